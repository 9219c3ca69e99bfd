//! The method in one file: from element matrices to corrected gages, with nalgebra alone. `cargo run --example plain` prints the
//! history of the paper's four cases; only [`torque_box`], which says what the wing torque box is, comes from the crate. A test of
//! the specification holds it to the crate's own answers in 24 runs.
//!
//! It takes what it is given to be sound, for that is what makes it short. [`corfem::method`] is the same text with its reasons.

use nalgebra::{DMatrix, DVector};

type Matrix = DMatrix<f64>;
type Vector = DVector<f64>;

/// Why the method cannot go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// A matrix that must be positive definite is not.
    NotPositiveDefinite(&'static str),
    /// A change took the root of this mode below zero.
    LostRoot(usize),
    /// Two modes came so close that the denominator of (C.21) vanished.
    CloseModes(usize, usize),
    /// Recursive 1 did not settle in the orders allowed, or its residuals do not prove it; the last relative change of a root, and the
    /// bound on its error.
    Unsettled(f64, f64),
}

/// An element's stiffness for unit gage (or area) at the structural DOF it touches.
pub struct Element {
    pub dof: Vec<usize>,
    pub unit: Matrix,
}

/// $K_S = \sum_e s_e K_e$ for gages and areas $s_e$.
pub fn assemble(elements: &[Element], sizes: &[f64], dof_count: usize) -> Matrix {
    let mut stiffness = Matrix::zeros(dof_count, dof_count);
    for (element, size) in elements.iter().zip(sizes) {
        for (a, &row) in element.dof.iter().enumerate() {
            for (b, &column) in element.dof.iter().enumerate() {
                stiffness[(row, column)] += size * element.unit[(a, b)];
            }
        }
    }
    stiffness
}

/// The dynamic stiffness and the transformation (A.5, A.7, A.8): $K_D^{-1} = T^t K_S^{-1} T$, $B^t = K_S^{-1} T K_D$.
pub fn condense(stiffness: Matrix, t: &Matrix) -> Result<(Matrix, Matrix), Error> {
    let factor = stiffness
        .cholesky()
        .ok_or(Error::NotPositiveDefinite("structural stiffness"))?;
    let deflections = factor.solve(t);
    let flexibility = t
        .tr_mul(&deflections)
        .cholesky()
        .ok_or(Error::NotPositiveDefinite("dynamic flexibility"))?;
    let dynamic = flexibility.inverse();
    let transformation = deflections * &dynamic;
    Ok((dynamic, transformation))
}

/// An element's share of the dynamic stiffness, $B K_e B^t$ (A.9): only its own rows of $B^t$ take part.
pub fn share(element: &Element, size: f64, transformation: &Matrix) -> Matrix {
    let own = transformation.select_rows(&element.dof);
    size * own.tr_mul(&(&element.unit * &own))
}

/// Modes of vibration: $\omega^2$ in rad²/s², and shapes with $V^t M V = I$, one per column.
#[derive(Clone)]
pub struct Modes {
    pub omega_squared: Vector,
    pub shapes: Matrix,
}

/// The lowest `count` modes of $K v = \omega^2 M v$ (3): with $M = L L^t$ those of the symmetric $L^{-1} K L^{-t}$.
pub fn solve(stiffness: &Matrix, mass: &Matrix, count: usize) -> Result<Modes, Error> {
    let lower = mass
        .clone()
        .cholesky()
        .ok_or(Error::NotPositiveDefinite("mass"))?
        .unpack();
    let mut reduced = stiffness.clone();
    lower.solve_lower_triangular_mut(&mut reduced);
    reduced.transpose_mut();
    lower.solve_lower_triangular_mut(&mut reduced);
    let eigen = (0.5 * (&reduced + reduced.transpose())).symmetric_eigen();
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    order.truncate(count);
    let mut shapes = eigen.eigenvectors.select_columns(&order);
    lower.tr_solve_lower_triangular_mut(&mut shapes);
    Ok(Modes {
        omega_squared: eigen.eigenvalues.select_rows(&order),
        shapes,
    })
}

