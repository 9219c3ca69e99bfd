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
fn columns_that_touch_and_fortran_exponents_are_read() {
    let data = parsed(&real_mode(
        "        12\n-1.23456D-101-2.00000d+100 -3.00000E+00\n",
    ));
    assert_eq!(data.shapes, dmatrix![-1.23456e-101; -2e100; -3.0]);
    // Three digits of an exponent push its letter out; blanks may separate what is in no columns.
    let data = parsed(&real_mode("12\n-1.23456-101 2.0 3\n"));
    assert_eq!(data.shapes, dmatrix![-1.23456e-101; 2.0; 3.0]);
    assert_eq!(
        parsed(&real_mode(TIP).replace('\n', "\r\n")),
        parsed(&real_mode(TIP))
    );
    assert_eq!(
        parsed(&real_mode(TIP).replace("    -1\n", &format!("{:80}\n", "    -1"))),
        parsed(&real_mode(TIP))
    );
    let apart = format!("\n\n{}\n\n\n{}\n", dataset("58", ""), real_mode(TIP));
    assert_eq!(
        parsed(&apart),
        parsed(&(dataset("58", "") + &real_mode(TIP))),
        "empty lines between datasets"
    );
}

/// The frequency is the root's magnitude over 2π; of a pair the root with a negative imaginary part is passed over.
#[test]
fn a_complex_root_is_read_unless_its_imaginary_part_is_negative() {
    let root = |imaginary: f64| {
        mode(
            [1, 3, 2, 8, 2, 3],
            &format!("{:13.5}{imaginary:13.5}", -3.0),
            TIP,
        )
    };
    let data = parsed(&(root(4.0) + &root(-4.0) + &root(0.0)));
    for (found, magnitude) in data.frequencies_hz.iter().zip([5.0, 3.0]) {
        assert!(
            (found - magnitude / (2.0 * PI)).abs() < ROUND_OFF,
            "{found}"
        );
    }
    assert_eq!(
        (data.frequencies_hz.len(), data.shapes),
        (2, dmatrix![1.0, 1.0])
    );
}

