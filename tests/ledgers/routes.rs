//! The ledger of routes, `tests/routes.toml`: every number has at least two, and the tests named there exist.

use crate::ledgers::equations::{defines, strings};
use std::collections::BTreeSet;
use toml::Table;

fn entries() -> Vec<Table> {
    let document: Table = include_str!("../routes.toml").parse().unwrap();
    let list = document["number"].as_array().unwrap();
    list.iter()
        .map(|entry| entry.as_table().unwrap().clone())
        .collect()
}

#[test]
fn every_number_has_two_routes_and_tests_that_exist() {
    let mut seen = BTreeSet::new();
    for entry in entries() {
        let what = entry["what"].as_str().unwrap().to_owned();
        let routes = strings(&entry, "routes");
        assert!(routes.len() >= 2, "{what}: {routes:?}");
        let different: BTreeSet<&String> = routes.iter().collect();
        assert_eq!(different.len(), routes.len(), "{what}");
        let tests = strings(&entry, "tests");
        assert!(!tests.is_empty(), "{what}");
        for test in tests {
            assert!(
                defines("tests", &test, &["#[test]\nfn ", "#[test]\n    fn "]),
                "{what}: {test}"
            );
        }
        assert!(seen.insert(what.clone()), "{what} twice");
    }
    assert!(seen.len() > 20);
}
