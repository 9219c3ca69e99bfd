//! Changes of mass: masses of elements and points as parameters of a whole model, and their derivatives.

use crate::prelude::*;

/// Aluminum, lbf·s²/in⁴.
pub const DENSITY: f64 = 2.5e-4;
/// Elements of the box, its free DOF, and its dynamic points.
const ELEMENTS: usize = 39;
const FREE: usize = 36;
const POINTS: usize = 9;

/// Part of the box that is a parameter.
#[derive(Debug, Clone, Copy)]
pub enum Part {
    /// The stiffness of an element.
    Stiffness(usize),
    /// The mass of an element.
    ElementMass(usize),
    /// The mass of a dynamic point, from zero.
    PointMass(usize),
}

pub fn point_masses() -> Vec<Part> {
    (0..POINTS).map(Part::PointMass).collect()
}

fn element_masses() -> Vec<Part> {
    (1..=ELEMENTS).map(Part::ElementMass).collect()
}

/// The box of Case 2 at its test gages as the paper has it, with a density, of which that model knows nothing.
fn the_box(density: f64) -> FiniteElementModel {
    let case = case_of(2);
    let model = case.model_with(&[0.010; 15]).unwrap();
    let mut elements = model.structure().elements().to_vec();
    for element in &mut elements {
        element.material.density = density;
    }
    let grids = model.structure().grids().to_vec();
    let all = (1..=ELEMENTS).map(|label| Parameter::new(label, &[label]));
    FiniteElementModel::new(
        Structure::new(grids, elements).unwrap(),
        model.load_distribution().clone(),
        model.mass().clone(),
        all.collect(),
    )
    .unwrap()
}

/// The box at all its DOF with the masses of its elements, those of its points multiplied by factors, and sensors at these.
fn whole_box(
    parts: &[Part],
    density: f64,
    point_factors: [f64; POINTS],
) -> (WholeModel, SparseMatrix) {
    let model = the_box(density);
    let (structure, t) = (model.structure(), model.load_distribution());
    let (elements, unit) = (structure.elements(), model.element_matrices());
    let stiffness_of = |label: usize| {
        let row = label - 1;
        assemble(&unit[row..=row], &[elements[row].size], FREE).unwrap()
    };
    let mass_of = |label: usize| {
        let (element, corners) = (&elements[label - 1], &structure.corners()[label - 1]);
        let mut mass = zero_square(FREE);
        for (row, lumped) in lumped_masses(structure, element, corners) {
            mass[(row, row)] += lumped;
        }
        mass
    };
    let mass_at = |point: usize| {
        let (own, motion) = (model.mass()[(point, point)], t.column(point));
        point_factors[point] * own * motion * motion.transpose()
    };
    let share = |part: &Part| match *part {
        Part::Stiffness(label) => ParameterMatrix::Stiffness(stiffness_of(label)),
        Part::ElementMass(label) => ParameterMatrix::Mass(mass_of(label)),
        Part::PointMass(point) => ParameterMatrix::Mass(mass_at(point)),
    };
    let shares = parts.iter().map(share).collect_vec();
    let stiffness: DMatrix<f64> = (1..=ELEMENTS).map(stiffness_of).sum();
    let of_elements: DMatrix<f64> = (1..=ELEMENTS).map(mass_of).sum();
    let of_points: DMatrix<f64> = (0..POINTS).map(mass_at).sum();
    let (whole, _) = of_dense(&stiffness, &(of_elements + of_points), &shares).unwrap();
    (whole, sparse(&t.transpose()).unwrap())
}

/// The same condensed to its dynamic points, with a sensor at each.
pub fn boxed(
    parts: &[Part],
    density: f64,
    point_factors: [f64; POINTS],
) -> (WholeModel, SparseMatrix) {
    let (whole, sensors) = whole_box(parts, density, point_factors);
    let ones = vec![1.0; parts.len()];
    let (condensed, mass) = condensed(&whole, &ones, &sensors).unwrap();
    let b = condensed.transformation.transpose();
    let through = |parameter: &WholeParameter| match &parameter.share {
        WholeShare::Stiffness(share) => share.through(&b).map(ParameterMatrix::Stiffness),
        WholeShare::Mass(share) => share.through(&b).map(ParameterMatrix::Mass),
    };
    let shares: Result<Vec<_>, Error> = whole.parameters().iter().map(through).collect();
    of_dense(&condensed.stiffness, &mass, &shares.unwrap()).unwrap()
}

/// The nine lowest modes of a first model.
pub fn modes(model: &WholeModel) -> Modes {
    let ones = vec![1.0; model.parameters().len()];
    model.modes(&ones, POINTS).unwrap().vibrations
}

