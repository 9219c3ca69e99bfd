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

use super::shapes::{Change, changed};
use crate::job::assignment::pair_cheaply;
use crate::job::likelihood::Frequencies;
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::sparse::{ParameterMatrix, parts_of, solve_lower};
use crate::weighted::noise::Noise;
use nalgebra::{Cholesky, DMatrix, DVector, DVectorView, RowDVector};
use std::rc::Rc;

/// Least standard deviations of a reading, over the largest of its mode, and of a frequency: what first order and parameters leave out is
/// no less, however small the noise.
pub(super) const LEAST: Noise = Noise {
    shape: 0.01,
    frequency: 0.005,
};
/// Standard deviation of a parameter's factor in a first model.
const MODEL_ERROR: f64 = 0.3;
/// The same of stiffness that no parameter scales; what it does is bounded by
/// $\lvert v_l^t \Delta K v_i \rvert \le \delta \sqrt{\lambda_l \lambda_i}$ (Cauchy and Schwarz).
const OTHER_ERROR: f64 = 0.003;
/// Share of right tests in which a mistake may be named.
pub(super) const FALSE_ALARMS: f64 = 1e-3;
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

/// What the readings of a test mode may be if it came from one mode of the model or another.
struct Likelihood {
    shapes: DMatrix<f64>,
    /// $W^{-1}$ of every mode.
    priors: Rc<Vec<DMatrix<f64>>>,
    /// $L^{-1}$ (n × n) of every mode i, one below the other, with $G_i^{-1} = L L^t$.
    halves: DMatrix<f64>,
    /// The root of the mean square of the test modes' deviations, and with it the noise of a reading by mode of the model.
    common: f64,
    noise: Vec<f64>,
    /// The deviation of every test mode's readings over that.
    times: Vec<f64>,
    /// The negative logarithm of the likelihood of every test mode's frequency (columns), if it came from each mode (rows).
    frequencies: DMatrix<f64>,
}

/// Costs of every test mode's frequency (columns), if it came from each mode of the model.
pub(super) fn frequency_costs(seen: &SeenModes, hertz: &[f64], noise: &[Noise]) -> DMatrix<f64> {
    let own = |mode: usize| noise.get(mode).map_or(0.0, |noise| noise.frequency);
    let test = |(mode, hertz): (usize, &f64)| [*hertz, own(mode).max(LEAST.frequency)];
    let frequencies = Frequencies {
        test: hertz.iter().enumerate().map(test).collect(),
        spreads: vec![MODEL_ERROR; seen.shares.len()],
    };
    frequencies.costs(&seen.modes, &parts_of(&seen.shares, &seen.modes))
}

impl Likelihood {
    fn new(seen: &SeenModes, hertz: &[f64], noise: &[Noise]) -> Option<Self> {
        let own = |mode: usize| noise.get(mode).map_or(0.0, |noise| noise.shape);
        let deviations: Vec<f64> = (0..hertz.len())
            .map(|mode| own(mode).max(LEAST.shape))
            .collect();
        let squares = deviations.iter().map(|own| own * own).sum::<f64>();
        let common = (squares / deviations.len().max(1) as f64).sqrt();
        let frequencies = frequency_costs(seen, hertz, noise);
        let shapes = seen.modes.shapes().clone();
        let squares = seen.modes.omega_squared();
        let prior = |mode: usize| {
            let own = squares[mode];
            let column = |share: &ParameterMatrix| match share {
                ParameterMatrix::Stiffness(share) => share.column(mode).into_owned(),
                ParameterMatrix::Mass(share) => own * share.column(mode),
            };
            // The part of mode l over its deviation, at most one: where first order gives more, modes mix freely.
            let gap = DVector::from_iterator(
                squares.len(),
                squares
                    .iter()
                    .map(|other| (own - other).abs().max(f64::EPSILON * own)),
            );
            let mut parts: Vec<DVector<f64>> = seen.shares.iter().map(column).collect();
            for part in &mut parts {
                part.component_div_assign(&gap);
                *part *= MODEL_ERROR;
                part[mode] = 0.0;
            }
            let size = |l: usize| parts.iter().map(|part| part[l].powi(2)).sum::<f64>().sqrt();
            let sizes = DVector::from_fn(squares.len(), |l, _| size(l));
            let mut covariance = DMatrix::zeros(squares.len(), squares.len());
            for mut part in parts {
                for (l, value) in part.iter_mut().enumerate() {
                    // Below the mode the gap is negative.
                    *value *= if squares[l] > own { -1.0 } else { 1.0 } / sizes[l].max(1.0);
                }
                covariance.ger(1.0, &part, &part, 1.0);
            }
            for l in 0..squares.len() {
                let other = (OTHER_ERROR * (own * squares[l]).sqrt() / gap[l]).min(1.0);
                // Terms of second order are of the size of the square of those of first.
                covariance[(l, l)] += sizes[l].min(1.0).powi(4) + other.powi(2);
            }
            covariance[(mode, mode)] = 1.0;
            let mut inverse = Cholesky::new(covariance)?.inverse();
            inverse[(mode, mode)] = 0.0;
            Some(inverse)
        };
        let priors = (0..squares.len()).map(prior).collect::<Option<Vec<_>>>()?;
        Self {
            shapes: DMatrix::zeros(0, 0),
            priors: Rc::new(priors),
            halves: DMatrix::zeros(0, 0),
            common,
            noise: Vec::new(),
            times: deviations.iter().map(|own| own / common).collect(),
            frequencies,
        }
        .with(shapes)
    }

