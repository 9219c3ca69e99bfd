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