/// The analysis of a model's nine lowest modes.
pub fn analyze(
    (model, sensors): &(WholeModel, SparseMatrix),
    factors: &[f64],
    test: &Modes,
) -> Result<SensorModel, Error> {
    model.analyze(factors, sensors, test, by_sorting(), POINTS)
}

#[test]
fn dynamic_mass_holds_the_kinetic_energy_of_the_structural_mass() {
    // (A.9): q_Dᵗ M_D q_D = q_Sᵗ M_S q_S with q_S = Bᵗ q_D, M_S put together here entry by entry.
    let model = the_box(DENSITY);
    let structure = model.structure();
    let b_t = model.condense(&[1.0; ELEMENTS]).unwrap().transformation;
    let mut structural = zero_square(FREE);
    for (element, corners) in structure.elements().iter().zip(structure.corners()) {
        let volumes = corner_volumes(element.kind, corners);
        for (grid, volume) in element.grids.iter().zip(volumes) {
            for direction in 0..3 {
                if let Some(dof) = structure.free_dof_index(*grid, direction) {
                    structural[(dof, dof)] += DENSITY * element.size * volume;
                }
            }
        }
    }
    let expected = dynamic_mass(&structural, &b_t).unwrap() + model.mass();
    let (whole, sensors) = whole_box(&element_masses(), DENSITY, [1.0; POINTS]);
    let (_, dynamic) = condensed(&whole, &[1.0; ELEMENTS], &sensors).unwrap();
    assert_relative_eq!(
        dynamic,
        expected,
        epsilon = MATRIX_ROUND_OFF * expected.amax()
    );
    assert!(
        (dynamic - model.mass()).trace() > model.mass()[(2, 2)],
        "the elements weigh more than the smallest point mass"
    );
}

/// Shares add up at all DOF, and through the modes, whose mass is one.
#[test]
fn mass_shares_sum_to_the_mass() {
    let parts = [point_masses(), element_masses()].concat();
    let model = whole_box(&parts, DENSITY, [1.0; POINTS]);
    let test = seen_by(&model.1, &modes(&model.0));
    for factors in [
        vec![1.0; 48],
        (0..48).map(|e| 0.6 + 0.02 * e as f64).collect(),
    ] {
        let (_, mass) = model.0.at(&factors).unwrap();
        let own = |(parameter, factor): (&WholeParameter, &f64)| match &parameter.share {
            WholeShare::Mass(share) => *factor * share.dense(),
            other => panic!("{other:?}"),
        };
        let sum: DMatrix<f64> = model.0.parameters().iter().zip(&factors).map(own).sum();
        let mass = mass.dense();
        assert_relative_eq!(sum, mass, epsilon = MATRIX_ROUND_OFF * mass.amax());
        let analysis = analyze(&model, &factors, &test).unwrap();
        let through = |share: &ParameterMatrix| match share {
            ParameterMatrix::Mass(share) => share.clone(),
            other => panic!("{other:?}"),
        };
        let sum: DMatrix<f64> = analysis.shares().iter().map(through).sum();
        let one = eye(POINTS);
        assert_relative_eq!(sum, one, epsilon = MATRIX_ROUND_OFF);
    }
}

#[test]
fn mass_factors_leave_the_stiffness_alone() {
    let stiffness = (1..=ELEMENTS).map(Part::Stiffness).collect_vec();
    let parts = [stiffness, element_masses()].concat();
    let (model, sensors) = whole_box(&parts, DENSITY, [1.0; POINTS]);
    let at = |mass_factor: f64| {
        let factors = [[1.0; ELEMENTS], [mass_factor; ELEMENTS]].concat();
        let (stiffness, _) = model.at(&factors).unwrap();
        let (condensed, mass) = condensed(&model, &factors, &sensors).unwrap();
        (stiffness, condensed, mass)
    };
    let (light, heavy) = (at(1.0), at(2.0));
    assert_eq!(light.0, heavy.0);
    assert_eq!(light.1.stiffness, heavy.1.stiffness);
    assert_eq!(light.1.transformation, heavy.1.transformation);
    let points = the_box(DENSITY).mass().clone();
    let (one, two) = (light.2 - &points, heavy.2 - points);
    assert_relative_eq!(2.0 * one, two, epsilon = MATRIX_ROUND_OFF * two.amax());
}

/// The box with point masses off by up to 30 %, stiffness of panels and masses as parameters, and the modes of the right one.
pub fn both() -> ((WholeModel, SparseMatrix), Modes) {
    let (truth, _) = boxed(&point_masses(), DENSITY, [1.0; POINTS]);
    let wrong = [1.3, 0.8, 1.2, 0.75, 1.25, 0.9, 1.1, 0.85, 1.15];
    let panels = (1..=15).map(Part::Stiffness).collect_vec();
    let parts = [panels, point_masses()].concat();
    (boxed(&parts, DENSITY, wrong), modes(&truth))
}

