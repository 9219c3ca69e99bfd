//! The modes of a deck as tables.

use crate::prelude::*;
use corfem::files::deck;
use corfem::present::tables::deck::deck_tables;

#[test]
fn a_structure_that_hangs_free_says_how_many_modes_are_not_listed() {
    let held = &rods()[1].1;
    let free =
        held.replace("GRID,1,,0.,0.,0.,,123456", "GRID,1,,0.,0.,0.,,23456") + "CMASS2,11,1.,1,1\n";
    let notes = |text: &str| {
        let deck = deck::read("deck", text.as_bytes(), &[]).expect("a deck");
        let modes = deck::modes(&deck.model, usize::MAX).expect("modes");
        deck_tables(&deck.unread, &modes, 2)[0].notes.join(" ")
    };
    assert!(
        notes(&free).contains("The structure hangs free: 1 rigid-body mode is not listed."),
        "{}",
        notes(&free)
    );
    assert!(!notes(held).contains("free"), "{}", notes(held));
}
