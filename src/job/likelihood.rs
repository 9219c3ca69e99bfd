//! The likelihood of pairs of test modes and modes of a model, by shapes and frequencies.

use super::assignment::pair_optimally;
use super::{LoadedJob, PreparedJob};
use crate::method::error::{Error, check_count};
use crate::method::sorting::Pairing;
use crate::method::step::Bounds;
use crate::sparse::visibility::visibilities;
use crate::sparse::{Pair, SensorModel};
use nalgebra::DMatrix;

/// Deviation of a shape, of unit length, from that of its model's mode.
const UNLIKE: f64 = 0.1;
/// Most that a frequency costs a pair: beyond, something else is wrong with it, which shapes alone must tell.
const MOST_BY_FREQUENCY: f64 = 20.0;

/// The cost $\frac{1}{2} z^2 + \ln t$ of every mode (rows) and test mode, whose frequency (Hz) has a deviation as a fraction:
///
/// $$ z = \frac{1}{t} \ln \frac{f_j}{f_i}, \qquad t^2 = \sigma_j^2 + \sum_e (\tfrac{1}{2} \delta_e s_{ie})^2, $$
///
/// where $s_{ie}$ is the part (n × p) of parameter e in mode i's stiffness or mass and $\delta_e$ the deviation of its logarithm.
pub(super) fn costs_of_frequencies(
    hertz: &[f64],
    parts: &DMatrix<f64>,
    priors: &[f64],
    test: &[[f64; 2]],
) -> DMatrix<f64> {
    // A model of one parameter alone may be that of any.
    let largest = priors.iter().copied().fold(0.0, f64::max);
    let prior = |e: usize| match parts.ncols() == priors.len() {
        true => priors[e],
        false => largest,
    };
    let moved = |mode: usize| {
        let parts = parts.row(mode);
        let moved = parts.iter().enumerate();
        let moved = moved.map(|(e, part)| (0.5 * prior(e) * part).powi(2));
        moved.sum::<f64>()
    };
    let moved: Vec<f64> = (0..hertz.len()).map(moved).collect();
    DMatrix::from_fn(hertz.len(), test.len(), |mode, place| {
        let [own, noise] = test[place];
        let deviation = (noise * noise + moved[mode]).sqrt();
        let apart = (own / hertz[mode]).ln() / deviation;
        (0.5 * apart * apart).min(MOST_BY_FREQUENCY) + deviation.ln()
    })
}

/// The mode of the model of every test mode, or none: as many pairs as there are of a modal assurance (n × g) no less than the floor, of
/// the least total cost, the negative logarithm of their likelihood,
///
/// $$ \frac{d - 1}{2} \ln \left( 1 + \frac{1 - \mathrm{MAC}}{(d - 1) s^2} \right) + 2 \ln \frac{1}{\nu} $$
///
/// at d sensors, for a mode of visibility $\nu$ ([`visibilities`]), and what its frequency costs, where that counts
/// ([`costs_of_frequencies`]). That of the shape is Student's with the deviation $s$ of 0.1. What sensors see of a mode that they hardly see
/// may be anything, and looks like any test mode.
///
/// With many sensors modal assurance alone finds a pair more often than with frequencies, which a model far off has in another order:
/// of exact tests at eight sensors it pairs a few fewer wrong, at two and three many more.
///
/// # Errors
/// Errors of [`pair_optimally`].
pub(super) fn pairs(
    assurance: &DMatrix<f64>,
    readings: &DMatrix<f64>,
    by_frequency: Option<&DMatrix<f64>>,
    floor: f64,
) -> Result<Vec<Option<usize>>, Error> {
    let free = readings.nrows().saturating_sub(1) as f64;
    let prices: Vec<f64> = visibilities(readings)
        .into_iter()
        .map(|visibility| -2.0 * visibility.max(f64::EPSILON).ln())
        .collect();
    let cost = |(mode, test): (usize, usize)| {
        let unlike = (1.0 - assurance[(mode, test)]).max(0.0);
        let by_shape = match free > 0.0 {
            true => 0.5 * free * (unlike / (free * UNLIKE * UNLIKE)).ln_1p(),
            false => 0.0,
        };
        by_shape + prices[mode] + by_frequency.map_or(0.0, |costs| costs[(mode, test)])
    };
    let (modes, tests) = assurance.shape();
    let costs = DMatrix::from_fn(modes, tests, |mode, test| cost((mode, test)));
    // One pair more outweighs whatever it costs the others.
    let enough = 1.0 + tests as f64 * (costs.max() - costs.min());
    let close = costs.map_with_location(|mode, test, cost| {
        match assurance[(mode, test)] >= floor {
            true => enough + costs.max() - cost,
            // Not as good as no pair.
            false => -1.0,
        }
    });
    pair_optimally(&rounded(&close, COSTS), 0.0)
}

