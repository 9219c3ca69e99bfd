//! Which single mistake in the readings explains a test, judged against what noise and a wrong model may do to its shapes.
//!
//! To first order, a parameter wrong by the fraction $\delta_e$ changes mode i of the model by
//!
//! $$ \Delta v_i = \sum_e \delta_e \sum_{l \ne i} \frac{v_l^t K_e v_i}{\lambda_i - \lambda_l} v_l , \qquad \lambda = \omega^2 . $$
//!
//! With $\delta_e$ independent, of deviation [`MODEL_ERROR`], and noise on every reading, a test shape that came from
//! mode i is a sum of modes whose parts q have a known covariance W, and ridge regression finds them and the misfit,
//!
//! $$ q = G_i V^t x , \qquad G_i = (V^t V + \sigma^2 W^{-1})^{-1}, \qquad
//! \rho = \frac{x^t x - x^t V q}{\sigma^2 q_i^2} , $$
//!
//! with the part of mode i itself free. A density that is spread wider is lower: its d numbers, but for the scale, cost
//! $\ln \sigma \lvert q_i \rvert$ each, or a mode of which the sensors hardly see anything would explain any shape as noise. Close modes mix freely, so clusters are compared as subspaces. No mass is needed: free
//! structures and light points are judged like others.

use super::Change;
use crate::{
    job::{assignment::pair_cheaply, likelihood::Frequencies},
    method::{error::Error, modes::Modes},
    sparse::{ParameterMatrix, parts_of, solve_lower},
    weighted::noise::Noise,
};
use nalgebra::{Cholesky, DMatrix, DVector, DVectorView, RowDVector};

/// Least standard deviations of a reading, over the largest of its mode, and of a frequency: what first order and parameters leave out is
/// no less, however small the noise.
pub const LEAST: Noise = Noise {
    shape: 0.01,
    frequency: 0.005,
};
/// Standard deviation of a parameter's factor in a first model.
const MODEL_ERROR: f64 = 0.3;
/// The same of stiffness that no parameter scales; what it does is bounded by
/// $\lvert v_l^t \Delta K v_i \rvert \le \delta \sqrt{\lambda_l \lambda_i}$ (Cauchy and Schwarz).
const OTHER_ERROR: f64 = 0.003;
/// Share of right tests in which a mistake may be named.
pub const FALSE_ALARMS: f64 = 1e-3;
/// A gain closer to one than this factor may be the model's.
const LEAST_GAIN: f64 = 1.5;
/// A sensor is dead when its readings are below this part of those expected.
const DEAD: f64 = 0.1;
/// Number of suspect sensors, those that others predict worst, tried for exchanged labels.
const MOST_EXCHANGED: usize = 24;

/// Modes of the model at the sensors.
#[derive(Debug, Clone)]
pub struct SeenModes {
    /// $\omega^2$, and shapes of unit generalized mass in the whole model (sensors × n).
    pub modes: Modes,
    /// $V^t K_e V$ or $V^t M_e V$ of every parameter, with the whole shapes.
    pub shares: Vec<ParameterMatrix>,
}

/// What is known of modes of the model and of the test before the readings.
struct Known {
    /// $W^{-1}$ of every mode.
    priors: Vec<DMatrix<f64>>,
    /// The root of the mean square of the test modes' deviations.
    common: f64,
    /// The deviation of every test mode's readings over that.
    times: Vec<f64>,
    /// The negative logarithm of the likelihood of every test mode's frequency (columns), if it came from each mode (rows).
    frequencies: DMatrix<f64>,
}

/// What the readings of a test mode may be if it came from one mode of the model or another.
struct Likelihood<'a> {
    known: &'a Known,
    shapes: DMatrix<f64>,
    /// $L^{-1}$ (n × n) of every mode i, one below the other, with $G_i^{-1} = L L^t$.
    halves: DMatrix<f64>,
    /// The noise of a reading by mode of the model.
    noise: Vec<f64>,
}

