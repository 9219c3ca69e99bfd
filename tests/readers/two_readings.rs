//! Lines that can be cut in two ways, and the forms in which other programs write what is one thing: read as what they say, or refused.

use super::test_data_axes::{node, system};
use super::test_data_universal::{TIP, dataset, parsed, real_mode};
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

#[test]
fn columns_of_other_widths_are_refused_by_their_line() {
    let text = real_mode(TIP).replace("  1.25000E+01  0.00000E+00", "  7.351612E-01  1.000000E+00");
    let error = read("wing.unv", text.as_bytes())
        .expect_err("two readings")
        .to_string();
    assert!(
        error.starts_with("wing.unv, line 10: ") && error.contains("other numbers between blanks"),
        "{error}"
    );
}

#[test]
fn text_between_datasets_is_a_remark() {
    let between = format!(
        "{}Workpiece of May\n-1 is no mark here\n{}",
        dataset("151", ""),
        real_mode(TIP)
    );
    assert_eq!(
        parsed(&between),
        parsed(&(dataset("151", "") + &real_mode(TIP)))
    );
}

#[test]
fn places_of_two_datasets_agree_or_are_refused() {
    let fine = |x: f64| {
        dataset(
            "2411",
            &format!(
                "{:10}{:10}{:10}{:10}\n{x:25.16E}{:25.16E}{:25.16E}\n",
                12, 0, 0, 11, 2.0, 3.0
            ),
        )
    };
    let coarse = dataset("15", &node(12, [0, 0], [1.23457, 2.0, 3.0]));
    let place = |text: String| parsed(&(text + &real_mode(TIP))).sensors[0].place;
    for text in [
        coarse.clone() + &fine(1.234_567_89),
        fine(1.234_567_89) + &coarse,
    ] {
        assert_eq!(place(text), Some(Vector3::new(1.234_567_89, 2.0, 3.0)));
    }
    let text = coarse + &fine(1.2347) + &real_mode(TIP);
    let error = read("wing.unv", text.as_bytes())
        .expect_err("two places")
        .to_string();
    assert!(
        error.contains("node 12 was given at another place before"),
        "{error}"
    );
}

