//! The one page of the specification, `paper/specification.md`, made from `paper/equations.toml`: `documents.rs` holds them equal.

use crate::ledgers::equations::{entries, test_of};
use crate::ledgers::strings;
use crate::prelude::*;
use std::fmt::Write;
use toml::{Table, Value};

/// Every equation and sentence in the paper's order: what it is, and folded what is it in the crate, what checks it, and how it could be
/// wrong.
pub fn page() -> String {
    let entries = entries();
    let wrong = |entry: &Table| entry["wrong"].as_array().unwrap().clone();
    let count: usize = entries.iter().map(|(_, entry)| wrong(entry).len()).sum();
    let is_equation = |(_, entry): &&(String, Table)| entry.contains_key("number");
    let equations = entries.iter().filter(is_equation).count();
    let sentences = entries.len() - equations;
    let mut page = format!("{equations} equations, {sentences} sentences, {count} wrong forms.\n");
    for (owner, entry) in &entries {
        let text = |key: &str| entry.get(key).and_then(Value::as_str);
        let what = text("what").unwrap();
        match text("formula") {
            Some(formula) => page += &format!("\n### ({owner}) {what}\n\n$$ {formula} $$\n"),
            None => {
                let from = text("from").filter(|from| ["print", "ours"].contains(from));
                let from = from.unwrap_or_else(|| panic!("{owner}: from the print or ours"));
                page += &format!("\n### Sentence ({from}): {owner}\n\n{what}.\n");
            }
        }
        let code = |key: &str| {
            let mut names = strings(entry, key);
            if key == "tests" && entry.contains_key("number") {
                names.insert(0, format!("equations::{}", test_of(owner)));
            }
            let names = names
                .iter()
                .map(|name| format!("`{}`", name.trim_start_matches("contents::")));
            names.collect_vec().join(", ")
        };
        for (key, title) in [("print", "The paper prints"), ("scan", "The scan has")] {
            page += &text(key).map_or(String::new(), |formula| {
                format!("\n{title}\n\n$$ {formula} $$\n")
            });
        }
        for (key, title) in [("correction", "Correction"), ("remark", "Remark")] {
            page += &text(key).map_or(String::new(), |words| format!("\n{title}: {words}.\n"));
        }
        let forms = wrong(entry);
        let summary = match forms.len() {
            0 => "Code and tests".to_owned(),
            1 => "Code, tests, one wrong form".to_owned(),
            many => format!("Code, tests, {many} wrong forms"),
        };
        page += &format!("\n<details><summary>{summary}</summary>\n\n");
        if !code("functions").is_empty() {
            page += &format!("In the crate: {}.\n\n", code("functions"));
        }
        page += &format!("Tests: {}.\n\n", code("tests"));
        for form in forms {
            let text = |key: &str| form.get(key).and_then(Value::as_str).unwrap();
            let place = match form.get("file").and_then(Value::as_str) {
                Some(file) => format!("`{file}`"),
                None => "the formula".to_owned(),
            };
            let to = match text("new") {
                "" => "left out".to_owned(),
                new => format!("for it `{new}`"),
            };
            let (what, old) = (text("what"), text("old"));
            writeln!(page, "- Wrong: {what}. In {place} `{old}`, {to}.").unwrap();
        }
        page += "\n</details>\n";
    }
    page
}
