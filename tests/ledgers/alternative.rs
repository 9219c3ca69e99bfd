//! What a user of SciPy would do instead: the table of `paper/cost.md` is made from `golden/least_squares.json`, which
//! `benches/least_squares.py` writes, and from the golden of the two rules.

use crate::ledgers::tables::{computed, table};
use crate::prelude::*;

const SUBJECTS: [&str; 5] = ["Case 1", "Case 2", "Case 3", "building", "GARTEUR"];
const FIRST: &str = "first model";
const WEIGHTED: &str = "weighted";
const ANALYTIC: &str = "analytic";
/// The same with SciPy's other linear solver.
const LSMR: &str = "analytic, lsmr";
/// The ways by their name in the file and by what they are.
const WAYS: [(&str, &str); 5] = [
    (ANALYTIC, "`least_squares`, analytic"),
    (LSMR, "the same, `tr_solver=\"lsmr\"`"),
    ("finite differences", "the same, finite differences"),
    ("paper's rule", "the paper's rule"),
    (WEIGHTED, "weighted steps"),
];

static ANSWERS: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../../golden/least_squares.json")).unwrap()
});

fn answer(subject: &str, way: &str, key: &str) -> Option<f64> {
    ANSWERS[subject][way][key].as_f64()
}

/// A number of weighted steps on a case, which are in the golden of the two rules.
fn of_rules(subject: &str, way: &str, column: &str, digits: usize) -> Option<String> {
    let is_there = way == WEIGHTED && subject.starts_with("Case");
    is_there.then(|| computed("rules", &format!("{subject}, {way}"), column, digits))
}

/// Exact analyses.
fn analyses(subject: &str, way: &str) -> Option<String> {
    let counted = || answer(subject, way, "analyses").map(|count| format!("{count:.0}"));
    of_rules(subject, way, "Analyses", 0).or_else(counted)
}

/// What is left of the errors of gages or factors, or where these are not known of those of frequencies, %.
fn left(subject: &str, way: &str) -> Option<String> {
    let known = || answer(subject, way, "factors").or_else(|| answer(subject, way, "frequencies"));
    let left = || known().map(|error| format!("{error:.1}"));
    of_rules(subject, way, "Factor RMS", 1).or_else(left)
}

/// The table of `paper/cost.md`.
pub fn least_squares() -> String {
    type Cell = fn(&str, &str) -> Option<String>;
    let parts: [(&str, Cell); 2] = [("analyses", analyses), ("left, %", left)];
    let mut rows = vec![("left, %: first model".to_owned(), (FIRST, left as Cell))];
    for (what, cell) in parts {
        rows.extend(WAYS.map(|(way, name)| (format!("{what}: {name}"), (way, cell))));
    }
    table(
        &format!("what and by which way | {}", SUBJECTS.join(" | ")),
        rows,
        |(way, cell)| {
            SUBJECTS
                .map(|subject| cell(subject, way).unwrap_or_default())
                .to_vec()
        },
    )
}

/// What becomes of the tailplane, GARTEUR's sixth parameter, of which the test says nothing.
pub fn tailplane() -> String {
    let values = ANSWERS["GARTEUR"][ANALYTIC]["values"].as_str().unwrap();
    let factor: f64 = values.split(' ').nth(5).unwrap().parse().unwrap();
    format!("on GARTEUR it makes the tailplane {factor:.0} times as stiff")
}

/// What `paper/cost.md` says: three combinations of gages are open where the gages are right, and in Case 1 everywhere.
#[test]
fn three_combinations_of_gages_are_open() {
    let open = |case: &&str| ANSWERS[*case][FIRST]["open"].clone();
    let found = SUBJECTS[..3].iter().map(open).collect_vec();
    assert_eq!(found, [json!([3, 3]), json!([3, 0]), json!([3, 0])]);
}

/// The paper's rule does the same here and in the golden of the two rules, which another program made.
#[test]
fn the_papers_rule_is_that_of_the_golden() {
    for subject in &SUBJECTS[..3] {
        let row = format!("{subject}, paper's rule");
        let [analyses, left] =
            ["Analyses", "Factor RMS"].map(|column| computed("rules", &row, column, 4));
        let [found, error] =
            ["analyses", "factors"].map(|key| answer(subject, "paper's rule", key));
        assert_eq!(analyses, format!("{:.4}", found.unwrap()), "{subject}");
        assert_eq!(left, format!("{:.4}", error.unwrap()), "{subject}");
    }
}
