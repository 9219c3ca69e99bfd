//! Lines that can be cut in two ways, and the forms in which other programs write what is one thing: read as what they say, or refused.

use super::test_data_universal::real_mode;
use crate::common::jobs::said;
use crate::prelude::*;

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

#[test]
fn a_table_says_its_encoding_and_its_modes() {
    let text = "name;direction;mode 7;mode 8\nfrequency_hz;;1,5;2,5\na;z;1;2\n";
    let data = read("test.csv", text.as_bytes()).unwrap();
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
        assert!(
            crate::prelude::said(read("test.csv", bytes)).contains(what),
            "{what}"
        );
    }
}

/// A rigid-body mode of the test is left out, said, and refused where the job names it; the others keep their numbers.
#[test]
fn rigid_modes_of_a_test_are_left_out_and_said() {
    let mut files = building();
    let without = finished(&prepared(&files));
    let text = file(&mut files, "test.csv");
    let lines = text.lines().zip(["0", "mode 6", "1", "1", "1", "1", "1"]);
    *text = lines
        .map(|(line, last)| format!("{line},{last}\n"))
        .collect();
    let found = finished(&prepared(&files));
    assert_eq!(found.found.factors, without.found.factors);
    assert_eq!(about(&found.trust, "rigid-modes"), ["6"]);
    let named = said(&with(files, "job.toml", "[test]", "[test]\nmodes = [1, 6]"));
    assert!(named.contains("mode 6 has a frequency of 0 Hz"), "{named}");
}

/// The factors are those by the matrix of a part.
#[test]
fn a_parameter_may_be_a_second_whole_matrix() {
    let factors = |files: &Files| finished(&prepared(files)).found.factors;
    let mut files = building();
    let expected = factors(&files);
    let mut of = |name: &str| {
        let found = matrices::read("K", file(&mut files, name).as_bytes(), None);
        found.unwrap().matrix.dense()
    };
    let (whole, part) = (of("stiffness.mtx"), of("story_1.mtx"));
    for at in [1.1, 0.5] {
        let rule = format!("stiffness = \"second.mtx\"\nat = {at:?}");
        let mut files = with(files.clone(), "job.toml", "matrix = \"story_1.mtx\"", &rule);
        let second = sparse(&(&whole + (at - 1.0) * &part)).unwrap();
        files.push(("second.mtx".to_owned(), write_matrix_market(&second)));
        assert_alike(factors(&files), &expected, 100.0 * MATRIX_ROUND_OFF);
    }
}
