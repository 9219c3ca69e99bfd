//! Coordinate systems of a Universal File: along which axes its nodes are placed and its sensors measure.

use super::test_data_universal::{TIP, dataset, parsed, real_mode};
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

#[test]
fn sensors_measure_along_the_axes_of_their_nodes() {
    // System 3 is turned by a quarter about z: its x is the global y; 4 stands in it, and its x points along the y of 3.
    let quarter = system(
        3,
        0,
        0,
        [[10.0, 0.0, 0.0], [10.0, 7.0, 0.0], [10.0, 2.0, 5.0]],
    );
    let within = system(4, 0, 3, [[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 0.0, 3.0]]);
    let oblique = matrix(
        5,
        0,
        [
            [0.6, 0.8, 0.0],
            [-0.8, 0.6, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 1.0, 0.0],
        ],
    );
    let values = |nodes: &[usize]| {
        nodes
            .iter()
            .map(|node| format!("{node:10}\n") + &row(&[1.0, 2.0, 3.0], 13))
            .collect::<String>()
    };
    let nodes = [
        node(1, [3, 0], [1.0, 2.0, 3.0]),
        node(2, [0, 3], [1.0, 2.0, 3.0]),
        node(3, [4, 4], [1.0, 2.0, 3.0]),
        node(4, [5, 5], [1.0, 0.0, 0.0]),
        node(5, [1, 1], [1.0, 2.0, 3.0]),
    ];
    // Wherever the systems stand in the file.
    let text = dataset("15", &nodes.concat())
        + &real_mode(&values(&[1, 2, 3, 4, 5]))
        + &dataset("18", &(quarter + &within))
        + &dataset("2420", &(PART.to_owned() + &oblique));
    let data = parsed(&text);
    assert!(data.skipped.is_empty(), "{:?}", data.skipped);
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let expected = [
        (Vector3::new(8.0, 1.0, 3.0), [x, y, z]),
        (Vector3::new(1.0, 2.0, 3.0), [y, -x, z]),
        // Of 4 in the global axes: origin (10, 1, 0), x along -x, y along -y.
        (Vector3::new(9.0, -1.0, 3.0), [-x, -y, z]),
        (
            Vector3::new(0.6, 1.8, 0.0),
            [Vector3::new(0.6, 0.8, 0.0), Vector3::new(-0.8, 0.6, 0.0), z],
        ),
        (Vector3::new(1.0, 2.0, 3.0), [x, y, z]),
    ];
    for (sensors, (place, axes)) in data.sensors.chunks(3).zip(expected) {
        for (sensor, axis) in sensors.iter().zip(axes) {
            let found = sensor
                .axis
                .unwrap_or_else(|| Vector3::ith(sensor.direction, 1.0));
            assert!(
                (found - axis).amax() < ROUND_OFF,
                "{}: {found}",
                sensor.name
            );
            assert!(
                (sensor.place.unwrap() - place).amax() < ROUND_OFF,
                "{}",
                sensor.name
            );
        }
    }
    // Coordinates of dataset 2411 are global ones.
    let long = dataset(
        "2411",
        &format!(
            "{:10}{:10}{:10}        11\n{}",
            1,
            3,
            3,
            row(&[1.0, 2.0, 3.0], 25)
        ),
    );
    let quarter = system(
        3,
        0,
        0,
        [[10.0, 0.0, 0.0], [10.0, 7.0, 0.0], [10.0, 2.0, 5.0]],
    );
    let data = parsed(&(dataset("18", &quarter) + &long + &real_mode(&values(&[1]))));
    assert_eq!(
        (data.sensors[0].place, data.sensors[0].axis),
        (Some(Vector3::new(1.0, 2.0, 3.0)), Some(y))
    );
}

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

#[test]
fn coordinate_systems_that_are_none_are_refused() {
    let said = |text: String| {
        read("wing.unv", (text + &real_mode(TIP)).as_bytes())
            .map(drop)
            .expect_err("wrong")
            .to_string()
    };
    let points = |points| dataset("18", &system(3, 0, 0, points));
    let origin = said(points([[1.0; 3], [1.0; 3], [0.0; 3]]));
    assert!(
        origin.contains("line 6: the point on the x axis is the origin"),
        "{origin}"
    );
    let on_axis = said(points([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]));
    assert!(
        on_axis.contains("line 6: the point in the xz plane is on the x axis"),
        "{on_axis}"
    );
    // Seen from its origin as a point a hundred times farther away is: at less than a ten-thousandth of a radian.
    let near_axis = |far: f64| points([[0.0; 3], [1.0, 0.0, 0.0], [far, 0.0, 0.05]]);
    assert!(said(near_axis(1000.0)).contains("line 6: the point in the xz plane is on the x axis"));
    parsed(&(near_axis(100.0) + &real_mode(TIP)));
    let unknown = said(dataset(
        "18",
        &system(3, 0, 2, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    ));
    assert!(
        unknown.contains(
            "\"2\" is not zero or the number of a Cartesian coordinate system before this one"
        ),
        "{unknown}"
    );
    let skewed = |by: f64| {
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, by], [0.0, 0.0, 1.0], [0.0; 3]];
        dataset("2420", &(PART.to_owned() + &matrix(3, 0, rows)))
    };
    parsed(&(skewed(1e-4) + &real_mode(TIP)));
    let skew = said(skewed(1.1e-4));
    assert!(
        skew.contains("the three rows above are not unit vectors at right angles"),
        "{skew}"
    );
    let of_kind = |kind, place| {
        let system = system(3, kind, 0, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        dataset("18", &system) + &dataset("15", &node(12, [0, 3], place))
    };
    let sphere = said(of_kind(2, [0.0; 3]));
    let expected =
        "line 10: node 12 has coordinate system 3, which is no Cartesian or cylindrical one";
    assert!(sphere.contains(expected), "{sphere}");
    let on_axis = said(of_kind(1, [0.0, 0.0, 4.0]));
    let expected = "line 10: node 12 is on the axis of its cylindrical coordinate system";
    assert!(on_axis.contains(expected), "{on_axis}");
}

/// Reading along global axes would be a guess. 0 is the global system by the format, 1 is SDRC's number for it.
#[test]
fn a_sensor_whose_coordinate_system_is_not_in_the_file_is_an_error() {
    let of = |systems| dataset("15", &node(12, systems, [1.0, 2.0, 3.0])) + &real_mode(TIP);
    for systems in [[7, 0], [0, 7]] {
        let error = read("wing.unv", of(systems).as_bytes()).expect_err("no system 7");
        assert_eq!(
            error.to_string(),
            "wing.unv, line 3: node 12 has coordinate system 7, which is no Cartesian or cylindrical one of a dataset 18 or 2420 of the file"
        );
    }
    assert_eq!(parsed(&of([1, 1])).sensors[0].axis, None);
    // A node without a sensor may have any.
    let other = dataset("15", &node(13, [7, 7], [0.0; 3]));
    assert_eq!(parsed(&(other + &of([0, 0]))).sensors.len(), 1);
}
