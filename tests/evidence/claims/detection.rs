//! What is named off the reconstructed box, and how often.

use crate::evidence::detection::{BOXES, BoxRates, SIZES, box_rates, tables};
use crate::prelude::*;

/// Gage, by which the verdict of a case is made, names no sound element; own hardly ever asks for about 60.
fn assert_no_alarms(rates: &BoxRates, boxes: usize) {
    assert_eq!((rates.mistaken[3], rates.alarms[3]), (0, 0), "{rates:?}");
    assert!(rates.about_60[1] * 10 < boxes, "{rates:?}");
}

#[test]
#[ignore = "a minute: 900 other boxes, twice"]
fn detection_holds_off_this_box() {
    assert_golden("detection", &csv(&tables()), Numbers::COUNTED);
    for size in SIZES {
        let rates = box_rates(size, BOXES);
        assert!(rates.named[3] * 100 >= LEAST_DETECTED_BOXES * BOXES);
        assert_no_alarms(&rates, BOXES);
    }
}

#[test]
fn a_few_other_boxes_are_detected_too() {
    for size in SIZES {
        let rates = box_rates(size, 20);
        assert!(2 * rates.named[3] > 20, "{rates:?}");
        assert!(
            rates.named[3] > rates.named[1].max(rates.named[0]),
            "{rates:?}"
        );
        assert_no_alarms(&rates, 20);
    }
}
