//! Full eigensolutions by perturbation and by re-analysis, counted.

use crate::evidence::eigensolutions::{Counted, counted};
use crate::prelude::*;

fn case(number: usize, error: f64) -> Counted {
    let settings = case_of(number).settings;
    counted(
        &Known::of_case(number).unwrap(),
        None,
        (&settings, |model| model),
        error,
    )
    .unwrap()
}

#[test]
fn analyses_are_the_passes_and_the_start() {
    let run = case_run(&case_of(1));
    assert!(run.correlation.converged);
    let found = case(1, 0.025);
    assert_eq!(
        found.reanalysis.analyses,
        found.reanalysis.steps + 1,
        "a step, an analysis"
    );
    assert!(found.perturbation.reached && found.reanalysis.reached);
    assert_eq!(
        (found.name.as_str(), found.parameters, found.error),
        ("Case 1", 15, 0.025)
    );
    assert!(found.perturbation.analyses <= run.correlation.passes.len() + 1);
}

#[test]
fn perturbation_takes_a_third_of_the_eigensolutions_of_reanalysis_and_less_for_less_error() {
    let mut before = None;
    for error in [0.05, 0.025] {
        for number in 1..=3 {
            let Counted {
                perturbation,
                reanalysis,
                ..
            } = case(number, error);
            assert!(perturbation.reached && reanalysis.reached, "case {number}");
            assert!(
                2 * perturbation.analyses < reanalysis.analyses,
                "case {number}: {perturbation:?} {reanalysis:?}"
            );
        }
        let last = case(3, error).reanalysis.analyses;
        assert!(before.replace(last).is_none_or(|before| before < last));
    }
}

#[test]
fn a_small_wing_is_planted_and_found() {
    let wing = Wing {
        bays: [9, 3, 1],
        measured: [9, 3],
        zones: 3,
        ..Wing::default()
    };
    let known = planted(&wing).unwrap();
    assert_eq!((known.truth.len(), known.test.len()), (15, 10));
    let at_truth = known
        .model
        .analyze(&known.truth, &known.test, Some(10))
        .unwrap();
    assert!(at_truth.exact().errors.sum() < ROUND_OFF_FLOOR);
    let start = known
        .model
        .analyze(&[1.0; 15], &known.test, Some(10))
        .unwrap();
    assert!(start.exact().errors.sum() > 0.1);
}
