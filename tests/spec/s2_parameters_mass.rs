//! Changes of mass: element and point masses, their derivatives, and correlation by mass or by both.

use crate::common::log_log_slope;
use crate::common::tolerances::{FORWARD_DIFFERENCE, MATRIX_ROUND_OFF};
use approx::assert_relative_eq;
use corfem::method::appendix_a::condense;
use corfem::method::appendix_c::general::{ModalChange, first_order};
use corfem::method::assembly::dense_stiffness;
use corfem::method::assembly::element_matrices;
use corfem::method::derivatives::{DERIVATIVE_STEP, by_definition};
use corfem::method::elements::corner_volumes;
use corfem::method::error::Error;
use corfem::method::geometry::Geometry;
use corfem::method::model::{FiniteElementModel, ModalModel, Parameter, ParameterMatrix, Scaled};
use corfem::method::modes::ModeSet;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::structure::Structure;
use corfem::torque_box::Case;
use nalgebra::{DMatrix, DVector};

/// Aluminum, lbf·s²/in⁴.
pub const DENSITY: f64 = 2.5e-4;

/// The box of Case 2 at its test gages, its panels with a density, given parameters and point mass factors.
pub fn boxed(
    parameters: Vec<Parameter>,
    density: f64,
    point_factors: [f64; 9],
) -> Result<FiniteElementModel, Error> {
    let case = Case::new(2).expect("a case");
    let model = case.model_with(&[0.010; 15]).expect("a model");
    let mut elements = model.structure().elements().to_vec();
    for element in &mut elements {
        element.material = element.material.with_density(density)?;
    }
    let structure = Structure::new(model.structure().grids().to_vec(), elements)?;
    let mut mass = model.mass().clone();
    for (dof, factor) in point_factors.iter().enumerate() {
        mass[(dof, dof)] *= factor;
    }
    FiniteElementModel::new(
        structure,
        model.load_distribution().clone(),
        mass,
        parameters,
    )
}

pub fn point_masses() -> Vec<Parameter> {
    (0..9)
        .map(|dof| Parameter::of(&format!("mass {dof}"), Scaled::PointMass, &[dof]))
        .collect()
}

fn element_masses() -> Vec<Parameter> {
    (1..=39)
        .map(|label| Parameter::of(&format!("of {label}"), Scaled::ElementMass, &[label]))
        .collect()
}

pub fn modes(model: &FiniteElementModel) -> ModeSet {
    let factors = vec![1.0; model.parameters().len()];
    model.modes(&factors).expect("solved").into()
}

#[test]
fn dynamic_mass_holds_the_kinetic_energy_of_the_structural_mass() {
    // (A.9): q_Dᵗ M_D q_D = q_Sᵗ M_S q_S with q_S = Bᵗ q_D, M_S put together here entry by entry.
    let model = boxed(element_masses(), DENSITY, [1.0; 9]).expect("a model");
    let structure = model.structure();
    let matrices = element_matrices(structure);
    let sizes: Vec<f64> = structure
        .elements()
        .iter()
        .map(|element| element.size)
        .collect();
    let stiffness = dense_stiffness(&matrices, &sizes, 36).expect("36 free DOF");
    let b_t = condense(&stiffness, model.load_distribution())
        .expect("independent")
        .transformation;
    let mut structural = DMatrix::zeros(36, 36);
    for element in structure.elements() {
        let volumes = corner_volumes(
            &Geometry::new(element.kind, &structure.corners(element)).expect("fits"),
        );
        for (grid, volume) in element.grids.iter().zip(volumes) {
            for direction in 0..3 {
                if let Some(dof) = structure.free_dof_index(*grid, direction) {
                    structural[(dof, dof)] += DENSITY * element.size * volume;
                }
            }
        }
    }
    let expected = b_t.tr_mul(&(structural * &b_t)) + model.mass();
    let dynamic = model.matrices(&[1.0; 39]).expect("held");
    assert_eq!(dynamic.mass.shape(), (9, 9));
    assert_relative_eq!(
        dynamic.mass,
        expected,
        epsilon = MATRIX_ROUND_OFF * expected.amax()
    );
    let added = dynamic.mass - model.mass();
    assert!(
        added.trace() > model.mass()[(2, 2)],
        "the elements weigh more than the smallest point mass"
    );
}

