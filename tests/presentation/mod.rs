//! Tables, figures, the page, and the program from outside.

pub mod figures;
pub mod play;
pub mod program;
pub mod report;
pub mod tables;

use crate::prelude::*;

/// How far numbers of goldens may be apart, and that everything else is the same to the letter.
#[test]
fn a_golden_holds_words_blanks_rules_and_whole_numbers_and_every_number_by_its_unit() {
    let others = "element 8|element 9, 2 passes|3 passes, a    1.0|a  1.0, ─────|────, f 10.60 Hz|f 10.61 Hz, f -1.0|f 1.0, \
                  f 10.0 Hz|f 10.0 Hz 3, f 1e-3|f 1e-4, one\ntwo|one two, a 1.0|a\u{a0}1.0";
    for pair in others.split(", ") {
        let (one, other) = pair.split_once('|').unwrap();
        assert!(Numbers::AS_WRITTEN.agree(one, one), "{one}");
        for numbers in [Numbers::AS_WRITTEN, Numbers::BY_UNIT] {
            assert!(!numbers.agree(one, other), "{pair}");
        }
    }
    let drawn = |x: &str| Numbers::DRAWN.agree("x=\"10.6\"", &format!("x=\"{x}\""));
    assert_eq!(["10.7", "10.8", "11"].map(drawn), [true, false, false]);
    for (unit, part) in [("Hz", 1e-5), ("in", 1e-4), ("%", 1e-4)] {
        let row = |value: f64| format!("table,\"1, 2\",GVT,{unit},{value},10");
        let agrees = |times: f64| Numbers::BY_UNIT.agree(&row(10.0), &row(10.0 + times * part));
        assert_eq!([0.9, 1.1].map(agrees), [true, false], "{unit}");
    }
}
