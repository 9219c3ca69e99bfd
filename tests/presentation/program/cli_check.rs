//! `corfem check` from outside.

use crate::common::jobs::folder_of;
use crate::presentation::program::cli::printed;
use serde_json::Value;

#[test]
fn check_says_what_it_finds() {
    let corfem = |format: &str| printed(&["check", "--format", format]);
    let report = corfem("text");
    let words = report.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(report.starts_with("Before the first step"), "{report:.200}");
    assert!(
        words.contains("Test mode 7 and analysis mode 6 have a cross-orthogonality of 0.667 only.")
    );
    let json: Value = serde_json::from_str(&corfem("json")).expect("JSON");
    let structures = json["structures"].as_array().expect("a list");
    let names: Vec<&str> = structures
        .iter()
        .map(|found| found["name"].as_str().expect("a name"))
        .collect();
    assert_eq!(names, ["Case 1", "Case 2", "Case 3", "Case 4"]);
    assert_eq!(structures[2]["findings"], Value::Array(Vec::new()));
    assert_eq!(structures[3]["findings"][1]["low_pair"]["test"], 6);
}

#[test]
fn a_check_of_a_job_ranks_its_parameters() {
    let job = folder_of("building").join("job.toml");
    let job = job.to_str().expect("a name");
    let text = printed(&["check", job]);
    let suspects = text.split("Suspects: ").nth(1).expect("the table");
    assert!(
        (1..=10).all(|story| suspects.contains(&format!("story {story} "))),
        "{suspects}"
    );
    let json: Value =
        serde_json::from_str(&printed(&["check", job, "--format", "json"])).expect("JSON");
    assert_eq!(
        (
            &json["tables"][3]["name"],
            &json["tables"][3]["rows"][0]["label"]
        ),
        (&"suspects".into(), &"story 6".into())
    );
}