/// The analysis mode that answers each test mode, and the sign that turns it the same way.
#[derive(Clone)]
pub struct Pairing {
    pub mode: Vec<usize>,
    pub sign: Vec<f64>,
}

/// Pairs test modes with analysis modes by their cross-orthogonality $m = V_F^t M V_G$ (4): the entry closest to one first,
/// then the closest of what is left.
pub fn pair(cross: &Matrix) -> Pairing {
    let (analysis_count, test_count) = cross.shape();
    let mut candidates: Vec<(usize, usize)> = (0..test_count)
        .flat_map(|j| (0..analysis_count).map(move |i| (i, j)))
        .collect();
    let from_one = |(i, j): (usize, usize)| (1.0 - cross[(i, j)].abs()).abs();
    candidates.sort_by(|&a, &b| from_one(a).total_cmp(&from_one(b)));
    let mut partner = vec![None; test_count];
    for (i, j) in candidates {
        if partner[j].is_none() && !partner.contains(&Some(i)) {
            partner[j] = Some(i);
        }
    }
    let mode: Vec<usize> = partner.into_iter().flatten().collect();
    let sign = mode
        .iter()
        .enumerate()
        .map(|(j, &i)| cross[(i, j)].signum())
        .collect();
    Pairing { mode, sign }
}

/// Square root of the sum of squares of the errors over the test modes, as fractions.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    pub frequency: f64,
    pub shape: f64,
}

impl Errors {
    /// $e_S = e_f + e_v$.
    pub fn sum(&self) -> f64 {
        self.frequency + self.shape
    }
}

/// $e_f$ (5) and $e_v$ (6), every shape scaled to a largest component of one.
pub fn errors(analysis: &Modes, pairing: &Pairing, test: &Modes) -> Errors {
    let (mut frequency, mut shape) = (0.0, 0.0);
    for (j, (&i, sign)) in pairing.mode.iter().zip(&pairing.sign).enumerate() {
        let (v, w) = (analysis.shapes.column(i), test.shapes.column(j));
        let difference = v * (sign / v.amax()) - w / w.amax();
        frequency += ((analysis.omega_squared[i] / test.omega_squared[j]).sqrt() - 1.0).powi(2);
        shape += difference.norm_squared() / difference.len() as f64;
    }
    Errors {
        frequency: frequency.sqrt(),
        shape: shape.sqrt(),
    }
}

/// Roots $\gamma = 1/\omega^2$ after a change, and shapes $p$ in terms of the modes before it, $p_{jj} = 1$.
pub struct Perturbed {
    pub roots: Vector,
    pub shapes: Matrix,
}

/// First order (C.20, C.21) for $\beta = V^t \Delta K V$, with $k = \omega^2$ before the change.
pub fn first_order(k: &Vector, beta: &Matrix) -> Result<Perturbed, Error> {
    let roots = (k + beta.diagonal()).map(f64::recip);
    let shapes = shapes_from(k, beta, &roots, beta)?;
    Ok(Perturbed { roots, shapes })
}

/// Recursive 1 (7, 8, C.22), order by order until no root changes by more than `tolerance`.
pub fn recursive_1(
    k: &Vector,
    beta: &Matrix,
    tolerance: f64,
    orders: usize,
) -> Result<Perturbed, Error> {
    let Perturbed {
        mut roots,
        mut shapes,
    } = first_order(k, beta)?;
    let mut coupling = beta.clone();
    coupling.fill_diagonal(0.0);
    let mut change = f64::INFINITY;
    for _ in 1..orders {
        // Off the diagonal β_ij + Σ_{s≠i,j} β_is p_sj, on it Σ_{i≠j} β_ji p_ij: all the sums of one order.
        let sums = &coupling * &shapes;
        shapes = shapes_from(k, beta, &roots, &sums)?;
        change = 0.0_f64;
        for (j, root) in roots.iter_mut().enumerate() {
            let lambda = 1.0 / k[j];
            let next =
                lambda - (beta[(j, j)] * lambda + *root * sums[(j, j)]) / (k[j] + beta[(j, j)]);
            change = change.max((next / *root - 1.0).abs());
            *root = next;
        }
        if change < tolerance {
            break;
        }
    }
    let error = root_error(&(Matrix::from_diagonal(k) + beta), &roots, &shapes);
    if change < LARGEST_UNSETTLED_CHANGE && error <= LARGEST_ROOT_ERROR {
        Ok(Perturbed { roots, shapes })
    } else {
        Err(Error::Unsettled(change, error))
    }
}

