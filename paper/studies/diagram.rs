//! Diagrams of documents: a few series over two axes, drawn as the report's figures are.

use crate::paper::figures::canvas::{
    BLUE, Dash, Form, GRAY, INK, KEY, LINE, MIDDLE, Mark, Named, ORANGE, PALE, Pen, SKY, VERMILION,
    WIDE, corners, line, mark, name_ends, name_upright, polygon, svg, write,
};
use crate::prelude::*;
use plotters::style::RGBColor;

/// Drawing style of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawn {
    /// Lines through the points, broken at a point that is no number.
    Lines(Dash),
    /// A dot at every point.
    Dots,
    /// A bar to every point from zero.
    Bars,
}

/// Name, drawing style and points of a series.
pub type Series = (&'static str, Drawn, Vec<(f64, f64)>);

/// A diagram: its subject, the names of its axes across and up, and its series.
///
/// Of each axis the first, second and last number are given; the one up is logarithmic over three powers of ten and more.
#[derive(Debug, Clone)]
pub struct Diagram(
    pub &'static str,
    pub [&'static str; 2],
    pub [f64; 3],
    pub [f64; 3],
    pub Vec<Series>,
);

const HEIGHT: f64 = 340.0;
/// Left, top and bottom of the plot, px.
const PLOT: [f64; 3] = [72.0, 10.0, 292.0];
const COLORS: [RGBColor; 6] = [BLUE, VERMILION, ORANGE, GRAY, SKY, INK];

impl Diagram {
    /// The diagram as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn svg(&self) -> Result<String, PresentError> {
        let Self(title, labels, x_ticks, y_ticks, all) = self;
        let [left, top, bottom] = PLOT;
        let longest = all.iter().map(|(name, ..)| name.chars().count()).max();
        let right = WIDE - KEY - 7.8 * longest.unwrap_or(0) as f64;
        let [first, _, last] = *y_ticks;
        let is_logarithmic = first > 0.0 && last > 999.0 * first;
        let up = |y: f64| if is_logarithmic { y.log10() } else { y };
        let place = |x: f64, y: f64| {
            let across = (x - x_ticks[0]) / (x_ticks[2] - x_ticks[0]);
            let height = (up(y) - up(first)) / (up(last) - up(first));
            (
                left + (right - left) * across,
                bottom - (bottom - top) * height,
            )
        };
        let ticks = |[first, second, last]: [f64; 3], is_logarithmic: bool| {
            let next = move |at: &f64| match is_logarithmic {
                true => at * second / first,
                false => at + second - first,
            };
            // But for the round-off of sums and products.
            std::iter::successors(Some(first), move |at| Some(next(at)))
                .take_while(move |at| *at < 1.001 * last)
        };
        svg(title, title, HEIGHT, |area| {
            for y in ticks(*y_ticks, is_logarithmic) {
                let down = place(x_ticks[0], y).1;
                let tick = if is_logarithmic {
                    format!("{y:.0e}")
                } else {
                    y.to_string()
                };
                line(area, &[(left, down), (right, down)], Pen::solid(PALE, 0.8))?;
                write(area, &tick, (left - 26.0, down), MIDDLE)?;
            }
            for x in ticks(*x_ticks, false) {
                write(
                    area,
                    &x.to_string(),
                    (place(x, first).0, bottom + 14.0),
                    MIDDLE,
                )?;
            }
            write(
                area,
                labels[0],
                (0.5 * (left + right), bottom + 36.0),
                MIDDLE,
            )?;
            name_upright(area, labels[1], 0.5 * (top + bottom))?;
            let ground = if is_logarithmic { first } else { 0.0 };
            let mut ends = Vec::new();
            for ((name, drawn, points), row) in all.iter().zip(0_u8..) {
                let color = COLORS[usize::from(row)];
                let pen = Pen::solid(color, 1.0);
                let places = points.iter().map(|&(x, y)| place(x, y)).collect_vec();
                let beside = (right, top + 14.0 + LINE * f64::from(row));
                let of = |form, size| Mark(form, size, Some(color), pen);
                ends.push(match drawn {
                    Drawn::Lines(dash) => {
                        for piece in places.split(|(_, down)| down.is_nan()) {
                            line(area, piece, Pen(color, 1.8, *dash))?;
                        }
                        Named(
                            places[places.len() - 1],
                            name,
                            Some(Pen(color, 2.4, *dash)),
                            None,
                        )
                    }
                    Drawn::Dots => {
                        places
                            .iter()
                            .try_for_each(|at| mark(area, *at, of(Form::Circle, 4.0)))?;
                        Named(beside, name, None, Some(of(Form::Circle, 4.0)))
                    }
                    Drawn::Bars => {
                        places.iter().try_for_each(|&(x, y)| {
                            let end = (x + 9.0, place(0.0, ground).1);
                            polygon(area, &corners((x - 9.0, y), end), Some(color), pen)
                        })?;
                        Named(beside, name, None, Some(of(Form::Square, 5.0)))
                    }
                });
            }
            if ends.len() > 1 {
                name_ends(area, ends)?;
            }
            line(
                area,
                &[(left, bottom), (right, bottom)],
                Pen::solid(INK, 1.0),
            )
        })
    }
}
