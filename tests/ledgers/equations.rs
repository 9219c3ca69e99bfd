//! `paper/equations.toml` against the code: every equation is listed, every function and test named there exists, and every equation and
//! sentence has a wrong form. `wrong_forms.rs` has what is done with these.

use crate::ledgers::files_below;
use crate::prelude::*;
use toml::{Table, Value};

/// Every equation number the paper has: 1 to 13, A.1 to A.9, B.1 to B.7, C.1 to C.24.
pub fn numbers() -> Vec<String> {
    let plain = (1..=13).map(|n| n.to_string());
    let appendix = |letter: char, last: usize| (1..=last).map(move |n| format!("{letter}.{n}"));
    plain
        .chain(appendix('A', 9))
        .chain(appendix('B', 7))
        .chain(appendix('C', 24))
        .collect()
}

/// Every equation and then every sentence, by its number or name.
pub fn entries() -> Vec<(String, Table)> {
    let text = include_str!("../../paper/equations.toml");
    let document: Table = text.parse().unwrap();
    let list = |kind: &str, key: &'static str| {
        let list = document[kind].as_array().unwrap().clone();
        list.into_iter().map(move |entry| {
            let entry = entry.as_table().unwrap().clone();
            (entry[key].as_str().unwrap().to_owned(), entry)
        })
    };
    list("equation", "number")
        .chain(list("sentence", "name"))
        .collect()
}

pub fn strings(entry: &Table, key: &str) -> Vec<String> {
    let list = entry
        .get(key)
        .and_then(Value::as_array)
        .unwrap_or_else(|| panic!("{key} in {entry}"));
    list.iter()
        .map(|value| value.as_str().unwrap().to_owned())
        .collect()
}

fn source(folder: &str, module: &str) -> Option<String> {
    let root = in_root(folder);
    let path = module.replace("::", "/");
    [format!("{path}.rs"), format!("{path}/mod.rs")]
        .iter()
        .find_map(|file| fs::read_to_string(root.join(file)).ok())
}

/// Whether `folder` defines a function (or type) `module::name`.
pub fn defines(folder: &str, full_name: &str, keywords: &[&str]) -> bool {
    let Some((module, name)) = full_name.rsplit_once("::") else {
        return false;
    };
    source(folder, module).is_some_and(|text| {
        text.match_indices(name).any(|(at, _)| {
            let before = &text[..at];
            let after = text[at + name.len()..].chars().next();
            keywords.iter().any(|keyword| before.ends_with(keyword))
                && !after.is_some_and(|c| c.is_alphanumeric() || c == '_')
        })
    })
}

#[test]
fn every_equation_is_listed_once_and_in_order() {
    let listed = entries().into_iter().map(|(owner, _)| owner).collect_vec();
    let (equations, sentences) = listed.split_at(numbers().len());
    assert_eq!(equations, numbers());
    let different: BTreeSet<&String> = sentences.iter().collect();
    assert_eq!(different.len(), sentences.len());
}

#[test]
fn every_function_named_exists() {
    for (number, entry) in entries() {
        let functions = strings(&entry, "functions");
        assert!(
            !functions.is_empty() || entry.contains_key("remark"),
            "{number} has neither function nor remark"
        );
        for function in functions {
            assert!(
                defines(
                    "src",
                    &function,
                    &["pub fn ", "pub struct ", "pub(crate) fn "]
                ),
                "{number}: {function}"
            );
        }
    }
}

/// The test that executes an equation.
pub fn test_of(number: &str) -> String {
    let (letter, number) = number.rsplit_once('.').unwrap_or(("", number));
    let name = [letter, &format!("{number:0>2}")].join("_");
    format!("eq_{}", name.trim_start_matches('_'))
}

#[test]
fn every_equation_is_executed_in_the_papers_order() {
    let text = include_str!("../equations/mod.rs");
    let listed = text.split_whitespace().filter(|word| {
        let number = word.strip_prefix("eq_");
        number.is_some_and(|number| !number.contains('"'))
    });
    let tests = numbers().iter().map(|number| test_of(number)).collect_vec();
    assert_eq!(listed.collect_vec(), tests);
    assert!(tests.is_sorted());
}

#[test]
fn every_sentence_has_a_law_in_the_specification() {
    for (name, entry) in entries() {
        let tests = strings(&entry, "tests");
        let has_law = tests.iter().any(|test| test.starts_with("spec::s"));
        assert!(has_law || entry.contains_key("number"), "{name}");
    }
}

#[test]
fn every_test_named_exists_and_is_a_test() {
    for (number, entry) in entries() {
        for test in strings(&entry, "tests") {
            assert!(
                defines("tests", &test, &["#[test]\nfn ", "#[test]\n    fn "]),
                "{number}: {test}"
            );
        }
    }
}

#[test]
fn every_entry_says_what_it_is_and_has_a_wrong_form() {
    for (number, entry) in entries() {
        assert!(
            entry["what"].as_str().is_some_and(|what| what.len() > 10),
            "{number}"
        );
        let own = if entry.contains_key("number") {
            ["number", "formula"]
        } else {
            ["name", "what"]
        };
        assert!(own.iter().all(|key| entry.contains_key(*key)), "{number}");
        let known: BTreeSet<&str> = [
            "what",
            "functions",
            "tests",
            "wrong",
            "correction",
            "print",
            "scan",
            "remark",
            "from",
        ]
        .into_iter()
        .chain(own)
        .collect();
        assert!(
            entry.keys().all(|key| known.contains(key.as_str())),
            "{number}"
        );
        let forms = entry.get("wrong").and_then(Value::as_array);
        assert!(forms.is_some_and(|forms| !forms.is_empty()), "{number}");
    }
}

#[test]
fn the_check_itself_finds_what_is_missing() {
    assert!(defines("src", "method::modes::solve", &["pub fn "]));
    assert!(!defines("src", "method::modes::solv", &["pub fn "]));
    assert!(!defines(
        "src",
        "method::modes::solved_by_nobody",
        &["pub fn "]
    ));
    assert!(!defines("src", "nowhere::solve", &["pub fn "]));
    assert!(defines(
        "tests",
        "ledgers::equations::every_function_named_exists",
        &["#[test]\nfn "]
    ));
    assert!(!defines(
        "tests",
        "ledgers::equations::numbers",
        &["#[test]\nfn "]
    ));
}

/// A file that nobody lists is a test that never runs.
#[test]
fn every_file_of_tests_is_part_of_the_test_program() {
    let tests = in_root("tests");
    assert_eq!(found(&tests, "main"), listed(&tests.join("main.rs")));
    for room in listed(&tests.join("main.rs")) {
        let folder = tests.join(&room);
        assert_eq!(
            found(&folder, "mod"),
            listed(&folder.join("mod.rs")),
            "{room}"
        );
    }
}

/// The modules that a file lists.
fn listed(file: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(file).unwrap();
    text.lines()
        .filter_map(|line| {
            line.trim_start_matches("pub ")
                .strip_prefix("mod ")?
                .strip_suffix(';')
        })
        .map(str::to_owned)
        .collect()
}

/// The modules that stand in a folder, without the file that lists them.
fn found(folder: &Path, list: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().path())
        // A folder without source holds data.
        .filter(|path| {
            !path.is_dir()
                || files_below(path)
                    .iter()
                    .any(|file| file.extension().is_some_and(|end| end == "rs"))
        })
        .filter(|path| path.is_dir() || path.extension().is_some_and(|end| end == "rs"))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|name| name != list)
        .collect()
}
