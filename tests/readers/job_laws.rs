//! Laws of a job by numbers that are worked out by hand: how each concern is filled, and both sides of every limit before the first step.

use super::job_concerns::tested;
use super::twice::universal;
use crate::common::jobs::unbroken;
use crate::prelude::*;
use crate::spec::sx_preflight::{NONE, numbered};
use corfem::job::HeldOut;
use corfem::present::report::facts;

fn before(files: &Files) -> Vec<Concern> {
    trust_in(&prepared(files)).all().to_vec()
}

/// Identifiers and sentences of those whose identifiers begin so.
fn lines(all: &[Concern], names: &[&str]) -> Vec<String> {
    let is_of = |own: &&Concern| {
        let mut names = names.iter();
        names.any(|name| own.identifier.starts_with(name))
    };
    let line = |own: &Concern| format!("{}: {}", own.identifier, own.words);
    all.iter().filter(is_of).map(line).collect()
}

/// One of them, or nothing.
fn line(all: &[Concern], names: &[&str]) -> String {
    lines(all, names).join("; ")
}

/// A fact of a job's model.
fn fact(files: &Files, name: &str) -> String {
    let facts = facts(&prepared(files)).unwrap();
    let fact = facts.into_iter().find(|own| own.fact == name);
    fact.unwrap().value
}

/// The same before the first step, of another job with its only parameter in bounds.
fn bounded(files: Files, bounds: &str) -> Files {
    with(
        files,
        "job.toml",
        "name = \"all\"\n",
        &format!("name = \"all\"\n{bounds}"),
    )
}

/// A building of ten floors has $\omega_j = 2 \sqrt{k/m} \sin \frac{(2j - 1) \pi}{42}$: .9712, 2.8917, 4.7480, 6.4974 Hz. All its frequencies
/// have 200 for weight and 100 for slope, and of 40 numbers the factor takes 4e4/(4e4 + 1); 72.055 and 17.262 are the quantiles of 39.
#[test]
fn a_right_job_says_all_that_is_known_of_it() {
    let right = tested(|_| {});
    let places = "not-checked-places-of-sensors: Not checked: places of sensors (the places of sensors or of their grids are not given).";
    let assumed =
        "assumed-deviations: Standard deviations assumed: 0.5 % of frequencies, 2 % of shapes.";
    assert_eq!(lines(&before(&right), &[""]), [places, assumed]);
    let result = finished(&prepared(&right));
    let below = "below-noise: Noise alone would leave a chi-squared of 17.3 or more in 999 of 1000 tests, for 0.0 here: the test was \
                 computed, or its deviations are too large, and so are the intervals.";
    let said = lines(result.trust.all(), &[""]);
    assert_eq!(said, [places, assumed, below]);
    let numbers = "Chi-squared is 0.0 for 39.0 degrees of freedom; noise alone leaves at most 72.1 in 999 of 1000 tests.";
    assert_eq!(result.misfit.in_numbers(), numbers);
    let taken = "the lowest 8, beside 0 rigid-body modes";
    assert_eq!(fact(&right, "modes taken"), taken);
    assert_eq!(fact(&right, "parameters without bounds"), "all");
    // A parameter that ends at a bound takes none of the numbers.
    let higher = tested(|data| {
        data.frequencies_hz
            .iter_mut()
            .for_each(|hertz| *hertz *= 1.1)
    });
    let stopped = finished(&prepared(&bounded(higher, "lower = 0.9\nupper = 1.1\n")));
    assert_eq!(stopped.misfit.degrees_of_freedom, 40.0);
    // Without the second of the three modes it is unanswered, the one above the last is not.
    let left = with(
        tested(|_| {}),
        "job.toml",
        "[test]\n",
        "[test]\nmodes = [2, 4]\n",
    );
    let unanswered = lines(&before(&left), &["unanswered-modes"]);
    assert_eq!(unanswered.len(), 1);
    assert!(unanswered[0].contains(": mode 3 (4.747"), "{unanswered:?}");
    let weighted = comparing(right, "shape_weights = [1, 1, 0.5, 1]");
    assert_eq!(lines(&before(&weighted), &["own-weights"]).len(), 1);
}

