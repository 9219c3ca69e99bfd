//! Lines of a deck that are no cards, and case control that cannot be followed.

use crate::prelude::*;
use crate::readers::deck_errors::{GOOD, error};

#[test]
fn a_line_that_is_no_card_is_named() {
    let cases: &[(&str, usize, &str, &str)] = &[
        (
            "1234,5",
            8,
            "neither a card's name nor a continuation",
            "1234",
        ),
        ("?,*1,=", 8, "neither a card's name nor a continuation", "?"),
        (
            "GRID,3,,12345678901",
            8,
            "longer than a field: 8 characters, or 16 with an asterisk",
            "12345678901",
        ),
        (
            "+B,1,2",
            8,
            "this line continues a card that ends with tag B",
            "none does",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\n+A,2\n+A,2",
            10,
            "the continuation in line 9 has",
            "the tag A already",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\nSPC1,1,3,2,,,,,,+A\n+A,2",
            9,
            "tag A continues",
            "the card of line 8 already",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\n+A,2,,,,,,,,+A",
            8,
            "tag A continues",
            "the card of line 8 already",
        ),
        (
            "GRDSET\nGRDSET,,,,,,,456",
            9,
            "the second GRDSET card",
            "a deck may have one",
        ),
    ];
    for &(cards, line, expected, found) in cases {
        let error = error(None, cards);
        let FileError::DeckLine {
            file,
            line: at,
            reason,
        } = &error
        else {
            panic!("{cards}: {error}");
        };
        assert_eq!((file.as_str(), *at), ("wing.dat", line), "{error}");
        assert!(
            reason.contains(expected) && reason.contains(found),
            "{error}"
        );
    }
    let error = deck::read("wing.dat", "+,1\n".as_bytes(), &[]).expect_err("nothing to continue");
    assert!(
        matches!(error, FileError::DeckLine { line: 1, .. }),
        "{error}"
    );
}

#[test]
fn case_control_that_selects_two_sets_is_refused() {
    for (control, line) in [
        ("SPC = 1\nSPC = 2", 2),
        ("SPC = 1\nSUBCASE 2\nSPC = 1\nSPC = 3", 4),
        ("MPC = NONE", 1),
        ("MPC=3\nMPC=4", 2),
    ] {
        let error = deck::read(
            "wing.dat",
            format!("{control}\nBEGIN BULK\n{GOOD}").as_bytes(),
            &[],
        )
        .expect_err(control);
        assert!(
            matches!(&error, FileError::DeckLine { line: found, reason, .. } if *found == line && reason.ends_with("must select one set of constraints by its number")),
            "{error}"
        );
    }
    let same = format!("SPC = 1\nSUBCASE 2\nSPC = 1\nDISP = ALL\nBEGIN BULK\n{GOOD}");
    assert!(deck::read("wing.dat", same.as_bytes(), &[]).is_ok());
}
