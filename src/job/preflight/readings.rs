//! The single mistake in the readings that explains a test, judged against what noise and a wrong model may do to its shapes.
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

use crate::{
    job::concern::{Check, Concern},
    method::{error::Error, modes::Modes},
    sparse::{ParameterMatrix, pair_cheaply, solve_lower},
    weighted::noise::Noise,
};
use nalgebra::{Cholesky, DMatrix, DVector, DVectorView};

/// Least standard deviations of a reading, over the largest of its mode, and of a frequency: what first order and parameters leave out is
/// no less, however small the noise.
pub const LEAST: Noise = Noise {
    shape: 0.01,
    frequency: 0.005,
};
/// Standard deviation of a parameter's factor in a first model.
pub const MODEL_ERROR: f64 = 0.3;
/// The same of stiffness that no parameter scales; what it does is bounded by
/// $\lvert v_l^t \Delta K v_i \rvert \le \delta \sqrt{\lambda_l \lambda_i}$ (Cauchy and Schwarz).
const OTHER_ERROR: f64 = 0.003;
/// Share of right tests in which a mistake may be named.
pub const FALSE_ALARMS: f64 = 1e-3;
/// A gain closer to one than this factor may be the model's.
const LEAST_GAIN: f64 = 1.5;
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
pub struct Known {
    /// $W^{-1}$ of every mode.
    priors: Vec<DMatrix<f64>>,
    /// The root of the mean square of the test modes' deviations.
    common: f64,
    /// The deviation of every test mode's readings over that.
    times: Vec<f64>,
}

/// What the readings of a test mode may be if it came from one mode of the model or another.
pub struct Likelihood<'a> {
    known: &'a Known,
    shapes: DMatrix<f64>,
    /// $L^{-1}$ (n × n) of every mode i, one below the other, with $G_i^{-1} = L L^t$.
    halves: DMatrix<f64>,
    /// The noise of a reading by mode of the model.
    noise: Vec<f64>,
}

/// $W^{-1}$ of a mode; none where parameters of no size would move it.
fn prior(seen: &SeenModes, mode: usize) -> Option<DMatrix<f64>> {
    let roots = &seen.modes.omega_squared;
    let own = roots[mode];
    // Of two equal roots first order gives more than one.
    let gap = roots.map(|other| {
        let gap = own - other;
        gap.abs().max(f64::EPSILON * own).copysign(gap)
    });
    let mut parts = DMatrix::zeros(roots.len(), seen.shares.len());
    for (mut part, share) in parts.column_iter_mut().zip(&seen.shares) {
        part.copy_from(&share.matrix().column(mode).component_div(&gap));
        part *= MODEL_ERROR;
        if matches!(share, ParameterMatrix::Mass(_)) {
            part *= own;
        }
    }
    let mut spread = DVector::zeros(roots.len());
    for (l, mut part) in parts.row_iter_mut().enumerate() {
        let size = part.norm();
        // Where first order gives more than one, modes mix freely.
        part /= size.max(1.0);
        let other = (OTHER_ERROR * (own * roots[l]).sqrt() / gap[l].abs()).min(1.0);
        // Terms of second order are of the size of the square of those of first.
        spread[l] = size.min(1.0).powi(4) + other.powi(2);
    }
    parts.row_mut(mode).fill(0.0);
    let mut covariance = &parts * parts.transpose() + DMatrix::from_diagonal(&spread);
    covariance[(mode, mode)] = 1.0;
    let mut inverse = Cholesky::new(covariance)?.inverse();
    inverse[(mode, mode)] = 0.0;
    Some(inverse)
}

impl Known {
    /// What is known before a test of this noise; none where the parameters leave a mode no deviation.
    pub fn new(seen: &SeenModes, noise: &[Noise]) -> Option<Self> {
        let deviations = noise.iter().map(|own| own.shape.max(LEAST.shape));
        let deviations: Vec<f64> = deviations.collect();
        let squares = deviations.iter().map(|own| own * own).sum::<f64>();
        let common = (squares / deviations.len() as f64).sqrt();
        let priors = (0..seen.modes.len()).map(|mode| prior(seen, mode));
        Some(Self {
            priors: priors.collect::<Option<_>>()?,
            common,
            times: deviations.iter().map(|own| own / common).collect(),
        })
    }

    /// What sensors say that see the model's modes so; none where they do not tell them apart.
    pub fn seen_as(&self, shapes: DMatrix<f64>) -> Option<Likelihood<'_>> {
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
    /// The negative logarithm of the likelihood of every test shape (columns), if it came from each mode (rows). It is Student's, whose
    /// tails leave room for more noise and for modes that the model does not have.
    pub fn of_shapes(&self, test: &DMatrix<f64>) -> DMatrix<f64> {
        let (count, freedom) = (self.noise.len(), test.nrows().max(2) as f64 - 1.0);
        // xᵗ V G Vᵗ x is the square of L⁻¹ Vᵗ x, and q_i its product with the column i of L⁻¹.
        let halves = &self.halves * self.shapes.tr_mul(test);
        DMatrix::from_fn(count, test.ncols(), |mode, shape| {
            let own = self.halves.view((mode * count, mode), (count, 1));
            let half = halves.view((mode * count, shape), (count, 1));
            // ρ σ² q² at the noise σ q: the logarithms of 1 + ρ/(d - 1) and of σ q are one.
            let noise = self.known.times[shape] * self.noise[mode] * own.dot(&half);
            let left = test.column(shape).norm_squared() - half.norm_squared();
            let spread = noise * noise + left.max(0.0) / freedom;
            0.5 * freedom * spread.max(f64::MIN_POSITIVE).ln()
        })
    }

