//! Rigid-body vectors: what each motion shows at a measuring point.

use crate::prelude::*;
use nalgebra::Unit;

fn dof(position: [f64; 3], direction: Unit<Vector3<f64>>) -> MeasuringPoint {
    MeasuringPoint {
        position: Vector3::from(position),
        direction,
    }
}

#[test]
fn motions_displace_a_point_as_named() {
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    let dofs = axes.map(|axis| dof([2.0, 3.0, 5.0], axis));
    // A column for each motion.
    let expected = dmatrix![
        1.0, 0.0, 0.0, 0.0, -5.0, -3.0;
        0.0, 1.0, 0.0, -5.0, 0.0, 2.0;
        0.0, 0.0, 1.0, 3.0, 2.0, 0.0
    ];
    assert_eq!(rigid_body_vectors(&dofs), expected);
}

#[test]
fn vertical_dof_see_one_and_x_in_symmetric_motion() {
    let dofs = [
        dof([-7.0, 1.0, 2.0], Vector3::z_axis()),
        dof([4.0, 3.0, -2.0], Vector3::z_axis()),
    ];
    assert_eq!(
        rigid_body_vectors(&dofs).select_columns(&SYMMETRIC),
        dmatrix![1.0, -7.0; 1.0, 4.0]
    );
}

#[test]
fn lateral_dof_see_side_roll_and_yaw_in_antisymmetric_motion() {
    let dofs = [
        dof([2.0, 3.0, 5.0], Vector3::x_axis()),
        dof([2.0, 3.0, 5.0], Vector3::y_axis()),
        dof([2.0, 3.0, 5.0], Vector3::z_axis()),
    ];
    assert_eq!(
        rigid_body_vectors(&dofs).select_columns(&ANTISYMMETRIC),
        dmatrix![0.0, 0.0, -3.0; 1.0, -5.0, 2.0; 0.0, 3.0, 0.0]
    );
}

#[test]
fn an_oblique_dof_sees_its_component() {
    let oblique = dof(
        [2.0, 3.0, 5.0],
        Unit::new_normalize(Vector3::new(0.0, 3.0, 4.0)),
    );
    let found = rigid_body_vectors(&[oblique]);
    // 3/5 of −5 and 4/5 of 3.
    assert_eq!(found.shape(), (1, 6));
    assert_relative_eq!(found[3], -0.6, max_relative = MATRIX_ROUND_OFF);
}

#[test]
fn balancing_refuses_no_motions_no_dof_and_no_position() {
    let here = [dof([0.0; 3], Vector3::z_axis())];
    let lost = [dof([f64::NAN, 0.0, 0.0], Vector3::z_axis())];
    let raw = modes(&[1.0], eye(1));
    for (motions, dofs, words) in [
        (
            &[][..],
            &here[..],
            "rigid-body stiffness: 0 given or asked for; there must be at least 1",
        ),
        (
            &SYMMETRIC[..1],
            &[],
            "rigid-body vectors: 0 x 1 instead of 1 x 1",
        ),
        (
            &SYMMETRIC[1..],
            &lost,
            "rigid-body vectors of entry (0, 0) is NaN; it must be a finite number",
        ),
    ] {
        let vectors = rigid_body_vectors(dofs).select_columns(motions);
        assert_eq!(
            said(balance(&raw, &zero_square(1), &eye(1), &vectors)),
            words
        );
    }
}

properties! {
    /// A structure without supports resists none of the six: the vectors agree with the rod's own geometry.
    #[test]
    fn rigid_body_motions_meet_no_force(truss in free_truss()) {
        let vectors = rigid_body_vectors(&truss.dofs);
        prop_assert_eq!(vectors.shape(), (15, 6));
        let forces = &truss.stiffness * &vectors;
        for motion in 0..6 {
            let scale = truss.stiffness.amax() * vectors.column(motion).amax();
            prop_assert!(forces.column(motion).amax() <= MATRIX_ROUND_OFF * scale);
        }
        prop_assert_eq!(vectors.rank(RIGID_BODY_RANK), 6);
    }
}
