//! The figures of `paper/interpretation.md`: every printed column by every rule after the published number of iterations.

use super::diagram::{Diagram, Series, SeriesMark};
use super::published_counts::COUNTED;
use super::published_counts::{Counted, RULES, Rule};

/// Differences of gages, and error sums.
pub fn counted_figures() -> [(&'static str, Diagram); 2] {
    let of = |rule: Rule| COUNTED.iter().filter(move |column| column.rule == rule);
    let dots = |value: fn(&Counted) -> f64| {
        RULES.map(|rule| {
            let points = (1..)
                .map(f64::from)
                .zip(of(rule).map(|column| 100.0 * value(column)));
            Series::new(rule.name(), SeriesMark::Dots, points)
        })
    };
    let printed = |column: &Counted| {
        // A pass prints no error sum of its inner loop, but ended below its tolerance.
        let tolerance = if column.name.ends_with("pass 1") {
            0.025
        } else {
            0.015
        };
        100.0 * column.printed_sum.unwrap_or(tolerance)
    };
    let bars = (1..).map(f64::from).zip(of(Rule::Half).map(printed));
    let sketch = |title, label, top, series| Diagram {
        title,
        labels: ["column", label],
        x: (0.0, 19.0),
        y: (0.0, top),
        is_logarithmic: false,
        series,
    };
    let mut sums = vec![Series::new("printed", SeriesMark::Bars, bars)];
    sums.extend(dots(|column| column.error_sum));
    [
        (
            "counted_gages",
            sketch(
                "Gages after the published number of iterations",
                "RMS difference from the print, points",
                35.0,
                dots(|column| column.difference).to_vec(),
            ),
        ),
        (
            "counted_sums",
            sketch(
                "Error sums after the published number of iterations",
                "error sum, %",
                25.0,
                sums,
            ),
        ),
    ]
}