/// Digits after the point, in base two, of a modal assurance: a sum of products of up to four thousand sensors is rounded by less.
const ASSURANCES: f64 = 40.0;
/// The same of a cost, which is up to a thousand times as steep.
const COSTS: f64 = 30.0;

fn rounded(numbers: &DMatrix<f64>, digits: f64) -> DMatrix<f64> {
    let digits = digits.exp2();
    numbers.map(|number| (digits * number).round() / digits)
}

/// Squared closeness to the digits that shapes decide. Equal ones then tie, and a tie goes by the order of the modes, which ascend in
/// frequency.
pub(super) fn decided(closeness: &DMatrix<f64>) -> DMatrix<f64> {
    rounded(closeness, ASSURANCES)
}

impl LoadedJob {
    /// Deviation of the logarithm of every parameter's factor before the test: its prior's, or that of any number within its bounds, of
    /// which none is more likely than others, if that is less.
    fn spreads(&self) -> Vec<f64> {
        let ranges = self.source.whole.ranges();
        let spread = |(prior, range): (&f64, &Option<Bounds>)| {
            let within = range.map(|range| (range.upper / range.lower).ln() / 12.0_f64.sqrt());
            within.map_or(*prior, |within| prior.min(within))
        };
        self.source.priors.iter().zip(&ranges).map(spread).collect()
    }

    /// Frequencies (Hz) of test modes (from zero) with their deviations as fractions.
    pub(super) fn measured_frequencies(&self, modes: &[usize]) -> Vec<[f64; 2]> {
        let own = |&mode: &usize| {
            let noise = self.deviations(mode).frequency;
            [self.data.frequencies_hz[mode], noise]
        };
        modes.iter().map(own).collect()
    }
}

impl PreparedJob {
    /// What frequencies cost pairs of these test modes (from zero) with a model's modes ([`costs_of_frequencies`]).
    pub(super) fn costs_with(&self, model: &SensorModel, tests: &[usize]) -> DMatrix<f64> {
        let (modes, priors) = (&model.exact.modes, self.loaded.spreads());
        let test = self.loaded.measured_frequencies(tests);
        costs_of_frequencies(&modes.frequencies_hz(), &model.parts(), &priors, &test)
    }

    /// Rule that gives every test mode that is compared the most likely partner.
    pub(super) fn pair(&self) -> Pair {
        let priors = self.loaded.spreads();
        let test = self.loaded.measured_frequencies(&self.modes);
        Pair::by(move |of| {
            let hertz = of.modes.frequencies_hz();
            let costs = of
                .parts
                .map(|parts| costs_of_frequencies(&hertz, &parts(), &priors, &test));
            let (squares, readings) = (of.cross.component_mul(of.cross), &of.modes.shapes);
            let partners = pairs(&squares, readings, costs.as_ref(), 0.0)?;
            check_count("test modes", of.cross.ncols(), 0, of.cross.nrows())?;
            let analysis_mode = partners.into_iter().flatten().collect();
            Ok(Pairing::signed(analysis_mode, of.cross))
        })
    }
}
