//! What condensation to the measured DOF costs where all of them are measured.

use crate::prelude::*;

properties! {
    #[test]
    fn where_every_joint_is_measured_condensation_costs_nothing(stories in prop::collection::vec(0.5..2.0_f64, 10)) {
        let model = shear_building(&stories, 1.0, None);
        let sensors = sensors_at(&(0..10).collect_vec(), 10);
        let (condensed, mass) = condensed(&model, &[1.0; 10], &sensors)?;
        let condensed = solve(&condensed.stiffness, &mass, 10)?;
        let whole = model.modes(&[1.0; 10], 10)?.vibrations;
        assert_alike(condensed.frequencies_hz(), whole.frequencies_hz(), MATRIX_ROUND_OFF);
        let assurance = modal_assurance(whole.shapes(), condensed.shapes())?;
        prop_assert!(assurance.diagonal().min() > 1.0 - MATRIX_ROUND_OFF);
    }
}
