//! `paper/errata.md` against the tests: every entry names one that shows it or is of an equation whose print or scan is executed, every
//! test named there exists, and every formula of print or scan in `paper/equations.toml` has its entry.

use crate::ledgers::equations;
use crate::ledgers::files_below;
use crate::prelude::*;

/// The entries: paragraphs that begin in bold, with the lists that belong to them.
fn entries(text: &str) -> Vec<&str> {
    let starts = text
        .match_indices("\n\n**")
        .map(|(at, _)| at + 2)
        .collect_vec();
    let end = |start: usize| {
        let rest = &text[start..];
        rest.find("\n\n**")
            .into_iter()
            .chain(rest.find("\n## "))
            .min()
            .map_or(text.len(), |at| start + at)
    };
    starts
        .iter()
        .map(|&start| &text[start..end(start)])
        .collect()
}

/// The names of tests in a text: words in backticks with an underscore, without those of files and constants.
fn tests_named(text: &str) -> Vec<&str> {
    let words = text.split('`').skip(1).step_by(2);
    words
        .filter(|word| {
            word.contains('_')
                && word
                    .chars()
                    .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        })
        .collect()
}

/// The numbers of equations in the bold words that an entry begins with.
fn numbers(entry: &str) -> impl Iterator<Item = &str> {
    let title = entry.split("**").nth(1).unwrap_or_default();
    let brackets = title.split('(').skip(1);
    let words = brackets.filter_map(|rest| Some(rest.split_once(')')?.0));
    words.filter(|words| equations::numbers().contains(&words.to_string()))
}

/// Whether `paper/equations.toml` has what print or scan has of an equation.
fn keeps(number: &str, key: &str) -> bool {
    let mut entries = equations::entries().into_iter();
    entries.any(|(own, entry)| own == number && entry.contains_key(key))
}

/// The lists of the errata are those formulas that differ from the right ones.
#[test]
fn print_and_scan_of_every_equation_are_in_their_list() {
    let parts = include_str!("../../paper/errata.md")
        .split("\n## ")
        .collect_vec();
    for (part, key) in [(parts[1], "print"), (parts[2], "scan")] {
        let part = format!("\n\n{part}");
        for number in equations::numbers() {
            let is_listed = entries(&part)
                .iter()
                .any(|entry| numbers(entry).any(|own| own == number));
            assert!(is_listed || !keeps(&number, key), "({number}): {key}");
        }
        for entry in entries(&part)
            .into_iter()
            .filter(|entry| key == "print" && entry.starts_with("**("))
        {
            assert!(numbers(entry).all(|number| keeps(number, key)), "{entry}");
        }
    }
}

/// Whether some file of tests has the test.
fn exists(name: &str) -> bool {
    let tests = in_root("tests");
    let mut files = files_below(&tests);
    files.retain(|file| file.extension().is_some_and(|end| end == "rs"));
    files.iter().any(|file| {
        let text = fs::read_to_string(file).unwrap();
        text.contains(&format!("#[test]\nfn {name}("))
            || text.contains(&format!("#[test]\n    fn {name}("))
    })
}

#[test]
fn every_entry_of_the_errata_names_a_test_that_exists() {
    let text = include_str!("../../paper/errata.md");
    let entries = entries(text);
    assert!(
        entries.len() > 25,
        "only {} entries were read",
        entries.len()
    );
    for entry in entries {
        let files = entry.split('`').filter(|word| word.starts_with("tests/"));
        for file in files.clone() {
            assert!(in_root(file).is_file(), "{file}");
        }
        let names = tests_named(entry);
        let one_line = entry.split_whitespace().collect_vec().join(" ");
        let is_executed = |key| numbers(entry).any(|number| keeps(number, key));
        let shown = ["print", "scan"].into_iter().any(is_executed)
            || !names.is_empty()
            || files.count() > 0
            || one_line.contains("No result depends on this");
        assert!(shown, "no test in: {entry}");
        for name in names {
            assert!(exists(name), "{name} in: {entry}");
        }
    }
}

#[test]
fn the_check_of_the_errata_finds_what_is_missing() {
    let text = "Title\n\n**one** `a_test`\n- `b_test`\n\n**two** `file.rs` and `X_Y`\n\n## Next\n\n**three** `K`";
    assert_eq!(entries(text).len(), 3);
    assert_eq!(tests_named(entries(text)[0]), ["a_test", "b_test"]);
    assert!(tests_named(entries(text)[1]).is_empty() && !entries(text)[1].contains("Next"));
    assert!(tests_named(entries(text)[2]).is_empty());
    assert!(exists("the_check_of_the_errata_finds_what_is_missing") && !exists("entries"));
}
