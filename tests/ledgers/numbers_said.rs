//! The ledger of numbers, `tests/numbers.toml`: every sentence with a number outside the tour, with the test or file that its number comes
//! from.

use crate::ledgers::claims::assert_listed;
use crate::ledgers::documents::documents_and_readmes;
use crate::ledgers::equations::defines;
use crate::ledgers::tables;
use crate::prelude::*;

/// Sentences whose computed words are asserted.
const COMPUTED: &str = "ledgers::documents::sentences_in_documents_are_what_the_program_computes";

/// What a number counts that says no quantity: parts of the paper, names and places.
const NAMES: [&str; 40] = [
    "case",
    "cases",
    "table",
    "tables",
    "chapter",
    "chapters",
    "recursive",
    "element",
    "elements",
    "panel",
    "panels",
    "pass",
    "eq.",
    "step",
    "fem",
    "mode",
    "modes",
    "tn",
    "tp",
    "sm-ag",
    "v.",
    "dataset",
    "datasets",
    "nastran-",
    "output",
    "cord",
    "page",
    "figure",
    "version",
    "rust",
    "python",
    "appendix",
    "section",
    "grid",
    "grids",
    "reference",
    "references",
    "sensor",
    "sensors",
    "volume",
];

/// A sentence without code, the targets of links, formulas and numbers of equations.
fn plain(sentence: &str) -> String {
    let mut text = String::new();
    for (place, part) in sentence.split('`').enumerate() {
        text += if place % 2 == 0 { part } else { "" };
    }
    let mut rest = String::new();
    for (place, part) in text.split("](").enumerate() {
        rest += match place {
            0 => part,
            _ => part.split_once(')').map_or("", |(_, after)| after),
        };
    }
    let outside = rest.split('$').step_by(2).collect_vec().join(" ");
    // Numbers of equations: (13), (C.22), (7, 8).
    let mut plain = String::new();
    for (place, part) in outside.split('(').enumerate() {
        let inside = part.split_once(')').filter(|_| place > 0);
        plain += match inside {
            Some((inside, after)) if is_equations(inside) => after,
            _ => part,
        };
    }
    plain
}

fn is_equations(inside: &str) -> bool {
    let words = inside.split([',', ' ']).filter(|word| !word.is_empty());
    let is_one = |word: &str| {
        let number = word.trim_start_matches(['A', 'B', 'C', '.']);
        ["to", "and"].contains(&word) || number.parse::<u32>().is_ok_and(|number| number < 40)
    };
    !inside.is_empty() && words.into_iter().all(is_one)
}

/// True of a sentence that says a number, other than one that names something.
fn is_numeric(sentence: &str) -> bool {
    let plain = plain(sentence);
    let mut is_name = false;
    for word in plain.split_whitespace() {
        let bare = word
            .trim_matches(|c: char| !c.is_alphanumeric())
            .to_lowercase();
        let has_digit = bare.chars().any(|c| c.is_ascii_digit());
        let joins = ["to", "and", "or"].contains(&&*bare);
        if has_digit {
            let begins = bare.starts_with(|c: char| c.is_ascii_digit());
            if begins && !is_name {
                return true;
            }
        } else if !joins {
            is_name = NAMES.contains(&&*bare);
        }
    }
    false
}

fn words(text: &str) -> String {
    text.split_whitespace().collect_vec().join(" ")
}

#[test]
fn every_sentence_with_a_number_says_where_it_comes_from() {
    let computed = tables::sentences();
    let mut documents = documents_and_readmes();
    documents.retain(|name, _| !name.starts_with("paper/tour/"));
    let is_right = |name: &str, sentence: &str, from: &String| {
        let file = from.strip_prefix("measured: ").unwrap_or(from);
        let is_there = match from.contains("::") {
            true => defines("tests", from, &["]\nfn ", "]\n    fn "]),
            // A document may be its own source where its code computes.
            false => {
                in_root(file).exists() && (file != name || documents[name].contains("```rust"))
            }
        };
        let is_said = |(document, phrase): &(&str, String)| {
            let (phrase, sentence) = (words(phrase), words(sentence));
            *document == name && (sentence.contains(&phrase) || phrase.contains(&sentence))
        };
        is_there && (from != COMPUTED || computed.iter().any(is_said))
    };
    assert_listed("tests/numbers.toml", &documents, is_numeric, is_right);
}

#[test]
fn a_number_that_names_something_is_none() {
    for named in [
        "By Case 4, (13) and Tables 10 to 12.",
        "See `x1.5` in [this](a1.md).",
    ] {
        assert!(!is_numeric(named), "{named}");
    }
    for said in ["Case 4 has 60.", "It is 1.5 %.", "By 2 of them."] {
        assert!(is_numeric(said), "{said}");
    }
}
