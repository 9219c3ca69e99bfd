//! A wire frame: how it moves between its sensors.

use super::subject::chain;
use crate::prelude::*;
use corfem::present::frame::Frame;

properties! {
    #![proptest_config(crate::common::costly_config())]

    /// Interpolation passes through what is measured and stays between the least and the most of it.
    #[test]
    fn a_frame_moves_as_its_sensors_say_and_between_them_within_their_range(
        places in prop::array::uniform12(-10.0..10.0_f64),
        shape in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        prop_assume!(shape.iter().any(|component| component.abs() > 0.01));
        let mut subject = chain("rod", &[1.0, 1.1, 0.9], |row| {
            (Vector3::new(places[3 * row], places[3 * row + 1], places[3 * row + 2]), Vector3::z())
        });
        let other = Vector3::new(places[9], places[10], places[11]);
        subject.frame.push(vec![subject.sensors[0].place.unwrap(), other]);
        let frame = Frame::from_report(&subject);
        let moved = frame.moved(&shape, None);
        let largest = shape.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
        let unit = shape.map(|component| component / largest);
        for (at, motion) in frame.nodes.iter().zip(&moved) {
            match subject.sensors.iter().position(|sensor| sensor.place == Some(*at)) {
                Some(row) => prop_assert_eq!(motion.z, unit[row]),
                None => {
                    let (low, high) = unit.iter().fold((f64::MAX, f64::MIN), |(l, h), &u| (l.min(u), h.max(u)));
                    prop_assert!((low - INTERPOLATED..=high + INTERPOLATED).contains(&motion.z));
                }
            }
        }
    }
}

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
fn a_place_near_a_sensor_moves_as_it_does_and_one_twice_as_far_has_a_sixteenth_of_its_weight() {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let frame = of_places(
        vec![at(3.0), at(6.0), at(4.0), at(3.0 + 1e-6)],
        &[Vector3::z(), Vector3::z()],
        Vec::new(),
    );
    let moved = frame.moved(&[2.0, -1.0], None);
    // At one and at two lengths from one and minus one half: 16 to 1.
    assert_within(moved[2].z, (16.0 - 0.5) / 17.0, INTERPOLATED);
    assert_within(moved[3].z, 1.0, INTERPOLATED);
    // The farthest that a place can be, too.
    let far = of_places(
        vec![at(1.0), at(3.0), at(0.0)],
        &[Vector3::z(), Vector3::z()],
        Vec::new(),
    );
    assert_within(
        far.moved(&[2.0, -1.0], None)[2].z,
        (81.0 - 0.5) / 82.0,
        INTERPOLATED,
    );
    let unknown = of_places(vec![at(0.0), at(1.0)], &[], Vec::new());
    assert_eq!(unknown.moved(&[1.0], None), [Vector3::zeros(); 2]);
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
