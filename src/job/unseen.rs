//! Remarks on what no sensor sees: it takes no part in anything.

use super::assignment::pair_optimally;
use super::{Concern, Kind, PreparedJob};
use crate::method::error::Error;
use crate::sparse::visibility::visibilities;
use crate::weighted::comparison::Comparison;
use nalgebra::DMatrix;

/// Deviation of a shape, of unit length, from that of its model's mode in the likelihood of a pair.
const UNLIKE: f64 = 0.1;

impl PreparedJob {
    /// Remarks on parts of the model without a sensor, and on modes of the first model that move none.
    pub(super) fn unseen_concerns(&self) -> Vec<Concern> {
        let source = &self.loaded.source;
        let (left, names) = &source.left_out;
        let parts =
            (*left > 0).then(|| Concern::new(Kind::PartsWithoutSensor, names, &[*left as f64]));
        let loose = (!source.loose.is_empty())
            .then(|| Concern::new(Kind::LooseWithoutSensor, &source.loose, &[]));
        let unseen = self.first.unseen();
        let hertz: Vec<String> = unseen.iter().map(|hertz| format!("{hertz:.4}")).collect();
        let modes = (!hertz.is_empty())
            .then(|| Concern::new(Kind::UnseenModes, &hertz, &[hertz.len() as f64]));
        [parts, loose, modes].into_iter().flatten().collect()
    }

    /// A remark on the modes of a model between the first and the last frequency of the test that no test mode answers: the test may have
    /// missed them.
    pub(super) fn unanswered(&self, model: &Comparison) -> Option<Concern> {
        let exact = &model.model.exact;
        let hertz = exact.modes.frequencies_hz();
        let tested = self
            .compared()
            .map(|mode| self.loaded.data.frequencies_hz[mode]);
        let (first, last) = tested.fold((f64::INFINITY, 0.0_f64), |(first, last), hertz| {
            (first.min(hertz), last.max(hertz))
        });
        let seen = visibilities(&exact.modes.shapes);
        let lone = model.lone().iter().map(|lone| lone.partner);
        let partners: Vec<usize> = exact
            .pairing
            .analysis_mode
            .iter()
            .copied()
            .chain(lone)
            .collect();
        let is_lacking =
            |mode: &usize| (first..=last).contains(&hertz[*mode]) && !partners.contains(mode);
        let lacking: Vec<usize> = (0..hertz.len()).filter(is_lacking).collect();
        let name = |&mode: &usize| {
            format!(
                "mode {} ({:.4} Hz, {:.2})",
                mode + 1,
                hertz[mode],
                seen[mode]
            )
        };
        let names: Vec<String> = lacking.iter().map(name).collect();
        let measure: Vec<f64> = lacking.iter().map(|&mode| hertz[mode]).collect();
        (!names.is_empty()).then(|| Concern::new(Kind::Unanswered, &names, &measure))
    }
}

/// The mode of the model of every test mode, or none, for the largest sum of modal assurance (n × g), of a pair no less than the floor,
/// less what hardly seen modes pay.
///
/// In the negative logarithm of the likelihood of a shape, $(1 - \mathrm{MAC}) / 2 s^2$ with a deviation $s$, a mode of visibility
/// $\nu$ ([`visibilities`]) costs $2 \ln (1 / \nu)$ more: what little sensors see of it may be anything, and looks like any test mode.
///
/// # Errors
/// Errors of [`pair_optimally`].
pub(super) fn pairs(
    assurance: &DMatrix<f64>,
    readings: &DMatrix<f64>,
    floor: f64,
) -> Result<Vec<Option<usize>>, Error> {
    let price = |visibility: f64| -4.0 * UNLIKE * UNLIKE * visibility.max(f64::EPSILON).ln();
    let prices: Vec<f64> = visibilities(readings).into_iter().map(price).collect();
    let dearest = prices.iter().copied().fold(0.0, f64::max);
    // None is negative, which would be as good as no pair.
    let close = assurance.map_with_location(|mode, _, close| match close >= floor {
        true => close + dearest - prices[mode],
        false => -1.0,
    });
    pair_optimally(&decided(&close), 0.0)
}

/// Squared closeness to the digits that shapes decide: a sum of products of up to four thousand sensors is rounded by less than
/// $2^{-40}$. Equal ones then tie, and a tie goes by the order of the modes, which ascend in frequency.
pub(super) fn decided(closeness: &DMatrix<f64>) -> DMatrix<f64> {
    let digits = 40.0_f64.exp2();
    closeness.map(|close| (digits * close).round() / digits)
}
