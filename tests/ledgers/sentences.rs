//! The ledgers of sentences: `tests/claims.toml` has those on the step or on Case 4, with what each holds for and the test behind it;
//! `tests/numbers.toml` those with a number, with where one of its numbers stands; `tests/superlatives.toml` those that rank, with their
//! rivals.

use crate::ledgers::{
    defines, documents, documents_and_readmes, file, files, is_test, is_word, tables, words,
};
use crate::prelude::*;
use toml::Value;

/// What a sentence on the step or on Case 4 says, or on what the paper says in words; wrong readings of sensors are not of the step.
const CLAIMS: &str = "The paper finds|the shape that differs|box rods have|aper's wing|or exceeds|Case 4|lement 8|by own|by relative|by gage|\
    reading own|reading relative|reading matrix|reading gage|readings own|four readings|Four readings|the reading whose|\
    reading of the step|readings of the step|No reading|any reading|every reading|Relative |Half lies|Own and matrix|own and matrix|\
    gages of relative";

/// The tests that run at least twenty other boxes.
const OF_OTHER_BOXES: [&str; 4] = [
    "cargo bench --bench studies -- --check detection",
    "contents::s4_readings::on_other_boxes_relative_is_compared_with_every_reading",
    "contents::s4_readings::changes_add_on_thirty_other_boxes",
    "contents::s4_covers::covers_of_a_bay_that_begin_alike_stay_alike_under_any_rule",
];

/// What a number counts that says no quantity: parts of the paper, names and places.
const NAMES: &str = "case cases table tables chapter chapters recursive element elements panel panels pass eq. step fem mode modes tn tp \
    sm-ag v. dataset datasets nastran- output cord page figure version rust python appendix section grid grids reference references \
    sensor sensors volume";

/// Words of a sentence that ranks.
const RANKS: &str = "best|worst|most|least|largest|smallest|greatest|nearest|closest|farthest|fewest|longest|shortest|strongest|weakest|\
    fastest|slowest|than any|than either";

/// Words that rank nothing: bounds, a method, a majority, and what numbers are relative to.
const RANKS_NOTHING: &str =
    "at most|at least|at best|least squares|most of|largest component|largest entry";

/// A sentence of a document, with its paragraph.
struct Said {
    document: &'static str,
    sentence: String,
    paragraph: String,
}

/// Paragraphs and points of lists on one line each, without code, computed blocks, tables, images, formulas, headings and links on to the
/// next chapter.
fn paragraphs(text: &str) -> Vec<String> {
    let (mut all, mut open) = (Vec::new(), String::new());
    let (mut is_code, mut is_block) = (false, false);
    for line in text.lines().map(str::trim).chain([""]) {
        let is_fence = line.starts_with("```");
        is_code ^= is_fence;
        if line.starts_with("<!-- ") {
            // Another comment stands alone.
            is_block = line.starts_with("<!-- computed: ");
        }
        let is_other = is_code
            || is_block
            || is_fence
            || line.contains("Previous: [")
            || line.contains("Next: [")
            || line.starts_with(['#', '|', '<', '$'])
            || line.starts_with("![");
        let is_point = line.starts_with("- ") || line.starts_with("* ");
        if line.is_empty() || is_other || is_point {
            all.push(words(&std::mem::take(&mut open)));
        }
        if !is_other {
            open += &format!("{line} ");
        }
    }
    all
}

/// The sentences of documents.
fn said(documents: &[(&'static str, &'static str)]) -> Vec<Said> {
    let mut all = Vec::new();
    for (document, text) in documents {
        for paragraph in paragraphs(text) {
            let mut marked = paragraph.clone();
            for end in [". ", ".** ", "? "] {
                marked = marked.replace(end, &format!("{end}\0"));
            }
            for sentence in marked.split('\0').map(str::trim) {
                let (sentence, paragraph) = (sentence.to_owned(), paragraph.clone());
                all.push(Said {
                    document,
                    sentence,
                    paragraph,
                });
            }
        }
    }
    all.retain(|own| !own.sentence.is_empty());
    all
}

/// What is wrong with a list: sentences that are meant and missing, and entries that nobody says or whose source is not right.
fn listed(
    list: &str,
    documents: &[(&'static str, &'static str)],
    is_meant: fn(&str) -> bool,
    is_right: &dyn Fn(&Said, &Value) -> bool,
) -> Vec<String> {
    let mut entries = Vec::new();
    for (document, own) in file(list).parse::<toml::Table>().unwrap() {
        match own {
            Value::Table(own) => {
                entries.extend(
                    own.into_iter()
                        .map(|(sentence, source)| (document.clone(), sentence, source)),
                );
            }
            // A claim has both among what it says.
            own => entries.extend(own.as_array().unwrap().iter().map(|claim| {
                let [document, sentence] =
                    ["document", "sentence"].map(|key| claim[key].as_str().unwrap().to_owned());
                (document, sentence, claim.clone())
            })),
        }
    }
    let (said, mut wrong) = (said(documents), Vec::new());
    let is_of = |own: &Said, (document, sentence, _): &(String, String, Value)| {
        (own.document, &own.sentence) == (document, sentence)
    };
    for own in said.iter().filter(|own| is_meant(&own.sentence)) {
        if !entries.iter().any(|entry| is_of(own, entry)) {
            wrong.push(format!("{}: not in {list}: {}", own.document, own.sentence));
        }
    }
    for entry in &entries {
        let own = said.iter().find(|own| is_of(own, entry));
        if !own.is_some_and(|own| is_right(own, &entry.2)) {
            wrong.push(format!(
                "{list}: {}: not said, or not from there: {}",
                entry.0, entry.1
            ));
        }
    }
    wrong
}

