//! The paper's tables as printed: every cell of the files, and the CPU seconds among them.

use crate::paper::tables::paper_tables;
use crate::paper::tables::published::published_table;
use crate::prelude::*;

#[test]
fn every_printed_cell_is_one_line_as_printed() {
    for number in 2..=13 {
        let file = in_root(format!("paper/tables/table_{number}.csv"));
        let file = fs::read_to_string(file).unwrap();
        let rows = file.lines().filter(|line| !line.starts_with('#')).skip(1);
        let printed = rows
            .flat_map(|row| row.split(',').skip(1))
            .filter(|cell| !cell.is_empty())
            .collect_vec();
        let table = published_table(number).unwrap();
        let written = csv(from_ref(&table));
        let written = written
            .lines()
            .skip(1)
            .map(|line| line.rsplit_once(',').unwrap().1)
            .collect_vec();
        assert_eq!(written, printed, "Table {number}");
        assert!(
            table.title.starts_with(&format!("Table {number}. ")),
            "{}",
            table.title
        );
        let names: BTreeSet<&str> = table
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .collect();
        assert_eq!(names.len(), table.columns.len(), "Table {number}");
        assert!(
            !text(&[table]).contains('_'),
            "Table {number} has words for a reader"
        );
    }
}

#[test]
fn table_13_has_the_cpu_seconds() {
    let table = published_table(13).unwrap();
    let at = table
        .columns
        .iter()
        .position(|column| column.name == "Pass 1 time")
        .unwrap();
    assert_eq!(table.columns[at].unit, "s");
    let cells = table.rows.iter().map(|row| &row.cells[at]).collect_vec();
    let printed = ["1.9", "2.6", "4.8", "1.3"].map(|text| Cell::Printed(text.to_owned()));
    assert_eq!(cells, printed.iter().collect_vec());
    assert_eq!(
        table.rows[3].cells.last(),
        Some(&Cell::Blank),
        "no check in Case 4"
    );
    assert!(published_table(1).is_err() && published_table(14).is_err());
}

#[test]
fn tables_of_the_paper_are_named_in_order() {
    let names = [
        "table_13",
        "table_5",
        "table_9_exact",
        "table_3",
        "table_4",
        "table_1",
        "table_12",
    ];
    assert!(
        paper_tables(names).starts_with("Of the paper's tables, here are 1, 3, 4, 5, 12, 13; ")
    );
}
