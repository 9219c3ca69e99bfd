//! `corfem check` from outside.

use crate::common::jobs::folder_of;
use crate::presentation::program::cli::{corfem, printed};
use serde_json::Value;

#[test]
fn a_check_without_a_job_is_refused_and_the_remedy_named() {
    let refused = corfem(&["check"]);
    assert_eq!(refused.status.code(), Some(2));
    let words = String::from_utf8_lossy(&refused.stderr);
    assert!(
        words.contains("<JOB>") && words.contains("corfem init job.toml writes a job"),
        "{words}"
    );
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
    // Last comes where to measure next: as it is, then one more sensor.
    let (_, next) = text.split_once("Where to measure next").expect("the table");
    assert!(
        next.contains("as it is ") && next.contains("with grid 1 x "),
        "{next}"
    );
    let next = &json["tables"][4];
    assert_eq!(next["name"], "next_measurement");
    assert_eq!(next["rows"][1]["label"], "with grid 1 x");
}
