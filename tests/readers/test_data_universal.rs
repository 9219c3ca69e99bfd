//! The Universal File: fixed columns, marks and what looks like them, and files that are not what they should be.

use crate::prelude::*;

/// A dataset 55 of a real mode.
pub fn real_mode(values: &str) -> String {
    let none = "NONE\n".repeat(5);
    let codes = "         1         2         2         8         2         3\n         2         4         0         1";
    let root = "  1.25000E+01  0.00000E+00  0.00000E+00  0.00000E+00";
    format!("    -1\n    55\n{none}{codes}\n{root}\n{values}    -1\n")
}

fn parsed(text: &str) -> TestData {
    read("wing.unv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn binary_data_are_passed_over_to_their_mark() {
    let mut bytes =
        b"    -1\n    58b     1     2          11           8\nNONE\n\xff\x00\n\xfe\xff    -1\n"
            .to_vec();
    bytes.extend(real_mode("        12\n  0.00000E+00  0.00000E+00  1.00000E+00\n").bytes());
    let data = read("wing.unv", &bytes).unwrap();
    assert_eq!((data.skipped, data.shapes), (vec![58], dmatrix![1.0]));
}

/// What is read of what is written says the same to six digits, by node and direction; a direction that is zero in every mode is no sensor, and
/// sensors without a grid have the numbers behind the others.
fn assert_six_digits(data: &TestData) {
    let found = parsed(&write_universal(data));
    assert_eq!(found.lines, data.lines);
    let pairs = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            assert_within(a, b, UNIVERSAL_ROUNDING * b.abs());
        }
    };
    pairs(&found.frequencies_hz, &data.frequencies_hz);
    let last = data.sensors.iter().filter_map(|own| own.grid).max();
    let (mut next, mut rows) = (last.unwrap_or(0), BTreeMap::new());
    for (own, row) in data.sensors.iter().zip(data.shapes.row_iter()) {
        next += usize::from(own.grid.is_none());
        let mut at_grid = data.sensors.iter().filter(|other| other.grid == own.grid);
        let place = own
            .grid
            .map_or(own.place, |_| at_grid.find_map(|other| other.place));
        if row.amax() > 0.0 {
            let numbers = row.iter().chain(place.iter().flatten()).copied();
            rows.insert(
                (own.grid.unwrap_or(next), own.direction),
                numbers.collect_vec(),
            );
        }
    }
    assert_eq!(found.sensors.len(), rows.len());
    for (own, row) in found.sensors.iter().zip(found.shapes.row_iter()) {
        let numbers = row.iter().chain(own.place.iter().flatten()).copied();
        pairs(
            &numbers.collect_vec(),
            &rows[&(own.grid.unwrap(), own.direction)],
        );
    }
}

properties! {
    #[test]
    fn every_test_reads_back_from_its_universal_file_to_six_digits(data in ground_test()) {
        assert_six_digits(&data);
        assert_six_digits(&wing_test());
    }

    #[test]
    fn what_was_read_is_written_again_as_it_was(data in ground_test()) {
        let once = write_universal(&parsed(&write_universal(&data)));
        prop_assert_eq!(write_universal(&parsed(&once)), once);
    }
}
