//! The four cases against the independent program (golden/reference/), whole history and all.

use crate::common::tolerances::{EXPECTED_FREQUENCY, EXPECTED_HISTORY};
use approx::assert_relative_eq;
use corfem::cases::fit::fit;
use corfem::cases::torque_box::Reconstruction;
use corfem::cases::{CASES, Case, CaseResult, anomalies, run_case};
use corfem::method::model::Range;
use toml::Table;

fn expected() -> Table {
    include_str!("../../golden/reference/expected.toml")
        .parse()
        .expect("the golden reads")
}

fn list(table: &Table, section: &str, key: &str) -> Vec<f64> {
    let values = table[section][key].as_array().expect("a list");
    values
        .iter()
        .map(|value| value.as_float().expect("a number"))
        .collect()
}

fn number(table: &Table, section: &str, key: &str) -> f64 {
    table[section][key].as_float().expect("a number")
}

fn assert_all_close(found: &[f64], expected: &[f64], relative: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert_relative_eq!(a, b, max_relative = relative);
    }
}

fn result(number: usize) -> CaseResult {
    run_case(&Case::new(number).expect("a case"), |_, _| {}).expect("it runs")
}

#[test]
fn all_twelve_published_columns_have_the_expected_frequencies() {
    let table = expected();
    let fit = fit(&Reconstruction::embedded().expect("the box")).expect("solved");
    assert_eq!(fit.columns.len(), 12);
    for column in &fit.columns {
        let name = column.column.replace('_', " ");
        let section = if name.starts_with("pass") {
            format!("case {} {name}, published gages", column.case)
        } else {
            format!("case {} {name}", column.case)
        };
        let frequencies = list(&table, &section, "frequencies");
        assert_all_close(&column.frequencies_hz, &frequencies, EXPECTED_FREQUENCY);
        if name != "gvt" {
            let (f, v) = ("frequency_rms", "shape_rms");
            assert_relative_eq!(
                column.frequency_rms,
                number(&table, &section, f),
                max_relative = EXPECTED_HISTORY
            );
            assert_relative_eq!(
                column.shape_rms,
                number(&table, &section, v),
                max_relative = EXPECTED_HISTORY
            );
        } else {
            assert!(column.frequency_rms < 1e-12 && column.shape_rms < 1e-12);
        }
    }
}

#[test]
fn initial_solutions_are_the_expected_ones() {
    let table = expected();
    for case in CASES {
        let initial = result(case).correlation.initial;
        let section = format!("case {case} initial");
        let frequencies = list(&table, &section, "frequencies");
        assert_all_close(
            &initial.modes.frequencies_hz(),
            &frequencies,
            EXPECTED_FREQUENCY,
        );
        let (f, v) = (initial.errors.frequency_rms(), initial.errors.shape_rms());
        assert_relative_eq!(
            f,
            number(&table, &section, "frequency_rms"),
            max_relative = EXPECTED_HISTORY
        );
        assert_relative_eq!(
            v,
            number(&table, &section, "shape_rms"),
            max_relative = EXPECTED_HISTORY
        );
    }
}

#[test]
fn whole_history_of_cases_1_to_3_is_the_expected_one() {
    let table = expected();
    for (case, passes) in [(1, 2), (2, 2), (3, 3)] {
        let result = result(case);
        assert_eq!(result.correlation.passes.len(), passes);
        assert!(result.correlation.converged && result.succeeded());
        for (row, pass) in result.correlation.passes.iter().enumerate() {
            let section = format!("case {case} computed pass {}", row + 1);
            let iterations = table[&section]["iterations"].as_integer().expect("a count");
            assert_eq!(pass.inner.iterations.len() as i64, iterations, "{section}");
            let sums: Vec<f64> = pass
                .inner
                .iterations
                .iter()
                .map(|i| i.errors.sum())
                .collect();
            assert_all_close(
                &sums,
                &list(&table, &section, "inner_error_sums"),
                EXPECTED_HISTORY,
            );
            assert_all_close(
                &result.pass_gages[row],
                &list(&table, &section, "gages"),
                EXPECTED_HISTORY,
            );
            let frequencies = list(&table, &section, "frequencies");
            assert_all_close(&pass.check.frequencies_hz, &frequencies, EXPECTED_HISTORY);
            let (f, v) = (
                pass.check.errors.frequency_rms(),
                pass.check.errors.shape_rms(),
            );
            assert_relative_eq!(
                f,
                number(&table, &section, "frequency_rms"),
                max_relative = EXPECTED_HISTORY
            );
            assert_relative_eq!(
                v,
                number(&table, &section, "shape_rms"),
                max_relative = EXPECTED_HISTORY
            );
        }
    }
}

