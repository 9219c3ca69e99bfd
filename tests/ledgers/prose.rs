//! The documentation of `src/`: its first lines begin with the noun that they document, not with a clause.
//!
//! "What the test sees of a parameter" leaves the reader to find the noun: an interval, a share, an answer of yes or no.
//! `tests/ceilings.toml` has the number of such lines that each room still has; a number there only falls.

use crate::ledgers::weight::{ceilings, rooms};
use crate::prelude::*;

/// The words with which a clause begins that has no noun.
const OPENINGS: [&str; 11] = [
    "What", "How", "Whether", "Where", "Which", "Those", "The same", "That", "These", "They",
    "Such",
];

fn is_clause(line: &str) -> bool {
    OPENINGS.iter().any(|opening| {
        let rest = line.strip_prefix(opening);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    })
}

/// The numbers and texts of the lines that begin with a clause: of the first line of every block of documentation and of the
/// first below its heading "Errors".
fn clauses(code: &str) -> Vec<(usize, &str)> {
    let (mut found, mut before, mut is_below_errors) = (Vec::new(), None, false);
    for (line, number) in code.lines().map(str::trim).zip(1..) {
        let mark = line.get(..3).filter(|mark| ["///", "//!"].contains(mark));
        let text = mark.map_or("", |mark| line[mark.len()..].trim());
        let is_first = mark.is_some() && mark != before;
        if (is_first || is_below_errors) && is_clause(text) {
            found.push((number, text));
        }
        // A heading has an empty line below it.
        is_below_errors =
            mark.is_some() && (text == "# Errors" || is_below_errors && text.is_empty());
        before = mark;
    }
    found
}

#[test]
fn documentation_begins_with_its_noun() {
    let mut allowed = ceilings().clauses;
    let mut wrong = Vec::new();
    for (room, files) in rooms() {
        let mut found = Vec::new();
        for (file, text) in &files {
            let line = |(number, text)| format!("    src/{file}:{number}: {text}");
            found.extend(clauses(text).into_iter().map(line));
        }
        let (count, allowed) = (found.len(), allowed.remove(&room).unwrap_or_default());
        if count != allowed {
            let advice = if count < allowed {
                "lower it"
            } else {
                "begin each with its noun"
            };
            let places = found.join("\n");
            wrong.push(format!(
                "{room}: {count} lines begin with a clause, {allowed} in tests/ceilings.toml; {advice}:\n{places}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(allowed.is_empty(), "no rooms: {allowed:?}");
}

#[test]
fn a_clause_is_told_from_a_noun() {
    let code = "//! What it is.\n\n/// The same again.\n/// How it is.\n///\n/// # Errors\n///\n/// Those of [`x`].\n/// Such.\nfn x() {}\n\
                /// Whatever is.\nfn y() {}\n// Where it is.\nlet z = \"///\";\n    /// That it is: text.\n//// Which.";
    let numbers = clauses(code)
        .into_iter()
        .map(|(number, _)| number)
        .collect_vec();
    assert_eq!(numbers, [1, 3, 8, 15]);
}
