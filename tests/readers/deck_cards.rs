//! Cards that are not understood: added to a good deck, each of them makes it fail.

use crate::prelude::*;
use crate::readers::deck_errors::GOOD;

/// The cards that a deck is refused for.
fn refused(deck: &str) -> Vec<Unread> {
    match deck::read("wing.dat", deck.as_bytes(), &[]).expect_err(deck) {
        FileError::DeckCards { file, cards } => {
            assert_eq!(file, "wing.dat");
            cards
        }
        error => panic!("{deck}: {error}"),
    }
}

/// Names of cards that are in no element's family.
const OTHERS: &str = "CSHAER CORD GIRD MTA1 SCP1 CQDEMM NSM SPCOFF SPCAX CRIGD1 K2GG";

fn of_reason(card: &str, line: usize, count: usize, reason: Reason) -> Unread {
    Unread {
        card: card.into(),
        line,
        count,
        reason,
    }
}

fn unknown(card: &str, line: usize, count: usize) -> Unread {
    let is_other = OTHERS.split(' ').any(|other| other == card) || card.starts_with("MDLPRM");
    let reason = match card {
        "INCLUDE" | "READFILE" => Reason::Elsewhere,
        _ if is_other => Reason::Unknown,
        _ => Reason::Lacking,
    };
    of_reason(card, line, count, reason)
}

/// One test for every family of cards, by name: cards of the family, the last with two lines of one card.
macro_rules! families {
    ($($family:ident: $($card:literal)+;)+) => {$(
        #[test]
        fn $family() {
            for card in [$($card),+] {
                let name = card.split([',', ' ']).next().unwrap();
                let parameter = || card[..card.rfind(',').unwrap()].replace(',', " ");
                let name = if ["PARAM", "MDLPRM"].contains(&name) { parameter() } else { name.to_owned() };
                let expected = [unknown(&name, 8, 1)];
                assert_eq!(refused(&format!("{GOOD}{card}\n")), expected, "behind the others");
                assert_eq!(refused(&format!("{GOOD}{}\n", card.to_lowercase())), expected, "in small letters");
                assert_eq!(refused(&format!("SPC = 1\nBEGIN BULK\n{GOOD}{card}\n"))[0].line, 10, "with case control");
                let deck = format!("{GOOD}{card}\n");
                let names = from_ref(&name);
                let ignored = deck::read("wing.dat", deck.as_bytes(), names).expect(card);
                assert_eq!(ignored.unread, [Unread { reason: Reason::Ignored, ..unknown(&name, 8, 1) }]);
                assert_eq!(ignored.model, deck::read("wing.dat", GOOD.as_bytes(), &[]).unwrap().model);
            }
        }
    )+};
}

families! {
    bars_and_beams: "CBAR,9,9,1,2,0.,1.,0." "CBEAM,9,9,1,2,0.,1.,0.";
    plates: "CQUAD4,9,9,1,2,1,2" "CTRIA3,9,9,1,2,1" "CQUAD2,9,9,1,2,1,2";
    tubes_and_solids: "CTUBE,9,9,1,2" "CHEXA,9,9,1,2,1,2,1,2";
    springs: "CELAS1,9,9,1,1" "CELAS2,9,1.,1,1" "GENEL,9,,1,1" "CBUSH,9,9,1,2";
    misspelled: "CSHAER,9,9,1,2,1,2" "CORD,9,1,1,2" "GIRD,9" "MTA1,9,1.+6,,.3" "SCP1,1,1,2" "CQDEMM,9,9,1,2,1,2";
    materials: "MATT1,1,1";
    masses: "CONM1,9,1" "CMASS3,9,9,1,2" "CMASS4,9,1.,1,2" "NSM,1,PROD,1,.1";
    points_and_reductions: "EPOINT,9" "ASET,1,1" "ASET1,1,1" "OMIT,1,1" "OMIT1,1,1" "SEBSET,1,1,1";
    supports: "SUPORT,1,1" "SUPORT1,1,1,1" "SPCOFF,1,1" "SPCAX,1,1";
    rigid_elements: "RBE2,9,1,1,2" "RBE3,9,,1,1" "RROD,9,1,2,1" "RBAR,9,1,2" "CRIGD1,9,1,2";
    matrices: "DMIG,K2GG,0,6,1,0" "K2GG,9";
    other_files: "INCLUDE 'wing/covers.bdf'" "INCLUDE \"a\"" "READFILE covers";
    parameters_of_the_model: "PARAM,COUPMASS,1" "PARAM,CM1,2." "PARAM,CM2,2." "PARAM,CK1,2." "PARAM,CK2,2." "MDLPRM,SHEARP,HARRIS" "MDLPRM,DELMASS,1.";
    superelements: "SEBULK,1,PRIMARY" "SECONCT,1,0" "CSUPER,1,2,1" "SETREE,1,2";
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
                    assert_eq!(found, [of_reason(&slip, 8, 1, found[0].reason)]);
                }
            }
        }
    }
}
