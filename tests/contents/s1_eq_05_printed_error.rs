//! (5) as printed: the error of a frequency is relative.

use crate::prelude::*;

#[test]
fn frequency_error_is_relative() {
    // Table 3's initial errors in percent have the SRSS the text prints, 0.3828; differences in hertz do not.
    let table = PublishedTable::number(3).unwrap();
    let (mut relative, mut absolute) = (0.0, 0.0);
    for mode in 1..=9 {
        let row = mode.to_string();
        let percent = table.required(&row, "initial_percent").unwrap();
        let difference =
            table.required(&row, "initial_hz").unwrap() - table.required(&row, "gvt_hz").unwrap();
        relative += (percent / 100.0_f64).powi(2);
        absolute += difference * difference;
    }
    assert_within(relative.sqrt(), 0.3828, PRINTED_SRSS);
    assert!(
        (97.0..98.0).contains(&absolute.sqrt()),
        "{}",
        absolute.sqrt()
    );
}
