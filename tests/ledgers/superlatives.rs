//! The ledger of superlatives, `tests/superlatives.toml`: every sentence of the documents that ranks, with its rivals or what it is.

use crate::ledgers::claims::assert_listed;
use crate::ledgers::documents::documents_and_readmes;
use crate::ledgers::equations::defines;
use crate::ledgers::tables::computed_at;
use crate::prelude::*;

/// Words of a sentence that ranks.
const WORDS: [&str; 19] = [
    "best",
    "worst",
    "most",
    "least",
    "largest",
    "smallest",
    "greatest",
    "nearest",
    "closest",
    "farthest",
    "fewest",
    "longest",
    "shortest",
    "strongest",
    "weakest",
    "fastest",
    "slowest",
    "than any",
    "than either",
];

/// Words that rank nothing: bounds, a method, a majority, and what numbers are relative to.
const OTHERS: [&str; 7] = [
    "at most",
    "at least",
    "at best",
    "least squares",
    "most of",
    "largest component",
    "largest entry",
];

#[derive(Deserialize)]
#[serde(untagged)]
enum Source {
    Ranks(Vec<Rank>),
    /// The test that ranks; `defined`, where it says what is computed or done and compares no results; or `outside this crate`, as it
    /// says.
    Said(String),
}

/// Places of goldens whose numbers have, in magnitude, the least or the most of all.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Rank {
    #[serde(default)]
    least: Vec<String>,
    #[serde(default)]
    most: Vec<String>,
    of: Vec<String>,
    /// By how much a rival may be ahead.
    #[serde(default)]
    within: f64,
}

impl Rank {
    fn holds(&self) -> bool {
        let all = |places: &[String]| -> BTreeMap<&str, f64> {
            places.iter().flat_map(|own| computed_at(own)).collect()
        };
        let (least, most, mut rivals) = (all(&self.least), all(&self.most), all(&self.of));
        rivals.retain(|place, _| !least.contains_key(place) && !most.contains_key(place));
        let is_behind = |rival: &f64| {
            least
                .values()
                .all(|own| own.abs() <= rival.abs() + self.within)
                && most
                    .values()
                    .all(|own| own.abs() >= rival.abs() - self.within)
        };
        !rivals.is_empty() && rivals.values().all(is_behind)
    }
}

fn ranks(sentence: &str) -> bool {
    let words: String = sentence.split('`').step_by(2).collect();
    // "Most panels" at the head is a majority.
    let lower = words.replace("Most ", "").to_lowercase();
    let plain = OTHERS.iter().fold(lower, |text, own| text.replace(own, ""));
    let plain = format!(" {} ", plain.replace(|c: char| !c.is_alphanumeric(), " "));
    WORDS
        .iter()
        .any(|word| plain.contains(&format!(" {word} ")))
}

#[test]
fn every_superlative_is_of_all_its_rivals() {
    let is_right = |document: &str, sentence: &str, source: &Source| match source {
        Source::Ranks(all) => all.iter().all(Rank::holds),
        Source::Said(own) => {
            own == "defined"
                || own == "outside this crate" && sentence.contains(own)
                || own == document && own.starts_with("paper/tour/")
                || defines("tests", own, &["]\nfn ", "]\n    fn "])
        }
    };
    let documents = documents_and_readmes();
    assert_listed("tests/superlatives.toml", &documents, ranks, is_right);
}
