//! Ground vibration tests, drawn and written by hand.

use crate::prelude::*;

/// A wing test with everything that a test may have: rotations, a sensor without grid, places and a wire frame.
pub fn wing_test() -> TestData {
    let sensor = |name: &str, grid, direction, place: Option<[f64; 3]>| Sensor {
        name: name.to_owned(),
        grid,
        direction,
        axis: None,
        place: place.map(Vector3::from),
    };
    TestData {
        frequencies_hz: vec![12.5, 17.875],
        sensors: vec![
            sensor("tip, front", Some(12), 2, Some([-1.0, 52.5, 3.125])),
            sensor("the \"root\"", Some(1), 2, Some([-1.0, -1.0, -1.0])),
            sensor("pitch", Some(12), 4, Some([-1.0, 52.5, 3.125])),
            sensor("pod", None, 0, None),
        ],
        shapes: dmatrix![1.0, -0.3125; 0.125, 1.0; -1.5e-7, 2.5e3; 0.0, -0.5],
        frequency_deviation: Some(vec![0.003, 0.005]),
        shape_deviation: Some(vec![0.01, 0.02]),
        phase_collinearity: vec![0.99, 0.875],
        lines: vec![[1, 12], [12, 13]],
        ..TestData::default()
    }
}

/// A place for a number, or nothing there.
fn sometimes<T: Debug + Clone + 'static>(
    value: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<Option<T>> {
    prop::option::of(value).boxed()
}

/// A test with one to four modes at one to six sensors. Numbers are up to a million and down to a millionth, or zero, no
/// shape is zero, no sensor comes twice.
pub fn ground_test() -> impl Strategy<Value = TestData> {
    let number = || prop_oneof![4 => (-1.0..1.0_f64, -6..=6).prop_map(|(m, e)| m * 10_f64.powi(e)), 1 => Just(0.0)];
    (1..=4_usize, 1..=6_usize).prop_flat_map(move |(modes, sensors)| {
        let positive = |count| prop::collection::vec(1e-3..1e3_f64, count);
        let sensor = (
            "[a-z\"',;#][a-z \"',;#]{0,8}[a-z\"',;#]",
            sometimes(1..9_usize),
            0..6_usize,
            sometimes((number(), number(), number())),
        );
        (
            positive(modes),
            prop::collection::vec(sensor, sensors),
            prop::collection::vec(number(), modes * sensors),
            (sometimes(positive(modes)), sometimes(positive(modes))),
            prop::collection::btree_map(0..modes, positive(sensors), 0..=modes),
        )
            .prop_map(
                move |(
                    frequencies_hz,
                    rows,
                    values,
                    (frequency_deviation, shape_deviation),
                    own,
                )| {
                    let own = own.into_iter();
                    let mut seen = std::collections::HashSet::new();
                    let sensors = rows
                        .into_iter()
                        .map(|(name, grid, direction, place)| Sensor {
                            name,
                            grid: grid.filter(|grid| seen.insert((*grid, direction))),
                            direction,
                            axis: None,
                            place: place.map(|(x, y, z)| Vector3::new(x, y, z)),
                        });
                    let sensors = sensors.collect_vec();
                    let mut shapes = DMatrix::from_vec(sensors.len(), modes, values);
                    shapes
                        .row_mut(0)
                        .apply(|value| *value = if *value == 0.0 { 1.0 } else { *value });
                    TestData {
                        frequencies_hz,
                        sensors,
                        shapes,
                        frequency_deviation,
                        shape_deviation,
                        component_deviation: own
                            .map(|(mode, own)| (mode, DVector::from_vec(own)))
                            .collect(),
                        ..TestData::default()
                    }
                },
            )
    })
}
