//! Figures of the report, against those that are stored, one of every kind.

use crate::paper::figures::{Figure, case_figures};
use crate::prelude::*;

/// The four cases, run once for all tests of figures.
pub fn results() -> &'static [CaseResult] {
    static RESULTS: OnceLock<Vec<CaseResult>> = OnceLock::new();
    RESULTS.get_or_init(|| CASES.map(|number| case_run(&case_of(number))).into())
}

/// Every figure of the report, drawn once.
pub fn figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(|| case_figures(results()).unwrap())
}

#[test]
fn stored_figures_are_what_the_command_writes() {
    let stored = fs::read_dir(in_root("golden/figures")).unwrap();
    let stored = stored.map(|entry| entry.unwrap().path()).collect_vec();
    assert_eq!(stored.len(), 6);
    for path in stored {
        let name = path.file_stem().and_then(|name| name.to_str()).unwrap();
        let drawn = figures().iter().find(|figure| figure.name == name).unwrap();
        let stored = fs::read_to_string(&path).unwrap();
        let is_same = Numbers::DRAWN.agree(&stored, &drawn.svg);
        assert!(is_same, "{name} differs: write it again");
    }
}
