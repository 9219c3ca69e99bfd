//! What the studies of `paper/studies` must show for `paper/*.md` to say so: their tables against the goldens, and the claims one by one.
//! Nothing here runs a user's structure.

pub mod appendices_expected;
pub mod certified;
pub mod claims;
pub mod enclosed;
pub mod next_step;

pub use crate::common::presentation::studies::*;
use crate::prelude::*;

/// How far numbers of a study may be from its golden.
fn numbers(name: &str) -> Numbers {
    let steps = Numbers {
        relative: JOB_RESULTS,
        absolute: 100.0 * ROUND_OFF_FLOOR,
        last_digit: true,
        ..Numbers::AS_WRITTEN
    };
    match name {
        "rules" => Numbers {
            absolute: JOB_RESULTS,
            last_digit: false,
            ..steps
        },
        "linearization" | "linearization_new" => steps,
        "eigensolutions" => Numbers {
            relative: GOLDEN_STEPS,
            ..Numbers::COUNTED
        },
        "intervals_structures" | "intervals_repeats" => Numbers::COUNTED,
        _ => Numbers::BY_UNIT,
    }
}

fn assert_studies(studies: &[Study]) {
    for (name, text) in studies {
        assert_golden(name, &text().unwrap(), numbers(name));
    }
}

/// The last, of readings, is `paper/readings.csv`.
#[test]
fn tables_of_studies_are_the_stored_ones() {
    assert_studies(&QUICK[..QUICK.len() - 1]);
}

#[test]
#[ignore = "half an hour: right tests and as many of three times the noise, of seven structures with two noises"]
fn intervals_on_structures_built_later_are_the_stored_ones() {
    assert_studies(&LONG[LONG.len() - 2..]);
}
