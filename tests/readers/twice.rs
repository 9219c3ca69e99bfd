//! A datum that is given twice agrees, or is doubted: place and grid, numbers and order of modes, unit and factor.

use crate::common::jobs::torque_box;
use crate::prelude::*;

fn about(files: &Files, identifier: &str) -> Vec<Vec<String>> {
    let loaded = prepared(files);
    let trust = trust_in(&loaded);
    let all = trust
        .all()
        .iter()
        .filter(|own| own.identifier.starts_with(identifier));
    all.map(|own| own.about.clone()).collect()
}

/// A job whose sensors are at other places.
pub fn with_places(files: Files, edit: impl FnOnce(&mut Vec<Vector3<f64>>)) -> Files {
    retested(files, |data| {
        let places = data.sensors.iter();
        let mut places = places.map(|own| own.place.unwrap()).collect_vec();
        edit(&mut places);
        for (sensor, place) in data.sensors.iter_mut().zip(places) {
            sensor.place = Some(place);
        }
    })
}

/// A building whose test is a Universal File, after an edit of its text.
fn in_universal(edit: impl FnOnce(String) -> String) -> Files {
    let mut files = measured_building(10, 4);
    let (name, text) = files.last_mut().unwrap();
    let data = test_data::read("test.csv", text.as_bytes()).unwrap();
    *text = edit(write_universal(&data));
    *name = "test.unv".to_owned();
    files[0].1 = files[0].1.replace("test.csv", "test.unv");
    files
}

/// The same with other numbers of its modes.
pub fn numbered(numbers: [usize; 4]) -> Files {
    in_universal(|text| {
        let own = |number: usize| format!("{:10}{:10}{:10}{number:10}\n", 2, 4, 0);
        let mut parts = text.split(&own(1)).map(str::to_owned).collect_vec();
        for number in 2..=4 {
            let last = parts.pop().unwrap();
            let cut = last.split_once(&own(number)).unwrap();
            parts.extend([cut.0.to_owned(), cut.1.to_owned()]);
        }
        let mut whole = parts[0].clone();
        for (number, part) in numbers.iter().zip(&parts[1..]) {
            whole += &(own(*number) + part);
        }
        whole
    })
}

/// The same with a system of units, by code and factor of length.
pub fn universal(code: usize, length: f64) -> Files {
    in_universal(|text| {
        let units = format!("{code:10}{:<20}{:10}\n", "Own", 2);
        let factors = format!("{length:25.17E}{:25.17E}{:25.17E}\n", 1.0, 1.0);
        format!("    -1\n   164\n{units}{factors}    -1\n{text}")
    })
}

/// Two places exchanged are those of other grids; places a little off are not.
#[test]
fn a_place_that_is_another_grids_is_doubted() {
    for (one, other) in [(0, 1), (2, 7), (3, 8)] {
        let exchanged = with_places(torque_box(), |places| places.swap(one, other));
        let named = [one, other].map(|place| format!("D{}", place + 1));
        assert_eq!(about(&exchanged, "other-grid"), [named]);
        // Somebody who says how far a sensor may be answers for it.
        let mut told = exchanged;
        told[0].1 = told[0]
            .1
            .replace("[test]", "[sensors]\ndistance = 1e6\n[test]");
        assert_eq!(about(&told, "other-grid"), [[""; 0]; 0]);
    }
    let near = with_places(torque_box(), |places| {
        places
            .iter_mut()
            .for_each(|place| *place += Vector3::new(0.02, -0.01, 0.03));
    });
    assert_eq!(about(&near, "other-grid"), [[""; 0]; 0]);
    assert_eq!(about(&torque_box(), "other-grid"), [[""; 0]; 0]);
}

#[test]
fn numbers_of_modes_in_another_order_are_doubted() {
    let none = [[""; 0]; 0];
    assert_eq!(about(&numbered([1, 2, 3, 4]), "numbered-otherwise"), none);
    let other = numbered([2, 1, 3, 4]);
    assert_eq!(about(&other, "numbered-otherwise"), [["2", "1", "3", "4"]]);
    // A part of a test keeps its numbers; who chooses modes by number may mean either.
    let part = numbered([3, 5, 6, 9]);
    assert_eq!(about(&part, "numbered-otherwise"), none);
    let mut chosen = part;
    chosen[0].1 = chosen[0]
        .1
        .replace("\"test.unv\"", "\"test.unv\"\nmodes = [1, 3]");
    assert_eq!(about(&chosen, "numbered-otherwise"), [["3", "5", "6", "9"]]);
    // Numbers that tell nothing apart are none.
    for same in [[1; 4], [0; 4]] {
        assert_eq!(about(&numbered(same), "numbered-otherwise"), none);
    }
}

#[test]
fn a_factor_of_length_that_is_another_units_is_doubted() {
    let none = [[""; 0]; 0];
    let systems = [
        (1, 1.0),
        (2, 3.28084),
        (3, 1.0),
        (4, 3.28084),
        (5, 1000.0),
        (6, 100.0),
        (7, 39.37),
        (7, 39.3701),
        (8, 1000.0),
        (10, 1000.0),
    ];
    for (code, length) in systems {
        assert_eq!(
            about(&universal(code, length), "units-disagree"),
            none,
            "{code}"
        );
        let other = universal(code, 25.4 * length);
        assert_eq!(about(&other, "units-disagree"), [["Own"]], "{code}");
    }
    assert_eq!(about(&universal(9, 12.0), "units-disagree"), none);
}
