//! Coordinate systems of a Universal File: along which axes its nodes are placed and its sensors measure.

use super::test_data_universal::{dataset, parsed, real_mode};
use crate::prelude::*;

pub fn row(values: &[f64], width: usize) -> String {
    values
        .iter()
        .map(|value| format!("{value:width$.5}"))
        .collect::<String>()
        + "\n"
}

/// A node of dataset 15 with the coordinate systems of its place and of its displacements.
pub fn node(node: usize, [of_place, of_motion]: [usize; 2], place: [f64; 3]) -> String {
    format!("{node:10}{of_place:10}{of_motion:10}        11") + &row(&place, 13)
}

/// A system of dataset 18: origin, a point on the x axis, one in the xz plane.
pub fn system(number: usize, kind: usize, reference: usize, points: [[f64; 3]; 3]) -> String {
    let numbers = format!("{number:10}{kind:10}{reference:10}         8         1\nSYS\n");
    numbers + &row(&points[..2].concat(), 13) + &row(&points[2], 13)
}

/// A system of dataset 2420: unit vectors along its axes, and its origin.
pub fn matrix(number: usize, kind: usize, rows: [[f64; 3]; 4]) -> String {
    format!("{number:10}{kind:10}         8\nCS{number}\n")
        + &rows.map(|values| row(&values, 25)).concat()
}

pub const PART: &str = "         1\nPart\n";

/// What six digits leave beside a global axis is none of a sensor's, and a ten-thousandth is where that ends.
#[test]
fn axes_a_hair_from_the_global_ones_are_the_global_ones() {
    let axis = |beside: f64| {
        let rows = [
            [1.0, beside, 0.0],
            [-beside, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0; 3],
        ];
        let text = dataset("15", &node(12, [0, 3], [0.0; 3]))
            + &dataset("2420", &(PART.to_owned() + &matrix(3, 0, rows)));
        let shape = format!("{:10}\n", 12) + &row(&[1.0, 0.0, 0.0], 13);
        parsed(&(text + &real_mode(&shape))).sensors[0]
            .axis
            .unwrap()
    };
    assert_eq!(axis(9e-5), Vector3::x());
    assert!((axis(1e-4) - Vector3::new(1.0, 1e-4, 0.0)).amax() < BESIDE_AN_AXIS);
}
