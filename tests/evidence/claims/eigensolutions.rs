//! Full eigensolutions by perturbation and by re-analysis, counted.

use crate::evidence::eigensolutions::{Counted, counted};
use crate::prelude::*;

fn case(number: usize, error: f64) -> Counted {
    let settings = case_of(number).settings;
    counted(
        &Known::of_case(number).unwrap(),
        None,
        (&settings, |model| model),
        error,
    )
    .unwrap()
}

#[test]
fn perturbation_takes_a_third_of_the_eigensolutions_of_reanalysis_and_less_for_less_error() {
    let mut before = None;
    for error in [0.05, 0.025] {
        for number in 1..=3 {
            let Counted {
                perturbation,
                reanalysis,
                ..
            } = case(number, error);
            assert!(perturbation.reached && reanalysis.reached, "case {number}");
            assert!(
                2 * perturbation.analyses < reanalysis.analyses,
                "case {number}: {perturbation:?} {reanalysis:?}"
            );
        }
        let last = case(3, error).reanalysis.analyses;
        assert!(before.replace(last).is_none_or(|before| before < last));
    }
}