/// Costs of every test mode's frequency (columns), if it came from each mode of the model.
pub fn frequency_costs(seen: &SeenModes, hertz: &[f64], noise: &[Noise]) -> DMatrix<f64> {
    let own = |mode: usize| noise.get(mode).map_or(0.0, |noise| noise.frequency);
    let test = |(mode, hertz): (usize, &f64)| [*hertz, own(mode).max(LEAST.frequency)];
    let frequencies = Frequencies {
        test: hertz.iter().enumerate().map(test).collect(),
        spreads: vec![MODEL_ERROR; seen.shares.len()],
    };
    frequencies.costs(&seen.modes, &parts_of(&seen.shares, &seen.modes))
}

impl Known {
    fn new(seen: &SeenModes, hertz: &[f64], noise: &[Noise]) -> Option<Self> {
        let own = |mode: usize| noise.get(mode).map_or(0.0, |noise| noise.shape);
        let deviations: Vec<f64> = (0..hertz.len())
            .map(|mode| own(mode).max(LEAST.shape))
            .collect();
        let squares = deviations.iter().map(|own| own * own).sum::<f64>();
        let common = (squares / deviations.len().max(1) as f64).sqrt();
        let roots = &seen.modes.omega_squared;
        let prior = |mode: usize| {
            let own = roots[mode];
            let scale = |share: &ParameterMatrix| match share {
                ParameterMatrix::Stiffness(_) => 1.0,
                ParameterMatrix::Mass(_) => own,
            };
            let gap = roots.map(|other| (own - other).abs().max(f64::EPSILON * own));
            let mut parts = DMatrix::zeros(roots.len(), seen.shares.len());
            for (mut part, share) in parts.column_iter_mut().zip(&seen.shares) {
                part.copy_from(&share.matrix().column(mode).component_div(&gap));
                part *= MODEL_ERROR * scale(share);
                part[mode] = 0.0;
            }
            let mut spread = DVector::zeros(roots.len());
            for (l, mut part) in parts.row_iter_mut().enumerate() {
                let size = part.norm();
                // Below the mode the gap is negative. Where first order gives more than one, modes mix freely.
                part *= if roots[l] > own { -1.0 } else { 1.0 } / size.max(1.0);
                let other = (OTHER_ERROR * (own * roots[l]).sqrt() / gap[l]).min(1.0);
                // Terms of second order are of the size of the square of those of first.
                spread[l] = size.min(1.0).powi(4) + other.powi(2);
            }
            let mut covariance = &parts * parts.transpose() + DMatrix::from_diagonal(&spread);
            covariance[(mode, mode)] = 1.0;
            let mut inverse = Cholesky::new(covariance)?.inverse();
            inverse[(mode, mode)] = 0.0;
            Some(inverse)
        };
        Some(Self {
            priors: (0..roots.len()).map(prior).collect::<Option<_>>()?,
            common,
            times: deviations.iter().map(|own| own / common).collect(),
            frequencies: frequency_costs(seen, hertz, noise),
        })
    }

    /// What sensors say that see the model's modes so.
    fn seen_as(&self, shapes: DMatrix<f64>) -> Option<Likelihood<'_>> {
        let (gram, count) = (shapes.tr_mul(&shapes), shapes.ncols());
        let noise = shapes.column_iter().map(|own| self.common * own.amax());
        let noise: Vec<f64> = noise.collect();
        let mut halves = DMatrix::zeros(count * count, count);
        for (mode, prior) in self.priors.iter().enumerate() {
            let ridge = Cholesky::new(&gram + noise[mode].powi(2) * prior)?;
            let half = solve_lower(ridge.l_dirty(), DMatrix::identity(count, count));
            halves.rows_mut(mode * count, count).copy_from(&half);
        }
        Some(Likelihood {
            known: self,
            shapes,
            halves,
            noise,
        })
    }
}

