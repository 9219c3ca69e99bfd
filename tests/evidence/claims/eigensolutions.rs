//! Full eigensolutions by perturbation and by re-analysis, counted.

use crate::evidence::eigensolutions::{ERRORS, counted};
use crate::prelude::*;

#[test]
fn perturbation_takes_a_third_of_the_eigensolutions_of_reanalysis_and_less_for_less_error() {
    let mut before = None;
    for error in ERRORS {
        let analyses = (1..=3).map(|number| {
            let settings = case_of(number).settings;
            counted(&Known::of_case(number), &settings, error).map(|(analyses, _)| analyses)
        });
        let analyses = analyses.collect_vec();
        assert!(
            analyses.iter().all(|[quick, slow]| 2 * quick < *slow),
            "{analyses:?}"
        );
        let last = analyses[2][1];
        assert!(before.replace(last).is_none_or(|before| before < last));
    }
}
