//! Lines of a deck that are no cards, and case control that cannot be followed.

use crate::readers::deck_errors::{GOOD, error};
use corfem::files::deck;
use corfem::files::error::FileError;

#[test]
fn a_line_that_is_no_card_is_named() {
    let cases: &[(&str, usize, &str, &str)] = &[
        ("1234,5", 8, "a card's name or a continuation", "1234"),
        ("=,*1,=", 8, "a card's name or a continuation", "="),
        (
            "GRID,3,,1.,2.,3.,,,,+A,9",
            8,
            "no more fields than a line has",
            "GRID,3,,1.,2.,3.,,,,+A,9",
        ),
        (
            "GRID*,3,,1.,2.,+A,9",
            8,
            "no more fields than a line has",
            "GRID*,3,,1.,2.,+A,9",
        ),
        (
            "GRID,3,,1.2345678",
            8,
            "a field of 8 characters, or of 16 with an asterisk",
            "1.2345678",
        ),
        (
            "GRID*,3,,1.234567890123456",
            8,
            "a field of 8 characters, or of 16 with an asterisk",
            "1.234567890123456",
        ),
        (
            "+B,1,2",
            8,
            "a card that this line continues",
            "none that ends with tag B",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\n+,2",
            9,
            "a card that this line continues",
            "none before it",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\n+A,2\n+A,2",
            10,
            "a continuation with a tag of its own",
            "A, which the one in line 9 has",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\nSPC1,1,3,2,,,,,,+A\n+A,2",
            9,
            "a card with continuations of its own",
            "tag A, which continues the card of line 8",
        ),
        (
            "SPC1,1,2,2,,,,,,+A\n+A,2,,,,,,,,+A",
            8,
            "a card with continuations of its own",
            "tag A, which continues the card of line 8",
        ),
        (
            "GRDSET\nGRDSET,,,,,,,456",
            9,
            "one GRDSET card at most",
            "another",
        ),
    ];
    for &(cards, line, expected, found) in cases {
        let error = error(None, cards);
        let FileError::DeckLine {
            file,
            line: at,
            expected: wanted,
            found: there,
        } = &error
        else {
            panic!("{cards}: {error}");
        };
        assert_eq!((file.as_str(), *at), ("wing.dat", line), "{error}");
        assert_eq!((*wanted, there.as_str()), (expected, found));
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
        ("SPC = 1\nSUBCASE 2\nSPC = 2", 3),
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
            matches!(&error, FileError::DeckLine { line: found, expected: "one set of constraints, by its number", .. } if *found == line),
            "{error}"
        );
    }
    let same = format!("SPC = 1\nSUBCASE 2\nSPC = 1\nDISP = ALL\nBEGIN BULK\n{GOOD}");
    assert!(deck::read("wing.dat", same.as_bytes(), &[]).is_ok());
}
