//! The verdict on a finished correlation.

use crate::method::error_sum::Errors;
use crate::method::inner_loop::Stop;
use crate::method::outer_loop::Correlation;
use crate::method::step::Bounds;
use crate::sparse::UNSEEN_SHARE;
use crate::torque_box::CaseResult;
use crate::weighted::comparison::ModeErrors;
use crate::weighted::intervals::is_at_end;
use crate::weighted::lower_place::PLACES;
use serde::Serialize;

/// End of a correlation, or of a part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The exact modes met the tolerances of the paper's loops.
    Tolerance,
    /// No step of the paper's loops lowered the error sum any more.
    #[serde(rename = "local minimum")]
    LocalMinimum,
    /// The objective of weighted steps is stationary, and steps from places drawn about it have found nothing lower.
    Lowest,
    /// It is stationary; nothing lower was looked for, or the steps were led to a lower place for the last time.
    Stationary,
    /// Weighted steps ended where the objective falls no more though its slopes promise it: pairs of modes change ahead, or the digits of
    /// an analysis tell no lower place.
    Short,
    /// The passes, iterations or trials allowed were used up.
    Cap,
    /// The caller asked to stop.
    Request,
    /// Not one step was taken: the first was uphill with all its halvings, or no pass was allowed.
    Nothing,
}

impl End {
    /// A sentence on it, empty for tolerances that are met.
    pub fn words(self) -> String {
        let words = match self {
            Self::Tolerance => "",
            Self::LocalMinimum => "No further step lowered it.",
            Self::Lowest => {
                return format!(
                    "Steps ended at a stationary place, and nothing lower was found from {PLACES} others."
                );
            }
            Self::Stationary => "Steps ended at a stationary place; a lower place may exist.",
            Self::Short => {
                "Steps ended short of a minimum: ahead of them no place is lower, where their slopes promise one; a lower place may exist."
            }
            Self::Cap => "The iterations or passes allowed ran out.",
            Self::Request => "It was stopped by request.",
            Self::Nothing => "No step from the first model lowered it, or none was allowed.",
        };
        words.to_owned()
    }

    /// True at a minimum of weighted steps, about which intervals hold.
    pub fn is_stationary(self) -> bool {
        matches!(self, Self::Lowest | Self::Stationary)
    }

    /// True of weighted steps that may have more to lower.
    pub fn is_early(self) -> bool {
        matches!(self, Self::Short | Self::Cap | Self::Request)
    }

    /// The end of the paper's loops.
    pub fn of_loops(run: &Correlation, is_stopped: bool) -> Self {
        let mut passes = run.passes.iter();
        let has_stepped = passes.any(|pass| !pass.inner.iterations.is_empty());
        match run.passes.last() {
            _ if is_stopped && !run.converged => Self::Request,
            _ if !has_stepped && !run.converged => Self::Nothing,
            Some(pass) if pass.inner.stop == Stop::LocalMinimum => Self::LocalMinimum,
            _ if run.converged => Self::Tolerance,
            _ => Self::Cap,
        }
    }
}

impl From<Stop> for End {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Tolerance => Self::Tolerance,
            Stop::LocalMinimum => Self::LocalMinimum,
            Stop::Iterations => Self::Cap,
        }
    }
}

/// Verdict on a correlation, at its best factors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Reason why it ended.
    pub end: End,
    /// Whether the exact modes at the best factors meet the tolerances.
    pub is_within: bool,
    /// Error sum there: the number that the tolerance is compared with.
    pub error_sum: f64,
    /// The test mode with the largest errors there, from zero.
    pub worst_mode: usize,
    /// Its errors.
    pub worst: ModeErrors,
    /// Parameters at an end of their range, from zero.
    pub at_bound: Vec<usize>,
    /// Parameters that no test mode has [`UNSEEN_SHARE`] of its stiffness or mass in, from zero.
    pub unseen: Vec<usize>,
}

/// Error sum that nine modes of the same root mean square errors would have.
pub(crate) fn sum_of_nine_modes(errors: &Errors) -> f64 {
    3.0 * (errors.frequency_rms() + errors.shape_rms())
}

impl Verdict {
    /// The verdict on a correlation that is best at `factors`, within these bounds, where the test modes have the error sum and `errors`.
    pub fn new(
        (end, is_within): (End, bool),
        (error_sum, errors): (f64, &[ModeErrors]),
        factors: &[f64],
        ranges: &[Option<Bounds>],
    ) -> Self {
        let worst_mode = (0..errors.len())
            .max_by(|&a, &b| errors[a].square().total_cmp(&errors[b].square()))
            .unwrap_or(0);
        let at_end = |e: &usize| ranges[*e].is_some_and(|range| is_at_end(range, factors[*e]));
        Self {
            end,
            is_within,
            error_sum,
            worst_mode,
            worst: errors.get(worst_mode).copied().unwrap_or_default(),
            at_bound: (0..factors.len()).filter(at_end).collect(),
            unseen: Vec::new(),
        }
    }

    /// The verdict on a case of the paper.
    pub fn of_case(result: &CaseResult) -> Self {
        let run = &result.correlation;
        let (end, factors) = (End::of_loops(run, false), &run.best_factors);
        let errors = result.best_errors.iter().copied();
        let errors: Vec<ModeErrors> = errors.map(ModeErrors::from).collect();
        let sums = (run.best_check().errors.sum(), &errors[..]);
        let is_unseen = |&e: &usize| factors[e] * result.seen[e] < UNSEEN_SHARE;
        Self {
            unseen: (0..factors.len()).filter(is_unseen).collect(),
            ..Self::new((end, run.converged), sums, factors, &result.ranges)
        }
    }
}
