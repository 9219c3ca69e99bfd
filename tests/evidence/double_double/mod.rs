//! The whole chain of Cases 1 to 4 in double-double arithmetic: element matrices from coordinates, condensation, modes by Jacobi's
//! rotations, pairing, errors, derivatives, steps, limits, Recursive 1 to convergence, passes.
//!
//! It says how many digits of the history are round-off, and how near each decision (a halving, a stop, a pairing, a tolerance
//! met) was to falling otherwise. The condition is measured: the chain runs again with a noise of $10^{-20}$ where double precision
//! rounds, in the structural stiffness relative to its diagonal and in every change of the error sum relative to the sum, and what
//! comes out of it over what went in is how much one rounding counts. The crate differs from the chain by less than $10^{-14}$ times
//! that condition (which is up to $10^7$), and every decision of it is the chain's.
//!
//! No decision of any run hangs on less than $10^{-9}$, or on anything near it. The nearest of all is the stop after iteration 29 of
//! the run with seven test and nine analysis modes, whose error sum is 0.05 % below the tolerance.

mod analysis;
mod chain;
mod elements;
mod noise;

use crate::common::double_double::{DD_EPSILON, Dd};
use crate::common::tolerances::{CHAIN_ROUND_OFF, NEAREST_DECISION, ROUND_OFF};
use crate::evidence::readings::READINGS;
use approx::assert_relative_eq;
use chain::{Decision, History, Pass, run};
use corfem::method::outer_loop::Settings;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, PUBLISHED_RUNS, fewer_modes_run};
use corfem::torque_box::{CASES, Case, CaseResult, run_case};
use noise::Noise;
use num_rational::BigRational;
use proptest::prelude::*;
use std::f64::consts::PI;

/// The noise that stands for rounding, and its seeds.
const NOISE: f64 = 1e-20;
const SEEDS: [u64; 3] = [1, 2, 3];
const ALL_MODES: (usize, usize) = (9, 9);

/// Numbers of the crate, the same by the chain, and by the chain with noise.
fn assert_agree(what: &str, found: &[f64], exact: &[Dd], noisy: &[Vec<Dd>]) {
    assert_eq!(found.len(), exact.len(), "{what}");
    let largest = |others: &[Dd]| {
        let apart = others
            .iter()
            .zip(exact)
            .map(|(&other, &exact)| ((other - exact) / exact).abs().to_f64());
        apart.fold(0.0, f64::max)
    };
    let condition = noisy
        .iter()
        .map(|numbers| largest(numbers) / NOISE)
        .fold(1.0, f64::max);
    let apart = largest(&found.iter().copied().map(Dd::from).collect::<Vec<_>>());
    assert!(
        apart <= CHAIN_ROUND_OFF * condition,
        "{what}: {apart:e} apart, condition {condition:e}"
    );
}

/// The crate's pass beside the chain's: error sums, gages, squared frequencies, and the two errors of the check.
fn assert_pass(what: &str, found: [&[f64]; 4], pass: usize, exact: &History, noisy: &[History]) {
    let [error_sums, gages, squares, errors] = found;
    let of_check = |pass: &Pass| vec![pass.errors.frequency, pass.errors.shape];
    let compare = |name: &str, found: &[f64], of: &dyn Fn(&Pass) -> Vec<Dd>| {
        let noisy: Vec<Vec<Dd>> = noisy
            .iter()
            .map(|history| of(&history.passes[pass]))
            .collect();
        assert_agree(
            &format!("{what}, pass {}, {name}", pass + 1),
            found,
            &of(&exact.passes[pass]),
            &noisy,
        );
    };
    compare("error sums", error_sums, &|pass| pass.error_sums.clone());
    compare("gages", gages, &|pass| pass.gages.clone());
    compare("squared frequencies", squares, &|pass| {
        pass.omega_squared.clone()
    });
    compare("errors", errors, &of_check);
}

