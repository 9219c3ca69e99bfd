//! How far a step can be trusted: predicted modes beside exact ones, by perturbation and by a linear Taylor step.
//!
//! The paper's section 6 calls Van de Vooren's formulae more accurate than a Taylor series type linearization. All of them know the
//! same: the modes before the step and $\beta = V^t \Delta K V$, whose entries are the exact derivatives of $K_D$.

use crate::prelude::*;

/// What predicts modes, in the order of [`Prediction::errors`].
pub const METHODS: [&str; 4] = [
    "first order",
    "Recursive 1, order 4",
    "Taylor in ω²",
    "Taylor in 1/ω²",
];
/// A kind of error by name.
pub type Measure = (&'static str, fn(&Errors) -> f64);
/// RMS errors over all modes, fractions.
pub const MEASURES: [Measure; 2] = [
    ("frequencies", Errors::frequency_rms),
    ("shapes", Errors::shape_rms),
];
/// The order of Recursive 1.
const ORDER: usize = 4;

/// Steps of the figure and the table: halved from the whole correction to less than a hundredth of it.
pub const STEPS: [f64; 8] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125];

/// What a prediction is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exact {
    /// The modes of the changed stiffness with the $B$ before the step, as the inner loop sees the structure.
    SameCondensation,
    /// The modes of a new finite element analysis, with a new $B$.
    NewCondensation,
}

/// How good the predictions of one step are.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// The step as a fraction of the whole one.
    pub step: f64,
    /// Errors over all modes by each of the [`METHODS`]; none where it fails, because a root is lost or modes come together.
    pub errors: Vec<Option<Errors>>,
}

/// A linear step of the roots' inverses $\omega^2$, or of the roots $\lambda = 1/\omega^2$, and of the shapes, by exact derivatives:
///
/// $$ \Delta\omega_i^2 = \beta_{ii}, \qquad \Delta\lambda_i = -\lambda_i^2 \beta_{ii}, \qquad
///    p_{ij} = \frac{\beta_{ij}}{\omega_j^2 - \omega_i^2} $$
fn taylor(k: &DVector<f64>, beta: &DMatrix<f64>, of_roots: bool) -> Perturbed {
    let root = |i: usize| {
        if of_roots {
            1.0 / k[i] - beta[(i, i)] / (k[i] * k[i])
        } else {
            1.0 / (k[i] + beta[(i, i)])
        }
    };
    let shape = |i: usize, j: usize| {
        if i == j {
            1.0
        } else {
            beta[(i, j)] / (k[j] - k[i])
        }
    };
    Perturbed {
        roots: DVector::from_fn(k.len(), |i, _| root(i)),
        shapes: DMatrix::from_fn(k.len(), k.len(), shape),
    }
}

/// The predictions of steps from a model's first factors, all one, toward given ones: fractions `steps` of the way.
///
/// # Errors
/// Those of [`Weighed::matrices`], [`solve`] and [`pair_modes`].
pub fn predictions(
    model: &Weighed,
    toward: &[f64],
    steps: &[f64],
    exact: Exact,
) -> Result<Vec<Prediction>, Error> {
    let DynamicModel {
        stiffness,
        mass,
        shares,
    } = model.matrices(&vec![1.0; toward.len()])?;
    let start = solve(&stiffness, &mass, stiffness.nrows())?;
    let (k, shapes) = (start.omega_squared(), start.shapes());
    let of_step = |&step: &f64| {
        let changes = shares
            .iter()
            .zip(toward)
            .map(|(share, factor)| step * (factor - 1.0) * share);
        let change: DMatrix<f64> = changes.sum();
        let beta = symmetric_part(&shapes.tr_mul(&(&change * shapes)));
        let factors = toward
            .iter()
            .map(|factor| 1.0 + step * (factor - 1.0))
            .collect_vec();
        let answer = match exact {
            Exact::SameCondensation => solve(&(&stiffness + &change), &mass, k.len())?,
            Exact::NewCondensation => model.modes(&factors)?,
        };
        let found = [first_order(k, &beta), recursive_1(k, &beta, ORDER)].map(Result::ok);
        let error = |found: Option<Perturbed>| -> Result<Option<Errors>, Error> {
            let Some(Perturbed { roots, shapes: p }) =
                found.filter(|found| found.roots.iter().all(|root| *root > 0.0))
            else {
                return Ok(None);
            };
            let modes = Modes::new(roots.map(f64::recip), shapes * p)?.scaled_with(&mass)?;
            let pairing = pair_modes(&cross_orthogonality(&modes, &answer, &mass)?)?;
            errors(&modes, &pairing, &answer).map(Some)
        };
        let linear = [false, true].map(|of_roots| Some(taylor(k, &beta, of_roots)));
        let errors = found
            .into_iter()
            .chain(linear)
            .map(error)
            .collect::<Result<_, _>>()?;
        Ok(Prediction { step, errors })
    };
    steps.iter().map(of_step).collect()
}

/// The [`STEPS`] of Case 2 and of the delta wing, from their wrong gages toward the right ones.
///
/// # Errors
/// Those of the models and of [`predictions`].
pub fn both_structures(exact: Exact) -> Result<[(&'static str, Vec<Prediction>); 2], CaseError> {
    let of = |known: Known| predictions(&known.model, &known.truth, &STEPS, exact);
    Ok([
        ("Case 2", of(Known::of_case(2)?)?),
        ("Delta wing", of(Known::delta_wing()?)?),
    ])
}
