//! Factors of parameters as marks on a common axis, with their limits, published values and uncertainties.

use super::canvas::*;
use corfem::method::step::Bounds;
use corfem::present::table::Digits;

/// Margins of the plot: left at least, right, top, bottom, px.
const MARGINS: [f64; 4] = [64.0, 24.0, 44.0, 46.0];
const ROW: f64 = 24.0;
/// Most steps of the axis.
const STEPS: f64 = 7.0;

/// Mark of the value where a row began.
const OPEN: Mark = Mark(Form::Circle, 4.0, Some(WHITE), Pen(INK, 1.4, Dash::Solid));

/// A parameter's factor.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnFactor {
    /// Name of the parameter.
    pub name: String,
    /// Value of the factor.
    pub value: f64,
    /// Value where the row began, if that is not the origin.
    pub from: Option<f64>,
    /// Standard deviation of it.
    pub deviation: Option<f64>,
    /// The published factor.
    pub published: Option<f64>,
    /// Bounds of its own.
    pub bounds: Option<Bounds>,
    /// Remark on a factor that stands out.
    pub remark: Option<&'static str>,
}

/// Factors with their axis, limits and legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// Rows.
    pub rows: Vec<DrawnFactor>,
    /// Limits of all of them.
    pub limits: Option<Bounds>,
    /// Name of the horizontal axis.
    pub across: String,
    /// Name of the rows.
    pub down: &'static str,
    /// Value that every row is compared with.
    pub origin: f64,
    /// Decimals of the numbers.
    pub decimals: usize,
    /// Name of the published values.
    pub published: &'static str,
}

impl Factors {
    /// The factors as SVG.
    pub fn draw(&self, name: &str, title: &str) -> Result<String, PresentError> {
        let height = MARGINS[2] + MARGINS[3] + ROW * self.rows.len() as f64;
        svg(name, title, height, |area| self.draw_on(area))
    }

    /// True if a bound of a row lies on the axis.
    pub fn draws_bounds(&self) -> bool {
        let [low, high, _] = self.bounds();
        let bounds = self.rows.iter().filter_map(|row| row.bounds);
        bounds
            .flat_map(|range| [range.lower, range.upper])
            .any(|end| (low..=high).contains(&end))
    }