fn with_noise(case: &Case, settings: &Settings, modes: (usize, usize)) -> Vec<History> {
    SEEDS
        .into_iter()
        .map(|seed| run(case, settings, modes, Noise::of(NOISE, seed)))
        .collect()
}

/// Runs a case both ways and compares them.
fn compared(case: &Case) -> (CaseResult, History) {
    let found = run_case(case, |_, _| {}).expect("it runs");
    let exact = run(case, &case.settings, ALL_MODES, Noise::none());
    let noisy = with_noise(case, &case.settings, ALL_MODES);
    assert_eq!(found.correlation.passes.len(), exact.passes.len());
    for (row, (pass, exact_pass)) in found
        .correlation
        .passes
        .iter()
        .zip(&exact.passes)
        .enumerate()
    {
        let halvings: Vec<usize> = pass
            .inner
            .iterations
            .iter()
            .map(|iteration| iteration.halvings)
            .collect();
        assert_eq!(
            (pass.inner.stop, halvings),
            (exact_pass.stop, exact_pass.halvings.clone())
        );
        let error_sums: Vec<f64> = pass
            .inner
            .iterations
            .iter()
            .map(|iteration| iteration.errors.sum())
            .collect();
        let modes = &pass.check.pairing.analysis_mode;
        let squares: Vec<f64> = modes
            .iter()
            .map(|&mode| pass.check.modes.omega_squared()[mode])
            .collect();
        let errors = [pass.check.errors.frequency, pass.check.errors.shape];
        let what = format!("Case {}, {:?}", case.number, case.settings.inner.step);
        assert_pass(
            &what,
            [&error_sums, &found.pass_gages[row], &squares, &errors],
            row,
            &exact,
            &noisy,
        );
    }
    (found, exact)
}

/// The decision that would be the first to fall otherwise.
fn nearest(decisions: &[Decision]) -> &Decision {
    decisions
        .iter()
        .min_by(|a, b| a.margin.total_cmp(&b.margin))
        .expect("there are decisions")
}

/// Which decision of each case hangs on least, and on how much.
#[test]
fn the_cases_are_those_of_double_double_and_no_decision_hangs_on_round_off() {
    for (number, (what, margin)) in CASES.into_iter().zip([
        ("pass 1, iteration 12: stop", 0.008_000),
        ("pass 2, iteration 30, halving 0: lower or not", 0.006_898),
        ("pass 3, iteration 30, halving 0: lower or not", 0.006_290),
        ("pass 1, iteration 1, halving 0: lower or not", 0.026_750),
    ]) {
        let (_, exact) = compared(&Case::new(number).expect("a case"));
        let found = nearest(&exact.decisions);
        assert_eq!(found.what, what);
        assert_relative_eq!(found.margin, margin, epsilon = 5e-7);
    }
}

/// A case by the readings that it is not run by.
fn assert_other_readings(number: usize) {
    let case = Case::new(number).expect("a case");
    for reading in READINGS
        .into_iter()
        .filter(|&reading| reading != case.settings.inner.step)
    {
        let case = Case {
            settings: case.settings_by(reading),
            ..case.clone()
        };
        let (_, exact) = compared(&case);
        let decision = nearest(&exact.decisions);
        assert!(
            decision.margin > NEAREST_DECISION,
            "Case {number}, {reading:?}: {decision:?}"
        );
    }
}

#[test]
fn other_readings_of_case_1_are_those_of_double_double_too() {
    assert_other_readings(1);
}

#[test]
fn other_readings_of_case_2_are_those_of_double_double_too() {
    assert_other_readings(2);
}

#[test]
fn other_readings_of_case_3_are_those_of_double_double_too() {
    assert_other_readings(3);
}

#[test]
fn other_readings_of_case_4_are_those_of_double_double_too() {
    assert_other_readings(4);
}

