//! (13) as printed: the change of a factor, not the factor.

use crate::common::boxes::first_problem;
use corfem::method::derivatives::by_definition;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{StepRule, stiffness_changes, unlimited_factors};

#[test]
fn printed_step_is_the_change_of_the_factor_not_the_factor() {
    // (13) prints c = R e_S Δe/Δk. On Case 2, 50 % too stiff throughout, that factor is near zero, below its own bound,
    // for every element; one minus it is a factor.
    let problem = first_problem(2);
    let state = ModalState::start(&problem);
    let errors = by_definition(&problem, &state).expect("separate modes");
    let stiffness = stiffness_changes(&problem, &[1.0; 15], &[1.0; 15], StepRule::Diagonal);
    let error_sum = state.errors().sum();
    let factors = unlimited_factors(&errors, &stiffness, error_sum, 0.8);
    let e_s_after = |factors: Vec<f64>| {
        let state = ModalState::at(&problem, factors, UpdateRule::default());
        state.map_or(f64::INFINITY, |state| state.errors().sum())
    };
    assert!(e_s_after(factors.clone()) < error_sum);
    let printed: Vec<f64> = factors.iter().map(|factor| 1.0 - factor).collect();
    assert!(printed.iter().all(|&factor| factor < 0.55), "{printed:?}");
    assert!(e_s_after(printed) > error_sum);
}
