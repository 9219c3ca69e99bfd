//! What a deck may say and how: sets, two to a card, defaults, ranges, formats.

use crate::prelude::*;

/// A rod of E A/L = 1000 lbf/in from a fixed grid 1 along x to grid 2, which moves along x alone.
const ROD: &str = "\
GRID,1,,0.,0.,0.
GRID,2,,10.,0.,0.
CROD,1,1,1,2
PROD,1,1,.01
MAT1,1,1.+6,,.3
SPC1,1,123456,1
SPC1,1,23456,2
";

#[test]
fn case_control_selects_the_sets() {
    let deck = format!(
        "ID A,B\nCEND\nSPC = 1\n  mpc=4\nBEGIN  BULK\n{ROD}GRID,3,,20.,0.,0.,,23456\nMPC,4,3,1,-1.,2,1,1.\n\
         MPC,5,3,1,-1.,2,1,3.\nSPC1,2,1,2\nCMASS2,8,.4,3,1\nENDDATA\nnonsense"
    );
    let read = read_deck(&deck).unwrap();
    let skipped = |card: &str, line, count| Unread {
        card: card.into(),
        line,
        count,
        reason: Reason::NotSelected,
    };
    assert_eq!(read.unread, [skipped("MPC", 15, 1), skipped("SPC1", 16, 1)]);
    assert_eq!(read.model.ties.len(), 1);
    assert_eq!(read.model.ties[0].terms[0].1, 1.0);
    assert!(!read.model.grids[1].constrained[0]);
    // Case control that selects nothing holds nothing.
    let loose = format!("CEND\nBEGIN BULK\n{ROD}CMASS2,8,.4,2,1");
    let read = read_deck(&loose).unwrap();
    assert_eq!(read.unread, [skipped("SPC1", 8, 2)]);
    assert!(
        read.model
            .grids
            .iter()
            .all(|grid| grid.constrained == [false; 3])
    );
}

#[test]
fn cards_without_part_in_the_model_are_listed_by_name() {
    let deck = format!(
        "PARAM,GRDPNT,0\n{ROD}CMASS2,8,.4,2,1\nFORCE,9,2,0,1.,1.\nEIGR,1,INV\nPARAM,POST,-1\n+X,MAX\n"
    );
    let error = read_deck(&deck).expect_err("+X continues nothing");
    assert!(
        matches!(error, FileError::DeckLine { line: 13, .. }),
        "{error}"
    );
    let read = read_deck(deck.replace("+X,MAX\n", "")).unwrap();
    let listed = |card: &str, line, count| Unread {
        card: card.into(),
        line,
        count,
        reason: Reason::WithoutPart,
    };
    assert_eq!(read.unread, [listed("PARAM", 1, 2), listed("FORCE", 10, 1)]);
}

/// Grids 1 to 4 along x, and what the SPC1 cards of a deck constrain of their x, or its error.
fn held(control: &str, supports: &str) -> Result<Vec<bool>, FileError> {
    let deck = format!("{control}GRID,1\nGRID,2\nGRID,3\nGRID,4\n{supports}");
    let grids = read_deck(&deck)?.model.grids;
    Ok(grids.into_iter().map(|grid| grid.constrained[0]).collect())
}

#[test]
fn spcadd_joins_sets() {
    let supports = "SPCADD,10,1,2\nSPC1,1,1,1\nSPC1,2,1,2,3\n";
    assert_eq!(held("", supports).unwrap(), [true, true, true, false]);
    let more = format!("{supports}SPC1,7,1,4\nSPCADD,11,1,,7\n");
    for (set, expected) in [
        (10, [true, true, true, false]),
        (11, [true, false, false, true]),
        (2, [false, true, true, false]),
    ] {
        assert_eq!(
            held(&format!("SPC = {set}\nBEGIN BULK\n"), &more).unwrap(),
            expected,
            "{set}"
        );
    }
    let own = format!("{supports}SPC1,10,1,4\n");
    assert_eq!(
        held("SPC = 10\nBEGIN BULK\n", &own).unwrap(),
        [true, true, true, false],
        "its sets alone"
    );
    let long = "SPCADD,10,1,1,1,1,1,1,1,+A\n+A,2\nSPC1,1,1,1\nSPC1,2,1,2\n";
    assert_eq!(held("", long).unwrap(), [true, true, false, false]);
}

