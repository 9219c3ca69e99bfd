//! `paper/equations.toml`, `paper/errata.md` and `tests/routes.toml` against the code. `wrong_forms.rs` has what is done with wrong forms.

use crate::ledgers::{defines, file, files, is_test, strings};
use crate::prelude::*;
use toml::Table;

/// Every equation number the paper has: 1 to 13, A.1 to A.9, B.1 to B.7, C.1 to C.24.
fn numbers() -> Vec<String> {
    let mut numbers = Vec::new();
    for (appendix, last) in [("", 13), ("A.", 9), ("B.", 7), ("C.", 24)] {
        numbers.extend((1..=last).map(|number| format!("{appendix}{number}")));
    }
    numbers
}

/// Every equation and then every sentence, by its number or name.
pub fn entries() -> Vec<(String, Table)> {
    let document: Table = file("paper/equations.toml").parse().unwrap();
    let mut entries = Vec::new();
    for (kind, key) in [("equation", "number"), ("sentence", "name")] {
        for entry in document[kind].as_array().unwrap() {
            let owner = entry[key].as_str().unwrap().to_owned();
            entries.push((owner, entry.as_table().unwrap().clone()));
        }
    }
    entries
}

/// The test that executes an equation.
pub fn test_of(number: &str) -> String {
    let (letter, number) = number.rsplit_once('.').unwrap_or(("", number));
    let name = [letter, &format!("{number:0>2}")].join("_");
    format!("eq_{}", name.trim_start_matches('_'))
}

pub fn every_equation_has_its_function_its_tests_and_a_wrong_form() -> Vec<String> {
    let (mut wrong, entries) = (Vec::new(), entries());
    let executed = file("tests/equations/mod.rs")
        .split_whitespace()
        .collect_vec();
    if !numbers()
        .iter()
        .eq(entries[..numbers().len()].iter().map(|(own, _)| own))
    {
        wrong.push("paper/equations.toml: equations are missing, or in another order".to_owned());
    }
    for (owner, entry) in &entries {
        let mut refuse = |what: &str| wrong.push(format!("paper/equations.toml: {owner}: {what}"));
        let (functions, tests) = (strings(entry, "functions"), strings(entry, "tests"));
        if functions.is_empty() && !entry.contains_key("remark") {
            refuse("neither function nor remark");
        }
        let keywords = ["pub fn ", "pub struct ", "pub(crate) fn "];
        for function in functions
            .iter()
            .filter(|own| !defines("src", own, &keywords))
        {
            refuse(function);
        }
        for test in tests.iter().filter(|test| !is_test(test)) {
            refuse(test);
        }
        let has_law = match entry.contains_key("number") {
            true => executed.contains(&&*test_of(owner)),
            false => tests.iter().any(|test| test.starts_with("contents::s")),
        };
        if !has_law || entry["wrong"].as_array().is_none_or(Vec::is_empty) {
            refuse("no law of its own, or no wrong form");
        }
    }
    wrong
}

/// Entries of the errata are paragraphs that begin in bold. Each names a test that shows it, or is of an equation whose print or scan is
/// executed; and print and scan of every equation have their entry in their list.
pub fn every_entry_of_the_errata_is_shown_by_a_test() -> Vec<String> {
    let (mut wrong, equations) = (Vec::new(), entries());
    let keeps = |number: &str, key: &str| {
        let mut all = equations.iter();
        all.any(|(own, entry)| own == number && entry.contains_key(key))
    };
    let exists = |name: &str| {
        let test = format!("fn {name}(");
        let mut all = files("tests/", ".rs").into_iter();
        all.any(|(_, text)| {
            text.contains(&format!("]\n{test}")) || text.contains(&format!("]\n    {test}"))
        })
    };
    let lists = file("paper/errata.md").split("\n## ").skip(1);
    for (list, key) in lists.zip(["print", "scan", ""]) {
        let mut listed = BTreeSet::new();
        for entry in list.split("\n\n**").skip(1) {
            let title = entry.split("**").next().unwrap();
            let brackets = title
                .split('(')
                .skip(1)
                .map(|rest| rest.split(')').next().unwrap());
            let own = brackets
                .filter(|own| numbers().contains(&own.to_string()))
                .collect_vec();
            let code = entry.split('`').skip(1).step_by(2).collect_vec();
            let is_name = |word: &&&str| {
                word.contains('_')
                    && word
                        .chars()
                        .all(|c| c == '_' || c.is_ascii_lowercase() || c.is_ascii_digit())
            };
            let tests = code.iter().filter(is_name).collect_vec();
            let paths = code
                .iter()
                .filter(|word| word.starts_with("tests/"))
                .collect_vec();
            let is_executed = own
                .iter()
                .any(|own| keeps(own, "print") || keeps(own, "scan"));
            let is_shown = is_executed
                || tests.len() + paths.len() > 0
                || super::words(entry).contains("No result depends on this");
            let is_misplaced =
                key == "print" && title.starts_with('(') && !own.iter().all(|own| keeps(own, key));
            if !is_shown
                || is_misplaced
                || !tests.iter().all(|own| exists(own))
                || !paths.iter().all(|own| in_root(own).is_file())
            {
                wrong.push(format!(
                    "paper/errata.md: no test, or in a wrong list: {title}"
                ));
            }
            listed.extend(own);
        }
        let missing = equations
            .iter()
            .filter(|(own, _)| keeps(own, key) && !listed.contains(&own[..]));
        wrong.extend(
            missing.map(|(own, _)| format!("paper/errata.md: ({own}): its {key} is not listed")),
        );
    }
    wrong
}

pub fn every_number_has_two_routes_and_tests_that_exist() -> Vec<String> {
    let document: Table = file("tests/routes.toml").parse().unwrap();
    let mut wrong = Vec::new();
    for entry in document["number"].as_array().unwrap() {
        let entry = entry.as_table().unwrap();
        let (routes, tests) = (strings(entry, "routes"), strings(entry, "tests"));
        let different: BTreeSet<&String> = routes.iter().collect();
        if different.len() < 2 || tests.is_empty() || !tests.iter().all(|test| is_test(test)) {
            wrong.push(format!("tests/routes.toml: {}", entry["what"]));
        }
    }
    wrong
}
