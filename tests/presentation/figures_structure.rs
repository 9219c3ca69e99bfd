//! The structure with its names, and how modes are drawn on it: crowded, in any plane, and without lines.

use super::subject::chain;
use crate::common::drawings::{Written, words, written};
use crate::paper::figures::canvas::WIDE;
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
    draw_structure("structure", "Structure", subject, WIDE).unwrap()
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
    const SOLID: &str = "x right and down, y right and up, z up";
    type Turn = fn(f64, f64) -> Vector3<f64>;
    for (unit, [wide, long], turn, expected) in [
        (
            1.0,
            [2.0, 1.0],
            (|a, b| at(a, b, 0.0)) as Turn,
            "x right, y up",
        ),
        // A square too.
        (1.0, [1.0, 1.0], |a, b| at(a, b, 0.0), "x right, y up"),
        (1.0, [2.0, 1.0], |a, b| at(b, a, 0.0), "x down, y right"),
        (1.0, [2.0, 1.0], |a, b| at(a, 0.0, b), "x right, z up"),
        (1.0, [2.0, 1.0], |a, b| at(0.0, a, b), "y right, z up"),
        // A hundred-millionth of its length is round-off, and no depth.
        (
            1e3,
            [1.0, 0.5],
            |a, b| at(a, b, 1e-8 * (a + b)),
            "x right, y up",
        ),
        (1e3, [1.0, 1.0], |a, b| at(a, b, 0.5 * b), SOLID),
        (
            1e3,
            [1.0, 1.0],
            |a, b| at(a, b, 0.1 * b),
            "depth drawn 3 times",
        ),
        (
            1e3,
            [1.0, 1.0],
            |a, b| at(a, b, 1e-5 * b),
            "depth drawn 7 times",
        ),
        // A structure of any unit.
        (
            0.01,
            [1.0, 1.0],
            |a, b| at(a, b, 4.5e-3 * b),
            "depth drawn 7 times",
        ),
    ] {
        let corners = panel(wide, long).into_iter();
        let corners = corners
            .map(|of| turn(unit * of.x, unit * of.y))
            .collect_vec();
        let sensors = vec![("s".to_owned(), Some(corners[0]))];
        let said = words(&drawn(&with_sensors(sensors, vec![corners]))).remove(2);
        match said.strip_prefix(&format!("{SOLID}; ")) {
            Some(depth) => assert_eq!(depth, expected),
            None => assert_eq!(said, expected),
        }
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
    let raised = |heights: [f64; 4], size: f64| {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        [0, 1, 2, 3].map(|row| at(size * corners[row][0], size * corners[row][1], heights[row]))
    };
    let (flat, deep) = (raised([0.0; 4], 2.0), raised([0.0, 0.2, 0.4, 0.0], 2.0));
    let drawn =
        |frame, motion| mode_shapes::draw(&modes(frame, motion), "modes", "Modes", WIDE).unwrap();
    let round = |row: usize| at((row as f64).sin(), (row as f64).cos(), 0.0);
    let askew = |row: usize| at(0.0, 0.1 * (row as f64).cos(), (row as f64).sin());
    let up = |row: usize| at(0.0, 0.0, (row as f64).sin());
    for (name, svg) in [
        ("in_plane", drawn(frame(flat, lines()), round)),
        ("in_depth", drawn(frame(deep, lines()), askew)),
        ("as_marks", drawn(frame(deep, Vec::new()), up)),
    ] {
        assert_golden(&format!("drawing_modes_{name}"), &svg, Numbers::DRAWN);
    }
    // Out of a plane that is flat but for round-off no depth is exaggerated.
    let [bent, even] = [1e-5, 0.0]
        .map(|height| drawn(frame(raised([0.0, height, 0.0, 0.0], 5e2), lines()), askew));
    assert!(Numbers::DRAWN.agree(&bent, &even));
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
