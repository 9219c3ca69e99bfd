//! Goldens of the report: Tables 3 to 8 and 13, and Case 4.

use crate::paper::tables::cases::all_tables;
use crate::paper::tables::published::root_error_table;
use crate::prelude::*;
use corfem::present::render::markdown;

fn tables() -> Vec<Table> {
    let results = CASES
        .into_iter()
        .map(|number| case_run(&case_of(number)))
        .collect_vec();
    all_tables(&results).unwrap()
}

#[test]
fn every_table_as_numbers() {
    let tables = tables();
    let names = tables.iter().map(|table| table.name.as_str()).collect_vec();
    assert_eq!(
        names,
        [
            "outcome",
            "table_3",
            "table_4",
            "case_1_next_step",
            "table_5",
            "table_6",
            "case_2_next_step",
            "table_7",
            "table_8",
            "case_3_next_step",
            "case_4_frequencies",
            "case_4_gages",
            "case_4_factors",
            "table_13",
            "settings"
        ]
    );
    for table in tables
        .iter()
        .filter(|table| !["outcome", "settings"].contains(&table.name.as_str()))
    {
        assert_table(table);
    }
}

#[test]
fn report_as_text_and_markdown() {
    let rounded = Numbers::AS_WRITTEN;
    let tables = tables();
    assert_golden("report_text", &text(&tables), rounded);
    assert_golden("report_markdown", &markdown(&tables), rounded);
}

#[test]
fn cases_by_substructures() {
    let numbers = Numbers::BY_UNIT;
    let results = CASES
        .into_iter()
        .map(|number| {
            let mut case = case_of(number);
            case.grouping = Grouping::Substructures;
            case_run(&case)
        })
        .collect_vec();
    let tables = all_tables(&results).unwrap();
    assert!(
        tables.iter().all(|table| !table.title.contains("Table 3")),
        "the paper has no grouped run"
    );
    assert_golden("substructures", &csv(&tables), numbers);
}

#[test]
fn root_errors_of_table_1() {
    // Errors near round-off are another machine's to choose; a percent error of 1e-9 is already eleven digits of a root.
    let numbers = Numbers {
        relative: GOLDEN_RELATIVE,
        absolute: GOLDEN_ABSOLUTE_ROOT_PERCENT,
        last_digit: false,
        ..Numbers::AS_WRITTEN
    };
    let table = root_error_table().unwrap();
    assert_eq!((table.rows.len(), table.columns.len()), (24, 14));
    // Errors over many decades: a reader sees a digit and a power of ten.
    let written = text(from_ref(&table));
    let cells = written.split_whitespace().filter(|word| {
        let parts = word.split_once("e-");
        parts.is_some_and(|(digits, _)| digits.trim_start_matches('-').len() == 3)
    });
    assert!(cells.count() > 24 * 7, "{written}");
    assert_golden("table_1", &csv(&[table]), numbers);
}

/// No digit of a published number is lost on its way from the paper's table, and none is added that round-off made.
#[test]
fn published_numbers_are_written_as_they_are() {
    let mut count = 0;
    for table in tables() {
        for cell in table.rows.iter().flat_map(|row| &row.cells) {
            let Cell::Number {
                published: Some(number),
                ..
            } = cell
            else {
                continue;
            };
            let written = cell.published().unwrap();
            assert_eq!(
                written.parse().ok(),
                Some(*number),
                "{}: {written}",
                table.name
            );
            assert!(written.len() <= 8, "{}: {written}", table.name);
            count += 1;
        }
    }
    assert!(count > 300, "{count}");
}