#[test]
fn sets_that_do_not_exist_or_that_nothing_selects_are_refused() {
    for (supports, line, field, expected) in [
        (
            "SPCADD,10,1,3\nSPC1,1,1,1\n",
            5,
            4,
            "the set of an SPC card",
        ),
        (
            "SPCADD,10\nSPC1,1,1,1\n",
            5,
            3,
            "a positive integer of at most eight digits",
        ),
        (
            "SPCADD,10,1\nSPC1,1,1,1\nSPC1,2,1,2\n",
            7,
            2,
            "beside set 10: a deck without case control may have one set",
        ),
        (
            "SPCADD,10,1\nSPC1,1,1,1\nSPCADD,11,1\n",
            7,
            2,
            "beside set 10: a deck without case control may have one set",
        ),
    ] {
        let error = held("", supports).expect_err(supports);
        assert!(
            matches!(&error, FileError::DeckField { line: at, field: of, reason, .. }
                if (*at, *of) == (line, field) && reason.contains(expected)),
            "{error}"
        );
    }
    let error = held("TITLE = A\nSPC = 3\nBEGIN BULK\n", "SPC1,1,1,1\n").expect_err("no set 3");
    assert_eq!(
        error.to_string(),
        "test, line 2: the deck has no set 3 of constraints"
    );
    let ignored = ["SPCAX".to_owned()];
    let deck = "SPC = 3\nBEGIN BULK\nGRID,1\nSPCAX,3,1,1\n";
    assert!(
        deck::read("test", deck.as_bytes(), &ignored).is_ok(),
        "its cards are left out by request"
    );
}

properties! {
    /// The deck of a weighted model is another deck of the same model, without the parameter.
    #[test]
    fn wtmass_multiplies_masses_and_densities(model in crate::common::decks::bulk_data(), factor in 1e-4..1e4_f64) {
        let factor = deck::number::nearest_in_field(factor);
        let value = deck::number::large_real(factor).unwrap();
        let text = bulk_text(&model)?;
        let weighted = read_deck(format!("PARAM*,WTMASS,{value}\n{text}"))?;
        prop_assert!(weighted.unread.iter().all(|card| card.reason == deck::Reason::Untouched));
        let mut expected = model;
        for element in &mut expected.elements {
            element.material.density = deck::number::nearest_in_field(factor * element.material.density);
        }
        for point in &mut expected.masses {
            point.mass = deck::number::nearest_in_field(factor * point.mass);
        }
        prop_assert_eq!(&weighted.model, &expected);
        let again = read_deck(bulk_text(&weighted.model)?)?;
        prop_assert_eq!(&again.model, &expected);
    }
}

#[test]
fn wtmass_may_stand_in_case_control_and_counts_once() {
    let text = format!("PARAM,WTMASS,.5\nSPC = 1\nBEGIN BULK\n{ROD}CMASS2,8,.4,2,1\n");
    for text in [text.clone(), format!("SUBCASE 1\n  {text}")] {
        assert_eq!(read_deck(&text).unwrap().model.masses[0].mass, 0.2);
    }
    for (more, line, what) in [
        ("PARAM,WTMASS,.5", 12, "the second PARAM,WTMASS"),
        ("PARAM,WTMASS,0.", 1, "a positive real number"),
        ("PARAM,WTMASS,2", 1, "a real number with a decimal point"),
        (
            "PARAM,WTMASS,1.-308",
            1,
            "a factor that keeps every mass within the range of numbers",
        ),
    ] {
        let text = if line == 1 {
            text.replace("PARAM,WTMASS,.5", more)
        } else {
            format!("{text}{more}\n")
        };
        let error = read_deck(&text).expect_err(more).to_string();
        assert!(
            error.starts_with(&format!("test, line {line}:")) && error.contains(what),
            "{error}"
        );
    }
}

#[test]
fn latin_1_and_a_byte_order_mark_are_read() {
    let expected = read_deck(ROD).unwrap();
    let marked = [
        b"\xEF\xBB\xBF$ \xC3\x84nderung\n".as_slice(),
        ROD.as_bytes(),
    ]
    .concat();
    let latin_1 = [
        b"$ \xC4nderung f\xFCr Fl\xFCgel\n".as_slice(),
        ROD.as_bytes(),
    ]
    .concat();
    for bytes in [
        [b"\xEF\xBB\xBF".as_slice(), ROD.as_bytes()].concat(),
        marked,
        latin_1,
    ] {
        assert_eq!(deck::read("test", &bytes, &[]).unwrap(), expected);
    }
    let name = [ROD.as_bytes(), b"CR\xD6D,2,1,1,2\n"].concat();
    let error = deck::read("test", &name, &[]).expect_err("no card has such a letter");
    assert!(
        matches!(&error, FileError::DeckCards { cards, .. } if cards[0].card == "CR\u{d6}D"),
        "{error}"
    );
}

