//! The pre-flight: what it says of exchanged frequencies.

use crate::prelude::*;
use crate::spec::sx_preflight::{case, findings, wing};

#[test]
fn exchanged_frequencies_are_named_where_models_are_closer_than_modes() {
    for specimen in [case(2), wing()] {
        for first in 0..specimen.test.len() - 1 {
            let mut wrong = specimen.clone();
            alter(&mut wrong.test, |squares, _| {
                squares.swap_rows(first, first + 1)
            });
            let found = findings(&wrong);
            let found = found.iter().map(|own| &own.identifier[..]).collect_vec();
            let named = format!("frequencies-exchanged-{}-{}", first + 1, first + 2);
            assert_eq!(found, [named], "{}", specimen.name);
        }
    }
}
