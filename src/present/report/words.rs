//! The answer and the verdict in words.

use super::{Parameter, Rms};
use crate::job::verdict::{End, Verdict};
use crate::job::{History, JobResult};
use crate::method::step::StepRule;
use crate::present::table::RMS_PERCENT;

/// One line on a finished job: what is against it, the errors before and after, the factors that differ from 1, the surest change first, and
/// how many do not; parameters come in this order.
pub(super) fn answer(result: &JobResult, errors: &[Rms], parameters: &[Parameter]) -> String {
    let against = match &result.verdict {
        _ if result.trust.stands_against() => "Not to be trusted as it stands: ",
        _ if missed(result).is_some() => "The model does not hold where it was not fitted: ",
        verdict if verdict.is_within => "",
        _ if !is_weighted(result) => "Outside tolerance: ",
        _ if !result.misfit.is_by_noise() => "The model does not explain the test: ",
        _ if is_untested(result) => "The test confirms nothing: ",
        _ => "Steps ended short: ",
    };
    let fall = |own: &Rms| {
        let [first, last] =
            [own.first_percent, own.corrected_percent].map(|it| RMS_PERCENT.write(it));
        match own.error.split_once(", ") {
            Some((_, held_out)) => format!("{held_out} {first} → {last} %"),
            None => format!("{} error {first} → {last} %", own.error),
        }
    };
    let errors = errors.iter().map(fall).collect::<Vec<_>>().join(", ");
    let (all, told) = (
        parameters.len(),
        parameters.iter().filter(|own| own.low.is_some()),
    );
    let told: Vec<&Parameter> = told.collect();
    let differs =
        |own: &&&Parameter| own.low > Some(1.0) || own.high.is_some_and(|high| high < 1.0);
    let changed: Vec<&&Parameter> = told.iter().filter(differs).collect();
    let named = |own: &&&Parameter| {
        let percent = format!("{:+.1}", own.change_percent).replace('-', "−");
        format!("{} {percent} %", own.parameter)
    };
    let names = changed.iter().map(named).collect::<Vec<_>>().join(", ");
    let changes = match (told.len(), changed.len()) {
        (0, _) => "no factor has an interval".to_owned(),
        (told, count) => format!(
            "{count} of {all} factors differ from 1 beyond their interval, if only these are wrong{}{names}; {} unchanged, {} unknown",
            if count > 0 { ": " } else { "" },
            told - count,
            all - told
        ),
    };
    let line = format!("{against}{errors}; {changes}.");
    line[..1].to_uppercase() + &line[1..]
}

/// True if the noise decides the verdict, and not the tolerances of the paper's loops.
fn is_weighted(result: &JobResult) -> bool {
    matches!(result.found.history, History::GaussNewton(_))
}

/// True if noise may have left the residuals, and those of a wrong model as well.
fn is_untested(result: &JobResult) -> bool {
    let misfit = &result.misfit;
    let is_early = result.verdict.end.is_early();
    is_weighted(result) && misfit.is_by_noise() && !misfit.can_fail() && !is_early
}

/// Words for modes held out that the model does not hold for.
fn missed(result: &JobResult) -> Option<&String> {
    result.predicted.as_ref()?.missed.as_ref()
}

/// The verdict on a finished job. Bounds and what is not seen are remarks, and a doubt is answered before anything else is tried.
pub(super) fn verdict_of_job(result: &JobResult) -> String {
    let verdict = &result.verdict;
    let judged = is_weighted(result).then(|| result.misfit.in_words());
    let judged = judged.unwrap_or_else(|| by_tolerance(verdict));
    let judged = missed(result)
        .into_iter()
        .cloned()
        .chain([judged])
        .collect::<Vec<_>>();
    let numbers: Vec<usize> = result
        .found
        .prepared
        .compared()
        .map(|mode| mode + 1)
        .collect();
    let lower = match verdict.end {
        End::Cap if is_weighted(result) => "A lower place may exist.",
        _ => "",
    };
    let next = match verdict.is_within || result.trust.has_doubt() {
        true => "",
        false if is_untested(result) => {
            "Compare more modes or sensors, or group the parameters; the test confirms nothing."
        }
        false => advice(verdict),
    };
    sentences([
        &judged.join(" "),
        &verdict.end.words(),
        lower,
        &worst(verdict, &numbers),
        next,
    ])
}

/// Sentences one behind the other, without those that are empty.
pub fn sentences<const N: usize>(all: [&str; N]) -> String {
    all.into_iter()
        .filter(|own| !own.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// A sentence on the error sum beside the tolerance of the paper's loops.
pub fn by_tolerance(verdict: &Verdict) -> String {
    let error_sum = format!("error sum {:.2} %", 100.0 * verdict.error_sum);
    match verdict.is_within {
        true => format!("Correlated: {error_sum}, within tolerance."),
        false => format!("Outside tolerance: {error_sum}."),
    }
}

/// A sentence on the mode with the largest errors.
pub fn worst(verdict: &Verdict, mode_numbers: &[usize]) -> String {
    let shape = verdict
        .worst
        .shape
        .map(|shape| format!(", shape {:.2} % RMS", 100.0 * shape));
    format!(
        "Worst is mode {}: frequency {:+.2} %{}.",
        mode_numbers
            .get(verdict.worst_mode)
            .map_or(verdict.worst_mode + 1, |number| *number),
        // Rounding first keeps a minus sign off zero.
        (1e4 * verdict.worst.frequency).round() / 100.0 + 0.0,
        shape.unwrap_or_default()
    )
}

/// Advice on the next try.
pub fn advice(verdict: &Verdict) -> &'static str {
    match verdict.end {
        End::Cap => "Try more iterations or passes.",
        End::Nothing => "Look for a mistake in the test's units, sensors or order of modes.",
        _ if !verdict.at_bound.is_empty() => {
            "Try wider bounds, or look at how the elements at a bound are modeled."
        }
        _ => {
            "Try other parameters or groups, or look at how the elements of the worst mode are modeled."
        }
    }
}

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
