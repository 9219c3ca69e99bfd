//! The alternatives to the primary step and update rules, on the torque box: why the primary ones are primary.
//!
//! Statements, not histories: how the alternatives compare on this box, with room for another machine's last digit.
//! First passes of Cases 1, 2 and 3, iterations and error sum reached:
//!
//! | step rule | halvings | Case 1 | Case 2 | Case 3 |
//! |---|---|---|---|---|
//! | root sum of squares | 5 | 14, 2.5 % | 6, 2.4 % | 22, 2.5 % |
//! | root sum of squares | 0 | 14, 2.5 % | 4, 6.2 % | 6, 4.0 % |
//! | sum over modes | 5 | 25, 2.5 % | 12, 2.3 % | 32, 2.5 % |
//! | steepest descent | 0 | 3, 8.6 % | 6, 6.8 % | 4, 8.9 % |

use crate::common::appendix_c::exact;
use crate::common::boxes::{first_problem, problem_of};
use crate::common::tolerances::{ROUND_OFF, SAME_HISTORY, STATED_ERROR_SUM};
use corfem::cases::Case;
use corfem::cases::published::PublishedTable;
use corfem::cases::torque_box::TEST_GAGE;
use corfem::method::appendix_c::{Perturbed, first_order, normalize_with_mass, recursive_1, recursive_2};
use corfem::method::error::Error;
use corfem::method::error_sum::errors;
use corfem::method::inner_loop::{InnerRun, InnerSettings, Stop, run};
use corfem::method::model::{ModalModel, Share};
use corfem::method::modes::ModeSet;
use corfem::method::pairing::pair_modes;
use corfem::method::state::UpdateRule;
use corfem::method::step::StepRule;
use nalgebra::DMatrix;

/// A case's first pass with other rules.
fn first_pass(number: usize, change: impl Fn(&mut InnerSettings)) -> InnerRun {
    let case = Case::new(number).unwrap();
    let ranges = case.model().unwrap().factor_ranges().unwrap();
    let mut settings = case.settings.inner.clone();
    change(&mut settings);
    run(&problem_of(&case), &[1.0; 15], &ranges, &settings).unwrap()
}

/// Root mean square error of all gages where an inner loop ended, relative to the test's.
fn gage_error(number: usize, run: &InnerRun) -> f64 {
    let first = Case::new(number).unwrap().first_gages();
    let squares: f64 =
        run.last.factors.iter().zip(first).map(|(factor, gage)| (factor * gage / TEST_GAGE - 1.0).powi(2)).sum();
    (squares / 15.0).sqrt()
}

#[test]
fn the_primary_rules_reach_the_tolerance() {
    for number in 1..=3 {
        let run = first_pass(number, |_| {});
        assert_eq!(run.stop, Stop::Tolerance);
        assert!(gage_error(number, &run) < 0.15);
    }
}

#[test]
fn a_sum_over_modes_takes_smaller_steps_and_more_iterations() {
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let run = first_pass(number, |settings| settings.step = StepRule::Sum);
        assert_eq!(run.stop, Stop::Tolerance);
        let ratio = run.iterations.len() as f64 / primary.iterations.len() as f64;
        assert!((1.3..2.3).contains(&ratio), "case {number}: {ratio}");
        let longest = |run: &InnerRun| {
            let steps = run.first_unlimited_factors.iter().map(|c| (c - 1.0).abs());
            steps.fold(0.0, f64::max)
        };
        assert!(longest(&run) < longest(&primary));
    }
}

#[test]
fn plain_steepest_descent_stops_far_from_the_test() {
    for number in 1..=3 {
        let run = first_pass(number, |settings| {
            settings.step = StepRule::SteepestDescent;
            settings.halvings = 0;
        });
        assert_eq!(run.stop, Stop::LocalMinimum);
        let (count, gages) = (run.iterations.len(), gage_error(number, &run));
        assert!((3..=6).contains(&count), "{count}");
        assert!(run.last.errors.sum() > 0.06, "{}", run.last.errors.sum());
        // Where the primary rules leave 6, 5 and 13 %.
        assert!(gages > 0.17, "{gages}");
    }
}

#[test]
fn steepest_descent_with_halvings_creeps() {
    // Whether it ever reaches the tolerance hangs on the last digit. That it does not with twice the iterations of the
    // primary rule does not: it stands at 3.5, 3.9 and 2.9 % then.
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let run = first_pass(number, |settings| {
            settings.step = StepRule::SteepestDescent;
            settings.iterations = 2 * primary.iterations.len();
        });
        assert_eq!(run.stop, Stop::Iterations);
        assert!(run.last.errors.sum() > 0.025);
        assert!(gage_error(number, &run) > gage_error(number, &primary));
    }
}

