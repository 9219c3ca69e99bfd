//! Lumped masses of single elements.

use crate::prelude::*;

#[test]
fn rectangle_and_triangle_lump_equally_and_rod_by_halves() {
    let at = |x, y| Vector3::new(x, y, 0.0);
    let rectangle = [at(0.0, 0.0), at(4.0, 0.0), at(4.0, 3.0), at(0.0, 3.0)];
    for kind in [ElementKind::ShearPanel, ElementKind::Membrane] {
        assert_eq!(corner_volumes(kind, &rectangle), vec![3.0; 4]);
    }
    assert_eq!(
        corner_volumes(ElementKind::Triangle, &rectangle[..3]),
        vec![2.0; 3]
    );
    assert_eq!(
        corner_volumes(ElementKind::Rod, &rectangle[1..3]),
        vec![1.5; 2]
    );
    assert_eq!(
        said(check_corners(1, ElementKind::Rod, &rectangle)),
        "corners of an element: 4 given or asked for; there must be 2 to 2"
    );
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
        let volumes = corner_volumes(kind, &corners);
        assert_eq!(volumes.len(), 4);
        for (found, expected) in volumes.iter().zip(expected) {
            assert_relative_eq!(*found, expected, max_relative = ROUND_OFF);
        }
    }
}

properties! {
    #[test]
    fn lumped_volumes_do_not_depend_on_place_or_orientation(
        offset in point(), turn in rotation(), x3 in 1.0..8.0, y3 in 1.0..8.0, x4 in -1.0..1.0, y4 in 1.0..8.0,
    ) {
        let flat = [[0.0, 0.0], [5.0, 0.0], [x3, y3], [x4, y4]].map(|[x, y]| Vector3::new(x, y, 0.0));
        prop_assume!(check_corners(1, ElementKind::Membrane, &flat).is_ok());
        let moved = flat.map(|corner| turn * corner + offset);
        for (kind, count) in [(ElementKind::Rod, 2), (ElementKind::Triangle, 3), (ElementKind::Membrane, 4)] {
            let here = corner_volumes(kind, &flat[..count]);
            let there = corner_volumes(kind, &moved[..count]);
            prop_assert_eq!(here.len(), count);
            for (a, b) in here.iter().zip(there) {
                // Offsets of 100 in and areas of some in²: the difference of two large coordinates.
                prop_assert!((a - b).abs() <= MATRIX_ROUND_OFF * (1.0 + a));
            }
        }
    }

    /// Corners of a flat element share all of its volume; those of a warped one a little more than that of its mean plane.
    #[test]
    fn lumped_volumes_sum_to_the_elements(sample in sample()) {
        let Sample { kind, corners, warped, .. } = sample;
        let sum: f64 = corner_volumes(kind, &corners).iter().sum();
        let volume = match kind {
            ElementKind::Rod => (corners[1] - corners[0]).norm(),
            ElementKind::Triangle => 0.5 * (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm(),
            _ => 0.5 * (corners[2] - corners[0]).cross(&(corners[3] - corners[1])).norm(),
        };
        let excess = sum / volume - 1.0;
        if warped && corners.len() == 4 {
            prop_assert!(excess > 0.0, "{excess:e}");
        } else {
            prop_assert!(excess.abs() <= MATRIX_ROUND_OFF, "{excess:e}");
        }
    }
}

/// The sample alone with this density and size, its corners as grids from one on, held where they are.
fn structure(sample: &Sample, density: f64, size: f64, held: &[[bool; 3]]) -> Structure {
    let grids = sample.corners.iter().zip(held).zip(1..);
    let grids = grids.map(|((&corner, &held), label)| grid(label, corner.into(), held));
    let element = Element {
        label: 1,
        kind: sample.kind,
        grids: (1..=sample.corners.len()).collect(),
        size,
        material: Material {
            density,
            ..sample.material
        },
    };
    Structure::new(grids.collect(), vec![element]).unwrap()
}

/// An element without a density has no mass.
#[test]
fn a_material_without_density_has_no_lumped_mass() {
    let corners = [Vector3::zeros(), Vector3::x()];
    let rod = Sample {
        kind: ElementKind::Rod,
        corners: corners.to_vec(),
        warped: false,
        material: Material::isotropic(1e7, 0.3).unwrap(),
    };
    let structure = structure(&rod, 0.0, 0.5, &[[false; 3]; 2]);
    let element = &structure.elements()[0];
    assert!(lumped_masses(&structure, element, &structure.corners()[0]).is_empty());
    assert_eq!(
        said(BulkData::from_structure(&structure).mass_dof(&structure)),
        "degrees of freedom with mass: 0 given or asked for; there must be at least 1"
    );
}