#[test]
fn mass_shares_sum_to_the_mass() {
    let parameters = point_masses().into_iter().chain(element_masses()).collect();
    let model = boxed(parameters, DENSITY, [1.0; 9]).expect("a model");
    for factors in [
        vec![1.0; 48],
        (0..48).map(|e| 0.6 + 0.02 * e as f64).collect(),
    ] {
        let dynamic = model.matrices(&factors).expect("held");
        let mut sum = DMatrix::zeros(9, 9);
        for share in &dynamic.shares {
            assert!(matches!(share, ParameterMatrix::Mass(_)));
            sum += share.matrix();
        }
        assert_relative_eq!(
            sum,
            dynamic.mass,
            epsilon = MATRIX_ROUND_OFF * dynamic.mass.amax()
        );
    }
}

#[test]
fn mass_factors_leave_sizes_and_stiffness_alone() {
    let model = boxed(element_masses(), DENSITY, [1.0; 9]).expect("a model");
    let (light, heavy) = (
        model.matrices(&[1.0; 39]).expect("held"),
        model.matrices(&[2.0; 39]).expect("held"),
    );
    assert_eq!(light.stiffness, heavy.stiffness);
    assert_eq!(
        model.at(&[2.0; 39]).expect("sizes").sizes,
        model.at(&[1.0; 39]).expect("sizes").sizes
    );
    let (one, two) = (&light.mass - model.mass(), &heavy.mass - model.mass());
    assert_relative_eq!(2.0 * one, two, epsilon = MATRIX_ROUND_OFF * two.amax());
}

#[test]
fn unit_mass_share_is_symmetric_and_semidefinite() {
    let model = boxed(element_masses(), DENSITY, [1.0; 9]).expect("a model");
    for share in &model.matrices(&[1.0; 39]).expect("held").shares {
        let share = share.matrix();
        assert_eq!(share.shape(), (9, 9));
        assert_eq!(*share, share.transpose());
        let smallest = share.clone().symmetric_eigenvalues().min();
        assert!(smallest >= -MATRIX_ROUND_OFF * share.amax());
    }
}

/// The box with point masses off by up to 30 %, stiffness of panels and masses as parameters.
pub fn both() -> (FiniteElementModel, ModeSet) {
    let truth = boxed(point_masses(), DENSITY, [1.0; 9]).expect("a model");
    let wrong = [1.3, 0.8, 1.2, 0.75, 1.25, 0.9, 1.1, 0.85, 1.15];
    let parameters = (1..=15)
        .map(|label| Parameter::element(label, None))
        .chain(point_masses())
        .collect();
    (
        boxed(parameters, DENSITY, wrong).expect("a model"),
        modes(&truth),
    )
}

#[test]
fn mass_derivatives_are_central_differences() {
    let (model, test) = both();
    let problem = model
        .matrices(&[1.0; 24])
        .expect("held")
        .analyze(&test, Some(9))
        .expect("reduced");
    let state = ModalState::start(&problem);
    let derivatives = by_definition(&problem, &state).expect("separate modes");
    for e in 0..24 {
        let e_s = |change: f64| {
            let mut factors = vec![1.0; 24];
            factors[e] += change;
            let state = ModalState::at(&problem, factors, UpdateRule::Eigensolution);
            state.expect("solved").errors().sum()
        };
        let h = DERIVATIVE_STEP;
        let (below, here, above) = (e_s(-h), e_s(0.0), e_s(h));
        let central = (above - below) / (2.0 * h);
        let curvature = (above - 2.0 * here + below) / (h * h);
        let forward = derivatives[e] / h;
        // What a forward difference of exact error sums differs by; first-order roots and shapes leave the rest,
        // which is of the same order in the step.
        let difference = (forward - central - 0.5 * curvature * h).abs();
        assert!(
            difference < FORWARD_DIFFERENCE,
            "parameter {e}: {forward} for {central}, off by {difference}"
        );
    }
}

