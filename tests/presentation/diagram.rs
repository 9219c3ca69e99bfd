//! Diagrams: every point where the axes say.

use crate::common::drawings::attribute;
use crate::evidence::diagram::{Diagram, Series, SeriesMark};
use crate::prelude::*;

#[test]
fn a_point_midway_on_both_axes_lies_midway() {
    for (y, is_logarithmic, middle) in [((0.0, 8.0), false, 4.0), ((0.1, 1000.0), true, 10.0)] {
        let points = [(0.0, y.0), (1.0, middle), (2.0, y.1)];
        let diagram = Diagram {
            title: "a diagram",
            labels: ["across", "up"],
            x: (0.0, 2.0),
            y,
            is_logarithmic,
            series: vec![Series::new("dots", SeriesMark::Dots, points)],
        };
        let svg = diagram.svg().unwrap();
        // The legend's dots come behind them.
        let circles = svg.split("<circle").skip(1).step_by(2).take(3);
        let dots = circles.map(|tag| ["cx", "cy"].map(|name| attribute(tag, name)));
        let dots = dots.collect_vec();
        for axis in [0, 1] {
            let between = 0.5 * (dots[0][axis] + dots[2][axis]);
            assert_within(dots[1][axis], between, DRAWN_UNIT);
        }
        assert!(dots[2][0] > dots[0][0] && dots[2][1] < dots[0][1]);
    }
}
