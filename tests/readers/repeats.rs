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

/// By variances estimated from two, three, eight and twenty tests.
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
