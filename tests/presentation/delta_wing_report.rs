//! The delta wing's tables, number by number.

use crate::evidence::delta_wing_tables::delta_wing_tables;
use crate::prelude::*;

static RUN: LazyLock<WingCorrelation> =
    LazyLock::new(|| correlate_wing(&wing(), |_, _| {}).expect("it runs"));

fn wing() -> DeltaWing {
    DeltaWing::embedded()
}

#[test]
fn why_a_pass_stopped_is_said_in_words() {
    let mut run = RUN.clone();
    run.correlation.passes[0].inner.stop = Stop::LocalMinimum;
    run.correlation.passes[1].inner.stop = Stop::Iterations;
    let tables = delta_wing_tables(&wing(), &run).expect("tables");
    let passes = tables.iter().find(|table| table.name.contains("passes"));
    let said = passes
        .expect("a table of passes")
        .rows
        .iter()
        .map(|row| &row.cells[1])
        .collect_vec();
    let word = |word: &str| Cell::Text(word.to_owned());
    assert_eq!(
        said,
        [
            &word("local minimum"),
            &word("iterations"),
            &word("tolerance")
        ]
    );
}
