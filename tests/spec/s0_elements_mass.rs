//! Lumped masses of single elements.

use crate::common::strategies::{point, rotation};
use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF};
use approx::assert_relative_eq;
use corfem::method::elements::corner_volumes;
use corfem::method::error::Error;
use corfem::method::geometry::Geometry;
use corfem::method::structure::ElementKind;
use nalgebra::Vector3;
use proptest::prelude::*;

#[test]
fn rectangle_and_triangle_lump_equally_and_rod_by_halves() {
    let at = |x, y| Vector3::new(x, y, 0.0);
    let rectangle = [at(0.0, 0.0), at(4.0, 0.0), at(4.0, 3.0), at(0.0, 3.0)];
    for kind in [ElementKind::ShearPanel, ElementKind::Membrane] {
        assert_eq!(
            corner_volumes(&Geometry::new(kind, &rectangle).expect("four corners")),
            vec![3.0; 4]
        );
    }
    assert_eq!(
        corner_volumes(&Geometry::new(ElementKind::Triangle, &rectangle[..3]).expect("three")),
        vec![2.0; 3]
    );
    assert_eq!(
        corner_volumes(&Geometry::new(ElementKind::Rod, &rectangle[1..3]).expect("two")),
        vec![1.5; 2]
    );
    let error = Geometry::new(ElementKind::Rod, &rectangle).expect_err("four corners");
    assert!(matches!(
        error,
        Error::WrongCornerCount {
            expected: 2,
            found: 4
        }
    ));
}

#[test]
fn trapezoid_lumps_more_where_it_is_wider() {
    let at = |x, y| Vector3::new(x, y, 0.0);
    // Sides 6 (bottom) and 2 (top), height 3: area 12; corner triangles 9, 9, 3, 3.
    let corners = [at(0.0, 0.0), at(6.0, 0.0), at(4.0, 3.0), at(2.0, 3.0)];
    let volumes =
        corner_volumes(&Geometry::new(ElementKind::ShearPanel, &corners).expect("four corners"));
    let expected = [21.0 / 6.0, 21.0 / 6.0, 15.0 / 6.0, 15.0 / 6.0];
    for (found, expected) in volumes.iter().zip(expected) {
        assert_relative_eq!(*found, expected, max_relative = ROUND_OFF);
    }
}

#[test]
fn warped_quadrilateral_lumps_the_area_of_its_diagonals_beside_true_corner_triangles() {
    // A square of side 6 with one corner raised by 9. Diagonals (6, 6, 0) and (-6, 6, 9): 9 |(6, -6, 8)| / 2 = 9 sqrt(34).
    let at = Vector3::new;
    let corners = [
        at(0.0, 0.0, 0.0),
        at(6.0, 0.0, 0.0),
        at(6.0, 6.0, 0.0),
        at(0.0, 6.0, 9.0),
    ];
    let area = 9.0 * 34.0_f64.sqrt();
    // Corner 4 and its neighbors: sides (0, -6, -9) and (6, 0, -9), half of 18 |(3, -3, 2)|.
    let (raised, beside) = (9.0 * 22.0_f64.sqrt(), 3.0 * 117.0_f64.sqrt());
    let expected = [beside, 18.0, beside, raised].map(|corner| (area + corner) / 6.0);
    for kind in [ElementKind::ShearPanel, ElementKind::Membrane] {
        let volumes = corner_volumes(&Geometry::new(kind, &corners).expect("four corners"));
        assert_eq!(volumes.len(), 4);
        for (found, expected) in volumes.iter().zip(expected) {
            assert_relative_eq!(*found, expected, max_relative = ROUND_OFF);
        }
    }
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn lumped_volumes_do_not_depend_on_place_or_orientation(
        offset in point(), turn in rotation(), x3 in 1.0..8.0, y3 in 1.0..8.0, x4 in -1.0..1.0, y4 in 1.0..8.0,
    ) {
        let flat = [[0.0, 0.0], [5.0, 0.0], [x3, y3], [x4, y4]].map(|[x, y]| Vector3::new(x, y, 0.0));
        prop_assume!(Geometry::new(ElementKind::Membrane, &flat).is_ok());
        let moved = flat.map(|corner| turn * corner + offset);
        for (kind, count) in [(ElementKind::Rod, 2), (ElementKind::Triangle, 3), (ElementKind::Membrane, 4)] {
            let here = corner_volumes(&Geometry::new(kind, &flat[..count]).expect("fits"));
            let there = corner_volumes(&Geometry::new(kind, &moved[..count]).expect("fits"));
            prop_assert_eq!(here.len(), count);
            for (a, b) in here.iter().zip(there) {
                // Offsets of 100 in and areas of some in²: the difference of two large coordinates.
                prop_assert!((a - b).abs() <= MATRIX_ROUND_OFF * (1.0 + a));
            }
        }
    }
}
