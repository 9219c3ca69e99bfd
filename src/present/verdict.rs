//! What a correlation came to, in words.

use crate::method::verdict::{Outcome, Verdict};

/// The verdict in sentences, with the parameters' names; numbers stand for those that have none.
pub fn verdict_in_words(verdict: &Verdict, names: &[String]) -> String {
    let named = |indices: &[usize]| {
        let name = |&e: &usize| names.get(e).cloned().unwrap_or_else(|| (e + 1).to_string());
        indices.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let within = if verdict.is_within {
        "within tolerance"
    } else {
        "outside tolerance"
    };
    let mut words = match verdict.outcome {
        Outcome::Tolerance => "Within tolerance".to_owned(),
        Outcome::LocalMinimum => format!("Stopped at a local minimum, {within}"),
        Outcome::Cap => {
            "Stopped by the number of iterations or passes allowed, outside tolerance".to_owned()
        }
        Outcome::Nothing => {
            "Nothing could be done, outside tolerance: no step from the first model lowers the \
                             error sum, or none was allowed"
                .to_owned()
        }
    };
    words += &format!(
        ": error sum {:.2} %. Worst is mode {}: frequency {:+.2} %, shape {:.2} % RMS.",
        100.0 * verdict.error_sum,
        verdict.worst_mode + 1,
        // Rounded first, so that no zero has a minus sign.
        (1e4 * verdict.worst.frequency).round() / 100.0 + 0.0,
        100.0 * verdict.worst.shape
    );
    if !verdict.at_bound.is_empty() {
        words += &format!(" At a bound: {}.", named(&verdict.at_bound));
    }
    if !verdict.unseen.is_empty() {
        words += &format!(
            " Hardly seen by the test modes, and so not to be trusted: {}.",
            named(&verdict.unseen)
        );
    }
    if !verdict.is_within {
        words += match verdict.outcome {
            Outcome::Cap => " Try more iterations or passes.",
            Outcome::Nothing => {
                " Look for a mistake in the test's units, sensors or order of modes."
            }
            _ if !verdict.at_bound.is_empty() => {
                " Try wider bounds, or look at how the elements at a bound are modeled."
            }
            _ => {
                " Try other parameters or groups, or look at how the elements of the worst mode are modeled."
            }
        };
    }
    words
}
