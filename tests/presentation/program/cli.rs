//! The command line program from outside: output, exit status, and nothing half-written.

use crate::prelude::*;

pub fn corfem(arguments: &[&str]) -> std::process::Output {
    assert_cmd::Command::cargo_bin("corfem")
        .unwrap()
        .args(arguments)
        .output()
        .unwrap()
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// What it prints, without a word on standard error.
pub fn printed(arguments: &[&str]) -> String {
    let done = corfem(arguments);
    let is_silent = done.stderr.is_empty();
    assert_eq!(
        (done.status.code(), is_silent),
        (Some(0), true),
        "{arguments:?}"
    );
    text(&done.stdout)
}

pub fn parsed(arguments: &[&str]) -> Value {
    serde_json::from_slice(&corfem(arguments).stdout).unwrap()
}

#[test]
fn another_box_is_a_change_of_data_alone() {
    let folder = new_folder();
    let path = folder.path().join("box.toml");
    // Halving modulus and masses together leaves every frequency alone: only their ratio matters.
    let text = include_str!("../../../paper/reconstruction.toml");
    let mut table: toml::Table = text.parse().unwrap();
    table["youngs_modulus"] = 5.0e6.into();
    for mass in table["masses"].as_array_mut().unwrap() {
        *mass = (0.5 * mass.as_float().unwrap()).into();
    }
    fs::write(&path, table.to_string()).unwrap();
    let frequencies = |more: &[&str]| {
        let document = parsed(&[&["cases", "2", "-f", "json"], more].concat());
        let modes = document["cases"][0]["correlation"]["modes"]
            .as_array()
            .unwrap()
            .clone();
        modes
            .iter()
            .map(|own| own["test_hz"].as_f64().unwrap())
            .collect_vec()
    };
    let other = frequencies(&["--box", path.to_str().unwrap()]);
    assert_alike(other, frequencies(&[]), MATRIX_ROUND_OFF);
}

/// What every case came to, with a bar for every gage.
#[test]
fn without_a_command_it_prints_what_every_case_came_to() {
    assert_golden("cases", &printed(&[]), Numbers::AS_WRITTEN);
}

/// The numbers of a list in JSON.
pub fn numbers(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}

/// A path on a command line.
pub fn words(path: &Path) -> &str {
    path.to_str().unwrap()
}