    /// Steps of one, two or five times a power of ten that hold everything with room for its number: lower end, upper end, step.
    fn bounds(&self) -> [f64; 3] {
        let each = |row: &DrawnFactor| {
            let deviation = row.deviation.unwrap_or(0.0);
            [
                row.value - deviation,
                row.value + deviation,
                row.published.unwrap_or(row.value),
                row.from.unwrap_or(row.value),
            ]
        };
        let values = || {
            self.rows
                .iter()
                .flat_map(each)
                .filter(|value| value.is_finite())
        };
        let least = values().fold(self.limits.map_or(self.origin, |_| 0.0), f64::min);
        let most = values().fold(
            self.limits.map_or(self.origin, |limits| limits.upper),
            f64::max,
        );
        let rough = (most - least).max(0.02) / STEPS;
        // A deviation and a remark stand behind their number.
        let has = |what: fn(&DrawnFactor) -> bool| f64::from(self.rows.iter().any(what));
        let words =
            0.9 + 1.5 * has(|row| row.deviation.is_some()) + 1.2 * has(|row| row.remark.is_some());
        let room = self.limits.map_or(words, |_| 0.4);
        let ten = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0]
            .into_iter()
            .map(|part| part * ten)
            .find(|step| *step >= rough)
            .unwrap_or(10.0 * ten);
        [
            step * (least / step - room).floor(),
            step * (most / step + room).ceil(),
            step,
        ]
    }

    fn draw_on(&self, area: &Area) -> Drawn {
        let [low, high, step] = self.bounds();
        let count = self.rows.len() as f64;
        let [_, right, top, bottom] = MARGINS;
        let margins = [
            name_room(self.rows.iter().map(|row| &row.name), MARGINS[0]),
            right,
            top,
            bottom,
        ];
        let mut chart = chart(area, margins).build_cartesian_2d(low..high, count..0.0)?;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        axes(&mut chart)
            .disable_y_mesh()
            .x_labels(((high - low) / step).round() as usize + 2)
            .y_labels(0)
            .x_label_formatter(&|x| signed(format!("{x:.decimals$}")))
            .x_desc(&self.across)
            .draw()?;
        let place = |factor: f64, row: f64| placed(&chart, factor, row);
        name_upright(area, self.down, top + 0.5 * ROW * count)?;
        let mut beyond = 0.0;
        if let Some(limits) = self.limits {
            let (upper, lower) = (place(limits.lower, 0.0), place(limits.upper, count));
            rectangle(area, upper, lower, between(WHITE, SKY, 0.6))?;
            let text = format!("limits {:.2} to {:.2}", limits.lower, limits.upper);
            let at = (0.5 * (upper.0 + lower.0), upper.1 - 13.0);
            write(
                area,
                &text,
                at,
                Letters {
                    color: BLUE,
                    ..MIDDLE
                },
            )?;
            beyond = lower.0;
        } else {
            let origin = [place(self.origin, 0.0), place(self.origin, count)];
            line(area, &origin, Pen::solid(GRAY, 1.0))?;
        }
        let diamond = Mark(Form::Diamond, 5.0, Some(ORANGE), Pen::solid(INK, 0.9));
        for (row, factor) in self.rows.iter().enumerate() {
            let row = row as f64 + 0.5;
            let (x, y) = place(low, row);
            write(area, &shortened(&factor.name), (x - 8.0, y), END)?;
            if !factor.value.is_finite() {
                continue;
            }
            let color = if factor.remark.is_some() {
                VERMILION
            } else {
                INK
            };
            let tip = place(factor.value, row);
            let ends = factor
                .bounds
                .iter()
                .flat_map(|range| [range.lower, range.upper]);
            for end in ends.filter(|end| (low..=high).contains(end)) {
                let (x, y) = place(end, row);
                line(area, &[(x, y - 7.0), (x, y + 7.0)], Pen::solid(BLUE, 1.6))?;
            }
            let from = place(factor.from.unwrap_or(self.origin), row);
            line(area, &[from, tip], Pen::solid(color, 2.0))?;
            if factor.from.is_some() {
                mark(area, from, OPEN)?;
            }
            if let Some(published) = factor.published {
                mark(area, place(published, row), diamond)?;
            }
            let mut ends = [tip.0, tip.0];
            let deviation = factor.deviation.filter(|deviation| deviation.is_finite());
            if let Some(deviation) = deviation {
                let bar = [-deviation, deviation].map(|part| place(factor.value + part, row));
                ends = bar.map(|(x, _)| x);
                line(area, &bar, Pen::solid(ORANGE, 2.4))?;
                for (x, y) in bar {
                    line(area, &[(x, y - 5.0), (x, y + 5.0)], Pen::solid(ORANGE, 2.0))?;
                }
            }
            // The estimate lies over its bar.
            mark(
                area,
                tip,
                Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0)),
            )?;
            // The number is next to its mark, on the side away from the published value or the start; a remark names a factor that
            // stands out.
            let written = |value: f64| signed(Digits::Fixed(self.decimals).write(value));
            let around = deviation.map(|deviation| format!(" ± {}", written(deviation)));
            let number = written(factor.value) + &around.unwrap_or_default();
            let other = factor.published.or(factor.from).unwrap_or(self.origin);
            let (text, at, letters) = match factor.remark {
                Some(remark) if self.limits.is_some() => (
                    format!("{remark}: {number}"),
                    (tip.0 - 10.0, tip.1 - 11.0),
                    END,
                ),
                remark => {
                    let text = format!("{number} {}", remark.unwrap_or_default())
                        .trim_end()
                        .to_owned();
                    match factor.value < other {
                        true => (text, (ends[0] - 10.0, tip.1), END),
                        false => (text, (ends[1].max(beyond) + 10.0, tip.1), START),
                    }
                }
            };
            // The line to the origin may pass behind it.
            if self.limits.is_none() {
                let wide = 0.6 * letters.height * text.chars().count() as f64;
                let right = if factor.value < other {
                    at.0
                } else {
                    at.0 + wide
                };
                rectangle(area, (right - wide, at.1 - 7.0), (right, at.1 + 7.0), WHITE)?;
            }
            write(area, &text, at, Letters { color, ..letters })?;
        }
        if self.rows.iter().any(|factor| factor.from.is_some()) {
            let (x, y) = place(high, 0.0);
            marked(area, (x - 230.0, y - 13.0), OPEN, "first model")?;
            let closed = Mark(Form::Circle, 4.0, Some(INK), Pen::solid(INK, 1.0));
            marked(area, (x - 120.0, y - 13.0), closed, "corrected")?;
        }
        if self.rows.iter().any(|factor| factor.published.is_some()) {
            let (x, y) = place(high, 0.0);
            marked(area, (x - 230.0, y - 13.0), diamond, self.published)?;
        }
        Ok(())
    }
}
