//! What is said of the tests themselves: how deep properties go, what did not run, and which mutants are left out.

use super::files_below;
use super::package::root;
use crate::prelude::*;

/// The test files with their texts.
fn test_files() -> Vec<(PathBuf, String)> {
    let files = files_below(&root().join("tests")).into_iter();
    let sources = files.filter(|path| path.extension().is_some_and(|end| end == "rs"));
    sources
        .map(|path| {
            let text = fs::read_to_string(&path).unwrap();
            (path, text)
        })
        .collect()
}

/// `PROPTEST_CASES` sets how many cases every property draws: each takes one of the configurations of `tests/common/mod.rs`, the first
/// where it names none.
#[test]
fn every_property_follows_the_number_of_cases_asked_for() {
    let configurations = ["config()", "costly_config()"];
    let mut count = 0;
    for (path, text) in test_files() {
        let mut lines = text.lines().map(str::trim).peekable();
        while let Some(line) = lines.next() {
            if line != "properties! {" {
                continue;
            }
            let next = lines.peek().copied().unwrap_or_default();
            let named = next
                .strip_prefix("#![proptest_config(")
                .and_then(|rest| rest.strip_suffix(")]"));
            let is_known = named
                .map_or(next.starts_with("#[") || next.starts_with("///"), |name| {
                    configurations.contains(&name.trim_start_matches("crate::common::"))
                });
            assert!(is_known, "{}: {next}", path.display());
            count += 1;
        }
    }
    assert!(count > 50, "{count}");
}

/// Failures that a property once found are kept beside it.
#[test]
fn every_kept_failure_belongs_to_a_test() {
    let kept = files_below(&root().join("tests")).into_iter();
    let kept = kept.filter(|path| {
        path.extension()
            .is_some_and(|end| end == "proptest-regressions")
    });
    for path in kept {
        let source = fs::read_to_string(path.with_extension("rs")).unwrap_or_default();
        assert!(source.contains("properties!"), "{}", path.display());
    }
    assert!(!root().join("proptest-regressions").exists());
}

/// A test that needs something says so to the summary, by `#[ignore]`, and not by returning early.
#[test]
fn every_test_that_does_not_run_is_counted_as_ignored() {
    for (path, text) in test_files()
        .iter()
        .filter(|(path, _)| !path.ends_with("suite.rs"))
    {
        for word in ["NOT RUN", "NOT TESTED", "SKIPPED"] {
            assert!(!text.contains(word), "{}: {word}", path.display());
        }
        let bare = text.lines().find(|line| line.trim() == "#[ignore]");
        assert_eq!(bare, None, "{}: without a reason", path.display());
    }
}

/// The alternatives of an expression's first group, each with what stands around it; the expression itself without one.
fn alternatives(expression: &str) -> Vec<String> {
    let Some((before, rest)) = expression.split_once('(') else {
        return vec![expression.to_owned()];
    };
    let (inside, after) = rest.split_once(')').unwrap();
    inside
        .split('|')
        .map(|one| format!("{before}{one}{after}"))
        .collect()
}

/// What is left out of mutation testing is there: a file, and in it the type and the function that the expression names.
#[test]
fn every_mutant_left_out_names_a_file_and_a_function() {
    let text = fs::read_to_string(root().join(".cargo/mutants.toml")).unwrap();
    let table: toml::Table = toml::from_str(&text).unwrap();
    let excluded = table["exclude_re"].as_array().unwrap();
    assert!(excluded.len() > 25, "{}", excluded.len());
    for expression in excluded {
        let expression = expression.as_str().unwrap();
        let (file, mutant) = expression.split_once(':').unwrap();
        let file = file.replace("\\.", ".");
        let source = fs::read_to_string(root().join(&file));
        let source = source.unwrap_or_else(|_| panic!("there is no {file}: {expression}"));
        // A line's own number would go stale with the next change.
        assert!(
            !mutant.starts_with(|first: char| first.is_ascii_digit()),
            "{expression}"
        );
        // "replace < with <= in Type::function", or "replace Type::function -> bool with true", or "delete field name".
        let named = mutant
            .rsplit_once(" in ")
            .map_or(mutant, |(_, function)| function);
        let named = named.split(" -> ").next().unwrap();
        for name in alternatives(named) {
            let words = name.rsplit(' ').next().unwrap_or_default();
            let words = words.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            for word in words.filter(|word| word.len() > 1) {
                assert!(source.contains(word), "{file} has no {word}: {expression}");
            }
        }
    }
}