impl Likelihood<'_> {
    /// The negative logarithm of the likelihood of every test mode (columns), if it came from each mode (rows), and the part $q_i$ of
    /// that mode. That of its shape is Student's, whose tails leave room for more noise and for modes that the model does not have.
    fn of_shapes(&self, test: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
        let (count, freedom) = (self.noise.len(), test.nrows().max(2) as f64 - 1.0);
        // xᵗ V G Vᵗ x is the square of L⁻¹ Vᵗ x, and q_i its product with the column i of L⁻¹.
        let halves = &self.halves * self.shapes.tr_mul(test);
        let mut costs = self.known.frequencies.clone();
        let mut parts = DMatrix::zeros(count, test.ncols());
        for mode in 0..count {
            let (first, own) = (mode * count, self.halves.column(mode));
            for (shape, half) in halves.column_iter().enumerate() {
                let half = half.rows(first, count);
                let part = own.rows(first, count).dot(&half);
                // ρ σ² q² at the noise σ q: the logarithms of 1 + ρ/(d - 1) and of σ q are one.
                let noise = self.known.times[shape] * self.noise[mode] * part;
                let left = test.column(shape).norm_squared() - half.norm_squared();
                let spread = noise * noise + left.max(0.0) / freedom;
                costs[(mode, shape)] += 0.5 * freedom * spread.max(f64::MIN_POSITIVE).ln();
                parts[(mode, shape)] = part;
            }
        }
        [costs, parts]
    }

    /// The readings expected of another sensor, which sees the modes by a row of their shapes: those of the most likely mode.
    fn expected(&self, test: &DMatrix<f64>, row: &RowDVector<f64>) -> Vec<f64> {
        let ([costs, _], count) = (self.of_shapes(test), self.noise.len());
        let of_shape = |(test, costs): (DVectorView<f64>, DVectorView<f64>)| {
            let half = self.halves.rows(costs.imin() * count, count);
            (half * row.transpose()).dot(&(half * self.shapes.tr_mul(&test)))
        };
        let both = test.column_iter().zip(costs.column_iter());
        both.map(of_shape).collect()
    }

    /// The same of all shapes, each from a mode of its own, after these modes.
    fn of_test(&self, test: &DMatrix<f64>) -> Result<(Vec<Option<usize>>, f64), Error> {
        let [costs, _] = self.of_shapes(test);
        pair_cheaply(&costs)
    }
}

/// Answers of the readings of a test.
#[derive(Default)]
pub struct Told {
    /// The single mistake that explains the test best, if it does so well enough, and by which factor it makes the test more likely, as
    /// a decimal logarithm.
    pub mistake: Option<(Change, f64)>,
    /// The mode of the model that every test mode most likely is, if all have one.
    pub partners: Option<Vec<usize>>,
    /// The negative logarithm of the likelihood of the test without that mistake.
    pub least: f64,
    /// The reason why they tell nothing, if they do not.
    pub silent: Option<&'static str>,
}

