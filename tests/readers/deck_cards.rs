//! Cards that are not understood: added to a good deck, each of them makes it fail.

use crate::prelude::*;
use crate::readers::deck_errors::GOOD;

/// The cards that a deck is refused for.
fn refused(deck: &str) -> Vec<Unread> {
    match deck::read("wing.dat", deck.as_bytes(), &[]).expect_err(deck) {
        FileError::DeckCards { cards, .. } => cards,
        error => panic!("{deck}: {error}"),
    }
}

/// Cards, family by family, behind the reason for which they are refused.
const FAMILIES: &str = "\
Lacking: CBAR,9,9,1,2,0.,1.,0.|CBEAM,9,9,1,2,0.,1.,0.|CQUAD4,9,9,1,2,1,2|CTRIA3,9,9,1,2,1|CQUAD2,9,9,1,2,1,2|CTUBE,9,9,1,2|CHEXA,9,9,1,2,1,2,1,2
Lacking: CELAS1,9,9,1,1|CELAS2,9,1.,1,1|GENEL,9,,1,1|CBUSH,9,9,1,2|MATT1,1,1|CONM1,9,1|CMASS3,9,9,1,2|CMASS4,9,1.,1,2|EPOINT,9
Lacking: ASET,1,1|ASET1,1,1|OMIT,1,1|OMIT1,1,1|SEBSET,1,1,1|SUPORT,1,1|SUPORT1,1,1,1|RBE2,9,1,1,2|RBE3,9,,1,1|RROD,9,1,2,1|RBAR,9,1,2
Lacking: DMIG,K2GG,0,6,1,0|PARAM,COUPMASS,1|PARAM,CM1,2.|PARAM,CM2,2.|PARAM,CK1,2.|PARAM,CK2,2.|SEBULK,1,PRIMARY|SECONCT,1,0|CSUPER,1,2,1|SETREE,1,2
Unknown: CSHAER,9,9,1,2,1,2|CORD,9,1,1,2|GIRD,9|MTA1,9,1.+6,,.3|SCP1,1,1,2|CQDEMM,9,9,1,2,1,2|NSM,1,PROD,1,.1|SPCOFF,1,1|SPCAX,1,1|CRIGD1,9,1,2
Unknown: K2GG,9|MDLPRM,SHEARP,HARRIS|MDLPRM,DELMASS,1.
Elsewhere: INCLUDE 'wing/covers.bdf'|INCLUDE \"a\"|READFILE covers";

#[test]
fn cards_that_are_not_understood_are_refused_unless_they_are_left_out() {
    let good = read_deck(GOOD).unwrap().model;
    for line in FAMILIES.lines() {
        let (reason, cards) = line.split_once(": ").unwrap();
        let reason = match reason {
            "Lacking" => Reason::Lacking,
            "Unknown" => Reason::Unknown,
            _ => Reason::Elsewhere,
        };
        for card in cards.split('|') {
            let words = card.split([',', ' ']).collect_vec();
            // Parameters are named with the cards.
            let count = 1 + usize::from(["PARAM", "MDLPRM"].contains(&words[0]));
            let expected = [Unread {
                card: words[..count].join(" "),
                line: 8,
                count: 1,
                reason,
            }];
            assert_eq!(refused(&format!("{GOOD}{card}\n")), expected);
            assert_eq!(
                refused(&format!("{GOOD}{}\n", card.to_lowercase())),
                expected
            );
            assert_eq!(
                refused(&format!("SPC = 1\nBEGIN BULK\n{GOOD}{card}\n"))[0].line,
                10
            );
            let deck = format!("{GOOD}{card}\n");
            let left = deck::read("wing.dat", deck.as_bytes(), from_ref(&expected[0].card));
            let left = left.expect(card);
            let [mut ignored] = expected;
            ignored.reason = Reason::Ignored;
            assert_eq!((left.unread, &left.model), (vec![ignored], &good));
        }
    }
}

#[test]
fn a_slip_in_any_name_is_refused() {
    let names = [
        "GRID", "GRDSET", "CONROD", "MAT1", "CMASS2", "CONM2", "SPC1", "SPCADD", "MPC", "MPCADD",
        "PARAM", "EIGR", "EIGRL", "CROD", "PROD", "CSHEAR", "PSHEAR", "CQDMEM", "PQDMEM", "CTRMEM",
        "PTRMEM", "FORCE", "LOAD", "SPC", "DESVAR", "PAERO1",
    ];
    for name in names {
        for place in 0..name.len() {
            let without = format!("{}{}", &name[..place], &name[place + 1..]);
            let doubled = format!("{}{}", &name[..=place], &name[place..]);
            let mut exchanged = name.chars().collect_vec();
            exchanged.swap(place, (place + 1) % name.len());
            for slip in [without, doubled, exchanged.into_iter().collect()] {
                if slip.starts_with(|c: char| c.is_ascii_alphabetic())
                    && !names.contains(&slip.as_str())
                {
                    let found = refused(&format!("{GOOD}{slip},9\n"));
                    let [
                        Unread {
                            card,
                            line: 8,
                            count: 1,
                            ..
                        },
                    ] = &found[..]
                    else {
                        panic!("{slip}: {found:?}")
                    };
                    assert_eq!(card, &slip);
                }
            }
        }
    }
}
