//! The structure with its names, and how modes are drawn on it: crowded, in any plane, and without lines.

use super::subject::chain;
use crate::common::drawings::{Written, words, written};
use crate::paper::figures::mode_shapes;
use crate::paper::figures::structure::draw_structure;
use crate::prelude::*;
use corfem::present::frame::Frame;
use corfem::present::frame::{DrawnMode, DrawnModes};
use corfem::present::report::SensorPoint;

fn at(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// A panel of some size with sensors of these names and places.
fn with_sensors(
    sensors: Vec<(String, Option<Vector3<f64>>)>,
    frame: Vec<Vec<Vector3<f64>>>,
) -> Report {
    let sensor = |(name, place): (String, _)| SensorPoint {
        name,
        place,
        direction: Vector3::z(),
    };
    let sensors = sensors.into_iter().map(sensor).collect();
    Report {
        sensors,
        frame,
        ..chain("rod", &[1.0; 3], |row| {
            (at(row as f64, 0.0, 0.0), Vector3::z())
        })
    }
}

fn drawn(subject: &Report) -> String {
    draw_structure("structure", "Structure", subject).expect("drawn")
}

fn panel(wide: f64, long: f64) -> Vec<Vector3<f64>> {
    vec![
        at(0.0, 0.0, 0.0),
        at(wide, 0.0, 0.0),
        at(wide, long, 0.0),
        at(0.0, long, 0.0),
    ]
}

#[test]
fn names_of_a_crowd_find_room_and_long_ones_stand_in_a_list() {
    let crowd = |row: usize| {
        (
            format!("c{row}"),
            Some(at(0.01 * row as f64, 0.02 * (row % 3) as f64, 0.0)),
        )
    };
    let mut sensors = (0..18).map(crowd).collect_vec();
    sensors.extend((0..4).map(|row| {
        (
            format!("edge {row}"),
            Some(at(2.0, 0.01 * f64::from(row), 0.0)),
        )
    }));
    sensors.extend((0..5).map(|row| (format!("one of five {row}"), Some(at(1.0, 0.5, 0.0)))));
    // Zero has one sign: these two are at one place.
    sensors.extend([-0.0, 0.0].map(|zero| (format!("z{zero}"), Some(at(zero, 1.0, zero)))));
    sensors.extend((0..9).map(|row| {
        (
            format!("where is sensor {row}?"),
            [None, Some(at(f64::NAN, 0.0, 0.0))][row % 2],
        )
    }));
    let mut subject = with_sensors(sensors, vec![panel(2.0, 1.0)]);
    subject.supports = vec![at(2.0, 1.0, 0.0)];
    subject.grids = vec![
        (11, at(2.0, 1.0, 0.0)),
        (12, at(2.0, 0.0, 0.0)),
        (13, at(1.5, 0.5, 0.0)),
    ];
    assert_golden("drawing_structure", &drawn(&subject), Numbers::DRAWN);
    // A line has less than 94 letters: beside a name of 80 there is no room for the words before it.
    let unknown = |long: usize| {
        let sensors = vec![
            ("s".to_owned(), Some(at(0.0, 0.0, 0.0))),
            ("n".repeat(long), None),
        ];
        words(&drawn(&with_sensors(sensors, vec![panel(2.0, 1.0)])))
            .contains(&"place unknown:".to_owned())
    };
    assert!(unknown(80) && !unknown(79));
    // Where there are more than any ring about them has room for, a name stands where the first would.
    let many = (0..110)
        .map(|row| {
            (
                format!("s{row}"),
                Some(at(1.0 + 1e-6 * f64::from(row), 0.5, 0.0)),
            )
        })
        .collect();
    assert_golden(
        "drawing_structure_full",
        &drawn(&with_sensors(many, vec![panel(2.0, 1.0)])),
        Numbers::DRAWN,
    );
}

#[test]
fn a_plane_is_drawn_as_it_is_and_says_where_its_axes_go() {
    let turned = |turn: fn(f64, f64) -> Vector3<f64>, long: f64| {
        let corners = vec![
            turn(0.0, 0.0),
            turn(1e3, 0.0),
            turn(1e3, long),
            turn(0.0, long),
        ];
        words(&drawn(&with_sensors(
            vec![("s".to_owned(), Some(corners[0]))],
            vec![corners],
        )))
        .remove(2)
    };
    assert_eq!(turned(|a, b| at(a, b, 0.0), 500.0), "x right, y up");
    assert_eq!(
        turned(|a, b| at(a, b, 0.0), 1e3),
        "x right, y up",
        "a square too"
    );
    assert_eq!(turned(|a, b| at(b, a, 0.0), 500.0), "x down, y right");
    assert_eq!(turned(|a, b| at(a, 0.0, b), 500.0), "x right, z up");
    assert_eq!(turned(|a, b| at(0.0, a, b), 500.0), "y right, z up");
    // A hundred-millionth of its length is round-off, and no depth.
    assert_eq!(
        turned(|a, b| at(a, b, 1e-8 * (a + b)), 500.0),
        "x right, y up"
    );
    let solid = |depth: f64| {
        let corners = vec![
            at(0.0, 0.0, 0.0),
            at(1e3, 0.0, 0.0),
            at(1e3, 1e3, depth),
            at(0.0, 1e3, depth),
        ];
        words(&drawn(&with_sensors(
            vec![("s".to_owned(), Some(corners[0]))],
            vec![corners],
        )))
        .remove(2)
    };
    let axes = "x right and down, y right and up, z up";
    assert_eq!(solid(500.0), axes);
    assert_eq!(solid(100.0), format!("{axes}; depth drawn 3 times"));
    assert_eq!(solid(0.01), format!("{axes}; depth drawn 7 times"));
    let small = panel(0.01, 0.01)
        .into_iter()
        .enumerate()
        .map(|(row, place)| place + at(0.0, 0.0, 4.5e-5 * (row / 2) as f64));
    let small = small.collect_vec();
    let said = words(&drawn(&with_sensors(
        vec![("s".to_owned(), Some(small[0]))],
        vec![small],
    )));
    assert_eq!(
        said[2],
        format!("{axes}; depth drawn 7 times"),
        "a structure of any unit"
    );
}

#[test]
fn a_structure_without_grids_has_none_in_its_legend() {
    let mut subject = with_sensors(
        vec![("s".to_owned(), Some(at(0.0, 0.0, 0.0)))],
        vec![panel(2.0, 1.0)],
    );
    assert_eq!(words(&drawn(&subject))[1..3], ["sensor", "x right, y up"]);
    subject.grids = vec![(1, at(0.0, 0.0, 0.0))];
    subject.supports = vec![at(2.0, 0.0, 0.0)];
    assert_eq!(words(&drawn(&subject))[1..4], ["sensor", "held", "grid"]);
}

#[test]
fn names_at_the_corners_stay_on_the_page_and_off_the_legend() {
    let corners = panel(2.0, 1.0);
    let near = |row: usize| corners[row % 4] + at(1e-3 * (row / 4) as f64, 0.0, 0.0);
    let sensors = (0..40)
        .map(|row| (format!("edge {row:03}"), Some(near(row))))
        .collect();
    let svg = drawn(&with_sensors(sensors, vec![corners.clone()]));
    let names = written(&svg)
        .into_iter()
        .filter(|word| word.text.starts_with("edge"))
        .collect_vec();
    assert_eq!(names.len(), 40);
    for Written {
        bounds: [left, top, right, bottom],
        text,
        ..
    } in names
    {
        assert!(
            left > 4.0 && right < 756.0 && top > 60.0 && bottom < 450.0,
            "{text}: {left} {top} {right} {bottom}"
        );
    }
}

/// Modes of four places, each moving as its number and its state say.
fn modes(frame: Frame, motion: fn(usize) -> Vector3<f64>) -> DrawnModes {
    let moved = |mode: usize, state: usize| {
        (0..4)
            .map(|node| 0.3 * motion(mode + state + 2 * node))
            .collect()
    };
    let mode = |mode: usize| DrawnMode {
        number: mode + 1,
        hertz: [1.0, 1.25, 0.999].map(|part| part * 10f64.powi(mode as i32)),
        moved: [0, 1, 2].map(|state| moved(mode, state)),
    };
    DrawnModes {
        frame,
        modes: (0..4).map(mode).collect(),
    }
}

fn frame(nodes: [Vector3<f64>; 4], lines: Vec<Vec<usize>>) -> Frame {
    let known = BTreeMap::from([(0, vec![(0, Vector3::z())]), (2, Vec::new())]);
    Frame {
        nodes: nodes.to_vec(),
        lines,
        panels: Vec::new(),
        pieces: Vec::new(),
        known,
        grids: vec![None; 4],
    }
}

#[test]
fn modes_are_drawn_in_their_plane_in_depth_and_as_marks() {
    let lines = || vec![vec![0, 1, 2, 3, 0]];
    let flat = [
        at(0.0, 0.0, 0.0),
        at(4.0, 0.0, 0.0),
        at(4.0, 2.0, 0.0),
        at(0.0, 2.0, 0.0),
    ];
    let deep = [
        at(0.0, 0.0, 0.0),
        at(4.0, 0.0, 0.2),
        at(4.0, 2.0, 0.4),
        at(0.0, 2.0, 0.0),
    ];
    let in_plane = modes(frame(flat, lines()), |row| {
        at((row as f64).sin(), (row as f64).cos(), 0.0)
    });
    assert_golden(
        "drawing_modes_in_plane",
        &mode_shapes::draw(&in_plane, "modes", "Modes").expect("drawn"),
        Numbers::DRAWN,
    );
    let in_depth = modes(frame(deep, lines()), |row| {
        at(0.0, 0.1 * (row as f64).cos(), (row as f64).sin())
    });
    assert_golden(
        "drawing_modes_in_depth",
        &mode_shapes::draw(&in_depth, "modes", "Modes").expect("drawn"),
        Numbers::DRAWN,
    );
    // Out of a plane that is flat but for round-off no depth is exaggerated.
    let bent = [
        at(0.0, 0.0, 0.0),
        at(1e3, 0.0, 1e-5),
        at(1e3, 5e2, 0.0),
        at(0.0, 5e2, 0.0),
    ];
    let even = bent.map(|place| at(place.x, place.y, 0.0));
    let [bent, even] = [bent, even].map(|nodes| {
        let modes = modes(frame(nodes, lines()), |row| {
            at(0.0, 0.1 * (row as f64).cos(), (row as f64).sin())
        });
        mode_shapes::draw(&modes, "modes", "Modes").expect("drawn")
    });
    assert!(Numbers::DRAWN.agree(&bent, &even));
    let marks = modes(frame(deep, Vec::new()), |row| {
        at(0.0, 0.0, (row as f64).sin())
    });
    assert_golden(
        "drawing_modes_as_marks",
        &mode_shapes::draw(&marks, "modes", "Modes").expect("drawn"),
        Numbers::DRAWN,
    );
}

properties! {
    #![proptest_config(crate::common::costly_config())]

    /// As long as there is room, no name lies on another's, on the legend or beyond the page.
    #[test]
    fn names_beside_places_lie_neither_on_each_other_nor_off_the_page(
        places in prop::collection::vec((0.0..2.0_f64, 0.0..1.0_f64), 1..25),
        name in "[a-z]{1,8}",
    ) {
        let sensors = places.iter().map(|&(x, y)| (name.clone(), Some(at(x, y, 0.0)))).collect();
        let svg = drawn(&with_sensors(sensors, vec![panel(2.0, 1.0)]));
        let names = written(&svg).into_iter().filter(|word| word.text == name).collect_vec();
        prop_assert_eq!(names.len(), places.len());
        for (row, Written { bounds: [left, top, right, bottom], .. }) in names.iter().enumerate() {
            prop_assert!(*left > 0.0 && *right < 760.0 && *top > 60.0 && *bottom < 450.0);
            for Written { bounds: [l, t, r, b], .. } in &names[row + 1..] {
                prop_assert!(right <= l || r <= left || bottom <= t || b <= top);
            }
        }
    }
}