    /// The same with other readings of the model's modes, or fewer.
    fn with(&self, shapes: DMatrix<f64>) -> Option<Self> {
        let (gram, count) = (shapes.transpose() * &shapes, shapes.ncols());
        let noise: Vec<f64> = shapes
            .column_iter()
            .map(|own| self.common * own.amax())
            .collect();
        let (unit, mut halves) = (
            DMatrix::identity(count, count),
            DMatrix::zeros(count * count, count),
        );
        for (mode, prior) in self.priors.iter().enumerate() {
            let ridge = Cholesky::new(&gram + noise[mode].powi(2) * prior)?;
            let half = solve_lower(ridge.l_dirty(), unit.clone());
            halves.rows_mut(mode * count, count).copy_from(&half);
        }
        Some(Self {
            halves,
            shapes,
            priors: Rc::clone(&self.priors),
            common: self.common,
            noise,
            times: self.times.clone(),
            frequencies: self.frequencies.clone(),
        })
    }

    /// The negative logarithm of the likelihood of every test mode (columns), if it came from each mode (rows), and the part $q_i$ of
    /// that mode. That of its shape is Student's, whose tails leave room for more noise and for modes that the model does not have.
    fn of_shapes(&self, test: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
        let (count, freedom) = (self.noise.len(), test.nrows().max(2) as f64 - 1.0);
        // xᵗ V G Vᵗ x is the square of L⁻¹ Vᵗ x, and q_i its product with the column i of L⁻¹.
        let halves = &self.halves * (self.shapes.transpose() * test);
        let squares: Vec<f64> = test
            .column_iter()
            .map(|shape| shape.norm_squared())
            .collect();
        let [mut costs, mut parts] = [(); 2].map(|()| DMatrix::zeros(count, test.ncols()));
        for mode in 0..count {
            let (first, own) = (mode * count, self.halves.column(mode));
            for (shape, half) in halves.column_iter().enumerate() {
                let half = half.rows(first, count);
                let part = own.rows(first, count).dot(&half);
                let left = (squares[shape] - half.norm_squared()).max(0.0);
                // ρ σ² q² at the noise σ q: the logarithms of 1 + ρ/(d - 1) and of σ q are one.
                let noise = self.times[shape] * self.noise[mode] * part;
                let spread = noise * noise + left / freedom;
                let by_shape = 0.5 * freedom * spread.max(f64::MIN_POSITIVE).ln();
                costs[(mode, shape)] = by_shape + self.frequencies[(mode, shape)];
                parts[(mode, shape)] = part;
            }
        }
        [costs, parts]
    }

    /// The readings expected of another sensor, which sees the modes by a row of their shapes: those of the most likely mode.
    fn expected(&self, test: &DMatrix<f64>, row: &RowDVector<f64>) -> Vec<f64> {
        let ([costs, _], count) = (self.of_shapes(test), self.noise.len());
        let of_shape = |(shape, costs): (DVectorView<f64>, DVectorView<f64>)| {
            let half = self.halves.rows(costs.imin() * count, count);
            (half * row.transpose()).dot(&(half * self.shapes.tr_mul(&shape)))
        };
        test.column_iter()
            .zip(costs.column_iter())
            .map(of_shape)
            .collect()
    }

    /// The same of all shapes, each from a mode of its own, with what `adds` says of each, after these modes.
    fn of_test(
        &self,
        test: &DMatrix<f64>,
        adds: impl Fn(usize, f64) -> f64,
    ) -> Result<(Vec<Option<usize>>, f64), Error> {
        let [mut costs, parts] = self.of_shapes(test);
        for test in 0..test.ncols() {
            for (mode, noise) in self.noise.iter().enumerate() {
                let size = self.times[test] * parts[(mode, test)].abs();
                costs[(mode, test)] += adds(test, noise * size);
            }
        }
        pair_cheaply(&costs)
    }

