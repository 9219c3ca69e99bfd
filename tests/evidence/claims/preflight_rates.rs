//! How often the pre-flight names mistakes made on purpose, and how often it is wrong.

use crate::common::tolerances::{LEAST_COLUMNS, LEAST_DETECTIONS, MOST_LOW_PAIRS};
use crate::evidence::plant::{MISTAKES, Mistake};
use crate::evidence::rates::{Rates, SEEDS, all_rates, rates, spring_chain};
use std::sync::OnceLock;

pub fn study() -> &'static [Rates] {
    static STUDY: OnceLock<Vec<Rates>> = OnceLock::new();
    STUDY.get_or_init(|| all_rates(SEEDS).expect("it runs"))
}

#[test]
fn no_good_test_is_accused() {
    assert_eq!(study().len(), 4);
    for found in study() {
        assert_eq!(
            (found.seeds, found.false_alarms),
            (100, 0),
            "{}",
            found.name
        );
        // Low pairs are so, by noise: that of the box's light points is large where heavy ones ought to rest.
        assert!(
            found.low_pairs
                <= if found.name.starts_with("Case") {
                    MOST_LOW_PAIRS
                } else {
                    0
                },
            "{}",
            found.name
        );
    }
}

#[test]
fn nearly_every_mistake_is_named() {
    for found in study() {
        for rate in &found.rates {
            let what = format!("{}: {rate:?}", found.name);
            assert!(
                rate.named <= rate.told && rate.told <= rate.said && rate.said <= found.seeds,
                "{what}"
            );
            assert!(rate.told >= LEAST_DETECTIONS, "{what}");
            // Columns of T look like sensors where masses are alike.
            assert!(
                rate.named
                    >= if rate.mistake == Mistake::TwoColumns {
                        LEAST_COLUMNS
                    } else {
                        LEAST_DETECTIONS
                    },
                "{what}"
            );
        }
        let possible = MISTAKES
            .into_iter()
            .filter(|m| *m != Mistake::Transposed || found.name != "Delta wing");
        assert!(
            possible.eq(found.rates.iter().map(|rate| rate.mistake)),
            "{}",
            found.name
        );
    }
}

#[test]
fn the_same_seeds_give_the_same_rates() {
    let chain = spring_chain().unwrap();
    let few = rates(&chain, 1..=5).unwrap();
    assert_eq!(few, rates(&chain, 1..=5).unwrap());
    assert_eq!(few.seeds, 5);
    assert!(few.rates.iter().all(|rate| rate.said <= 5));
}
