//! Changes of mass: element and point masses, their derivatives, and correlation by mass or by both.

use crate::common::log_log_slope;
use crate::common::tolerances::{FORWARD_DIFFERENCE, MATRIX_ROUND_OFF, ROUND_OFF};
use approx::assert_relative_eq;
use corfem::assembly::{FactorizedStiffness, element_matrices};
use corfem::cases::Case;
use corfem::condensation::{condense, unit_mass_share};
use corfem::derivatives::{DERIVATIVE_STEP, error_derivatives};
use corfem::elements::mass::corner_volumes;
use corfem::error::Error;
use corfem::modal::{ModalProblem, Share};
use corfem::model::FiniteElementModel;
use corfem::modes::{Modes, solve};
use corfem::outer_loop::{Settings, correlate};
use corfem::parameters::{Parameter, Scaled};
use corfem::perturbation::UpdateRule;
use corfem::structure::Structure;
use nalgebra::DMatrix;

/// Aluminum, lbf·s²/in⁴.
const DENSITY: f64 = 2.5e-4;

/// The box of Case 2 at its test gages, its panels with a density, given parameters and point mass factors.
fn boxed(
    parameters: Vec<Parameter>,
    density: f64,
    point_factors: [f64; 9],
) -> Result<FiniteElementModel, Error> {
    let case = Case::new(2)?;
    let model = case.model_with(&[0.010; 15])?;
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

fn point_masses() -> Vec<Parameter> {
    (0..9)
        .map(|dof| Parameter::of(&format!("mass {dof}"), Scaled::PointMass(vec![dof])))
        .collect()
}

fn element_masses() -> Vec<Parameter> {
    (1..=39)
        .map(|label| Parameter::of(&format!("of {label}"), Scaled::ElementMass(vec![label])))
        .collect()
}

fn modes(model: &FiniteElementModel) -> Modes {
    let dynamic = model
        .analyze(&vec![1.0; model.parameters().len()])
        .expect("held");
    solve(&dynamic.stiffness, &dynamic.mass, 9).expect("solved")
}

#[test]
fn dynamic_mass_holds_the_kinetic_energy_of_the_structural_mass() {
    // (A.9): q_Dᵗ M_D q_D = q_Sᵗ M_S q_S with q_S = Bᵗ q_D, M_S put together here entry by entry.
    let model = boxed(element_masses(), DENSITY, [1.0; 9]).expect("a model");
    let structure = model.structure();
    let matrices = element_matrices(structure).expect("good panels");
    let sizes: Vec<f64> = structure
        .elements()
        .iter()
        .map(|element| element.size)
        .collect();
    let stiffness =
        FactorizedStiffness::new(&matrices, &sizes, structure.free_dof()).expect("held");
    let b_t = condense(&stiffness, model.load_distribution())
        .expect("independent")
        .transformation;
    let mut structural = DMatrix::zeros(36, 36);
    for element in structure.elements() {
        let volumes = corner_volumes(element.kind, &structure.corners(element)).expect("fits");
        for (grid, volume) in element.grids.iter().zip(volumes) {
            for direction in 0..3 {
                if let Some(dof) = structure.free_dof_index(*grid, direction) {
                    structural[(dof, dof)] += DENSITY * element.size * volume;
                }
            }
        }
    }
    let expected = b_t.tr_mul(&(structural * &b_t)) + model.mass();
    let dynamic = model.analyze(&[1.0; 39]).expect("held");
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
        let dynamic = model.analyze(&factors).expect("held");
        let mut sum = DMatrix::zeros(9, 9);
        for share in &dynamic.shares {
            assert!(matches!(share, Share::Mass(_)));
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
        model.analyze(&[1.0; 39]).expect("held"),
        model.analyze(&[2.0; 39]).expect("held"),
    );
    assert_eq!(light.stiffness, heavy.stiffness);
    assert_eq!(
        model.sizes(&[2.0; 39]).expect("sizes"),
        model.sizes(&[1.0; 39]).expect("sizes")
    );
    let (one, two) = (&light.mass - model.mass(), &heavy.mass - model.mass());
    assert_relative_eq!(2.0 * one, two, epsilon = MATRIX_ROUND_OFF * two.amax());
}

#[test]
fn unit_mass_share_is_symmetric_and_semidefinite() {
    let model = boxed(element_masses(), DENSITY, [1.0; 9]).expect("a model");
    let b_t = DMatrix::from_fn(36, 9, |i, j| ((i * 7 + j * 3) % 11) as f64 - 5.0);
    for element in model.element_matrices() {
        let share = unit_mass_share(&b_t, element);
        assert_eq!(share.shape(), (9, 9));
        assert_eq!(share, share.transpose());
        let smallest = share.clone().symmetric_eigenvalues().min();
        assert!(smallest >= -MATRIX_ROUND_OFF * share.amax());
    }
}

/// The box with point masses off by up to 30 %, stiffness of panels and masses as parameters.
fn both() -> (FiniteElementModel, Modes) {
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
    let problem =
        ModalProblem::new(&model.analyze(&[1.0; 24]).expect("held"), &test, 9).expect("reduced");
    let state = problem.start_state().expect("a state");
    let derivatives = error_derivatives(&problem, &state).expect("separate modes");
    for e in 0..24 {
        let e_s = |change: f64| {
            let mut factors = vec![1.0; 24];
            factors[e] += change;
            let state = problem.state_at(factors, UpdateRule::Eigensolution);
            state.expect("solved").errors.sum()
        };
        let h = DERIVATIVE_STEP;
        let (below, here, above) = (e_s(-h), e_s(0.0), e_s(h));
        let central = (above - below) / (2.0 * h);
        let curvature = (above - 2.0 * here + below) / (h * h);
        let forward = derivatives.error_change[e] / h;
        // What a forward difference of exact error sums differs by; first-order roots and shapes leave the rest,
        // which is of the same order in the step.
        let difference = (forward - central - 0.5 * curvature * h).abs();
        assert!(
            difference < FORWARD_DIFFERENCE,
            "parameter {e}: {forward} for {central}, off by {difference}"
        );
    }
    // Mass lowers what stiffness raises.
    assert!(derivatives.share_change.iter().all(|&change| change >= 0.0));
}

#[test]
fn perturbation_by_mass_approaches_the_eigensolution_of_the_changed_pencil() {
    let (model, test) = both();
    let problem =
        ModalProblem::new(&model.analyze(&[1.0; 24]).expect("held"), &test, 9).expect("reduced");
    let points: Vec<(f64, f64)> = [0.005, 0.01, 0.02, 0.04]
        .into_iter()
        .map(|size| {
            let factors: Vec<f64> = (0..24)
                .map(|e| 1.0 + if e % 3 == 0 { size } else { -size })
                .collect();
            let first = problem
                .state_at(factors.clone(), UpdateRule::FirstOrder)
                .expect("solved");
            let exact = problem
                .state_at(factors, UpdateRule::Eigensolution)
                .expect("solved");
            let pairs = first
                .modes
                .omega_squared
                .iter()
                .zip(exact.modes.omega_squared.iter());
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
    let problem =
        ModalProblem::new(&model.analyze(&[1.0; 24]).expect("held"), &test, 9).expect("reduced");
    let factors: Vec<f64> = (0..24)
        .map(|e| 1.0 + 0.05 * ((e * 5 % 7) as f64 - 3.0) / 3.0)
        .collect();
    let ours = problem
        .state_at(factors.clone(), UpdateRule::default())
        .expect("solved");
    let exact = problem
        .state_at(factors, UpdateRule::Eigensolution)
        .expect("solved");
    for (a, b) in ours
        .modes
        .omega_squared
        .iter()
        .zip(exact.modes.omega_squared.iter())
    {
        assert_relative_eq!(*a, *b, max_relative = 1e2 * MATRIX_ROUND_OFF);
    }
    assert_relative_eq!(
        ours.modes.shapes,
        exact.modes.shapes,
        epsilon = 1e4 * MATRIX_ROUND_OFF * exact.modes.shapes.amax()
    );
    assert_relative_eq!(
        ours.errors.sum(),
        exact.errors.sum(),
        max_relative = 1e4 * MATRIX_ROUND_OFF
    );
}

#[test]
fn wrong_point_masses_are_found() {
    let truth = boxed(point_masses(), 1e-12, [1.0; 9]).expect("a model");
    let wrong = [1.2, 0.85, 1.15, 0.8, 1.25, 0.9, 1.1, 0.85, 1.15];
    let model = boxed(point_masses(), 1e-12, wrong).expect("a model");
    let mut settings = Settings {
        least_passes: 2,
        ..Settings::default()
    };
    settings.inner.tolerance = 0.002;
    settings.later_inner_tolerance = 0.002;
    let ranges = model.factor_ranges().expect("no bounds");
    let result = correlate(
        |f| model.analyze(f),
        &modes(&truth),
        &ranges,
        &settings,
        |_, _| {},
    )
    .expect("it runs");
    assert!(result.converged);
    let last = result.passes.last().expect("a pass");
    for (dof, (factor, wrong)) in last.factors.iter().zip(wrong).enumerate() {
        // The tip's front mass of 0.0001 is a hundredth of its neighbors and hardly felt: 10 %.
        let bar = if dof == 2 { 0.1 } else { 0.02 };
        assert!(
            (factor * wrong - 1.0).abs() < bar,
            "mass {dof}: {}",
            factor * wrong
        );
    }
}

#[test]
fn stiffness_and_mass_change_together() {
    let (model, test) = both();
    let ranges = model.factor_ranges().expect("no bounds");
    let settings = Settings::default();
    let result =
        correlate(|f| model.analyze(f), &test, &ranges, &settings, |_, _| {}).expect("it runs");
    assert!(
        result.converged,
        "{:?}",
        result.passes.last().expect("a pass").check.errors
    );
    // Stiffness and mass scaled alike leave every mode alone, so the factors themselves need not be the true ones.
    let last = result.passes.last().expect("a pass");
    assert!(last.factors[..15].iter().any(|f| (f - 1.0).abs() > 0.01));
    assert!(last.factors[15..].iter().any(|f| (f - 1.0).abs() > 0.01));
}

#[test]
fn mass_limits_hold() {
    let wrong = [1.3, 0.8, 1.2, 0.75, 1.25, 0.9, 1.1, 0.85, 1.15];
    let range = corfem::step::Range::positive("factor", 0.9, 1.1).expect("a range");
    let parameters = point_masses()
        .into_iter()
        .map(|p| Parameter {
            factor_range: Some(range),
            ..p
        })
        .collect();
    let model = boxed(parameters, DENSITY, wrong).expect("a model");
    let truth = modes(&boxed(point_masses(), DENSITY, [1.0; 9]).expect("a model"));
    let ranges = model.factor_ranges().expect("bounds");
    let settings = Settings {
        most_passes: 2,
        ..Settings::default()
    };
    let result =
        correlate(|f| model.analyze(f), &truth, &ranges, &settings, |_, _| {}).expect("it runs");
    for pass in &result.passes {
        assert!(
            pass.factors
                .iter()
                .all(|factor| (0.9 - ROUND_OFF..=1.1 + ROUND_OFF).contains(factor))
        );
    }
    let held = result
        .passes
        .iter()
        .flat_map(|pass| &pass.factors)
        .any(|f| (f - 0.9).abs() < ROUND_OFF || (f - 1.1).abs() < ROUND_OFF);
    assert!(held, "some limit was reached");
}

#[test]
fn bad_mass_parameters_name_the_offender() {
    let unknown = boxed(
        vec![Parameter::of("far", Scaled::PointMass(vec![9]))],
        DENSITY,
        [1.0; 9],
    );
    assert!(
        matches!(unknown, Err(Error::UnknownDynamicDof { found: 9, count: 9, ref parameter }) if parameter == "far")
    );
    let unknown = boxed(
        vec![Parameter::of("far", Scaled::ElementMass(vec![40]))],
        DENSITY,
        [1.0; 9],
    );
    assert!(
        matches!(unknown, Err(Error::UnknownElement { element: 40, ref parameter }) if parameter == "far")
    );
    let twice = vec![
        Parameter::of("a", Scaled::PointMass(vec![3])),
        Parameter::of("b", Scaled::PointMass(vec![4, 3])),
    ];
    let shared = boxed(twice, DENSITY, [1.0; 9]);
    assert!(
        matches!(shared, Err(Error::SharedElement { element: 3, ref first, ref second }) if first == "a" && second == "b")
    );
    // The same element may have its stiffness in one parameter and its mass in another.
    let both = vec![
        Parameter::element(3, None),
        Parameter::of("mass of 3", Scaled::ElementMass(vec![3])),
    ];
    assert!(boxed(both, DENSITY, [1.0; 9]).is_ok());
    let empty = boxed(
        vec![Parameter::of("none", Scaled::PointMass(vec![]))],
        DENSITY,
        [1.0; 9],
    );
    assert!(matches!(
        empty,
        Err(Error::Empty {
            what: "members of a parameter"
        })
    ));
    assert!(matches!(
        boxed(vec![], DENSITY, [1.0; 9]),
        Err(Error::Empty { what: "parameters" })
    ));
    assert!(matches!(
        boxed(point_masses(), -1.0, [1.0; 9]),
        Err(Error::NotPositive {
            what: "density",
            ..
        })
    ));
}

#[test]
fn point_mass_coupled_to_others_cannot_be_scaled() {
    let model = boxed(point_masses(), DENSITY, [1.0; 9]).expect("a model");
    let mut mass = model.mass().clone();
    mass[(4, 6)] = 0.001;
    mass[(6, 4)] = 0.001;
    let parameters = |dof| vec![Parameter::of("p", Scaled::PointMass(vec![dof]))];
    let make = |dof| {
        let t = model.load_distribution().clone();
        FiniteElementModel::new(model.structure().clone(), t, mass.clone(), parameters(dof))
    };
    assert!(matches!(make(6), Err(Error::CoupledMass { dof: 6 })));
    assert!(make(5).is_ok());
}