#[test]
fn two_elements_or_properties_stand_on_a_card() {
    let deck = "\
GRDSET,,,,,,,456
GRID,1
GRID,2,,1.
GRID,3,,1.,1.,,,3
CROD,1,10,1,2,2,20,2,3
PROD,10,1,.5
PROD,20,1,.25
CTRMEM,4,30,1,2,3
CSHEAR,6,40,1,2,3,1
CQDMEM,7,50,1,2,3,1
PTRMEM,30,1,.1,0.,31,1,.2
PSHEAR,41,1,.3,,40,1,.4
PQDMEM,50,1,.5
MAT1,1,1.04+7,4.+6
";
    let model = read_deck(deck).unwrap().model;
    let sizes = model
        .elements
        .iter()
        .map(|element| element.size)
        .collect_vec();
    assert_eq!(sizes, [0.5, 0.25, 0.1, 0.4, 0.5]);
    assert_eq!(model.elements[1].grids, [2, 3]);
    assert_eq!(model.elements[2].grids, [1, 2, 3]);
    assert_eq!(model.elements[3].grids, [1, 2, 3, 1]);
    assert_eq!(
        model.grids[2].constrained,
        [false, false, true],
        "its own card counts"
    );
    assert_eq!(
        model.grids[0].constrained, [false; 3],
        "rotations have no place"
    );
    let material = model.elements[0].material;
    assert_eq!(material.shear_modulus, 4e6);
    approx::assert_relative_eq!(material.poissons_ratio, 0.3, epsilon = ROUND_OFF);
    assert_eq!(material.density, 0.0);
}

#[test]
fn mat1_derives_what_is_blank() {
    let with = |fields: &str| {
        let deck = ROD.replace("MAT1,1,1.+6,,.3", &format!("MAT1,1,{fields}"));
        read_deck(&deck).map(|deck| deck.model.elements[0].material)
    };
    let material = with("1.+7,,.25,3.-4").unwrap();
    assert_eq!((material.shear_modulus, material.density), (4e6, 3e-4));
    let material = with(",4.+6,.25").unwrap();
    assert_eq!(
        (material.youngs_modulus, material.shear_modulus),
        (1e7, 4e6)
    );
    let material = with("1.+7").unwrap();
    assert_eq!(material.youngs_modulus, 1e7);
    let material = with("1.+7,3.+6,.25").unwrap();
    assert_eq!(material.shear_modulus, 3e6);
    for (fields, field) in [
        (",4.+6", 3),
        (",,.3", 3),
        ("-1.,,.3", 3),
        ("1.+7,,.6", 5),
        ("1.+7,-4.+6,.3", 4),
        ("1.+7,,.3,-1.", 6),
    ] {
        let error = with(fields).expect_err(fields);
        assert!(
            matches!(&error, FileError::DeckField { card, line: 5, field: found, .. } if card == "MAT1" && *found == field),
            "{fields}: {error}"
        );
    }
}

#[test]
fn spc1_lists_and_ranges_constrain_grids() {
    let deck = "\
GRID,1
GRID,2
GRID,4
GRID,5
GRID,9
GRID,12
SPC1,1,1,1,THRU,4
SPC1,1,23,5,,9,,,,+B
SPC1,1,3,12,THRU,12
+B,12
";
    let model = read_deck(deck).unwrap().model;
    let constrained: Vec<[bool; 3]> = model.grids.iter().map(|grid| grid.constrained).collect();
    let x = [true, false, false];
    let yz = [false, true, true];
    assert_eq!(constrained, [x, x, x, yz, yz, yz]);
}

/// The field after the last of a line is the first of the next: fields 10 and 11 are no data.
#[test]
fn a_range_may_go_on_in_the_next_line() {
    let grids = "GRID,1\nGRID,2\nGRID,3\nGRID,4\n";
    let supports = "SPC1,1,1,,,,,,1,+B\n+B,THRU,3\nSPC1,1,2,,,,,2,THRU,+C\n+C,3,4\n";
    let model = read_deck(format!("{grids}{supports}")).unwrap().model;
    let constrained = model.grids.iter().map(|grid| grid.constrained);
    let x = [true, false, false];
    let xy = [true, true, false];
    assert!(constrained.eq([x, xy, xy, [false, true, false]]));
    let unknown = format!("{grids}SPC1,1,1,,,,,,1,+B\n+B,7\n");
    let error = read_deck(&unknown).expect_err("there is no grid 7");
    assert!(
        matches!(&error, FileError::DeckField { line: 6, field: 12, reason, .. } if reason.contains("\"7\"")),
        "{error}"
    );
}

#[test]
fn neighbors_constrained_alike_are_written_as_a_range_and_one_alone_is_not() {
    let deck = "GRID,1,,,,,,12\nGRID,2,,1.,,,,12\nGRID,3,,2.,,,,3\nGRID,4,,3.\n";
    let model = read_deck(deck).unwrap().model;
    let text = bulk_text(&model).unwrap();
    let constrained = text
        .lines()
        .filter(|line| line.starts_with("SPC1"))
        .map(|line| line.split_whitespace().skip(2).collect_vec())
        .collect_vec();
    assert_eq!(
        constrained,
        [
            vec!["12456", "1", "THRU", "2"],
            vec!["3456", "3"],
            vec!["456", "4"]
        ]
    );
}
