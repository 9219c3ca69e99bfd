//! The four cases by every reading of the step against the independent program (golden/reference/), whole history and all.

use crate::evidence::fit::fit;
use crate::evidence::readings::run_by_reading;
use crate::prelude::*;
use corfem::torque_box::ANOMALY_RATIO;
use toml::Table;

fn expected(reading: StepRule) -> Table {
    let path = format!("golden/reference/expected_{}.toml", reading.name());
    fs::read_to_string(in_root(&path)).unwrap().parse().unwrap()
}

fn list(table: &Table, section: &str, key: &str) -> Vec<f64> {
    let values = table[section][key].as_array().unwrap();
    values
        .iter()
        .map(|value| value.as_float().unwrap())
        .collect()
}

fn number(table: &Table, section: &str, key: &str) -> f64 {
    table[section][key].as_float().unwrap()
}

fn assert_all_close(found: &[f64], expected: &[f64], relative: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert_relative_eq!(a, b, max_relative = relative);
    }
}

fn result(number: usize) -> CaseResult {
    case_run(&case_of(number))
}

#[test]
fn all_twelve_published_columns_have_the_expected_frequencies() {
    let table = expected(StepRule::Matrix);
    let columns = fit();
    assert_eq!(columns.len(), 12);
    for column in &columns {
        let name = column.stage.replace('_', " ");
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
                column.errors.frequency_rms(),
                number(&table, &section, f),
                max_relative = EXPECTED_HISTORY
            );
            assert_relative_eq!(
                column.errors.shape_rms(),
                number(&table, &section, v),
                max_relative = EXPECTED_HISTORY
            );
        } else {
            assert!(
                column.errors.frequency_rms().max(column.errors.shape_rms()) < 10.0 * ROUND_OFF
            );
        }
    }
}

