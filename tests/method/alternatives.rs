//! The named alternatives to the primary step and update rules, on the torque box: why the primary ones are primary.
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
//!
//! Steepest descent with five halvings ends near the tolerance after more than twice the iterations of the primary rule.
//! On which side of the tolerance it ends hangs on the last digit of the shapes, so that no test says it.

use crate::common::boxes::problem_of;
use crate::common::tolerances::{SAME_HISTORY, STATED_ERROR_SUM};
use corfem::cases::Case;
use corfem::cases::published::PublishedTable;
use corfem::cases::torque_box::TEST_GAGE;
use corfem::method::appendix_c::UpdateRule;
use corfem::method::inner_loop::{InnerRun, InnerSettings, Stop, run};
use corfem::method::modal::ModalProblem;
use corfem::method::outer_loop::{Settings, correlate};
use corfem::method::step::StepRule;

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
    let squares: f64 = run
        .last
        .factors
        .iter()
        .zip(first)
        .map(|(factor, gage)| (factor * gage / TEST_GAGE - 1.0).powi(2))
        .sum();
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
        let run = first_pass(number, |settings| settings.step = StepRule::SumOverModes);
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
fn plain_steepest_descent_stalls() {
    for number in 1..=3 {
        let run = first_pass(number, |settings| {
            settings.step = StepRule::SteepestDescent;
            settings.halvings = 0;
        });
        assert_eq!(run.stop, Stop::LocalMinimum);
        assert!(
            (3..=6).contains(&run.iterations.len()),
            "{}",
            run.iterations.len()
        );
        assert!(run.last.errors.sum() > 0.06, "{}", run.last.errors.sum());
        // Where the primary rules leave 6, 5 and 13 %.
        assert!(
            gage_error(number, &run) > 0.17,
            "{}",
            gage_error(number, &run)
        );
    }
}

#[test]
fn steepest_descent_with_halvings_needs_more_than_twice_the_iterations() {
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let run = first_pass(number, |settings| settings.step = StepRule::SteepestDescent);
        assert!(run.iterations.len() > 2 * primary.iterations.len());
        assert!(gage_error(number, &run) > gage_error(number, &primary));
    }
}

#[test]
fn stopping_at_the_first_rise_stops_early() {
    let at_first_rise = |number| first_pass(number, |settings| settings.halvings = 0);
    // Case 1 never rises; Cases 2 and 3 are left at 6 and 4 %.
    assert_eq!(at_first_rise(1).stop, Stop::Tolerance);
    assert!(
        first_pass(1, |_| {})
            .iterations
            .iter()
            .all(|i| i.halvings == 0)
    );
    for (number, error_sum) in [(2, 0.062), (3, 0.040)] {
        let run = at_first_rise(number);
        assert_eq!(run.stop, Stop::LocalMinimum);
        assert!(
            (run.last.errors.sum() - error_sum).abs() < STATED_ERROR_SUM,
            "{}",
            run.last.errors.sum()
        );
        let halved = first_pass(number, |_| {});
        assert!(halved.iterations.iter().any(|i| i.halvings > 0));
    }
}

#[test]
fn the_converged_recursion_makes_the_history_of_the_eigensolution() {
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let exact = first_pass(number, |settings| {
            settings.update = UpdateRule::Eigensolution
        });
        assert_eq!(primary.iterations.len(), exact.iterations.len());
        for (a, b) in primary.iterations.iter().zip(&exact.iterations) {
            assert_eq!(a.halvings, b.halvings);
            assert!((a.errors.sum() / b.errors.sum() - 1.0).abs() <= SAME_HISTORY);
        }
    }
}

