//! The table of a test: the layout that its documentation states, as spreadsheets vary it, and its faults.

use crate::prelude::*;

/// The example of the documentation.
const WING: &str = "# Wing test of 3 May, soft suspension
frequency_hz,,,,,,,12.1,17.9
frequency_deviation,,,,,,,0.003,0.005
name,grid,direction,sign,x,y,z,mode 1,mode 2
tip,12,z,-,0.,52.5,3.1,-1.0,0.31
\"aileron, outer\",14,z,+,8.,48.,3.1,0.87,-0.55
";

fn wing(text: &str) -> TestData {
    read("wing.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn the_documented_example_reads() {
    let data = wing(WING);
    assert_eq!(data.frequencies_hz, [12.1, 17.9]);
    assert_eq!(data.frequency_deviation, Some(vec![0.003, 0.005]));
    assert_eq!(
        (data.shape_deviation, data.phase_collinearity, data.units),
        (None, vec![], None)
    );
    assert_eq!(
        data.shapes,
        dmatrix![1.0, -0.31; 0.87, -0.55],
        "a sensor against its axis has its sign turned"
    );
    let names = data
        .sensors
        .iter()
        .map(|sensor| (sensor.name.as_str(), sensor.grid, sensor.direction))
        .collect_vec();
    assert_eq!(
        names,
        [("tip", Some(12), 2), ("aileron, outer", Some(14), 2)]
    );
    assert_eq!(data.sensors[0].place, Some(Vector3::new(0.0, 52.5, 3.1)));
    let source = include_str!("../../src/files/test_data/csv.rs");
    let documented = source
        .lines()
        .filter_map(|line| line.strip_prefix("//! "))
        .collect_vec();
    assert!(
        documented.join("\n").contains(WING.trim_end()),
        "the documentation has this example"
    );
}

#[test]
fn spreadsheets_may_separate_by_semicolons_or_tabs_and_write_decimal_commas() {
    let expected = wing(WING);
    // The comment's comma stays, and so does that within quotation marks.
    let converted = |separator: &str| {
        let text = WING.replace(',', separator);
        text.replace(&format!("aileron{separator}"), "aileron,")
            .replace(&format!("May{separator}"), "May,")
    };
    assert_eq!(wing(&converted(";")), expected);
    assert_eq!(wing(&converted("\t")), expected);
    assert_eq!(wing(&converted(";").replace('.', ",")), expected);
    assert_eq!(wing(&WING.replace('\n', "\r\n")), expected);
    assert_eq!(wing(&format!("\u{feff}{WING}")), expected);
    assert_eq!(
        wing(
            &WING
                .replace("# Wing", "\"# Wing")
                .replace("suspension", "suspension\",,")
        ),
        expected
    );
    assert_eq!(
        wing(
            &WING
                .replace("name,grid", "Name, GRID ")
                .replace("tip", "\n,,,,,,,,\ntip")
        ),
        expected
    );
    // Latin-1, as old spreadsheets write.
    let latin = WING
        .replace("tip", "fl\u{fc}gel")
        .chars()
        .map(|c| c as u8)
        .collect_vec();
    assert_eq!(
        read("wing.csv", &latin).unwrap().sensors[0].name,
        "fl\u{fc}gel"
    );
}

#[test]
fn columns_may_stand_in_any_order() {
    let data = wing("direction,mode 1,sign,mode 2,grid\nfrequency_hz,8.5,,9.5\nz,2,-,3,12\n");
    assert_eq!(data.frequencies_hz, [8.5, 9.5]);
    assert_eq!(data.shapes, dmatrix![-2.0, -3.0]);
    assert_eq!(data.sensors[0].grid, Some(12));
    let names =
        wing("frequency_hz,8.5\ndirection,mode 1,name\nz,1,\"tip\"\nz,2,\"the \"\"root\"\"\"\nz,3,\"\"\"pod\"\"\"\n")
            .sensors;
    let names = names
        .iter()
        .map(|sensor| sensor.name.as_str())
        .collect_vec();
    assert_eq!(
        names,
        ["tip", "the \"root\"", "\"pod\""],
        "quoted at the end of a line"
    );
}

#[test]
fn a_sensor_without_a_name_is_called_by_grid_and_direction() {
    let data = wing("frequency_hz,,8.5\ngrid,direction,mode 1\n\n7,ry,1e-3\n12,X,-2\n");
    let names = data
        .sensors
        .iter()
        .map(|sensor| sensor.name.as_str())
        .collect_vec();
    assert_eq!(names, ["7 ry", "12 x"]);
    assert_eq!(data.sensors[0].place, None);
    assert_eq!(data.shapes, dmatrix![1e-3; -2.0]);
}

/// Line, expectation and finding for every fault.
#[test]
fn faults_are_named_by_line_with_what_is_expected() {
    let cases = [
        (WING.replace("-1.0", "1..0"), 5, "a number", "1..0"),
        (
            WING.replace(",-1.0,0.31", ",-1.0"),
            5,
            "the row has 8 cells",
            "needs 9",
        ),
        (WING.replace("-1.0", "nan"), 5, "a number", "nan"),
        (WING.replace("-1.0", "\"1,234\""), 5, "a number", "1,234"),
        (WING.replace("17.9", "1e999"), 2, "a number", "1e999"),
        (
            WING.replace("12,z", "12,w"),
            5,
            "a direction x, y, z, rx, ry or rz",
            "w",
        ),
        (WING.replace("z,-", "z,down"), 5, "a sign + or -", "down"),
        (WING.replace("12,z", "-12,z"), 5, "a grid number", "-12"),
        (
            WING.replace("tip,12", ","),
            5,
            "a name or a grid number",
            "is missing",
        ),
        (
            WING.replace("0.,52.5", ",52.5"),
            5,
            "a number",
            "is missing",
        ),
        (
            WING.replace("\"aileron", "aileron"),
            6,
            "a quotation mark is not closed",
            "aileron, outer",
        ),
        (
            WING.replace("frequency_deviation", "frequency_hz"),
            3,
            "the second row",
            "frequency_hz",
        ),
        (WING.replace("x,y,z", "x,y,y"), 4, "once each", "y"),
        (
            WING.replace("mode 2", "comment"),
            4,
            "a title: name, grid",
            "comment",
        ),
        (
            WING.replace("x,y,z", "x,y,"),
            4,
            "all of x, y, z or none",
            "name grid",
        ),
        (
            WING.replace("direction", ""),
            4,
            "a header with direction",
            "name grid",
        ),
        (
            WING.replace("frequency_hz", "frequency"),
            2,
            "a title: name, grid",
            "frequency",
        ),
        (
            WING.lines().skip(2).collect_vec().join("\n"),
            4,
            "a row frequency_hz",
            "the file ends",
        ),
        (String::new(), 0, "a header", "the file ends"),
    ];
    for (text, at, wanted, there) in cases {
        let error = read("wing.csv", text.as_bytes()).expect_err(&text);
        let FileError::DeckLine { file, line, reason } = &error else {
            panic!("{error}")
        };
        assert_eq!((file.as_str(), *line), ("wing.csv", at), "{error}\n{text}");
        assert!(reason.contains(wanted) && reason.contains(there), "{error}");
    }
    let twice =
        read("wing.csv", WING.replace("14,z", "12,z").as_bytes()).expect_err("a sensor twice");
    assert!(twice.to_string().contains("sensor z 12"), "{twice}");
}

/// Such as decimal commas between commas, which put every number into the next column.
#[test]
fn a_row_longer_or_shorter_than_the_header_is_an_error_with_its_column() {
    let said = |text: &str| {
        read("wing.csv", text.as_bytes())
            .expect_err(text)
            .to_string()
    };
    let stray = |line, column, cell| {
        format!(
            "wing.csv, line {line}: column {column}: \"{cell}\" stands where nothing belongs; decimal commas need semicolons or tabs \
             between cells"
        )
    };
    let commas = WING.replace("12.1,17.9", "12,1,17,9");
    assert_eq!(said(&commas), stray(2, 10, "17"));
    assert_eq!(said(&WING.replace("-0.55", "-0.55,,7")), stray(6, 11, "7"));
    let untitled = WING
        .replace("sign,x", "sign,,x")
        .replace("z,-", "z,-,soft")
        .replace("z,+", "z,+,");
    assert_eq!(
        said(
            &untitled
                .replace("z,,,,,,,", "z,,,,,,,,")
                .replace("n,,,,,,,", "n,,,,,,,,")
        ),
        stray(5, 5, "soft")
    );
    assert_eq!(
        said(&WING.replace("0.87,-0.55", "0.87")),
        "wing.csv, line 6: the row has 8 cells and needs 9"
    );
    assert_eq!(
        said(&WING.replace("12.1,17.9", "12.1")),
        "wing.csv, line 2: the row has 8 cells and needs 9"
    );
    // A number above a sensor's grid or name belongs to no mode.
    let shifted = WING.replace("frequency_hz,,,,,,,", "frequency_hz,,,,,,1.5,");
    assert_eq!(said(&shifted), stray(2, 7, "1.5"));
    // A spreadsheet fills all rows to one length.
    let filled = WING
        .lines()
        .map(|line| format!("{line},,\n"))
        .collect::<String>();
    assert_eq!(wing(&filled), wing(WING));
}

#[test]
fn a_column_of_deviations_belongs_to_the_mode_of_its_number() {
    let text = "deviation 2,direction,mode 1,grid,mode 2,mode 3\nfrequency_hz,,8.5,,9.5,10.5\n0.01,z,2,12,-3,\n0.5,z,1,13,1,\n";
    let data = wing(text);
    assert_eq!(data.shapes.column(1).as_slice(), [-3.0, 1.0]);
    let own = data
        .component_deviation
        .iter()
        .map(|(mode, own)| (*mode, own.as_slice()))
        .collect_vec();
    assert_eq!(own, [(1, &[0.01, 0.5][..])]);
    // Of a mode without a shape it is not read.
    let alone = wing(&text.replace("deviation 2", "Deviation 3"));
    assert!(alone.component_deviation.is_empty());
    let said = |old: &str, new: &str| {
        let text = text.replace(old, new);
        read("wing.csv", text.as_bytes())
            .expect_err(&text)
            .to_string()
    };
    assert!(said("deviation 2", "deviation 0").contains("a column deviation 0, but no mode 0"));
    for wrong in ["deviation", "deviation two"] {
        assert!(said("deviation 2", wrong).contains("a title deviation with the number of a mode"));
    }
    assert!(said("grid,mode 2", "deviation 2,mode 2").contains("once each"));
    assert!(said("deviation 2", "deviation 4").contains("a column deviation 4, but no mode 4"));
    assert!(said("0.01", "").contains("line 3"));
    assert!(said("0.01", "0").contains("component deviation"));
    assert!(said("0.01", "-1").contains("component deviation"));
    assert!(said("hz,,8.5,,9.5", "hz,7,8.5,1,9.5").contains("where nothing belongs"));
}

#[test]
fn titles_of_modes_are_in_order_and_none_is_there_twice() {
    let said = |first: &str, second: &str| {
        let text = WING.replace("mode 1,mode 2", &format!("{first},{second}"));
        read("wing.csv", text.as_bytes()).map_err(|error| error.to_string())
    };
    let place = |column, title, place| {
        Err(format!(
            "wing.csv, line 4: column {column}: this is mode {place}, but its title is \"{title}\"; titles must differ and number \
             modes from left to right"
        ))
    };
    assert_eq!(said("mode 7", "mode 2"), place(9, "mode 2", 8));
    assert_eq!(said("Mode_2", "Mode_1"), place(9, "Mode_1", 3));
    let numbers = |first, second| said(first, second).unwrap().numbers;
    assert_eq!(numbers("mode 7", "mode 8"), [7, 8]);
    assert_eq!(numbers("mode 1", "mode 2"), [0; 0]);
    assert_eq!(
        said("mode 1", "mode 3 (torsion)"),
        place(9, "mode 3 (torsion)", 2)
    );
    assert_eq!(said("mode 0", "mode 1"), place(8, "mode 0", 1));
    assert_eq!(said("Mode A", "mode a"), place(9, "mode a", 2));
    for titles in [
        ["mode1", "mode-2"],
        ["mode bending", "mode torsion 1"],
        ["Mode 1", "mode: 2, outer"],
    ] {
        let titles = titles.map(|title| format!("\"{title}\""));
        assert_eq!(said(&titles[0], &titles[1]), Ok(wing(WING)));
    }
}

#[test]
fn what_is_written_reads_back_as_it_was() {
    let expected = TestData {
        lines: Vec::new(),
        ..wing_test()
    };
    assert_eq!(wing(&write_csv(&expected)), expected);
    let mut strange = expected.clone();
    strange.sensors[0].name = "two\nlines".to_owned();
    assert_eq!(wing(&write_csv(&strange)).sensors[0].name, "two lines");
}

properties! {
    #[test]
    fn every_test_reads_back_from_its_table_to_the_last_digit(data in ground_test()) {
        prop_assert_eq!(wing(&write_csv(&data)), data);
    }
}
