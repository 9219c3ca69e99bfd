//! One law for gage and mass, for the model and for its deck: stiffness factors leave every mass alone.

use crate::contents::s2_parameters_mass::DENSITY;
use crate::prelude::*;

/// Structural DOF of the box, all of them dynamic here.
const DOF: usize = 36;
const COVERS: [usize; 6] = [2, 4, 8, 9, 11, 15];
const WEBS: [usize; 9] = [1, 3, 5, 6, 7, 10, 12, 13, 14];

/// What differs from the first box.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Changed {
    Stiffness,
    Mass,
    Both,
}

/// The box of Case 2 with point masses at every DOF that is free, and densities of its covers, webs and rods, or zeros.
///
/// With all these DOF dynamic nothing is condensed, so that the modes of the model are those of the structure. Its parameters are the
/// stiffness of covers and of webs.
fn whole_box([covers, webs, rods]: [f64; 3], points: &[f64]) -> FiniteElementModel {
    let model = Case::new(2).and_then(|case| case.model()).unwrap();
    let mut elements = model.structure().elements().to_vec();
    for element in &mut elements {
        element.material.density = match element.label {
            label if COVERS.contains(&label) => covers,
            label if WEBS.contains(&label) => webs,
            _ => rods,
        };
    }
    let grids = model.structure().grids().to_vec();
    FiniteElementModel::new(
        Structure::new(grids, elements).unwrap(),
        eye(DOF),
        DMatrix::from_diagonal(&points.to_vec().into()),
        vec![
            Parameter::new("covers", &COVERS),
            Parameter::new("webs", &WEBS),
        ],
    )
    .unwrap()
}

/// Squared frequencies of a box with the masses of its points and those that its elements have at their first sizes.
fn roots(model: &FiniteElementModel, factors: &[f64]) -> DVector<f64> {
    let mass = model.mass() + DMatrix::from_diagonal(&lumped_mass(model.structure()));
    let stiffness = model.condense(factors).unwrap().stiffness;
    let modes = solve(&stiffness, &mass, DOF).unwrap();
    modes.omega_squared().clone()
}

/// Squared frequencies of the model, and of its deck written and read again.
fn both(model: &FiniteElementModel, factors: &[f64]) -> [Vec<f64>; 2] {
    let bulk = BulkData::from_model(model, factors, &[Vector3::zeros(); DOF]).unwrap();
    let text = bulk_text(&bulk).unwrap();
    let read = deck::read("box", text.as_bytes(), &[]).unwrap().model;
    let modes = deck::modes(&read, usize::MAX).unwrap().modes;
    [&roots(model, factors), modes.omega_squared()].map(|squared| squared.as_slice().to_vec())
}

properties! {
    #[test]
    fn modes_of_the_written_deck_are_those_of_the_model(
        stiffness in prop::array::uniform2(0.3..3.0_f64),
        masses in prop::array::uniform2(0.3..3.0_f64),
        changed in prop_oneof![Just(Changed::Stiffness), Just(Changed::Mass), Just(Changed::Both)],
        has_density in any::<bool>(),
        points in prop::collection::vec(0.002..0.02_f64, DOF),
    ) {
        let factors = if changed == Changed::Mass { [1.0; 2] } else { stiffness };
        let [covers, rods] = if changed == Changed::Stiffness { [1.0; 2] } else { masses };
        let density = if has_density { DENSITY } else { 0.0 };
        let model = whole_box([covers * density, density, rods * density], &points);
        let [own, written] = both(&model, &factors);
        prop_assert_eq!(written.len(), DOF);
        // A change of every stiffness and mass by a part changes every root by no more than that part of both. Round-off of
        // the flexibility is relative to its largest root, and the box is up to ten thousand times stiffer along its rods
        // than across: even there what is left is far below what a mass of another size would change.
        let spread = own[DOF - 1] / own[0];
        let tolerance = 2.0 * DECK_ROUNDING + ROUND_OFF * spread;
        prop_assert!(tolerance < DECK_ROOTS, "{}", spread);
        for (own, written) in own.iter().zip(&written) {
            prop_assert!(relative_error(own, written) < tolerance, "{own} {written} {tolerance}");
        }
    }
}
