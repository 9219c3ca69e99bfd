//! What the printed gages say about the readings of the step and of the sum.

use crate::common::golden::Numbers;
use crate::common::tolerances::ROUND_OFF;
use crate::evidence::reading_tables::readings_tables;
use crate::evidence::readings::{
    READINGS, ReadingColumn, all_columns, columns_of, detection, run_by_reading,
};
use corfem::method::modes::solve;
use corfem::method::step::StepRule;
use corfem::present::render::csv;
use corfem::torque_box::fewer_modes::PUBLISHED_CASE;
use corfem::torque_box::published::PublishedTable;
use corfem::torque_box::wing_box::{Reconstruction, TEST_GAGE};
use corfem::torque_box::{CASES, Case, run_case};
use nalgebra::DMatrix;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, RngSeed, TestRunner};
use std::path::Path;
use std::sync::LazyLock;

fn the_box() -> Reconstruction {
    Reconstruction::embedded().expect("the box")
}

static COLUMNS: LazyLock<Vec<ReadingColumn>> =
    LazyLock::new(|| all_columns(&the_box()).expect("they run"));

fn of(reading: StepRule, table: usize) -> Vec<&'static ReadingColumn> {
    COLUMNS
        .iter()
        .filter(|column| (column.reading, column.table) == (reading, table))
        .collect()
}

/// Correlation in hundredths and difference in tenths of a percent point, column by column of a table of gages.
fn agreement(reading: StepRule, table: usize) -> Vec<(i64, i64)> {
    let of_column = |column: &&ReadingColumn| {
        (
            (100.0 * column.correlation()).round() as i64,
            (1000.0 * column.difference()).round() as i64,
        )
    };
    of(reading, table).iter().map(of_column).collect()
}

#[test]
fn cases_2_and_3_and_tables_10_to_12_were_run_with_the_relative_change() {
    assert_eq!(agreement(StepRule::Relative, 6), [(84, 93), (83, 106)]);
    assert_eq!(
        agreement(StepRule::Relative, 8),
        [(89, 85), (81, 115), (86, 86)]
    );
    assert_eq!(agreement(StepRule::Relative, 10), [(92, 70), (88, 81)]);
    assert_eq!(
        agreement(StepRule::Relative, 11),
        [(93, 71), (94, 52), (92, 65)]
    );
    assert_eq!(
        agreement(StepRule::Relative, 12),
        [(87, 118), (87, 123), (87, 124)]
    );
    // In each of these columns it is nearer to the print than matrix and own, by both measures.
    for table in [6, 8, 10, 11, 12] {
        for other in [StepRule::Norm, StepRule::Diagonal] {
            for (relative, other) in of(StepRule::Relative, table).iter().zip(of(other, table)) {
                assert!(relative.correlation() > other.correlation());
                assert!(relative.difference() < other.difference());
            }
        }
    }
}

#[test]
fn case_1_was_not() {
    for (relative, (own, matrix)) in of(StepRule::Relative, 4)
        .iter()
        .zip(of(StepRule::Diagonal, 4).iter().zip(of(StepRule::Norm, 4)))
    {
        assert!(relative.difference() > 2.0 * own.difference().max(matrix.difference()));
    }
    // The step of own and matrix serves about equally.
    let shear = |reading| {
        of(reading, 4)
            .iter()
            .map(|c| (1000.0 * c.gage_rms[0]).round() as i64)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        (shear(StepRule::Diagonal), shear(StepRule::Norm)),
        (vec![84, 50], vec![69, 42])
    );
}

#[test]
fn correlation_and_difference_by_hand() {
    let column = ReadingColumn {
        gages_in: [0.011, 0.012, 0.013].to_vec(),
        published_errors: vec![0.3, 0.4, 0.5],
        ..COLUMNS[0].clone()
    };
    assert!((column.correlation() - 1.0).abs() < ROUND_OFF);
    assert!((column.difference() - 0.2).abs() < ROUND_OFF);
    let turned = ReadingColumn {
        published_errors: vec![0.3, 0.2, 0.1],
        ..column
    };
    assert!((turned.correlation() + 1.0).abs() < ROUND_OFF);
}

