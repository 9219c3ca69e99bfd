//! The plan of a factorization, flexibility by half a solution, and shares of elements that no theory of elasticity made.

use crate::common::fill::{self, Fill};
use crate::common::log_log_slope;
use crate::common::matrices::relative_distance;
use crate::common::strategies::symmetric;
use crate::common::structures::{condition, sizes};
use crate::common::tolerances::{CONDITIONED_ROUND_OFF, FILL_ORDER, MATRIX_ROUND_OFF};
use corfem::method::assembly::{dense_stiffness, element_matrices};
use corfem::method::error::Error;
use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
use corfem::sparse::SparseMatrix;
use corfem::sparse::factorization::{Factor, FactorizationPlan};
use corfem::torque_box::Case;
use nalgebra::{DMatrix, Vector3};
use proptest::prelude::*;
use std::sync::Arc;

/// A square net of membranes and rods in the plane, swept, with one edge held and every grid free in x and y.
fn net(cells: usize) -> Structure {
    let label = |i: usize, j: usize| 1 + i + (cells + 1) * j;
    let material = Material::isotropic(1.0e7, 0.3).expect("a material");
    let place = |i: usize, j: usize| Vector3::new(i as f64 + 0.5 * j as f64, j as f64, 0.0);
    let all = || (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
    let grid = |(i, j)| Grid {
        label: label(i, j),
        position: place(i, j),
        constrained: [j == 0, j == 0, true],
    };
    let corners = |(i, j)| {
        vec![
            label(i, j),
            label(i + 1, j),
            label(i + 1, j + 1),
            label(i, j + 1),
        ]
    };
    let cells = all().filter(|at| at.0 < cells && at.1 < cells).map(corners);
    let element = |(row, grids)| Element {
        label: row + 1,
        kind: ElementKind::Membrane,
        grids,
        size: 0.1,
        material,
    };
    Structure::new(
        all().map(grid).collect(),
        cells.enumerate().map(element).collect(),
    )
    .expect("a structure")
}

fn plan(structure: &Structure) -> Arc<FactorizationPlan> {
    let elements = element_matrices(structure);
    Arc::new(FactorizationPlan::new(structure, &elements).expect("a plan"))
}

fn fill_of(structure: &Structure) -> Fill {
    let elements = element_matrices(structure);
    let fill = fill::of_factor(&plan(structure), &elements);
    // Dense blocks store zeros too.
    assert!(fill.needed <= fill.entries);
    fill
}

/// George (1973): by nested dissection the factor of an n × n net has of the order of n² log n entries, and n³ row by row. Between
/// 16 and 128 cells n² log n has the slope 2.3.
#[test]
fn fill_grows_as_nested_dissection_promises() {
    let cells = [16_usize, 32, 64, 128];
    let points: Vec<(f64, f64)> = cells
        .map(|n| (n as f64, fill_of(&net(n)).entries as f64))
        .to_vec();
    let found = log_log_slope(&points);
    assert!((found - 2.3).abs() <= FILL_ORDER, "{found}: {points:?}");
}

/// The same paper: the multiplications grow as n³, to which small nets come from below, where row by row they would as n⁴. The one
/// membrane of a net of one cell couples its four DOF, whose columns have four numbers and less.
#[test]
fn work_grows_as_nested_dissection_promises() {
    assert_eq!(fill_of(&net(1)).operations, 30.0);
    let points = [64_usize, 128].map(|n| (n as f64, fill_of(&net(n)).operations));
    let found = log_log_slope(&points);
    assert!((found - 3.0).abs() <= FILL_ORDER, "{found}: {points:?}");
}

#[test]
fn a_plan_of_other_elements_is_refused() {
    let (small, large) = (net(3), net(4));
    let elements = element_matrices(&large);
    let refused =
        Factor::of_planned_stiffness(&plan(&small), &elements, &sizes(&large), large.free_dof());
    assert!(
        matches!(
            refused,
            Err(Error::WrongShape {
                what: "degrees of freedom of the plan",
                ..
            })
        ),
        "{refused:?}"
    );
    let mut moved = elements.clone();
    moved.swap(0, 1);
    let refused =
        Factor::of_planned_stiffness(&plan(&large), &moved, &sizes(&large), large.free_dof());
    assert!(
        matches!(
            refused,
            Err(Error::WrongShape {
                what: "elements of the plan",
                ..
            })
        ),
        "{refused:?}"
    );
    assert!(
        Factor::of_planned_stiffness(&plan(&large), &elements, &sizes(&large), large.free_dof())
            .is_ok()
    );
}

#[test]
fn a_load_distribution_says_what_is_wrong_with_it() {
    let columns = |columns: &[Vec<(usize, f64)>]| {
        SparseMatrix::of_columns("load distribution", 3, columns).unwrap_err()
    };
    let refused = columns(&[vec![(0, 1.0)], vec![(3, 1.0)]]);
    assert_eq!(
        refused.to_string(),
        "rows of a matrix: 4 asked for, but there are only 3"
    );
    let refused = columns(&[vec![(2, f64::NAN)]]);
    assert!(
        matches!(
            refused,
            Error::NotFinite {
                what: "load distribution",
                row: 2,
                column: 0,
                ..
            }
        ),
        "{refused:?}"
    );
    let t = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 0.0, 0.0, 0.5, 2.0]);
    let sparse = SparseMatrix::of_dense("load distribution", &t).expect("finite");
    assert_eq!(sparse.entries(), [(0, 0, 1.0), (2, 0, 0.5), (2, 1, 2.0)]);
    assert_eq!((sparse.dense(), sparse.rows()), (t, 3));
}

