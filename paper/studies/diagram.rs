//! Diagrams of documents: a few series over two axes, drawn as the report's figures are.

use crate::paper::figures::canvas::{
    Area, BLUE, Dash, Drawn, Form, GRAY, INK, KEY, LINE, Mark, Named, ORANGE, Pen, SKY, VERMILION,
    axes, chart, corners, line, mark, name_ends, name_upright, placed, polygon, svg,
};
use crate::paper::figures::chart::Chart;
use crate::prelude::*;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;

/// Drawing style of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesMark {
    /// A line through the points.
    Line,
    /// A dashed one.
    Dashed,
    /// A dot at every point.
    Dots,
    /// A bar to every point, from zero or from the lower end of a logarithmic axis.
    Bars,
}

/// Points drawn together, with their name.
#[derive(Debug, Clone)]
pub struct Series {
    /// Name of the series; empty for one that continues the series before.
    pub name: &'static str,
    /// Drawing style.
    pub mark: SeriesMark,
    /// Points of the series.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A series of these points.
    pub fn new(
        name: &'static str,
        mark: SeriesMark,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().collect();
        Self { name, mark, points }
    }
}

/// A diagram: the names and ends of its axes, and its series.
#[derive(Debug, Clone)]
pub struct Diagram {
    /// Subject of the diagram.
    pub title: &'static str,
    /// Names of its axes, across and up.
    pub labels: [&'static str; 2],
    /// Ends of the axis across.
    pub x: (f64, f64),
    /// Ends of the axis up.
    pub y: (f64, f64),
    /// True if the axis up is logarithmic.
    pub is_logarithmic: bool,
    /// The series that are drawn.
    pub series: Vec<Series>,
}

const HEIGHT: f64 = 340.0;
/// Left, right without names, top and bottom, px.
const MARGINS: [f64; 4] = [72.0, 20.0, 10.0, 48.0];
const COLORS: [RGBColor; 6] = [BLUE, VERMILION, ORANGE, GRAY, SKY, INK];
/// Half the width of a bar, px.
const HALF_BAR: f64 = 9.0;
/// Most labels along the axis across.
const LABELS: usize = 7;

impl Diagram {
    /// The diagram as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn svg(&self) -> Result<String, PresentError> {
        svg(self.title, self.title, HEIGHT, |area| {
            let (x, y) = (self.x.0..self.x.1, self.y.0..self.y.1);
            let mut builder = chart(area, self.margins());
            if !self.is_logarithmic {
                return self.draw_on(area, builder.build_cartesian_2d(x, y)?);
            }
            let [low, high] = [y.start, y.end].map(|end| end.log10().round() as i32);
            let powers = (low..=high).step_by(if high - low > 7 { 2 } else { 1 });
            let powers = powers.map(|power| 10f64.powi(power)).collect();
            let y = y.log_scale().with_key_points(powers);
            self.draw_on(area, builder.build_cartesian_2d(x, y)?)
        })
    }

    /// Room of the axes, and of the names at the ends of lines.
    fn margins(&self) -> [f64; 4] {
        let [left, right, top, bottom] = MARGINS;
        let names = name_margin(self.series.iter().map(|series| series.name));
        let right = if self.has_lines() { names } else { right };
        [left, right, top, bottom]
    }

    /// True if names stand at the ends of lines; bars and dots have a legend instead.
    fn has_lines(&self) -> bool {
        let is_line =
            |series: &Series| matches!(series.mark, SeriesMark::Line | SeriesMark::Dashed);
        self.series.iter().any(is_line)
    }

    fn draw_on<Y>(
        &self,
        area: &Area,
        mut chart: Chart<'_, '_, plotters::coord::types::RangedCoordf64, Y>,
    ) -> Drawn
    where
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        // Four digits, without the round-off of sums of decimal steps.
        let tick = |value: &f64| {
            let text = format!("{value:.3e}");
            text.parse::<f64>().unwrap_or(*value).to_string()
        };
        let upright = |value: &f64| match value.abs().log10().round() as i32 {
            power @ ..-3 if self.is_logarithmic => format!("10{}", raised(power)),
            _ => tick(value),
        };
        axes(&mut chart)
            .disable_x_mesh()
            .x_labels(LABELS)
            .y_labels(6)
            .x_label_formatter(&tick)
            .y_label_formatter(&upright)
            .x_desc(self.labels[0])
            .draw()?;
        let [_, _, top, bottom] = MARGINS;
        name_upright(area, self.labels[1], 0.5 * (HEIGHT + top - bottom))?;
        let ground = if self.is_logarithmic { self.y.0 } else { 0.0 };
        let end_of = placed(area, &chart, self.x.1, self.y.1);
        let mut ends: Vec<Named> = Vec::new();
        for Series {
            name,
            mark: form,
            points,
        } in &self.series
        {
            let row = ends.len() - usize::from(name.is_empty() && !ends.is_empty());
            let color = COLORS[row % COLORS.len()];
            let dash = if *form == SeriesMark::Dashed {
                Dash::Dashed
            } else {
                Dash::Solid
            };
            let dot = Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0));
            let places = points
                .iter()
                .map(|&(x, y)| (placed(area, &chart, x, y), placed(area, &chart, x, ground)));
            let places = places.collect_vec();
            match form {
                SeriesMark::Line | SeriesMark::Dashed => {
                    let line_of = places.iter().map(|(at, _)| *at).collect_vec();
                    line(area, &line_of, Pen(color, 1.8, dash))?;
                }
                SeriesMark::Dots => places.iter().try_for_each(|(at, _)| mark(area, *at, dot))?,
                SeriesMark::Bars => places.iter().try_for_each(|((x, y), (_, ground))| {
                    let bar = corners((x - HALF_BAR, *y), (x + HALF_BAR, *ground));
                    polygon(area, &bar, Some(color), Pen::solid(color, 1.0))
                })?,
            }
            let (pen, key) = match form {
                SeriesMark::Dots => (None, Some(dot)),
                SeriesMark::Bars => (None, Some(Mark(Form::Square, 5.0, Some(color), dot.3))),
                _ => (Some(Pen(color, 2.4, dash)), None),
            };
            let end = places.last().map_or(end_of, |(at, _)| *at);
            match ends.last_mut() {
                Some(last) if name.is_empty() => last.0 = end,
                _ => ends.push(Named(end, name, pen, key)),
            }
        }
        if !self.has_lines() {
            let names = name_margin(ends.iter().map(|named| named.1));
            let (left, first) = (end_of.0 - names - 6.0, end_of.1 + 14.0);
            let rows = ends
                .iter_mut()
                .zip((0..).map(|row| first + LINE * f64::from(row)));
            rows.for_each(|(end, down)| end.0 = (left, down));
        }
        if ends.len() > 1 {
            name_ends(area, ends)?;
        }
        line(
            area,
            &[
                placed(area, &chart, self.x.0, self.y.0),
                placed(area, &chart, self.x.1, self.y.0),
            ],
            Pen::solid(INK, 1.0),
        )
    }
}

/// Room for names behind the ends of their lines, px.
fn name_margin<'a>(names: impl Iterator<Item = &'a str>) -> f64 {
    let longest = names.map(|name| name.chars().count()).max();
    KEY + 7.8 * longest.unwrap_or(0) as f64
}

/// A negative number as an exponent.
fn raised(power: i32) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |digit: char| {
        digit
            .to_digit(10)
            .map_or('⁻', |digit| digits[digit as usize])
    };
    power.to_string().chars().map(raise).collect()
}
