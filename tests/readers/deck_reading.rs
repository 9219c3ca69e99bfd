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
fn latin_1_is_read() {
    let text = [
        b"$ \xC4nderung f\xFCr Fl\xFCgel\n".as_slice(),
        ROD.as_bytes(),
    ]
    .concat();
    let found = deck::read("test", &text, &[]).unwrap();
    assert_eq!(found, read_deck(ROD).unwrap());
}

#[test]
fn neighbors_constrained_alike_are_written_as_a_range_and_one_alone_is_not() {
    let deck = "GRID,1,,,,,,12\nGRID,2,,1.,,,,12\nGRID,3,,2.,,,,3\nGRID,4,,3.\n";
    let model = read_deck(deck).unwrap().model;
    let text = bulk_text(&model).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("SPC1"));
    let held = lines.map(|line| line.split_whitespace().skip(1).collect_vec().join(" "));
    assert_eq!(held.collect_vec(), ["12456 1 THRU 2", "3456 3", "456 4"]);
}