/// Dataset 55 in double precision, three numbers of 25 columns a line.
#[test]
fn values_of_double_precision_keep_their_digits() {
    let value = 0.123_456_789_012_345_6;
    let double = real_mode(TIP)
        .replace(
            "         8         2         3",
            "         8         4         3",
        )
        .replace(
            "  0.00000E+00  0.00000E+00  1.00000E+00\n",
            &format!("{value:25.16E}{:25.16E}{:25.16E}\n", 2.0, 3.0),
        );
    assert_eq!(parsed(&double).shapes, dmatrix![value; 2.0; 3.0]);
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

const ROWS: &str = "name,direction,mode 1,mode 2\nfrequency_hz,,1.5,2.5\n";

#[test]
fn a_row_below_the_header_may_be_a_sensor_with_a_number_sign() {
    let names = |text: &str| {
        let sensors = table(&(ROWS.to_owned() + text)).sensors.into_iter();
        sensors.map(|sensor| sensor.name).collect_vec()
    };
    assert_eq!(names("#1,z,1.,2.\n#2,z,3.,4.\n"), ["#1", "#2"]);
    assert_eq!(
        names("a,z,1.,2.\n# left out on Monday\n##b,z,1.,2.\n\"#2\",z,3.,4.\n"),
        ["a", "#2"]
    );
    let error = refused(ROWS.to_owned() + "a,z,1.,2.\n#2,z,3.,4.\n");
    assert!(
        error.starts_with("test.csv, line 4: \"#2\" may be a comment or a sensor"),
        "{error}"
    );
}

#[test]
fn a_table_names_its_separator_its_encoding_and_its_modes() {
    let text = "sep=;\nname;direction;mode 7;mode 8\nfrequency_hz;;1,5;2,5\na;z;1;2\n";
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

#[test]
fn directions_are_known_by_other_names() {
    let found = |word: &str| {
        let data = table(&format!("{ROWS}a,{word},1.,2.\n"));
        (data.sensors[0].direction, data.shapes[(0, 0)])
    };
    for (word, direction, sign) in [
        ("z", 2, 1.0),
        ("-z", 2, -1.0),
        ("+Z", 2, 1.0),
        ("3", 2, 1.0),
        ("-3", 2, -1.0),
        ("UZ", 2, 1.0),
        ("-ux", 0, -1.0),
        ("RY", 4, 1.0),
        ("5", 4, 1.0),
    ] {
        assert_eq!(found(word), (direction, sign), "{word}");
    }
    for word in ["7", "0", "--z", "uw", "urx2", ""] {
        assert!(
            refused(format!("{ROWS}a,{word},1.,2.\n")).contains("is not a direction")
                || word.is_empty(),
            "{word}"
        );
    }
    let both = ROWS
        .replace("direction", "direction,sign")
        .replace("hz,,", "hz,,,");
    let error = refused(both + "a,-z,-,1.,2.\n");
    assert!(
        error.contains("empty, where the direction has a sign"),
        "{error}"
    );
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
    assert_eq!(found.trust.about(Kind::RigidModes), ["6"]);
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

#[test]
fn a_symmetric_matrix_has_one_triangle_or_two_that_agree() {
    let market = |kind: &str, entries: &str| {
        let count = entries.lines().count();
        matrix(
            &format!("%%MatrixMarket matrix coordinate {kind}\n2 2 {count}\n{entries}\n"),
            None,
        )
    };
    let expected = Ok(dmatrix![2.0, -1.0; -1.0, 3.0]);
    for (kind, entries) in [
        ("real symmetric", "1 1 2\n2 1 -1\n2 2 3"),
        ("real symmetric", "1 1 2\n1 2 -1\n2 2 3"),
        ("double symmetric", "1 1 2\n1 2 -1\n2 1 -1\n2 2 3"),
        ("complex hermitian", "1 1 2 0\n2 1 -1 0.0\n2 2 3 0"),
        ("complex general", "1 1 2 0\n2 1 -1 0\n1 2 -1 0\n2 2 3 0"),
    ] {
        assert_eq!(market(kind, entries), expected, "{kind}: {entries}");
    }
    assert_eq!(
        market("unsigned-integer general", "1 1 2"),
        Ok(dmatrix![2.0, 0.0; 0.0, 0.0])
    );
    let error = market("real symmetric", "1 1 2\n1 2 -1\n2 1 -2\n2 2 3").expect_err("two values");
    assert!(
        error.contains("entries (1, 2) and (2, 1) of a symmetric matrix differ"),
        "{error}"
    );
}

#[test]
fn abaqus_labels_name_the_rows() {
    let lower =
        "** by labels\n*MATRIX, TYPE=STIFFNESS\n7,1, 7,1, 2.0\n7,3, 7,1, -1.0e0\n7,3, 7,3, 3.\n";
    let both = "7,1, 7,1, 2.0\n7,1, 7,3, -1.\n7,3, 7,1, -1.0\n7,3, 7,3, 3.\n";
    for text in [lower, both] {
        let found = matrices::read("K", text.as_bytes(), None).unwrap();
        assert_eq!(found.matrix.dense(), dmatrix![2.0, -1.0; -1.0, 3.0]);
        let rows = found
            .rows
            .unwrap()
            .iter()
            .map(|label| (label.grid, label.component))
            .collect_vec();
        assert_eq!(rows, [(7, 1), (7, 3)]);
    }
    let error = matrix(&lower.replace("7,3, 7,3", "0,3, 7,3"), None).expect_err("no node");
    assert!(
        error.starts_with("K, line 5: \"0,3, 7,3, 3.\" is not an entry of five cells"),
        "{error}"
    );
    let error = matrix(&both.replace("7,1, -1.0", "7,1, -1.5"), None).expect_err("two values");
    assert!(
        error.contains("node 7, component 1 with node 7, component 3"),
        "{error}"
    );
}

#[test]
fn dmig_is_read_by_its_own_cards_alone() {
    let own = "DMIG,K,0,6,1,0\nDMIG,K,7,1,,7,1,2.\nDMIG,K,8,1,,7,1,-1.,,+A\n+A,8,1,3.\n";
    let expected = Ok(dmatrix![2.0, -1.0; -1.0, 3.0]);
    assert_eq!(matrix(own, None), expected);
    let punched = format!(
        "$TITLE = A\n         1       G      1.0E+00\n-CONT-                  2.0E+00\nBEGIN BULK\nGRID,1\nENDDATA\n{own}$EIGENVECTOR\n"
    );
    assert_eq!(matrix(&punched, None), expected);
}

/// OUTPUT4 with integers of sixteen columns and exponents of three digits, and two matrices of one name.
#[test]
fn output4_is_read_in_its_wider_forms() {
    let of = |width: usize, format: &str, first: f64| {
        let integers = |all: &[i64]| {
            all.iter()
                .map(|n| format!("{n:width$}"))
                .collect::<String>()
                + "\n"
        };
        let number = |value: f64| {
            let written = format!("{value:.9e}");
            let (mantissa, exponent) = written.split_once('e').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            format!("{:>20}", format!("{mantissa}E{exponent:+04}"))
        };
        let head: String = [2, 2, 2, 2].iter().map(|n| format!("{n:width$}")).collect();
        head + &format!("{:<8}1P,{format}\n", "KAA")
            + &integers(&[1, 1, 2])
            + &(number(first) + &number(-1.0) + "\n")
            + &integers(&[2, 1, 2])
            + &(number(-1.0) + &number(3e-100) + "\n")
            + &integers(&[3, 1, 1])
            + &(number(1.0) + "\n")
    };
    for (width, format) in [(8, "4E20.9"), (16, "4E20.9"), (16, "4E20.9E3")] {
        let one = of(width, format, 2.0);
        assert_eq!(
            matrix(&one, None),
            Ok(dmatrix![2.0, -1.0; -1.0, 3e-100]),
            "{format}"
        );
        let two = one + &of(width, format, 5.0);
        assert_eq!(
            matrix(&two, Some("KAA@2")),
            Ok(dmatrix![5.0, -1.0; -1.0, 3e-100])
        );
        let error = matrix(&two, Some("KAA")).expect_err("two of them");
        assert!(
            error.contains("there are 2 matrices KAA; name one KAA@1 or KAA@2"),
            "{error}"
        );
        assert!(matrix(&two, Some("KAA@3")).is_err());
    }
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
        let (_folder, path) = placed(files);
        let prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
        run(&prepared, |_| {}, || true).unwrap().found.factors
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
    let text = files[0].1.clone();
    files.push(("run".to_owned(), text));
    assert!(
        said(&files).contains("run#3.mtx may be a file or a matrix of run"),
        "{}",
        said(&files)
    );
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
    let (_folder, path) = placed(&files);
    let prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(prepared.alone().len(), 2);
    let named = with(building(), "job.toml", "rows = \"rows.csv\"\n", "");
    assert!(
        said(&named).contains("model.rows is missing"),
        "{}",
        said(&named)
    );
}
