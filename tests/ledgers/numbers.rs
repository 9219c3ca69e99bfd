//! How far numbers of goldens may be apart, and that everything else is the same to the letter.

use crate::prelude::*;

#[test]
fn a_golden_holds_words_blanks_rules_and_whole_numbers() {
    let text = Numbers::AS_WRITTEN;
    for (one, other) in [
        ("element 8", "element 9"),
        ("Worst is mode 6.", "Worst is mode 7."),
        ("2 passes", "3 passes"),
        ("Table 3", "Table 4"),
        ("a    1.0", "a  1.0"),
        ("a 1.0", "a\u{a0}1.0"),
        ("─────", "────"),
        ("f 10.60 Hz", "f 10.61 Hz"),
        ("f -1.0", "f 1.0"),
        ("f 10.0 Hz", "g 10.0 Hz"),
        ("f 10.0 Hz", "f 10.0 Hz 3"),
        ("f 1e-3", "f 1e-4"),
        ("one\ntwo", "one two"),
    ] {
        assert!(
            text.agree(one, one) && !text.agree(one, other),
            "{one}: {other}"
        );
        assert!(!Numbers::BY_UNIT.agree(one, other), "{one}: {other}");
    }
    assert!(Numbers::DRAWN.agree("x=\"10.6\"", "x=\"10.7\""));
    assert!(!Numbers::DRAWN.agree("x=\"10.6\"", "x=\"10.8\""));
    assert!(!Numbers::DRAWN.agree("x=\"10\"", "x=\"11\""));
}

#[test]
fn a_golden_table_holds_every_number_by_its_unit() {
    let row = |unit: &str, value: f64| format!("table,\"1, 2\",GVT,{unit},{value},10");
    for (unit, within, beyond) in [
        ("Hz", 10.0 * (1.0 + 0.9e-6), 10.0 * (1.0 + 1.1e-6)),
        ("in", 10.0 * (1.0 + 0.9e-5), 10.0 * (1.0 + 1.1e-5)),
        ("%", 10.0 + 0.9e-4, 10.0 + 1.1e-4),
        ("", 10.0, 11.0),
    ] {
        let golden = row(unit, 10.0);
        assert!(
            Numbers::BY_UNIT.agree(&golden, &row(unit, within)),
            "{unit}"
        );
        assert!(
            !Numbers::BY_UNIT.agree(&golden, &row(unit, beyond)),
            "{unit}"
        );
    }
    // A gage half a percent off, which a tolerance meant for percent would forgive.
    assert!(!Numbers::BY_UNIT.agree(&row("in", 0.01), &row("in", 0.01005)));
}
