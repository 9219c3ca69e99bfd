//! Tables as text, Markdown and CSV: what a terminal has room for, and what another program reads.

use crate::prelude::*;
use corfem::present::render::{WIDTH, markdown};
use corfem::present::table::counted;

/// A table of a user's correlation: any number of columns and rows, words in headings, some numbers published.
fn table() -> impl Strategy<Value = Table> {
    let cell = prop_oneof![
        Just(Cell::Blank),
        "[a-z]{1,8}".prop_map(Cell::text),
        (-1e4..1e4_f64, prop::option::of(-1e4..1e4_f64))
            .prop_map(|(value, published)| Cell::beside(value, Digits::Fixed(2), published)),
    ];
    let columns = prop::collection::vec("[A-Z][a-z]{1,9}( [a-z]{1,9}){0,2}", 1..30);
    (columns, "[a-z]{1,20}", "([a-z]{1,12} ){1,40}[a-z]{1,12}").prop_flat_map(
        move |(columns, label, note)| {
            let row = prop::collection::vec(cell.clone(), columns.len());
            prop::collection::vec(row, 1..6).prop_map(move |rows| {
                let mut table = Table::new("name", note.clone(), "Row")
                    .headings(columns.iter().cloned(), "%")
                    .notes([note.clone()]);
                for cells in rows {
                    table.row(&label, cells);
                }
                table
            })
        },
    )
}

/// A table with these words in every place where a user's names come.
fn named(words: &str) -> Table {
    Table::new("names", words, "Row")
        .labels([words])
        .column(words, "", [Cell::text(words)])
        .notes([words.to_owned()])
}

/// A terminal would obey an escape sequence, and a line end would leave its row.
#[test]
fn control_characters_of_names_are_shown_in_every_format() {
    let tables = [named("a\u{1b}[2Jb\0c\nd\te")];
    for shown in [text(&tables), markdown(&tables), csv(&tables)] {
        assert!(
            shown.chars().all(|c| c == '\n' || !c.is_control()),
            "{shown:?}"
        );
        assert!(shown.contains("a\\u{1b}[2Jb\\u{0}c\\nd\\te"), "{shown}");
    }
}

#[test]
fn a_bar_in_a_name_does_not_begin_a_cell_of_markdown() {
    let shown = markdown(&[named("story|3")]);
    let row = shown
        .lines()
        .rfind(|line| line.starts_with("| story"))
        .unwrap();
    assert_eq!(row, "| story\\|3 | story\\|3 |");
}

/// A spreadsheet would compute it. Numbers are numbers, with a sign too.
#[test]
fn a_name_that_is_a_formula_is_words_in_csv() {
    for formula in ["=cmd|' /C calc'!A0", "+A1", "-A1", "@SUM(A1,2)"] {
        let shown = csv(&[named(formula)]);
        let row = shown.lines().nth(1).unwrap();
        assert!(row.contains(&format!("'{formula}")), "{row}");
        assert!(
            !row.contains(&format!(",{formula}")) && !row.contains(&format!(",\"{formula}")),
            "{row}"
        );
    }
    for number in ["-1.5", "+2", "-3e-4"] {
        assert!(csv(&[named(number)]).contains(&format!(",{number},")));
    }
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn no_line_of_text_is_longer_than_a_page(table in table()) {
        let text = text(from_ref(&table));
        for line in text.lines() {
            prop_assert!(line.chars().count() <= WIDTH, "{line}");
            prop_assert_eq!(line, line.trim_end());
        }
        // However it is split, everything is in it, in its order.
        let words = text.split_whitespace().collect_vec();
        let note = table.notes[0].split_whitespace().collect_vec();
        prop_assert!(words.ends_with(&note));
        for row in &table.rows {
            for cell in &row.cells {
                for written in [Some(cell.computed()), cell.published()].into_iter().flatten() {
                    prop_assert!(written.is_empty() || words.contains(&written.as_str()));
                }
            }
        }
    }

    #[test]
    fn no_name_is_too_long_for_a_page(words in prop::collection::vec("x{1,250}( x{1,120}){0,3}", 4)) {
        let [label, column, cell, note] = &words[..] else { unreachable!("four") };
        let table = Table::new("t", "A title", "Mode").labels([label]).column(column, "Hz", [Cell::text(cell)]).notes([note]);
        let shown = text(&[table]);
        for line in shown.lines() {
            prop_assert!(line.chars().count() <= WIDTH, "{line}");
        }
        let letters = words.iter().map(|words| words.matches('x').count()).sum::<usize>();
        prop_assert_eq!(shown.matches('x').count(), letters);
    }

    #[test]
    fn every_number_is_one_line_of_csv(table in table()) {
        let filled = table.rows.iter().flat_map(|row| &row.cells);
        let count = filled.filter(|cell| **cell != Cell::Blank).count();
        prop_assert_eq!(csv(&[table]).lines().count(), count + 1);
    }
}

