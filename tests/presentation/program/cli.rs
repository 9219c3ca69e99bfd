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

#[test]
fn every_case_in_full_has_the_papers_tables_and_a_line_a_pass() {
    let all = corfem(&["cases", "--all"]);
    assert_eq!(all.status.code(), Some(0));
    let report = text(&all.stdout);
    for table in [3, 4, 5, 6, 7, 8, 13] {
        assert!(report.contains(&format!("Table {table})")), "Table {table}");
    }
    assert!(report.contains("Anomaly: element 8") && !report.contains("(Table 1, "));
    let progress = text(&all.stderr);
    assert_eq!(progress.lines().count(), 8, "one line a pass: {progress}");
    assert!(progress.starts_with("case 1, pass 1: 12 iterations"));
    assert_eq!(corfem(&["cases", "1", "2", "3", "4"]).stdout, all.stdout);
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
fn quiet_is_taken_before_and_after_the_command() {
    for arguments in [
        ["-q", "cases", "4"],
        ["cases", "-q", "4"],
        ["cases", "4", "--quiet"],
    ] {
        assert!(printed(&arguments).contains("Case 4"));
    }
}

#[test]
fn help_puts_every_option_below_its_own_heading() {
    let help = text(&corfem(&["cases", "--help"]).stdout);
    let (before, settings) = help
        .split_once("Settings of the loops:")
        .expect("the heading");
    for option in [
        "--all", "--quiet", "--format", "--output", "--box", "--groups",
    ] {
        assert!(
            before.contains(option) && !settings.contains(option),
            "{option}"
        );
    }
    for option in [
        "--rule",
        "--accumulation",
        "--relaxation",
        "--tolerance",
        "--limits",
        "--iterations",
        "--passes",
    ] {
        assert!(settings.contains(option), "{option}");
    }
    for reading in ["matrix", "own", "relative", "gage", "sum", "product"] {
        let line = |line: &&str| line.trim_start().starts_with(&format!("{reading} "));
        let line = settings
            .lines()
            .find(line)
            .unwrap_or_else(|| panic!("{reading}"));
        assert!(line.split_whitespace().count() > 4, "{line}");
    }
    assert!(!text(&corfem(&["--help"]).stdout).contains("Settings"));
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
fn csv_has_one_number_a_line_under_a_heading() {
    let output = text(&corfem(&["cases", "3", "--format", "csv"]).stdout);
    let mut lines = output.lines();
    assert_eq!(
        lines.next(),
        Some("table,row,column,unit,computed,published")
    );
    assert!(lines.all(|line| line.split(',').count() == 6));
    assert!(output.contains("table_8,membrane RMS,Pass 3 error,%,"));
}

#[test]
fn markdown_has_headings_and_pipes() {
    let output = text(&corfem(&["cases", "2", "--format", "markdown"]).stdout);
    assert!(output.contains("## Case 2: frequencies and errors (Table 5)"));
    assert!(output.lines().filter(|line| line.starts_with('|')).count() > 20);
}

#[test]
fn quiet_says_nothing_on_standard_error() {
    let output = corfem(&["cases", "1", "--quiet"]);
    assert!(output.stderr.is_empty() && !output.stdout.is_empty());
}

#[test]
fn help_says_what_it_does_and_what_the_exit_status_means() {
    let help = text(&corfem(&["--help"]).stdout);
    // Lines are broken to the width of the terminal, wherever that falls.
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in [
        "ground vibration test",
        "Exit status",
        "inch, pound-force, second",
        "cases",
    ] {
        assert!(help.contains(words), "{words}");
    }
    let cases = text(&corfem(&["cases", "--help"]).stdout);
    for words in [
        "--format",
        "--output",
        "--box",
        "--iterations",
        "--quiet",
        "detects a modeling",
    ] {
        assert!(cases.contains(words), "{words}");
    }
    assert!(help.contains("Case 4 detected a modeling error"), "{help}");
    for command in ["correlate", "study"] {
        let help = text(&corfem(&[command, "--help"]).stdout);
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            help.contains("a second one ends the program at once"),
            "{help}"
        );
    }
}

#[test]
fn output_file_is_written_whole_and_matches_standard_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let output = corfem(&[
        "cases",
        "4",
        "-f",
        "json",
        "-o",
        path.to_str().expect("UTF-8"),
    ]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty());
    let written = std::fs::read(&path).expect("written");
    assert_eq!(written, corfem(&["cases", "4", "-f", "json"]).stdout);
    let entries = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(entries, 1, "no scratch file is left");
}

