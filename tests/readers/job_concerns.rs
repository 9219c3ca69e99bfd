//! What a job's pre-flight says: doubts that name a mistake by sensor, mode or parameter.

use crate::common::jobs::run;
use crate::common::jobs::torque_box;
use crate::prelude::*;
use corfem::job::LoadedJob;
use corfem::job::concern::Grade;

/// The identifiers of a job's doubts.
fn doubts(files: &Files) -> Vec<String> {
    let loaded = prepared(files);
    let trust = trust_in(&loaded);
    let doubts = trust.all().iter().filter(|concern| concern.stands());
    doubts.map(|own| own.identifier.clone()).collect()
}

/// The number of a model's rigid-body modes.
pub fn rigid_bodies(prepared: &PreparedJob) -> usize {
    let bodies = prepared.loaded.source.whole.rigid_bodies();
    bodies.unwrap().rigid()
}

/// A building of ten stories, and its test after an edit.
pub fn tested(edit: impl FnOnce(&mut TestData)) -> Files {
    retested(measured_building(10, 4), edit)
}

#[test]
fn a_right_job_has_no_doubt() {
    assert_eq!(doubts(&tested(|_| {})), [""; 0]);
}

#[test]
fn a_mistake_in_a_sensor_is_named_by_the_sensors_name() {
    let reversed = tested(|data| {
        data.sensors[4].name = "S505".to_owned();
        data.shapes.row_mut(4).neg_mut();
    });
    assert_eq!(doubts(&reversed), ["reversed-S505"]);
    let twice = tested(|data| data.shapes.row_mut(4).scale_mut(2.0));
    assert_eq!(doubts(&twice), ["gain-5"]);
    let exchanged = tested(|data| data.shapes.swap_rows(2, 6));
    assert_eq!(doubts(&exchanged), ["exchanged-3-7"]);
}

#[test]
fn gross_mistakes_are_named_before_anything_fails() {
    let thousandfold = tested(|data| data.shapes.row_mut(4).scale_mut(1000.0));
    assert_eq!(doubts(&thousandfold), ["gain-5"]);
    // Of a test in which no mode has a partner nothing is corrected, and the program says what looks wrong.
    let drowned = tested(|data| data.shapes.row_mut(4).scale_mut(1e5));
    let told = answered(&drowned);
    assert_eq!((told.status, told.doubts), (3, vec!["gain-5".to_owned()]));
    let (_folder, path) = placed(&drowned);
    let loaded = prepare(&path).unwrap();
    let error = run(&loaded, |_| {}, || true)
        .expect_err("refused")
        .to_string();
    assert!(
        error.contains("no mode of the model is like a test mode"),
        "{error}"
    );
}

/// Shapes of no structure: whatever else is found, something is, and a correlation is refused.
#[test]
fn a_test_of_which_no_mode_resembles_one_of_the_model_is_doubtful() {
    let mut draws = Draws(26);
    let mut left = 0;
    for _ in 0..20 {
        let unlike = tested(|data| {
            data.shapes
                .apply(|reading| *reading = draws.between(-1.0, 1.0))
        });
        let loaded = prepared(&unlike);
        if loaded.modes.len() < loaded.loaded.data.frequencies_hz.len() {
            continue;
        }
        let found = doubts(&unlike);
        assert!(!found.is_empty());
        left += usize::from(found == ["no-pair"]);
    }
    assert!(left > 0);
}

/// Of four test modes two resemble none of the model: as many as are compared. A single floor moves in no mode of ten by more than
/// a fifth of the square of its shape.
#[test]
fn a_test_half_of_whose_modes_have_partners_is_correlated_with_these() {
    let half = tested(|data| {
        for (mode, floor) in [(2, 0), (3, 5)] {
            data.shapes.column_mut(mode).fill(0.0);
            data.shapes[(floor, mode)] = 1.0;
        }
    });
    let loaded = prepared(&half);
    assert_eq!((loaded.modes.len(), loaded.unpaired.len()), (2, 2));
    let result = finished(&loaded);
    let left = result
        .trust
        .all()
        .iter()
        .filter(|left| left.grade == Grade::LeftOut);
    let left = left.map(|left| &left.identifier[..]).collect_vec();
    assert_eq!(left, ["not-compared-3", "not-compared-4"]);
}

