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
        "linearization" => steps,
        "eigensolutions" => Numbers {
            relative: GOLDEN_STEPS,
            ..Numbers::COUNTED
        },
        _ => Numbers::BY_UNIT,
    }
}

/// The first, of readings, is `paper/readings.csv`; the last two take minutes.
#[test]
fn tables_of_studies_are_the_stored_ones() {
    for (name, tables) in &STUDIES[1..10] {
        assert_golden(name, &csv(&tables()), numbers(name));
    }
}
