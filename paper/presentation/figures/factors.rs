//! Factors of parameters as marks on a common axis, with their limits, published values and uncertainties.

use super::canvas::*;
use corfem::method::step::Bounds;
use corfem::present::table::Digits;

/// Margins of the plot: left at least, right, top, bottom, px.
const MARGINS: [f64; 4] = [64.0, 24.0, 44.0, 46.0];
const ROW: f64 = 24.0;
/// Height of a row of the narrow form, whose name and number stand above its marks, px.
const HIGH_ROW: f64 = 40.0;
/// Most steps of the axis, and of that of the narrow form.
const STEPS: [f64; 2] = [7.0, 4.0];

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
    pub fn draw(&self, name: &str, title: &str, wide: f64) -> Result<String, PresentError> {
        let row = if wide < WIDE { HIGH_ROW } else { ROW };
        let height = MARGINS[2] + MARGINS[3] + row * self.rows.len() as f64;
        svg(name, title, (wide, height), |area| self.draw_on(area, row))
    }

    /// True if a bound of a row lies on the axis.
    pub fn draws_bounds(&self) -> bool {
        let [low, high, _] = self.bounds(false);
        let bounds = self.rows.iter().filter_map(|row| row.bounds);
        bounds
            .flat_map(|range| [range.lower, range.upper])
            .any(|end| (low..=high).contains(&end))
    }

    /// Steps of one, two or five times a power of ten that hold everything, with room for its number where that stands beside it: lower
    /// end, upper end, step. An axis of what is not negative does not begin below zero.
    fn bounds(&self, is_narrow: bool) -> [f64; 3] {
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
        let rough = (most - least).max(0.02) / STEPS[usize::from(is_narrow)];
        // A deviation and a remark stand behind their number.
        let has = |what: fn(&DrawnFactor) -> bool| f64::from(self.rows.iter().any(what));
        let words =
            0.9 + 1.5 * has(|row| row.deviation.is_some()) + 1.2 * has(|row| row.remark.is_some());
        let beside = self.limits.map_or(words, |_| 0.4);
        let room = if is_narrow { 0.1 } else { beside };
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

    fn draw_on(&self, area: &Area, row_high: f64) -> Drawn {
        let is_narrow = width(area) < WIDE;
        let [low, high, step] = self.bounds(is_narrow);
        let count = self.rows.len() as f64;
        let [least, right, top, bottom] = MARGINS;
        let left = match is_narrow {
            true => right,
            false => name_room(self.rows.iter().map(|row| &row.name), least),
        };
        let margins = [left, right, top, bottom];
        let mut chart = chart(area, margins).build_cartesian_2d(low..high, count..0.0)?;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        axes(&mut chart)
            .disable_y_mesh()
            .x_labels(((high - low) / step).round() as usize + 2)
            .y_labels(0)
            .x_label_formatter(&|x| signed(format!("{x:.decimals$}")))
            .x_desc(&self.across)
            .axis_desc_style(if is_narrow { MIDDLE.small() } else { MIDDLE }.style())
            .draw()?;
        let place = |factor: f64, row: f64| placed(area, &chart, factor, row);
        if !is_narrow {
            name_upright(area, self.down, top + 0.5 * row_high * count)?;
        }
        if let Some(limits) = self.limits {
            let (upper, lower) = (place(limits.lower, 0.0), place(limits.upper, count));
            rectangle(area, upper, lower, between(WHITE, SKY, 0.6))?;
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
            // Half of the row, or below the name.
            let part = if is_narrow { 0.7 } else { 0.5 };
            let row = row as f64 + part;
            if !is_narrow {
                let (x, y) = place(low, row);
                write(area, &shortened(&factor.name), (x - 8.0, y), END)?;
            }
            let ends = self.draw_row(area, factor, [low, high], &|value| place(value, row))?;
            self.write_row(area, factor, (&place, low, row), ends)?;
        }
        self.draw_legend(area, place(high, 0.0))
    }

    /// Marks of a row, and where they end left and right, px; no ends of what is no number.
    fn draw_row(
        &self,
        area: &Area,
        factor: &DrawnFactor,
        [low, high]: [f64; 2],
        place: &dyn Fn(f64) -> Place,
    ) -> Drawn<Option<[f64; 2]>> {
        if !factor.value.is_finite() {
            return Ok(None);
        }
        let color = factor.color();
        let tip = place(factor.value);
        let ends = factor
            .bounds
            .iter()
            .flat_map(|range| [range.lower, range.upper]);
        for end in ends.filter(|end| (low..=high).contains(end)) {
            let (x, y) = place(end);
            line(area, &[(x, y - 7.0), (x, y + 7.0)], Pen::solid(BLUE, 1.6))?;
        }
        let from = place(factor.from.unwrap_or(self.origin));
        line(area, &[from, tip], Pen::solid(color, 2.0))?;
        if factor.from.is_some() {
            mark(area, from, OPEN)?;
        }
        if let Some(published) = factor.published {
            mark(area, place(published), DIAMOND)?;
        }
        let mut ends = [tip.0, tip.0];
        if let Some(deviation) = factor.finite_deviation() {
            let bar = [-deviation, deviation].map(|part| place(factor.value + part));
            ends = bar.map(|(x, _)| x);
            line(area, &bar, Pen::solid(ORANGE, 2.4))?;
            for (x, y) in bar {
                line(area, &[(x, y - 5.0), (x, y + 5.0)], Pen::solid(ORANGE, 2.0))?;
            }
        }
        // The estimate lies over its bar.
        let closed = Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0));
        mark(area, tip, closed)?;
        Ok(Some(ends))
    }

    /// Number of a row, next to its mark on the side away from the published value or the start, with a remark that names a factor that
    /// stands out; in the narrow form above it, behind the row's name.
    fn write_row(
        &self,
        area: &Area,
        factor: &DrawnFactor,
        (place, low, row): (&dyn Fn(f64, f64) -> Place, f64, f64),
        ends: Option<[f64; 2]>,
    ) -> Drawn {
        let written = |value: f64| signed(Digits::Fixed(self.decimals).write(value));
        let around = factor
            .finite_deviation()
            .map(|deviation| format!(" ± {}", written(deviation)));
        let number = written(factor.value) + &around.unwrap_or_default();
        let text = match factor.remark {
            Some(remark) if self.limits.is_some() => format!("{remark}: {number}"),
            remark => format!("{number} {}", remark.unwrap_or_default()),
        };
        let text = text.trim_end();
        let count = text.chars().count();
        let color = factor.color();
        if width(area) < WIDE {
            let (left, y) = place(low, row);
            let (left, right, y) = (left + 4.0, width(area) - EDGE, y - 19.0);
            let text = if ends.is_some() { text } else { "" };
            let room = ((right - left) / 7.8) as usize;
            let name = cut(&factor.name, room.saturating_sub(2 + count).clamp(1, 40));
            // The lines of the axis pass behind both.
            let wide = |words: &str| 7.8 * words.chars().count() as f64;
            for (from, to) in [(left, left + wide(&name)), (right - wide(text), right)] {
                rectangle(area, (from, y - 8.0), (to, y + 8.0), WHITE)?;
            }
            write(area, &name, (left, y), START)?;
            return write(area, text, (right, y), Letters { color, ..END });
        }
        let Some(ends) = ends else {
            return Ok(());
        };
        let (tip, start) = (place(factor.value, row), place(low, row).0);
        if self.limits.is_some() && factor.remark.is_some() {
            let at = (tip.0 - 10.0, tip.1 - 11.0);
            return write(area, text, at, Letters { color, ..END });
        }
        let other = factor.published.or(factor.from).unwrap_or(self.origin);
        let wide = 0.6 * START.height * count as f64;
        let is_left = factor.value < other && ends[0] - 10.0 - wide > start;
        let beyond = match self.limits {
            Some(limits) => place(limits.upper, row).0,
            None if factor.value < other => place(other, row).0,
            None => start,
        };
        let (at, letters) = match is_left {
            true => ((ends[0] - 10.0, tip.1), END),
            false => ((ends[1].max(beyond) + 10.0, tip.1), START),
        };
        // The line to the origin may pass behind it.
        if self.limits.is_none() {
            let right = if is_left { at.0 } else { at.0 + wide };
            rectangle(area, (right - wide, at.1 - 7.0), (right, at.1 + 7.0), WHITE)?;
        }
        write(area, text, at, Letters { color, ..letters })
    }

    /// Marks with their meanings, above the axis and to its right end; the narrow form has them above the limits.
    fn draw_legend(&self, area: &Area, (x, y): Place) -> Drawn {
        let words = 32.0 + 7.8 * self.published.chars().count() as f64;
        let (y, left) = match width(area) < WIDE {
            true => (y - 31.0, words),
            false => (y - 13.0, words.max(230.0)),
        };
        if self.rows.iter().any(|factor| factor.from.is_some()) {
            marked(area, (x - 230.0, y), OPEN, "first model")?;
            let closed = Mark(Form::Circle, 4.0, Some(INK), Pen::solid(INK, 1.0));
            marked(area, (x - 120.0, y), closed, "corrected")?;
        }
        if self.rows.iter().any(|factor| factor.published.is_some()) {
            marked(area, (x - left, y), DIAMOND, self.published)?;
        }
        Ok(())
    }
}

impl DrawnFactor {
    /// Color of its marks and of its number.
    fn color(&self) -> RGBColor {
        if self.remark.is_some() {
            VERMILION
        } else {
            INK
        }
    }

    fn finite_deviation(&self) -> Option<f64> {
        self.deviation.filter(|deviation| deviation.is_finite())
    }
}
