//! The Universal File of shapes that a correlation leaves beside its report, as other programs read it.

use super::cli::text;
use super::cli_jobs::reported;
use crate::prelude::*;

/// Asserts that another program reads in the file of the building what this crate's reader does.
fn check(answer: &Value) {
    let file = &reported("building").files["shapes.unv"];
    let data = read("shapes.unv", file.as_bytes()).unwrap();
    assert_eq!(data.skipped, [0_usize; 0]);
    let near = |found: &Value, value: f64, what: &str| {
        let found = found.as_f64().expect(what);
        let apart = (found - value).abs();
        assert!(apart <= 2.0 * UNIVERSAL_ROUNDING, "{what}: {found} {value}");
    };
    for (mode, hertz) in data.frequencies_hz.iter().enumerate() {
        near(&answer["frequencies_hz"][mode], *hertz, "a frequency");
    }
    let mut moving = 0;
    for (row, sensor) in data.sensors.iter().enumerate() {
        let node = sensor.grid.unwrap().to_string();
        let place = sensor.place.unwrap();
        (0..3).for_each(|axis| near(&answer["nodes"][&node][axis], place[axis], "a place"));
        for mode in 0..data.frequencies_hz.len() {
            let value = &answer["shapes"][mode][&node][sensor.direction];
            near(value, data.shapes[(row, mode)], "a component");
            moving += 1;
        }
    }
    let shapes = answer["shapes"].as_array().unwrap().iter();
    let all = shapes.flat_map(|shape| shape.as_object().unwrap().values());
    let all = all.flat_map(|node| node.as_array().unwrap());
    assert_eq!(
        all.filter(|value| value.as_f64() != Some(0.0)).count(),
        moving
    );
    let line = answer["line"].as_array().unwrap();
    let line = line.iter().filter_map(Value::as_u64).collect_vec();
    let pairs: Vec<[usize; 2]> = line
        .windows(2)
        .filter(|two| !two.contains(&0))
        .map(|two| [two[0] as usize, two[1] as usize])
        .collect();
    assert_eq!(data.lines, pairs);
    assert_eq!(pairs, [[1, 3], [3, 4], [4, 7], [7, 10]]);
    for dataset in ["  2420", "  2411", "    82", "    55"] {
        let is_there = file.lines().any(|line| line == dataset);
        assert!(is_there, "dataset {dataset}");
    }
}

/// The stored answer is that of pyuff 2.5.8 and of SDynPy 0.23.0, digit for digit the same.
#[test]
fn other_programs_read_the_shapes_that_a_correlation_writes() {
    let answer = include_str!("../../../golden/formats/shapes_read.json");
    check(&serde_json::from_str(answer).unwrap());
}

fn check_with(program: &str) {
    let script = in_root("golden/formats/shapes_read.py");
    let folder = new_folder();
    let path = folder.path().join("shapes.unv");
    fs::write(&path, &reported("building").files["shapes.unv"]).unwrap();
    let mut python = Command::new("python3");
    let output = python.arg(script).arg(&path).arg(program).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    check(&serde_json::from_slice(&output.stdout).unwrap());
}

#[test]
#[ignore = "needs Python with pyuff"]
fn pyuff_reads_the_shapes_of_a_correlation() {
    check_with("pyuff");
}

#[test]
#[ignore = "needs Python with SDynPy"]
fn sdynpy_reads_the_shapes_of_a_correlation() {
    check_with("sdynpy");
}
