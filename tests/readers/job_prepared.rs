//! What a job is prepared to: how many modes of the model, which mass at the sensors, and what the sensors measure.

use super::test_data_axes::{PART, matrix, row};
use super::test_data_universal::{dataset, real_mode};
use crate::common::jobs::said;
use crate::prelude::*;

#[test]
fn a_job_without_a_title_is_called_by_its_file() {
    assert_eq!(prepared(&rods()).loaded.title, "job");
    assert_eq!(prepared(&building()).loaded.title, "ten-story building");
}

/// Half as many again as test modes, four more at least, and no more than there are.
#[test]
fn more_modes_of_the_model_are_taken_than_the_test_has() {
    for (stories, modes, expected) in [(16, 10, 15), (16, 5, 9), (6, 5, 6)] {
        assert_eq!(
            prepared(&measured_building(stories, modes)).analysis_modes,
            expected,
            "{modes} of {stories}"
        );
    }
}

/// A mass that hangs free on a spring from nothing has a rigid-body motion alone.
#[test]
fn a_model_without_a_vibration_has_no_modes_to_take() {
    let mut files = measured_building(2, 2);
    files[1].1 =
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1e4\n2 1 -1e4\n2 2 1e4\n"
            .to_owned();
    files[2].1 = "%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 1 60\n".to_owned();
    assert_eq!(
        said(&files),
        "modes of finite frequency: 2 given or asked for; there must be 1 to 0"
    );
}

/// A model is compared with the test modes as they were measured, of another scale and of no other sign.
#[test]
fn test_modes_keep_the_sense_in_which_they_were_measured() {
    let prepared = prepared(&rods());
    let model = prepared.analyze(&[1.0, 1.0]).unwrap();
    for (compared, measured) in model
        .model()
        .test()
        .shapes()
        .column_iter()
        .zip(prepared.test.shapes().column_iter())
    {
        assert!(compared.dot(&measured) > 0.0, "{compared} {measured}");
    }
}

#[test]
fn a_minus_before_the_direction_turns_the_sensor() {
    let turned = "[sensors]\nplace = [{ sensor = \"S2\", grid = 2, direction = \"-x\" }]";
    let shapes = |files: &Files| prepared(files).test.shapes().clone();
    let (plain, turned) = (shapes(&rods()), shapes(&rods_with("[sensors]", turned)));
    assert_eq!(plain.row(0), -turned.row(0));
    assert_eq!(plain.rows(1, 2), turned.rows(1, 2));
}

/// Rows that are rotations are found as those that are translations.
#[test]
fn a_sensor_of_rotations_measures_a_rotation() {
    let turned = building().into_iter().map(|(name, text)| match &name[..] {
        "rows.csv" => (name, text.replace(",x,0", ",rx,0")),
        "test.csv" => (name, text.replace(",x,+", ",rx,+")),
        _ => (name, text),
    });
    let (plain, turned) = (prepared(&building()), prepared(&turned.collect()));
    assert!(
        turned
            .loaded
            .placed
            .iter()
            .all(|sensor| sensor.direction == 3)
    );
    assert_eq!(plain.loaded.sensors, turned.loaded.sensors);
}

/// Axes of the test that are oblique to the model's: a sensor sees the part of each motion that is along its own.
#[test]
fn a_sensor_reads_the_part_of_a_motion_along_its_axis() {
    let axes = matrix(
        3,
        0,
        [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, 1.0], [0.0; 3]],
    );
    let node = format!("{:10}{:10}{:10}{:10}", 1, 0, 3, 11) + &row(&[0.0; 3], 13);
    let mode = |values: [f64; 3]| real_mode(&(format!("{:10}\n", 1) + &row(&values, 13)));
    let test = dataset("15", &node)
        + &dataset("2420", &(PART.to_owned() + &axes))
        + &mode([0.6, -0.8, 0.0])
        + &mode([0.8, 0.6, 0.0]);
    let mut files = measured_building(2, 2);
    let diagonal = |a: f64, b: f64| {
        format!("%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 {a}\n2 2 {b}\n")
    };
    (files[1].1, files[2].1) = (diagonal(1e4, 2e4), diagonal(1.0, 1.0));
    (files[3].1, files[4].1) = ("1,x\n1,y\n".to_owned(), test);
    let sensors = prepared(&files).loaded.sensors.dense();
    assert!((sensors - dmatrix![0.6, 0.8; -0.8, 0.6]).amax() < ROUND_OFF);
}

#[test]
fn a_sensor_may_be_as_far_as_its_job_allows_and_is_placed_once() {
    let nearest = rods_with("[sensors]", "[sensors]\nby = \"nearest\"\ndistance = 1.0");
    let far = prepared(&with(nearest, "test.csv", "+,10.0,", "+,11.0,"));
    assert_eq!(
        (far.loaded.placed[0].grid, far.loaded.placed[0].distance),
        (2, Some(1.0))
    );
    let no_number = rods_with("[sensors]", "[sensors]\nby = \"nearest\"\ndistance = nan");
    let no_number = said(&no_number);
    assert_eq!(
        no_number,
        "job.toml: sensor S2: grid 2 is 0.0000 away; sensors.distance allows NaN"
    );
    let place = |grid: usize| format!("{{ sensor = \"S2\", grid = {grid}, direction = \"x\" }}");
    let twice = format!("[sensors]\nplace = [{}, {}]", place(2), place(3));
    let twice = said(&rods_with("[sensors]", &twice));
    assert_eq!(twice, "job.toml: sensors.place: sensor S2 is named twice");
}
