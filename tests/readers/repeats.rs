//! Repeated tests: their mean, what their scatter says, and what a job makes of it.

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

const ALL: &str = "[1, 2, 3, 4, 5]";

#[test]
fn neither_scale_nor_sign_nor_order_of_repeats_matters() {
    let exact = exact();
    let tests = (1..=6).map(|seed| noisy(&exact, seed)).collect_vec();
    let one = prepared(&repeated(&tests, ALL)).loaded.data.clone();
    let mut others = tests.into_iter().rev().collect_vec();
    for (place, test) in others.iter_mut().enumerate() {
        test.shapes *= [-0.3, 12.0][place % 2];
        // Sensors in another order too.
        test.sensors.swap(place % 5, 4);
        test.shapes.swap_rows(place % 5, 4);
    }
    let two = prepared(&repeated(&others, ALL)).loaded.data.clone();
    // Rows of the second that have the sensors of the first.
    let row = |own: &Sensor| two.sensors.iter().position(|other| other.name == own.name);
    let rows = one
        .sensors
        .iter()
        .map(|own| row(own).unwrap())
        .collect_vec();
    let shapes = two.shapes.select_rows(&rows);
    for mode in 0..5 {
        let (own, other) = (one.shapes.column(mode), shapes.column(mode));
        let off = own - own.dot(&other).signum() * other;
        assert!(off.amax() < MATRIX_ROUND_OFF, "{mode}");
        let other = two.component_deviation[&mode].select_rows(&rows);
        assert_alike(&one.component_deviation[&mode], &other, MATRIX_ROUND_OFF);
    }
    assert_alike(&one.frequencies_hz, &two.frequencies_hz, MATRIX_ROUND_OFF);
}

/// By variances estimated from two, three, eight and twenty tests: of many jobs the mean of chi-squared over its degrees of freedom, beside its
/// standard error.
#[test]
fn chi_squared_by_estimated_deviations_is_one_in_the_mean_or_a_fifth_less() {
    let (exact, jobs) = (exact(), 60);
    for repeats in [20, 8, 3, 2] {
        let ratio = |job: u64| {
            let seeds = repeats * job + 1..=repeats * job + repeats;
            let tests = seeds.map(|seed| noisy(&exact, seed)).collect_vec();
            let misfit = finished(&prepared(&repeated(&tests, ALL))).misfit;
            misfit.chi_squared / misfit.degrees_of_freedom
        };
        let ratios = DVector::from_iterator(jobs, (0..jobs as u64).map(ratio));
        let (mean, error) = (
            ratios.mean(),
            (ratios.variance() / (jobs as f64 - 1.0)).sqrt(),
        );
        let chance = STANDARD_ERRORS * error;
        let expected = 1.0 - LEANING - chance..1.0 + chance;
        assert!(
            expected.contains(&mean) && error < 0.1,
            "{repeats}: {mean} {error}"
        );
    }
}

#[test]
fn repeats_that_are_unlike_are_refused() {
    let exact = exact();
    let mut tests = (1..=4).map(|seed| noisy(&exact, seed)).collect_vec();
    tests[2].shapes.swap_columns(1, 2);
    let refused = crate::common::jobs::said(&repeated(&tests, ALL));
    let words = "test.repeats: mode 2 of 3.csv is unlike the others";
    assert!(refused.contains(words), "{refused}");
}
