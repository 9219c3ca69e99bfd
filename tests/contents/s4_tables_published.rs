//! The report against the published tables: how near they are, and that what was promised is kept.

use crate::evidence::fit::fit;
use crate::prelude::*;

fn results() -> Vec<CaseResult> {
    [1, 2, 3].map(|number| case_run(&case_of(number))).into()
}

/// Column of a published frequency table's last pass.
fn last_pass(case: usize) -> &'static str {
    if case == 3 {
        "pass_3_percent"
    } else {
        "pass_2_percent"
    }
}

fn frequency_table(case: usize) -> PublishedTable {
    PublishedTable::number(2 * case + 1).unwrap()
}

#[test]
fn box_fits_the_108_published_frequencies_as_stated() {
    // Differences of all, and where they are.
    let all = fit().into_iter().flat_map(|column| {
        let at = (column.case, column.stage);
        let differences = column.differences.into_iter().zip(1..);
        differences.map(move |(off, mode)| (off.abs(), at, mode))
    });
    let all = all.collect_vec();
    assert_eq!(all.len(), 108);
    // The fit stated in paper/print_and_box.md: RMS 1.106 %, largest 5.20 % at Case 3's start, mode 4.
    let rms = rms(&all.iter().map(|(off, ..)| *off).collect_vec());
    let (largest, at, mode) = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    assert_eq!(
        format!("{:.3} {:.2}", 100.0 * rms, 100.0 * largest),
        "1.106 5.20"
    );
    assert_eq!((at, mode), ((3, "initial"), 4));
}

#[test]
fn initial_shape_errors_are_the_published_ones_within_two_percent_of_them() {
    for result in results() {
        let printed = frequency_table(result.case.number)
            .required("shape_rms", "initial_percent")
            .unwrap();
        let computed = 100.0 * result.correlation.initial.errors.shape_rms();
        // Published 7.67, 0.83, 8.94 %; computed 7.56, 0.84, 8.92 %.
        assert!(
            relative_error(computed, printed) < FITTED_SHAPE_ERROR,
            "{computed} for {printed}"
        );
    }
}

#[test]
fn initial_frequency_errors_are_near_the_published_ones() {
    for result in results() {
        let table = frequency_table(result.case.number);
        let printed = table.required("frequency_rms", "initial_percent").unwrap();
        let computed = 100.0 * result.correlation.initial.errors.frequency_rms();
        // Within the fit of the box: 12.11 for 12.76, 20.63 for 21.11, 5.67 for 5.01 %.
        assert_within(computed, printed, FITTED_FREQUENCY_ERROR);
    }
}

#[test]
fn final_errors_are_no_worse_than_published_except_case_2s_frequencies() {
    for result in results() {
        let table = frequency_table(result.case.number);
        let last = result.correlation.passes.last().unwrap();
        let heading = last_pass(result.case.number);
        let frequency = table.required("frequency_rms", heading).unwrap();
        let shape = table.required("shape_rms", heading).unwrap();
        // Case 2 ends at 0.45 for 0.42 %: the cap of thirty iterations leaves it short of its tolerance in both passes.
        let allowed = if result.case.number == 2 {
            0.46
        } else {
            frequency
        };
        assert!(100.0 * last.check.errors.frequency_rms() <= allowed);
        assert!(100.0 * last.check.errors.shape_rms() <= shape);
    }
}

#[test]
fn gages_of_case_3_keep_their_bounds_in_every_pass() {
    let result = &results()[2];
    for gage in result.pass_gages.iter().flatten() {
        assert!((0.007 - ROUND_OFF * 0.01..=0.013 + ROUND_OFF * 0.01).contains(gage));
    }
}

#[test]
fn every_table_reads_and_its_misprints_are_remarked() {
    for number in 2..=13 {
        let table = PublishedTable::number(number).unwrap();
        assert!(!table.labels.is_empty() && !table.headings.is_empty());
        let found = contradictions(&table);
        for (row, column) in &found {
            let remarked = table
                .remarks
                .iter()
                .any(|r| r.contains(&format!("row {row},")) && r.contains(column));
            assert!(
                remarked,
                "{}: row {row}, {column} contradicts itself unremarked",
                table.name
            );
        }
        let misprints = table
            .remarks
            .iter()
            .filter(|r| r.starts_with("misprint"))
            .count();
        assert!(
            misprints <= found.len(),
            "{}: {misprints} misprints noted, found {found:?}",
            table.name
        );
    }
    assert!(PublishedTable::number(1).is_err() && PublishedTable::number(14).is_err());
}

/// Percent errors that do not follow from the frequency or gage beside them, whatever its last digit stands for.
fn contradictions(table: &PublishedTable) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for label in &table.labels {
        for unit in ["hz", "in"] {
            let Some(target) = table.value(label, &format!("gvt_{unit}")) else {
                continue;
            };
            for heading in table
                .headings
                .iter()
                .filter(|h| h.ends_with(&format!("_{unit}")))
            {
                let percent = heading.replace(&format!("_{unit}"), "_percent");
                let (Some(value), Some(printed)) =
                    (table.value(label, heading), table.value(label, &percent))
                else {
                    continue;
                };
                // Half a unit of the error's one decimal, and of the last of four digits of value and target.
                let half_unit = |x: f64| 0.5 * 10f64.powf(x.log10().floor() - 3.0) / x;
                let slack =
                    0.05 + 100.0 * (half_unit(value) + half_unit(target)) + 100.0 * ROUND_OFF;
                let recomputed = 100.0 * (value / target - 1.0);
                if (recomputed - printed).abs() > slack {
                    found.push((label.clone(), percent));
                }
            }
        }
    }
    found
}
