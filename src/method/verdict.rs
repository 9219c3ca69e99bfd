//! What a correlation came to, as data.
//! Tour: [chapter 10](crate::tour::chapter_10_own_structure).

use crate::method::error_sum::ModeError;
use crate::method::model::Bounds;
use serde::Serialize;

/// Largest part of a test mode's generalized stiffness (or mass) below which a parameter counts as unseen: twice as much of it
/// would move no frequency by half a percent.
pub const UNSEEN_SHARE: f64 = 0.01;

/// Why a correlation ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The exact modes met the tolerances, and nothing else ended it.
    Tolerance,
    /// No step lowered the error sum any more.
    LocalMinimum,
    /// Steps became too short to tell whether one lowers it, which is no proof of a minimum.
    ShortSteps,
    /// The passes allowed were used up, or the iterations of the only one.
    Cap,
    /// The caller asked to stop.
    Request,
    /// Not one step was taken: the first was uphill with all its halvings, or no pass was allowed.
    Nothing,
}

/// What a correlation came to. It judges the best factors, [`best_factors`](super::outer_loop::Correlation::best_factors).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Why it ended.
    pub outcome: Outcome,
    /// Whether the exact modes at the best factors meet the tolerances.
    pub is_within: bool,
    /// Error sum there, in the measure of the settings: the number that the tolerance is compared with.
    pub error_sum: f64,
    /// The test mode with the largest errors there, from zero.
    pub worst_mode: usize,
    /// Its errors.
    pub worst: ModeError,
    /// Parameters at an end of their range, from zero.
    pub at_bound: Vec<usize>,
    /// Parameters that no test mode has [`UNSEEN_SHARE`] of its stiffness or mass in, from zero.
    pub unseen: Vec<usize>,
}

impl Verdict {
    /// The verdict on a correlation that is best at `factors`, where the test modes have the error sum and `errors`; `seen` is the
    /// largest part of a test mode that each parameter had at first.
    pub(crate) fn new(
        outcome: Outcome,
        (error_sum, errors): (f64, &[ModeError]),
        factors: &[f64],
        seen: &[f64],
        ranges: &[Option<Bounds>],
        is_within: bool,
    ) -> Self {
        let worst_mode = (0..errors.len())
            .max_by(|&a, &b| errors[a].square().total_cmp(&errors[b].square()))
            .unwrap_or(0);
        let at_end = |e: &usize| ranges[*e].is_some_and(|range| range.has_end_at(factors[*e]));
        let is_unseen = |e: &usize| factors[*e] * seen[*e] < UNSEEN_SHARE;
        Self {
            outcome,
            is_within,
            error_sum,
            worst_mode,
            worst: errors.get(worst_mode).copied().unwrap_or_default(),
            at_bound: (0..factors.len()).filter(at_end).collect(),
            unseen: (0..factors.len()).filter(is_unseen).collect(),
        }
    }
}
