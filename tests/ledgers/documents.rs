//! The numbers of README.md and `paper/*.md` that the program computes, held against the goldens, which other tests hold
//! against the program.
//!
//! `documents.toml` lists tables and sentences with places for numbers. A table stands in its document between
//! `<!-- computed: NAME -->` and `<!-- end -->`; `CORFEM_DOCUMENTS=write cargo test documents` writes it anew. A sentence
//! has to stand in its document word for word, and is changed by hand. Numbers of other origin stand in tables marked
//! `measured:` (with machine and date) or `stored:` (with the file).

use crate::ledgers::places::{filled, goldens};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use toml::Table;

fn ledger() -> Table {
    include_str!("documents.toml").parse().expect("it reads")
}

fn entries(key: &str) -> Vec<(String, String)> {
    let ledger = ledger();
    let list = ledger[key].as_array().expect("a list");
    let string = |value: &toml::Value| value.as_str().expect("a string").to_owned();
    list.iter()
        .map(|entry| {
            let name = entry.get("name").unwrap_or_else(|| &entry["document"]);
            (string(name), string(&entry["text"]))
        })
        .collect()
}

/// README.md and the texts in `paper/`, by their path.
fn documents() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("README.md")];
    for entry in fs::read_dir(root.join("paper")).expect("it reads") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|end| end == "md") {
            files.push(path);
        }
    }
    files
        .into_iter()
        .map(|file| {
            let name = file.strip_prefix(root).expect("below the root");
            let text = fs::read_to_string(&file).expect("it reads");
            (name.display().to_string(), text)
        })
        .collect()
}

/// A document with the blocks behind one marker replaced, and how many there are.
pub fn with_block(document: &str, marker: &str, block: &str) -> (String, usize) {
    let (start, end) = (format!("<!-- {marker} -->\n"), "<!-- end -->");
    let mut pieces = document.split(&start);
    let mut out = pieces.next().unwrap_or_default().to_owned();
    let mut count = 0;
    for piece in pieces {
        let (_, after) = piece
            .split_once(end)
            .unwrap_or_else(|| panic!("{marker} has no end"));
        out.push_str(&format!("{start}{}\n{end}{after}", block.trim()));
        count += 1;
    }
    (out, count)
}

#[test]
fn tables_in_documents_are_what_the_program_computes() {
    let goldens = goldens();
    let mut documents = documents();
    let before = documents.clone();
    for (name, template) in entries("table") {
        let block = filled(&template, &goldens).unwrap_or_else(|what| panic!("{name}: {what}"));
        let mut count = 0;
        for text in documents.values_mut() {
            let (now, found) = with_block(text, &format!("computed: {name}"), &block);
            *text = now;
            count += found;
        }
        assert!(count > 0, "no document has the table {name}");
    }
    for (name, text) in documents {
        if text == before[&name] {
            continue;
        }
        if std::env::var("CORFEM_DOCUMENTS").is_ok_and(|value| value == "write") {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
            fs::write(path, text).expect("it can be written");
        } else {
            panic!(
                "{name} is not what the goldens say; CORFEM_DOCUMENTS=write writes its tables anew"
            );
        }
    }
}

#[test]
fn sentences_in_documents_are_what_the_program_computes() {
    let goldens = goldens();
    let documents = documents();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let wrong: Vec<String> = entries("sentence")
        .into_iter()
        .filter_map(|(document, template)| {
            let sentence =
                filled(&template, &goldens).unwrap_or_else(|what| panic!("{document}: {what}"));
            let said = words(&documents[&document]).contains(&words(&sentence));
            (!said).then(|| format!("{document} should say: {sentence}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The print is quoted there, not computed.
const QUOTATIONS: [&str; 2] = ["paper/errata.md", "paper/interpretation.md"];

#[test]
fn every_table_of_numbers_says_where_they_come_from() {
    for (name, text) in documents() {
        if QUOTATIONS.contains(&name.as_str()) {
            continue;
        }
        let mut origin = None;
        for line in text.lines() {
            if let Some(marker) = line.strip_prefix("<!-- ") {
                origin = ["computed: ", "measured: ", "stored: "]
                    .iter()
                    .find(|kind| marker.starts_with(**kind));
            }
            let has_decimals = line
                .as_bytes()
                .windows(3)
                .any(|w| w[0].is_ascii_digit() && w[1] == b'.' && w[2].is_ascii_digit());
            assert!(
                origin.is_some() || !line.starts_with('|') || !has_decimals,
                "{name}: {line}"
            );
        }
    }
}

#[test]
fn a_block_is_replaced_and_counted() {
    let document = "a\n<!-- computed: n -->\nold\n<!-- end -->\nb";
    let (now, count) = with_block(document, "computed: n", "new");
    assert_eq!(now, document.replace("old", "new"));
    assert_eq!(count, 1);
}
