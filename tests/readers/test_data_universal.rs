//! The Universal File: fixed columns, marks and what looks like them, and files that are not what they should be.

use crate::prelude::*;

pub const NONE: &str = "NONE\nNONE\nNONE\nNONE\nNONE\n";

pub fn dataset(number: &str, body: &str) -> String {
    format!("    -1\n{number:>6}\n{body}    -1\n")
}

/// A dataset 55 with its six codes, its record 8 and its values.
fn mode(codes: [usize; 6], record: &str, values: &str) -> String {
    let codes: String = codes.iter().map(|code| format!("{code:10}")).collect();
    dataset(
        "55",
        &format!("{NONE}{codes}\n         2         4         0         1\n{record}\n{values}"),
    )
}

pub fn real_mode(values: &str) -> String {
    mode(
        [1, 2, 2, 8, 2, 3],
        "  1.25000E+01  0.00000E+00  0.00000E+00  0.00000E+00",
        values,
    )
}

pub const TIP: &str = "        12\n  0.00000E+00  0.00000E+00  1.00000E+00\n";

pub fn parsed(text: &str) -> TestData {
    read("wing.unv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn binary_data_are_passed_over_to_their_mark() {
    let mut bytes =
        b"    -1\n    58b     1     2          11           8\nNONE\n\xff\x00\n\xfe\xff    -1\n"
            .to_vec();
    bytes.extend(real_mode(TIP).bytes());
    let data = read("wing.unv", &bytes).unwrap();
    assert_eq!((data.skipped, data.shapes), (vec![58], dmatrix![1.0]));
}

/// Place and numbers of a sensor.
type PlacedRow = (Option<Vector3<f64>>, Vec<f64>);

/// What a Universal File can hold of a test, by node and direction.
fn by_node(data: &TestData) -> BTreeMap<(usize, usize), PlacedRow> {
    let last = data
        .sensors
        .iter()
        .filter_map(|sensor| sensor.grid)
        .max()
        .unwrap_or(0);
    let mut next = last;
    let mut first_place = BTreeMap::new();
    let mut rows = Vec::new();
    for (sensor, row) in data.sensors.iter().zip(data.shapes.row_iter()) {
        let grid = sensor.grid.unwrap_or_else(|| {
            next += 1;
            next
        });
        if let Some(place) = sensor.place {
            first_place.entry(grid).or_insert(place);
        }
        rows.push((
            (grid, sensor.direction),
            row.iter().copied().collect::<Vec<f64>>(),
        ));
    }
    rows.retain(|(_, row)| row.iter().any(|value| *value != 0.0));
    rows.into_iter()
        .map(|(key, row)| (key, (first_place.get(&key.0).copied(), row)))
        .collect()
}

fn assert_six_digits(found: &TestData, expected: &TestData) {
    let close = |a: f64, b: f64| assert_within(a, b, UNIVERSAL_ROUNDING * b.abs());
    assert_eq!(found.lines, expected.lines);
    found
        .frequencies_hz
        .iter()
        .zip(&expected.frequencies_hz)
        .for_each(|(a, b)| close(*a, *b));
    let (found, expected) = (by_node(found), by_node(expected));
    assert_eq!(found.keys().collect_vec(), expected.keys().collect_vec());
    for ((place, row), (expected_place, expected_row)) in found.values().zip(expected.values()) {
        assert_eq!(place.is_some(), expected_place.is_some());
        let (place, expected_place) = (
            place.unwrap_or_default(),
            expected_place.unwrap_or_default(),
        );
        place
            .iter()
            .zip(expected_place.iter())
            .for_each(|(a, b)| close(*a, *b));
        row.iter()
            .zip(expected_row)
            .for_each(|(a, b)| close(*a, *b));
    }
}

#[test]
fn what_is_written_reads_back_to_six_digits() {
    assert_six_digits(&parsed(&write_universal(&wing_test())), &wing_test());
    let data = TestData {
        shapes: zero_square(1),
        ..TestData::default()
    };
    assert_eq!(
        write_universal(&data),
        "",
        "a test that is none has no datasets, and no panic"
    );
}

properties! {
    #[test]
    fn every_test_reads_back_from_its_universal_file_to_six_digits(data in ground_test()) {
        assert_six_digits(&parsed(&write_universal(&data)), &data);
    }

    #[test]
    fn what_was_read_is_written_again_as_it_was(data in ground_test()) {
        let once = write_universal(&parsed(&write_universal(&data)));
        prop_assert_eq!(write_universal(&parsed(&once)), once);
    }
}
