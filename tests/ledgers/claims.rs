//! The ledger of claims, `tests/claims.toml`: every sentence of a document on the step or on Case 4, with what it holds for and the test
//! behind it.

use crate::ledgers::documents::documents;
use crate::ledgers::equations::defines;
use crate::prelude::*;
use serde::de::DeserializeOwned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ledger {
    claim: Vec<Claim>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    document: String,
    sentence: String,
    holds: Holds,
    test: String,
}

/// What a sentence is about.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Holds {
    /// This box: the paragraph says so.
    OnThisBox,
    /// Other boxes, twenty at least, by one of [`OF_OTHER_BOXES`].
    OnOtherBoxes,
    /// What was found elsewhere: the paragraph says "outside this crate".
    OutsideThisCrate,
    /// What the paper prints, or how its case is set up.
    InPrint,
    /// What the crate does, or what follows from the equations.
    ByDefinition,
}

/// The tests that run at least twenty other boxes.
const OF_OTHER_BOXES: [&str; 4] = [
    "evidence::claims::detection::detection_holds_off_this_box",
    "spec::s4_readings::on_other_boxes_relative_is_compared_with_every_reading",
    "spec::s4_readings::changes_add_on_thirty_other_boxes",
    "spec::s4_covers::covers_of_a_bay_that_begin_alike_stay_alike_under_any_rule",
];

/// What a sentence on the step or on Case 4 says, or on what the paper says in words; wrong readings of sensors are not of the step.
const WORDS: [&str; 28] = [
    "The paper finds",
    "the shape that differs",
    "box rods have",
    "aper's wing",
    "or exceeds",
    "Case 4",
    "lement 8",
    "by own",
    "by relative",
    "by gage",
    "reading own",
    "reading relative",
    "reading matrix",
    "reading gage",
    "readings own",
    "four readings",
    "Four readings",
    "the reading whose",
    "reading of the step",
    "readings of the step",
    "No reading",
    "any reading",
    "every reading",
    "Relative ",
    "Half lies",
    "Own and matrix",
    "own and matrix",
    "gages of relative",
];

/// Paragraphs and points of lists on one line each, without code, computed blocks, tables, images, formulas, headings and links on to the
/// next chapter.
pub fn paragraphs(text: &str) -> Vec<String> {
    let (mut all, mut open) = (Vec::new(), String::new());
    let (mut is_code, mut is_block) = (false, false);
    for line in text.lines().map(str::trim).chain([""]) {
        let is_fence = line.starts_with("```");
        is_code ^= is_fence;
        if line.starts_with("<!-- ") {
            // Another comment stands alone.
            is_block = line.starts_with("<!-- computed: ");
        }
        let is_step_on = line.contains("Previous: [") || line.contains("Next: [");
        let is_other = is_code
            || is_block
            || is_fence
            || is_step_on
            || line.starts_with(['#', '|', '<', '$'])
            || line.starts_with("![");
        let is_point = line.starts_with("- ") || line.starts_with("* ");
        if (line.is_empty() || is_other || is_point) && !open.is_empty() {
            all.push(std::mem::take(&mut open));
        }
        if !is_other {
            for word in line.split_whitespace() {
                open += if open.is_empty() { "" } else { " " };
                open += word;
            }
        }
    }
    all
}

/// The sentences of a paragraph.
pub fn sentences(paragraph: &str) -> Vec<&str> {
    let mut ends = [". ", ".** ", "? "]
        .iter()
        .flat_map(|end| paragraph.match_indices(end).map(|(at, _)| at + end.len()))
        .collect_vec();
    ends.push(paragraph.len());
    ends.sort_unstable();
    let mut start = 0;
    ends.into_iter()
        .map(|end| paragraph[std::mem::replace(&mut start, end)..end].trim())
        .filter(|sentence| !sentence.is_empty())
        .collect()
}