/// Modes whose shapes are those of four Hadamard functions, or others, at four sensors, by their frequencies.
fn looked_at(
    analysis: &[f64],
    tests: &[f64],
    shapes: &DMatrix<f64>,
    noise: &[Noise],
) -> Vec<Concern> {
    let hadamard = dmatrix![1.0, 1.0, 1.0, 1.0; 1.0, -1.0, 1.0, -1.0; 1.0, 1.0, -1.0, -1.0; 1.0, -1.0, -1.0, 1.0]
        / 2.0;
    let squares = |hertz: &[f64]| {
        let squares = hertz.iter().map(|hertz| (TAU * hertz).powi(2));
        DVector::from_iterator(hertz.len(), squares)
    };
    let modes = |hertz: &[f64], shapes| Modes::new(squares(hertz), shapes).unwrap();
    let readings = hadamard.columns(0, analysis.len()).into_owned();
    let seen = SeenModes {
        // One parameter scales all.
        shares: vec![ParameterMatrix::Stiffness(DMatrix::from_diagonal(
            &squares(analysis),
        ))],
        modes: modes(analysis, readings),
    };
    let test = modes(tests, &hadamard * shapes);
    let numbers = (1..=tests.len()).collect_vec();
    let (_, mut found) = measured_once((&test, noise), &numbers).unwrap();
    found.extend(preflight_at_sensors(&seen, (&test, noise), (&numbered(4), "test")).unwrap());
    found
}

/// A unit is named where half of the ratios at least are within 1.35 of its factor, and the test is by enough more likely in it.
#[test]
fn every_limit_of_frequencies_has_two_sides() {
    // No two ratios alike, so that a unit leads to no other mode.
    let (spread, same) = ([1.0, 5.0, 70.0, 400.0], eye(4));
    let is_named = |ratios: [f64; 4]| {
        let tests = spread
            .iter()
            .zip(ratios)
            .map(|(hertz, ratio)| hertz * ratio);
        let found = looked_at(&spread, &tests.collect_vec(), &same, &[NONE; 4]);
        let said = "common-factor: Test frequencies are near 2π times the model's: the test is in rad/s? The test would be 10^";
        let found = line(&found, &["common-factor"]);
        assert!(found.is_empty() || found.starts_with(said), "{found}");
        !found.is_empty()
    };
    // Whatever no unit explains is none of these.
    for factor in [1.5, 1.0 / 1.5, 2.0] {
        assert!(!is_named([factor; 4]), "{factor}");
    }
    for (off, expected) in [(1.34, true), (1.36, false)] {
        for factor in [TAU * off, TAU / off] {
            assert_eq!(is_named([factor; 4]), expected, "{factor}");
        }
        let [near, far] = [TAU, TAU * 1.5];
        assert!(is_named([near, near, far, far]));
        assert_eq!(is_named([near, TAU * off, far, far]), expected);
    }
}

/// Two test modes are alike from a modal assurance of .9 on. They are one mode where noise explains what they differ by: at four sensors with
/// deviations of 1 and .5 %, $\chi^2 = 2 \cdot 10^4 (1 - m + \ln^2 r)$ is at most 18.47.
#[test]
fn a_mode_is_measured_twice_where_noise_explains_the_difference() {
    let noise = Noise {
        shape: 0.01,
        frequency: 0.005,
    };
    let (none, alike, twice) = ("", ".", "; measured twice?");
    for (close, ratio, end) in [
        (0.899_f64, 1.0, none),
        (0.901, 1.0, alike),
        (0.99906, 1.0, alike),
        (0.99909, 1.0, twice),
        (0.9996, 1.022, twice),
        (0.9996, 1.024, alike),
        (0.9996, 0.978, twice),
        (0.9996, 0.976, alike),
    ] {
        let (own, other) = (close.sqrt(), (1.0 - close).sqrt());
        let shapes = dmatrix![1.0, own; 0.0, other; 0.0, 0.0; 0.0, 0.0];
        let found = looked_at(&[1.0, 3.0, 9.0, 27.0], &[1.0, ratio], &shapes, &[noise; 2]);
        let expected = match end {
            "" => String::new(),
            _ => format!(
                "same-1-2: Test modes 1 and 2 are nearly the same shape, modal assurance {close:.3}{end}"
            ),
        };
        assert_eq!(line(&found, &["same-"]), expected);
    }
    // By a deviation of one any two shapes would be one mode.
    let files = tested(|data| {
        let first = data.shapes.column(0).into_owned();
        data.shapes.set_column(1, &first);
        data.frequencies_hz[1] = 1.001 * data.frequencies_hz[0];
        data.shape_deviation = Some(vec![1.0; 4]);
    });
    let found = line(&before(&files), &["same-"]);
    assert_eq!(
        found,
        "same-1-2: Test modes 1 and 2 are nearly the same shape, modal assurance 1.000."
    );
}

