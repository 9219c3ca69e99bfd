//! What stands around the cards of a deck, and what is read and has no part in the model.

use crate::prelude::*;
use crate::readers::deck_errors::GOOD;

/// Several programs write a checksum there.
#[test]
fn what_follows_enddata_does_not_count() {
    let good = deck::read("wing.bdf", GOOD.as_bytes(), &[]).unwrap().model;
    for end in [
        "ENDDATA 13664a4e",
        "enddata",
        "  ENDDATA\t7",
        "ENDDATA,1",
        "ENDDATA $ the end",
    ] {
        let text = format!("{GOOD}{end}\nCBAR,9\nnonsense, \"\n");
        assert_eq!(
            deck::read("wing.bdf", text.as_bytes(), &[])
                .expect(end)
                .model,
            good
        );
    }
    let text = format!("{GOOD}ENDDATAX\n");
    assert!(deck::read("wing.bdf", text.as_bytes(), &[]).is_err());
}

/// Two subcases with supports of their own are two models; the first counts, and cards of the other are named.
#[test]
fn of_several_subcases_the_first_selects_the_constraints() {
    let held = |control: &str| {
        let text = format!("{control}BEGIN BULK\n{GOOD}SPC,2,2,123\n");
        let read = deck::read("wing.bdf", text.as_bytes(), &[]).expect(control);
        (
            read.model.grids[1].constrained[0],
            read.unread[0].card.clone(),
        )
    };
    let [first, second] = [(false, "SPC".to_owned()), (true, "SPC1".to_owned())];
    assert_eq!(held("SUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 2\n"), first);
    assert_eq!(held("SUBCASE 1\nSPC = 2\nSUBCASE 2\nSPC = 1\n"), second);
    assert_eq!(held("SPC = 1\nSUBCASE 1\nSUBCASE 2\nSPC = 2\n"), first);
    assert_eq!(held("SPC = 1\nSUBCASE 1\nSPC = 2\nSUBCASE 2\n"), second);
}

/// NASTRAN-95 has a second panel's property in field 6, later programs a factor, which must be zero here.
#[test]
fn a_property_of_shear_panels_may_end_in_zeros_or_in_another_property() {
    let read = |card: &str| {
        let text =
            format!("{GOOD}{card}\nGRID,3,,10.,10.,0.\nGRID,4,,0.,10.,0.\nCSHEAR,5,2,1,2,3,4\n");
        deck::read("wing.bdf", text.as_bytes(), &[]).map(|read| read.model.elements[1].size)
    };
    for card in [
        "PSHEAR,2,1,.5",
        "PSHEAR,2,1,.5,0.",
        "PSHEAR,2,1,.5,0.,0.,0.",
        "PSHEAR,2,1,.5,,0,0",
        "PSHEAR,2,1,.5,,,0.",
    ] {
        assert_eq!(read(card).unwrap_or_else(|error| panic!("{error}")), 0.5);
    }
    assert_eq!(read("PSHEAR,3,1,.1,,2,1,.25").unwrap(), 0.25);
    assert!(read("PSHEAR,2,1,.5,0.,1.,0.").is_err());
}

#[test]
fn torsion_of_rods_is_named_and_in_no_stiffness() {
    let text = GOOD.replace("PROD,1,1,.01", "PROD,1,1,.01,.5") + "CONROD,2,1,2,1,.5,.25\n";
    let read = deck::read("wing.bdf", text.as_bytes(), &[]).unwrap();
    let said = read
        .unread
        .iter()
        .map(corfem::present::tables::deck::not_read)
        .collect_vec();
    assert_eq!(
        said,
        [
            "Not read: PROD J (line 4, 1 card), torsion of rods: grids have no rotations here.",
            "Not read: CONROD J (line 8, 1 card), torsion of rods: grids have no rotations here."
        ]
    );
    let plain = deck::read(
        "wing.bdf",
        text.replace(",.5,.25", ",.5")
            .replace(",.01,.5", ",.01")
            .as_bytes(),
        &[],
    );
    assert_eq!(read.model, plain.unwrap().model);
}
