//! The verdict on a correlation in words.

use crate::job::verdict::{Outcome, Stationary, Verdict};
use crate::weighted::lower_place::PLACES;

/// The verdict in sentences, with the parameters' names and the numbers of the test modes; places from one stand for those that
/// have none.
pub fn verdict_in_words(verdict: &Verdict, names: &[String], mode_numbers: &[usize]) -> String {
    let named = |indices: &[usize]| {
        let name = |&e: &usize| names.get(e).cloned().unwrap_or_else(|| (e + 1).to_string());
        indices.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let mut words = outcome_in_words(verdict, None, mode_numbers);
    if !verdict.at_bound.is_empty() {
        words += &format!(" At a bound: {}.", named(&verdict.at_bound));
    }
    if !verdict.unseen.is_empty() {
        words += &format!(
            " Hardly seen by the test modes, and so not to be trusted: {}.",
            named(&verdict.unseen)
        );
    }
    words + advice(verdict)
}

/// The end of a correlation in sentences. The criterion it is `judged` by stands first; without one that is the tolerance.
pub(super) fn outcome_in_words(
    verdict: &Verdict,
    judged: Option<&str>,
    mode_numbers: &[usize],
) -> String {
    let end = match verdict.outcome {
        _ if verdict.stationary == Some(Stationary::Lowest) => &format!(
            " Steps ended at a stationary place, and nothing lower was found from {PLACES} others."
        ),
        _ if verdict.stationary.is_some() => {
            " Steps ended at a stationary place; a lower place may exist."
        }
        Outcome::Tolerance | Outcome::Untested => "",
        Outcome::LocalMinimum => " No further step lowered it.",
        Outcome::Short => {
            " Steps ended short of a minimum: ahead of them no place is lower, where their slopes promise one; a lower place may exist."
        }
        Outcome::Cap if judged.is_some() => " The steps allowed ran out; a lower place may exist.",
        Outcome::Cap => " The iterations or passes allowed ran out.",
        Outcome::Request => " It was stopped by request.",
        Outcome::Nothing => " No step from the first model lowered it, or none was allowed.",
    };
    let by_tolerance = || {
        let error_sum = format!("error sum {:.2} %", 100.0 * verdict.error_sum);
        if verdict.is_within {
            format!("Correlated: {error_sum}, within tolerance.")
        } else {
            format!("Outside tolerance: {error_sum}.")
        }
    };
    let judged = judged.map_or_else(by_tolerance, str::to_owned);
    format!(
        "{judged}{end} Worst is mode {}: frequency {:+.2} %{}.",
        mode_numbers
            .get(verdict.worst_mode)
            .map_or(verdict.worst_mode + 1, |number| *number),
        // Rounding first keeps a minus sign off zero.
        (1e4 * verdict.worst.frequency).round() / 100.0 + 0.0,
        verdict
            .worst
            .shape
            .map_or_else(String::new, |shape| format!(
                ", shape {:.2} % RMS",
                100.0 * shape
            ))
    )
}

/// Advice on the next try, if there is a reason for one.
pub(super) fn advice(verdict: &Verdict) -> &'static str {
    match verdict.outcome {
        _ if verdict.is_within => "",
        Outcome::Cap => " Try more iterations or passes.",
        Outcome::Untested => {
            " Compare more modes or sensors, or group the parameters; the test confirms nothing."
        }
        Outcome::Nothing => " Look for a mistake in the test's units, sensors or order of modes.",
        _ if !verdict.at_bound.is_empty() => {
            " Try wider bounds, or look at how the elements at a bound are modeled."
        }
        _ => {
            " Try other parameters or groups, or look at how the elements of the worst mode are modeled."
        }
    }
}
