//! The property that lets the fast forms stand in for the text: the modes of the whole model at the sensors are those of the text's
//! dense matrices, over random structures, the paper's cases and the delta wing.

use crate::prelude::*;

/// Condition beyond which round-off leaves less than the digits compared: of the structural stiffness scaled to unit diagonal, of the
/// dynamic stiffness, and of the squared frequencies.
const LARGEST_CONDITION: f64 = 1e6;
/// Relative distance of squared frequencies below which modes are compared as one subspace.
const CLUSTER: f64 = 1e-3;

/// The paper's box with every coordinate and mass off by as much as a tenth, whose elements have mass, and the stiffness of each of its 39
/// elements as a parameter.
fn random_model() -> impl Strategy<Value = FiniteElementModel> {
    let boxed = |(number, off, density): (usize, Vec<f64>, f64)| {
        let mut reconstruction = Reconstruction::embedded().ok()?;
        let mut off = off.into_iter();
        let numbers = reconstruction.grids.values_mut().flatten();
        numbers
            .chain(&mut reconstruction.masses)
            .zip(&mut off)
            .for_each(|(number, off)| *number *= off);
        let case = Case::from_reconstruction(number, reconstruction).ok()?;
        let bare = structure(&case.reconstruction, &case.panels, case.rod_area).ok()?;
        let mut elements = bare.elements().to_vec();
        for element in &mut elements {
            element.material.density = density;
        }
        let structure = Structure::new(bare.grids().to_vec(), elements).ok()?;
        let parameters = (1..=39).map(|label| Parameter::new(label, &[label]));
        let (t, mass) = (
            load_distribution(&case.reconstruction).ok()?,
            case.reconstruction.mass(),
        );
        let model = FiniteElementModel::new(structure, t, mass, parameters.collect()).ok()?;
        is_well_conditioned(&model).then_some(model)
    };
    let off = prop::collection::vec(0.9..1.1_f64, 60);
    (1..=4_usize, off, 1e-5..1e-3_f64).prop_filter_map("a box that is well conditioned", boxed)
}

fn is_well_conditioned(model: &FiniteElementModel) -> bool {
    let stiffness = dense(model.structure());
    let scale = stiffness.diagonal().map(|entry| 1.0 / entry.sqrt());
    let scaled = stiffness.component_mul(&(&scale * scale.transpose()));
    let is_fine = |values: DVector<f64>| values.min() * LARGEST_CONDITION >= values.max();
    let Ok(condensed) = model.condense(&vec![1.0; model.parameters().len()]) else {
        return false;
    };
    let (whole, _) = dense_modes(model, stiffness.nrows());
    is_fine(scaled.symmetric_eigenvalues())
        && is_fine(condensed.stiffness.symmetric_eigenvalues())
        && is_fine(whole.omega_squared().clone())
}

fn has_element_masses(model: &FiniteElementModel) -> bool {
    let mut elements = model.structure().elements().iter();
    elements.any(|element| element.material.density > 0.0)
}

/// The lowest modes at every structural DOF by dense matrices, or at the dynamic ones where all the mass is.
fn dense_modes(model: &FiniteElementModel, count: usize) -> (Modes, DMatrix<f64>) {
    let t = model.load_distribution();
    if !has_element_masses(model) {
        let condensed = model.condense(&vec![1.0; model.parameters().len()]);
        let stiffness = condensed.unwrap().stiffness;
        let modes = solve(&stiffness, model.mass(), count).unwrap();
        let seen = modes.shapes().clone();
        return (modes, seen);
    }
    let lumped = DMatrix::from_diagonal(&lumped_mass(model.structure()));
    let mass = lumped + t * model.mass() * t.transpose();
    let modes = solve(&dense(model.structure()), &mass, count).unwrap();
    let seen = t.tr_mul(modes.shapes());
    (modes, seen)
}

fn assert_same_modes(model: &FiniteElementModel, count: usize) {
    let (whole, sensors) = whole::of(model).unwrap();
    let found = whole
        .modes(&vec![1.0; whole.parameters().len()], count)
        .unwrap()
        .vibrations;
    let seen = sensors.times(found.shapes()).unwrap();
    let (plain, plain_seen) = dense_modes(model, count);
    let squares = plain.omega_squared();
    for (mode, (a, b)) in squares.iter().zip(found.omega_squared()).enumerate() {
        assert_within((b / a).sqrt(), 1.0, TWO_PROGRAMS);
        // A cluster at the end of the list may go on behind it.
        let is_near = |other: &usize| relative_error(squares[*other], a) < CLUSTER;
        let cluster = (0..count).filter(is_near).collect_vec();
        if cluster.contains(&(count - 1)) && cluster.len() > 1 {
            continue;
        }
        let (span, shape) = (
            plain_seen.select_columns(&cluster),
            seen.column(mode).into_owned(),
        );
        let part = span.clone().svd(true, true).solve(&shape, 0.0).unwrap();
        let apart = (span * part - &shape).norm() / seen.amax();
        assert!(apart <= TWO_PROGRAMS, "shape {mode}: {apart:e}");
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn a_random_structure_has_the_same_modes_at_its_sensors(model in random_model()) {
        assert_same_modes(&model, 9);
    }
}

#[test]
fn every_case_has_the_same_modes() {
    for number in CASES {
        let model = case_of(number).model().unwrap();
        assert_same_modes(&model, 9);
    }
}

#[test]
fn the_delta_wing_has_the_same_modes() {
    let model = first_model();
    assert_same_modes(&model, 10);
}
