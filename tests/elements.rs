//! Elements of every kind: what holds for each wherever it lies, and what no element may be made of.

use crate::common::matrices::{rank_of_semidefinite, relative_distance};
use crate::common::panels::{Kind, Sample, flat_panel, panel_sample, placed, sample};
use crate::common::strategies::{point, rotation};
use crate::common::tolerances::ELEMENT_ROUND_OFF;
use corfem::elements::panel::mean_plane;
use corfem::elements::{rod::rod, triangle::triangle, unit_stiffness};
use corfem::error::Error;
use corfem::structure::{ElementKind, Material};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use proptest::prelude::*;

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
const ROUND_THE_TRIANGLE: [[usize; 3]; 6] =
    [[0, 1, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0], [1, 0, 2], [0, 2, 1]];

/// The same matrix with the corners' DOF in another order.
fn permuted(stiffness: &DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    let dof: Vec<usize> = order
        .iter()
        .flat_map(|&corner| 3 * corner..3 * corner + 3)
        .collect();
    stiffness.select_rows(&dof).select_columns(&dof)
}

fn steel() -> Material {
    Material::isotropic(3e7, 0.3).unwrap()
}

proptest! {
    #![proptest_config(crate::common::config())]

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
            Kind::Triangle => ROUND_THE_TRIANGLE.iter().map(|order| &order[..]).collect(),
            Kind::Element(ElementKind::Rod) => vec![&[1, 0]],
            Kind::Element(_) => ROUND_THE_PERIMETER.iter().map(|order| &order[..]).collect(),
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
        let rod = sample.kind == Kind::Element(ElementKind::Rod);
        let expected = sample.stiffness() / if rod { factor } else { 1.0 };
        let distance = relative_distance(&larger.stiffness(), &expected);
        prop_assert!(distance <= ELEMENT_ROUND_OFF, "{distance:e}");
    }

    #[test]
    fn a_concave_panel_is_refused_by_the_name_of_its_corner(
        corners in flat_panel(),
        reach in 0.0..0.9_f64,
        corner in 0..4_usize,
        shear in prop::bool::ANY,
        turn in rotation(),
        origin in point(),
    ) {
        let mut corners = corners;
        // The diagonals cross at the origin: beyond it the corner caves in.
        corners[corner] = reach * corners[(corner + 2) % 4];
        let corners = corners.map(|corner| origin + turn * corner);
        let kind = if shear { ElementKind::ShearPanel } else { ElementKind::Membrane };
        let refused = unit_stiffness(kind, &corners, &steel());
        let named = matches!(refused, Err(Error::NotConvex { corner: named }) if named == corner + 1);
        prop_assert!(named, "{refused:?}");
    }

    #[test]
    fn the_mean_plane_keeps_what_is_flat(corners in placed(flat_panel())) {
        let plane = mean_plane(&corners).unwrap();
        let size = (corners[2] - corners[0]).norm();
        for a in 0..4 {
            for b in 0..4 {
                let (flat, true_distance) = (
                    (plane.corners[a] - plane.corners[b]).norm(),
                    (corners[a] - corners[b]).norm(),
                );
                prop_assert!((flat - true_distance).abs() <= ELEMENT_ROUND_OFF * size);
            }
        }
        prop_assert_eq!(plane.diagonals, [corners[2] - corners[0], corners[3] - corners[1]]);
        let shoelace: f64 = (0..4).map(|k| plane.corners[k].perp(&plane.corners[(k + 1) % 4])).sum();
        prop_assert!((plane.area - 0.5 * shoelace).abs() <= ELEMENT_ROUND_OFF * size * size);
        prop_assert_eq!(plane.corners[0].amax(), 0.0);
        prop_assert!(plane.corners[1].x > 0.0 && plane.corners[1].y.abs() <= ELEMENT_ROUND_OFF * size);
    }

    #[test]
    fn the_mean_plane_is_parallel_to_both_diagonals(sample in panel_sample()) {
        let corners: [Vector3<f64>; 4] = std::array::from_fn(|k| sample.corners[k]);
        let plane = mean_plane(&corners).unwrap();
        for (k, diagonal) in plane.diagonals.iter().enumerate() {
            let flat = (plane.corners[k + 2] - plane.corners[k]).norm();
            prop_assert!((flat - diagonal.norm()).abs() <= ELEMENT_ROUND_OFF * diagonal.norm());
        }
        let across = plane.diagonals[0].dot(&plane.diagonals[1]);
        let flat_across = (plane.corners[2] - plane.corners[0]).dot(&(plane.corners[3] - plane.corners[1]));
        prop_assert!((across - flat_across).abs() <= ELEMENT_ROUND_OFF * plane.diagonals[0].norm_squared());
    }
}

