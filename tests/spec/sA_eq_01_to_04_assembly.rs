//! Assembly and factorization: two routes to the same deflections, and every refusal by name.

use crate::common::matrices::relative_distance;
use crate::common::strategies::positive_definite;
use crate::common::structures::{
    as_element, condition, dense, factorized, grid, rod, sizes_of, spring_chain, unit_material,
};
use crate::common::tolerances::{CONDITIONED_ROUND_OFF, MATRIX_ROUND_OFF, ROUND_OFF};
use corfem::method::assembly::{dense_stiffness, element_matrices};
use corfem::method::elements::unit_stiffness;
use corfem::method::error::Error;
use corfem::method::geometry::Geometry;
use corfem::method::structure::{Element, ElementKind, Structure};
use corfem::sparse::factorization::Factor;
use corfem::torque_box::Case;
use nalgebra::DMatrix;
use proptest::prelude::*;

/// Loads on `count` DOF, two sets of them.
fn loads(count: usize) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(-1.0..1.0_f64, 2 * count)
        .prop_map(move |entries| DMatrix::from_vec(count, 2, entries))
}

/// One element of each kind on a unit square, any of the twelve DOF constrained.
fn square(constrained: &[bool]) -> Structure {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.2],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.1],
    ];
    let grids = (0..4)
        .map(|k| {
            grid(
                k + 1,
                positions[k],
                [
                    constrained[3 * k],
                    constrained[3 * k + 1],
                    constrained[3 * k + 2],
                ],
            )
        })
        .collect();
    let panel = |label, kind, grids: [usize; 4]| Element {
        label,
        kind,
        grids: grids.to_vec(),
        size: 0.25,
        material: unit_material(),
    };
    let elements = vec![
        rod(5, [3, 1], 2.0),
        panel(7, ElementKind::ShearPanel, [2, 3, 4, 1]),
        panel(6, ElementKind::Membrane, [4, 3, 2, 1]),
    ];
    Structure::new(grids, elements).unwrap()
}

properties! {
    #![proptest_config(crate::common::config())]

    /// All twelve DOF at once, the constrained ones struck out afterwards: the slow obvious way.
    #[test]
    fn assembly_scatters_elements_and_strikes_out_the_held_dof(
        constrained in prop::collection::vec(prop::bool::ANY, 12).prop_filter("all constrained", |constrained| constrained.contains(&false)),
    ) {
        let structure = square(&constrained);
        let mut whole = DMatrix::zeros(12, 12);
        for element in structure.elements() {
            let unit = unit_stiffness(&Geometry::new(element.kind, &structure.corners(element)).unwrap(), &element.material);
            for a in 0..unit.nrows() {
                for b in 0..unit.ncols() {
                    let at = |k: usize| 3 * (element.grids[k / 3] - 1) + k % 3;
                    whole[(at(a), at(b))] += element.size * unit[(a, b)];
                }
            }
        }
        let free: Vec<usize> = (0..12).filter(|&k| !constrained[k]).collect();
        let expected = whole.select_rows(&free).select_columns(&free);
        let found = dense(&structure);
        prop_assert_eq!(found.shape(), expected.shape());
        prop_assert!((found - expected).amax() <= ROUND_OFF * whole.amax());
        for (matrix, element) in element_matrices(&structure).iter().zip(structure.elements()) {
            prop_assert_eq!(matrix.label, element.label);
            prop_assert_eq!(matrix.unit.shape(), (matrix.dof.len(), matrix.dof.len()));
        }
    }

    #[test]
    fn stiffness_is_linear_in_gage_and_area(a in sizes_of(3), b in sizes_of(3), factor in 0.1..10.0_f64) {
        let matrices = element_matrices(&square(&[false; 12]));
        let at = |sizes: &[f64]| dense_stiffness(&matrices, sizes, 12).unwrap();
        let mixed: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + factor * b).collect();
        prop_assert!(relative_distance(&at(&mixed), &(at(&a) + factor * at(&b))) <= ROUND_OFF);
    }

    /// The sparse factor, scaled, against nalgebra's dense Cholesky, not scaled, on the box with gages and areas over two
    /// decades.
    #[test]
    fn sparse_and_dense_deflections_agree(number in 1..=4_usize, sizes in sizes_of(39), loads in loads(36)) {
        let model = Case::new(number).unwrap().model().unwrap();
        let matrices = model.element_matrices();
        let factor = Factor::of_stiffness(matrices, &sizes, model.structure().free_dof()).unwrap();
        let found = factor.solve(&loads).unwrap();
        let stiffness = dense_stiffness(matrices, &sizes, 36).unwrap();
        let expected = stiffness.clone().cholesky().unwrap().solve(&loads);
        let bar = CONDITIONED_ROUND_OFF * condition(&stiffness);
        prop_assert!(relative_distance(&found, &expected) <= bar, "{:e}", relative_distance(&found, &expected));
    }

    /// The tip of a chain moves by the sum of the springs' flexibilities; springs over ten decades make condition
    /// numbers of 1e10, which is no reason to refuse.
    #[test]
    fn springs_in_series_add_their_flexibilities(decades in prop::collection::vec(0.0..10.0_f64, 1..8)) {
        let springs: Vec<f64> = decades.iter().map(|d| 10f64.powf(*d)).collect();
        let structure = spring_chain(&springs, [true, false]);
        let tip = DMatrix::from_fn(springs.len(), 1, |row, _| f64::from(row + 1 == springs.len()));
        let deflections = factorized(&structure).unwrap().solve(&tip).unwrap();
        let bar = CONDITIONED_ROUND_OFF * condition(&dense(&structure));
        let mut expected = 0.0;
        for (deflection, spring) in deflections.iter().zip(&springs) {
            expected += 1.0 / spring;
            prop_assert!((deflection - expected).abs() <= bar * deflections.amax());
        }
    }

    #[test]
    fn a_positive_definite_matrix_of_condition_1e10_is_solved((stiffness, _) in positive_definite(9, 10.0), loads in loads(9)) {
        let (elements, free) = as_element(&stiffness);
        let found = Factor::of_stiffness(&elements, &[1.0], &free).unwrap().solve(&loads).unwrap();
        // What a backward stable solution leaves, whatever the condition.
        let residual = (&stiffness * &found - &loads).amax();
        prop_assert!(residual <= MATRIX_ROUND_OFF * stiffness.amax() * found.amax());
        let expected = stiffness.clone().cholesky().unwrap().solve(&loads);
        let values = stiffness.symmetric_eigenvalues();
        let bar = CONDITIONED_ROUND_OFF * values.max() / values.min();
        prop_assert!(relative_distance(&found, &expected) <= bar);
    }

}