proptest! {
    #![proptest_config(crate::common::config())]

    /// Half a solution is enough: WᵗW against TᵗK⁻¹T with nalgebra's dense Cholesky, on the box with any gages and any T.
    #[test]
    fn flexibility_is_that_of_whole_solutions(
        factors in prop::collection::vec(0.3..3.0_f64, 39),
        t in prop::collection::vec(prop::collection::vec((0..36_usize, -2.0..2.0_f64), 1..4), 1..6),
    ) {
        let model = Case::new(2).unwrap().model().unwrap();
        let (structure, elements) = (model.structure(), model.element_matrices());
        let sizes: Vec<f64> = sizes(structure).iter().zip(&factors).map(|(size, factor)| size * factor).collect();
        let factor = Factor::of_planned_stiffness(&plan(structure), elements, &sizes, structure.free_dof()).unwrap();
        let loads = SparseMatrix::of_columns("load distribution", 36, &t).unwrap();
        let found = factor.flexibility(&loads).unwrap();
        let stiffness = dense_stiffness(elements, &sizes, 36).unwrap();
        let deflections = stiffness.clone().cholesky().unwrap().solve(&loads.dense());
        let expected = loads.dense().tr_mul(&deflections);
        prop_assert!((&found - &expected).amax() <= CONDITIONED_ROUND_OFF * condition(&stiffness) * deflections.amax());
        prop_assert!(found == found.transpose());
        prop_assert!(relative_distance(&factor.solve(&loads.dense()).unwrap(), &deflections) <= CONDITIONED_ROUND_OFF * condition(&stiffness));
    }

    /// An element's share needs no theory of elasticity: matrices of another origin, indefinite ones among them, give B Kₑ Bᵗ,
    /// and all shares sum to K_D.
    #[test]
    fn shares_of_any_element_matrix_are_its_congruence(change in symmetric(12), strength in 0.0..0.02_f64) {
        let model = Case::new(1).unwrap().model().unwrap();
        let units = model.element_matrices().iter().map(|element| {
            let count = element.dof.len();
            &element.unit + strength * element.unit.amax() * change.view((0, 0), (count, count))
        });
        let units: Vec<DMatrix<f64>> = units.collect();
        let model = model.with_unit_stiffness(units.clone()).unwrap();
        let ones = vec![1.0; model.parameters().len()];
        // Changes beyond what the structure bears are refused, and are not this property's matter.
        let Ok(matrices) = model.matrices(&ones) else { return Ok(()) };
        let b = model.condense(&ones).unwrap().transformation;
        for (row, share) in matrices.shares.iter().enumerate() {
            let label = model.parameters()[row].members[0];
            let at = model.structure().elements().iter().position(|element| element.label == label).unwrap();
            let rows = b.select_rows(&model.element_matrices()[at].dof);
            let expected = model.structure().elements()[at].size * rows.tr_mul(&(&units[at] * &rows));
            let scale = model.structure().elements()[at].size * units[at].amax() * rows.amax().powi(2);
            prop_assert!((share.matrix() - expected).amax() <= MATRIX_ROUND_OFF * scale);
        }
    }
}