/// Squared circular frequencies at some factors by first order.
fn first_order_state(problem: &ModalModel, factors: &[f64]) -> DVector<f64> {
    let count = problem.exact().modes.len();
    let (mut beta, mut alpha) = (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
    for (share, factor) in problem.shares().iter().zip(factors) {
        match share {
            ParameterMatrix::Stiffness(matrix) => beta += (factor - 1.0) * matrix,
            ParameterMatrix::Mass(matrix) => alpha += (factor - 1.0) * matrix,
        }
    }
    let change = ModalChange::of_vibrations(problem.exact().modes.omega_squared(), beta, alpha);
    first_order(&change).expect("apart").roots.map(f64::recip)
}

#[test]
fn perturbation_by_mass_approaches_the_eigensolution_of_the_changed_pencil() {
    let (model, test) = both();
    let problem = model
        .matrices(&[1.0; 24])
        .expect("held")
        .analyze(&test, Some(9))
        .expect("reduced");
    let points: Vec<(f64, f64)> = [0.005, 0.01, 0.02, 0.04]
        .into_iter()
        .map(|size| {
            let factors: Vec<f64> = (0..24)
                .map(|e| 1.0 + if e % 3 == 0 { size } else { -size })
                .collect();
            let first = first_order_state(&problem, &factors);
            let exact =
                ModalState::at(&problem, factors, UpdateRule::Eigensolution).expect("solved");
            let pairs = first.iter().zip(exact.modes().omega_squared().iter());
            (
                size,
                pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max),
            )
        })
        .collect();
    let slope = log_log_slope(&points);
    assert!((1.9..2.2).contains(&slope), "{slope}");
}

#[test]
fn converged_perturbation_by_stiffness_and_mass_is_the_eigensolution() {
    let (model, test) = both();
    let problem = model
        .matrices(&[1.0; 24])
        .expect("held")
        .analyze(&test, Some(9))
        .expect("reduced");
    let factors: Vec<f64> = (0..24)
        .map(|e| 1.0 + 0.05 * ((e * 5 % 7) as f64 - 3.0) / 3.0)
        .collect();
    let ours = ModalState::at(&problem, factors.clone(), UpdateRule::default()).expect("solved");
    let exact = ModalState::at(&problem, factors, UpdateRule::Eigensolution).expect("solved");
    for (a, b) in ours
        .modes()
        .omega_squared()
        .iter()
        .zip(exact.modes().omega_squared().iter())
    {
        assert_relative_eq!(*a, *b, max_relative = 1e2 * MATRIX_ROUND_OFF);
    }
    assert_relative_eq!(
        ours.modes().shapes(),
        exact.modes().shapes(),
        epsilon = 1e4 * MATRIX_ROUND_OFF * exact.modes().shapes().amax()
    );
    assert_relative_eq!(
        ours.errors().sum(),
        exact.errors().sum(),
        max_relative = 1e4 * MATRIX_ROUND_OFF
    );
}

/// What a gage has to do with mass: nothing. Twice the stiffness everywhere leaves $B$ and the mass alone, and every squared
/// frequency doubles; were the mass to follow the gages, they would not. The density is a hundred times aluminum's, so that it shows.
#[test]
fn gages_twice_as_thick_double_every_squared_frequency() {
    let stiffness: Vec<Parameter> = (1..=39)
        .map(|label| Parameter::element(label, None))
        .collect();
    let model = boxed(stiffness, 100.0 * DENSITY, [1.0; 9]).expect("a model");
    let at = |factor: f64| model.matrices(&[factor; 39]).expect("held");
    let (first, thick) = (at(1.0), at(2.0));
    assert!(
        first.mass.trace() > 1.1 * model.mass().trace(),
        "elements have a mass of their own"
    );
    assert_relative_eq!(
        thick.mass,
        first.mass,
        epsilon = MATRIX_ROUND_OFF * first.mass.amax()
    );
    let [first, thick] = [1.0, 2.0].map(|factor| {
        model
            .modes(&[factor; 39])
            .expect("solved")
            .omega_squared()
            .clone()
    });
    assert_relative_eq!(thick, 2.0 * first, max_relative = 1e2 * MATRIX_ROUND_OFF);
}