#[test]
fn bad_input_is_exit_status_2_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let unknown = corfem(&["cases", "7"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("there is no case 7; choose 1 to 4"));
    assert!(unknown.stdout.is_empty());
    assert_eq!(corfem(&["cases", "--format", "pdf"]).status.code(), Some(2));
    assert_eq!(
        corfem(&["cases", "--iterations", "0"]).status.code(),
        Some(2)
    );
    let missing = corfem(&["cases", "--box", &path("absent.toml")]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(text(&missing.stderr).contains("absent.toml"));
    let report = path("no/such/folder/report.txt");
    let nowhere = corfem(&["cases", "4", "--output", &report]);
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(text(&nowhere.stderr).contains("report.txt"));
    std::fs::write(path("bad.toml"), "youngs_modulus = \"soft\"").expect("written");
    let bad = corfem(&[
        "cases",
        "4",
        "--box",
        &path("bad.toml"),
        "-o",
        &path("report.txt"),
    ]);
    assert_eq!(bad.status.code(), Some(2));
    assert!(text(&bad.stderr).contains("bad.toml") && text(&bad.stderr).contains("youngs_modulus"));
    assert!(!folder.path().join("report.txt").exists());
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

#[test]
fn too_few_iterations_is_exit_status_3_with_the_best_still_printed() {
    let output = corfem(&["cases", "1", "--iterations", "2", "--passes", "1"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stdout).contains("Pass 1"));
}

#[test]
fn substructures_are_groups_in_the_report() {
    let report = text(&corfem(&["cases", "4", "--groups", "--quiet"]).stdout);
    for group in ["covers", "spars", "ribs"] {
        assert!(report.contains(group), "{group}");
    }
    let output = corfem(&["cases", "2", "--groups", "--quiet"]);
    assert_eq!(output.status.code(), Some(0));
    let run = parsed(&["cases", "2", "--groups", "--format", "json", "--quiet"]);
    let passes = run["cases"][0]["correlation"]["passes"]
        .as_array()
        .expect("passes");
    let plain = parsed(&["cases", "2", "--format", "json", "--quiet"]);
    assert_ne!(
        &plain["cases"][0]["correlation"],
        &run["cases"][0]["correlation"]
    );
    assert!(!passes.is_empty());
}

#[test]
fn no_command_prints_a_line_that_is_too_long_by_default() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = folder.path().join("box.dat");
    let deck = deck.to_str().expect("UTF-8");
    assert!(corfem(&["deck", "3", "-o", deck]).status.success());
    for arguments in [
        &["cases"][..],
        &["cases", "--all"],
        &["cases", "--all", "--groups"],
        &["tables"],
        &["fewer-modes"],
        &["deck", "4"],
        &["modes", deck],
        &["--help"],
        &["cases", "--help"],
    ] {
        let output = corfem(arguments);
        let printed = text(&output.stdout);
        assert!(printed.lines().count() > 10, "{arguments:?}");
        for line in printed.lines().chain(text(&output.stderr).lines()) {
            assert!(line.chars().count() <= 100, "{arguments:?}: {line}");
            assert!(!line.contains("_percent"), "{arguments:?}: {line}");
            assert!(!line.contains(": 1 iterations"), "{arguments:?}: {line}");
        }
    }
}
