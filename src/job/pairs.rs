//! Pairs of test modes and modes of a model: their likelihood by shapes and frequencies, and the assignment of all at once, where the
//! method's own (4) takes the closest pair first and may leave a bad one for the last.

use super::{Method, PreparedJob};
use crate::{
    method::{
        error::{Error, check_count},
        linear_algebra::check_finite,
        modes::Modes,
        sorting::Pairing,
        step::Bounds,
    },
    sparse::{Pair, visibility::visibilities},
    weighted::identifiability::PRIOR_DEVIATION,
};
use nalgebra::DMatrix;

/// The analysis mode of every test mode, or none, such that the `closeness` (n × g, larger for closer, as the modal assurance) of all
/// pairs has the largest total,
///
/// $$ \max_a \sum_j c_{a(j) j}, \qquad c_{a(j) j} \ge 0, $$
///
/// with no analysis mode in two pairs; g may exceed n. Test modes enter in their order, each by the shortest path that
/// makes room for it; ties go to the lowest analysis mode, or else leave an earlier test mode's pair alone. So the same
/// numbers always give the same pairs. Source: Kuhn, *Naval Research Logistics Quarterly* 2 (1955),
/// 83; shortest paths by Jonker and Volgenant, *Computing* 38 (1987), 325.
///
/// # Errors
/// [`Error::Value`] for an entry that is not finite.
pub fn pair_optimally(closeness: &DMatrix<f64>) -> Result<Vec<Option<usize>>, Error> {
    check_finite("closeness", closeness)?;
    // After the analysis modes, every test mode (the last one first) has a place of its own at no cost: it means no partner.
    let (analysis_count, test_count) = closeness.shape();
    let places = analysis_count + test_count;
    let cost = |test: usize, place: usize| match closeness.get((place, test)) {
        Some(&close) if place < analysis_count && close >= 0.0 => -close,
        _ if place + test + 1 == places => 0.0,
        _ => f64::INFINITY,
    };
    let mut owner: Vec<Option<usize>> = vec![None; places];
    let (mut test_price, mut place_price) = (vec![0.0; test_count], vec![0.0; places]);
    for start in 0..test_count {
        let (mut distance, mut before) = (vec![f64::INFINITY; places], vec![None; places]);
        let (mut open, mut visited): (Vec<usize>, Vec<usize>) = ((0..places).collect(), Vec::new());
        let (mut next_test, mut reached) = (Some(start), 0.0);
        while let Some(test) = next_test {
            for &place in &open {
                let length = reached + cost(test, place) - test_price[test] - place_price[place];
                if length < distance[place] {
                    (distance[place], before[place]) = (length, visited.last().copied());
                }
            }
            let nearest = open
                .iter()
                .copied()
                .min_by(|&a, &b| distance[a].total_cmp(&distance[b]));
            visited.extend(nearest);
            open.retain(|place| Some(*place) != nearest);
            reached = nearest.map_or(reached, |place| distance[place]);
            next_test = nearest.and_then(|place| owner[place]);
        }
        test_price[start] += reached;
        for &place in &visited {
            place_price[place] -= reached - distance[place];
            owner[place]
                .into_iter()
                .for_each(|other: usize| test_price[other] += reached - distance[place]);
        }
        let mut last = visited.pop();
        while let Some(place) = last {
            last = before[place];
            owner[place] = last.map_or(Some(start), |earlier: usize| owner[earlier]);
        }
    }
    let of = |test| (0..analysis_count).find(|place| owner[*place] == Some(test));
    Ok((0..test_count).map(of).collect())
}

/// The mode of the model of every test mode, in as many pairs as there are, of the least total of their costs (n × g), and this total.
///
/// # Errors
/// Errors of [`pair_optimally`].
pub(super) fn pair_cheaply(costs: &DMatrix<f64>) -> Result<(Vec<Option<usize>>, f64), Error> {
    let dearest = costs.max() + 1.0;
    let partners = pair_optimally(&costs.map(|cost| dearest - cost))?;
    let cost = |(test, mode): (usize, &Option<usize>)| Some(costs[((*mode)?, test)]);
    let total = partners.iter().enumerate().filter_map(cost).sum();
    Ok((partners, total))
}

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
            let parts = of.parts.filter(|_| method == Method::GaussNewton);
            let costs = parts.map(|parts| frequencies.costs(of.modes, &parts()));
            let partners = pairs(&squares, &of.modes.shapes, costs.as_ref(), 0.0)?;
            check_count("test modes", of.cross.ncols(), 0, of.cross.nrows())?;
            let partners = partners.into_iter().flatten().collect();
            Ok(Pairing::signed(partners, of.cross))
        })
    }
}
