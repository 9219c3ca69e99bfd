//! The data of the figures are what the tables say.

use crate::common::jobs::loaded;
use crate::evidence::wing_subjects::wing_subjects;
use crate::paper::figures::error_history::error_history;
use crate::paper::figures::mode_shapes::panel_parts;
use crate::paper::figures::report::{derivatives, mode_agreement};
use crate::paper::figures::{Figure, report_figures};
use crate::paper::figures::{case_figures, comparison_figures};
use crate::paper::report::case_report;
use crate::paper::tables::cases::{frequency_table, iteration_table};
use crate::paper::tables::unlimited::{ANOMALY, unlimited_factors, unlimited_table};
use crate::prelude::*;
use corfem::present::frame::DrawnModes;
use corfem::present::table::Column;
use corfem::torque_box::fewer_modes::{FewerModesRun, all_runs};

/// The four cases, run once for all tests of figures.
pub fn results() -> &'static [CaseResult] {
    static RESULTS: OnceLock<Vec<CaseResult>> = OnceLock::new();
    RESULTS.get_or_init(|| {
        let run =
            |number| run_case(&Case::new(number).expect("a case"), |_, _| {}).expect("it runs");
        CASES.into_iter().map(run).collect()
    })
}

/// The runs with fewer modes, run once.
pub fn fewer_modes_runs() -> &'static [FewerModesRun] {
    static RUNS: OnceLock<Vec<FewerModesRun>> = OnceLock::new();
    RUNS.get_or_init(|| all_runs(&Case::new(PUBLISHED_CASE).expect("a case")).expect("they run"))
}

/// The wings, correlated once.
pub fn wings() -> &'static [Report] {
    static WINGS: OnceLock<[Report; 2]> = OnceLock::new();
    WINGS.get_or_init(|| wing_subjects().expect("they run"))
}

/// Every figure of the report, drawn anew.
pub fn draw_all() -> Vec<Figure> {
    let mut figures = case_figures(results()).expect("drawn");
    figures.extend(comparison_figures(PUBLISHED_CASE, fewer_modes_runs()).expect("drawn"));
    figures
}

/// Every figure of the report, drawn once.
pub fn figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(draw_all)
}

/// The same and those of the wings, which have places, bounds and modes that the box has not.
pub fn all_figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(|| {
        let of_wing = |wing| report_figures(wing).expect("drawn");
        let of_wings = wings().iter().flat_map(of_wing);
        figures().iter().cloned().chain(of_wings).collect()
    })
}

/// The figures of the worked jobs.
pub fn job_figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    let of_job = |name| {
        let report = Report::from_job(&loaded(name), Some(worked(name))).expect("a report");
        report_figures(&report).expect("drawn")
    };
    let jobs = ["box", "building", "garteur", "wing"];
    let drawn = || {
        std::thread::scope(|scope| {
            let drawn = jobs.map(|name| scope.spawn(move || of_job(name)));
            drawn.map(|figures| figures.join().expect("drawn")).concat()
        })
    };
    FIGURES.get_or_init(drawn)
}

fn cell(table: &Table, row: &str, column: &str, unit: &str) -> (f64, Option<f64>) {
    let named = |c: &Column| c.name == column && c.unit == unit;
    let at = table.columns.iter().position(named).expect("the column");
    let row = table.rows.iter().find(|r| r.label == row).expect("the row");
    match row.cells[at] {
        Cell::Number {
            computed,
            published,
            ..
        } => (computed, published),
        _ => panic!("no number in row {}, column {column}", row.label),
    }
}

