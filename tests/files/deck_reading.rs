//! What a deck may say and how: sets, two to a card, defaults, ranges, formats.

use crate::common::tolerances::ROUND_OFF;
use corfem::files::deck::write::bulk_data;
use corfem::files::deck::{self, Reason, Unread};
use corfem::files::error::FileError;

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
    let read = deck::read("test", &deck).expect("it reads");
    let skipped = |card: &str, line| Unread {
        card: card.into(),
        line,
        reason: Reason::NotSelected,
    };
    assert_eq!(read.unread, [skipped("MPC", 15), skipped("SPC1", 16)]);
    assert_eq!(read.model.ties.len(), 1);
    assert_eq!(read.model.ties[0].terms[0].1, 1.0);
    assert!(!read.model.grids[1].constrained[0]);
    // Case control that selects nothing holds nothing.
    let loose = format!("CEND\nBEGIN BULK\n{ROD}CMASS2,8,.4,2,1");
    let read = deck::read("test", &loose).expect("it reads");
    assert_eq!(read.unread.len(), 2);
    assert!(
        read.model
            .grids
            .iter()
            .all(|grid| grid.constrained == [false; 3])
    );
}

#[test]
fn unknown_cards_are_listed_in_the_order_of_the_file() {
    let deck = format!(
        "PARAM,WTMASS,2.\n{ROD}CMASS2,8,.4,2,1\nCBAR,9,1,1,2,1.,0.,0.\nEIGR,1,INV\n+X,MAX\n"
    );
    let error = deck::read("test", &deck).expect_err("+X continues nothing");
    assert!(
        matches!(error, FileError::DeckLine { line: 12, .. }),
        "{error}"
    );
    let read = deck::read("test", &deck.replace("+X,MAX\n", "")).expect("it reads");
    let unknown = |card: &str, line| Unread {
        card: card.into(),
        line,
        reason: Reason::Unknown,
    };
    assert_eq!(read.unread, [unknown("PARAM", 1), unknown("CBAR", 10)]);
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
    let model = deck::read("test", deck).expect("it reads").model;
    let sizes: Vec<f64> = model.elements.iter().map(|element| element.size).collect();
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
        deck::read("test", &deck).map(|deck| deck.model.elements[0].material)
    };
    let material = with("1.+7,,.25,3.-4").expect("E and nu");
    assert_eq!((material.shear_modulus, material.density), (4e6, 3e-4));
    let material = with(",4.+6,.25").expect("G and nu");
    assert_eq!(
        (material.youngs_modulus, material.shear_modulus),
        (1e7, 4e6)
    );
    let material = with("1.+7,3.+6,.25").expect("all three");
    assert_eq!(material.shear_modulus, 3e6);
    for (fields, field) in [
        ("1.+7", 3),
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
fn spc1_lists_and_ranges_hold_grids() {
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
    let model = deck::read("test", deck).expect("it reads").model;
    let constrained: Vec<[bool; 3]> = model.grids.iter().map(|grid| grid.constrained).collect();
    let x = [true, false, false];
    let yz = [false, true, true];
    assert_eq!(constrained, [x, x, x, yz, yz, yz]);
}

#[test]
fn grdset_holds_where_a_grid_says_nothing() {
    let deck = "GRDSET,,,,,,,3\nGRID,1\nGRID,2,,1.,,,,1\n";
    let grids = deck::read("test", deck).expect("it reads").model.grids;
    assert_eq!(grids[0].constrained, [false, false, true]);
    assert_eq!(grids[1].constrained, [true, false, false]);
}

#[test]
fn neighbors_held_alike_are_written_as_a_range_and_one_alone_is_not() {
    let deck = "GRID,1,,,,,,12\nGRID,2,,1.,,,,12\nGRID,3,,2.,,,,3\nGRID,4,,3.\n";
    let model = deck::read("test", deck).expect("it reads").model;
    let text = bulk_data(&model, &mut 0).expect("a deck");
    let constrained: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.starts_with("SPC1"))
        .map(|line| line.split_whitespace().skip(2).collect())
        .collect();
    assert_eq!(
        constrained,
        [
            vec!["12456", "1", "THRU", "2"],
            vec!["3456", "3"],
            vec!["456", "4"]
        ]
    );
}

#[test]
fn formats_and_sections_of_a_deck_by_hand() {
    // Small fields, tabs, a large card whose second half is missing, and a continuation without a tag.
    let deck = "\
GRID*                  1                              1.              2.
GRID\t2\t\t3.\t4.\t5.\t\t12\t\tremark
MPC     1       1       1       1.      2       3       .5
        \t2\t3\t1.5
";
    let model = deck::read("test", deck).expect("it reads").model;
    assert_eq!(model.grids[0].position.as_slice(), [1.0, 2.0, 0.0]);
    assert_eq!(model.grids[1].position.as_slice(), [3.0, 4.0, 5.0]);
    assert_eq!(model.grids[1].constrained, [true, true, false]);
    assert_eq!(model.ties[0].terms.len(), 2);
    assert_eq!(model.ties[0].terms[1].1, 1.5);
}

#[test]
fn what_stands_behind_column_80_does_not_count() {
    let card = format!("{:80}12345678", "GRID    1               1.");
    let more = format!(
        "{:80}12345678",
        "GRID*                  2                              1.              2."
    );
    let model = deck::read("test", &format!("{card}\n{more}\n"))
        .expect("it reads")
        .model;
    assert_eq!(model.grids[0].position.as_slice(), [1.0, 0.0, 0.0]);
    assert_eq!(model.grids[1].position.as_slice(), [1.0, 2.0, 0.0]);
}
