//! The alternatives to the loop's recursion and to its halvings, on the torque box by the library's own reading of the step.

use crate::prelude::*;

/// A case's first pass with other rules and any analysis of it.
fn first_pass_of(
    number: usize,
    analysis: &dyn Analysis,
    change: impl Fn(&mut InnerSettings),
) -> InnerRun {
    let case = case_of(number);
    let ranges = case.model().unwrap().factor_ranges().unwrap();
    let mut settings = case.settings.inner.clone();
    settings.step = StepRule::Matrix;
    change(&mut settings);
    run(analysis, &[1.0; 15], &ranges, &settings).unwrap()
}

/// The same with the paper's analysis.
fn first_pass(number: usize, change: impl Fn(&mut InnerSettings)) -> InnerRun {
    first_pass_of(number, &first_problem(number), change)
}

#[test]
fn stopping_at_the_first_rise_stops_early() {
    // By own Cases 2 and 3 are left at 11.5 and 6.5 %, by matrix Case 2 at 3.2 %, where halvings reach the 2.5 % asked for.
    for (number, step, error_sum) in [
        (2, StepRule::Own, 0.115),
        (3, StepRule::Own, 0.065),
        (2, StepRule::Matrix, 0.032),
    ] {
        let run = first_pass(number, |settings| {
            (settings.step, settings.halvings) = (step, 0)
        });
        assert_eq!(run.stop, Stop::LocalMinimum);
        assert_within(run.last.errors.sum(), error_sum, STATED_ERROR_SUM);
        let halved = first_pass(number, |settings| settings.step = step);
        assert_eq!(halved.stop, Stop::Tolerance);
        assert!(halved.iterations.iter().any(|i| i.halvings > 0));
    }
}

#[test]
fn the_converged_recursion_makes_the_history_of_the_eigensolution() {
    for number in 1..=3 {
        let primary = first_pass(number, |_| {});
        let exact = first_pass_of(number, &Eigensolved(first_problem(number)), |_| {});
        assert_eq!(primary.iterations.len(), exact.iterations.len());
        for (a, b) in primary.iterations.iter().zip(&exact.iterations) {
            assert_eq!(a.halvings, b.halvings);
            assert!(relative_error(a.errors.sum(), b.errors.sum()) <= SAME_HISTORY);
        }
    }
}
