//! The verdict on a case in words.

use corfem::job::verdict::Verdict;
use corfem::present::verdict::verdict_in_words;
use corfem::torque_box::CaseResult;

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
