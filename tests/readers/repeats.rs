//! Repeated tests: their mean, what their scatter says, and what a job makes of it.

use crate::common::jobs::run;
use crate::common::jobs::said;
use crate::prelude::*;

/// The building's exact test.
pub fn exact() -> TestData {
    prepared(&building()).loaded.data.clone()
}

/// The same with noise, scaled and signed anyhow as an identification leaves it.
pub fn noisy(exact: &TestData, seed: u64) -> TestData {
    let modes = Modes::from_measured(&exact.frequencies_hz, &exact.shapes).unwrap();
    let test = with_noise(&modes, Noise::USUAL, seed).unwrap();
    let (mut shapes, mut draws) = (test.shapes().clone(), Draws(seed));
    for mut shape in shapes.column_iter_mut() {
        shape *= draws.between(-3.0, 3.0);
    }
    TestData {
        frequencies_hz: test.frequencies_hz(),
        shapes,
        ..exact.clone()
    }
}

/// The building's job with these tests as repeats, and these modes of them (from one).
pub fn repeated(tests: &[TestData], modes: &str) -> Files {
    let names = (1..=tests.len())
        .map(|number| format!("{number}.csv"))
        .collect_vec();
    let entry = format!("repeats = {names:?}\nmodes = {modes}");
    let mut files = with(building(), "job.toml", "file = \"test.csv\"", &entry);
    files.extend(
        names
            .into_iter()
            .zip(tests)
            .map(|(name, test)| (name, write_csv(test))),
    );
    files
}

fn loaded(files: &Files) -> PreparedJob {
    prepared(files)
}

const ALL: &str = "[1, 2, 3, 4, 5]";

#[test]
fn neither_scale_nor_sign_nor_order_of_repeats_matters() {
    let exact = exact();
    let tests = (1..=6).map(|seed| noisy(&exact, seed)).collect_vec();
    let one = loaded(&repeated(&tests, ALL)).loaded.data.clone();
    let mut others = tests.into_iter().rev().collect_vec();
    for (place, test) in others.iter_mut().enumerate() {
        test.shapes *= [-0.3, 12.0][place % 2];
        // Sensors in another order too.
        test.sensors.swap(place % 5, 4);
        test.shapes.swap_rows(place % 5, 4);
    }
    let two = loaded(&repeated(&others, ALL)).loaded.data.clone();
    let row = |name: &str| {
        one.sensors
            .iter()
            .position(|sensor| sensor.name == name)
            .unwrap()
    };
    for (place, sensor) in two.sensors.iter().enumerate() {
        let same = row(&sensor.name);
        for mode in 0..5 {
            let signs = one.shapes.column(mode).dot(&{
                let mut there = two.shapes.column(mode).into_owned();
                for (place, sensor) in two.sensors.iter().enumerate() {
                    there[row(&sensor.name)] = two.shapes[(place, mode)];
                }
                there
            });
            let off = one.shapes[(same, mode)] - signs.signum() * two.shapes[(place, mode)];
            assert!(off.abs() < MATRIX_ROUND_OFF, "{mode} {}", sensor.name);
            let [own, other] = [(&one, same), (&two, place)]
                .map(|(data, row)| data.component_deviation[&mode][row]);
            assert!(relative_error(own, other) < MATRIX_ROUND_OFF);
        }
    }
    assert_alike(
        one.frequencies_hz.iter(),
        &two.frequencies_hz,
        MATRIX_ROUND_OFF,
    );
}

