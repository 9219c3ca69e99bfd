//! Noisy test modes as tables, number by number.

use crate::evidence::noisy_modes::{NOISY_CASE, noisy_modes, noisy_tables, study};
use crate::prelude::*;

fn number(table: &Table, row: &str, column: &str) -> f64 {
    let at = table
        .columns
        .iter()
        .position(|found| found.name == column)
        .expect("the column");
    match table
        .rows
        .iter()
        .find(|found| found.label == row)
        .expect("the row")
        .cells[at]
    {
        Cell::Number { computed, .. } => computed,
        ref other => panic!("{row}, {column}: {other:?}"),
    }
}

#[test]
fn median_and_worst_are_of_the_seeds_alone() {
    let case = Case::new(NOISY_CASE).unwrap();
    let odd = noisy_modes(&case, Noise::USUAL, 1..=3).unwrap();
    for study in [study(), &odd] {
        let gages = &noisy_tables(study)[0];
        let raw = study.runs[1..]
            .iter()
            .map(|run| 100.0 * run.raw.gage_rms)
            .collect_vec();
        let (median, worst) = (
            number(gages, "median", "Raw all"),
            number(gages, "worst", "Raw all"),
        );
        let below = raw
            .iter()
            .filter(|value| **value < median - ROUND_OFF)
            .count();
        let above = raw
            .iter()
            .filter(|value| **value > median + ROUND_OFF)
            .count();
        assert_eq!((below, above), (raw.len() / 2, raw.len() / 2));
        assert_eq!(worst, raw.iter().copied().largest());
        let labels = gages.rows.iter().map(|row| row.label.as_str());
        assert_eq!(
            labels
                .filter(|label| label.parse::<u64>().is_err())
                .collect_vec(),
            ["no noise", "median", "worst"]
        );
    }
}

#[test]
fn notes_say_why_nothing_is_balanced_and_whether_appendix_b_helps() {
    let tables = noisy_tables(study());
    let notes = tables[0].notes.join(" ");
    let better = study().runs[1..]
        .iter()
        .filter(|run| run.screened.gage_rms < run.raw.gage_rms)
        .count();
    assert!(
        notes.contains("Balancing does not apply")
            && notes.contains(&format!("screened ones with {better}."))
    );
    // One that is as good is not better.
    let mut alike = study().clone();
    alike
        .runs
        .iter_mut()
        .for_each(|run| run.screened.gage_rms = run.raw.gage_rms);
    alike.runs[1].screened.gage_rms *= 0.9;
    assert!(
        noisy_tables(&alike)[0]
            .notes
            .join(" ")
            .contains("screened ones with 1.")
    );
    assert!(notes.contains("1.0 % of its shape's largest component"));
    let mut free = study().clone();
    free.support_ratio = None;
    assert!(
        noisy_tables(&free)[0]
            .notes
            .join(" ")
            .contains("balanced first")
    );
    free.runs.truncate(1);
    let alone = &noisy_tables(&free)[0];
    assert!(
        alone.rows[1..]
            .iter()
            .all(|row| row.cells.iter().all(|cell| *cell == Cell::Blank)),
        "no seeds"
    );
}
