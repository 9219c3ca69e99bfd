//! Results as tables: of any correlation ([`report`]), and of decks and jobs.

pub mod deck;
pub mod job;
pub mod report;

use super::table::Digits;
use crate::method::step::StepRule;

/// Digits of a frequency.
pub const HERTZ: Digits = Digits::Significant(4);
/// Digits of root mean squares in percent.
pub const RMS_PERCENT: Digits = Digits::Fixed(2);

impl StepRule {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Matrix => "matrix",
            Self::Own => "own",
            Self::Relative => "relative",
            Self::Gage => "gage",
        }
    }
}
