//! Assembly and factorization: two routes to the same deflections, and every refusal by name.

use crate::common::structures::{of_dense, rod, unit_material};
use crate::prelude::*;

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
    /// All twelve DOF at once, the constrained ones struck out afterwards: the slow obvious way.
    #[test]
    fn assembly_scatters_elements_and_strikes_out_the_held_dof(
        constrained in prop::collection::vec(prop::bool::ANY, 12).prop_filter("all constrained", |constrained| constrained.contains(&false)),
    ) {
        let structure = square(&constrained);
        let mut whole = zero_square(12);
        for (element, corners) in structure.elements().iter().zip(structure.corners()) {
            let unit = unit_stiffness(element.kind, corners, &element.material);
            for a in 0..unit.nrows() {
                for b in 0..unit.ncols() {
                    let at = |k: usize| 3 * (element.grids[k / 3] - 1) + k % 3;
                    whole[(at(a), at(b))] += element.size * unit[(a, b)];
                }
            }
        }
        let free = (0..12).filter(|&k| !constrained[k]).collect_vec();
        let expected = whole.select_rows(&free).select_columns(&free);
        let found = dense(&structure);
        prop_assert_eq!(found.shape(), expected.shape());
        prop_assert!((found - expected).amax() <= ROUND_OFF * whole.amax());
        for (matrix, element) in element_matrices(&structure).zip(structure.elements()) {
            prop_assert_eq!(matrix.label, element.label);
            prop_assert_eq!(matrix.unit.shape(), (matrix.dof.len(), matrix.dof.len()));
        }
    }

    #[test]
    fn stiffness_is_linear_in_gage_and_area(a in sizes_of(3), b in sizes_of(3), factor in 0.1..10.0_f64) {
        let matrices = element_matrices(&square(&[false; 12])).collect_vec();
        let at = |sizes: &[f64]| assemble(&matrices, sizes, 12).unwrap();
        let mixed = a.iter().zip(&b).map(|(a, b)| a + factor * b).collect_vec();
        prop_assert!(relative_distance(&at(&mixed), &(at(&a) + factor * at(&b))) <= ROUND_OFF);
    }

    /// The sparse factor, scaled, against nalgebra's dense Cholesky, not scaled, on the box with gages and areas over two
    /// decades.
    #[test]
    fn sparse_and_dense_deflections_agree(number in 1..=4_usize, sizes in sizes_of(39), loads in loads(36)) {
        let model = case_of(number).model()?;
        let matrices = model.element_matrices();
        let stiffness = assemble(matrices, &sizes, 36)?;
        let found = of_dense(&stiffness)?.solve(&loads)?;
        let expected = stiffness.clone().cholesky().unwrap().solve(&loads);
        let bar = CONDITIONED_ROUND_OFF * condition(&stiffness);
        prop_assert!(relative_distance(&found, &expected) <= bar, "{:e}", relative_distance(&found, &expected));
    }

    /// The tip of a chain moves by the sum of the springs' flexibilities; springs over ten decades make condition
    /// numbers of 1e10, which is no reason to refuse.
    #[test]
    fn springs_in_series_add_their_flexibilities(decades in prop::collection::vec(0.0..10.0_f64, 1..8)) {
        let springs = decades.iter().map(|d| 10f64.powf(*d)).collect_vec();
        let structure = spring_chain(&springs, [true, false]);
        let tip = DMatrix::from_fn(springs.len(), 1, |row, _| f64::from(row + 1 == springs.len()));
        let deflections = factorized(&structure)?.solve(&tip)?;
        let bar = CONDITIONED_ROUND_OFF * condition(&dense(&structure));
        let mut expected = 0.0;
        for (deflection, spring) in deflections.iter().zip(&springs) {
            expected += 1.0 / spring;
            prop_assert!((deflection - expected).abs() <= bar * deflections.amax());
        }
    }

    #[test]
    fn a_positive_definite_matrix_of_condition_1e10_is_solved((stiffness, _) in positive_definite(9, 10.0), loads in loads(9)) {
        let found = of_dense(&stiffness)?.solve(&loads)?;
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
    let matrices = element_matrices(&structure).collect_vec();
    for sizes in [vec![1.0; 2], vec![1.0; 4]] {
        let words = format!("element sizes: {} x 1 instead of 3 x 1", sizes.len());
        assert_eq!(said(assemble(&matrices, &sizes, 3)), words);
    }
    assert_eq!(
        said(assemble(&matrices, &[1.0; 3], 2)),
        "degrees of freedom: 3 given or asked for; there must be 1 to 2"
    );
    let factor = factorized(&structure).unwrap();
    for (loads, words) in [
        (DMatrix::zeros(4, 2), "loads: 4 x 2 instead of 3 x 2"),
        (
            dmatrix![0.0; f64::NAN; 0.0],
            "loads of entry (1, 0) is NaN; it must be a finite number",
        ),
    ] {
        assert_eq!(said(factor.solve(&loads)), words);
    }
    assert_eq!(
        factor.solve(&DMatrix::zeros(3, 2)).unwrap(),
        DMatrix::zeros(3, 2)
    );
}

#[test]
fn bad_geometry_is_refused_by_its_element() {
    let structure = |kind: ElementKind, positions: &[[f64; 3]], grids: &[usize]| {
        let points = positions.iter().zip(1..);
        let points = points.map(|(&position, label)| grid(label, position, [false; 3]));
        let element = Element {
            label: 8,
            kind,
            grids: grids.to_vec(),
            size: 1.0,
            material: unit_material(),
        };
        said(Structure::new(points.collect(), vec![element]))
    };
    let with = |kind, positions: &[[f64; 3]]| {
        structure(kind, positions, &(1..=positions.len()).collect_vec())
    };
    let [a, b, c, d] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let (inside, higher) = ([0.25, 0.5, 0.0], [0.0, 2.0, 0.0]);
    let rod = "relative length of element 8 is 0; it must be above 1e-12";
    assert_eq!(with(ElementKind::Rod, &[c, c]), rod);
    // The same grid twice.
    assert_eq!(structure(ElementKind::Rod, &[c], &[1, 1]), rod);
    for kind in [ElementKind::ShearPanel, ElementKind::Membrane] {
        let angle = |corner: usize| format!("relative area of corner {corner} of element 8 is ");
        assert_eq!(
            with(kind, &[a, b, b, a]),
            "relative area of element 8 is 0; it must be above 1e-10"
        );
        for (positions, corner) in [
            ([d, a, inside, c], 3),
            // Corners that do not run round the perimeter.
            ([a, c, b, higher], 2),
        ] {
            let refused = with(kind, &positions);
            assert!(refused.starts_with(&angle(corner)), "{refused}");
        }
    }
}
