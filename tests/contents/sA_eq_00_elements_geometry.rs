//! The corners of panels and triangles: the mean plane, and the shapes that are refused.

use crate::common::closed_forms::analytical::area;
use crate::common::panels::{panel_sample, placed};
use crate::prelude::*;

const PANELS: [ElementKind; 2] = [ElementKind::ShearPanel, ElementKind::Membrane];

/// Whose corners are refused, and the ratio that shows it.
fn refusal(kind: ElementKind, corners: &[Point]) -> Option<(String, f64)> {
    match check_corners(7, kind, corners) {
        Ok(()) => None,
        Err(Error::Value {
            what: "relative area",
            owner,
            value,
            ..
        }) => Some((owner, value)),
        Err(other) => panic!("{other:?}"),
    }
}

/// The words for a corner from one.
fn angle(corner: usize) -> String {
    format!("corner {corner} of element 7")
}

const NO_AREA: &str = "element 7";

/// Whether the corners are refused for an area that is this part of the square of their size.
fn has_no_area(kind: ElementKind, corners: &[Point], expected: f64) -> bool {
    matches!(refusal(kind, corners), Some((what, ratio))
        if what == NO_AREA && ((ratio - expected).abs() <= ROUND_OFF || ratio.is_nan() && expected.is_nan()))
}

fn diagonals(corners: &[Point; 4]) -> [Point; 2] {
    [corners[2] - corners[0], corners[3] - corners[1]]
}

/// Area by the shoelace formula.
fn shoelace(flat: &[Vector2<f64>; 4]) -> f64 {
    0.5 * (0..4)
        .map(|k| flat[k].perp(&flat[(k + 1) % 4]))
        .sum::<f64>()
}

properties! {
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
        let refused = refusal(kind, &corners).map(|(what, _)| what);
        prop_assert_eq!(refused, Some(angle(corner + 1)));
    }

    #[test]
    fn the_mean_plane_keeps_what_is_flat(corners in placed(flat_panel())) {
        let flat = mean_plane(&corners);
        let size = (corners[2] - corners[0]).norm();
        for a in 0..4 {
            for b in 0..4 {
                let (found, true_distance) = ((flat[a] - flat[b]).norm(), (corners[a] - corners[b]).norm());
                prop_assert!((found - true_distance).abs() <= ELEMENT_ROUND_OFF * size);
            }
        }
        let [d13, d24] = diagonals(&corners);
        prop_assert!((0.5 * d13.cross(&d24).norm() - shoelace(&flat)).abs() <= ELEMENT_ROUND_OFF * size * size);
        prop_assert!((area(&flat) - shoelace(&flat)).abs() <= ELEMENT_ROUND_OFF * size * size);
        prop_assert_eq!(flat[0].amax(), 0.0);
        prop_assert!(flat[1].x > 0.0 && flat[1].y.abs() <= ELEMENT_ROUND_OFF * size);
    }

    #[test]
    fn the_mean_plane_is_parallel_to_both_diagonals(sample in panel_sample()) {
        let corners: [Vector3<f64>; 4] = std::array::from_fn(|k| sample.corners[k]);
        let (plane, [d13, d24]) = (mean_plane(&corners), diagonals(&corners));
        let [flat13, flat24] = [plane[2] - plane[0], plane[3] - plane[1]];
        for (flat, diagonal) in [(flat13, d13), (flat24, d24)] {
            prop_assert!((flat.norm() - diagonal.norm()).abs() <= ELEMENT_ROUND_OFF * diagonal.norm());
        }
        prop_assert!((d13.dot(&d24) - flat13.dot(&flat24)).abs() <= ELEMENT_ROUND_OFF * d13.norm_squared());
    }
}

#[test]
fn a_panel_needs_area() {
    let kite = |width: f64| {
        [(-3.0, 0.0), (0.0, -width), (3.0, 0.0), (0.0, width)].map(|(x, y)| Vector3::new(x, y, 0.0))
    };
    for kind in PANELS {
        for start in 0..4 {
            let numbered = |width: f64| {
                let corners = kite(width);
                std::array::from_fn::<_, 4, _>(|k| corners[(k + start) % 4])
            };
            // Area 6·width over the square of the long diagonal, 36.
            for width in [0.0, 5e-10] {
                assert!(has_no_area(kind, &numbered(width), width / 6.0), "{width}");
            }
            assert_eq!(refusal(kind, &numbered(9e-10)), None);
        }
        assert!(has_no_area(kind, &[Vector3::zeros(); 4], f64::NAN));
        let mut lost = kite(1.0);
        lost[3].y = f64::NAN;
        assert!(has_no_area(kind, &lost, f64::NAN));
    }
}

#[test]
fn a_corner_is_straight_within_one_part_in_ten_to_the_tenth() {
    let at = |corners: [(f64, f64); 4]| corners.map(|(x, y)| Vector3::new(x, y, 0.0));
    let bent = |height: f64| at([(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, height)]);
    let repeated = at([(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    for kind in PANELS {
        let words = |corners: &[Point]| refusal(kind, corners).map(|(what, _)| what);
        assert_eq!(words(&bent(0.7e-10)), Some(angle(4)));
        assert_eq!(words(&bent(1.5e-10)), None);
        assert_eq!(words(&repeated), Some(angle(2)));
    }
}

#[test]
fn a_triangle_needs_area() {
    let corners =
        |height: f64| [(0.0, 0.0), (1.0, 0.0), (0.5, height)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let kind = ElementKind::Triangle;
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let numbered = |height: f64| order.map(|k| corners(height)[k]);
        for height in [0.0, 1.5e-10] {
            assert!(
                has_no_area(kind, &numbered(height), height / 2.0),
                "{height}"
            );
        }
        assert_eq!(refusal(kind, &numbered(3e-10)), None);
        assert!(has_no_area(kind, &numbered(f64::NAN), f64::NAN));
    }
}

#[test]
fn a_plane_frame_of_reference_is_right_handed() {
    // The reversed square is seen from the other side, so that its corners still run counterclockwise.
    let square =
        [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vector3::new(x, y, 5.0));
    let [a, b, c, d] = square;
    for corners in [[a, b, c, d], [a, d, c, b]] {
        let flat = mean_plane(&corners);
        let found =
            Matrix3::from_columns(&[flat[1].push(0.0), flat[2].push(0.0), flat[3].push(1.0)]);
        let (first, second) = ((corners[1] - a).norm(), (corners[3] - a).norm());
        let expected = Matrix3::new(first, first, 0.0, 0.0, second, second, 0.0, 0.0, 1.0);
        assert_eq!(found, expected);
        assert_eq!(shoelace(&flat), 2.0);
    }
}