#[test]
fn fixed_orders_come_nearer_to_that_history_as_they_rise() {
    // Factors after the first iteration, which every rule computes from the same derivatives, are the same; the error
    // sum there is where the rules differ.
    for number in 1..=3 {
        let exact = first_pass(number, |settings| {
            settings.update = UpdateRule::Eigensolution
        });
        let distance = |update| {
            let run = first_pass(number, |settings| {
                settings.update = update;
                settings.iterations = 1;
            });
            assert_eq!(run.last.factors, exact.iterations[0].factors);
            (run.last.errors.sum() - exact.iterations[0].errors.sum()).abs()
        };
        let first = distance(UpdateRule::FirstOrder);
        let second = distance(UpdateRule::Recursive1 { order: 2 });
        let fourth = distance(UpdateRule::Recursive1 { order: 4 });
        assert!(
            fourth < second && second < first,
            "{first:e} {second:e} {fourth:e}"
        );
        let third = distance(UpdateRule::Recursive2 { order: 3 });
        assert!(third < second);
    }
}

#[test]
fn first_order_modes_mislead_the_inner_loop() {
    // Case 1, first pass: what the inner loop holds for 2.5 % is 9 % when checked, where the primary rule's is 4 %.
    let check = |update| {
        let mut case = Case::new(1).unwrap();
        case.settings.inner.update = update;
        let settings = Settings {
            most_passes: 1,
            ..case.settings.clone()
        };
        let model = case.model().unwrap();
        let test = case.test_modes().unwrap();
        let found = correlate(
            |f| model.analyze(f),
            &test,
            &[None; 15],
            &settings,
            |_, _| {},
        )
        .unwrap();
        let pass = &found.passes[0];
        assert!(pass.inner.last.errors.sum() < 0.025);
        (pass.inner.iterations.len(), pass.check.errors.sum())
    };
    let (primary, first) = (check(UpdateRule::default()), check(UpdateRule::FirstOrder));
    let original = check(UpdateRule::Original);
    assert!(
        first.0 > 2 * primary.0 && first.1 > 2.0 * primary.1,
        "{primary:?} {first:?}"
    );
    // The original formulae lie between the two.
    assert!(
        primary.1 < original.1 && original.1 < first.1,
        "{original:?}"
    );
}

/// Largest error of nine frequencies, in percent, of Recursive 1 at the published total change of a case.
fn largest_frequency_error(case: &Case, problem: &ModalProblem, table: usize, order: usize) -> f64 {
    let column = if case.number == 3 {
        "pass_3_in"
    } else {
        "pass_1_in"
    };
    let table = PublishedTable::number(table).unwrap();
    let factors: Vec<f64> = case
        .panels
        .iter()
        .map(|panel| table.required(&panel.label.to_string(), column).unwrap() / panel.gage)
        .collect();
    let frequencies = |update| {
        let state = problem.state_at(factors.clone(), update).unwrap();
        state.modes.frequencies_hz()
    };
    let exact = frequencies(UpdateRule::Eigensolution);
    let found = frequencies(UpdateRule::Recursive1 { order });
    let errors = found.iter().zip(exact).map(|(a, b)| (a / b - 1.0).abs());
    100.0 * errors.fold(0.0, f64::max)
}

#[test]
fn recursive_1_gains_about_a_digit_an_order_on_the_box() {
    // Percent, to the last digit that an independent program gave for the same changes.
    for (number, table, expected) in [
        (
            1,
            4,
            [
                (1, "0.96"),
                (2, "0.043"),
                (3, "0.013"),
                (4, "0.0004"),
                (6, "0.00001"),
            ],
        ),
        (
            2,
            6,
            [
                (1, "0.085"),
                (2, "0.0013"),
                (3, "0.00009"),
                (4, "0.000003"),
                (6, "0.000000"),
            ],
        ),
        (
            3,
            8,
            [
                (1, "2.3"),
                (2, "0.094"),
                (3, "0.14"),
                (4, "0.007"),
                (6, "0.0008"),
            ],
        ),
    ] {
        let case = Case::new(number).unwrap();
        let problem = problem_of(&case);
        for (order, printed) in expected {
            let digits = printed.len() - 1 - printed.find('.').unwrap();
            let last_digit = 0.1_f64.powi(i32::try_from(digits).unwrap());
            let found = largest_frequency_error(&case, &problem, table, order);
            let expected: f64 = printed.parse().unwrap();
            assert!(
                (found - expected).abs() <= last_digit,
                "case {number}, order {order}: {found} {printed}"
            );
        }
    }
}