#[test]
fn a_matrix_that_is_no_part_of_the_first_model_is_named() {
    let files = measured_building(10, 4);
    let ten_times = with(
        files.clone(),
        "job.toml",
        "matrix = \"stiffness.mtx\"",
        "matrix = \"more.mtx\"",
    );
    let stiffness = files[1].1.clone();
    let more = |factor: f64| {
        let mut lines = stiffness.lines();
        let mut text = lines.by_ref().take(2).map(str::to_owned).collect_vec();
        for line in lines {
            let (place, value) = line.rsplit_once(' ').unwrap();
            let value: f64 = value.parse().unwrap();
            text.push(format!("{place} {:.6e}", factor * value));
        }
        ("more.mtx".to_owned(), text.join("\n") + "\n")
    };
    let job = |factor: f64| [ten_times.clone(), vec![more(factor)]].concat();
    assert_eq!(doubts(&job(10.0)), ["not-part-all"]);
    assert_eq!(doubts(&job(1.001)), ["not-part-all"]);
    // With the seven digits that are written it still is a part.
    assert_eq!(doubts(&job(1.0 + 5e-8)), [""; 0]);
    assert_eq!(doubts(&job(0.5)), [""; 0]);
    let again = |matrix: &str| {
        let all = "matrix = \"stiffness.mtx\"";
        let twice = format!("{all}\n[[parameter]]\nname = \"again\"\nmatrix = \"{matrix}\"");
        with(files.clone(), "job.toml", all, &twice)
    };
    let of_opposite_sign = [again("more.mtx"), vec![more(-1.0)]].concat();
    assert_eq!(doubts(&of_opposite_sign), ["negative-again"]);
}

/// Two floors on a ground of two units of the last of thirteen digits, half of one for each floor.
pub const HARDLY_HELD: &str = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 100000.0000001\n2 1 -1e5\n2 2 1e5\n";

/// The doubts and remarks of motions that are free by digits, of floors with this stiffness and these lines of the job, each with the
/// suspension that would not show, and how many are free.
fn free(stiffness: &str, lines: &str) -> (Vec<(bool, String)>, usize) {
    let rows = stiffness.split_whitespace().nth(5).unwrap();
    let mut files = measured_building(rows.parse().unwrap(), 1);
    files[1].1 = stiffness.to_owned();
    files[0].1 = files[0]
        .1
        .replacen("[test]", &format!("{lines}\n[test]"), 1);
    let loaded = prepared(&files);
    let trust = trust_in(&loaded);
    let all = trust.all().iter();
    let all = all.filter(|concern| concern.identifier == "free-by-digits");
    let hertz = |words: &str| words.split_once("below ").unwrap().1[..4].to_owned();
    let all = all.map(|concern| (concern.stands(), hertz(&concern.words)));
    (all.collect(), rigid_bodies(&loaded))
}

