//! Diagrams: every point where the axes say, and a legend of what has a name.

use crate::common::drawings::{attribute, words};
use crate::evidence::diagram::{Diagram, Series, SeriesMark};
use crate::prelude::*;

fn drawn(y: (f64, f64), is_logarithmic: bool, series: Vec<Series>) -> String {
    let diagram = Diagram {
        title: "a diagram",
        labels: ["across", "up"],
        x: (0.0, 2.0),
        y,
        is_logarithmic,
        series,
    };
    diagram.svg().expect("it can be drawn")
}

/// Centers of the first three dots; the legend's come behind them.
fn dots(svg: &str) -> Vec<[f64; 2]> {
    let circles = svg.split("<circle").skip(1).step_by(2).take(3);
    circles
        .map(|tag| ["cx", "cy"].map(|name| attribute(tag, name)))
        .collect()
}

#[test]
fn a_point_midway_on_both_axes_lies_midway() {
    for (y, is_logarithmic, middle) in [((0.0, 8.0), false, 4.0), ((0.1, 1000.0), true, 10.0)] {
        let points = [(0.0, y.0), (1.0, middle), (2.0, y.1)];
        let svg = drawn(
            y,
            is_logarithmic,
            vec![Series::new("dots", SeriesMark::Dots, points)],
        );
        let dots = dots(&svg);
        for axis in [0, 1] {
            let between = 0.5 * (dots[0][axis] + dots[2][axis]);
            assert!((dots[1][axis] - between).abs() <= DRAWN_UNIT, "{dots:?}");
        }
        assert!(dots[2][0] > dots[0][0] && dots[2][1] < dots[0][1]);
    }
}

#[test]
fn a_series_without_a_name_goes_on_in_the_color_of_the_one_before() {
    let line = |name, points| Series::new(name, SeriesMark::Line, points);
    let series = vec![
        line("first", [(0.0, 1.0), (1.0, 2.0)]),
        line("", [(1.0, 3.0), (2.0, 4.0)]),
        line("second", [(0.0, 5.0), (2.0, 6.0)]),
    ];
    let svg = drawn((0.0, 8.0), false, series);
    let written = words(&svg);
    for name in ["first", "second", "across", "up", "a diagram"] {
        assert_eq!(
            written.iter().filter(|word| *word == name).count(),
            1,
            "{name}"
        );
    }
    assert!(written.iter().all(|word| !word.is_empty()));
    // A line each, and one in the legend for what has a name.
    let lines = ["<polyline", "<line"]
        .iter()
        .flat_map(|kind| svg.split(kind).skip(1))
        .filter_map(|tag| tag.split('>').next())
        .collect_vec();
    let of = |color: &str| lines.iter().filter(|tag| tag.contains(color)).count();
    assert_eq!((of("#0072B2"), of("#D55E00")), (3, 2), "{svg}");
}

#[test]
fn small_powers_of_ten_are_written_as_such() {
    let svg = drawn(
        (1e-6, 1.0),
        true,
        vec![Series::new(
            "a",
            SeriesMark::Line,
            [(0.0, 1e-6), (2.0, 1.0)],
        )],
    );
    let written = words(&svg);
    for label in ["10⁻⁶", "10⁻⁴", "0.001", "1"] {
        assert!(
            written.iter().any(|word| word == label),
            "{label}: {written:?}"
        );
    }
}
