//! The paper's box: the connectivity of Table 2 and the loads of the nine dynamic points.

use crate::common::torque_boxes::reconstruction;
use crate::prelude::*;
use corfem::torque_box::wing_box::rod_ends;
use nalgebra::{Matrix4, Vector4};

/// The grids of a rib from the tip in: rear upper, rear lower, front upper, front lower.
fn rib(number: usize) -> [usize; 4] {
    std::array::from_fn(|k| 4 * number + k + 1)
}

fn at(data: &Reconstruction, grid: usize) -> Vector3<f64> {
    data.grids[&grid].into()
}

/// Where the three dynamic points of a rib are.
fn dynamic_points(data: &Reconstruction, number: usize) -> [Vector3<f64>; 3] {
    let [rear_upper, rear_lower, front_upper, front_lower] = rib(number).map(|grid| at(data, grid));
    let (rear, front) = (
        0.5 * (rear_upper + rear_lower),
        0.5 * (front_upper + front_lower),
    );
    [rear, rear + data.mid_chord_fraction * (front - rear), front]
}

/// Forces and moments at the ends of a beam of unit length clamped at both, under a unit load at ξ: (R_a, M_a, R_b, M_b),
/// by two beam elements and the equilibrium of their common node.
fn clamped_beam_by_elements(xi: f64) -> [f64; 4] {
    let element = |l: f64| {
        Matrix4::new(
            12.0,
            6.0 * l,
            -12.0,
            6.0 * l,
            6.0 * l,
            4.0 * l * l,
            -6.0 * l,
            2.0 * l * l,
            -12.0,
            -6.0 * l,
            12.0,
            -6.0 * l,
            6.0 * l,
            2.0 * l * l,
            -6.0 * l,
            4.0 * l * l,
        ) / (l * l * l)
    };
    let (left, right) = (element(xi), element(1.0 - xi));
    let middle = left.fixed_view::<2, 2>(2, 2) + right.fixed_view::<2, 2>(0, 0);
    let moved = middle.try_inverse().unwrap().column(0).into_owned();
    let at_a = left.fixed_view::<2, 2>(0, 2) * moved;
    let at_b = right.fixed_view::<2, 2>(2, 0) * moved;
    [-at_a[0], -at_a[1], -at_b[0], -at_b[1]]
}

