//! Remarks on what no sensor sees: it takes no part in anything.

use super::{Concern, Kind, PreparedJob};
use crate::sparse::visibility::visibilities;
use crate::weighted::comparison::Comparison;

impl PreparedJob {
    /// Remarks on parts of the model without a sensor, and on modes of the first model that move none.
    pub(super) fn unseen_concerns(&self) -> Vec<Concern> {
        let source = &self.loaded.source;
        let left = &source.left_out;
        let parts = (!left.is_empty())
            .then(|| Concern::new(Kind::PartsWithoutSensor, left, &[left.len() as f64]));
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
        let partners = model.partners();
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