/// With bounds of .9 to 1.1 a stiffness has frequencies of $\sqrt{.9}$ to $\sqrt{1.1}$ in reach, a mass of $1/\sqrt{1.1}$ to $1/\sqrt{.9}$, and a
/// prior of .1 alone has $e^{\mp .2}$: each but for four deviations of .5 %.
#[test]
fn every_limit_of_reach_has_two_sides() {
    let hertz = (1e5_f64 / 60.0).sqrt() / TAU;
    let of = |bounds: &str, ratio: f64| {
        let files = tested(|data| data.frequencies_hz[3] *= ratio);
        let mut files = bounded(files, bounds);
        if bounds.contains("mass") {
            files = with(
                files,
                "job.toml",
                "matrix = \"stiffness.mtx\"",
                "matrix = \"mass.mtx\"",
            );
            let mass: String = (1..=10).map(|row| format!("{row} {row} 60\n")).collect();
            files.push((
                "mass.mtx".to_owned(),
                format!("%%MatrixMarket matrix coordinate real symmetric\n10 10 10\n{mass}"),
            ));
        }
        line(&before(&files), &["beyond-reach-"])
    };
    let (stiff, heavy, prior) = (
        "lower = 0.9\nupper = 1.1\n",
        "scales = \"mass\"\nlower = 0.9\nupper = 1.1\n",
        "prior_deviation = 0.1\n",
    );
    let (root, ends) = (|of: f64| of.sqrt(), 0.02);
    for (bounds, low, high) in [
        (stiff, root(0.9), root(1.1)),
        (heavy, root(1.1).recip(), root(0.9).recip()),
        (prior, f64::exp(-0.2), f64::exp(0.2)),
    ] {
        for (ratio, is_in_reach) in [
            (low * (1.0 - ends) * 0.999, false),
            (low * (1.0 - ends) * 1.001, true),
            (high * (1.0 + ends) * 0.999, true),
            (high * (1.0 + ends) * 1.001, false),
        ] {
            let found = of(bounds, ratio);
            let [own, low, high] = [ratio, low, high].map(|of| of * hertz);
            let start = format!("beyond-reach-4: Test mode 4 has {}", &own.to_string()[..5]);
            let partner = format!(
                " Hz, and its partner, mode 4 of the first model, can have {low:.4} to {high:.4} Hz within"
            );
            match is_in_reach {
                true => assert_eq!(found, ""),
                false => assert!(
                    found.starts_with(&start) && found.contains(&partner),
                    "{found}"
                ),
            }
        }
    }
}