#[test]
fn case_4_names_its_faulty_element() {
    let table = expected();
    let section = "case 4 first iteration";
    let result = result(4);
    assert_all_close(
        result.unlimited_factors(),
        &list(&table, section, "unlimited_factors"),
        EXPECTED_HISTORY,
    );
    let error_sum = result.correlation.initial.errors.sum();
    assert_relative_eq!(
        error_sum,
        number(&table, section, "error_sum"),
        max_relative = EXPECTED_HISTORY
    );
    assert_eq!(result.anomalies.len(), 1);
    assert_eq!(result.anomalies[0].parameter, "8");
    let largest = result
        .unlimited_factors()
        .iter()
        .copied()
        .fold(f64::MIN, f64::max);
    assert_eq!(result.anomalies[0].factor, largest);
    // Published: about 60.
    assert!((55.0..65.0).contains(&largest));
    assert_eq!(result.correlation.passes.len(), 1);
    assert_eq!(result.correlation.passes[0].inner.iterations.len(), 1);
    assert!(result.succeeded() && !result.correlation.converged);
}

#[test]
fn other_cases_report_no_anomaly() {
    for case in [1, 2, 3] {
        assert!(result(case).anomalies.is_empty());
    }
}

#[test]
fn same_input_gives_the_same_bytes() {
    let json = || {
        let results: Vec<_> = CASES.into_iter().map(result).collect();
        let fit = fit(&Reconstruction::embedded().expect("the box")).expect("solved");
        corfem::present::json::cases(&results, &fit).expect("written")
    };
    assert_eq!(json(), json());
}

/// Far is twenty widths beyond either bound, and the farthest comes first.
#[test]
fn an_anomaly_lies_far_beyond_either_bound() {
    let range = Range {
        lower: 0.55,
        upper: 1.5,
    };
    let width = range.upper - range.lower;
    let (above, below) = (range.upper + 20.0 * width, range.lower - 20.0 * width);
    let names = ["A", "B", "C", "D", "E"].map(String::from);
    let factors = [above + 0.1, above - 0.1, below - 0.2, below + 0.2, 1.0];
    let found = anomalies(&names, &factors, range);
    let found: Vec<(&str, f64)> = found
        .iter()
        .map(|anomaly| (anomaly.parameter.as_str(), anomaly.factor))
        .collect();
    assert_eq!(found, [("C", factors[2]), ("A", factors[0])]);
    // Numbers without round-off: twenty widths are not yet beyond twenty widths.
    let range = Range {
        lower: 0.5,
        upper: 1.5,
    };
    assert!(anomalies(&names, &[21.5, -19.5], range).is_empty());
    assert_eq!(anomalies(&names, &[21.75, -19.75], range).len(), 2);
}

/// Case 4 as the paper ran it is done when its one iteration names an element; run on, it has to correlate, as every
/// other case has in however few iterations.
#[test]
fn one_iteration_is_enough_for_case_4_alone() {
    let with_iterations = |number: usize, iterations: usize| {
        let mut case = Case::new(number).expect("a case");
        case.settings.inner.iterations = iterations;
        run_case(&case, |_, _| {}).expect("it runs")
    };
    assert!(with_iterations(4, 1).succeeded());
    let longer = with_iterations(4, 2);
    assert!(!longer.anomalies.is_empty());
    assert_eq!(longer.succeeded(), longer.correlation.converged);
    assert!(!longer.succeeded());
    let shorter = with_iterations(2, 1);
    assert!(shorter.anomalies.is_empty());
    assert_eq!(shorter.succeeded(), shorter.correlation.converged);
}
