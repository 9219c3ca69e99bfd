//! One deck in the forms in which programs write it: what is read is the same, or the line is named.

use crate::prelude::*;

/// Two rods in a row and a mass, as fields of cards.
const CARDS: [&str; 9] = [
    "GRID,1,,0.,0.,0.,,123456",
    "GRID,2,,10.5,0.,0.,,23456",
    "GRID,3,,21.25,0.,0.,,23456",
    "CROD,1,5,1,2",
    "CROD,2,5,2,3",
    "PROD,5,9,.0123",
    "MAT1,9,1.05+7,,.3,2.5-4",
    "CMASS2,7,.4,3,1",
    "SPC1,1,12,1,2,3",
];

fn read(text: &str) -> BulkData {
    let found = deck::read("forms.bdf", text.as_bytes(), &[]);
    found
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .model
}

fn all() -> String {
    CARDS.join("\n") + "\n"
}

properties! {
    /// A free real number of any length, with any exponent, is the number that it says.
    #[test]
    fn free_reals_of_any_length_are_read(value in -1e6..1e6_f64, digits in 1..25_usize, letter in prop::sample::select(vec!["E", "D", "e", ""])) {
        let written = format!("{value:.digits$e}").replace('e', "E");
        let (mantissa, exponent) = written.split_once('E').unwrap();
        let exponent: i32 = exponent.parse()?;
        let word = format!("{mantissa}{letter}{exponent:+}");
        let grid = read(&all().replace("10.5", &word)).grids[1].position.x;
        prop_assert_eq!(grid, written.parse::<f64>()?, "{}", word);
    }
}