#[test]
fn stopping_at_the_first_rise_stops_early() {
    let at_first_rise = |number| first_pass(number, |settings| settings.halvings = 0);
    // Case 1 never rises; Cases 2 and 3 are left at 6 and 4 %.
    assert_eq!(at_first_rise(1).stop, Stop::Tolerance);
    assert!(first_pass(1, |_| {}).iterations.iter().all(|i| i.halvings == 0));
    for (number, error_sum) in [(2, 0.062), (3, 0.040)] {
        let run = at_first_rise(number);
        assert_eq!(run.stop, Stop::LocalMinimum);
        assert!((run.last.errors.sum() - error_sum).abs() < STATED_ERROR_SUM, "{}", run.last.errors.sum());
        let halved = first_pass(number, |_| {});
        assert!(halved.iterations.iter().any(|i| i.halvings > 0));
    }
}

#[test]
fn the_converged_recursion_makes_the_history_of_the_eigensolution() {
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let exact = first_pass(number, |settings| settings.update = UpdateRule::Eigensolution);
        assert_eq!(primary.iterations.len(), exact.iterations.len());
        for (a, b) in primary.iterations.iter().zip(&exact.iterations) {
            assert_eq!(a.halvings, b.halvings);
            assert!((a.errors.sum() / b.errors.sum() - 1.0).abs() <= SAME_HISTORY);
        }
    }
}

/// β of given factors on a model's parameters.
fn change_by(problem: &ModalModel, factors: &[f64]) -> DMatrix<f64> {
    let of_parameter = |(share, factor): (&Share, &f64)| (factor - 1.0) * share.matrix();
    problem.shares.iter().zip(factors).map(of_parameter).sum()
}

#[test]
fn fixed_orders_come_nearer_to_that_history_as_they_rise() {
    // The factors of the first iteration come from derivatives alone and are the same for every rule; the error sum there
    // is where the rules differ.
    for number in 1..=3 {
        let problem = first_problem(number);
        let run = first_pass(number, |settings| {
            settings.update = UpdateRule::Eigensolution;
            settings.iterations = 1;
        });
        let k = &problem.exact.modes.omega_squared;
        let beta = change_by(&problem, &run.last.factors);
        let distance = |found: Result<Perturbed, Error>| {
            let Perturbed { roots, mut shapes } = found.unwrap();
            normalize_with_mass(&mut shapes, &DMatrix::zeros(k.len(), k.len())).unwrap();
            let pairing = pair_modes(&shapes.tr_mul(&problem.cross)).unwrap();
            let modes = ModeSet { omega_squared: roots.map(f64::recip), shapes: &problem.exact.modes.shapes * shapes };
            let sum = errors(&modes, &pairing, &problem.test).sum();
            (sum - run.last.errors.sum()).abs()
        };
        let first = distance(first_order(k, &beta));
        let second = distance(recursive_1(k, &beta, 2));
        let fourth = distance(recursive_1(k, &beta, 4));
        assert!(fourth < second && second < first, "{first:e} {second:e} {fourth:e}");
        let third = distance(recursive_2(k, &beta, 3));
        assert!(third < second);
        assert!(distance(exact(k, &beta)) < ROUND_OFF);
    }
}

/// Largest error of nine frequencies, in percent, of Recursive 1 at the published total change of a case.
fn largest_frequency_error(case: &Case, problem: &ModalModel, table: usize, order: usize) -> f64 {
    let column = if case.number == 3 { "pass_3_in" } else { "pass_1_in" };
    let table = PublishedTable::number(table).unwrap();
    let factors: Vec<f64> = case
        .panels
        .iter()
        .map(|panel| table.required(&panel.label.to_string(), column).unwrap() / panel.gage)
        .collect();
    let (k, beta) = (&problem.exact.modes.omega_squared, change_by(problem, &factors));
    let exact = exact(k, &beta).unwrap().roots;
    let found = recursive_1(k, &beta, order).unwrap().roots;
    // f is one over the square root of γ.
    let errors = exact.iter().zip(found.iter()).map(|(exact, found)| (exact / found).sqrt() - 1.0);
    100.0 * errors.map(f64::abs).fold(0.0, f64::max)
}

#[test]
fn recursive_1_gains_about_a_digit_an_order_on_the_box() {
    // Percent, to the last digit that an independent program gave for the same changes.
    let orders = [1, 2, 3, 4, 6];
    for (number, table, expected) in [
        (1, 4, ["0.96", "0.043", "0.013", "0.0004", "0.00001"]),
        (2, 6, ["0.085", "0.0013", "0.00009", "0.000003", "0.000000"]),
        (3, 8, ["2.3", "0.094", "0.14", "0.007", "0.0008"]),
    ] {
        let case = Case::new(number).unwrap();
        let problem = problem_of(&case);
        for (order, printed) in orders.into_iter().zip(expected) {
            let digits = printed.len() - 1 - printed.find('.').unwrap();
            let last_digit = 0.1_f64.powi(i32::try_from(digits).unwrap());
            let found = largest_frequency_error(&case, &problem, table, order);
            let expected: f64 = printed.parse().unwrap();
            assert!((found - expected).abs() <= last_digit, "case {number}, order {order}: {found} {printed}");
        }
    }
}
