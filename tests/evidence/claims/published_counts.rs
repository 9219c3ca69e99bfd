//! The printed columns of gages one by one, with exactly the published iterations, against the independent program
//! (golden/reference/published_counts.py).

use crate::evidence::readings::{COUNTED, Column, RULES, Rule, name, pooled};
use crate::prelude::*;
use toml::Table;

fn expected() -> Table {
    let text = include_str!("../../../golden/reference/expected_published_counts.toml");
    text.parse().unwrap()
}

fn column(rule: Rule, name: &str) -> &'static Column {
    let found = COUNTED
        .iter()
        .find(|column| (column.rule, &*column.name) == (rule, name));
    found.unwrap()
}

#[test]
fn every_rule_makes_what_the_independent_program_makes_of_the_printed_counts() {
    let table = expected();
    assert_eq!(COUNTED.len() + RULES.len(), table.len());
    for found in COUNTED.iter() {
        let section = &table[&format!("{}, {}", name(found.rule), found.name)];
        let number = |key: &str| section[key].as_float().unwrap();
        let gages = section["gages"].as_array().unwrap();
        assert_eq!(gages.len(), found.gages_in.len());
        for (found, expected) in found.gages_in.iter().zip(gages) {
            let expected = expected.as_float().unwrap();
            assert_relative_eq!(*found, expected, max_relative = EXPECTED_COUNTED);
        }
        let percent = [found.difference(), found.error_sum].map(|part| 100.0 * part);
        assert_relative_eq!(
            percent[0],
            number("difference"),
            max_relative = EXPECTED_COUNTED
        );
        assert_relative_eq!(
            percent[1],
            number("error_sum"),
            max_relative = EXPECTED_COUNTED
        );
    }
    for rule in RULES {
        let section = &table[&format!("{}, pooled", name(rule))];
        let expected = section["difference"].as_float().unwrap();
        assert_relative_eq!(
            100.0 * pooled(rule),
            expected,
            max_relative = EXPECTED_COUNTED
        );
    }
}

/// The step of the reading whose gages lie nearest is several times too short for the printed counts, in Cases 2 and 3 as in Tables
/// 10 and 11; own and matrix reach the printed error sums there and miss the gages.
#[test]
fn no_reading_reaches_the_printed_gages_and_the_printed_error_sums() {
    let relative = Some(StepRule::Relative);
    let apart = |rule| (1000.0 * pooled(rule)).round();
    assert_eq!(RULES.map(apart), [161.0, 197.0, 112.0, 124.0, 87.0]);
    for name in [
        "Table 10 FEM 7",
        "Table 10 FEM 9",
        "Table 11 FEM 7",
        "Table 11 FEM 9",
    ] {
        let printed = column(relative, name).printed_sum.unwrap();
        assert!(column(relative, name).error_sum > 2.5 * printed, "{name}");
        for reading in [StepRule::Matrix, StepRule::Own] {
            let other = column(Some(reading), name);
            assert!(other.error_sum < 1.4 * printed, "{name}");
            assert!(
                other.difference() > 1.2 * column(relative, name).difference(),
                "{name}"
            );
        }
    }
    assert!(column(relative, "Case 2 pass 1").error_sum > 3.0 * 0.025);
    // No column lies nearest by one reading alone throughout.
    let nearest = |name: &str| {
        let readings = RULES.into_iter().filter(Option::is_some);
        readings.min_by(|a, b| {
            column(*a, name)
                .difference()
                .total_cmp(&column(*b, name).difference())
        })
    };
    assert_eq!(nearest("Case 1 pass 1"), Some(Some(StepRule::Own)));
    assert_eq!(nearest("Table 10 FEM 7").map(name), Some("relative"));
}

/// What the documents say of error sums after the printed iterations, and of the columns that print thirty.
#[test]
fn error_sums_after_the_printed_iterations_are_not_the_printed_ones() {
    let over_printed = |rule, names: &[&str]| {
        let of =
            |name: &&str| column(rule, name).error_sum / column(rule, name).printed_sum.unwrap();
        names
            .iter()
            .map(of)
            .map(|ratio| format!("{ratio:.1}"))
            .collect_vec()
    };
    let table_10 = ["Table 10 FEM 7", "Table 10 FEM 9"];
    let ended = [
        "Table 10 FEM 7",
        "Table 10 FEM 9",
        "Table 11 FEM 7",
        "Table 11 FEM 9",
    ];
    let relative = over_printed(Some(StepRule::Relative), &ended);
    assert_eq!(relative, ["4.0", "4.4", "2.8", "5.8"]);
    assert_eq!(over_printed(Some(StepRule::Own), &table_10), ["1.1", "1.3"]);
    assert_eq!(
        over_printed(Some(StepRule::Matrix), &table_10),
        ["1.1", "1.3"]
    );
    let printed = |name| format!("{:.2}", 100.0 * column(None, name).printed_sum.unwrap());
    let thirty = [
        "Table 11 FEM 5",
        "Table 12 FEM 5",
        "Table 12 FEM 7",
        "Table 12 FEM 9",
    ];
    assert_eq!(thirty.map(printed), ["3.53", "3.36", "3.26", "3.26"]);
    assert_eq!(printed("Table 11 FEM 7"), "2.59");
    for name in &thirty[1..] {
        assert!(column(None, name).error_sum < 0.2 * 0.0326);
    }
    assert_eq!(
        format!("{:.1}", 100.0 * column(None, thirty[3]).error_sum),
        "0.5"
    );
}