    /// The reading expected of another sensor, which sees the modes so, in a test shape that came from this mode.
    fn expected(&self, test: &DVectorView<f64>, mode: usize, seen: &DVector<f64>) -> f64 {
        let count = self.noise.len();
        let half = self.halves.rows(mode * count, count);
        (half * seen).dot(&(half * self.shapes.tr_mul(test)))
    }

    /// The single mistake that explains a test best, as a doubt, if it does so well enough; the frequency of every test mode costs so much
    /// by the mode of the model that it comes from.
    ///
    /// A right test is more than $e^T$ times as likely with a given mistake as without in at most $e^{-T}$ of all tests (Markov's
    /// inequality), so H mistakes tried need $T = \ln(H / \alpha)$ for false alarms in a share $\alpha$.
    ///
    /// # Errors
    /// Those of [`pair_cheaply`].
    pub fn mistake(
        &self,
        test: &DMatrix<f64>,
        frequencies: &DMatrix<f64>,
        (sensors, file): (&[String], &str),
    ) -> Result<Option<Concern>, Error> {
        let (_, before) = pair_cheaply(&(self.of_shapes(test) + frequencies))?;
        let tried = self.tried(test, frequencies, sensors)?;
        let enough = (tried.len() as f64 / FALSE_ALARMS).ln();
        let best = tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let best = best.filter(|own| before - own.0 > enough);
        Ok(best.map(|(cost, mut doubt)| {
            let evidence = (before - cost) / std::f64::consts::LN_10;
            doubt.words += &format!(
                " in {file}. The test's shapes would be 10^{evidence:.1} times as likely, with its noise and a model 30 % wrong."
            );
            doubt
        }))
    }

    /// Mistakes of sensors, each with the negative logarithm of the test's likelihood without it.
    fn tried(
        &self,
        test: &DMatrix<f64>,
        frequencies: &DMatrix<f64>,
        names: &[String],
    ) -> Result<Vec<(f64, Concern)>, Error> {
        let corrected = |kind, about: &[&String], words, edit: &dyn Fn(&mut DMatrix<f64>)| {
            let mut own = test.clone();
            edit(&mut own);
            let cost = pair_cheaply(&(self.of_shapes(&own) + frequencies))?.1;
            Ok::<_, Error>((cost, Concern::doubt(Check::Readings, kind, about, words)))
        };
        let (mut tried, mut others, modes) = (Vec::new(), Vec::new(), test.ncols() as f64);
        for (sensor, name) in names.iter().enumerate() {
            let words = format!("Sensor {name} reversed? Give its row the other sign");
            let edit = |own: &mut DMatrix<f64>| own.row_mut(sensor).neg_mut();
            tried.push(corrected("reversed-", &[name], words, &edit)?);
            let fewer = self.shapes.clone().remove_row(sensor);
            let Some(without) = self.known.seen_as(fewer) else {
                continue;
            };
            let rest = test.clone().remove_row(sensor);
            let costs = without.of_shapes(&rest) + frequencies;
            others.push((pair_cheaply(&costs)?.1, sensor));
            let row = self.shapes.row(sensor).transpose();
            for (shape, reading) in test.row(sensor).iter().enumerate() {
                let partner = costs.column(shape).imin();
                let gain = reading / without.expected(&rest.column(shape), partner, &row);
                if gain.is_finite() && gain > 0.0 && gain.max(1.0 / gain) > LEAST_GAIN {
                    let words = format!(
                        "Sensor {name} reads {gain:.3} times too much? Divide its row by that"
                    );
                    let edit = |own: &mut DMatrix<f64>| own.row_mut(sensor).unscale_mut(gain);
                    let (cost, doubt) = corrected("gain-", &[name], words, &edit)?;
                    // Every mode's own ratio is a candidate; choosing among them costs the logarithm of their number, and readings so many
                    // times as large are spread as much wider.
                    tried.push((cost + modes.ln() + modes * gain.ln(), doubt));
                }
            }
        }
        others.sort_by(|a, b| a.0.total_cmp(&b.0));
        others.truncate(MOST_EXCHANGED);
        for (place, &(_, b)) in others.iter().enumerate() {
            for &(_, a) in &others[..place] {
                let [one, other] = [a.min(b), a.max(b)].map(|own| &names[own]);
                let words = format!(
                    "Sensors {one} and {other} exchanged? Exchange the readings of their rows"
                );
                let edit = |own: &mut DMatrix<f64>| own.swap_rows(a, b);
                tried.push(corrected("exchanged-", &[one, other], words, &edit)?);
            }
        }
        Ok(tried)
    }
}