/// Whether a test shows a sentence; a chapter of the tour is a test itself: its code computes what it says.
fn shows(test: &str, own: &Said) -> bool {
    let is_chapter = test == own.document && test.starts_with("paper/tour/");
    is_chapter || is_test(test) || OF_OTHER_BOXES[0] == test
}

pub fn every_sentence_on_the_step_or_on_case_4_has_its_test() -> Vec<String> {
    // Names of readings stand in backticks or without.
    let is_claim = |sentence: &str| {
        let plain = sentence.replace('`', "");
        CLAIMS.split('|').any(|word| plain.contains(word))
    };
    listed(
        "tests/claims.toml",
        &documents(),
        is_claim,
        &|own, claim| {
            let test = claim["test"].as_str().unwrap();
            let holds = match claim["holds"].as_str().unwrap() {
                "on_this_box" => own.paragraph.contains("this box"),
                "outside_this_crate" => own.paragraph.contains("outside this crate"),
                "on_other_boxes" => OF_OTHER_BOXES.contains(&test),
                holds => ["in_print", "by_definition"].contains(&holds),
            };
            holds && shows(test, own)
        },
    )
}

/// A sentence without code, the targets of links, formulas and numbers of equations: (13), (C.22), (7, 8).
fn plain(sentence: &str) -> String {
    let text: String = sentence.split('`').step_by(2).collect();
    let links = text.split("](").enumerate();
    let text = links.map(|(place, part)| match place {
        0 => part,
        _ => part.split_once(')').map_or("", |(_, after)| after),
    });
    let text = text.collect::<String>();
    let text = text.split('$').step_by(2).collect_vec().join(" ");
    let is_one = |word: &str| {
        let number = word.trim_start_matches(['A', 'B', 'C', '.']);
        ["", "to", "and"].contains(&word) || number.parse::<u32>().is_ok_and(|number| number < 40)
    };
    let is_equations = |inside: &str| !inside.is_empty() && inside.split([',', ' ']).all(is_one);
    let parts = text.split('(').enumerate();
    let parts = parts.map(|(place, part)| match part.split_once(')') {
        Some((inside, after)) if place > 0 && is_equations(inside) => after,
        _ => part,
    });
    parts.collect()
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
        if bare.split('.').count() > 2 {
            // A section.
            is_name = false;
        } else if has_digit {
            let begins = bare.starts_with(|c: char| c.is_ascii_digit());
            let said = literals(&bare.replace(',', "")).into_iter().next();
            numbers.extend(said.filter(|own| begins && !is_name && ![0.0, 1.0].contains(own)));
        } else if !["to", "and", "or"].contains(&&*bare) {
            is_name = NAMES.split(' ').any(|name| name == bare);
        }
    }
    // The number of a point of a list says nothing.
    numbers.retain(|_| plain.chars().any(char::is_alphabetic));
    numbers
}

/// Numbers that stand in a text, those on both sides of a dash too.
fn literals(text: &str) -> Vec<f64> {
    let (text, mut found) = (text.replace('_', "").replace("..", " "), Vec::new());
    for word in text.split(|c: char| !c.is_ascii_digit() && !".e-".contains(c)) {
        let word = word.trim_matches(|c: char| !c.is_ascii_digit());
        match word.parse() {
            Ok(number) => found.push(number),
            Err(_) => found.extend(word.split('-').filter_map(|part| part.parse::<f64>().ok())),
        }
    }
    found
}

/// Text of a test with the functions and constants that it names of its file and of the tolerances.
fn text_of(test: &str) -> String {
    let (module, name) = test.rsplit_once("::").unwrap();
    let path = format!("tests/{}", module.replace("::", "/"));
    let own = [
        files(&format!("{path}.rs"), ""),
        files(&format!("{path}/mod.rs"), ""),
    ]
    .concat();
    let items = own[0].1.split("\n\n");
    let items = items.chain(file("tests/common/tolerances.rs").split(";\n"));
    let items = items.filter_map(|item| {
        let mut kinds = ["fn ", "const ", "static "].into_iter();
        let (_, rest) = kinds.find_map(|kind| item.split_once(kind))?;
        Some((rest.split(|c| !is_word(c)).next()?, item))
    });
    let items = items.collect_vec();
    let body = items.iter().find(|(own, _)| *own == name).unwrap().1;
    let named: BTreeSet<&str> = body.split(|c| !is_word(c)).collect();
    let parts = items.iter().filter(|(own, _)| named.contains(own));
    parts.map(|(_, item)| *item).collect()
}