#[test]
fn mass_derivatives_are_central_differences() {
    let (model, test) = both();
    let problem = analyze(&model, &[1.0; 24], &test).unwrap();
    let state = problem.at(&[1.0; 24]).unwrap();
    let derivatives = problem.error_changes(&state).unwrap();
    assert_eq!(derivatives.len(), 24);
    for e in 0..24 {
        let e_s = |change: f64| {
            let mut factors = [1.0; 24];
            factors[e] += change;
            let there = analyze(&model, &factors, &test).unwrap();
            there.exact().errors.sum()
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

/// The change by factors on a model's parameters, seen through its modes.
fn change_by(problem: &SensorModel, factors: &[f64]) -> ModalChange {
    let k = problem.exact().modes.omega_squared();
    let (mut beta, mut alpha) = (zero_square(k.len()), zero_square(k.len()));
    for (share, factor) in problem.shares().iter().zip(factors) {
        match share {
            ParameterMatrix::Stiffness(matrix) => beta += (factor - 1.0) * matrix,
            ParameterMatrix::Mass(matrix) => alpha += (factor - 1.0) * matrix,
        }
    }
    ModalChange::of_vibrations(k, beta, alpha)
}

#[test]
fn converged_perturbation_by_stiffness_and_mass_is_the_eigensolution() {
    let (model, test) = both();
    let problem = analyze(&model, &[1.0; 24], &test).unwrap();
    let factors = (0..24)
        .map(|e| 1.0 + 0.05 * ((e * 5 % 7) as f64 - 3.0) / 3.0)
        .collect_vec();
    let ours = problem.at(&factors).unwrap();
    let change = change_by(&problem, &factors);
    let Perturbed { roots, mut shapes } = eigensolution(&change).unwrap();
    normalize_with_mass(&mut shapes, &change.alpha).unwrap();
    let exact = Modes::new(roots.map(f64::recip), problem.basis() * shapes).unwrap();
    for (a, b) in ours
        .modes
        .omega_squared()
        .iter()
        .zip(exact.omega_squared().iter())
    {
        assert_relative_eq!(*a, *b, max_relative = 1e2 * MATRIX_ROUND_OFF);
    }
    assert_relative_eq!(
        ours.modes.shapes(),
        exact.shapes(),
        epsilon = 1e4 * MATRIX_ROUND_OFF * exact.shapes().amax()
    );
    let expected = errors(&exact, &ours.pairing, problem.test()).unwrap();
    assert_relative_eq!(
        ours.errors.sum(),
        expected.sum(),
        max_relative = 1e4 * MATRIX_ROUND_OFF
    );
}

/// A gage has nothing to do with mass. Twice the stiffness everywhere leaves $B$ and the mass alone, and every squared frequency
/// doubles; were the mass to follow the gages, they would not. The density is a hundred times aluminum's, so that it shows.
#[test]
fn gages_twice_as_thick_double_every_squared_frequency() {
    let stiffness = (1..=ELEMENTS).map(Part::Stiffness).collect_vec();
    let (model, sensors) = whole_box(&stiffness, 100.0 * DENSITY, [1.0; POINTS]);
    let of_paper = the_box(100.0 * DENSITY);
    let mass = |factor: f64| {
        let condensed = condensed(&model, &[factor; ELEMENTS], &sensors);
        condensed.unwrap().1
    };
    let (first, thick) = (mass(1.0), mass(2.0));
    assert!(
        first.trace() > 1.1 * of_paper.mass().trace(),
        "elements have a mass of their own"
    );
    assert_relative_eq!(thick, first, epsilon = MATRIX_ROUND_OFF * first.amax());
    let of_analysis = of_paper.matrices(&[2.0; ELEMENTS]).unwrap().mass;
    assert_eq!(of_analysis, *of_paper.mass());
    let of_whole = |factor: f64| {
        let found = model.modes(&[factor; ELEMENTS], POINTS).unwrap();
        found.vibrations.omega_squared().clone()
    };
    let of_paper = |factor: f64| {
        let found = of_paper.modes(&[factor; ELEMENTS]).unwrap();
        found.omega_squared().clone()
    };
    assert_times(2.0, &of_whole(1.0), &of_whole(2.0));
    assert_times(2.0, &of_paper(1.0), &of_paper(2.0));
}

fn assert_times(factor: f64, first: &DVector<f64>, other: &DVector<f64>) {
    assert_relative_eq!(
        *other,
        factor * first,
        max_relative = 1e2 * MATRIX_ROUND_OFF
    );
}
