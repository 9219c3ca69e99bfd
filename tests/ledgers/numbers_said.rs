//! The ledger of numbers, `tests/numbers.toml`: every sentence with a number outside the tour, with where one of its numbers stands: as a
//! literal in a test, in what that test names, or in a file; or in a computed cell.

use crate::ledgers::claims::assert_listed;
use crate::ledgers::documents::documents_and_readmes;
use crate::ledgers::equations::defines;
use crate::ledgers::tables;
use crate::ledgers::weight::is_word;
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

/// Numbers that a sentence says, other than those that name something, and than zero and one, of which formulas are made.
fn numbers_of(sentence: &str) -> Vec<f64> {
    let plain = plain(sentence);
    let (mut is_name, mut numbers) = (false, Vec::new());
    for word in plain.split_whitespace() {
        let bare = word
            .trim_matches(|c: char| !c.is_alphanumeric())
            .to_lowercase();
        let has_digit = bare.chars().any(|c| c.is_ascii_digit());
        let joins = ["to", "and", "or"].contains(&&*bare);
        if bare.split('.').count() > 2 {
            // A section.
            is_name = false;
        } else if has_digit {
            let begins = bare.starts_with(|c: char| c.is_ascii_digit());
            let said = literals(&bare.replace(',', "")).into_iter().next();
            numbers.extend(said.filter(|own| begins && !is_name && ![0.0, 1.0].contains(own)));
        } else if !joins {
            is_name = NAMES.contains(&&*bare);
        }
    }
    // The number of a point of a list says nothing.
    let has_words = plain.chars().any(char::is_alphabetic);
    numbers.retain(|_| has_words);
    numbers
}

fn is_numeric(sentence: &str) -> bool {
    !numbers_of(sentence).is_empty()
}

/// Numbers that stand in a text, those on both sides of a dash too.
fn literals(text: &str) -> Vec<f64> {
    let text = text.replace('_', "").replace("..", " ");
    let words = text.split(|c: char| !c.is_ascii_digit() && !".e-".contains(c));
    let parsed = words.flat_map(|word| {
        let word = word.trim_matches(|c: char| !c.is_ascii_digit());
        let parts = word
            .parse::<f64>()
            .map_or_else(|_| word.split('-').collect(), |_| vec![word]);
        parts
            .into_iter()
            .filter_map(|part| part.parse().ok())
            .collect_vec()
    });
    parsed.collect()
}

/// Text of a test with the functions and constants that it names of its file and of the tolerances.
fn text_of(test: &str) -> String {
    let (module, name) = test.rsplit_once("::").unwrap();
    let path = module.replace("::", "/");
    let files = [
        format!("{path}.rs"),
        format!("{path}/mod.rs"),
        "common/tolerances.rs".to_owned(),
    ];
    let read = |file: &String| fs::read_to_string(in_root("tests").join(file)).ok();
    let all: String = files.iter().filter_map(read).collect();
    let item = |start: &str, end: &str| {
        let (_, rest) = all.split_once(start)?;
        rest.split(end).next()?.split("#[test]").next()
    };
    let body = item(&format!("fn {name}("), "\n}").unwrap();
    let named: BTreeSet<&str> = body.split(|c| !is_word(c)).collect();
    let items = named.iter().flat_map(|name| {
        [
            item(&format!("fn {name}("), "\n}"),
            item(&format!("const {name}:"), ";\n"),
            item(&format!("static {name}:"), ";\n"),
        ]
    });
    items
        .flatten()
        .fold(body.to_owned(), |text, item| text + item)
}

/// True if one of the numbers is a literal of a text: as it is, in percent, or in tenths.
fn stands_in(text: &str, numbers: &[f64]) -> bool {
    let literals = literals(text);
    let scaled = numbers
        .iter()
        .flat_map(|own| [1.0, 0.01, 10.0].map(|scale| scale * own));
    let mut pairs = scaled.flat_map(|number| literals.iter().map(move |own| (number, own)));
    pairs.any(|(number, own)| (number - own).abs() <= 1e-9 * own.abs())
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
        let numbers = numbers_of(sentence);
        let is_said = |(document, phrase): &(&str, String)| {
            let (phrase, sentence) = (words(phrase), words(sentence));
            *document == name && (sentence.contains(&phrase) || phrase.contains(&sentence))
        };
        let text = match from.split_once(": ") {
            Some(("measured", file)) => return in_root(file).exists(),
            Some((_, cell)) => {
                let (place, how) = cell.rsplit_once(':').unwrap();
                Some(tables::number(place, how))
            }
            None if from == COMPUTED => return computed.iter().any(is_said),
            None if from == "cited" => return true,
            // A document may be its own source where its code computes.
            None if from == name => return documents[name].contains("```rust"),
            None if from.contains("::") => {
                defines("tests", from, &["]\nfn ", "]\n    fn "]).then(|| text_of(from))
            }
            None => fs::read_to_string(in_root(from)).ok(),
        };
        text.is_some_and(|text| stands_in(&text, &numbers))
    };
    assert_listed("tests/numbers.toml", &documents, is_numeric, is_right);
}

#[test]
fn a_source_must_have_a_number_of_its_sentence() {
    let text = "assert_eq!(found, [0.0206, 74]); let range = 1e-6..=2e-5;";
    for number in [2.06, 7.4, 74.0, 2e-5] {
        assert!(stands_in(text, &[number]), "{number}");
    }
    assert!(!stands_in(text, &[3.0]));
    let test = "ledgers::numbers_said::a_source_must_have_a_number_of_its_sentence";
    assert!(stands_in(&text_of(test), &[2.06]));
}

#[test]
fn a_number_that_names_something_is_none() {
    for named in [
        "By Case 4, (13) and Tables 10 to 12.",
        "See `x1.5` in [this](a1.md).",
        "By 3.3.6 c = 1.",
        "3.",
    ] {
        assert!(!is_numeric(named), "{named}");
    }
    for said in [
        "Case 4 has 60.",
        "It is 1.5 %.",
        "By 2 of them.",
        "It has 1,326 and 3e-7.",
    ] {
        assert!(is_numeric(said), "{said}");
    }
}
