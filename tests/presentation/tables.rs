//! Tables as text, Markdown and CSV: what a terminal has room for, and what another program reads; and the paper's tables as printed.

use crate::paper::tables::published::published_table;
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
    let table = Table::new("names", words, "Row").labels([words]);
    let table = table.column(words, "", [Cell::text(words)]);
    table.notes([words.to_owned()])
}

/// A terminal would obey an escape sequence, a line end would leave its row, a bar would begin a cell of Markdown, and a spreadsheet would
/// compute a formula. Numbers are numbers, with a sign too.
#[test]
fn odd_names_are_words_in_every_format() {
    let tables = [named("a\u{1b}[2Jb\0c\nd\te")];
    for shown in [text(&tables), markdown(&tables), csv(&tables)] {
        assert!(
            shown.chars().all(|c| c == '\n' || !c.is_control()),
            "{shown:?}"
        );
        assert!(shown.contains("a\\u{1b}[2Jb\\u{0}c\\nd\\te"), "{shown}");
    }
    assert!(markdown(&[named("story|3")]).contains("\n| story\\|3 | story\\|3 |\n"));
    for formula in ["=cmd|' /C calc'!A0", "+A1", "-A1", "@SUM(A1,2)"] {
        let shown = csv(&[named(formula)]);
        assert!(shown.contains(&format!("'{formula}")), "{shown}");
        let is_bare = [",", ",\""].map(|before| shown.contains(&format!("{before}{formula}")));
        assert_eq!(is_bare, [false; 2], "{shown}");
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
        for cell in table.rows.iter().flat_map(|row| &row.cells) {
            for written in [Some(cell.computed()), cell.published()].into_iter().flatten() {
                prop_assert!(written.is_empty() || words.contains(&written.as_str()));
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

/// A published number stands below its own in text, in parentheses in Markdown; CSV quotes what would end a field.
#[test]
fn a_small_table_is_written_so_in_every_format() {
    let beside = Cell::beside(-4.0, Digits::Fixed(1), Some(-4.5));
    let first = [Cell::number(10.5, Digits::Significant(4))];
    let table = Table::new("t", "A title", "Mode").labels(["1", "2, \"both\""]);
    let table = table.column("Initial", "Hz", first);
    let table = table.column("Initial error", "%", [beside, Cell::text("words")]);
    let table = [table.notes(["A note."])];
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
    assert_eq!(text(&table), expected);
    let expected = "\
Computed values; the paper's follow in parentheses.

## A title

| Mode | Initial, Hz | Initial error, % |
| --- | ---: | ---: |
| 1 | 10.50 | -4.0 (-4.5) |
| 2, \"both\" |  | words |

A note.
";
    assert_eq!(markdown(&table), expected);
    let expected = "\
table,row,column,unit,computed,published
t,1,Initial,Hz,10.5,
t,1,Initial error,%,-4,-4.5
t,\"2, \"\"both\"\"\",Initial error,%,words,
";
    assert_eq!(csv(&table), expected);
}

#[test]
fn a_table_as_wide_as_the_page_stays_whole_and_a_wider_one_goes_on_below() {
    let parts = |wide: usize| {
        let cell = |wide: usize| [Cell::text("x".repeat(wide))];
        let table = Table::new("t", "A title", "Mode").labels(["label of 15 ..."]);
        let table = table.column("a", "", cell(40)).column("b", "", cell(wide));
        text(&[table]).matches("Mode").count()
    };
    let fits = WIDTH - 15 - 2 - 40 - 2;
    assert_eq!([fits, fits + 1].map(parts), [1, 2]);
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
    let passes = [0, 1].map(|count| counted(count, "pass", "passes"));
    assert_eq!(passes, ["0 passes", "1 pass"]);
}

/// Every printed cell of the paper's tables, those without a published number as blanks.
#[test]
fn every_printed_cell_is_one_line_as_printed() {
    for number in 2..=13 {
        let file = in_root(format!("paper/tables/table_{number}.csv"));
        let file = fs::read_to_string(file).unwrap();
        let rows = file.lines().filter(|line| !line.starts_with('#')).skip(1);
        let cells = rows.flat_map(|row| row.split(',').skip(1));
        let printed = cells.filter(|cell| !cell.is_empty()).collect_vec();
        let table = published_table(number).unwrap();
        let written = csv(from_ref(&table));
        let written = written.lines().skip(1);
        let written = written.map(|line| line.rsplit_once(',').unwrap().1);
        assert_eq!(written.collect_vec(), printed, "Table {number}");
        assert!(table.title.starts_with(&format!("Table {number}. ")));
        let names: BTreeSet<_> = table.columns.iter().map(|own| &own.name).collect();
        assert_eq!(names.len(), table.columns.len(), "Table {number}");
    }
}
