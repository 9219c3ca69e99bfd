//! One law for gage and mass, for the model and for its deck: stiffness factors leave every mass alone, mass factors every
//! stiffness.

use crate::common::tolerances::{DECK_ROOTS, DECK_ROUNDING, ROUND_OFF};
use crate::spec::s2_parameters_mass::DENSITY;
use corfem::files::deck::{self, BulkData, bulk_data};
use corfem::method::model::{FiniteElementModel, Parameter, Scaled};
use corfem::method::modes::solve;
use corfem::method::structure::Structure;
use corfem::torque_box::Case;
use nalgebra::{DMatrix, Vector3};
use proptest::prelude::*;

/// Structural DOF of the box, all of them dynamic here.
pub const DOF: usize = 36;
const COVERS: [usize; 6] = [2, 4, 8, 9, 11, 15];
const WEBS: [usize; 9] = [1, 3, 5, 6, 7, 10, 12, 13, 14];

/// Which factors differ from one.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Changed {
    Stiffness,
    Mass,
    Both,
}

/// The box of Case 2 with mass at every DOF that is free: panels and rods with a density or without one, and point masses.
///
/// With all these DOF dynamic, nothing is condensed but what has no mass, so that the modes of the model are those of
/// the structure. Its parameters are the stiffness of covers and of webs, the mass of covers and of rods, and point masses.
pub fn whole_box(density: f64, points: &[f64]) -> FiniteElementModel {
    let model = Case::new(2).and_then(|case| case.model()).expect("a model");
    let mut elements = model.structure().elements().to_vec();
    for element in &mut elements {
        element.material.density = density;
    }
    let grids = model.structure().grids().to_vec();
    let rods: Vec<usize> = (16..=39).collect();
    FiniteElementModel::new(
        Structure::new(grids, elements).expect("a structure"),
        DMatrix::identity(DOF, DOF),
        DMatrix::from_diagonal(&points.to_vec().into()),
        vec![
            Parameter::group("covers", &COVERS),
            Parameter::group("webs", &WEBS),
            Parameter::of("mass of covers", Scaled::ElementMass, &COVERS),
            Parameter::of("mass of rods", Scaled::ElementMass, &rods),
            Parameter::of(
                "mass at the tip",
                Scaled::PointMass,
                &(0..12).collect::<Vec<_>>(),
            ),
            Parameter::of(
                "mass inboard",
                Scaled::PointMass,
                &(24..36).collect::<Vec<_>>(),
            ),
        ],
    )
    .expect("a model")
}

/// Squared frequencies of the model, and of its deck written and read again.
fn both(model: &FiniteElementModel, factors: &[f64]) -> [Vec<f64>; 2] {
    let dynamic = model.matrices(factors).expect("an analysis");
    let own = solve(&dynamic.stiffness, &dynamic.mass, DOF).expect("modes");
    let bulk = BulkData::from_model(model, factors, &[Vector3::zeros(); DOF]).expect("bulk data");
    let text = bulk_data(&bulk).expect("a deck");
    let read = deck::read("box", text.as_bytes(), &[])
        .expect("it reads")
        .model;
    let modes = deck::modes(&read, usize::MAX).expect("modes").modes;
    [own.omega_squared(), modes.omega_squared()].map(|squared| squared.as_slice().to_vec())
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn modes_of_the_written_deck_are_those_of_the_model(
        drawn in prop::collection::vec(0.3..3.0_f64, 6),
        changed in prop_oneof![Just(Changed::Stiffness), Just(Changed::Mass), Just(Changed::Both)],
        has_density in any::<bool>(),
        points in prop::collection::vec((any::<bool>(), 0.002..0.02_f64), DOF),
    ) {
        let factors: Vec<f64> = drawn.iter().enumerate().map(|(row, &factor)| {
            let is_stiffness = row < 2;
            let stays = if is_stiffness { Changed::Mass } else { Changed::Stiffness };
            if changed == stays { 1.0 } else { factor }
        }).collect();
        // Without a density every DOF needs a point mass.
        let points: Vec<f64> = points
            .into_iter()
            .map(|(is_there, mass)| if is_there || !has_density { mass } else { 0.0 })
            .collect();
        let model = whole_box(if has_density { DENSITY } else { 0.0 }, &points);
        let [own, written] = both(&model, &factors);
        prop_assert_eq!(written.len(), DOF);
        // A change of every stiffness and mass by a part changes every root by no more than that part of both. Round-off of
        // the flexibility is relative to its largest root, and the box is up to ten thousand times stiffer along its rods
        // than across: even there what is left is far below what a mass of another size would change.
        let spread = own[DOF - 1] / own[0];
        let tolerance = 2.0 * DECK_ROUNDING + ROUND_OFF * spread;
        prop_assert!(tolerance < DECK_ROOTS, "{}", spread);
        for (own, written) in own.iter().zip(&written) {
            prop_assert!((own / written - 1.0).abs() < tolerance, "{own} {written} {tolerance}");
        }
    }
}

/// A gage half as large again leaves the mass of its element, and a mass factor its gage.
#[test]
fn the_deck_keeps_the_mass_of_the_first_size() {
    let model = whole_box(DENSITY, &[0.0; DOF]);
    let factors = [1.5, 1.0, 1.0, 4.0, 1.0, 1.0];
    let bulk = BulkData::from_model(&model, &factors, &[Vector3::zeros(); DOF]).expect("bulk data");
    let first = BulkData::from_structure(model.structure());
    for (element, before) in bulk.elements.iter().zip(&first.elements) {
        let gage = element.size / before.size;
        let mass = gage * element.material.density / before.material.density;
        let expected = match element.label {
            label if COVERS.contains(&label) => (1.5, 1.0),
            16.. => (1.0, 4.0),
            _ => (1.0, 1.0),
        };
        assert!((gage - expected.0).abs() < ROUND_OFF, "{}", element.label);
        assert!((mass - expected.1).abs() < ROUND_OFF, "{}", element.label);
    }
    assert!(bulk.masses.is_empty(), "no card for a mass of zero");
    // Heavier rods lower the lowest frequency, stiffer covers raise it.
    let lowest = |factors: &[f64]| both(&model, factors)[1][0];
    let start = lowest(&[1.0; 6]);
    assert!(lowest(&[1.5, 1.0, 1.0, 1.0, 1.0, 1.0]) > start);
    assert!(lowest(&[1.0, 1.0, 1.0, 4.0, 1.0, 1.0]) < start);
}