/// Settings, phases and readings from both sides of their limits.
#[test]
fn every_limit_of_a_test_has_two_sides() {
    let said = |files: &Files| line(&before(files), &["percent-", "complex", "gain-"]);
    let percent = |setting: &str, size: f64| {
        format!(
            "percent-{setting}: Setting {setting} is {size}, that is {} %: a percentage",
            100.0 * size
        )
    };
    let none = String::new;
    let check = |files: &Files, expected: String| {
        let found = said(files);
        assert!(
            found.starts_with(&expected) && found.is_empty() == expected.is_empty(),
            "{found}, {expected}"
        );
    };
    let shape = |size: f64| tested(|data| data.shape_deviation = Some(vec![size; 4]));
    let frequency = |size: f64| tested(|data| data.frequency_deviation = Some(vec![size; 4]));
    let by_components = |data: &mut TestData| {
        let own = DVector::from_fn(10, |row, _| if row == 0 { 15.0 } else { 2.5 });
        data.component_deviation = (0..4).map(|mode| (mode, own.clone())).collect();
    };
    let phase = |size: f64| tested(|data| data.phase_collinearity = vec![1.0, size, 1.0, 1.0]);
    for (files, expected) in [
        (shape(4.99), none()),
        (shape(5.01), percent("shape_deviation", 5.01)),
        // Of components, the root of the mean square.
        (
            tested(by_components),
            "percent-shape_deviation: Setting shape_deviation is 5.303".into(),
        ),
        (frequency(0.2), none()),
        (frequency(0.201), percent("frequency_deviation", 0.201)),
        (phase(0.951), none()),
        (
            phase(0.949),
            "complex: Complex test modes, with their phase collinearity: 2 (0.95).".into(),
        ),
    ] {
        check(&files, expected);
    }
    for entry in [
        "frequency_tolerance",
        "shape_tolerance",
        "inner.tolerance",
        "later_inner_tolerance",
        "error_sum_tolerance",
    ] {
        for (value, expected) in [(0.2, none()), (0.201, percent(entry, 0.201))] {
            let entries = format!("[correlation]\n{entry} = {value}\n[[parameter]]");
            let files = with(tested(|_| {}), "job.toml", "[[parameter]]", &entries);
            check(&files, expected);
        }
    }
    // A gain from one and a half on either way.
    for factor in [1.45, 1.0 / 1.45, 1.55, 1.0 / 1.55] {
        let expected = match f64::max(factor, 1.0 / factor) < 1.5 {
            true => none(),
            false => format!(
                "gain-5: Sensor 5 reads {factor:.3} times too much? Divide its row by that in test.csv."
            ),
        };
        let files = tested(|data| data.shapes.row_mut(4).scale_mut(factor));
        check(&files, expected);
    }
}

/// A sensor 120 in from the next grid is doubted where that is twice as near as its own. Sensors span the model: their places are in
/// another unit where they span twice as much.
#[test]
fn every_limit_of_places_has_two_sides() {
    let edited = |edit: &dyn Fn(usize, f64) -> f64| {
        before(&retested(building(), |data| {
            for (row, sensor) in data.sensors.iter_mut().enumerate() {
                if let Some(place) = &mut sensor.place {
                    place.z = edit(row, place.z);
                }
            }
        }))
    };
    let other = "other-grid: By their places sensors floor 1 are nearer";
    for (off, expected) in [(79.0, ""), (81.0, other)] {
        let moved = edited(&|row, z| z + if row == 0 { off } else { 0.0 });
        let found = line(&moved, &["other-grid"]);
        assert_eq!(&found[..found.len().min(other.len())], expected, "{off}");
    }
    let far = "unit-of-places: The sensors' places span 2.0 times what the model's do: another unit of length?";
    for (scale, expected) in [(1.99, ""), (2.01, far)] {
        let scaled = edited(&|_, z| scale * z);
        assert_eq!(line(&scaled, &["unit-of-places"]), expected, "{scale}");
    }
}

/// A right test of a tower whose parameters do nearly the same: its factors are told by their own deviations, and every mode is good. A
/// sensor turned round comes first, with its edit, and no parameter is advised on.
#[test]
fn words_agree_with_numbers() {
    let all = fs::read_dir(in_root("tests/runs/tower_contradicts_itself")).unwrap();
    let read = |entry: std::io::Result<fs::DirEntry>| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    let files: Files = all.map(read).collect();
    let of = |old: &str, new: &str| {
        let found = answered(&with(files.clone(), "t0.002_0.csv", old, new));
        (found.doubts, unbroken(&found.words))
    };
    let (doubts, right) = of("", "");
    assert!(
        doubts.is_empty() && !right.contains("cannot tell") && !right.contains("poor"),
        "{right}"
    );
    let (doubts, turned) = of("\n5,x,", "\n5,-x,");
    let edit = "Sensor 5 x reversed? Give its row the other sign in t0.002_0.csv. ";
    assert!(
        doubts.contains(&"reversed-5-x".to_owned()) && !turned.contains(" Try "),
        "{turned}"
    );
    assert!(
        turned.find(edit).unwrap() < turned.find("Not to be trusted").unwrap(),
        "{turned}"
    );
    for once in ["hi-squared is", "Not to be trusted", "reversed?"] {
        assert_eq!(turned.matches(once).count(), 1, "{turned}");
    }
}

