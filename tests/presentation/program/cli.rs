//! The command line program from outside: output, exit status, and nothing half-written.

use assert_cmd::Command;
use serde_json::Value;

pub fn corfem(arguments: &[&str]) -> std::process::Output {
    Command::cargo_bin("corfem")
        .expect("the program is built")
        .args(arguments)
        .output()
        .expect("it starts")
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
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

/// The numbers of a list in JSON.
pub fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(|number| number.as_f64().expect("a number"))
        .collect()
}

pub fn parsed(arguments: &[&str]) -> Value {
    serde_json::from_slice(&corfem(arguments).stdout).expect("JSON")
}

/// The head of README's table has the same numbers from the goldens.
#[test]
fn without_a_command_it_prints_less_than_a_page_of_a_terminal() {
    let plain = printed(&[]);
    assert_eq!(plain, printed(&["cases"]));
    assert_eq!(plain, printed(&["-q", "cases"]));
    let lines: Vec<&str> = plain.lines().collect();
    assert!(lines.len() <= 45, "{} lines", lines.len());
    assert!(
        lines.iter().all(|line| line.chars().count() <= 80),
        "{plain}"
    );
    let cells = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let readme = include_str!("../../../README.md");
    let rows = readme
        .split("<!-- computed: cases -->")
        .nth(1)
        .expect("the table");
    let rows = rows.split("<!-- end -->").next().expect("its end").trim();
    let mut count = 0;
    for row in rows.lines().skip(2) {
        let row = cells(&row.replace('|', " "));
        assert!(lines.iter().any(|line| cells(line) == row), "{row}");
        count += 1;
    }
    assert_eq!(count, 7);
    let words = cells(&plain);
    assert!(
        words.contains(
            "Case 4: element 8 asks for 58.4 times its stiffness (published: 60), the next"
        )
    );
    let json = parsed(&["cases", "-q", "-f", "json"]);
    for (row, case) in json["cases"].as_array().expect("four").iter().enumerate() {
        let line = lines
            .iter()
            .find(|line| line.starts_with(&format!("{} ", row + 1)));
        let line = line.unwrap_or_else(|| panic!("case {}", row + 1));
        assert!(
            line.ends_with(case["outcome"].as_str().expect("words")),
            "{line}"
        );
    }
    // A bar is as long as its error, in tenths of the largest, and a thin panel's goes the other way.
    for (panel, gage) in numbers(&json["cases"][1]["pass_gages_in"][1])
        .iter()
        .enumerate()
    {
        let (error, start) = (100.0 * (gage / 0.01 - 1.0), format!("{:>2}", panel + 1));
        let begun = format!("{start} {error:>+6.1} ");
        let line = lines
            .iter()
            .find_map(|line| line.split(&begun).nth(1))
            .expect("its line");
        let bar: String = line.chars().take(21).collect();
        let (left, right) = bar.split_once('│').expect("zero");
        let side = if error < 0.0 { left } else { right };
        let length = (error.abs() / 5.0).round() as usize;
        assert_eq!(side.matches('█').count(), length, "panel {start}: {line}");
        assert_eq!(bar.matches('█').count(), length, "panel {start}: {line}");
        assert_eq!(right.matches('░').count() + right.matches('█').count(), 10);
    }
    for command in ["cases --all", "tables", "report -o", "init --example"] {
        assert!(plain.contains(&format!("corfem {command}")), "{command}");
    }
}

#[test]
fn json_has_the_promised_keys() {
    let document = parsed(&["cases", "--format", "json", "--quiet"]);
    let cases = document["cases"].as_array().expect("a list");
    assert_eq!(cases.len(), 4);
    let length = |value: &Value| value.as_array().map(Vec::len);
    for (row, case) in cases.iter().enumerate() {
        assert_eq!(case["case"], row + 1);
        let run = &case["correlation"];
        let rms = |check: &Value| check["frequency_rms"].is_f64() && check["shape_rms"].is_f64();
        assert_eq!(length(&run["parameters"]), Some(15));
        assert_eq!(length(&run["test_frequencies_hz"]), Some(9));
        assert_eq!(length(&run["initial"]["frequencies_hz"]), Some(9));
        assert!(rms(&run["initial"]));
        assert_eq!(length(&case["first_gages_in"]), Some(15));
        let passes = run["passes"].as_array().expect("a list");
        assert_eq!(length(&case["pass_gages_in"]), Some(passes.len()));
        assert_eq!(length(&case["published_iterations"]), Some(passes.len()));
        for (pass, gages) in passes
            .iter()
            .zip(case["pass_gages_in"].as_array().expect("lists"))
        {
            let iterations = pass["iterations"].as_u64().expect("a count") as usize;
            assert_eq!(length(&pass["history"]), Some(iterations));
            assert_eq!(length(gages), Some(15));
            assert_eq!(length(&pass["unlimited_factors"]), Some(15));
            assert_eq!(length(&pass["factors"]), Some(15));
            assert_eq!(length(&pass["exact"]["frequencies_hz"]), Some(9));
            assert!(rms(&pass["exact"]));
        }
    }
    assert_eq!(
        cases[2]["correlation"]["passes"].as_array().map(Vec::len),
        Some(3)
    );
    assert_eq!(cases[3]["anomaly"]["parameter"], "8");
    let pairs = cases[1]["next_step"]["seen"]["parallel"]
        .as_array()
        .expect("a list");
    let pairs: Vec<_> = pairs
        .iter()
        .map(|pair| [pair[0].as_u64(), pair[1].as_u64()])
        .collect();
    assert_eq!(pairs, [[1, 14], [3, 7], [8, 10]].map(|pair| pair.map(Some)));
    assert_eq!(length(&cases[2]["next_step"]["step"]), Some(15));
    assert_eq!(length(&cases[2]["gage_errors"]), Some(15));
    assert!(cases[3]["next_step"].is_null() && cases[3]["gage_errors"].is_null());
    // Gages at the bound of 0.013 in were held there by the total limit in Case 3's history.
    let history = cases[2]["correlation"]["passes"][0]["history"]
        .as_array()
        .expect("a list");
    let held = history
        .iter()
        .flat_map(|i| i["limits"].as_array().expect("a list"))
        .any(|l| l == "total");
    assert!(held);
}

#[test]
fn another_box_is_a_change_of_data_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("box.toml");
    // Halving modulus and masses together leaves every frequency alone: only their ratio matters.
    let text = include_str!("../../../paper/reconstruction.toml");
    let mut table: toml::Table = text.parse().expect("it reads");
    table["youngs_modulus"] = 5.0e6.into();
    for mass in table["masses"].as_array_mut().expect("a list") {
        *mass = (0.5 * mass.as_float().expect("a number")).into();
    }
    std::fs::write(&path, table.to_string()).expect("written");
    let other = parsed(&[
        "cases",
        "2",
        "-f",
        "json",
        "--box",
        path.to_str().expect("UTF-8"),
    ]);
    let own = parsed(&["cases", "2", "-f", "json"]);
    let frequencies =
        |document: &Value| numbers(&document["cases"][0]["correlation"]["test_frequencies_hz"]);
    for (a, b) in frequencies(&other).iter().zip(frequencies(&own)) {
        approx::assert_relative_eq!(
            *a,
            b,
            max_relative = crate::common::tolerances::MATRIX_ROUND_OFF
        );
    }
}
