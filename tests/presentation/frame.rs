//! A wire frame: how it moves between its sensors.

use super::subject::chain;
use crate::prelude::*;
use corfem::present::frame::Frame;

/// A frame of these places, of which the first ones have sensors along an axis.
fn of_places(nodes: Vec<Vector3<f64>>, sensors: &[Vector3<f64>], panels: Vec<Vec<usize>>) -> Frame {
    let known = sensors
        .iter()
        .enumerate()
        .map(|(row, &along)| (row, vec![(row, along)]))
        .collect();
    Frame {
        grids: vec![None; nodes.len()],
        lines: Vec::new(),
        nodes,
        panels,
        pieces: Vec::new(),
        known,
    }
}

#[test]
fn a_grid_moves_as_the_whole_model_says_but_along_its_sensor_as_measured() {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let mut frame = of_places(vec![at(0.0), at(1.0), at(2.0)], &[Vector3::z()], Vec::new());
    frame.grids = vec![Some(1), Some(0), None];
    let grids = [Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, 6.0, 8.0)];
    let moved = frame.moved(&[-4.0], Some(&grids));
    assert_eq!(moved[0], Vector3::new(1.0, 1.5, -1.0));
    assert_eq!(moved[1], Vector3::new(0.25, 0.5, 0.75));
    assert_eq!(
        moved[2],
        -Vector3::z(),
        "as the sensor, which is the only one"
    );
}

#[test]
fn a_line_that_measures_along_itself_is_drawn_across_and_zero_has_one_sign() {
    for (axis, across) in [(0, Vector3::z()), (1, Vector3::z()), (2, Vector3::x())] {
        let line = Vector3::ith(axis, 1.0);
        let along = chain("rod", &[1.0; 3], |row| (row as f64 * line, line));
        let directions = |frame: &Frame| {
            frame
                .known
                .values()
                .flatten()
                .map(|sensor| sensor.1)
                .collect_vec()
        };
        assert_eq!(directions(&Frame::from_report(&along)), [across; 3]);
        let mut subject = along.clone();
        subject.sensors[1].direction = Vector3::ith((axis + 1) % 3, 1.0);
        let directions = directions(&Frame::from_report(&subject));
        assert_eq!(
            directions,
            [line, subject.sensors[1].direction, line],
            "one of them measures across already"
        );
        subject.sensors[0].place = Some(Vector3::repeat(-0.0));
        assert_eq!(Frame::from_report(&subject).nodes.len(), 3);
    }
}
