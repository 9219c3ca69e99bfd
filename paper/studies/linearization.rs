//! How far a step can be trusted: predicted modes beside exact ones, by perturbation and by a linear Taylor step.
//!
//! The paper's section 6 calls Van de Vooren's formulae more accurate than a Taylor series type linearization. All of them know the
//! same: the modes before the step and $\beta = V^t \Delta K V$, whose entries are the exact derivatives of $K_D$.

use super::{percents, rows};
use crate::prelude::*;

/// What predicts modes.
pub const METHODS: [&str; 4] = [
    "first order %",
    "Recursive 1, order 4 %",
    "Taylor in ω² %",
    "Taylor in 1/ω² %",
];
/// An RMS error over all modes, a fraction.
type Measure = fn(&Errors) -> f64;
/// RMS errors by name.
pub const MEASURES: [(&str, Measure); 2] = [
    ("frequencies", Errors::frequency_rms),
    ("shapes", Errors::shape_rms),
];
/// Steps halved from the whole correction to less than a hundredth of it.
pub const STEPS: [f64; 8] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125];

/// A linear step of the roots' inverses $\omega^2$, or of the roots $\lambda = 1/\omega^2$, and of the shapes, by exact derivatives:
///
/// $$ \Delta\omega_i^2 = \beta_{ii}, \qquad \Delta\lambda_i = -\lambda_i^2 \beta_{ii}, \qquad
///    p_{ij} = \frac{\beta_{ij}}{\omega_j^2 - \omega_i^2} $$
fn taylor(k: &DVector<f64>, beta: &DMatrix<f64>, of_roots: bool) -> Perturbed {
    let root = |i: usize| match of_roots {
        true => 1.0 / k[i] - beta[(i, i)] / (k[i] * k[i]),
        false => 1.0 / (k[i] + beta[(i, i)]),
    };
    let shape = |i: usize, j: usize| match i == j {
        true => 1.0,
        false => beta[(i, j)] / (k[j] - k[i]),
    };
    Perturbed {
        roots: DVector::from_fn(k.len(), |i, _| root(i)),
        shapes: DMatrix::from_fn(k.len(), k.len(), shape),
    }
}

/// Errors of the [`METHODS`] for each of the [`STEPS`] from a model's first factors toward the right ones: beside the modes of the changed
/// stiffness with the $B$ before the step, as the inner loop sees the structure, or beside those of a new condensation.
pub fn predictions(known: &Known, is_new: bool) -> Vec<[Errors; 4]> {
    let Known { model, truth, .. } = known;
    let first = model.matrices(&vec![1.0; truth.len()]).unwrap();
    let (mass, count) = (&first.mass, first.mass.nrows());
    let start = solve(&first.stiffness, mass, count).unwrap();
    let (k, shapes) = (start.omega_squared(), start.shapes());
    let of_step = |step: f64| {
        let factors = truth
            .iter()
            .map(|factor| 1.0 + step * (factor - 1.0))
            .collect_vec();
        let changes = first.shares.iter().zip(&factors);
        let change: DMatrix<f64> = changes.map(|(share, factor)| (factor - 1.0) * share).sum();
        let beta = symmetric_part(&shapes.tr_mul(&(&change * shapes)));
        let exact = match is_new {
            true => model.modes(&factors),
            false => solve(&(&first.stiffness + &change), mass, count),
        };
        let exact = exact.unwrap();
        let found = [
            first_order(k, &beta).unwrap(),
            recursive_1(k, &beta, 4).unwrap(),
            taylor(k, &beta, false),
            taylor(k, &beta, true),
        ];
        found.map(|Perturbed { roots, shapes: p }| {
            let modes = Modes::new(roots.map(f64::recip), shapes * p).unwrap();
            let modes = modes.scaled_with(mass).unwrap();
            let cross = cross_orthogonality(&modes, &exact, mass).unwrap();
            errors(&modes, &pair_modes(&cross).unwrap(), &exact).unwrap()
        })
    };
    STEPS.into_iter().map(of_step).collect()
}

/// RMS errors of predicted frequencies and shapes, a whole step, a quarter and a sixteenth.
pub fn tables() -> Vec<Table> {
    [("linearization", false), ("linearization_new", true)]
        .map(|(name, is_new)| {
            let both = [Known::of_case(2), Known::delta_wing()].into_iter();
            let found = both.flat_map(|known| {
                let all = predictions(&known, is_new);
                let of = |(what, measure): (&str, fn(&Errors) -> f64)| {
                    [0, 2, 4].map(|row| {
                        let label = format!("{}, {}, {what}", known.name, STEPS[row]);
                        (label, percents(all[row].map(|errors| measure(&errors))))
                    })
                };
                MEASURES.map(of).concat()
            });
            rows(name, &METHODS, found)
        })
        .to_vec()
}
