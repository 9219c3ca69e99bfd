//! Lines that can be cut in two ways, and the forms in which other programs write what is one thing: read as what they say, or refused.

use super::test_data_axes::{node, system};
use super::test_data_universal::{dataset, parsed, real_mode};
use crate::common::jobs::run;
use crate::common::jobs::said;
use crate::prelude::*;

fn table(text: &str) -> TestData {
    read("test.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refused(text: impl AsRef<[u8]>) -> String {
    read("test.csv", text.as_ref())
        .expect_err("two readings")
        .to_string()
}

properties! {
    /// Numbers in columns of any width, with an exponent of any form, touching or apart, are those that were written, or are refused.
    #[test]
    fn numbers_of_any_width_are_read_back_or_refused(
        values in prop::collection::vec((-1.0..1.0_f64, -30..30_i32), 3),
        (width, digits) in (8..31_usize).prop_flat_map(|width| (Just(width), 0..width - 6)),
        letter in prop::sample::select(vec!["E", "D", "e", "d"]),
    ) {
        let written = values
            .iter()
            .map(|(mantissa, exponent)| format!("{mantissa:.digits$}{letter}{exponent:+03}"))
            .collect_vec();
        let line: String = written.iter().map(|word| format!("{word:>width$}")).collect();
        let text = real_mode(&format!("        12\n{line}\n"));
        if let Ok(data) = read("wing.unv", text.as_bytes()) {
            let found = data.shapes.iter().copied().collect_vec();
            let meant = written.iter().map(|word| word.to_lowercase().replace('d', "e").parse::<f64>().unwrap());
            // A direction that is zero in every mode is no sensor.
            let meant = meant.filter(|value| *value != 0.0).collect_vec();
            prop_assert_eq!(found, meant, "{}", text);
        }
    }
}

/// Numbers that touch are those of their columns, unless a column ends within one of them.
#[test]
fn columns_that_cut_a_number_are_refused() {
    let read_as = |line: &str| {
        read(
            "wing.unv",
            real_mode(&format!("        12\n{line}\n")).as_bytes(),
        )
    };
    for (line, found) in [
        (
            "-1.000000E+00-2.000000E+00-3.000000E+00",
            [-1.0, -2.0, -3.0],
        ),
        ("1.0000000E+001.2500000D-013.0000000E+00", [1.0, 0.125, 3.0]),
    ] {
        assert_eq!(read_as(line).unwrap().shapes.as_slice(), found, "{line}");
    }
    for line in [
        // Three numbers of 26 columns are six of 13.
        "-0.6843851563267933091d+00-0.5000000000000000000d+00-0.2500000000000000000d+00",
        // The last digit of an exponent stands in the second column.
        "1.23456789E+00            2.0",
    ] {
        assert!(read_as(line).is_err(), "{line}");
    }
}

/// A sensor whose motion is along the directions of a cylindrical system at 30 degrees of its place.
#[test]
fn cylindrical_axes_of_a_test_turn_with_the_angle() {
    let cylinder = system(3, 1, 0, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    let text = dataset("18", &cylinder) + &dataset("15", &node(12, [3, 3], [2.0, 30.0, 5.0]));
    let values = "        12\n  1.00000E+00  1.00000E+00  1.00000E+00\n";
    let data = parsed(&(text + &real_mode(values)));
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    for (sensor, axis) in data.sensors.iter().zip([
        Vector3::new(cosine, sine, 0.0),
        Vector3::new(-sine, cosine, 0.0),
        Vector3::z(),
    ]) {
        assert!((sensor.axis.unwrap() - axis).amax() < ROUND_OFF);
        let place = sensor.place.unwrap() - Vector3::new(2.0 * cosine, 2.0 * sine, 5.0);
        assert!(place.amax() < ROUND_OFF);
    }
}

#[test]
fn a_table_says_its_encoding_and_its_modes() {
    let text = "name;direction;mode 7;mode 8\nfrequency_hz;;1,5;2,5\na;z;1;2\n";
    let data = table(text);
    assert_eq!(
        (data.frequencies_hz.as_slice(), data.numbers.as_slice()),
        (&[1.5, 2.5][..], &[7, 8][..])
    );
    for order in [u16::to_le_bytes, u16::to_be_bytes] {
        let units = once(0xfeff).chain(text.encode_utf16());
        let bytes = units.flat_map(order).collect_vec();
        assert_eq!(read("test.csv", &bytes).unwrap(), data);
    }
    for (bytes, what) in [
        (&[0x1f, 0x8b, 8, 0][..], "is compressed by gzip"),
        (b"PK\x03\x04..", "is an archive"),
        (b"name\0direction", "is binary"),
    ] {
        assert!(refused(bytes).contains(what), "{what}");
    }
}

/// A rigid-body mode of the test is left out, said, and refused where the job names it; the others keep their numbers.
#[test]
fn rigid_modes_of_a_test_are_left_out_and_said() {
    let measured = building();
    let text = &measured.iter().find(|file| file.0 == "test.csv").unwrap().1;
    // The rows above the header have a number a mode and nothing else.
    let with_rigid = text.lines().map(|line| {
        let last = match line.split(',').next().unwrap() {
            _ if line.contains("mode 1") => "mode 6",
            "frequency_hz" => "0",
            _ => "1",
        };
        format!("{line},{last}\n")
    });
    let with_rigid: String = with_rigid.collect();
    let with_rigid = with(measured.clone(), "test.csv", text, &with_rigid);
    let (_folder, path) = placed(&with_rigid);
    let found = run(&prepare(&path).unwrap(), |_| {}, || true).unwrap();
    let (_folder, path) = placed(&measured);
    let without = run(&prepare(&path).unwrap(), |_| {}, || true).unwrap();
    assert_eq!(found.found.factors, without.found.factors);
    assert_eq!(about(&found.trust, "rigid-modes"), ["6"]);
    let named = with(
        with_rigid,
        "job.toml",
        "\"test.csv\"",
        "\"test.csv\"\nmodes = [1, 6]",
    );
    assert!(
        said(&named).contains("mode 6 has a frequency of 0 Hz"),
        "{}",
        said(&named)
    );
}

fn matrix(text: &str, wanted: Option<&str>) -> Result<DMatrix<f64>, String> {
    let found = matrices::read("K", text.as_bytes(), wanted);
    found
        .map(|found| found.matrix.dense())
        .map_err(|error| error.to_string())
}

/// The stiffness of the building with its first story `at` times as stiff.
fn with_second(at: f64, digits: usize) -> Files {
    let files = building();
    let of = |name: &str| {
        let text = &files.iter().find(|file| file.0 == name).unwrap().1;
        matrix(text, None).unwrap()
    };
    let second = of("stiffness.mtx") + (at - 1.0) * of("story_1.mtx");
    let mut text = "%%MatrixMarket matrix array real general\n10 10\n".to_owned();
    second
        .iter()
        .for_each(|value| text += &format!("{value:.digits$e}\n"));
    let rule = format!("stiffness = \"second.mtx\"\nat = {at:?}");
    let mut files = with(files, "job.toml", "matrix = \"story_1.mtx\"", &rule);
    files.push(("second.mtx".to_owned(), text));
    files
}

#[test]
fn a_parameter_may_be_a_second_whole_matrix() {
    let factors = |files: &Files| {
        let prepared = prepared(files);
        finished(&prepared).found.factors
    };
    let expected = factors(&building());
    for at in [1.1, 0.5] {
        for (found, expected) in factors(&with_second(at, 16)).iter().zip(&expected) {
            assert!(
                relative_error(found, expected) < 100.0 * MATRIX_ROUND_OFF,
                "{found} {expected}"
            );
        }
    }
    let same = said(&with_second(1.000_000_1, 3));
    assert!(
        same.contains("the digits of the files do not tell the matrix at 1.0000001"),
        "{same}"
    );
    for at in ["1.0", "-2.0"] {
        let error = said(&with(
            with_second(1.1, 16),
            "job.toml",
            "at = 1.1",
            &format!("at = {at}"),
        ));
        assert!(
            error.contains("must be positive and another factor than one"),
            "{error}"
        );
    }
    let without = said(&with(with_second(1.1, 16), "job.toml", "at = 1.1", ""));
    assert!(
        without.contains("needs a matrix, or a whole stiffness or mass with the factor at"),
        "{without}"
    );
}

#[test]
fn a_number_sign_may_be_part_of_a_files_name() {
    let mut files = with(building(), "job.toml", "\"stiffness.mtx\"", "\"run#3.mtx\"");
    let found = files
        .iter_mut()
        .find(|file| file.0 == "stiffness.mtx")
        .unwrap();
    found.0 = "run#3.mtx".to_owned();
    let (_folder, path) = placed(&files);
    assert!(prepare(&path).is_ok());
    // The whole name comes first.
    files.push(("run".to_owned(), String::new()));
    let (_folder, path) = placed(&files);
    assert!(prepare(&path).is_ok());
}

#[test]
fn frequencies_alone_need_no_names_of_rows() {
    let frequencies = "mode 1,mode 2\nfrequency_hz,1.1,3.3\n".replace("mode 1", ",mode 1");
    let (old, _) = (building(), ());
    let text = old
        .iter()
        .find(|file| file.0 == "test.csv")
        .unwrap()
        .1
        .clone();
    let files = with(
        with(old, "test.csv", &text, &frequencies),
        "job.toml",
        "rows = \"rows.csv\"\n",
        "",
    );
    let prepared = prepared(&files);
    assert_eq!(prepared.loaded.alone.len(), 2);
    let named = with(building(), "job.toml", "rows = \"rows.csv\"\n", "");
    assert!(
        said(&named).contains("model.rows is missing"),
        "{}",
        said(&named)
    );
}