#[test]
fn error_histories_begin_and_end_with_the_tables_and_count_as_table_13() {
    let counts = iteration_table(results()).expect("it reads");
    for result in &results()[..3] {
        let data = error_history(&case_report(result).expect("a subject"));
        let table = frequency_table(result).expect("it reads");
        let case = result.case.number.to_string();
        assert_eq!(data.len(), result.correlation.passes.len());
        let root = (9.0_f64).sqrt();
        let same = |errors: &corfem::method::error_sum::Errors, column: &str| {
            let percent = |row| cell(&table, row, column, "%").0;
            assert_relative_eq!(
                100.0 * errors.frequency,
                root * percent("frequency RMS"),
                max_relative = ROUND_OFF
            );
            assert_relative_eq!(
                100.0 * errors.shape,
                root * percent("shape RMS"),
                max_relative = ROUND_OFF
            );
        };
        let mut iterations = 0;
        for (row, pass) in data.iter().enumerate() {
            let number = row + 1;
            let before = match number {
                1 => "Initial error".to_owned(),
                later => format!("Pass {} error", later - 1),
            };
            same(&pass.inner[0], &before);
            same(&pass.check, &format!("Pass {number} error"));
            assert_eq!(pass.from, iterations);
            let count = cell(&counts, &case, &format!("Pass {number}"), "").0;
            iterations += count as usize;
            assert_eq!(pass.inner.len(), count as usize + 1);
            assert_eq!(pass.to(), iterations);
            assert_eq!(
                pass.tolerance,
                Some(if number == 1 { 0.025 } else { 0.015 })
            );
            let steps = &result.correlation.passes[row].inner.iterations;
            for (errors, step) in pass.inner[1..].iter().zip(steps) {
                assert_eq!(*errors, step.errors);
            }
        }
    }
}

#[test]
fn drawn_modes_are_those_of_the_tables() {
    for result in &results()[..3] {
        let subject = case_report(result).expect("a subject");
        let modes = DrawnModes::from_report(&subject)
            .expect("nine points")
            .expect("places");
        let table = frequency_table(result).expect("it reads");
        let last = format!("Pass {}", result.correlation.passes.len());
        assert_eq!(modes.modes.len(), 9);
        for mode in &modes.modes {
            let row = mode.number.to_string();
            for (hertz, column) in mode.hertz.iter().zip(["GVT", "Initial", &last]) {
                assert_relative_eq!(
                    *hertz,
                    cell(&table, &row, column, "Hz").0,
                    max_relative = ROUND_OFF
                );
            }
            let up = |state: usize| {
                mode.moved[state]
                    .iter()
                    .map(|motion| motion.z)
                    .collect_vec()
            };
            for state in 0..3 {
                let largest = up(state)
                    .into_iter()
                    .fold(0.0, |most: f64, w| most.max(w.abs()));
                assert_eq!(largest, 1.0);
                // Analysis shapes are signed like their test mode.
                assert!(up(state).iter().zip(up(0)).map(|(a, b)| a * b).sum::<f64>() > 0.0);
            }
        }
        // The first bending mode moves everything one way; the color of every part is that of its place.
        let parts = panel_parts(&modes.frame, &Vector3::z(), &modes.modes[0].moved[0]);
        let sign = parts[0].1.signum();
        assert!(
            parts
                .iter()
                .all(|(_, motion)| sign * motion > 0.0 && motion.abs() <= 1.0)
        );
    }
}

#[test]
fn mode_agreement_is_complete_before_and_nearly_the_identity_after() {
    for result in &results()[..3] {
        let masses = &result.case.reconstruction.masses;
        let subject = case_report(result).expect("a subject");
        let initial = ExactResult::from(&result.correlation.initial);
        let checks = [&initial, subject.corrected()];
        let maps = mode_agreement(&subject).expect("shapes fit");
        let values = maps
            .iter()
            .map(|map| map.values.map(|value| value.expect("a cell")))
            .collect_vec();
        for (at, check) in checks.into_iter().enumerate() {
            let (cross, assurance) = (&values[at], &values[at + 2]);
            assert_eq!((cross.shape(), assurance.shape()), ((9, 9), (9, 9)));
            for j in 0..9 {
                // Nine modes of nine DOF hold every shape: Bessel's inequality is an equality.
                let column = cross.column(j);
                assert_relative_eq!(column.norm(), 1.0, max_relative = MATRIX_ROUND_OFF);
                assert_eq!(column.icamax(), check.pairing.analysis_mode[j]);
                for i in 0..9 {
                    let (v, w) = (
                        check.modes.shapes().column(i),
                        result.test.shapes().column(j),
                    );
                    let partner = check
                        .pairing
                        .analysis_mode
                        .iter()
                        .position(|&mode| mode == i)
                        .expect("all are paired");
                    let weighted: f64 = (0..9).map(|d| v[d] * masses[d] * w[d]).sum();
                    let weighted = check.pairing.sign[partner] * weighted;
                    assert!((cross[(i, j)] - weighted).abs() < MATRIX_ROUND_OFF);
                    let mac = v.dot(&w).powi(2) / (v.dot(&v) * w.dot(&w));
                    assert!((assurance[(i, j)] - mac).abs() < MATRIX_ROUND_OFF);
                }
            }
        }
        let off = |m: &nalgebra::DMatrix<f64>| (m.abs() - nalgebra::DMatrix::identity(9, 9)).amax();
        assert!(off(&values[1]) < off(&values[0]));
    }
}