#[test]
fn passes_with_fewer_modes_are_those_of_double_double() {
    let case = Case::new(PUBLISHED_CASE).expect("a case");
    let settings = Settings {
        least_passes: 1,
        most_passes: 1,
        ..case.settings.clone()
    };
    for modes in PUBLISHED_RUNS {
        let found = fewer_modes_run(&case, modes.0, modes.1).expect("it runs");
        let exact = run(&case, &settings, modes, Noise::none());
        let noisy = with_noise(&case, &settings, modes);
        assert_eq!(
            (found.iterations, found.stop),
            (exact.passes[0].error_sums.len(), exact.passes[0].stop)
        );
        let square = |&frequency: &f64| (2.0 * PI * frequency).powi(2);
        let squares: Vec<f64> = found.exact.frequencies_hz[..modes.0]
            .iter()
            .map(square)
            .collect();
        let root = (modes.0 as f64).sqrt();
        let errors = [
            root * found.exact.frequency_rms,
            root * found.exact.shape_rms,
        ];
        let what = format!("{modes:?}");
        assert_pass(
            &what,
            [&found.inner_error_sums, &found.gages_in, &squares, &errors],
            0,
            &exact,
            &noisy,
        );
        let decision = nearest(&exact.decisions);
        assert!(
            decision.margin > NEAREST_DECISION,
            "{modes:?}: {decision:?}"
        );
    }
}

fn exactly(value: Dd) -> BigRational {
    let part = |value: f64| BigRational::from_float(value).expect("a finite number");
    part(value.high) + part(value.low)
}

/// Whether a number is within some units of the last place of an exact one.
fn is_within(found: Dd, exact: BigRational, units: f64) -> bool {
    let allowed = BigRational::from_float(units * DD_EPSILON).expect("a finite number")
        * exactly(found.abs());
    let apart = exactly(found) - exact;
    -allowed.clone() <= apart && apart <= allowed
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn every_operation_is_good_to_a_hundred_bits(numbers in prop::array::uniform4(-1e3..1e3_f64), scale in 1e-17..1e-16_f64) {
        let [a, b] = [[0, 1], [2, 3]].map(|[high, low]| Dd::from(numbers[high]) + Dd::from(scale * numbers[low]));
        prop_assume!(b != Dd::ZERO);
        let (x, y) = (exactly(a), exactly(b));
        // A sum of opposite signs keeps the digits that its terms have.
        let (sum, difference) = (a + b, a - b);
        prop_assert!(is_within(sum, &x + &y, 1.0) && is_within(difference, &x - &y, 1.0));
        prop_assert!(is_within(a * b, &x * &y, 2.0));
        prop_assert!(is_within(a / b, &x / &y, 4.0));
        let root = a.abs().sqrt();
        prop_assert!(is_within(root * root, exactly(a.abs()), 8.0));
        prop_assert_eq!(a < b, x < y);
    }
}

/// Eigenvalues of a matrix whose eigenvalues are known: $2 - 2\cos\frac{j\pi}{10}$ of a chain of nine.
#[test]
fn jacobis_rotations_find_the_modes_of_a_chain() {
    use crate::common::double_double_matrices::{eigen, product, rows, transposed_product};
    let entry = |i: usize, j: usize| Dd::from([2.0, -1.0, 0.0][i.abs_diff(j).min(2)]);
    let chain = rows(9, 9, entry);
    let (values, vectors) = eigen(&chain);
    for (j, value) in values.iter().enumerate() {
        assert_relative_eq!(
            value.to_f64(),
            2.0 - 2.0 * ((j + 1) as f64 * PI / 10.0).cos(),
            max_relative = ROUND_OFF
        );
    }
    let through = transposed_product(&vectors, &product(&chain, &vectors));
    for (i, row) in through.iter().enumerate() {
        for (j, &entry) in row.iter().enumerate() {
            let expected = if i == j { values[i] } else { Dd::ZERO };
            assert!((entry - expected).abs().to_f64() < 1e3 * DD_EPSILON);
        }
    }
}