/// The largest $\sum_s |E_{js}| / \sqrt{\gamma_j \gamma_s}$ with $E = (AP)^{-1}(P - AP\Gamma)$: the roots of $A\gamma - I$ are the
/// eigenvalues of $\Gamma + E$, so that Gershgorin's discs bound the relative error of every $\gamma_j$.
fn root_error(a: &Matrix, roots: &Vector, shapes: &Matrix) -> f64 {
    let ap = a * shapes;
    let residual = shapes - &ap * Matrix::from_diagonal(roots);
    // Two modes led to one have no inverse.
    let Some(e) = ap.lu().solve(&residual) else {
        return f64::INFINITY;
    };
    let radius = |j: usize| -> f64 {
        (0..roots.len())
            .map(|s| e[(j, s)].abs() / (roots[j] * roots[s]).sqrt())
            .sum()
    };
    (0..roots.len())
        .map(radius)
        .max_by(f64::total_cmp)
        .unwrap_or(0.0)
}

const LARGEST_UNSETTLED_CHANGE: f64 = 1e-6;
const LARGEST_ROOT_ERROR: f64 = 1e-4;
const SMALLEST_SEPARATION: f64 = 1e-9;

/// $p_{ij} = -S_{ij} / (k_{ii} + \beta_{ii} - 1/\gamma_j)$ for the sums $S$ of an order.
fn shapes_from(k: &Vector, beta: &Matrix, roots: &Vector, sums: &Matrix) -> Result<Matrix, Error> {
    if let Some(mode) = roots.iter().position(|root| *root <= 0.0 || root.is_nan()) {
        return Err(Error::LostRoot(mode));
    }
    let mut shapes = Matrix::identity(k.len(), k.len());
    for (i, j) in (0..k.len())
        .flat_map(|j| (0..k.len()).map(move |i| (i, j)))
        .filter(|(i, j)| i != j)
    {
        let own = k[i] + beta[(i, i)];
        let difference = own - 1.0 / roots[j];
        if sums[(i, j)] != 0.0 && difference.abs() <= SMALLEST_SEPARATION * own {
            return Err(Error::CloseModes(i, j));
        }
        shapes[(i, j)] = if sums[(i, j)] == 0.0 {
            0.0
        } else {
            -sums[(i, j)] / difference
        };
    }
    Ok(shapes)
}

/// What an analysis hands to the loops: exact modes beside test modes, and each element's generalized stiffness.
pub struct Model {
    pub modes: Modes,
    pub test: Modes,
    pub pairing: Pairing,
    pub errors: Errors,
    /// $V_F^t M V_G$ (4).
    pub cross: Matrix,
    /// $V^t B K_e B^t V$ of every element, rad²/s².
    pub shares: Vec<Matrix>,
    /// The same on the test modes relative to their own, $V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$.
    pub test_shares: Vec<Matrix>,
    /// Gages, in.
    pub gages: Vec<f64>,
}

/// The finite element analysis at given gages, beside test modes of unit generalized mass.
pub fn analyze(
    elements: &[Element],
    sizes: &[f64],
    corrected: usize,
    t: &Matrix,
    mass: &Matrix,
    test: &Modes,
    count: usize,
) -> Result<Model, Error> {
    let (stiffness, transformation) = condense(assemble(elements, sizes, t.nrows()), t)?;
    let modes = solve(&stiffness, mass, count)?;
    let cross = modes.shapes.tr_mul(&(mass * &test.shapes));
    let pairing = pair(&cross);
    let errors = errors(&modes, &pairing, test);
    let omega = test.omega_squared.map(f64::sqrt);
    let shares_in = |shapes: &Matrix| -> Vec<Matrix> {
        let structural = &transformation * shapes;
        elements
            .iter()
            .zip(sizes)
            .take(corrected)
            .map(|(element, &size)| share(element, size, &structural))
            .collect()
    };
    let shares = shares_in(&modes.shapes);
    let relative = |share: Matrix| share.component_div(&(&omega * omega.transpose()));
    let test_shares = shares_in(&test.shapes).into_iter().map(relative).collect();
    Ok(Model {
        shares,
        test_shares,
        modes,
        test: test.clone(),
        pairing,
        errors,
        cross,
        gages: sizes[..corrected].to_vec(),
    })
}