/// All frequencies but the fourth are five hundredths higher than the model's: the stiffness follows to 1.05², and the fourth, held out, which was
/// right, is five hundredths off.
#[test]
fn a_mode_held_out_says_what_it_was_and_is() {
    let files = tested(|data| {
        data.frequencies_hz
            .iter_mut()
            .take(3)
            .for_each(|hertz| *hertz *= 1.05)
    });
    let files = with(files, "job.toml", "[test]\n", "[test]\nhold_out = [4]\n");
    let files = bounded(files, "prior_deviation = 100\n");
    let held = finished(&prepared(&files)).found.held_out().unwrap();
    let [
        HeldOut {
            mode: 4,
            frequency,
            shape: Some(shape),
        },
    ] = held[..]
    else {
        panic!("{held:?}")
    };
    let said = [frequency, shape].map(|own| own.map(|own| format!("{:.2}", own.abs())));
    assert_eq!(said, [["0.00", "5.00"], ["0.00", "0.00"]]);
}

/// The nearest grid that moves: the wall, two inches away, is held.
#[test]
fn a_sensor_is_never_placed_at_a_grid_that_is_held() {
    let files = rods_with("[sensors]", "[sensors]\nby = \"nearest\"");
    let files = with(files, "test.csv", "10.", "2.");
    let loaded = prepared(&files);
    let first = &loaded.loaded.placed[0];
    assert_eq!((first.grid, first.distance), (2, Some(8.0)));
}

/// Common mistakes of the readings, with declared noise that differs by mode: what each is called, by which power of ten it makes the test more
/// likely, and how large a gain is. No hand has worked these powers out; they are those of the equations at the head of `readings.rs`.
#[test]
fn the_evidence_of_a_mistake_is_what_it_is() {
    let of = |edit: &dyn Fn(&mut DMatrix<f64>)| {
        let files = tested(|data| {
            edit(&mut data.shapes);
            data.shape_deviation = Some(vec![0.001, 0.02, 0.03, 0.05]);
            data.frequency_deviation = Some(vec![0.001, 0.02, 0.01, 0.001]);
        });
        let kinds = ["reversed-", "exchanged-", "gain-"];
        let found = line(&before(&files), &kinds);
        let likely = found.split_once("The test's shapes would be ").unwrap();
        format!("{}{}", likely.0, &likely.1[..7])
    };
    let found = [
        of(&|shapes| shapes.row_mut(4).neg_mut()),
        of(&|shapes| shapes.swap_rows(2, 6)),
        of(&|shapes| shapes.row_mut(4).scale_mut(3.0)),
        of(&|shapes| shapes.row_mut(4).scale_mut(0.3)),
        of(&|shapes| shapes.row_mut(4).scale_mut(0.12)),
    ];
    let of_building = |noise: f64| {
        let found = before(&retested(building(), |data| {
            data.shapes.row_mut(3).neg_mut();
            data.shape_deviation = Some(vec![noise; 5]);
            data.frequency_deviation = Some(vec![0.001; 5]);
        }));
        line(&found, &["reversed-"])
    };
    // Less evidence than the number of tries over a thousandth of false alarms is none.
    for (noise, evidence) in [(0.001, 11.9), (0.05, 10.1), (0.2, 6.1)] {
        let expected = format!(
            "reversed-floor-7: Sensor floor 7 reversed? Give its row the other sign in test.csv. The test's shapes would be 10^{evidence:.1} times as likely, with its noise and a \
             model 30 % wrong."
        );
        assert_eq!(of_building(noise), expected);
    }
    assert_eq!(of_building(0.35), "");
    let expected = [
        "reversed-5: Sensor 5 reversed? Give its row the other sign in test.csv. 10^46.8",
        "exchanged-3-7: Sensors 3 and 7 exchanged? Exchange the readings of their rows in test.csv. 10^44.5",
        "gain-5: Sensor 5 reads 3.000 times too much? Divide its row by that in test.csv. 10^44.3",
        "gain-5: Sensor 5 reads 0.300 times too much? Divide its row by that in test.csv. 10^32.0",
        "gain-5: Sensor 5 reads 0.120 times too much? Divide its row by that in test.csv. 10^37.1",
    ];
    assert_eq!(found, expected);
}

