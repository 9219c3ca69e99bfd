//! The plan of a factorization, and shares of elements that no theory of elasticity made.

use crate::common::fill::{self, Fill};
use crate::prelude::*;

/// A square net of membranes and rods in the plane, swept, with one edge held and every grid free in x and y.
fn net(cells: usize) -> Structure {
    let label = |i: usize, j: usize| 1 + i + (cells + 1) * j;
    let material = Material::isotropic(1.0e7, 0.3).unwrap();
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
    .unwrap()
}

/// The order in which a matrix is eliminated that couples what these elements do.
fn order_of(count: usize, elements: &[ElementMatrix]) -> Vec<usize> {
    let coupled = |element: &ElementMatrix| {
        let pairs = element.dof.iter();
        let pairs = pairs.flat_map(|&a| element.dof.iter().map(move |&b| (a, b)));
        pairs
            .filter(|(a, b)| a != b)
            .flat_map(|(a, b)| [(a, b, -1.0), (a, a, 1.0)])
            .collect_vec()
    };
    let ground = (0..count).map(|row| (row, row, 1.0));
    let entries = elements.iter().flat_map(coupled).chain(ground).collect();
    let matrix = SparseMatrix::new("net", count, count, entries).unwrap();
    Factor::new("net", &matrix).unwrap().order().to_vec()
}

fn fill_of(structure: &Structure) -> Fill {
    let elements = element_matrices(structure).collect_vec();
    let order = order_of(structure.free_dof().len(), &elements);
    let fill = fill::of_order(&order, &elements);
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
    assert_within(found, 2.3, FILL_ORDER);
}

/// The same paper: the multiplications grow as n³, to which small nets come from below, where row by row they would as n⁴. The one
/// membrane of a net of one cell couples its four DOF, whose columns have four numbers and less.
#[test]
fn work_grows_as_nested_dissection_promises() {
    assert_eq!(fill_of(&net(1)).operations, 30.0);
    let points = [64_usize, 128].map(|n| (n as f64, fill_of(&net(n)).operations));
    let found = log_log_slope(&points);
    assert_within(found, 3.0, FILL_ORDER);
}

#[test]
fn a_factor_that_overflows_is_refused_by_its_row() {
    let coupled = vec![(0, 0, 1.0), (1, 1, 1.0), (0, 1, 1e200), (1, 0, 1e200)];
    let matrix = SparseMatrix::new("pair", 2, 2, coupled).unwrap();
    let error = Error::NotPositiveDefinite {
        what: "pair",
        row: 1,
    };
    assert_refused(Factor::new("pair", &matrix), error);
}

#[test]
fn a_load_distribution_says_what_is_wrong_with_it() {
    let columns = |columns: &[Vec<(usize, f64)>]| {
        SparseMatrix::of_columns("load distribution", 3, columns).unwrap_err()
    };
    let refused = columns(&[vec![(0, 1.0)], vec![(3, 1.0)]]);
    assert_eq!(
        refused.to_string(),
        "rows of a matrix: 4 given or asked for; there must be 1 to 3"
    );
    let refused = columns(&[vec![(2, f64::NAN)]]);
    assert!(
        matches!(
            refused,
            Error::Value {
                what: "load distribution",
                ref owner,
                expected: "a finite number",
                ..
            } if owner == "entry (2, 0)"
        ),
        "{refused:?}"
    );
    let t = dmatrix![1.0, 0.0; 0.0, 0.0; 0.5, 2.0];
    let sparse = SparseMatrix::of_dense("load distribution", &t).unwrap();
    assert_eq!(
        sparse.entries().collect_vec(),
        [(0, 0, 1.0), (2, 0, 0.5), (2, 1, 2.0)]
    );
    assert_eq!((sparse.dense(), sparse.rows()), (t, 3));
}

properties! {
    /// An element's share needs no theory of elasticity: matrices of another origin, indefinite ones among them, give B Kₑ Bᵗ,
    /// and all shares sum to K_D.
    #[test]
    fn shares_of_any_element_matrix_are_its_congruence(change in symmetric(12), strength in 0.0..0.02_f64) {
        let model = case_of(1).model()?;
        let units = model.element_matrices().iter().map(|element| {
            let count = element.dof.len();
            &element.unit + strength * element.unit.amax() * change.view((0, 0), (count, count))
        });
        let units = units.collect_vec();
        let model = model.with_unit_stiffness(units.clone())?;
        let ones = vec![1.0; model.parameters().len()];
        // Changes beyond what the structure bears are refused, and are not this property's matter.
        let Ok(matrices) = model.matrices(&ones) else { return Ok(()) };
        let b = model.condense(&ones)?.transformation;
        for (row, share) in matrices.shares.iter().enumerate() {
            let label = model.parameters()[row].elements[0];
            let at = model.structure().elements().iter().position(|element| element.label == label).unwrap();
            let rows = b.select_rows(&model.element_matrices()[at].dof);
            let expected = model.structure().elements()[at].size * rows.tr_mul(&(&units[at] * &rows));
            let scale = model.structure().elements()[at].size * units[at].amax() * rows.amax().powi(2);
            prop_assert!((share - expected).amax() <= MATRIX_ROUND_OFF * scale);
        }
    }
}
