//! Laws of a job that no list says: limits of frequencies and shapes by modes made for them, and what is drawn, or compared with another job.

use crate::common::jobs::{files_in, loaded, tested, unbroken};
use crate::extensions::preflight::{NONE, numbered};
use crate::prelude::*;
use corfem::job::concern::Grade;

/// Sentences of concerns whose identifiers begin so.
fn line(all: &[Concern], name: &str) -> String {
    let all = all.iter().filter(|own| own.identifier.starts_with(name));
    all.map(|own| &own.words[..]).collect()
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
        let said = "Test frequencies are near 2π times the model's: the test is in rad/s? The test would be 10^";
        let found = line(&found, "common-factor");
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
                "Test modes 1 and 2 are nearly the same shape, modal assurance {close:.3}{end}"
            ),
        };
        assert_eq!(line(&found, "same-"), expected);
    }
}

/// A right test of a tower whose parameters do nearly the same: its factors are told by their own deviations, and every mode is good. A
/// sensor turned round comes first, with its edit, and no parameter is advised on.
#[test]
fn words_agree_with_numbers() {
    let files = files_in(&in_root("tests/runs/tower_contradicts_itself"));
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

/// Four frequencies, each of weight 200 and slope 100 times its ratio to the test's, have a singular value of 200 times that: 1/1.05 at first, and
/// one at the end. With a frequency's weight of .005 it is known from the prior though its mode has no other stiffness.
#[test]
fn a_test_sees_the_first_model_and_the_last() {
    let files = tested(|data| {
        data.frequencies_hz
            .iter_mut()
            .for_each(|hertz| *hertz *= 1.05)
    });
    let free = "name = \"all\"\nprior_deviation = 100\n";
    let result = finished(&prepared(&with(
        files,
        "job.toml",
        "name = \"all\"\n",
        free,
    )));
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
}

/// Shapes of no structure: whatever else is found, something is, and a correlation is refused.
#[test]
fn a_test_of_which_no_mode_resembles_one_of_the_model_is_doubtful() {
    let (mut draws, mut left) = (Draws(26), 0);
    for _ in 0..20 {
        let files = tested(|data| data.shapes.apply(|own| *own = draws.between(-1.0, 1.0)));
        let job = prepared(&files);
        if job.modes.len() == job.loaded.data.frequencies_hz.len() {
            let trust = trust_in(&job);
            assert!(trust.has_doubt());
            left += usize::from(!line(trust.all(), "no-pair").is_empty());
        }
    }
    assert!(left > 0);
}

/// The law: a look at a job and the account of its run end in the same doubts and the same test modes that are not compared.
#[test]
fn a_look_and_a_run_end_in_the_same_doubts() {
    let names = ["box", "building", "garteur", "wing"];
    let mut all = names
        .map(|name| [trust_in(&loaded(name)), worked(name).trust.clone()])
        .to_vec();
    let edits: [fn(&mut TestData); 2] = [
        |data| data.shapes.row_mut(4).neg_mut(),
        |data| {
            data.shapes.column_mut(2).fill(0.0);
            data.shapes[(0, 2)] = 1.0;
        },
    ];
    for edit in edits {
        let job = prepared(&tested(edit));
        all.push([trust_in(&job), finished(&job).trust]);
    }
    for (place, both) in all.iter().enumerate() {
        let [looked, ran] = both.each_ref().map(|trust| {
            let all = trust.all().iter();
            let is_against = |own: &&Concern| {
                [Grade::Doubt, Grade::LeftOut].contains(&own.grade)
                    || own.identifier.starts_with("not-compared-")
            };
            all.filter(is_against)
                .map(|own| &own.identifier)
                .collect_vec()
        });
        assert_eq!(looked, ran);
        assert!(place < names.len() || !looked.is_empty());
    }
}

/// What a job leaves out of its settings is the library's, and what it gives is taken.
#[test]
fn a_job_sets_some_of_the_settings_and_the_others_are_the_librarys() {
    let settings = |job: &str| {
        let (_folder, path) = placed(&rods_with("[compare]", &format!("{job}\n[compare]")));
        corfem::job::read(&path).unwrap().correlation
    };
    assert_eq!(settings(""), Settings::default());
    let mut expected = Settings {
        most_passes: 3,
        ..Settings::default()
    };
    assert_eq!(settings("[correlation]\nmost_passes = 3"), expected);
    expected.inner.tolerance = 0.5;
    let given = "[correlation]\nmost_passes = 3\n[correlation.inner]\ntolerance = 0.5";
    assert_eq!(settings(given), expected);
}

/// By the paper's rule: ones change nothing, and what a mode of weight zero is measured as is in no error. The step measures changes of
/// stiffness by all test modes: another way to the same place.
#[test]
fn the_papers_error_sum_takes_the_weights_of_a_job() {
    let ran = |weights: &str, third: f64| {
        let own = format!("method = \"paper\"\n{weights}");
        let files = rods_with("method = \"gauss_newton\"", &own);
        let files = retested(files, |data| data.frequencies_hz[2] *= third);
        let found = finished(&prepared(&files)).found;
        (found.first.model().exact().errors, found.factors)
    };
    let plain = ran("", 1.0);
    assert_eq!(ran("shape_weights = [1, 1, 1]", 1.0), plain);
    assert_ne!(ran("", 1.02).0, plain.0);
    let weights = "frequency_weights = [1, 1, 0]\nshape_weights = [2, 1, 0]";
    let [without, wrong] = [1.0, 1.02].map(|third| ran(weights, third));
    assert_ne!(without, plain);
    assert_eq!(wrong.0, without.0);
    assert_alike(wrong.1, without.1, WEIGHTED_FACTOR);
}

/// A model is compared with the test modes as they were measured, of another scale and of no other sign.
#[test]
fn test_modes_keep_the_sense_in_which_they_were_measured() {
    let prepared = prepared(&rods());
    let model = prepared.analyze(&[1.0, 1.0]).unwrap();
    let compared = model.model().test().shapes().column_iter();
    for (compared, measured) in compared.zip(prepared.test.shapes().column_iter()) {
        assert!(compared.dot(&measured) > 0.0, "{compared} {measured}");
    }
}

/// Rows that are rotations are found as those that are translations.
#[test]
fn a_sensor_of_rotations_measures_a_rotation() {
    let turned = building().into_iter().map(|(name, text)| match &name[..] {
        "rows.csv" => (name, text.replace(",x,0", ",rx,0")),
        "test.csv" => (name, text.replace(",x,+", ",rx,+")),
        _ => (name, text),
    });
    let (plain, turned) = (prepared(&building()), prepared(&turned.collect()));
    let mut sensors = turned.loaded.placed.iter();
    assert!(sensors.all(|sensor| sensor.direction == 3));
    assert_eq!(plain.loaded.sensors, turned.loaded.sensors);
}