/// Two sensors tell nothing of one, three do.
#[test]
fn three_sensors_are_the_fewest_that_tell() {
    let of = |count: usize| {
        let few = tested(|data| {
            data.sensors.truncate(count);
            data.shapes = data.shapes.rows(0, count).into_owned();
        });
        line(&before(&few), &["not-checked-readings"])
    };
    let none =
        |why| format!("not-checked-readings-of-sensors: Not checked: readings of sensors ({why}).");
    let [one, two] = [
        "at one sensor all shapes are alike",
        "two sensors tell no mistake of one",
    ]
    .map(none);
    assert_eq!(
        [1, 2, 3, 4].map(of),
        [one, two, String::new(), String::new()]
    );
}

/// Ten rows along x and y of five grids move three hundred along both. An inch is 39.37 to a meter but for a ten-thousandth. Of thirty floors two
/// exchanged sensors are among those that the others predict worst.
#[test]
fn masses_units_and_exchanges_are_filled() {
    let mut files = tested(|data| {
        for (row, sensor) in data.sensors.iter_mut().enumerate() {
            (sensor.grid, sensor.direction) = (Some(row / 2 + 1), row % 2);
        }
    });
    *file(&mut files, "rows.csv") = (0..10)
        .map(|row| format!("{},{}\n", row / 2 + 1, ["x", "y"][row % 2]))
        .collect();
    let mass = "mass along x, y, z";
    assert_eq!(fact(&files, mass), "300.000, 300.000, 0.00000");
    let other = "units-disagree: The test's file says that it is in Own, of 39.370100 to a meter, but its factor of length is 39.374500.";
    for (factor, expected) in [(39.3735, ""), (39.3745, other)] {
        let found = before(&universal(7, factor));
        assert_eq!(line(&found, &["units-disagree"]), expected);
    }
    let exchanged = |data: &mut TestData| data.shapes.swap_rows(2, 19);
    let found = before(&retested(measured_building(30, 6), exchanged));
    assert_eq!(lines(&found, &["exchanged-3-20"]).len(), 1);
}

/// Four frequencies, each of weight 200 and slope 100 times its ratio to the test's, have a singular value of 200 times that: 1/1.05 at first, and
/// one at the end. With a frequency's weight of .005 it is known from the prior though its mode has no other stiffness. Deviations are assumed of what
/// lacks them alone.
#[test]
fn a_test_sees_the_first_model_and_the_last() {
    let files = tested(|data| {
        data.frequencies_hz
            .iter_mut()
            .for_each(|hertz| *hertz *= 1.05)
    });
    let result = finished(&prepared(&bounded(files, "prior_deviation = 100\n")));
    let [first, last] = [&result.seen_first, &result.seen].map(|seen| seen.singular_values[0]);
    assert!(
        (first * 1.05 / 200.0 - 1.0).abs() < HELD_OUT && relative_error(last, 200.0) < HELD_OUT,
        "{first} {last}"
    );
    let one = |row: usize, size: f64| {
        DMatrix::from_fn(2, 2, |r, c| if r == row && c == row { size } else { 0.0 })
    };
    let modes = Modes::new(dvector![1e4, 4e4], eye(2)).unwrap();
    let files = of_matrices(&[one(0, 1e4), one(1, 4e4)], &eye(2), &modes);
    let weights = "[compare]\nfrequency_weights = [1, 0.005]\nshape_weights = [1, 0]\n[[parameter]]\nname = \"p1\"";
    let files = with(files, "job.toml", "[[parameter]]\nname = \"p1\"", weights);
    assert_eq!(finished(&prepared(&files)).verdict.unseen, [1]);
    let given = tested(|data| data.frequency_deviation = Some(vec![0.005; 4]));
    assert_eq!(
        line(&before(&given), &["assumed-deviations"]),
        "assumed-deviations: Standard deviations assumed: 2 % of shapes."
    );
}
