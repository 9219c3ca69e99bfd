//! Small structures with known answers, and strategies of structures and their sizes.

pub use crate::common::known::lumped_mass;
use crate::prelude::*;
use corfem::chain::rods;

/// A material of which a rod of length one and area k is a spring of stiffness k.
pub fn unit_material() -> Material {
    Material::isotropic(1.0, 0.25).unwrap()
}

pub fn grid(label: usize, position: [f64; 3], constrained: [bool; 3]) -> Grid {
    Grid {
        label,
        position: position.into(),
        constrained,
    }
}

pub fn rod(label: usize, ends: [usize; 2], area: f64) -> Element {
    Element {
        label,
        kind: ElementKind::Rod,
        grids: ends.to_vec(),
        size: area,
        material: unit_material(),
    }
}

/// Stiffness of spring s of a chain of `mass_count` masses, lbf/in (d × d): spring 0 holds mass 0 to the ground, spring s joins
/// masses s - 1 and s, and spring d, if there is one, holds the last mass to the ground. Any other spring touches no mass.
pub fn spring_stiffness(mass_count: usize, spring: usize, stiffness: f64) -> DMatrix<f64> {
    let mut ends = DVector::zeros(mass_count);
    if spring < mass_count {
        ends[spring] = 1.0;
    }
    if (1..=mass_count).contains(&spring) {
        ends[spring - 1] = -1.0;
    }
    stiffness * &ends * ends.transpose()
}

/// Springs in a row along x between grids 1, 2, …, free along x alone; `constrained` says which ends are fixed.
pub fn spring_chain(springs: &[f64], constrained: [bool; 2]) -> Structure {
    rods(springs, constrained).unwrap()
}

/// Three springs in a row of stiffness 2, 4 and 8, fixed at one end, with T and M the identity.
pub fn chain_model(parameters: Vec<Parameter>) -> Result<FiniteElementModel, Error> {
    let identity = eye(3);
    FiniteElementModel::new(
        spring_chain(&[2.0, 4.0, 8.0], [true, false]),
        identity.clone(),
        identity,
        parameters,
    )
}

/// A four-bar linkage in the xz-plane: grids 1 and 2 fixed, 3 and 4 free in the plane, rods 1-4, 4-3, 3-2 and, if it is
/// braced, 1-3. Without the brace one motion is free, in which no DOF is without stiffness.
pub fn linkage(apex: [[f64; 2]; 2], areas: [f64; 4], braced: bool) -> Structure {
    let free = [false, true, false];
    let grids = vec![
        grid(1, [0.0, 0.0, 0.0], [true; 3]),
        grid(2, [1.0, 0.0, 0.0], [true; 3]),
        grid(3, [apex[0][0], 0.0, apex[0][1]], free),
        grid(4, [apex[1][0], 0.0, apex[1][1]], free),
    ];
    let ends = [[1, 4], [4, 3], [3, 2], [1, 3]];
    let rods = (0..if braced { 4 } else { 3 })
        .map(|k| rod(k + 1, ends[k], areas[k]))
        .collect();
    Structure::new(grids, rods).unwrap()
}

/// Feet of a linkage a unit apart, its upper corners leaning either way by up to 0.4 and 0.5 to 1.5 high, its areas
/// within a factor of a hundred. Shrinks to an upright frame.
pub fn linkage_data() -> impl Strategy<Value = ([[f64; 2]; 2], [f64; 4])> {
    let lean = -0.4..0.4_f64;
    let height = 0.5..1.5_f64;
    (
        (lean.clone(), height.clone(), lean, height),
        prop::array::uniform4(-1.0..1.0_f64),
    )
        .prop_map(|((x3, z3, x4, z4), decades)| {
            ([[1.0 + x3, z3], [x4, z4]], decades.map(|d| 10f64.powf(d)))
        })
}

/// Gages or areas of `count` elements over two decades, 0.003 to 0.3: condition numbers of the box up to some 1e8.
pub fn sizes_of(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec((-1.0..1.0_f64).prop_map(|d| 0.03 * 10f64.powf(d)), count)
}

/// Gages and areas as a structure has them.
pub fn sizes(structure: &Structure) -> Vec<f64> {
    structure
        .elements()
        .iter()
        .map(|element| element.size)
        .collect()
}

/// The stiffness of a structure by dense assembly.
pub fn dense(structure: &Structure) -> DMatrix<f64> {
    let matrices = element_matrices(structure).collect_vec();
    assemble(&matrices, &sizes(structure), structure.free_dof().len()).unwrap()
}

/// The stiffness of a structure, factorized.
pub fn factorized(structure: &Structure) -> Result<Factor, Error> {
    of_dense(&dense(structure))
}

/// A stiffness, factorized.
pub fn of_dense(stiffness: &DMatrix<f64>) -> Result<Factor, Error> {
    Factor::new(
        "stiffness",
        &SparseMatrix::of_dense("stiffness", stiffness)?,
    )
}

/// A stiffness scaled to unit diagonal, and the scale.
pub fn unit_diagonal(stiffness: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let scale = stiffness.diagonal().map(|entry| 1.0 / entry.sqrt());
    let scaled = DMatrix::from_fn(stiffness.nrows(), stiffness.ncols(), |row, column| {
        scale[row] * stiffness[(row, column)] * scale[column]
    });
    (scaled, scale)
}

/// Condition number of a stiffness scaled to unit diagonal, by nalgebra.
pub fn condition(stiffness: &DMatrix<f64>) -> f64 {
    let values = unit_diagonal(stiffness).0.symmetric_eigenvalues();
    values.max() / values.min()
}

/// The motions a stiffness does not resist, one per column, by nalgebra: of the unit-diagonal stiffness those
/// eigenvectors whose eigenvalue is zero to round-off, in physical units.
pub fn free_motions(stiffness: &DMatrix<f64>) -> DMatrix<f64> {
    let (scaled, scale) = unit_diagonal(stiffness);
    let eigen = scaled.symmetric_eigen();
    let free = (0..scale.len())
        .filter(|&k| eigen.eigenvalues[k].abs() < super::tolerances::MATRIX_ROUND_OFF)
        .collect_vec();
    DMatrix::from_diagonal(&scale) * eigen.eigenvectors.select_columns(&free)
}