/// Twenty repeats, each with eight tenths of the noise of the one before, and twenty with noise of their own.
#[test]
fn repeats_that_drift_are_said_and_widen_the_deviations() {
    const KEPT: f64 = 0.8;
    let exact = exact();
    let independent = (1..=20).map(|seed| noisy(&exact, seed)).collect_vec();
    let unit = |data: &TestData, mode: usize| {
        let shape = data.shapes.column(mode);
        let along =
            shape.dot(&exact.shapes.column(mode)) / exact.shapes.column(mode).norm_squared();
        shape / along
    };
    let mut drifting = independent.clone();
    for test in 1..drifting.len() {
        let fresh = (1.0 - KEPT * KEPT).sqrt();
        let before = drifting[test - 1].clone();
        for mode in 0..exact.frequencies_hz.len() {
            let next = |of: f64, last: f64, now: f64| of + KEPT * (last - of) + fresh * (now - of);
            let right = exact.frequencies_hz[mode];
            drifting[test].frequencies_hz[mode] = next(
                right,
                before.frequencies_hz[mode],
                independent[test].frequencies_hz[mode],
            );
            let (last, now) = (unit(&before, mode), unit(&independent[test], mode));
            let right = exact.shapes.column(mode);
            let shape = right.zip_zip_map(&last, &now, next);
            drifting[test].shapes.set_column(mode, &shape);
        }
    }
    let lag = |tests: &[TestData]| {
        let prepared = loaded(&repeated(tests, ALL));
        let said = trust_in(&prepared);
        let data = prepared.loaded.data.clone();
        let told = said
            .of(Kind::Drift)
            .map(|own| own.measure.clone())
            .collect_vec();
        let known = data
            .drift
            .map(|lag| vec![lag, ((1.0 + lag) / (1.0 - lag)).sqrt()]);
        assert_eq!(told, known.into_iter().collect_vec());
        // Numbers about their own mean are less alike by one in as many as there are.
        let mut unit = data.scatter.clone();
        unit.row_iter_mut()
            .for_each(|mut row| _ = row.normalize_mut());
        let next = (1..20).map(|test| unit.column(test - 1).dot(&unit.column(test)));
        let own = next.sum::<f64>() / unit.norm_squared() + 0.05;
        data.drift
            .iter()
            .for_each(|lag| assert_within(lag, own, ROUND_OFF));
        (data.drift, data.frequency_deviation.unwrap())
    };
    let (none, own) = lag(&independent);
    assert_eq!(none, None);
    let (found, wide) = lag(&drifting);
    let found = found.unwrap();
    assert_within(found, KEPT, 0.3);
    // As much wider as the mean of numbers that are alike from one to the next is less sure.
    let mut shuffled = drifting.clone();
    for place in 0..10 {
        shuffled.swap(place, (7 * place + 3) % 20);
    }
    let (_, alone) = lag(&shuffled);
    let wider = ((1.0 + found) / (1.0 - found)).sqrt();
    for (wide, alone) in wide.iter().zip(&alone) {
        assert_within(wide / alone / wider, 1.0, MATRIX_ROUND_OFF);
    }
    assert_eq!(own.len(), wide.len());
}