/// The answers of readings: the single mistake that explains the test best, and what no test could tell.
///
/// A right test is more than $e^T$ times as likely with a given mistake as without in at most $e^{-T}$ of all tests (Markov's
/// inequality), so H mistakes tried need $T = \ln(H / \alpha)$ for false alarms in a share $\alpha$.
///
/// # Errors
/// Those of [`pair_cheaply`].
pub fn explain(seen: &SeenModes, (test, noise): (&Modes, &[Noise])) -> Result<Told, Error> {
    let (hertz, test) = (test.frequencies_hz(), test.shapes());
    let silent = |reason| {
        Ok(Told {
            silent: Some(reason),
            ..Told::default()
        })
    };
    if test.nrows() <= 2 {
        return silent("two sensors tell no mistake of one");
    }
    let known = Known::new(seen, &hertz, noise);
    let shapes = seen.modes.shapes.clone();
    let Some(model) = known.as_ref().and_then(|known| known.seen_as(shapes)) else {
        return silent("the sensors do not tell the modes of the model apart");
    };
    let (partners, before) = model.of_test(test)?;
    let tried = tried(&model, test)?;
    let enough = (tried.len() as f64 / FALSE_ALARMS).ln();
    let best = tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let mistake = best
        .filter(|(_, after)| before - after > enough)
        .map(|(change, after)| (change, (before - after) / std::f64::consts::LN_10));
    // A reversed sensor moves a reading r by 2r/σ deviations, and a logarithm of a likelihood by no more than half their squares.
    let moved = |sensor: usize| {
        let moved = |(shape, times): (DVectorView<f64>, &f64)| {
            2.0 * shape[sensor] / (shape.amax() * model.known.common * times)
        };
        let shapes = test.column_iter().zip(&model.known.times);
        0.5 * shapes.map(|own| moved(own).powi(2)).sum::<f64>()
    };
    let is_weak = mistake.is_none() && (0..test.nrows()).all(|sensor| moved(sensor) <= enough);
    let (right, least) = match &mistake {
        Some((change, _)) => model.of_test(&change.of(test))?,
        None => (partners, before),
    };
    Ok(Told {
        mistake,
        partners: right.into_iter().collect(),
        least,
        silent: is_weak.then_some("by these deviations a reversed sensor would not show"),
    })
}

/// Changes of a test, each with the negative logarithm of its likelihood with the change.
fn tried(model: &Likelihood, test: &DMatrix<f64>) -> Result<Vec<(Change, f64)>, Error> {
    let sensors = test.nrows();
    let mut tried: Vec<(Change, f64)> = Vec::new();
    let mut others: Vec<(f64, usize)> = Vec::new();
    let try_change = |tried: &mut Vec<(Change, f64)>, change: Change, costs: f64| {
        let (_, misfit) = model.of_test(&change.of(test))?;
        tried.push((change, misfit + costs));
        Ok::<_, Error>(())
    };
    for sensor in 0..sensors {
        try_change(&mut tried, Change::Reversed(sensor), 0.0)?;
        let fewer = model.shapes.clone().remove_row(sensor);
        let Some(without) = model.known.seen_as(fewer) else {
            continue;
        };
        let rest = test.clone().remove_row(sensor);
        let (row, readings) = (model.shapes.row(sensor).into_owned(), test.row(sensor));
        others.push((without.of_test(&rest)?.1, sensor));
        let expected = without.expected(&rest, &row);
        let size = expected.iter().map(|value| value * value).sum::<f64>();
        if readings.norm_squared() < DEAD * DEAD * size {
            let [mut costs, parts] = without.of_shapes(&rest);
            for (test, times) in model.known.times.iter().enumerate() {
                for (mode, noise) in without.noise.iter().enumerate() {
                    let noise = noise * times * parts[(mode, test)].abs();
                    let noise = noise.max(f64::MIN_POSITIVE);
                    let apart = (readings[test] / noise).powi(2).min(1e9);
                    costs[(mode, test)] += 0.5 * apart + noise.ln();
                }
            }
            tried.push((Change::Dead(sensor), pair_cheaply(&costs)?.1));
        }
        // Every mode's own ratio is a candidate; choosing among them costs the logarithm of their number, and readings so many times as
        // large are spread as much wider.
        for (reading, expected) in readings.iter().zip(&expected) {
            let gain = reading / expected;
            if gain.is_finite() && gain > DEAD && gain.max(1.0 / gain) > LEAST_GAIN {
                let modes = test.ncols() as f64;
                try_change(
                    &mut tried,
                    Change::Gain(sensor, gain),
                    modes.ln() + modes * gain.ln(),
                )?;
            }
        }
    }
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    others.truncate(MOST_EXCHANGED);
    for (place, &(_, b)) in others.iter().enumerate() {
        for &(_, a) in &others[..place] {
            try_change(&mut tried, Change::Exchanged([a.min(b), a.max(b)]), 0.0)?;
        }
    }
    Ok(tried)
}