/// Frequencies of Table 11's gages by the inner loop's own frozen model, its steps alike in ratio: relative errors against
/// Table 9's, mean over the modes of a column.
fn mean_differences(changes: fn(f64, f64) -> f64) -> Vec<f64> {
    let case = Case::new(PUBLISHED_CASE).expect("a case");
    let model = case
        .model()
        .expect("a model")
        .matrices(&[1.0; 15])
        .expect("an analysis");
    let (gages, frequencies) = (
        PublishedTable::number(11).expect("Table 11"),
        PublishedTable::number(9).expect("Table 9"),
    );
    let of_column = |analysis_modes: usize| {
        let steps = gages
            .required("iterations", &format!("fem_{analysis_modes}_percent"))
            .expect("printed");
        let mut stiffness = model.stiffness.clone();
        for (panel, share) in case.panels.iter().zip(&model.shares) {
            let gage = gages
                .required(
                    &panel.label.to_string(),
                    &format!("fem_{analysis_modes}_in"),
                )
                .expect("printed");
            stiffness += (changes(gage / panel.gage, steps) - 1.0) * share.matrix();
        }
        // In the modes that the run was given.
        let first = solve(&model.stiffness, &model.mass, analysis_modes).expect("modes");
        let reduced = first.shapes().transpose() * stiffness * first.shapes();
        let identity = DMatrix::identity(analysis_modes, analysis_modes);
        let found = solve(&reduced, &identity, analysis_modes)
            .expect("modes")
            .frequencies_hz();
        let printed = |mode: usize| {
            frequencies.value(&(mode + 1).to_string(), &format!("fem_{analysis_modes}_hz"))
        };
        let differences = found
            .iter()
            .enumerate()
            .map(|(mode, hz)| hz / printed(mode).expect("printed") - 1.0);
        differences.sum::<f64>() / analysis_modes as f64
    };
    [5, 7, 9].map(of_column).into()
}

#[test]
fn printed_frequencies_are_those_of_changes_that_add() {
    // No rule of the step enters: gages of Table 11 against the 21 frequencies of Table 9.
    let multiplied = mean_differences(|ratio, _| ratio);
    let added = mean_differences(|ratio, steps| 1.0 + steps * (ratio.powf(1.0 / steps) - 1.0));
    assert!(
        multiplied.iter().all(|mean| (0.025..0.030).contains(mean)),
        "{multiplied:?}"
    );
    assert!(added.iter().all(|mean| mean.abs() < 0.0075), "{added:?}");
}

