//! Bars of a histogram: as high as their counts, side by side over the numbers they stand for.

use crate::common::drawings::attribute;
use crate::common::tolerances::DRAWN_UNIT;
use crate::presentation::figures_made_up::{spread, summary};
use corfem::present::figures::histogram::draw;
use proptest::prelude::*;

/// Left, top, width and height of every bar, in the units of the drawing: what is filled, without the page itself.
fn bars(svg: &str) -> Vec<[f64; 4]> {
    let filled = svg.split("<rect").skip(2);
    filled
        .map(|tag| ["x", "y", "width", "height"].map(|name| attribute(tag, name)))
        .collect()
}

/// Places across of the lines at the quantiles, by their color.
fn lines(svg: &str) -> Vec<f64> {
    let blue = svg
        .split("<polyline")
        .chain(svg.split("<line"))
        .filter(|tag| tag.contains("#0072B2"));
    blue.filter_map(|tag| {
        tag.split_once("points=\"")?
            .1
            .split(',')
            .next()?
            .trim()
            .parse()
            .ok()
    })
    .collect()
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn bars_are_as_high_as_their_counts_and_as_wide_as_their_intervals(
        counts in prop::collection::vec(0..30_usize, 2..12),
        least in -3.0..3.0_f64,
        length in 0.01..5.0_f64,
    ) {
        prop_assume!(counts.iter().any(|&count| count > 0));
        let middle = least + 0.5 * length;
        let spread = spread([least, least + length], [least, middle, least + length], &counts);
        let svg = draw("histogram", "Samples", &summary(vec![("factor", Some(spread))])).expect("drawn");
        let (bars, tallest) = (bars(&svg), *counts.iter().max().expect("some"));
        let shown: Vec<(usize, usize)> = counts.iter().copied().enumerate().filter(|(_, count)| *count > 0).collect();
        prop_assert_eq!(bars.len(), shown.len(), "no bar for no samples");
        // The quantiles stand at both ends of the axis and in its middle.
        let at = lines(&svg);
        prop_assert!(at.len() >= 3, "{}", svg);
        let (left, right) = at.iter().fold((f64::MAX, f64::MIN), |(low, high), &x| (low.min(x), high.max(x)));
        let wide = (right - left) / counts.len() as f64;
        prop_assert!((right - left - 2140.0).abs() < 2.0 * DRAWN_UNIT);
        let ground = bars[0][1] + bars[0][3];
        let highest = bars.iter().map(|bar| bar[3]).fold(0.0, f64::max);
        for ([x, y, width, height], (row, count)) in bars.into_iter().zip(shown) {
            prop_assert!((x - left - wide * row as f64).abs() < 2.0 * DRAWN_UNIT);
            prop_assert!((width - wide).abs() < 2.0 * DRAWN_UNIT);
            prop_assert!((y + height - ground).abs() < DRAWN_UNIT);
            prop_assert!((height - highest * count as f64 / tallest as f64).abs() < 2.0 * DRAWN_UNIT);
        }
    }
}
