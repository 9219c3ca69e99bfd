//! What the paper says in words beside its tables, on this box.

use crate::prelude::*;

/// Percent of each mode's strain energy that rods have in the tested structure of Case 1.
fn rod_parts() -> Vec<f64> {
    let mut case = case_of(1);
    case.panels
        .iter_mut()
        .for_each(|panel| panel.gage = TEST_GAGE);
    let model = with_every_element(&case);
    let shares = model.matrices(&[1.0; 39]).unwrap().shares;
    let panels: DMatrix<f64> = shares[..PANEL_COUNT].iter().sum();
    let modes = case.test_modes().unwrap();
    let energy = modes.shapes().tr_mul(&(panels * modes.shapes()));
    let part = |mode: usize| 100.0 * (1.0 - energy[(mode, mode)] / modes.omega_squared()[mode]);
    (0..9).map(part).collect()
}

/// Modes 1, 6, 8 and 9, of which the paper says so: 74 to 91 % on this box, and less than half of every other's. The box was fitted to
/// frequencies, not to this.
#[test]
fn rods_govern_modes_1_6_8_and_9() {
    let parts = rod_parts().into_iter().map(|part| format!("{part:.0}"));
    assert_eq!(parts.collect_vec().join(" "), "81 29 39 17 29 91 18 85 74");
}

/// Node lines of the test and the first model differ little "except for mode 8", says the paper; on this box it is mode 6.
#[test]
fn the_shape_that_differs_is_that_of_mode_6() {
    let modal = first_problem(1);
    let state = modal.exact();
    let each = mode_errors(&state.modes, &state.pairing, modal.test()).unwrap();
    let worst = each[5].shape;
    assert!(each.iter().all(|own| own.shape <= worst));
    let rms = state.errors.shape_rms();
    let found =
        [worst, rms, (worst / rms).powi(2) / 9.0].map(|part| format!("{:.1}", 100.0 * part));
    assert_eq!(found, ["20.6", "7.6", "82.1"]);
}

/// Section 5's wing has 1,326 structural and 108 dynamic degrees of freedom, 25 substructures and ten modes. That of the benches has as many
/// points and groups, and 132 degrees of freedom more.
#[test]
fn the_wing_of_the_benches_is_as_large_as_the_papers() {
    let model = Wing::default().model().unwrap();
    let found = [
        model.structure().free_dof().len() - 1326,
        model.load_distribution().ncols(),
        model.parameters().len(),
    ];
    assert_eq!(found, [132, 108, 25]);
}