properties! {
    /// What the structure does as a rigid body its dynamic points do: q_D = Tᵗq_S is their motion along z.
    #[test]
    fn dynamic_points_follow_rigid_bodies(
        data in reconstruction(),
        shift in crate::common::strategies::point(),
        spin in crate::common::strategies::point(),
    ) {
        let motion = |at: &Vector3<f64>| shift + spin.cross(at);
        let structural = DVector::from_iterator(36, (1..=12).flat_map(|grid| motion(&at(&data, grid)).data.0[0]));
        let t = load_distribution(&data)?;
        prop_assert_eq!(t.shape(), (36, 9));
        let dynamic = t.tr_mul(&structural);
        for number in 0..3 {
            for (k, point) in dynamic_points(&data, number).iter().enumerate() {
                let expected = motion(point).z;
                let found = dynamic[3 * number + k];
                prop_assert!((found - expected).abs() <= MATRIX_ROUND_OFF * structural.amax(), "{found} {expected}");
            }
        }
    }

    /// A unit force on each dynamic point arrives as a unit force along z and none in the plane.
    #[test]
    fn a_unit_force_arrives_whole(data in reconstruction()) {
        let t = load_distribution(&data)?;
        for column in t.column_iter() {
            for (axis, expected) in [0.0, 0.0, 1.0].into_iter().enumerate() {
                let sum: f64 = (0..12).map(|grid| column[3 * grid + axis]).sum();
                prop_assert!((sum - expected).abs() <= ROUND_OFF * column.amax());
            }
        }
    }

    /// A point on a spar loads the spar's two grids equally, and nothing else.
    #[test]
    fn a_spars_point_loads_its_two_grids_alone(data in reconstruction()) {
        let t = load_distribution(&data)?;
        for number in 0..3 {
            let [rear_upper, rear_lower, front_upper, front_lower] = rib(number);
            for (column, grids) in [(0, [rear_upper, rear_lower]), (2, [front_upper, front_lower])] {
                let mut expected = DVector::zeros(36);
                for grid in grids {
                    expected[3 * (grid - 1) + 2] = 0.5;
                }
                prop_assert_eq!(t.column(3 * number + column).into_owned(), expected);
            }
        }
    }

    /// The mid point loads its own rib with the end forces of a clamped beam, halves on upper and lower grid, and its end
    /// moments, as couples along the rib on upper and lower grid; the beam by elements and by the textbook's formulas.
    #[test]
    fn a_mid_points_load_is_a_clamped_beams(data in reconstruction()) {
        let t = load_distribution(&data)?;
        let xi = data.mid_chord_fraction;
        let by_elements = clamped_beam_by_elements(xi);
        let textbook = Vector4::new(
            (1.0 - xi).powi(2) * (1.0 + 2.0 * xi),
            xi * (1.0 - xi).powi(2),
            xi * xi * (3.0 - 2.0 * xi),
            -xi * xi * (1.0 - xi),
        );
        for k in 0..4 {
            prop_assert!((by_elements[k] - textbook[k]).abs() <= MATRIX_ROUND_OFF / xi.min(1.0 - xi).powi(3));
        }
        for number in 0..3 {
            let grids = rib(number);
            let column = t.column(3 * number + 1);
            let force = |grid: usize| column.fixed_rows::<3>(3 * (grid - 1)).into_owned();
            let mut chord = at(&data, grids[2]) - at(&data, grids[0]);
            chord.z = 0.0;
            let along = chord.normalize();
            for (end, (upper, lower)) in [(grids[0], grids[1]), (grids[2], grids[3])].into_iter().enumerate() {
                let (up, low) = (force(upper), force(lower));
                prop_assert!((up.z - textbook[2 * end] / 2.0).abs() <= ROUND_OFF);
                prop_assert!((low.z - textbook[2 * end] / 2.0).abs() <= ROUND_OFF);
                // Rotation that lifts the front is from upper −u to lower +u along the rib.
                let depth = at(&data, upper).z - at(&data, lower).z;
                let couple = textbook[2 * end + 1] * chord.norm() / depth * along;
                prop_assert!((up.xy() + couple.xy()).norm() <= ROUND_OFF * column.amax());
                prop_assert!((low.xy() - couple.xy()).norm() <= ROUND_OFF * column.amax());
            }
            let own = 12 * number..12 * (number + 1);
            prop_assert!((0..36).filter(|row| !own.contains(row)).all(|row| column[row] == 0.0));
        }
    }
}

#[test]
fn the_structure_has_table_2s_elements_and_a_fixed_root() {
    let case = case_of(4);
    let found = structure(&case.reconstruction, &case.panels, case.rod_area).unwrap();
    let (panels, rods) = found.elements().split_at(PANEL_COUNT);
    assert!(
        found
            .elements()
            .iter()
            .map(|element| element.label)
            .eq(1..=39)
    );
    for (element, panel) in panels.iter().zip(&case.panels) {
        let own = (element.kind, &element.grids, element.size);
        assert_eq!(own, (panel.kind, &panel.grids, panel.gage));
    }
    for (element, ends) in rods.iter().zip(rod_ends()) {
        let own = (element.kind, &element.grids[..], element.size);
        assert_eq!(own, (ElementKind::Rod, &ends[..], 0.01));
    }
    for element in found.elements() {
        let Material {
            youngs_modulus,
            poissons_ratio,
            ..
        } = element.material;
        assert_eq!((youngs_modulus, poissons_ratio), (1.0e7, 0.3339));
    }
    assert_eq!(found.free_dof().len(), 36);
    for (grid, label) in found.grids().iter().zip(1..) {
        assert_eq!((grid.label, grid.constrained), (label, [label > 12; 3]));
        assert_eq!(grid.position.z < 0.0, label % 2 == 0, "grid {label}");
        assert_eq!(
            <[f64; 3]>::from(grid.position),
            case.reconstruction.grids[&label]
        );
    }
    assert_eq!(panels[7].grids, [2, 4, 8, 6]);
    assert_eq!((panels[7].size, TEST_GAGE), (0.0001, 0.010));
}

#[test]
fn rods_run_along_every_free_edge_of_the_panels() {
    let edge = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let panels = case_of(1).panels;
    let edges = panels
        .iter()
        .flat_map(|panel| [0, 1, 2, 3].map(|k| edge([panel.grids[k], panel.grids[(k + 1) % 4]])));
    let free: BTreeSet<_> = edges.filter(|[first, _]| *first < 13).collect();
    assert_eq!(
        rod_ends().into_iter().map(edge).collect::<BTreeSet<_>>(),
        free
    );
    assert_eq!(rod_ends(), boxes().rods, "in the order of the stored boxes");
}
