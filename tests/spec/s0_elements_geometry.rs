//! The geometry of panels and triangles: the mean plane, and the shapes that are refused.

use crate::common::panels::{flat_panel, panel_sample, placed};
use crate::common::strategies::{point, rotation};
use crate::common::tolerances::{ELEMENT_ROUND_OFF, ROUND_OFF};
use corfem::method::error::Error;
use corfem::method::geometry::{Geometry, mean_plane};
use corfem::method::structure::ElementKind;
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

properties! {
    #![proptest_config(crate::common::config())]

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
        let refused = Geometry::new(kind, &corners);
        let named = matches!(refused, Err(Error::NotConvex(named)) if named == corner + 1);
        prop_assert!(named, "{refused:?}");
    }

    #[test]
    fn the_mean_plane_keeps_what_is_flat(corners in placed(flat_panel())) {
        let plane = mean_plane(&corners).unwrap();
        let size = (corners[2] - corners[0]).norm();
        for a in 0..4 {
            for b in 0..4 {
                let (flat, true_distance) = (
                    (plane.corners()[a] - plane.corners()[b]).norm(),
                    (corners[a] - corners[b]).norm(),
                );
                prop_assert!((flat - true_distance).abs() <= ELEMENT_ROUND_OFF * size);
            }
        }
        prop_assert_eq!(plane.diagonals(), [corners[2] - corners[0], corners[3] - corners[1]]);
        let shoelace: f64 = (0..4).map(|k| plane.corners()[k].perp(&plane.corners()[(k + 1) % 4])).sum();
        prop_assert!((plane.area() - 0.5 * shoelace).abs() <= ELEMENT_ROUND_OFF * size * size);
        prop_assert_eq!(plane.corners()[0].amax(), 0.0);
        prop_assert!(plane.corners()[1].x > 0.0 && plane.corners()[1].y.abs() <= ELEMENT_ROUND_OFF * size);
    }

    #[test]
    fn the_mean_plane_is_parallel_to_both_diagonals(sample in panel_sample()) {
        let corners: [Vector3<f64>; 4] = std::array::from_fn(|k| sample.corners[k]);
        let plane = mean_plane(&corners).unwrap();
        for (k, diagonal) in plane.diagonals().iter().enumerate() {
            let flat = (plane.corners()[k + 2] - plane.corners()[k]).norm();
            prop_assert!((flat - diagonal.norm()).abs() <= ELEMENT_ROUND_OFF * diagonal.norm());
        }
        let across = plane.diagonals()[0].dot(&plane.diagonals()[1]);
        let flat_across = (plane.corners()[2] - plane.corners()[0]).dot(&(plane.corners()[3] - plane.corners()[1]));
        prop_assert!((across - flat_across).abs() <= ELEMENT_ROUND_OFF * plane.diagonals()[0].norm_squared());
    }
}

#[test]
fn a_panel_needs_area() {
    let kite = |width: f64| {
        [(-3.0, 0.0), (0.0, -width), (3.0, 0.0), (0.0, width)].map(|(x, y)| Vector3::new(x, y, 0.0))
    };
    for start in 0..4 {
        let numbered = |width: f64| {
            let corners = kite(width);
            mean_plane(&std::array::from_fn(|k| corners[(k + start) % 4]))
        };
        // Area 6·width over the square of the long diagonal, 36.
        for width in [0.0, 5e-10] {
            let refused = numbered(width);
            assert!(
                matches!(refused, Err(Error::ZeroArea(area)) if (area - width / 6.0).abs() <= ROUND_OFF),
                "{refused:?}"
            );
        }
        assert!(numbered(9e-10).is_ok());
    }
    let nowhere = [Vector3::zeros(); 4];
    assert!(matches!(mean_plane(&nowhere), Err(Error::ZeroArea(0.0))));
    let mut lost = kite(1.0);
    lost[3].y = f64::NAN;
    assert!(matches!(mean_plane(&lost), Err(Error::ZeroArea(0.0))));
}

#[test]
fn a_corner_is_straight_within_one_part_in_ten_to_the_tenth() {
    let bent = |height: f64| {
        mean_plane(
            &[(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, height)]
                .map(|(x, y)| Vector3::new(x, y, 0.0)),
        )
    };
    assert!(matches!(bent(0.7e-10), Err(Error::NotConvex(4))));
    assert!(bent(1.5e-10).is_ok());
    let repeated =
        [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    assert!(matches!(mean_plane(&repeated), Err(Error::NotConvex(2))));
}

#[test]
fn a_triangle_needs_area() {
    let corners =
        |height: f64| [(0.0, 0.0), (1.0, 0.0), (0.5, height)].map(|(x, y)| Vector3::new(x, y, 0.0));
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let numbered =
            |height: f64| Geometry::new(ElementKind::Triangle, &order.map(|k| corners(height)[k]));
        for height in [0.0, 1.5e-10] {
            let refused = numbered(height);
            assert!(
                matches!(refused, Err(Error::ZeroArea(area)) if (area - height / 2.0).abs() <= ROUND_OFF),
                "{refused:?}"
            );
        }
        assert!(numbered(3e-10).is_ok());
        assert!(matches!(numbered(f64::NAN), Err(Error::ZeroArea(0.0))));
    }
}

#[test]
fn a_plane_frame_of_reference_is_right_handed() {
    // The reversed square is seen from the other side, so that its corners still run counterclockwise.
    let square =
        [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vector3::new(x, y, 5.0));
    let [a, b, c, d] = square;
    for corners in [[a, b, c, d], [a, d, c, b]] {
        let plane = mean_plane(&corners).unwrap();
        let found = Matrix3::from_columns(&[
            plane.corners()[1].push(0.0),
            plane.corners()[2].push(0.0),
            plane.corners()[3].push(1.0),
        ]);
        let (first, second) = ((corners[1] - a).norm(), (corners[3] - a).norm());
        let expected = Matrix3::new(first, first, 0.0, 0.0, second, second, 0.0, 0.0, 1.0);
        assert_eq!(found, expected);
        assert_eq!(plane.area(), 2.0);
    }
}
