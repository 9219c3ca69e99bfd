//! The paper's torque box as a subject of properties.

use crate::common::structures::of_dense;
use crate::prelude::*;
use corfem::sparse::factorization::Factor;

/// One of the paper's four cases: shear or membrane covers, thick or thin rods, like gages or one far too thin.
pub fn case() -> impl Strategy<Value = Case> {
    (1..=4_usize).prop_map(case_of)
}

/// Factors within the bounds of one iteration, 0.55 to 1.50; they shrink to the lower one.
pub fn factors(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.55..=1.5_f64, count)
}

/// The model of a case with every one of its 39 elements a parameter, the rods too.
pub fn with_every_element(case: &Case) -> FiniteElementModel {
    with_parameters(
        case,
        (1..=39)
            .map(|label| Parameter::new(label, &[label]))
            .collect(),
    )
}

/// The model of a case with parameters of one's own.
pub fn with_parameters(case: &Case, parameters: Vec<Parameter>) -> FiniteElementModel {
    FiniteElementModel::new(
        structure(&case.reconstruction, &case.panels, case.rod_area).unwrap(),
        load_distribution(&case.reconstruction).unwrap(),
        case.reconstruction.mass(),
        parameters,
    )
    .unwrap()
}

/// A box with other ribs and mid points than the paper's: every rib's chord points any way in the plane, 1 to 20 in
/// long, with upright spars 0.2 to 4 in deep, not at one height; ribs up to 60 in from each other. Shrinks to one of
/// equal ribs.
pub fn reconstruction() -> impl Strategy<Value = Reconstruction> {
    let rib = (
        (-30.0..30.0_f64, -30.0..30.0_f64),
        (1.0..20.0_f64, -3.0..3.0_f64),
        prop::array::uniform2((-2.0..2.0_f64, 0.2..4.0_f64)),
    );
    (prop::array::uniform4(rib), 0.1..0.9_f64).prop_map(|(ribs, mid_chord_fraction)| {
        let mut grids = BTreeMap::new();
        for (number, ((x, y), (chord, angle), spars)) in ribs.into_iter().enumerate() {
            let ends = [(x, y), (x + chord * angle.cos(), y + chord * angle.sin())];
            for (spar, ((x, y), (height, depth))) in ends.into_iter().zip(spars).enumerate() {
                let upper = 4 * number + 2 * spar + 1;
                grids.insert(upper, [x, y, height + depth / 2.0]);
                grids.insert(upper + 1, [x, y, height - depth / 2.0]);
            }
        }
        Reconstruction {
            youngs_modulus: 1e7,
            poissons_ratio: 0.3,
            mid_chord_fraction,
            masses: vec![1.0; 9],
            grids,
        }
    })
}

/// The structural stiffness of a model at given sizes, dense and factorized.
pub fn stiffness(model: &FiniteElementModel, sizes: &[f64]) -> (DMatrix<f64>, Factor) {
    let count = model.structure().free_dof().len();
    let dense = assemble(model.element_matrices(), sizes, count).unwrap();
    let factor = of_dense(&dense).unwrap();
    (dense, factor)
}
