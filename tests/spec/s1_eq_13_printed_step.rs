//! (13) as printed: the change of a factor, not the factor.

use crate::common::boxes::first_problem;
use corfem::method::analysis::Analysis;
use corfem::method::step::{StepRule, unlimited_factor};

#[test]
fn printed_step_is_the_change_of_the_factor_not_the_factor() {
    // (13) prints c = R e_S Δe/Δk. On Case 2, 50 % too stiff throughout, that factor is near zero, below its own bound,
    // for every element; one minus it is a factor.
    let problem = first_problem(2);
    let state = problem.exact();
    let errors = problem.error_changes(state).expect("separate modes");
    let stiffness = problem.stiffness_changes(state, &[1.0; 15], StepRule::Own);
    let error_sum = state.errors.sum();
    let factors: Vec<f64> = errors
        .iter()
        .zip(stiffness)
        .map(|(&error, stiffness)| unlimited_factor(error, stiffness, error_sum, 0.8))
        .collect();
    let e_s_after = |factors: &[f64]| {
        let state = problem.at(factors);
        state.map_or(f64::INFINITY, |state| state.errors.sum())
    };
    assert!(e_s_after(&factors) < error_sum);
    let printed: Vec<f64> = factors.iter().map(|factor| 1.0 - factor).collect();
    assert!(printed.iter().all(|&factor| factor < 0.55), "{printed:?}");
    assert!(e_s_after(&printed) > error_sum);
}
