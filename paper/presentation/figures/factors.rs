//! Factors as marks on a common axis, with their limits, published values and starts.

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

/// Mark of a published value.
const DIAMOND: Mark = Mark(Form::Diamond, 5.0, Some(ORANGE), Pen(INK, 0.9, Dash::Solid));

/// A parameter's factor.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnFactor {
    /// Name of the parameter.
    pub name: String,
    /// Value of the factor.
    pub value: f64,
    /// Value where the row began, if that is not the origin.
    pub from: Option<f64>,
    /// The published factor.
    pub published: Option<f64>,
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
    pub across: &'static str,
    /// Name of the rows.
    pub down: &'static str,
    /// Value that every row is compared with.
    pub origin: f64,
    /// Decimals of the numbers.
    pub decimals: usize,
}

impl Factors {
    /// The factors as SVG.
    pub fn draw(&self, name: &str, title: &str) -> Result<String, PresentError> {
        let height = MARGINS[2] + MARGINS[3] + ROW * self.rows.len() as f64;
        svg(name, title, height, |area| self.draw_on(area))
    }

    /// Steps of one, two or five times a power of ten that hold everything, with room for its number: lower end, upper end, step. An
    /// axis of what is not negative does not begin below zero.
    fn bounds(&self) -> [f64; 3] {
        let values = || {
            self.rows.iter().flat_map(|row| {
                [
                    row.value,
                    row.published.unwrap_or(row.value),
                    row.from.unwrap_or(row.value),
                ]
            })
        };
        let (lower, upper) = self
            .limits
            .map_or((self.origin, self.origin), |limits| (0.0, limits.upper));
        let (least, most) = (
            values().fold(lower, f64::min),
            values().fold(upper, f64::max),
        );
        let rough = (most - least).max(0.02) / STEPS;
        let room = self.limits.map_or(0.9, |_| 0.4);
        let ten = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0]
            .into_iter()
            .map(|part| part * ten)
            .find(|step| *step >= rough)
            .unwrap_or(10.0 * ten);
        let low = step * (least / step - room).floor();
        [
            if least >= 0.0 { low.max(0.0) } else { low },
            step * (most / step + room).ceil(),
            step,
        ]
    }

    fn draw_on(&self, area: &Area) -> Drawn {
        let [low, high, step] = self.bounds();
        let count = self.rows.len() as f64;
        let [least, right, top, bottom] = MARGINS;
        let left = name_room(self.rows.iter().map(|row| &row.name), least);
        let margins = [left, right, top, bottom];
        let mut chart = chart(area, margins).build_cartesian_2d(low..high, count..0.0)?;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        axes(&mut chart)
            .disable_y_mesh()
            .x_labels(((high - low) / step).round() as usize + 2)
            .y_labels(0)
            .x_label_formatter(&|x| signed(format!("{x:.decimals$}")))
            .x_desc(self.across)
            .draw()?;
        let place = |factor: f64, row: f64| placed(area, &chart, factor, row);
        name_upright(area, self.down, top + 0.5 * ROW * count)?;
        if let Some(limits) = self.limits {
            let (upper, lower) = (place(limits.lower, 0.0), place(limits.upper, count));
            rectangle(area, upper, lower, tint(SKY, 0.6))?;
            let text = format!("limits {:.2} to {:.2}", limits.lower, limits.upper);
            let half = 3.9 * text.chars().count() as f64;
            let at = ((0.5 * (upper.0 + lower.0)).max(EDGE + half), upper.1 - 13.0);
            let letters = Letters {
                color: BLUE,
                ..MIDDLE
            };
            write(area, &text, at, letters)?;
        } else {
            let origin = [place(self.origin, 0.0), place(self.origin, count)];
            line(area, &origin, Pen::solid(GRAY, 1.0))?;
        }
        for (row, factor) in self.rows.iter().enumerate() {
            let row = row as f64 + 0.5;
            let start = place(low, row);
            write(area, &factor.name, (start.0 - 8.0, start.1), END)?;
            self.draw_row(area, factor, start.0, &|value| place(value, row))?;
        }
        self.draw_legend(area, place(high, 0.0))
    }

    /// Marks of a row with its number, which stands on the side away from the published value or the start; a remark names a factor that
    /// stands out.
    fn draw_row(
        &self,
        area: &Area,
        factor: &DrawnFactor,
        start: f64,
        place: &dyn Fn(f64) -> Place,
    ) -> Drawn {
        let color = factor.remark.map_or(INK, |_| VERMILION);
        let tip = place(factor.value);
        let from = place(factor.from.unwrap_or(self.origin));
        line(area, &[from, tip], Pen::solid(color, 2.0))?;
        if factor.from.is_some() {
            mark(area, from, OPEN)?;
        }
        if let Some(published) = factor.published {
            mark(area, place(published), DIAMOND)?;
        }
        let closed = Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0));
        mark(area, tip, closed)?;
        let number = signed(Digits::Fixed(self.decimals).write(factor.value));
        if let Some(remark) = factor.remark {
            let at = (tip.0 - 10.0, tip.1 - 11.0);
            let text = format!("{remark}: {number}");
            return write(area, &text, at, Letters { color, ..END });
        }
        let other = factor.from.unwrap_or(self.origin);
        let wide = 0.6 * START.height * number.chars().count() as f64;
        let is_left = factor.value < other && tip.0 - 10.0 - wide > start;
        let beyond = match self.limits {
            Some(limits) => place(limits.upper).0,
            None if factor.value < other => place(other).0,
            None => start,
        };
        let (at, letters) = match is_left {
            true => ((tip.0 - 10.0, tip.1), END),
            false => ((tip.0.max(beyond) + 10.0, tip.1), START),
        };
        // The line to the origin may pass behind it.
        if self.limits.is_none() {
            let right = if is_left { at.0 } else { at.0 + wide };
            rectangle(area, (right - wide, at.1 - 7.0), (right, at.1 + 7.0), WHITE)?;
        }
        write(area, &number, at, letters)
    }

    /// Marks with their meanings, above the axis and to its right end.
    fn draw_legend(&self, area: &Area, (x, y): Place) -> Drawn {
        let y = y - 13.0;
        if self.rows.iter().any(|factor| factor.from.is_some()) {
            marked(area, (x - 230.0, y), OPEN, "first model")?;
            let closed = Mark(Form::Circle, 4.0, Some(INK), Pen::solid(INK, 1.0));
            marked(area, (x - 120.0, y), closed, "corrected")?;
        }
        if self.rows.iter().any(|factor| factor.published.is_some()) {
            marked(area, (x - 230.0, y), DIAMOND, "published (“about 60”)")?;
        }
        Ok(())
    }
}