fn small() -> Table {
    let beside = Cell::beside(-4.0, Digits::Fixed(1), Some(-4.5));
    Table::new("t", "A title", "Mode")
        .labels(["1", "2, \"both\""])
        .column(
            "Initial",
            "Hz",
            [Cell::number(10.5, Digits::Significant(4))],
        )
        .column("Initial error", "%", [beside, Cell::text("words")])
        .notes(["A note."])
}

#[test]
fn a_published_number_stands_below_its_own() {
    let expected = "\
Computed values; the paper's are in the rows marked \"published\".

A title

                      Initial
             Initial    error
Mode              Hz        %
─────────────────────────────
1              10.50     -4.0
  published              -4.5
2, \"both\"               words
─────────────────────────────

A note.
";
    assert_eq!(text(&[small()]), expected);
}

#[test]
fn a_table_as_wide_as_the_page_stays_whole_and_a_wider_one_goes_on_below() {
    let table = |wide: usize| {
        let cell = |wide: usize| [Cell::text("x".repeat(wide))];
        let table = Table::new("t", "A title", "Mode").labels(["label of 15 ..."]);
        text(&[table.column("a", "", cell(40)).column("b", "", cell(wide))])
    };
    assert_eq!(table(WIDTH - 15 - 2 - 40 - 2).matches("Mode").count(), 1);
    assert_eq!(table(WIDTH - 15 - 2 - 40 - 1).matches("Mode").count(), 2);
}

#[test]
fn markdown_has_it_in_parentheses() {
    let expected = "\
Computed values; the paper's follow in parentheses.

## A title

| Mode | Initial, Hz | Initial error, % |
| --- | ---: | ---: |
| 1 | 10.50 | -4.0 (-4.5) |
| 2, \"both\" |  | words |

A note.
";
    assert_eq!(markdown(&[small()]), expected);
}

#[test]
fn csv_quotes_what_would_end_a_field() {
    let expected = "\
table,row,column,unit,computed,published
t,1,Initial,Hz,10.5,
t,1,Initial error,%,-4,-4.5
t,\"2, \"\"both\"\"\",Initial error,%,words,
";
    assert_eq!(csv(&[small()]), expected);
}

#[test]
fn numbers_are_written_with_their_digits_and_never_as_minus_zero() {
    for (digits, value, written) in [
        (Digits::Fixed(2), -0.004, "0.00"),
        (Digits::Fixed(0), 14.0, "14"),
        (Digits::Significant(4), 99.996, "100.0"),
        (Digits::Significant(4), 2658.4, "2658"),
        (Digits::Significant(3), 0.0, "0.00"),
        (Digits::Significant(3), 1.5e-5, "0.0000150"),
        (Digits::Significant(3), 7.3e-19, "7.30e-19"),
        (Digits::Significant(3), 2.5e6, "2500000"),
        (Digits::Significant(3), 2.5e7, "2.50e7"),
        (Digits::Scientific(1), -0.00123, "-1.2e-3"),
    ] {
        assert_eq!(digits.write(value), written);
    }
    assert_eq!(counted(1, "pass", "passes"), "1 pass");
    assert_eq!(counted(0, "pass", "passes"), "0 passes");
}
