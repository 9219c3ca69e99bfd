//! Pairs of test modes and modes of a model: their likelihood by shapes and frequencies.

use super::{Method, PreparedJob};
use crate::{
    method::{
        error::{Error, check_count},
        modes::Modes,
        sorting::Pairing,
        step::Bounds,
    },
    sparse::{Pair, pair_optimally, visibility::visibilities},
    weighted::identifiability::PRIOR_DEVIATION,
};
use nalgebra::DMatrix;

/// Deviation of a shape, of unit length, from that of its model's mode.
const UNLIKE: f64 = 0.1;
/// Modal assurance below which a test mode counts as without a partner.
pub const FLOOR: f64 = 0.5;
/// Most that a frequency costs a pair: beyond, something else is wrong with it, which shapes alone must tell.
const MOST_BY_FREQUENCY: f64 = 20.0;

/// Steps of a cost in one: modal assurance, a sum of products of up to four thousand sensors, is rounded by a thousandth of one, and a cost is
/// up to a thousand times as steep.
const DIGITS: f64 = (1_u64 << 30) as f64;

/// Frequencies of test modes, and how far those of a model may be off.
pub struct Frequencies {
    /// Every test mode's (Hz), and its deviation as a fraction.
    pub test: Vec<[f64; 2]>,
    /// Deviation of the logarithm of every parameter's factor before the test.
    pub spreads: Vec<f64>,
}

impl Frequencies {
    /// The cost $\frac{1}{2} z^2 + \ln t$ of every mode (rows) and test mode,
    ///
    /// $$ z = \frac{1}{t} \ln \frac{f_j}{f_i}, \qquad t^2 = \sigma_j^2 + \sum_e (\frac{1}{2} \delta_e s_{ie})^2, $$
    ///
    /// where $s_{ie}$ is the part (n × p) of parameter e in mode i's stiffness or mass and $\delta_e$ its spread.
    pub(super) fn costs(&self, modes: &Modes, parts: &DMatrix<f64>) -> DMatrix<f64> {
        let (hertz, spreads) = (modes.frequencies_hz(), &self.spreads);
        let moved = |mode: usize| {
            let both = parts.row(mode).into_owned();
            let both = both.iter().zip(spreads);
            both.map(|(part, spread)| (0.5 * spread * part).powi(2))
                .sum::<f64>()
        };
        DMatrix::from_fn(hertz.len(), self.test.len(), |mode, place| {
            let [own, noise] = self.test[place];
            let deviation = (noise * noise + moved(mode)).sqrt();
            let apart = (own / hertz[mode]).ln() / deviation;
            (0.5 * apart * apart).min(MOST_BY_FREQUENCY) + deviation.ln()
        })
    }
}

/// The negative logarithm of the likelihood of every pair of a mode of the model and a test mode, by their modal assurance (n × g),
///
/// $$ \frac{d - 1}{2} \ln \big( 1 + \frac{1 - \mathrm{MAC}}{(d - 1) s^2} \big) + 2 \ln \frac{1}{\nu} $$
///
/// at d sensors, for a mode of visibility $\nu$ ([`visibilities`]), and what its frequency costs, where that counts
/// ([`Frequencies::costs`]). That of the shape is Student's with the deviation $s$ of 0.1. What sensors see of a mode that they hardly see
/// may be anything, and looks like any test mode.
pub fn costs(
    assurance: &DMatrix<f64>,
    readings: &DMatrix<f64>,
    by_frequency: Option<&DMatrix<f64>>,
) -> DMatrix<f64> {
    let free = readings.nrows().saturating_sub(1) as f64;
    let prices: Vec<f64> = visibilities(readings)
        .into_iter()
        .map(|seen| -2.0 * seen.max(f64::EPSILON).ln())
        .collect();
    // One sensor tells no shapes apart.
    let likeness = (free * UNLIKE * UNLIKE).max(f64::MIN_POSITIVE);
    assurance.map_with_location(|mode, test, close| {
        (0.5 * free * (1.0 + (1.0 - close).max(0.0) / likeness).ln())
            + prices[mode]
            + by_frequency.map_or(0.0, |costs| costs[(mode, test)])
    })
}

/// The mode of the model of every test mode, or none: as many pairs as there are of a modal assurance (n × g) no less than the floor, of
/// the least total cost ([`costs`]).
///
/// With many sensors modal assurance alone finds a pair more often than with frequencies, which a model far off has in another order:
/// of 207 exact pairs at eight sensors it has none wrong where this has one, at two 55 where this has 18.
///
/// # Errors
/// Errors of [`pair_optimally`].
pub fn pairs(
    assurance: &DMatrix<f64>,
    readings: &DMatrix<f64>,
    by_frequency: Option<&DMatrix<f64>>,
    floor: f64,
) -> Result<Vec<Option<usize>>, Error> {
    let costs = costs(assurance, readings, by_frequency);
    // One pair more outweighs whatever it costs the others.
    let most = costs.max();
    let enough = 1.0 + costs.ncols() as f64 * (most - costs.min()) + most;
    // Not as good as no pair. Rounded so that ties are exact, which go by the order of the modes.
    let close = costs.zip_map(assurance, |cost, close| {
        if close >= floor {
            (DIGITS * (enough - cost)).round() / DIGITS
        } else {
            -1.0
        }
    });
    pair_optimally(&close)
}

impl PreparedJob {
    /// Frequencies of test modes (from zero). The spread of a factor is its prior's, or if that is less that of any number within its
    /// bounds, of which none is more likely than others, or else the usual one: whoever knows nothing of it has a model all the same.
    pub(super) fn frequencies(&self, tests: &[usize]) -> Frequencies {
        let (source, hertz) = (&self.loaded.source, &self.loaded.data.frequencies_hz);
        let own = |&mode: &usize| [hertz[mode], self.loaded.deviations(mode).frequency];
        let spread = |(prior, range): (&f64, Option<Bounds>)| {
            let within = range.map(|range| (range.upper / range.lower).ln() / 12.0_f64.sqrt());
            prior.min(within.unwrap_or(PRIOR_DEVIATION))
        };
        Frequencies {
            test: tests.iter().map(own).collect(),
            spreads: source
                .priors
                .iter()
                .zip(source.whole.ranges())
                .map(spread)
                .collect(),
        }
    }

    /// Rule that gives every test mode that is compared the most likely partner; in the paper's loops, which follow shapes from step to
    /// step, by shapes alone.
    pub(super) fn pair(&self, method: Method) -> Pair {
        let frequencies = self.frequencies(&self.modes);
        Pair::by(move |of| {
            let squares = of.cross.component_mul(of.cross);
            let moves = of.moves.filter(|_| method == Method::GaussNewton);
            let costs = moves.map(|moves| frequencies.costs(of.modes, moves));
            let partners = pairs(&squares, &of.modes.shapes, costs.as_ref(), 0.0)?;
            check_count("test modes", of.cross.ncols(), 0, of.cross.nrows())?;
            let partners = partners.into_iter().flatten().collect();
            Ok(Pairing::signed(partners, of.cross))
        })
    }
}
