//! The pre-flight: what it says of exchanged frequencies, and of two mistakes at once.

use crate::prelude::*;
use crate::spec::sx_preflight::{case, findings, is_of, wing};

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

#[test]
fn two_mistakes_at_once_are_both_named() {
    let mut wrong = case(2);
    alter(&mut wrong.test, |squares, _| {
        *squares *= FACTORS[0].factor.powi(2)
    });
    alter(&mut wrong.test, |_, shapes| shapes.row_mut(3).neg_mut());
    let found = findings(&wrong);
    let [factor, change] = &found[..] else {
        panic!("{found:?}")
    };
    assert!(factor.words.ends_with("near 2π: the test is in rad/s?"));
    assert!(is_of(change, &Change::Reversed(3)), "{change:?}");
}