#[test]
fn derivatives_are_central_differences_and_give_the_factors_of_the_table() {
    for result in results() {
        let maps = derivatives(&case_report(result).expect("a subject")).expect("they were taken");
        let values = maps
            .each_ref()
            .map(|map| map.values.map(|value| value.expect("a cell")));
        let [frequency, error_sum] = &values;
        assert_eq!((frequency.shape(), error_sum.shape()), ((15, 9), (15, 1)));
        let model = result.case.model().expect("a model");
        let start = &result.correlation.initial;
        let shares = model.matrices(&[1.0; 15]).expect("analyzed").shares;
        for e in 0..15 {
            let frequencies = |step: f64| {
                let mut factors = [1.0; 15];
                factors[e] += step;
                let dynamic = model.matrices(&factors).expect("analyzed");
                corfem::method::modes::solve(&dynamic.stiffness, &dynamic.mass, 9)
                    .expect("solved")
                    .frequencies_hz()
            };
            // Fourth-order central difference: the eigenvalues' rounding asks for a step that second order cannot afford.
            const STEP: f64 = 2e-3;
            let stencil = [
                (8.0, STEP),
                (-8.0, -STEP),
                (-1.0, 2.0 * STEP),
                (1.0, -2.0 * STEP),
            ]
            .map(|(weight, step)| (weight, frequencies(step)));
            for j in 0..9 {
                let i = start.pairing.analysis_mode[j];
                let sum: f64 = stencil.iter().map(|(weight, f)| weight * f[i].ln()).sum();
                let difference = sum / (12.0 * STEP);
                let derivative = frequency[(e, j)];
                assert!(
                    (derivative - difference).abs() < CENTRAL_DIFFERENCE_FREQUENCY,
                    "case {}, panel {}, mode {}: {derivative} for {difference}",
                    result.case.number,
                    e + 1,
                    j + 1
                );
            }
            // (13) from the figure's column gives the unlimited factor of the table.
            let seen: f64 = (0..9)
                .map(|j| {
                    let v = result.test.shapes().column(j);
                    let share = v.dot(&(&shares[e] * v)) / result.test.omega_squared()[j];
                    share * share
                })
                .sum();
            let measure = match result.case.settings.inner.step {
                StepRule::Relative => 1.0,
                _ => seen.sqrt(),
            };
            let factor = 1.0 - 0.8 * start.errors.sum() * error_sum[(e, 0)] / measure;
            let printed = cell(&unlimited_table(result), &maps[0].rows.1[e], "Factor", "").0;
            assert_relative_eq!(factor, printed, max_relative = 1e3 * MATRIX_ROUND_OFF);
        }
    }
}

#[test]
fn unlimited_factors_are_those_of_the_table_with_the_published_one() {
    let result = &results()[3];
    let factors = unlimited_factors(result);
    let table = unlimited_table(result);
    assert_eq!(factors.len(), 15);
    for factor in &factors {
        let (computed, published) = cell(&table, &factor.name, "Factor", "");
        assert_eq!((factor.value, factor.published), (computed, published));
        let is_faulty = factor.name == "8";
        assert_eq!(factor.published, is_faulty.then_some(60.0));
        assert_eq!(factor.remark, is_faulty.then_some(ANOMALY));
        let row = table
            .rows
            .iter()
            .find(|row| row.label == factor.name)
            .expect("the row");
        let is_within = (0.55..=1.50).contains(&computed);
        let verdict = if is_within {
            "within bounds"
        } else {
            factor.remark.unwrap_or("limited")
        };
        assert_eq!(row.cells[1], Cell::text(verdict));
    }
}