    fn misfit(&self, test: &DMatrix<f64>) -> Result<f64, Error> {
        Ok(self.of_test(test, |_, _| 0.0)?.1)
    }
}

/// Answers of the readings of a test.
#[derive(Default)]
pub(super) struct Told {
    /// The single mistake that explains the test best, if it does so well enough, and by which factor it makes the test more likely, as
    /// a decimal logarithm.
    pub(super) mistake: Option<(Change, f64)>,
    /// The mode of the model that every test mode most likely is, if all have one.
    pub(super) partners: Option<Vec<usize>>,
    /// The negative logarithm of the likelihood of the test without that mistake.
    pub(super) least: f64,
    /// The reason why they tell nothing, if they do not.
    pub(super) silent: Option<&'static str>,
}

/// The answers of readings: the single mistake that explains the test best, and what no test could tell.
///
/// A right test is more than $e^T$ times as likely with a given mistake as without in at most $e^{-T}$ of all tests (Markov's
/// inequality), so H mistakes tried need $T = \ln(H / \alpha)$ for false alarms in a share $\alpha$.
///
/// # Errors
/// Those of [`pair_cheaply`].
pub(super) fn explain(seen: &SeenModes, (test, noise): (&Modes, &[Noise])) -> Result<Told, Error> {
    let (hertz, test) = (test.frequencies_hz(), test.shapes());
    let sensors = test.nrows();
    let silent = |reason| {
        Ok(Told {
            silent: Some(reason),
            ..Told::default()
        })
    };
    if sensors <= 2 {
        return silent("two sensors tell no mistake of one");
    }
    let Some(model) = Likelihood::new(seen, &hertz, noise) else {
        return silent("the sensors do not tell the modes of the model apart");
    };
    let (partners, before) = model.of_test(test, |_, _| 0.0)?;
    let tried = tried(&model, test)?;
    let enough = (tried.len() as f64 / FALSE_ALARMS).ln();
    let best = tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let mistake = best
        .filter(|(_, after)| before - after > enough)
        .map(|(change, after)| (change, (before - after) / std::f64::consts::LN_10));
    // A reversed sensor moves a reading r by 2r/σ deviations, and a logarithm of a likelihood by no more than half their squares.
    let mut moved = 2.0 * test;
    for (mut shape, times) in moved.column_iter_mut().zip(&model.times) {
        shape /= 0.5 * shape.amax() * model.common * times;
    }
    let most = moved.row_iter().map(|row| 0.5 * row.norm_squared());
    let is_weak = mistake.is_none() && most.fold(0.0, f64::max) <= enough;
    let (right, least) = match &mistake {
        Some((change, _)) => model.of_test(&changed(test, change), |_, _| 0.0)?,
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
        let misfit = model.misfit(&changed(test, &change))?;
        tried.push((change, misfit + costs));
        Ok::<_, Error>(())
    };
    for sensor in 0..sensors {
        try_change(&mut tried, Change::Reversed(sensor), 0.0)?;
        let Some(without) = model.with(model.shapes.clone().remove_row(sensor)) else {
            continue;
        };
        let rest = test.clone().remove_row(sensor);
        let (row, readings) = (model.shapes.row(sensor).into_owned(), test.row(sensor));
        others.push((without.misfit(&rest)?, sensor));
        let expected = without.expected(&rest, &row);
        let size = expected.iter().map(|value| value * value).sum::<f64>();
        if readings.norm_squared() < DEAD * DEAD * size {
            let noise_alone = |test: usize, noise: f64| {
                let noise = noise.max(f64::MIN_POSITIVE);
                0.5 * (readings[test] / noise).powi(2).min(1e9) + noise.ln()
            };
            let (_, misfit) = without.of_test(&rest, noise_alone)?;
            tried.push((Change::Dead(sensor), misfit));
        }
        // Every mode's own ratio is a candidate; choosing among them costs the logarithm of their number, and readings so many times as
        // large are spread as much wider.
        for (reading, expected) in readings.iter().zip(&expected) {
            let gain = reading / expected;
            if gain.is_finite() && gain > DEAD && gain.max(1.0 / gain) > LEAST_GAIN {
                let modes = test.ncols() as f64;
                let costs = modes.ln() + modes * gain.ln();
                try_change(&mut tried, Change::Gain(sensor, gain), costs)?;
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