/// Where an inner loop stands: modes by perturbation at factors on the stored element stiffness.
pub struct State {
    pub factors: Vec<f64>,
    pub modes: Modes,
    /// Their shapes in terms of the exact ones.
    pub generalized: Matrix,
    pub pairing: Pairing,
    pub errors: Errors,
}

impl State {
    pub fn start(model: &Model) -> Self {
        let count = model.modes.omega_squared.len();
        Self {
            factors: vec![1.0; model.shares.len()],
            modes: model.modes.clone(),
            generalized: Matrix::identity(count, count),
            pairing: model.pairing.clone(),
            errors: model.errors,
        }
    }

    /// All changes since the exact modes at once, $\beta = \sum_e (c_e - 1) V^t K_e V$.
    pub fn at(model: &Model, factors: Vec<f64>) -> Result<Self, Error> {
        let beta: Matrix = model
            .shares
            .iter()
            .zip(&factors)
            .map(|(share, factor)| (factor - 1.0) * share)
            .sum();
        let Perturbed { roots, mut shapes } =
            recursive_1(&model.modes.omega_squared, &beta, 1e-13, 60)?;
        shapes
            .column_iter_mut()
            .for_each(|mut shape| _ = shape.normalize_mut());
        let modes = Modes {
            omega_squared: roots.map(f64::recip),
            shapes: &model.modes.shapes * &shapes,
        };
        let pairing = pair(&shapes.tr_mul(&model.cross));
        let errors = errors(&modes, &pairing, &model.test);
        Ok(Self {
            factors,
            modes,
            generalized: shapes,
            pairing,
            errors,
        })
    }
}

/// Relative change of an element's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// $\Delta e_e = e_f + e_v - e_S$ (12) of every element, for 0.1 % of its stiffness, by first order.
pub fn error_changes(model: &Model, state: &State) -> Result<Vec<f64>, Error> {
    let (k, p) = (&state.modes.omega_squared, &state.generalized);
    let close = |i: usize, j: usize| {
        i != j && (k[i] - k[j]).abs() < 10.0 * DERIVATIVE_STEP * k[i].max(k[j])
    };
    let of_element = |(share, factor): (&Matrix, &f64)| {
        let beta = DERIVATIVE_STEP * *factor * p.tr_mul(&(share * p));
        // Modes closer than a step can tell apart keep their own shapes.
        let beta = beta.map_with_location(|i, j, entry| if close(i, j) { 0.0 } else { entry });
        let Perturbed { roots, shapes } = first_order(k, &beta)?;
        let modes = Modes {
            omega_squared: roots.map(f64::recip),
            shapes: &state.modes.shapes * shapes,
        };
        Ok(errors(&modes, &state.pairing, &model.test).sum() - state.errors.sum())
    };
    model
        .shares
        .iter()
        .zip(&state.factors)
        .map(of_element)
        .collect()
}

/// How $\Delta k_e$ of (12) and (13) is read.
#[derive(Clone, Copy, Debug)]
pub enum StepRule {
    /// The norm $\lVert \kappa \rVert_F$ of the element's relative stiffness $\kappa$ on the test modes.
    Matrix,
    /// The norm of its diagonal alone.
    Own,
    /// The relative change itself.
    Relative,
    /// The change of gage in units of 0.01 in.
    Gage,
}