#[test]
fn complex_modes_of_six_components_have_two_lines_a_node() {
    let row = |values: [f64; 6]| {
        values
            .iter()
            .map(|value| format!("{value:13.5}"))
            .collect::<String>()
            + "\n"
    };
    let values = format!(
        "        12\n{}{}",
        row([1.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
        row([0.0, 0.0, 0.0, 0.0, -2.0, -2.0])
    );
    let real = format!("        12\n{}", row([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
    let data = parsed(
        &(mode([1, 2, 3, 8, 5, 6], "  1.25000E+01", &values)
            + &mode([1, 2, 3, 8, 2, 6], "  1.25000E+01", &real)),
    );
    let names = data
        .sensors
        .iter()
        .map(|sensor| sensor.name.as_str())
        .collect_vec();
    assert_eq!(names, ["12 x", "12 z", "12 rz"]);
    // One in both parts turns to the root of two; a real mode among complex ones has a collinearity of one.
    let expected = dmatrix![-2.0_f64.sqrt(), 0.0; 0.0, 1.0; 8.0_f64.sqrt(), 0.0];
    assert!((data.shapes - expected).amax() < ROUND_OFF);
    assert!(
        data.phase_collinearity
            .iter()
            .all(|value| (value - 1.0).abs() < ROUND_OFF)
    );
}

#[test]
fn data_that_begin_with_minus_one_end_no_dataset() {
    let nodes = "        12         1         1        11\n    -1\u{a0}\n";
    assert!(read("wing.unv", dataset("2411", nodes).as_bytes()).is_err());
    let nodes = "        12         1         1        11\n   -1 -1 -1\n";
    let data = parsed(&(dataset("2411", nodes) + &real_mode(TIP)));
    assert_eq!(data.sensors[0].place, Some(Vector3::new(-1.0, -1.0, -1.0)));
    // An unknown dataset may have any line.
    let data =
        parsed(&(dataset("777", "        -1\n  -1\n") + &real_mode(TIP) + &dataset("58", "x\n")));
    assert_eq!(data.skipped, [58, 777]);
    // Minus one as a node is data, and no node.
    let error = read(
        "wing.unv",
        real_mode("        -1\n  0.00000E+00  0.00000E+00  1.00000E+00\n").as_bytes(),
    );
    let error = error.expect_err("no node");
    assert!(
        matches!(&error, FileError::DeckLine { line: 11, reason, .. } if reason.starts_with("\"-1\" is not")),
        "{error}"
    );
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

#[test]
fn directions_that_are_zero_in_all_modes_are_no_sensors() {
    let still = "         7\n  0.00000E+00  0.00000E+00  0.00000E+00\n";
    let moves = "         7\n  0.00000E+00  2.00000E+00  0.00000E+00\n";
    let root = TIP.replace('1', "0").replace("02\n", "12\n");
    let data = parsed(&(real_mode(&(TIP.to_owned() + still)) + &real_mode(&(root + moves))));
    let sensors = data
        .sensors
        .iter()
        .map(|s| (s.name.as_str(), s.grid, s.direction))
        .collect_vec();
    assert_eq!(sensors, [("7 y", Some(7), 1), ("12 z", Some(12), 2)]);
    assert_eq!(data.shapes, dmatrix![0.0, 2.0; 1.0, 0.0]);
}

#[test]
fn nodes_may_be_given_again_at_their_place_and_nowhere_else() {
    let node = |x: &str| {
        dataset(
            "15",
            &format!("        12         0         0         0{x:>13}  2.00000E+00  3.00000E+00\n"),
        )
    };
    let data = parsed(&(node("1.00000E+00") + &node("1.0") + &real_mode(TIP)));
    assert_eq!(data.sensors[0].place, Some(Vector3::new(1.0, 2.0, 3.0)));
    let error = read("wing.unv", (node("1.0") + &node("1.5")).as_bytes()).expect_err("two places");
    assert!(
        matches!(&error, FileError::DeckLine { line: 7, reason, .. } if reason == "node 12 was given at another place before"),
        "{error}"
    );
    let error =
        read("wing.unv", real_mode(&TIP.repeat(2)).as_bytes()).expect_err("twice in a mode");
    assert!(
        matches!(&error, FileError::DeckLine { line: 14, reason, .. } if reason == "node 12 is in this mode twice"),
        "{error}"
    );
}

#[test]
fn datasets_55_that_are_no_modes_are_passed_over_and_named() {
    let other = [
        [1, 1, 2, 8, 2, 3], // static
        [1, 5, 2, 8, 5, 3], // frequency response
        [1, 2, 4, 2, 2, 6], // stress of a mode
        [1, 2, 2, 9, 2, 3], // its reactions
    ];
    let other: String = other
        .into_iter()
        .map(|codes| mode(codes, "  1.25000E+01", TIP))
        .collect();
    let data = parsed(&(other + &real_mode(TIP)));
    assert_eq!((data.skipped, data.frequencies_hz), (vec![55], vec![12.5]));
}

#[test]
fn trace_lines_lift_the_pen_at_zero_and_go_on_over_lines() {
    let header = |count: usize| format!("         1{count:10}         0\nwing\n");
    let row = |nodes: &[usize]| {
        nodes
            .iter()
            .map(|node| format!("{node:10}"))
            .collect::<String>()
            + "\n"
    };
    let body = header(11)
        + &row(&[1, 2, 0, 3, 4, 5, 0, 0])
        + &row(&[6, 7, 1])
        + &header(2)
        + &row(&[8, 9]);
    let data = parsed(&(dataset("82", &body) + &real_mode(TIP)));
    assert_eq!(data.lines, [[1, 2], [3, 4], [4, 5], [6, 7], [7, 1], [8, 9]]);
}

#[test]
fn units_without_words_are_the_code() {
    let factors =
        "   1.0000000000000000D+00   1.0000000000000000D+00   1.0000000000000000D+00\n   0.0D+00\n";
    let of = |record: &str| {
        parsed(&(dataset("164", &format!("{record}\n{factors}")) + &real_mode(TIP))).units
    };
    assert_eq!(
        of("         7Inch (pound f)               2").as_deref(),
        Some("Inch (pound f)")
    );
    assert_eq!(of("         7").as_deref(), Some("7"));
    assert_eq!(parsed(&real_mode(TIP)).units, None);
}

/// Line, expectation and finding for every fault.
#[test]
fn faults_are_named_by_line_with_what_is_expected() {
    let good = real_mode(TIP);
    let cut = |lines: usize| good.split_inclusive('\n').take(lines).collect::<String>();
    let cases = [
        (cut(1), 2, "the number of a dataset", "the file ends"),
        (
            cut(5),
            6,
            "the dataset's last line, -1 in columns 5 and 6",
            "the file ends",
        ),
        (
            cut(12),
            13,
            "the dataset's last line, -1 in columns 5 and 6",
            "the file ends",
        ),
        (cut(5) + "    -1\n", 6, "five lines", "the dataset ends"),
        (
            cut(11) + "    -1\n",
            12,
            "a mode's values",
            "the dataset ends",
        ),
        (format!("-1\n{good}"), 1, "the mark of a dataset", "-1"),
        (
            good.replace("    55", "   5x5"),
            2,
            "the number of a dataset",
            "5x5",
        ),
        (
            good.replace("1.00000E+00\n", "1.00000F+00\n"),
            12,
            "a mode's values",
            "1.00000F+00",
        ),
        (
            good.replace("1.00000E+00\n", "NaN\n"),
            12,
            "a mode's values",
            "NaN",
        ),
        (
            good.replace("  1.00000E+00\n", "\n"),
            12,
            "a mode's values",
            "0.00000E+00  0.00000E+00",
        ),
        (
            good.replace("1.25000E+01", "-.25000E+01"),
            10,
            "a frequency, zero of a rigid-body mode",
            "-2.5",
        ),
        (
            good.replace("1.25000E+01", "-.00001E+00"),
            10,
            "a frequency, zero of a rigid-body mode",
            "-0.00001",
        ),
        (
            good.replace("        12\n", "      12.5\n"),
            11,
            "the number of a node",
            "12.5",
        ),
        (
            mode([1, 2, 2, 8, 2, 6], "1.0", TIP),
            8,
            "three or six values",
            "characteristic 2, 6 values of type 2",
        ),
        (
            mode([1, 2, 2, 8, 3, 3], "1.0", TIP),
            8,
            "three or six values",
            "characteristic 2, 3 values of type 3",
        ),
    ];
    for (text, at, wanted, there) in cases {
        let error = read("wing.unv", text.as_bytes()).expect_err(&text);
        let FileError::DeckLine { file, line, reason } = &error else {
            panic!("{error}")
        };
        assert_eq!((file.as_str(), *line), ("wing.unv", at), "{error}\n{text}");
        assert!(reason.contains(wanted) && reason.contains(there), "{error}");
    }
    for nothing in [
        real_mode(&TIP.replace('1', "0").replace("02\n", "12\n")),
        real_mode(""),
    ] {
        assert!(
            matches!(
                read("wing.unv", nothing.as_bytes()),
                Err(FileError::Method(_))
            ),
            "{nothing}"
        );
    }
}

/// A node that some mode leaves out was not measured there. Zero would be a measurement.
#[test]
fn a_sensor_that_some_mode_leaves_out_is_left_out_of_the_test_and_named() {
    let both = TIP.to_owned() + "         7\n  0.00000E+00  2.00000E+00  0.00000E+00\n";
    let data = parsed(&(real_mode(&both) + &real_mode(TIP)));
    assert_eq!(data.incomplete, ["7 y"]);
    assert_eq!((data.sensors.len(), data.shapes), (1, dmatrix![1.0, 1.0]));
    assert_eq!(parsed(&real_mode(&both).repeat(2)).incomplete, [""; 0]);
    // Six values a node in one mode and three in the other.
    let six = mode(
        [1, 2, 3, 8, 2, 6],
        "  1.25000E+01",
        "        12\n  0.00000E+00  0.00000E+00  1.00000E+00  0.00000E+00  3.00000E+00  0.00000E+00\n",
    );
    assert_eq!(parsed(&(six + &real_mode(TIP))).incomplete, ["12 ry"]);
    let apart = real_mode(TIP) + &real_mode(&TIP.replace("12", " 7"));
    let error = read("wing.unv", apart.as_bytes()).expect_err("nothing is in both");
    assert_eq!(
        error.to_string(),
        "wing.unv: no node and direction is in every mode; remove the modes with other nodes"
    );
}

#[test]
fn a_file_without_modes_is_told_which_datasets_it_has() {
    let static_case = mode([1, 1, 2, 8, 2, 3], "  1.25000E+01", TIP);
    let text = dataset("151", "") + &static_case + &dataset("58", "x\n") + &dataset("58", "x\n");
    let error = read("wing.unv", text.as_bytes()).expect_err("no modes");
    assert_eq!(
        error.to_string(),
        "wing.unv: no mode shapes; they are in datasets 55 or 2414, and this file has 55 of other data than modes at nodes, 58, 151"
    );
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
    let close =
        |a: f64, b: f64| assert!((a - b).abs() <= UNIVERSAL_ROUNDING * b.abs(), "{a} for {b}");
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
