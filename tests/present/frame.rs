//! A wire frame: how it moves between its sensors, and where it does not move at all.

use super::subject::chain;
use crate::common::tolerances::NODE_LINE;
use corfem::present::figures::frame::Frame;
use nalgebra::Vector3;
use proptest::prelude::*;

proptest! {
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
        subject.frame.push(vec![subject.sensors[0].place.expect("a place"), other]);
        let frame = Frame::of(&subject);
        let moved = frame.moved(&shape, None);
        let largest = shape.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
        let unit = shape.map(|component| component / largest);
        for (at, motion) in frame.nodes.iter().zip(&moved) {
            match subject.sensors.iter().position(|sensor| sensor.place == Some(*at)) {
                Some(row) => prop_assert_eq!(motion.z, unit[row]),
                None => {
                    let (low, high) = unit.iter().fold((f64::MAX, f64::MIN), |(l, h), &u| (l.min(u), h.max(u)));
                    prop_assert!((low - NODE_LINE..=high + NODE_LINE).contains(&motion.z));
                }
            }
        }
    }

    /// A plane that rises along a line of panels has its node line where it passes zero, and a held edge ends one.
    #[test]
    fn node_lines_lie_where_the_displacement_vanishes(zero in 0.1..2.9_f64, tilt in -0.05..0.05_f64) {
        let mut subject = chain("rod", &[1.0; 8], |row| (Vector3::new((row / 2) as f64, (row % 2) as f64, 0.0), Vector3::z()));
        let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        subject.frame = (0..3).map(f64::from).map(|x| vec![at(x, 0.0), at(x, 1.0), at(x + 1.0, 1.0), at(x + 1.0, 0.0)]).collect();
        let frame = Frame::of(&subject);
        let plane = |x: f64, y: f64| x - zero + tilt * (y - 0.5);
        let shape: Vec<f64> = (0..8).map(|row| plane((row / 2) as f64, (row % 2) as f64)).collect();
        prop_assume!(shape.iter().all(|w| w.abs() > 1e-6));
        let lines = frame.node_lines(&Vector3::z(), &frame.moved(&shape, None));
        prop_assert!(!lines.is_empty());
        let long: f64 = lines.iter().map(|[a, b]| (a - b).norm()).sum();
        prop_assert!((long - (1.0 + tilt * tilt).sqrt()).abs() < NODE_LINE, "{long}");
        for end in lines.as_flattened() {
            prop_assert!(plane(end.x, end.y).abs() < NODE_LINE);
        }
    }
}