/// Every pass of a run as the independent program has it.
fn assert_history(result: &CaseResult) {
    let table = expected(result.case.settings.inner.step);
    for (row, pass) in result.correlation.passes.iter().enumerate() {
        let section = format!("case {} computed pass {}", result.case.number, row + 1);
        let iterations = table[&section]["iterations"].as_integer().unwrap();
        assert_eq!(pass.inner.iterations.len() as i64, iterations, "{section}");
        let sums = pass
            .inner
            .iterations
            .iter()
            .map(|i| i.errors.sum())
            .collect_vec();
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
        assert_all_close(
            &ExactResult::from(&pass.check).frequencies_hz,
            &frequencies,
            EXPECTED_FREQUENCY,
        );
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

#[test]
fn every_reading_makes_the_expected_history_of_cases_1_to_3() {
    for reading in StepRule::ALL {
        for (number, passes) in [(1, 2), (2, 2), (3, 3)] {
            let result = run_by_reading(&case_of(number), reading).unwrap();
            assert_eq!(result.correlation.passes.len(), passes);
            assert_history(&result);
        }
    }
}

/// Tolerances decide when a case stops; they stop where the paper's print does.
#[test]
fn cases_stop_by_their_tolerances_after_the_printed_passes() {
    for (number, reading) in [
        (1, StepRule::Own),
        (2, StepRule::Relative),
        (3, StepRule::Relative),
    ] {
        let result = result(number);
        assert_eq!(result.case.settings.inner.step, reading);
        assert!(
            (
                result.case.settings.least_passes,
                result.case.settings.most_passes
            ) == (1, 10)
        );
        assert_eq!(result.correlation.passes.len(), published_passes(number));
        assert!(result.correlation.converged && result.succeeded());
        assert_history(&result);
    }
}

#[test]
fn every_reading_makes_the_expected_passes_with_fewer_modes() {
    for reading in StepRule::ALL {
        let table = expected(reading);
        let mut case = case_of(PUBLISHED_CASE);
        case.settings.inner.step = reading;
        for run in published_runs(&case).unwrap() {
            let section = format!(
                "case 2, {} test and {} analysis modes",
                run.test_modes, run.analysis_modes
            );
            assert_eq!(
                Some(run.iterations as i64),
                table[&section]["iterations"].as_integer(),
                "{reading:?} {section}"
            );
            assert_all_close(
                &run.gages_in,
                &list(&table, &section, "gages"),
                EXPECTED_HISTORY,
            );
            let mut frequencies = list(&table, &section, "inner_frequencies");
            frequencies.sort_by(f64::total_cmp);
            let mut found = run.inner.frequencies_hz.clone();
            found.sort_by(f64::total_cmp);
            assert_all_close(&found, &frequencies, EXPECTED_FREQUENCY);
            let (f, v) = ("inner_frequency_rms", "inner_shape_rms");
            assert_relative_eq!(
                run.inner.frequency_rms,
                number(&table, &section, f),
                max_relative = EXPECTED_HISTORY
            );
            assert_relative_eq!(
                run.inner.shape_rms,
                number(&table, &section, v),
                max_relative = EXPECTED_HISTORY
            );
        }
    }
}

#[test]
fn case_4_names_its_faulty_element() {
    let section = "case 4 first iteration";
    for (reading, stated) in
        StepRule::ALL
            .into_iter()
            .zip(["46.1 3.8", "58.4 4.6", "2.5 2.5", "148.7 2.5"])
    {
        let table = expected(reading);
        let result = run_by_reading(&case_of(4), reading).unwrap();
        assert_all_close(
            &result.unlimited_factors,
            &list(&table, section, "unlimited_factors"),
            EXPECTED_HISTORY,
        );
        let error_sum = result.correlation.initial.errors.sum();
        assert_relative_eq!(
            error_sum,
            number(&table, section, "error_sum"),
            max_relative = EXPECTED_HISTORY
        );
        let mut others = result.unlimited_factors.clone();
        let factor = others.remove(7);
        assert_eq!(
            format!("{factor:.1} {:.1}", others.into_iter().largest()),
            stated
        );
        // What is named does not depend on the reading that a case is run by.
        let anomaly = result.anomaly.as_ref().unwrap();
        assert_eq!(
            (&*anomaly.parameter, anomaly.factor),
            ("8", result.unlimited_factors[7])
        );
        assert_eq!(format!("{:.0}", anomaly.ratio), "59");
    }
    let result = result(4);
    assert_eq!(
        (
            result.correlation.passes.len(),
            result.correlation.passes[0].inner.iterations.len()
        ),
        (1, 1)
    );
    assert!(result.succeeded() && !result.correlation.converged);
}

#[test]
fn other_cases_report_no_anomaly_by_any_reading() {
    for reading in StepRule::ALL {
        for number in [1, 2, 3] {
            let result = run_by_reading(&case_of(number), reading).unwrap();
            // The largest factor stays near the next: what ANOMALY_RATIO lies between.
            let mut factors = result.unlimited_factors.clone();
            factors.sort_by(f64::total_cmp);
            assert!(factors[14] / factors[13] < 1.3);
            assert_eq!(result.anomaly, None);
        }
    }
}

/// A demand stands out from all others, which count as one at least; what stands far below does not.
#[test]
fn what_stands_out_is_many_times_the_next_demand() {
    let ratio = ANOMALY_RATIO;
    assert_eq!(
        stands_out(&[3.0, 12.0 * ratio, 1.0]),
        Some((1, 4.0 * ratio))
    );
    assert_eq!(
        stands_out(&[-30.0, 2.0 * ratio, 0.5]),
        Some((1, 2.0 * ratio))
    );
    assert_eq!(stands_out(&[2.0, 2.0 * ratio, 1.0]), None);
    assert_eq!(stands_out(&[-60.0, 0.9, 0.5]), None);
    assert_eq!(stands_out(&[2.0 * ratio]), Some((0, 2.0 * ratio)));
    assert_eq!(stands_out(&[]), None);
}
