//! What lowers the trust in a job's result, collected in one place.

use super::LoadedJob;
use super::preflight::{Finding, preflight};
use crate::files::deck::{Reason, Unread};
use crate::files::error::FileError;
use crate::method::model::DynamicModel;
use serde::Serialize;

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;

/// Something that a reader must know before trusting a result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Concern {
    /// What names it on the command line: lower-case words, numbers and names joined by hyphens.
    pub identifier: String,
    /// Whether it names a mistake; a remark only limits what is known.
    pub is_doubt: bool,
    /// A sentence.
    pub words: String,
}

impl Concern {
    /// A doubt, which names a mistake.
    pub fn doubt(identifier: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            identifier: identifier.into(),
            is_doubt: true,
            words: words.into(),
        }
    }

    /// A remark, which limits what is known.
    pub fn remark(identifier: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            is_doubt: false,
            ..Self::doubt(identifier, words)
        }
    }
}

impl LoadedJob {
    /// Everything doubtful before the first step: what the pre-flight finds, test modes that are left out, and what the readers
    /// left aside.
    ///
    /// # Errors
    /// Those of [`preflight`] and of the analyses it needs; a structure without supports has no condensed model to check, and a
    /// sentence says so.
    pub fn concerns(&self) -> Result<Vec<Concern>, FileError> {
        let mut all = self.preflight_concerns()?;
        for (mode, assurance) in &self.unpaired {
            let mode = mode + 1;
            all.push(Concern::remark(
                format!("left-out-{mode}"),
                format!(
                    "test mode {mode}: it resembles no mode of the first model (modal assurance {assurance:.2} at most) and is \
                     left out"
                ),
            ));
        }
        for (mode, phase) in self.data.phase_collinearity.iter().enumerate() {
            if *phase < COLLINEAR {
                let mode = mode + 1;
                all.push(Concern::remark(
                    format!("complex-{mode}"),
                    format!("test mode {mode}: complex, with a phase collinearity of {phase:.2}"),
                ));
            }
        }
        if !self.data.incomplete.is_empty() {
            all.push(Concern::remark(
                "not-in-every-mode",
                format!(
                    "sensors left out because some mode of the file has no value at them: {}",
                    self.data.incomplete.join(", ")
                ),
            ));
        }
        if !self.data.skipped.is_empty() {
            let numbers: Vec<String> = self.data.skipped.iter().map(usize::to_string).collect();
            all.push(Concern::remark(
                "datasets-not-read",
                format!(
                    "datasets of the Universal File that are not read: {}",
                    numbers.join(", ")
                ),
            ));
        }
        let unread = self.source.deck.iter().flat_map(|(_, deck)| &deck.unread);
        let unread = unread.filter(|card| card.reason != Reason::WithoutPart);
        let unread: Vec<String> = unread.map(Unread::place).collect();
        if !unread.is_empty() {
            all.push(Concern::remark(
                "cards-not-read",
                format!("cards of the deck that are left out: {}", unread.join(", ")),
            ));
        }
        all.extend(self.data.units.iter().map(|units| {
            Concern::remark(
                "units-of-test",
                format!("the test's file is in units of {units}; nothing is converted"),
            )
        }));
        Ok(all)
    }

    /// What the pre-flight finds.
    fn preflight_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let whole = &self.source.whole;
        match whole.condensed(&self.ones(), &self.sensors) {
            Ok((condensed, mass)) => {
                let model = DynamicModel {
                    stiffness: condensed.stiffness,
                    mass,
                    shares: Vec::new(),
                };
                let findings =
                    preflight(&model, &self.test, &self.job.correlation, &whole.ranges())?;
                Ok(findings.iter().map(Finding::concern).collect())
            }
            Err(error) => Ok(vec![Concern::remark(
                "no-preflight",
                format!(
                    "the pre-flight needs condensed matrices, which this model does not have: {error}"
                ),
            )]),
        }
    }
}
