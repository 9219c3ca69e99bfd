//! The whole method in one file, `paper/plain.rs`, beside the crate: two programs and one answer.

#[path = "../../paper/plain.rs"]
mod program;

use crate::prelude::*;

fn assert_same(what: &str, model: &FiniteElementModel, case: &Case, modes: (usize, usize)) {
    let test = case
        .test_modes()
        .and_then(|all| Ok(all.lowest(modes.0)?))
        .unwrap();
    let analyze = |factors: &[f64]| model.analyze(factors, &test, Some(modes.1));
    let ranges = model.factor_ranges().unwrap();
    let expected = correlate(analyze, &ranges, &case.settings, |_, _| true).unwrap();
    let mut problem = program::torque_box(case);
    problem.test = program::Modes {
        omega_squared: test.omega_squared().clone(),
        shapes: test.shapes().clone(),
    };
    let found = problem.correlate(modes.1).unwrap();
    assert_eq!(found.len(), expected.passes.len(), "{what}");
    for ((pass, gages, errors), expected) in found.iter().zip(&expected.passes) {
        let inner = &expected.inner;
        assert_eq!(pass.error_sums.len(), inner.iterations.len(), "{what}");
        for (found, expected) in pass.error_sums.iter().zip(&inner.iterations) {
            let apart = (found - expected.errors.sum()).abs();
            assert!(apart <= SAME_ON_THE_WAY, "{what}: {apart:e}");
        }
        for (found, expected) in pass
            .unlimited
            .iter()
            .zip(&inner.iterations[0].unlimited_factors)
        {
            // A change of one: a factor itself may be anything, zero too.
            let apart = (found - expected).abs() / (expected - 1.0).abs().max(1.0);
            assert!(apart <= SAME_ON_THE_WAY, "{what}: {apart:e}");
        }
        let sizes = model.sizes(&expected.factors).unwrap();
        for (found, expected) in gages.iter().zip(sizes) {
            let apart = relative_error(found, expected);
            assert!(apart <= SAME_CORRELATION, "{what}: {apart:e}");
        }
        let apart = (errors.sum() - expected.check.errors.sum()).abs();
        assert!(apart <= SAME_CORRELATION, "{what}: {apart:e}");
    }
}

#[test]
fn the_plain_program_corrects_every_case_by_every_reading_as_the_crate_does() {
    for number in CASES {
        for rule in StepRule::ALL {
            let mut case = case_of(number);
            case.settings = case.settings_by(rule);
            let model = case.model().unwrap();
            assert_same(
                &format!("case {number} by {}", rule.name()),
                &model,
                &case,
                (9, 9),
            );
        }
    }
}

#[test]
fn the_plain_program_corrects_with_fewer_modes_as_the_crate_does() {
    let mut case = case_of(PUBLISHED_CASE);
    case.settings.most_passes = 1;
    let model = case.model().unwrap();
    for (test, analysis) in PUBLISHED_RUNS {
        assert_same(
            &format!("{test} of {analysis} modes"),
            &model,
            &case,
            (test, analysis),
        );
    }
}
