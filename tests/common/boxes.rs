//! The torque box as the loops see it, and boxes like it with other gages.

use corfem::method::model::ModalModel;
use corfem::torque_box::Case;
use corfem::torque_box::wing_box::PANEL_COUNT;
use proptest::prelude::*;

/// The problem of a case's first pass: its first gages, its test modes, all nine analysis modes.
pub fn first_problem(number: usize) -> ModalModel {
    let case = Case::new(number).expect("a case of the paper");
    problem_of(&case)
}

/// The same for a case with other gages or settings.
pub fn problem_of(case: &Case) -> ModalModel {
    let model = case.model().expect("a model");
    let test = case.test_modes().expect("test modes");
    model
        .analyze(&[1.0; PANEL_COUNT], &test, None)
        .expect("a problem")
}

/// Case 2's box, of membranes and shear panels, with first gages of 0.008 to 0.013 in: up to 30 % off the test's
/// 0.010 in, as Case 3's are.
pub fn uneven_box() -> impl Strategy<Value = Case> {
    prop::collection::vec(0.008..0.013_f64, PANEL_COUNT).prop_map(|gages| {
        let mut case = Case::new(2).expect("a case of the paper");
        for (panel, gage) in case.panels.iter_mut().zip(gages) {
            panel.gage = gage;
        }
        case
    })
}