/// A source is a literal in a test, in what that test names, or in a file; or a computed cell, or a sentence that is computed.
pub fn every_sentence_with_a_number_says_where_it_comes_from() -> Vec<String> {
    let mut documents = documents_and_readmes();
    documents.retain(|(name, _)| !name.starts_with("paper/tour/"));
    let computed = tables::sentences();
    let is_numeric = |sentence: &str| !numbers_of(sentence).is_empty();
    listed(
        "tests/numbers.toml",
        &documents,
        is_numeric,
        &|own, from| {
            let from = from.as_str().unwrap();
            let text = match from.split_once(": ") {
                Some(("measured", file)) => return in_root(file).exists(),
                Some((_, cell)) => {
                    let (place, how) = cell.rsplit_once(':').unwrap();
                    tables::number(place, how)
                }
                None if from == "computed" => {
                    return computed.iter().any(|(document, phrase)| {
                        let phrase = words(phrase);
                        *document == own.document
                            && (own.sentence.contains(&phrase) || phrase.contains(&own.sentence))
                    });
                }
                None if from == "cited" => return true,
                // A document may be its own source where its code computes.
                None if from == own.document => return file(from).contains("```rust"),
                None if from.contains("::") => {
                    match defines("tests", from, &["]\nfn ", "]\n    fn "]) {
                        true => text_of(from),
                        false => return false,
                    }
                }
                None => file(from).to_owned(),
            };
            let literals = literals(&text);
            // As it is, in percent, or in tenths.
            numbers_of(&own.sentence).iter().any(|number| {
                let scaled = [1.0, 0.01, 10.0].map(|scale| scale * number);
                let is = |own: &f64| {
                    scaled
                        .iter()
                        .any(|number| (number - own).abs() <= 1e-9 * own.abs())
                };
                literals.iter().any(is)
            })
        },
    )
}

/// Whether the numbers of some places of goldens have, in magnitude, the least or the most of all.
fn ranks(rank: &Value) -> bool {
    let all = |key: &str| -> BTreeMap<&str, f64> {
        let places = rank.get(key).and_then(Value::as_array);
        let places = places.into_iter().flatten();
        places
            .flat_map(|own| tables::computed_at(own.as_str().unwrap()))
            .collect()
    };
    let (least, most, mut rivals) = (all("least"), all("most"), all("of"));
    rivals.retain(|place, _| !least.contains_key(place) && !most.contains_key(place));
    // By how much a rival may be ahead.
    let within = rank.get("within").and_then(Value::as_float).unwrap_or(0.0);
    let is_behind = |rival: &f64| {
        least.values().all(|own| own.abs() <= rival.abs() + within)
            && most.values().all(|own| own.abs() >= rival.abs() - within)
    };
    !rivals.is_empty() && rivals.values().all(is_behind)
}

/// A source is a list of ranks; the test that ranks; `defined`, where a sentence says what is computed or done and compares no results; or
/// `outside this crate`, as the sentence says.
pub fn every_superlative_is_of_all_its_rivals() -> Vec<String> {
    let is_ranking = |sentence: &str| {
        let words: String = sentence.split('`').step_by(2).collect();
        // "Most panels" at the head is a majority.
        let lower = words.replace("Most ", "").to_lowercase();
        let others = RANKS_NOTHING.split('|');
        let plain = others.fold(lower, |text, own| text.replace(own, ""));
        let plain = format!(" {} ", plain.replace(|c: char| !c.is_alphanumeric(), " "));
        let mut ranks = RANKS.split('|');
        ranks.any(|word| plain.contains(&format!(" {word} ")))
    };
    let documents = documents_and_readmes();
    listed(
        "tests/superlatives.toml",
        &documents,
        is_ranking,
        &|own, source| match source {
            Value::Array(all) => all.iter().all(ranks),
            source => {
                let source = source.as_str().unwrap();
                source == "defined"
                    || source == "outside this crate" && own.sentence.contains(source)
                    || shows(source, own)
            }
        },
    )
}

/// Sentences of `tests/computed.toml` stand in their document word for word, and are changed by hand.
pub fn sentences_are_what_the_program_computes() -> Vec<String> {
    let mut wrong = tables::sentences();
    wrong.retain(|(document, sentence)| !words(file(document)).contains(&words(sentence)));
    let says = |(document, sentence)| format!("{document}: it should say: {sentence}");
    wrong.into_iter().map(says).collect()
}
