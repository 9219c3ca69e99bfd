//! Where to measure next: the deviations that are told of a test with one sensor more or less are those of that test with the noise of this one.

use crate::common::jobs::{Files, building, loaded, of_matrices, of_whole, run};
use crate::common::tolerances::{MEASURED_NEXT, THREE_DIGITS};
use crate::prelude::*;
use corfem::job::{NextMeasurement, mean_deviation};

/// A job that compares modes by itself, one whose frequencies are so uncertain that they are compared together, one whose components have
/// deviations of their own, and a building so high that the modes at hand are few of it.
fn subjects() -> Vec<(&'static str, Files)> {
    let together = |data: &mut TestData| data.frequency_deviation = Some(vec![0.3; 5]);
    let own = |data: &mut TestData| {
        let deviations = DVector::from_fn(5, |row, _| 0.01 + 0.005 * row as f64);
        data.component_deviation = (0..5).map(|mode| (mode, deviations.clone())).collect();
    };
    let tall = shear_building(&[1e5; 30], 60.0, None);
    let tall = of_whole(&tall, &[0.9; 30], &[2, 9, 14, 20, 28], 5, Noise::USUAL);
    vec![
        ("by itself", building()),
        ("together", retested(building(), together)),
        ("own deviations", retested(building(), own)),
        ("tall", tall),
    ]
}

