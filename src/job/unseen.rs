//! Remarks on what no sensor sees: it takes no part in anything.

use super::{Concern, Kind, PreparedJob};

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
}