/// The unlimited factors $c_e = 1 - R e_S \Delta e_e/\Delta k_e$ (13).
pub fn unlimited_factors(
    model: &Model,
    state: &State,
    total: &[f64],
    relaxation: f64,
    rule: StepRule,
) -> Result<Vec<f64>, Error> {
    let changes = error_changes(model, state)?;
    let factor = |e: usize| {
        let relative = match rule {
            StepRule::Matrix => state.factors[e] * model.test_shares[e].norm(),
            StepRule::Own => state.factors[e] * model.test_shares[e].diagonal().norm(),
            StepRule::Relative => 1.0,
            StepRule::Gage => total[e] * model.gages[e] / 0.01,
        };
        1.0 - relaxation * state.errors.sum() * changes[e] / (DERIVATIVE_STEP * relative)
    };
    Ok((0..changes.len()).map(factor).collect())
}

/// How the loops step and when they stop; the defaults are the paper's.
#[derive(Clone, Copy)]
pub struct Settings {
    pub rule: StepRule,
    /// $R$ of the first iteration of a pass, and of the others.
    pub relaxation: [f64; 2],
    /// Bounds of one iteration's factor.
    pub factor_range: [f64; 2],
    /// Bounds of a gage, in.
    pub gage_range: [f64; 2],
    /// TOLI of the first pass, and of the others.
    pub inner_tolerance: [f64; 2],
    /// TOLO, TOLF and TOLV.
    pub tolerances: [f64; 3],
    pub halvings: i32,
    pub iterations: usize,
    pub passes: usize,
}

/// One pass: factors on the gages, unlimited factors at its start, and the error sum after every iteration.
pub struct Pass {
    pub factors: Vec<f64>,
    pub unlimited: Vec<f64>,
    pub error_sums: Vec<f64>,
}

/// Steps by perturbation alone, from one exact solution until the error sum is small or no step lowers it.
pub fn inner_loop(model: &Model, settings: &Settings, tolerance: f64) -> Result<Pass, Error> {
    let mut pass = Pass {
        factors: vec![1.0; model.shares.len()],
        unlimited: Vec::new(),
        error_sums: Vec::new(),
    };
    let mut state = State::start(model);
    while pass.error_sums.len() < settings.iterations {
        let relaxation = settings.relaxation[pass.error_sums.len().min(1)];
        let unlimited = unlimited_factors(model, &state, &pass.factors, relaxation, settings.rule)?;
        if pass.error_sums.is_empty() {
            pass.unlimited.clone_from(&unlimited);
        }
        // A step that does not lower the error sum is halved; one that no halving saves ends in a local minimum.
        let lower = |halving: i32| {
            let next: Vec<f64> = (0..unlimited.len())
                .map(|e| limited(model, settings, &pass, &unlimited, halving, e))
                .collect();
            // Gages multiply while the stiffness stored since the last exact modes adds.
            let share = |e: usize| (state.factors[e] + next[e] / pass.factors[e] - 1.0).max(1e-3);
            let found = State::at(model, (0..next.len()).map(share).collect()).ok()?;
            (found.errors.sum() < state.errors.sum()).then_some((next, found))
        };
        let Some((factors, found)) = (0..=settings.halvings).find_map(lower) else {
            break;
        };
        (pass.factors, state) = (factors, found);
        pass.error_sums.push(state.errors.sum());
        if state.errors.sum() < tolerance {
            break;
        }
    }
    Ok(pass)
}

/// The factor on element `e`'s gage after a halved step within the bounds of the iteration and of the gage.
fn limited(
    model: &Model,
    settings: &Settings,
    pass: &Pass,
    unlimited: &[f64],
    halving: i32,
    e: usize,
) -> f64 {
    let [lower, upper] = settings.factor_range;
    let step = (unlimited[e].clamp(lower, upper) - 1.0) * 0.5_f64.powi(halving);
    let [thin, thick] = settings.gage_range;
    (model.gages[e] * pass.factors[e] * (1.0 + step)).clamp(thin, thick) / model.gages[e]
}