/// The document and the sentence, with its paragraph, of those that are meant.
pub fn said(
    documents: &BTreeMap<String, String>,
    is_meant: impl Fn(&str) -> bool,
) -> BTreeMap<(String, String), String> {
    let mut all = BTreeMap::new();
    for (document, text) in documents {
        for paragraph in paragraphs(text) {
            for sentence in sentences(&paragraph)
                .into_iter()
                .filter(|own| is_meant(own))
            {
                all.insert((document.clone(), sentence.to_owned()), paragraph.clone());
            }
        }
    }
    all
}

/// Asserts that a ledger of sentences, by document, has all that are meant, each with a source that is right, and none that is not said.
pub fn assert_listed<S: DeserializeOwned>(
    file: &str,
    documents: &BTreeMap<String, String>,
    is_meant: impl Fn(&str) -> bool,
    is_right: impl Fn(&str, &str, &S) -> bool,
) {
    let text = fs::read_to_string(in_root(file)).unwrap();
    let ledger: BTreeMap<String, BTreeMap<String, S>> = toml::from_str(&text).unwrap();
    let said = said(documents, |_| true);
    let mut missing = said.keys().filter(|(_, own)| is_meant(own)).collect_vec();
    let mut wrong = Vec::new();
    for (document, own) in ledger {
        for (sentence, source) in own {
            let place = (document.clone(), sentence);
            missing.retain(|other| **other != place);
            if !said.contains_key(&place) || !is_right(&document, &place.1, &source) {
                wrong.push(place);
            }
        }
    }
    assert!(missing.is_empty(), "not in {file}: {missing:#?}");
    assert!(
        wrong.is_empty(),
        "{file}: not right, or not said: {wrong:#?}"
    );
}

/// True of a sentence on the step or on Case 4, whose names of readings stand in backticks or without.
fn is_claim(sentence: &str) -> bool {
    let plain = sentence.replace('`', "");
    WORDS.iter().any(|word| plain.contains(word))
}

#[test]
fn every_sentence_on_the_step_or_on_case_4_has_its_test() {
    let ledger: Ledger = toml::from_str(include_str!("../claims.toml")).unwrap();
    let (documents, mut listed) = (said(&documents(), is_claim), BTreeSet::new());
    for Claim {
        document,
        sentence,
        holds,
        test,
    } in ledger.claim
    {
        let place = (document, sentence);
        let paragraph = documents.get(&place);
        let paragraph = paragraph.unwrap_or_else(|| panic!("not in the documents: {place:?}"));
        match holds {
            Holds::OnThisBox => assert!(paragraph.contains("this box"), "{place:?}"),
            Holds::OutsideThisCrate => {
                assert!(paragraph.contains("outside this crate"), "{place:?}")
            }
            Holds::OnOtherBoxes => assert!(OF_OTHER_BOXES.contains(&&*test), "{place:?}"),
            Holds::InPrint | Holds::ByDefinition => (),
        }
        // A chapter of the tour is a test itself: its code computes what it says.
        let is_chapter = test == place.0 && test.starts_with("paper/tour/");
        let kinds = ["]\nfn ", "]\n    fn "];
        assert!(
            is_chapter || defines("tests", &test, &kinds),
            "{test} of {place:?}"
        );
        listed.insert(place);
    }
    let missing = documents
        .keys()
        .filter(|place| !listed.contains(*place))
        .collect_vec();
    assert!(missing.is_empty(), "not in tests/claims.toml: {missing:#?}");
    for test in OF_OTHER_BOXES {
        assert!(defines("tests", test, &["fn "]), "{test}");
    }
}

#[test]
fn a_paragraph_is_read_in_sentences_without_its_code() {
    let text = "# Case 4\n\n**By own.** It is 1.5. Is\nit?\n- a point\n\n```rust\nlet x = 1;\n```\n| by own |\nEnd.\n";
    let found = paragraphs(text);
    assert_eq!(
        found,
        ["**By own.** It is 1.5. Is it?", "- a point", "End."]
    );
    assert_eq!(
        sentences(&found[0]),
        ["**By own.**", "It is 1.5.", "Is it?"]
    );
}