/// Mean over many jobs of chi-squared over its degrees of freedom, with its standard error, by so many repeats of `test`.
fn chi_squared(jobs: u64, repeats: u64, modes: &str, test: impl Fn(u64) -> TestData) -> (f64, f64) {
    let ratios = (0..jobs)
        .map(|job| {
            let tests = (1..=repeats)
                .map(|seed| test(repeats * job + seed))
                .collect_vec();
            let misfit = run(&loaded(&repeated(&tests, modes)), |_| {}, || true)
                .unwrap()
                .misfit;
            misfit.chi_squared / misfit.degrees_of_freedom
        })
        .collect_vec();
    let (count, mean) = (jobs as f64, ratios.iter().sum::<f64>() / jobs as f64);
    let squares: f64 = ratios.iter().map(|ratio| (ratio - mean).powi(2)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}

/// By variances estimated from twenty tests, from two, three and eight in common.
#[test]
fn chi_squared_by_estimated_deviations_is_one_in_the_mean_or_a_fifth_less() {
    let exact = exact();
    for (jobs, repeats) in [(60, 20), (60, 8), (60, 3), (60, 2)] {
        let (mean, error) = chi_squared(jobs, repeats, ALL, |seed| noisy(&exact, seed));
        let chance = STANDARD_ERRORS * error;
        let expected = 1.0 - LEANING - chance..1.0 + chance;
        assert!(expected.contains(&mean), "{repeats}: {mean}");
        assert!(error < 0.1, "{repeats}: {error}");
    }
}

/// Frequencies that rise and fall together, and sensors that do.
fn correlated(exact: &TestData, seed: u64) -> TestData {
    let mut test = noisy(exact, seed);
    let mut draws = Draws(seed ^ 0xc0);
    let warm = 1.0 + 0.02 * (draws.unit() + draws.unit() + draws.unit() - 1.5);
    test.frequencies_hz
        .iter_mut()
        .for_each(|hertz| *hertz *= warm);
    for mut shape in test.shapes.column_iter_mut() {
        let turn = 0.05 * shape.amax() * (draws.unit() + draws.unit() + draws.unit() - 1.5);
        for row in [0, 2] {
            shape[row] += turn;
        }
    }
    test
}

/// Whether a covariance has made a job's residuals independent: the first is then not the weighted error of the first frequency.
fn is_whitened(loaded: &PreparedJob) -> bool {
    let (comparison, weights) = (loaded.analyze(&[1.0; 10]).unwrap(), loaded.weights());
    let State { modes, pairing, .. } = comparison.model().exact();
    let hertz = pairing.paired(modes).unwrap().frequencies_hz();
    let error = hertz[0] / comparison.model().test().frequencies_hz()[0] - 1.0;
    let first = residuals(&comparison, &weights).unwrap()[0];
    (first / (weights[0].frequency * error) - 1.0).abs() > 0.1
}

#[test]
fn with_enough_repeats_their_covariance_counts() {
    let exact = exact();
    // Two modes of five sensors have ten numbers beside their scales.
    let tests = (1..=13).map(|seed| correlated(&exact, seed)).collect_vec();
    for (tests, counts) in [(&tests[..12], false), (&tests[..], true)] {
        let files = repeated(tests, "[1, 2]");
        let loaded = loaded(&files);
        let trust = trust_in(&loaded);
        let of = |concern: &&Concern| concern.identifier() == "repeats";
        let words = trust.all().iter().find(of).unwrap().words();
        let expected = if counts {
            "their covariance counts"
        } else {
            "their variances alone count, for a covariance of 10 numbers needs 13 tests"
        };
        assert!(words.contains(expected), "{words}");
        assert_eq!(is_whitened(&loaded), counts);
        assert_eq!(trust.about(Kind::AssumedDeviations), [""; 0]);
        // Weights of the job's own leave variances.
        let own = comparing(files, "shape_weights = [2, 1]");
        assert!(!is_whitened(&self::loaded(&own)));
    }
    let (mean, error) = chi_squared(40, 40, ALL, |seed| correlated(&exact, seed));

    assert_within(mean, 1.0, STANDARD_ERRORS * error);
    assert!(error < 0.15, "{error}");
}

#[test]
fn repeats_that_do_not_go_together_are_refused() {
    let exact = exact();
    let tests = (1..=4).map(|seed| noisy(&exact, seed)).collect_vec();
    let changed = |change: fn(&mut TestData)| {
        let mut tests = tests.clone();
        change(&mut tests[2]);
        said(&repeated(&tests, ALL))
    };
    let other = "test.repeats: 3.csv has not the sensors, modes and shapes of 1.csv";
    assert!(changed(|test| test.sensors[1].name = "roof".to_owned()).contains(other));
    assert!(
        changed(|test| {
            test.frequencies_hz.pop();
            test.shapes = test.shapes.columns(0, 4).into_owned();
        })
        .contains(other)
    );
    let unlike = changed(|test| test.shapes.swap_columns(1, 2));
    assert!(
        unlike.contains("test.repeats: mode 2 of 3.csv is unlike the others"),
        "{unlike}"
    );
    let same = said(&repeated(&vec![tests[0].clone(); 4], ALL));
    assert!(
        same.contains("test.repeats: 4 tests do not tell the deviations of"),
        "{same}"
    );
    let one = said(&repeated(&tests[..1], ALL));
    assert!(
        one.contains("[test] must name either a file, or two or more repeats"),
        "{one}"
    );
    let both = with(
        repeated(&tests, ALL),
        "job.toml",
        "[test]",
        "[test]\nfile = \"1.csv\"",
    );
    assert!(said(&both).contains("[test] must name either a file"));
    let mut missing = repeated(&tests, ALL);
    missing.retain(|(name, _)| name != "2.csv");
    assert!(said(&missing).contains("2.csv (test.repeats in job.toml): no such file"));
}

/// Sensors that are left out or turned, and modes that are left out: the covariance is that of the numbers compared.
#[test]
fn a_covariance_is_that_of_what_is_compared() {
    let exact = exact();
    let tests = (1..=13).map(|seed| correlated(&exact, seed)).collect_vec();
    let files = with(
        repeated(&tests, "[2, 4]"),
        "job.toml",
        "[compare]",
        "[sensors]\nleave_out = [\"floor 4\"]\nplace = [{ sensor = \"floor 3\", grid = 3, direction = \"-x\" }]\n[compare]",
    );
    let loaded = loaded(&files);
    // By hand: frequencies over their deviations, of shapes the four floors that are left, and R (R − p − 2) with eight numbers.
    let hertz = |mode: usize| DMatrix::from_fn(1, 13, |_, test| tests[test].frequencies_hz[mode]);
    // All frequencies of so few files have one deviation, of five modes that have twelve numbers each.
    let off = |mode: usize| (hertz(mode) / hertz(mode).mean()).add_scalar(-1.0);
    let squares: f64 = (0..5).map(|mode| off(mode).norm_squared()).sum();
    let deviation = (squares / (5.0 * 12.0 - 2.0) / 13.0).sqrt();
    let (mut apart, mut along) = (DMatrix::zeros(10, 13), DMatrix::zeros(10, 2));
    for (place, mode) in [1, 3].into_iter().enumerate() {
        apart.set_row(5 * place, &(off(mode) / deviation).row(0));
        let deviations = &loaded.loaded.data.component_deviation[&mode];
        for (number, (floor, sign)) in [(0, 1.0), (1, -1.0), (3, 1.0), (4, 1.0)]
            .into_iter()
            .enumerate()
        {
            let (row, scale) = (5 * place + 1 + number, sign / deviations[floor]);
            let scatter = loaded.loaded.data.scatter.row(6 * mode + 1 + floor);
            apart.set_row(row, &(scatter * scale));
            along[(row, place)] = loaded.loaded.data.shapes[(floor, mode)] * scale;
        }
    }
    along
        .column_iter_mut()
        .for_each(|mut own| _ = own.normalize_mut());
    let covariance = &apart * apart.transpose() / (13.0 * 3.0) + &along * along.transpose();
    let (comparison, weights) = (loaded.analyze(&[1.0; 10]).unwrap(), loaded.weights());
    let found = residuals(&comparison, &weights).unwrap();
    assert_eq!(found.len(), 10);
    let by_hand = |covariance: &DMatrix<f64>| {
        let comparison = comparison.clone().with_covariance(covariance).unwrap();
        residuals(&comparison, &weights).unwrap()
    };
    let apart = (by_hand(&covariance) - &found).amax() / found.amax();
    assert!(apart < MATRIX_ROUND_OFF, "{apart}");
    // What goes together counts: variances alone would make other residuals of the same numbers.
    let variances = DMatrix::from_diagonal(&covariance.diagonal());
    assert!((by_hand(&variances) - &found).amax() > 0.1 * found.amax());
}

/// Modes that are held out leave the others their covariance: it needs no more tests, and their residuals are those of a job without them.
#[test]
fn modes_held_out_leave_the_covariance_of_the_others() {
    let exact = exact();
    let tests = (1..=13).map(|seed| correlated(&exact, seed)).collect_vec();
    let held = with(
        repeated(&tests, "[1, 2, 3]"),
        "job.toml",
        "[test]",
        "[test]\nhold_out = [3]",
    );
    let of = |files: &Files| {
        let loaded = loaded(files);
        let comparison = loaded.analyze(&[1.0; 10]).unwrap();
        residuals(&comparison, &loaded.weights()).unwrap()
    };
    let (with_held, without) = (of(&held), of(&repeated(&tests, "[1, 2]")));
    assert!(is_whitened(&loaded(&held)));
    assert_eq!((with_held.len(), without.len()), (18, 12));
    // Signs of a triangular factor are free, and the held mode weighs nothing.
    let apart = with_held.rows(0, 12).norm() / without.norm() - 1.0;
    assert!(apart.abs() < MATRIX_ROUND_OFF, "{apart}");
    assert!(with_held.rows(12, 6).amax() < MATRIX_ROUND_OFF * without.amax());
}