/// Deviations of the factors' logarithms at the first model of a job.
fn deviations(files: &Files) -> Vec<f64> {
    let result = run(&prepared(files), |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
    result.seen_first.deviations
}

/// The first model's modes as the sensors of a job read them.
fn seen(files: &Files) -> (Vec<f64>, DMatrix<f64>) {
    let job = prepared(files);
    let count = job.loaded.parameter_names().count();
    let comparison = job.analyze(&vec![1.0; count]).unwrap();
    let model = comparison.model();
    let hertz = model
        .exact()
        .modes
        .omega_squared()
        .iter()
        .map(|root| root.sqrt() / TAU);
    (hertz.collect(), model.basis().clone())
}

/// A job whose test has one more sensor, which reads what the model says of the test.
fn with_sensor(files: &Files, grid: usize) -> Files {
    let add = |data: &mut TestData, readings: &DVector<f64>| {
        let row = data.shapes.nrows();
        let mut sensor = data.sensors[0].clone();
        (sensor.name, sensor.grid, sensor.place) = (format!("new {grid}"), Some(grid), None);
        data.sensors.push(sensor);
        data.shapes = data.shapes.clone().insert_row(row, 0.0);
        data.shapes.set_row(row, &readings.transpose());
        for (mode, own) in &mut data.component_deviation {
            let mean = (own.norm_squared() / own.len() as f64).sqrt();
            assert!(*mode < 5);
            *own = own.clone().insert_row(row, mean);
        }
    };
    let blank = retested(files.clone(), |data| add(data, &DVector::zeros(5)));
    let (groups, (_, read)) = (prepared(files).together.clone(), seen(&blank));
    retested(files.clone(), |data| {
        let old = data.shapes.clone();
        let readings = (0..5).map(|j| {
            // Modes compared together have one combination for each shape.
            let group = groups.iter().find(|group| group.contains(&j));
            let own = group.cloned().unwrap_or(vec![j]);
            let all = read.select_columns(&own);
            let weights = data
                .component_deviation
                .get(&j)
                .map(|own| own.map(f64::recip));
            let weights = weights.unwrap_or(DVector::from_element(5, 1.0));
            let left = DMatrix::from_diagonal(&weights) * all.rows(0, 5);
            let right = weights.component_mul(&old.column(j));
            let shares = left.svd(true, true).solve(&right, 1e-12).unwrap();
            (all.row(5) * shares)[0]
        });
        let readings = DVector::from_iterator(5, readings);
        add(data, &readings);
    })
}

/// Words of a change without those before its name.
fn number(words: &str, before: &str) -> usize {
    let rest = words
        .strip_prefix(before)
        .unwrap_or_else(|| panic!("{words}"));
    rest.split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn deviations_told_are_those_of_a_job_with_that_sensor() {
    for (name, files) in subjects() {
        let next = prepared(&files).next_measurement().unwrap();
        let [now, more, less] = &next.changes;
        assert_close(&now[0].1, &deviations(&files), MEASURED_NEXT, name);
        assert_eq!(less.len(), 5, "{name}");
        assert!(more.len() >= 5, "{name}");
        for (words, told) in more.iter().take(3) {
            let with = with_sensor(&files, number(words, "with grid "));
            let shapes = &prepared(&with).loaded.data.shapes;
            // A job's noise is a part of its largest reading.
            if shapes.column_iter().all(|shape| shape.icamax() < 5) {
                assert_close(told, &deviations(&with), MEASURED_NEXT, words);
            }
        }
    }
}

fn assert_close(told: &[f64], right: &[f64], tolerance: f64, what: &str) {
    assert_eq!(told.len(), right.len(), "{what}");
    for (told, right) in told.iter().zip(right) {
        assert!(
            (told / right - 1.0).abs() < tolerance,
            "{what}: {told} {right}"
        );
    }
}

#[test]
fn changes_of_a_kind_come_with_the_least_deviation_first() {
    for (name, files) in subjects() {
        let next = prepared(&files).next_measurement().unwrap();
        for changes in &next.changes {
            let all = changes
                .iter()
                .map(|(_, own)| mean_deviation(own))
                .collect_vec();
            assert!(all.is_sorted(), "{name}: {all:?}");
        }
    }
}

#[test]
fn one_more_reading_never_tells_less() {
    for (name, files) in subjects() {
        let [now, more, less] = prepared(&files).next_measurement().unwrap().changes;
        let is_no_more = |own: &[f64], than: &[f64]| {
            let mut both = own.iter().zip(than);
            both.all(|(own, than)| *own <= than * (1.0 + ROUND_OFF))
        };
        assert!(
            more.iter().all(|own| is_no_more(&own.1, &now[0].1)),
            "{name}"
        );
        assert!(
            less.iter().all(|own| is_no_more(&now[0].1, &own.1)),
            "{name}"
        );
    }
}

/// From the roof on, the example measures the floor that ranks first, four times; no exchange of one is better.
#[test]
fn the_example_building_measures_the_floors_that_are_recommended() {
    let model = shear_building(&[1e5; 10], 60.0, None);
    let (shape, frequency) = (0.02, 0.005);
    let assumed = Noise { shape, frequency };
    let next = |floors: &BTreeSet<usize>| {
        let rows = floors.iter().map(|floor| floor - 1).collect_vec();
        let files = of_whole(&model, &STORIES, &rows, 5, assumed);
        prepared(&files).next_measurement().unwrap()
    };
    let left = |own: &NextMeasurement, change: usize| mean_deviation(&own.changes[change][0].1);
    let mut floors = BTreeSet::from([10]);
    while floors.len() < 5 {
        floors.insert(number(&next(&floors).changes[1][0].0, "with grid "));
    }
    let example = prepared(&building());
    let measured = example.loaded.data.sensors.iter();
    let measured: BTreeSet<usize> = measured.filter_map(|own| own.grid).collect();
    assert_eq!(measured, floors);
    let own = example.next_measurement().unwrap();
    for floor in &floors {
        for other in (1..=10).filter(|other| !floors.contains(other)) {
            let mut exchanged = floors.clone();
            exchanged.remove(floor);
            exchanged.insert(other);
            assert!(left(&next(&exchanged), 0) > left(&own, 0), "{exchanged:?}");
        }
    }
    assert_eq!(own.changes[1][0].0, "with grid 6 x");
    let even = next(&BTreeSet::from([2, 4, 6, 8, 10]));
    let told = [
        (left(&own, 0), 2.44),
        (left(&own, 1), 2.20),
        (left(&even, 0), 4.18),
    ];
    for (left, percent) in told {
        assert!((100.0 * left - percent).abs() < THREE_DIGITS, "{left}");
    }
    assert!(own.unranked.is_empty());
}

/// A star of three arms on a spring, two of them alike and without a sensor: where one moves against the other nothing else does.
fn star() -> Files {
    let spring = |a, b, k| springs(7, &[(a, b, k)]).dense();
    let alike = spring(3, Some(0), 3e4)
        + spring(4, Some(3), 2e4)
        + spring(5, Some(0), 3e4)
        + spring(6, Some(5), 2e4);
    let other = spring(1, Some(0), 5e4) + spring(2, Some(1), 4e4);
    let (parts, mass) = ([spring(0, None, 1e5), other, alike], eye(7));
    let all = solve(&parts.iter().sum(), &mass, 7).unwrap();
    let is_seen =
        |mode: &usize| (all.shapes()[(4, *mode)] - all.shapes()[(6, *mode)]).abs() < ROUND_OFF;
    let seen: Vec<usize> = (0..7).filter(is_seen).take(3).collect();
    let squares = DVector::from_iterator(3, seen.iter().map(|&mode| all.omega_squared()[mode]));
    let modes = Modes::new(squares, all.shapes().select_columns(&seen)).unwrap();
    let leave_out = "[sensors]\nleave_out = [\"S4\", \"S5\", \"S6\", \"S7\"]\n[[parameter]]";
    with(
        of_matrices(&parts, &mass, &modes),
        "job.toml",
        "[[parameter]]",
        leave_out,
    )
}

#[test]
fn places_that_would_see_other_modes_are_counted_and_not_ranked() {
    let next = prepared(&star()).next_measurement().unwrap();
    assert_eq!(next.changes[1].len(), 0);
    assert_eq!(next.unranked.len(), 1);
    assert!(
        next.unranked[0].starts_with("Not ranked: 4 places"),
        "{:?}",
        next.unranked
    );
}

/// Two masses on springs of their own: without its sensor neither has a shape.
#[test]
fn a_sensor_that_sees_a_mode_alone_is_not_left_out() {
    let parts = [diagonal([1e4, 0.0]), diagonal([0.0, 4e4])];
    let modes = Modes::new(dvector![1e4, 4e4], eye(2)).unwrap();
    let next = prepared(&of_matrices(&parts, &eye(2), &modes));
    let next = next.next_measurement().unwrap();
    assert_eq!(next.changes[2].len(), 0);
    let alone = "Not ranked: 2 sensors that see a test mode alone.";
    assert_eq!(next.unranked, [alone]);
}

#[test]
fn a_job_without_shapes_says_that_nothing_is_ranked() {
    let next = loaded("garteur").next_measurement().unwrap();
    assert!(next.changes.iter().all(Vec::is_empty));
    assert_eq!(next.unranked.len(), 1);
}

/// What a look costs grows with the cube of the parameters, so that of many places a part is looked at, which is said.
#[test]
fn of_too_many_places_and_sensors_a_part_is_looked_at() {
    let tall = shear_building(&[1e6; 250], 60.0, None);
    let measured = (0..60).map(|place| 4 * place + 2).collect_vec();
    let files = of_whole(&tall, &[0.9; 250], &measured, 5, Noise::USUAL);
    let next = prepared(&files).next_measurement().unwrap();
    let told = next.unranked.iter().map(|own| &own[..30]).collect_vec();
    assert_eq!(
        told,
        [
            "Of 190 places one in 28 was lo",
            "Of 60 sensors one in 9 was loo"
        ]
    );
    assert_eq!(next.changes[2].len(), 7);
}
