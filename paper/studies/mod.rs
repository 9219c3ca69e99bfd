//! The studies behind what `paper/*.md` claims of the method: made-up structures, made-up noise, and the tables and figures of
//! the documents. `cargo bench --bench studies -- NAME` prints one; the tests hold them against the goldens and the documents.

pub mod accumulation;
pub mod coverage;
pub mod delta_wing;
pub mod detection;
pub mod diagram;
pub mod eigensolutions;
pub mod fit;
pub mod known;
pub mod linearization;
pub mod by_matrix;
pub mod noisy_modes;
pub mod readings;
pub mod rules;
pub mod tour_figures;

use crate::prelude::*;

/// Name of a study's golden, and its tables.
pub type Study = (&'static str, fn() -> Vec<Table>);

/// All of them; the last two take minutes.
pub const STUDIES: [Study; 12] = [
    ("readings", readings::tables),
    ("fit", fit::tables),
    ("rules", rules::tables),
    ("noisy_modes", noisy_modes::tables),
    ("matrices_case_1", || by_matrix::tables(1)),
    ("matrices_case_2", || by_matrix::tables(2)),
    ("matrices_case_3", || by_matrix::tables(3)),
    ("delta_wing", delta_wing::tables),
    ("eigensolutions", eigensolutions::tables),
    ("linearization", linearization::tables),
    ("coverage", || coverage::tables(coverage::SEEDS)),
    ("detection", detection::tables),
];

/// Rows of numbers as a table whose columns may end with a unit; a number that is none leaves its place blank.
pub fn rows<L: ToString>(
    name: &str,
    columns: &[&str],
    rows: impl IntoIterator<Item = (L, Vec<f64>)>,
) -> Table {
    let table = Table::new(name, "", "");
    let mut table = columns.iter().fold(table, |table, column| {
        let percent = column.strip_suffix(" %");
        let unit = percent.map_or("", |_| "%");
        table.column(percent.unwrap_or(column), unit, [])
    });
    for (label, found) in rows {
        let found = found
            .into_iter()
            .map(|number| Some(number).filter(|own| !own.is_nan()));
        table.row(label, numbers(found, Digits::Fixed(0)));
    }
    table
}

/// Fractions in percent.
pub fn percents(fractions: impl IntoIterator<Item = f64>) -> Vec<f64> {
    fractions.into_iter().map(|own| 100.0 * own).collect()
}
