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
        assert!(
            (run.last.errors.sum() - error_sum).abs() < STATED_ERROR_SUM,
            "{}",
            run.last.errors.sum()
        );
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

/// β of given factors on a model's parameters.
fn change_by(problem: &Model, factors: &[f64]) -> DMatrix<f64> {
    let of_parameter = |(share, factor): (&DMatrix<f64>, &f64)| (factor - 1.0) * share;
    problem.shares().iter().zip(factors).map(of_parameter).sum()
}

#[test]
fn fixed_orders_come_nearer_to_that_history_as_they_rise() {
    // The factors of the first iteration come from derivatives alone and are the same for every order; the error sum there
    // is where they differ.
    for number in 1..=3 {
        let problem = first_problem(number);
        let exactly = Eigensolved(problem.clone());
        let run = first_pass_of(number, &exactly, |settings| settings.iterations = 1);
        let k = problem.exact().modes.omega_squared();
        let beta = change_by(&problem, &run.last.factors);
        let distance = |found: Result<Perturbed, Error>| {
            let Perturbed { roots, mut shapes } = found.unwrap();
            normalize_with_mass(&mut shapes, &zero_square(k.len())).unwrap();
            let pairing = pair_modes(&shapes.tr_mul(problem.cross())).unwrap();
            let modes = Modes::new(
                roots.map(f64::recip),
                problem.exact().modes.shapes() * shapes,
            )
            .unwrap();
            let sum = errors(&modes, &pairing, problem.test()).unwrap().sum();
            (sum - run.last.errors.sum()).abs()
        };
        let first = distance(first_order(k, &beta));
        let second = distance(recursive_1(k, &beta, 2));
        let fourth = distance(recursive_1(k, &beta, 4));
        assert!(
            fourth < second && second < first,
            "{first:e} {second:e} {fourth:e}"
        );
        let third = distance(recursive_2(k, &beta, 3));
        assert!(third < second);
        assert!(distance(exact(k, &beta)) < ROUND_OFF);
    }
}

/// Largest error of nine frequencies, in percent, of Recursive 1 at the published total change of a case.
fn largest_frequency_error(case: &Case, problem: &Model, table: usize, order: usize) -> f64 {
    let column = if case.number == 3 {
        "pass_3_in"
    } else {
        "pass_1_in"
    };
    let table = PublishedTable::number(table).unwrap();
    let factors = case
        .panels
        .iter()
        .map(|panel| table.required(&panel.label.to_string(), column).unwrap() / panel.gage)
        .collect_vec();
    let (k, beta) = (
        problem.exact().modes.omega_squared(),
        change_by(problem, &factors),
    );
    let exact = exact(k, &beta).unwrap().roots;
    let found = recursive_1(k, &beta, order).unwrap().roots;
    // f is one over the square root of γ.
    let errors = exact
        .iter()
        .zip(found.iter())
        .map(|(exact, found)| (exact / found).sqrt() - 1.0);
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
        let case = case_of(number);
        let problem = problem_of(&case);
        for (order, printed) in orders.into_iter().zip(expected) {
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
