//! Diagrams: a few series over two axes.

use super::canvas::{
    Area, BLUE, Dash, Drawn, END, Form, GRAY, INK, Mark, ORANGE, Pen, PresentError, SKY, VERMILION,
    axes, chart, line, mark, name_upright, placed, rectangle, svg, write,
};
use super::chart::Chart;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;

/// How a series is drawn.
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

/// Points drawn together, with what they are called.
#[derive(Debug, Clone)]
pub struct Series {
    /// Its name in the legend; none for what goes on with the series before.
    pub name: &'static str,
    /// How it is drawn.
    pub mark: SeriesMark,
    /// Its points.
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

/// A diagram: what its axes are called, from where to where they go, and what stands in it.
#[derive(Debug, Clone)]
pub struct Diagram {
    /// What it shows.
    pub title: &'static str,
    /// What its axes are called, across and up.
    pub labels: [&'static str; 2],
    /// Ends of the axis across.
    pub x: (f64, f64),
    /// Ends of the axis up.
    pub y: (f64, f64),
    /// Whether the axis up is logarithmic.
    pub is_logarithmic: bool,
    /// What is drawn.
    pub series: Vec<Series>,
}

const HEIGHT: f64 = 340.0;
/// Left, right, top and bottom, px.
const MARGINS: [f64; 4] = [72.0, 20.0, 10.0, 48.0];
const COLORS: [RGBColor; 6] = [BLUE, VERMILION, ORANGE, GRAY, SKY, INK];
/// Half the width of a bar, px.
const HALF_BAR: f64 = 9.0;

impl Diagram {
    /// The diagram as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn svg(&self) -> Result<String, PresentError> {
        svg(self.title, self.title, HEIGHT, |area| {
            let (x, y) = (self.x.0..self.x.1, self.y.0..self.y.1);
            let mut builder = chart(area, MARGINS);
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

    fn draw_on<Y>(
        &self,
        area: &Area,
        mut chart: Chart<'_, '_, plotters::coord::types::RangedCoordf64, Y>,
    ) -> Drawn
    where
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        // Without the round-off of sums of decimal steps.
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
            .x_labels(7)
            .y_labels(6)
            .x_label_formatter(&tick)
            .y_label_formatter(&upright)
            .x_desc(self.labels[0])
            .draw()?;
        name_upright(
            area,
            self.labels[1],
            0.5 * (HEIGHT + MARGINS[2] - MARGINS[3]),
        )?;
        let ground = if self.is_logarithmic { self.y.0 } else { 0.0 };
        let right = placed(&chart, self.x.1, self.y.1);
        let mut row = 0;
        for Series {
            name,
            mark: form,
            points,
        } in &self.series
        {
            row += usize::from(!name.is_empty());
            let color = COLORS[(row.max(1) - 1) % COLORS.len()];
            let dash = if *form == SeriesMark::Dashed {
                Dash::Dashed
            } else {
                Dash::Solid
            };
            let dot = Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0));
            let places = points
                .iter()
                .map(|&(x, y)| (placed(&chart, x, y), placed(&chart, x, ground)));
            let places: Vec<_> = places.collect();
            match form {
                SeriesMark::Line | SeriesMark::Dashed => {
                    let line_of = places.iter().map(|(at, _)| *at).collect::<Vec<_>>();
                    line(area, &line_of, Pen(color, 1.8, dash))?;
                }
                SeriesMark::Dots => places.iter().try_for_each(|(at, _)| mark(area, *at, dot))?,
                SeriesMark::Bars => places.iter().try_for_each(|((x, y), (_, ground))| {
                    rectangle(
                        area,
                        (x - HALF_BAR, y.min(*ground)),
                        (x + HALF_BAR, y.max(*ground)),
                        color,
                    )
                })?,
            }
            if !name.is_empty() {
                let at = (right.0 - 36.0, right.1 + 18.0 * row as f64 - 4.0);
                write(area, name, (at.0 - 6.0, at.1), END)?;
                match form {
                    SeriesMark::Dots => mark(area, (at.0 + 14.0, at.1), dot)?,
                    _ => line(
                        area,
                        &[at, (at.0 + 28.0, at.1)],
                        Pen(
                            color,
                            if *form == SeriesMark::Bars { 8.0 } else { 2.4 },
                            dash,
                        ),
                    )?,
                }
            }
        }
        line(
            area,
            &[
                placed(&chart, self.x.0, self.y.0),
                placed(&chart, self.x.1, self.y.0),
            ],
            Pen::solid(INK, 1.0),
        )
    }
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
