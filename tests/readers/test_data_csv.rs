//! The table of a test: the layout that its documentation states, and what is written.

use crate::prelude::*;

fn wing(text: &str) -> TestData {
    read("wing.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The first text of the list is the documentation's.
#[test]
fn the_documentation_has_the_example_that_the_list_reads() {
    let list = include_str!("files/tables.toml")
        .split("'''\n")
        .nth(1)
        .unwrap();
    let source = include_str!("../../src/files/test_data/csv.rs").lines();
    let documented = source
        .filter_map(|line| line.strip_prefix("//! "))
        .collect_vec();
    assert!(documented.join("\n").contains(list.trim_end()));
    // Latin-1, as old spreadsheets write.
    let latin = list
        .replace("tip", "fl\u{fc}gel")
        .chars()
        .map(|c| c as u8)
        .collect_vec();
    assert_eq!(
        read("wing.csv", &latin).unwrap().sensors[0].name,
        "fl\u{fc}gel"
    );
}

properties! {
    #[test]
    fn every_test_reads_back_from_its_table_to_the_last_digit(data in ground_test()) {
        prop_assert_eq!(wing(&write_csv(&data)), data);
    }
}