/// Half of the last digit of two numbers a row, 1e-7 each, holds two floors of 60 each by $\omega^2$ = 2e-7/120; doubles have 1.3e-9 a row. A
/// second pair of floors is held by twenty times as much: thirty times the rounding would free it, and the first is taken as held, with a doubt.
#[test]
fn a_resistance_that_rounding_may_be_counts_as_none_and_is_named() {
    let said = |stands, hertz: &str| vec![(stands, hertz.to_owned())];
    let remark = said(false, "6e-6");
    assert_eq!(free(HARDLY_HELD, ""), (remark.clone(), 1));
    let pair = |held: &str| {
        let second = format!("3 3 100000.0000{held}\n4 3 -1e5\n4 4 1e5\n");
        HARDLY_HELD.replacen("2 2 3", "4 4 6", 1) + &second
    };
    assert_eq!(free(&pair("020"), ""), (said(true, "6e-6"), 0));
    assert_eq!(free(&pair("200"), ""), (remark, 1));
    // Somebody says it.
    assert_eq!(free(HARDLY_HELD, "rigid_bodies = 1"), (Vec::new(), 1));
    assert_eq!(free(HARDLY_HELD, "rigid_bodies = 0"), (Vec::new(), 0));
    // Of the part that is measured too.
    let part = "rigid_bodies = 0\n[sensors]\nleave_out = [\"3\", \"4\"]";
    assert_eq!(free(&pair("200"), part), (Vec::new(), 0));
    // Five units of the last digit are no rounding, and numbers of one digit are exact.
    let held = HARDLY_HELD.replace("0000001", "0000005");
    assert_eq!(free(&held, ""), (Vec::new(), 0));
    let exact = HARDLY_HELD.replace(".0000001", "");
    assert_eq!(free(&exact, ""), (said(false, "7e-7"), 1));
}

#[test]
fn more_rigid_bodies_than_the_digits_allow_are_refused_by_key_and_value() {
    let files = measured_building(2, 1);
    let two = with(
        files.clone(),
        "job.toml",
        "[test]",
        "rigid_bodies = 2\n[test]",
    );
    let said = crate::common::jobs::said(&two);
    assert!(
        said.contains(
            "model.rigid_bodies is 2, but the digits of a double of model.stiffness leave at most 0"
        ),
        "{said}"
    );
    let mut negative = files;
    negative[1].1 = HARDLY_HELD.replace("100000.0000001", "99999.123456");
    let said = crate::common::jobs::said(&negative);
    let expected = "model.stiffness has negative energy in a motion of ";
    assert!(
        said.contains(expected) && said.contains("more than 11 digits explain"),
        "{said}"
    );
}

/// Of thirty tests whose deviations were written in percent, from five percent of a shape on, all.
#[test]
fn deviations_in_percent_are_named_in_every_test() {
    let mut draws = Draws(5);
    for test in 0..30 {
        let [frequency, shape] = [draws.between(0.05, 0.5), draws.between(5.0, 15.0)];
        let with = |unit: f64| {
            tested(|data| {
                data.frequency_deviation = Some(vec![unit * frequency; 4]);
                data.shape_deviation = Some(vec![unit * shape; 4]);
            })
        };
        let named = doubts(&with(1.0));
        assert!(
            named.contains(&"percent-shape_deviation".to_owned()),
            "test {test}: {named:?}"
        );
        assert_eq!(doubts(&with(0.01)), [""; 0], "test {test}");
    }
}

/// Of thirty choices of at least three of the nine sensors, all with coordinates 25.4 times too large, and none that is right.
#[test]
fn places_in_another_unit_are_named_wherever_the_sensors_are() {
    let mut draws = Draws(6);
    let loaded = prepared(&torque_box()).loaded;
    for test in 0..30 {
        let mut few = LoadedJob::clone(&loaded);
        while few.placed.len() > 3 && draws.unit() < 0.8 {
            few.placed.remove(draws.below(few.placed.len()));
        }
        let mut named = [false; 2];
        for (named, unit) in named.iter_mut().zip([25.4, 1.0]) {
            let mut other = few.clone();
            for sensor in &mut other.placed {
                sensor.distance = Some(0.0);
                let place = other.source.places.get(&sensor.grid);
                other.data.sensors[sensor.row].place = place.map(|place| unit * place);
            }
            *named = other
                .places_concerns()
                .iter()
                .any(|concern| concern.identifier == "unit-of-places");
        }
        assert_eq!(named, [true, false], "test {test}");
    }
}
