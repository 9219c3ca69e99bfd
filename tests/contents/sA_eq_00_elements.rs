//! Elements of every kind: what holds for each wherever it lies.

use crate::common::matrices::rank_of_semidefinite;
use crate::prelude::*;

/// Every way to number four corners round the perimeter.
const ROUND_THE_PERIMETER: [[usize; 4]; 8] = [
    [0, 1, 2, 3],
    [1, 2, 3, 0],
    [2, 3, 0, 1],
    [3, 0, 1, 2],
    [3, 2, 1, 0],
    [2, 1, 0, 3],
    [1, 0, 3, 2],
    [0, 3, 2, 1],
];
/// Every way to number three corners.
const ROUND_THE_TRIANGLE: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
    [1, 0, 2],
    [0, 2, 1],
];

/// The same matrix with the corners' DOF in another order.
fn permuted(stiffness: &DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    let dof = order
        .iter()
        .flat_map(|&corner| 3 * corner..3 * corner + 3)
        .collect_vec();
    stiffness.select_rows(&dof).select_columns(&dof)
}

properties! {
    #[test]
    fn rigid_body_motions_cost_no_force(sample in sample(), shift in point(), spin in point()) {
        let stiffness = sample.stiffness();
        let center = sample.corners[0];
        let motion = |of: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
            DVector::from_iterator(
                3 * sample.corners.len(),
                sample.corners.iter().flat_map(|corner| of(corner).data.0[0]),
            )
        };
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let six: [DVector<f64>; 6] = std::array::from_fn(|k| {
            motion(&|corner| if k < 3 { axes[k] } else { axes[k - 3].cross(&(corner - center)) })
        });
        let any = motion(&|corner| shift + spin.cross(&(corner - center)));
        for rigid in six.iter().chain([&any]) {
            let force = (&stiffness * rigid).amax();
            prop_assert!(
                force <= ELEMENT_ROUND_OFF * stiffness.amax() * rigid.amax(),
                "force {force:e} of a stiffness of {:e}", stiffness.amax()
            );
        }
    }

    #[test]
    fn stiffness_is_symmetric_and_semidefinite_of_its_kinds_rank(sample in sample()) {
        let stiffness = sample.stiffness();
        let dof = 3 * sample.corners.len();
        prop_assert_eq!(stiffness.shape(), (dof, dof));
        prop_assert_eq!(rank_of_semidefinite(&stiffness), sample.rank());
    }

    #[test]
    fn stiffness_turns_with_the_element(sample in sample(), turn in rotation()) {
        let corners = sample.corners.len();
        let mut turns = DMatrix::zeros(3 * corners, 3 * corners);
        for corner in 0..corners {
            turns.fixed_view_mut::<3, 3>(3 * corner, 3 * corner).copy_from(turn.matrix());
        }
        let turned = &turns * sample.stiffness() * turns.transpose();
        let distance = relative_distance(&sample.turned(&turn).stiffness(), &turned);
        prop_assert!(distance <= ELEMENT_ROUND_OFF, "{distance:e}");
    }

    #[test]
    fn renumbering_the_corners_changes_nothing(sample in sample()) {
        let stiffness = sample.stiffness();
        let orders: Vec<&[usize]> = match sample.kind {
            ElementKind::Triangle => ROUND_THE_TRIANGLE.iter().map(|order| &order[..]).collect(),
            ElementKind::Rod => vec![&[1, 0]],
            ElementKind::ShearPanel | ElementKind::Membrane => ROUND_THE_PERIMETER.iter().map(|order| &order[..]).collect(),
        };
        for order in orders {
            let renumbered = sample.renumbered(order).stiffness();
            let distance = relative_distance(&renumbered, &permuted(&stiffness, order));
            prop_assert!(distance <= ELEMENT_ROUND_OFF, "{order:?}: {distance:e}");
        }
    }

    #[test]
    fn similar_panels_are_alike_and_longer_rods_are_softer(
        sample in sample(),
        doublings in -20.0..20.0_f64,
    ) {
        let factor = doublings.exp2();
        let larger = Sample {
            corners: sample.corners.iter().map(|corner| factor * corner).collect(),
            ..sample.clone()
        };
        let rod = sample.kind == ElementKind::Rod;
        let expected = sample.stiffness() / if rod { factor } else { 1.0 };
        let distance = relative_distance(&larger.stiffness(), &expected);
        prop_assert!(distance <= ELEMENT_ROUND_OFF, "{distance:e}");
    }

}

#[test]
fn the_wrong_number_of_corners_is_refused() {
    for kind in [
        ElementKind::Rod,
        ElementKind::Triangle,
        ElementKind::ShearPanel,
        ElementKind::Membrane,
    ] {
        let corners = kind.corner_count();
        for count in (0..6).filter(|&count| count != corners) {
            assert_eq!(
                said(check_corners(7, kind, &vec![Vector3::zeros(); count])),
                format!(
                    "corners of an element: {count} given or asked for; there must be {corners} to {corners}"
                )
            );
        }
    }
}

#[test]
fn a_rod_needs_length_beyond_the_round_off_of_its_ends() {
    let from = Vector3::new(1.0, 0.0, 0.0);
    let along = |length: f64| {
        let ends = [from, from + Vector3::new(length, 0.0, 0.0)];
        check_corners(7, ElementKind::Rod, &ends)
    };
    for length in [0.0, 1.5e-12, -1.5e-12, f64::NAN] {
        let refused = along(length);
        assert!(
            matches!(&refused, Err(Error::Value { what: "relative length", owner, value, .. })
                if owner == "element 7" && (value.is_nan() || *value <= 1e-12)),
            "{length:e}: {refused:?}"
        );
    }
    assert!(along(3e-12).is_ok());
    assert_eq!(
        said(along(0.0)),
        "relative length of element 7 is 0; it must be above 1e-12"
    );
    // Both ends at the origin leave no size either.
    assert_eq!(
        said(check_corners(7, ElementKind::Rod, &[Vector3::zeros(); 2])),
        "relative length of element 7 is NaN; it must be above 1e-12"
    );
}