#[test]
fn table_of_readings_is_the_stored_one() {
    let detections = READINGS.map(|reading| detection(&the_box(), reading).expect("it runs"));
    let found = csv(&readings_tables(&COLUMNS, &detections).expect("tables"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("paper/readings.csv");
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "1") {
        std::fs::write(&path, &found).expect("written");
    }
    let stored = std::fs::read_to_string(&path).expect("paper/readings.csv");
    let numbers = Numbers::BY_UNIT;
    assert!(
        numbers.agree(&found, &stored),
        "paper/readings.csv has other numbers: write it again"
    );
}

/// The run of a case is the column of its own reading.
#[test]
fn a_case_is_its_column() {
    for number in [1, 2, 3] {
        let case = Case::new(number).expect("a case");
        let columns = columns_of(&run_case(&case, |_, _| {}).expect("it runs")).expect("columns");
        let expected: Vec<ReadingColumn> = of(case.settings.inner.step, 2 * number + 2)
            .into_iter()
            .cloned()
            .collect();
        assert_eq!(columns.len(), expected.len());
        for (found, expected) in columns.iter().zip(&expected) {
            assert_eq!(
                (&found.gages_in, found.iterations),
                (&expected.gages_in, expected.iterations)
            );
        }
    }
    assert_eq!(
        columns_of(&run_case(&Case::new(4).expect("a case"), |_, _| {}).expect("it runs"))
            .expect("none"),
        []
    );
}

/// A box with coordinates off by up to 12 % and masses by up to 30 %.
fn other_box() -> impl Strategy<Value = Reconstruction> {
    (
        prop::collection::vec(-0.12..0.12_f64, 8 * 3),
        prop::collection::vec(-0.3..0.3_f64, 9),
    )
        .prop_map(|(places, masses)| {
            let mut other = the_box();
            // Upper and lower grids move alike, so that no panel is turned over.
            for (grid, position) in &mut other.grids {
                for (axis, value) in position.iter_mut().enumerate() {
                    *value *= 1.0 + places[3 * ((grid - 1) / 2) + axis];
                }
            }
            other
                .masses
                .iter_mut()
                .zip(masses)
                .for_each(|(mass, off)| *mass *= 1.0 + off);
            other
        })
}

/// The evidence does not hang on this box: on others like it the relative change stays nearer to the print than own.
#[test]
#[ignore = "minutes: two cases by two readings on 20 boxes"]
fn on_other_boxes_the_relative_change_is_nearer_to_the_print_too() {
    let config = Config {
        rng_algorithm: RngAlgorithm::ChaCha,
        rng_seed: RngSeed::Fixed(12),
        ..Config::default()
    };
    let mut runner = TestRunner::new(config);
    let (mut boxes, mut nearer, mut alike, mut nearer_in_both) = (0, [0, 0], [0, 0], 0);
    while boxes < 20 {
        let other = other_box().new_tree(&mut runner).expect("a box").current();
        // Mean over the passes of correlation and difference.
        let means = |number: usize, reading| {
            let result = run_by_reading(
                &Case::from_reconstruction(number, other.clone()).ok()?,
                reading,
            )
            .ok()?;
            let columns = columns_of(&result).ok()?;
            let mean = |of: fn(&ReadingColumn) -> f64| {
                columns.iter().map(of).sum::<f64>() / columns.len() as f64
            };
            Some([
                mean(ReadingColumn::correlation),
                mean(ReadingColumn::difference),
            ])
        };
        let of = |number| {
            Some([
                means(number, StepRule::Relative)?,
                means(number, StepRule::Diagonal)?,
            ])
        };
        // A box that cannot be run by both readings says nothing about either.
        let (Some(second), Some(third)) = (of(2), of(3)) else {
            continue;
        };
        boxes += 1;
        println!("box {boxes}: Case 2 {second:.3?}, Case 3 {third:.3?}");
        for (row, [relative, own]) in [second, third].into_iter().enumerate() {
            alike[row] += i32::from(relative[0] > own[0]);
            nearer[row] += i32::from(relative[1] < own[1]);
        }
        // Case 2 has two columns and Case 3 three.
        let all = |reading: usize| 2.0 * second[reading][1] + 3.0 * third[reading][1];
        nearer_in_both += i32::from(all(0) < all(1));
    }
    println!("better correlated {alike:?}, nearer {nearer:?}, over both cases {nearer_in_both}");
    assert_eq!((alike, nearer, nearer_in_both), ([19, 18], [19, 17], 19));
}

/// Case 4 rests on two close modes of the faulty model: 73.2 and 74.8 Hz.
#[test]
fn case_4_depends_on_two_close_modes() {
    let result = run_case(&Case::new(CASES[3]).expect("a case"), |_, _| {}).expect("it runs");
    let hz = result.correlation.initial.modes.frequencies_hz();
    let close = hz
        .windows(2)
        .min_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])))
        .expect("two modes");
    assert_eq!(
        close
            .iter()
            .map(|hz| format!("{hz:.1}"))
            .collect::<Vec<_>>(),
        ["73.2", "74.8"]
    );
    assert_eq!(result.case.panels[7].gage / TEST_GAGE, 0.01);
    // The factor with a fault that is a little more or less: it moves with the distance of the two.
    let factor = |gage: f64| {
        let mut case = result.case.clone();
        case.panels[7].gage = gage;
        let result = run_case(&case, |_, _| {}).expect("it runs");
        let hz = result.correlation.initial.modes.frequencies_hz();
        let apart = hz
            .windows(2)
            .map(|pair| pair[1] / pair[0] - 1.0)
            .fold(f64::INFINITY, f64::min);
        (result.unlimited_factors()[7], apart)
    };
    // Half as thick, a little thicker: the two modes move apart, and the factor falls or even turns its sign.
    let (here, apart) = factor(0.0001);
    assert!((0.021..0.022).contains(&apart) && (58.0..59.0).contains(&here));
    for (gage, range) in [
        (0.00005, -6.1..-6.0),
        (0.0002, 5.5..5.6),
        (0.0004, 3.4..3.5),
        (0.0008, 2.0..2.1),
    ] {
        let (found, apart) = factor(gage);
        assert!(range.contains(&found), "{gage}: {found}");
        assert!(apart > 0.07, "{gage}: {apart}");
    }
}