#[test]
fn wrong_sizes_and_loads_are_refused_by_name() {
    let structure = spring_chain(&[1.0, 2.0, 3.0], [true, false]);
    let matrices = element_matrices(&structure);
    let free = structure.free_dof();
    for sizes in [vec![1.0; 2], vec![1.0; 4]] {
        for refused in [
            Factor::of_stiffness(&matrices, &sizes, free).unwrap_err(),
            dense_stiffness(&matrices, &sizes, 3).unwrap_err(),
        ] {
            assert!(
                matches!(refused, Error::WrongShape {
                    what: "element sizes", expected_rows: 3, expected_columns: 1, rows, columns: 1
                } if rows == sizes.len()),
                "{refused:?}"
            );
        }
    }
    for value in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        let refused = Factor::of_stiffness(&matrices, &[1.0, value, 3.0], free).unwrap_err();
        assert!(
            matches!(&refused, Error::NotPositive { what: "size", owner, .. } if owner == "element 2"),
            "{refused:?}"
        );
    }
    let nothing = Factor::of_stiffness(&matrices, &[1.0, 2.0, 3.0], &[]);
    assert!(
        matches!(
            nothing,
            Err(Error::Empty {
                what: "free degrees of freedom"
            })
        ),
        "{nothing:?}"
    );
    let factor = factorized(&structure).unwrap();
    let refused = factor.solve(&DMatrix::zeros(4, 2)).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::WrongShape {
                what: "loads",
                expected_rows: 3,
                expected_columns: 2,
                rows: 4,
                columns: 2
            }
        ),
        "{refused:?}"
    );
    let refused = factor
        .solve(&DMatrix::from_column_slice(3, 1, &[0.0, f64::NAN, 0.0]))
        .unwrap_err();
    assert!(
        matches!(
            refused,
            Error::NotFinite {
                what: "loads",
                row: 1,
                column: 0,
                ..
            }
        ),
        "{refused:?}"
    );
    assert_eq!(
        factor.solve(&DMatrix::zeros(3, 2)).unwrap(),
        DMatrix::zeros(3, 2)
    );
}

#[test]
fn bad_geometry_is_refused_by_its_element() {
    let with = |kind: ElementKind, positions: &[[f64; 3]]| {
        let grids = positions
            .iter()
            .zip(1..)
            .map(|(&position, label)| grid(label, position, [false; 3]));
        let element = Element {
            label: 8,
            kind,
            grids: (1..=positions.len()).collect(),
            size: 1.0,
            material: unit_material(),
        };
        match Structure::new(grids.collect(), vec![element]) {
            Err(Error::InElement { element: 8, source }) => *source,
            other => panic!("expected an error in element 8, found {other:?}"),
        }
    };
    let [a, b, c, d] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let inside = [0.25, 0.5, 0.0];
    assert!(matches!(
        with(ElementKind::Rod, &[c, c]),
        Error::ZeroLength(0.0)
    ));
    for kind in [ElementKind::ShearPanel, ElementKind::Membrane] {
        assert!(matches!(with(kind, &[a, b, b, a]), Error::ZeroArea(0.0)));
        assert!(matches!(
            with(kind, &[d, a, inside, c]),
            Error::NotConvex(3)
        ));
        // Corners that do not run round the perimeter.
        let higher = [0.0, 2.0, 0.0];
        assert!(matches!(
            with(kind, &[a, c, b, higher]),
            Error::NotConvex(2)
        ));
    }
    let grids = vec![grid(1, a, [true; 3]), grid(2, a, [false; 3])];
    let refused = Structure::new(grids, vec![rod(3, [1, 2], 1.0)]);
    assert_eq!(
        refused.unwrap_err().to_string(),
        "element 3: the rod has no length (0.000e0 between its ends)"
    );
}
