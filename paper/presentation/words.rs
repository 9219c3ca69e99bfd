//! The verdict on a case in words.

use corfem::job::verdict::Verdict;
use corfem::present::report::words::{advice, by_tolerance, sentences, worst};
use corfem::torque_box::CaseResult;

/// The verdict on a correlation by the paper's loops in sentences, with the parameters' names and the numbers of the test modes; places
/// from one stand for those that have none.
pub fn verdict_in_words(verdict: &Verdict, names: &[String], mode_numbers: &[usize]) -> String {
    let named = |start: &str, places: &[usize]| {
        let name = |&e: &usize| names.get(e).cloned().unwrap_or_else(|| (e + 1).to_string());
        let all = places.iter().map(name).collect::<Vec<_>>().join(", ");
        if all.is_empty() {
            all
        } else {
            format!("{start}: {all}.")
        }
    };
    sentences([
        &by_tolerance(verdict),
        &verdict.end.words(),
        &worst(verdict, mode_numbers),
        &named("At a bound", &verdict.at_bound),
        &named(
            "Hardly seen by the test modes, and so not to be trusted",
            &verdict.unseen,
        ),
        if verdict.is_within {
            ""
        } else {
            advice(verdict)
        },
    ])
}

/// [`verdict_in_words`] on a case, with the parameters that its test cannot tell apart, and the change that a weighted step would
/// still make.
pub fn case_in_words(result: &CaseResult) -> String {
    let names = &result.parameter_names;
    let mut words = verdict_in_words(&Verdict::of_case(result), names, &[]);
    let Some(next) = &result.next_step else {
        return words;
    };
    let pairs = next.seen.parallel.iter();
    let pairs: Vec<String> = pairs
        .map(|&(a, b, _)| format!("{} and {}", names[a], names[b]))
        .collect();
    let moved = next.moved().into_iter();
    let moved: Vec<String> = moved
        .map(|(e, size)| format!("{} by {size:.1}", names[e]))
        .collect();
    let step = format!(
        "In standard deviations of a test with errors of {} % in frequencies and {} % in shapes, one weighted step from here would \
         still move",
        100.0 * next.noise.frequency,
        100.0 * next.noise.shape,
    );
    for (start, list) in [("The test cannot tell apart:", pairs), (&step, moved)] {
        if !list.is_empty() {
            words += &format!(" {start} {}.", list.join(", "));
        }
    }
    words
}