#[test]
fn the_wrong_number_of_corners_is_refused() {
    for kind in [ElementKind::Rod, ElementKind::ShearPanel, ElementKind::Membrane] {
        for count in (0..6).filter(|&count| count != kind.corner_count()) {
            let refused = unit_stiffness(kind, &vec![Vector3::zeros(); count], &steel());
            assert!(
                matches!(refused, Err(Error::WrongCornerCount { expected, found })
                    if expected == kind.corner_count() && found == count),
                "{kind:?} of {count}: {refused:?}"
            );
        }
    }
}

#[test]
fn a_rod_needs_length_beyond_the_round_off_of_its_ends() {
    let from = Vector3::new(1.0, 0.0, 0.0);
    let along = |length: f64| rod([from, from + Vector3::new(length, 0.0, 0.0)], 1e7);
    for length in [0.0, 1.5e-12, -1.5e-12, f64::NAN] {
        let refused = along(length);
        assert!(
            matches!(refused, Err(Error::ZeroLength { length: found }) if found.is_nan() || found <= 2e-12),
            "{length:e}: {refused:?}"
        );
    }
    assert!(along(3e-12).is_ok());
    assert!(matches!(rod([Vector3::zeros(); 2], 1e7), Err(Error::ZeroLength { length: 0.0 })));
}

#[test]
fn a_panel_needs_area() {
    let kite = |width: f64| {
        [(-1.0, 0.0), (0.0, -width), (1.0, 0.0), (0.0, width)].map(|(x, y)| Vector3::new(x, y, 0.0))
    };
    for start in 0..4 {
        let numbered = |width: f64| {
            let corners = kite(width);
            mean_plane(&std::array::from_fn(|k| corners[(k + start) % 4]))
        };
        // Area 2·width over the square of the long diagonal, 4.
        for width in [0.0, 1.5e-10] {
            let refused = numbered(width);
            assert!(
                matches!(refused, Err(Error::ZeroArea { area }) if (area - width / 2.0).abs() < 1e-12),
                "{refused:?}"
            );
        }
        assert!(numbered(3e-10).is_ok());
    }
    let nowhere = [Vector3::zeros(); 4];
    assert!(matches!(mean_plane(&nowhere), Err(Error::ZeroArea { area: 0.0 })));
    let mut lost = kite(1.0);
    lost[3].y = f64::NAN;
    assert!(matches!(mean_plane(&lost), Err(Error::ZeroArea { area: 0.0 })));
}

#[test]
fn a_corner_is_straight_within_one_part_in_ten_to_the_tenth() {
    let bent = |height: f64| {
        mean_plane(&[(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, height)].map(|(x, y)| Vector3::new(x, y, 0.0)))
    };
    assert!(matches!(bent(0.7e-10), Err(Error::NotConvex { corner: 4 })));
    assert!(bent(1.5e-10).is_ok());
    let repeated = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    assert!(matches!(mean_plane(&repeated), Err(Error::NotConvex { corner: 2 })));
}

#[test]
fn a_triangle_needs_area() {
    let corners = |height: f64| [(0.0, 0.0), (1.0, 0.0), (0.5, height)].map(|(x, y)| Vector3::new(x, y, 0.0));
    for order in ROUND_THE_TRIANGLE {
        let numbered = |height: f64| triangle(order.map(|k| corners(height)[k]), &steel());
        for height in [0.0, 1.5e-10] {
            let refused = numbered(height);
            assert!(
                matches!(refused, Err(Error::ZeroArea { area }) if (area - height / 2.0).abs() < 1e-12),
                "{refused:?}"
            );
        }
        assert!(numbered(3e-10).is_ok());
        assert!(matches!(numbered(f64::NAN), Err(Error::ZeroArea { area: 0.0 })));
    }
}

#[test]
fn a_plane_frame_of_reference_is_right_handed() {
    // The reversed square is seen from the other side, so that its corners still run counterclockwise.
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vector3::new(x, y, 5.0));
    let [a, b, c, d] = square;
    for corners in [[a, b, c, d], [a, d, c, b]] {
        let plane = mean_plane(&corners).unwrap();
        let found = Matrix3::from_columns(&[
            plane.corners[1].push(0.0),
            plane.corners[2].push(0.0),
            plane.corners[3].push(1.0),
        ]);
        let (first, second) = ((corners[1] - a).norm(), (corners[3] - a).norm());
        let expected = Matrix3::new(first, first, 0.0, 0.0, second, second, 0.0, 0.0, 1.0);
        assert_eq!(found, expected);
        assert_eq!(plane.area, 2.0);
    }
}