/// Analysis, inner loop and exact check, until analysis and test agree: every pass with the gages and errors it led to.
pub fn correlate(
    analyze: impl Fn(&[f64]) -> Result<Model, Error>,
    mut gages: Vec<f64>,
    settings: &Settings,
) -> Result<Vec<(Pass, Vec<f64>, Errors)>, Error> {
    let (mut model, mut history) = (analyze(&gages)?, Vec::new());
    while history.len() < settings.passes && !is_correlated(&model.errors, settings) {
        let tolerance = settings.inner_tolerance[history.len().min(1)];
        let pass = inner_loop(&model, settings, tolerance)?;
        gages
            .iter_mut()
            .zip(&pass.factors)
            .for_each(|(gage, factor)| *gage *= factor);
        model = analyze(&gages)?;
        history.push((pass, gages.clone(), model.errors));
    }
    Ok(history)
}

fn is_correlated(errors: &Errors, settings: &Settings) -> bool {
    let [sum, frequency, shape] = settings.tolerances;
    errors.sum() <= sum && errors.frequency <= frequency && errors.shape <= shape
}

/// What a correlation is given.
pub struct Problem {
    pub elements: Vec<Element>,
    /// Gages and areas of all elements; the first `corrected` may change.
    pub sizes: Vec<f64>,
    pub corrected: usize,
    pub t: Matrix,
    pub mass: Matrix,
    pub test: Modes,
    pub settings: Settings,
}

impl Problem {
    /// Corrects the first gages with `count` analysis modes.
    pub fn correlate(&self, count: usize) -> Result<Vec<(Pass, Vec<f64>, Errors)>, Error> {
        let analyze = |gages: &[f64]| {
            let sizes = [gages, &self.sizes[self.corrected..]].concat();
            analyze(
                &self.elements,
                &sizes,
                self.corrected,
                &self.t,
                &self.mass,
                &self.test,
                count,
            )
        };
        correlate(
            analyze,
            self.sizes[..self.corrected].to_vec(),
            &self.settings,
        )
    }
}

/// A case of the paper's wing torque box, from the crate.
pub fn torque_box(case: &corfem::torque_box::Case) -> Problem {
    let model = case.model().expect("the box is sound");
    let modes = case.test_modes().expect("the box has modes");
    let element = |of: &corfem::method::appendix_a::ElementMatrix| Element {
        dof: of.dof.clone(),
        unit: of.unit.clone(),
    };
    let inner = &case.settings.inner;
    Problem {
        elements: model.element_matrices().iter().map(element).collect(),
        sizes: model
            .structure()
            .elements()
            .iter()
            .map(|element| element.size)
            .collect(),
        corrected: model.parameters().len(),
        t: model.load_distribution().clone(),
        mass: model.mass().clone(),
        test: Modes {
            omega_squared: modes.omega_squared().clone(),
            shapes: modes.shapes().clone(),
        },
        settings: Settings {
            rule: match inner.step.name() {
                "matrix" => StepRule::Matrix,
                "own" => StepRule::Own,
                "relative" => StepRule::Relative,
                _ => StepRule::Gage,
            },
            relaxation: [inner.first_relaxation, inner.relaxation],
            factor_range: [inner.factor_range.lower, inner.factor_range.upper],
            gage_range: case
                .gage_range
                .map_or([0.0, f64::INFINITY], |of| [of.lower, of.upper]),
            inner_tolerance: [inner.tolerance, case.settings.later_inner_tolerance],
            tolerances: [
                case.settings.error_sum_tolerance,
                case.settings.frequency_tolerance,
                case.settings.shape_tolerance,
            ],
            halvings: inner.halvings as i32,
            iterations: inner.iterations,
            passes: case.settings.most_passes,
        },
    }
}

#[allow(dead_code)]
fn main() -> Result<(), Error> {
    for number in corfem::torque_box::CASES {
        println!("Case {number}");
        let case = corfem::torque_box::Case::new(number).expect("a case of the paper");
        for (pass, gages, errors) in torque_box(&case).correlate(9)? {
            let reached = pass.error_sums.last().map_or(f64::NAN, |sum| 100.0 * sum);
            println!(
                "  {} iterations to an error sum of {reached:.2} %, exactly {:.2} %",
                pass.error_sums.len(),
                100.0 * errors.sum(),
            );
            let gages: Vec<String> = gages.iter().map(|gage| format!("{gage:.5}")).collect();
            println!("  gages, in: {}", gages.join(" "));
        }
    }
    Ok(())
}
