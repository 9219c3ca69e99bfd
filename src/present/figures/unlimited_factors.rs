//! Unlimited stiffness change factors of a first iteration with the limits drawn (Case 4).

use super::canvas::{
    Area, BLUE, Drawn, Form, INK, LETTERS, Letters, ORANGE, PALE, Pen, SKY, Side, VERMILION, WIDTH, between, line,
    mark, name_upright, rectangle, svg, units, write,
};
use crate::cases::CaseResult;
use crate::method::model::Range;
use crate::present::error::PresentError;
use crate::present::report::run_tables::factor_table;
use crate::present::report::table::{Cell, Digits};
use plotters::prelude::*;

/// One parameter's factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// Name of the parameter.
    pub parameter: String,
    /// Unlimited factor.
    pub computed: f64,
    /// What the paper prints, if it does.
    pub published: Option<f64>,
    /// What the report says of it.
    pub verdict: String,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct UnlimitedFactors {
    /// Case number.
    pub case: usize,
    /// Factors of the first iteration.
    pub factors: Vec<Factor>,
    /// Limits of one iteration.
    pub limits: Range,
}

/// Factors of a case, from its factor table.
pub fn unlimited_factors(result: &CaseResult) -> UnlimitedFactors {
    let factors = factor_table(result)
        .rows
        .into_iter()
        .filter_map(|row| match row.cells.as_slice() {
            [Cell::Number { computed, published, .. }, Cell::Text(verdict)] => Some(Factor {
                parameter: row.label,
                computed: *computed,
                published: *published,
                verdict: verdict.clone(),
            }),
            _ => None,
        })
        .collect();
    UnlimitedFactors { case: result.case.number, factors, limits: result.case.settings.inner.factor_range }
}

/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [64.0, 24.0, 44.0, 46.0];
const ROW: f64 = 24.0;

impl UnlimitedFactors {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_factors", self.case);
        let title = format!("Case {}: unlimited stiffness change factors", self.case);
        let height = MARGINS[2] + MARGINS[3] + ROW * self.factors.len() as f64;
        svg(&name, &title, (WIDTH, height), |area| self.on(area))
    }

    /// Tens that hold every factor with room for its number.
    fn bounds(&self) -> (f64, f64) {
        let values = || {
            let each = |factor: &Factor| [Some(factor.computed), factor.published];
            self.factors.iter().flat_map(each).flatten()
        };
        let least = values().fold(0.0, f64::min);
        let most = values().fold(self.limits.upper, f64::max);
        (10.0 * (least / 10.0 - 0.4).floor(), 10.0 * (most / 10.0 + 0.4).ceil())
    }

    fn on(&self, area: &Area) -> Drawn {
        let [left, right, top, bottom] = MARGINS;
        let (low, high) = self.bounds();
        let count = self.factors.len();
        let mut chart = ChartBuilder::on(area)
            .margin_right(units(right))
            .margin_top(units(top))
            .x_label_area_size(units(bottom))
            .y_label_area_size(units(left))
            .build_cartesian_2d(low..high, count as f64..0.0)?;
        let words = Letters::new(LETTERS, Side::Center);
        chart
            .configure_mesh()
            .disable_y_mesh()
            .bold_line_style(Pen::solid(PALE, 0.8).style())
            .light_line_style(TRANSPARENT)
            .axis_style(Pen::solid(INK, 1.0).style())
            .x_labels(((high - low) / 10.0) as usize + 2)
            .y_labels(0)
            .x_label_formatter(&|x| format!("{x:.0}").replace('-', "−"))
            .label_style(words.style())
            .axis_desc_style(words.style())
            .x_desc("unlimited stiffness change factor, first iteration")
            .set_all_tick_mark_size(units(4.0))
            .draw()?;
        let plot = chart.plotting_area();
        let place = |factor: f64, row: f64| {
            let (x, y) = plot.map_coordinate(&(factor, row));
            (f64::from(x) / f64::from(units(1.0)), f64::from(y) / f64::from(units(1.0)))
        };
        name_upright(area, "panel", top + 0.5 * ROW * count as f64)?;
        let (upper, lower) = (place(self.limits.lower, 0.0), place(self.limits.upper, count as f64));
        rectangle(area, upper, lower, between(WHITE, SKY, 0.6))?;
        let at = (0.5 * (upper.0 + lower.0), upper.1 - 13.0);
        let text = format!("limits {:.2} to {:.2}", self.limits.lower, self.limits.upper);
        write(area, &text, at, words.color(BLUE))?;
        for (row, factor) in self.factors.iter().enumerate() {
            let row = row as f64 + 0.5;
            write(
                area,
                &factor.parameter,
                (place(low, row).0 - 8.0, place(low, row).1),
                Letters::new(LETTERS, Side::Left),
            )?;
            let color = if factor.verdict == "anomaly" { VERMILION } else { INK };
            let tip = place(factor.computed, row);
            line(area, &[place(1.0, row), tip], Pen::solid(color, 2.0))?;
            if let Some(published) = factor.published {
                mark(area, place(published, row), (Form::Diamond, 5.0), Some(ORANGE), Pen::solid(INK, 0.9))?;
            }
            mark(area, tip, (Form::Circle, 4.0), Some(color), Pen::solid(color, 1.0))?;
            self.write_factor(area, factor, (tip, lower.0), color)?;
        }
        if self.factors.iter().any(|factor| factor.published.is_some()) {
            let (x, y) = (place(high, 0.0).0 - 230.0, upper.1 - 13.0);
            mark(area, (x, y), (Form::Diamond, 5.0), Some(ORANGE), Pen::solid(INK, 0.9))?;
            write(area, "published (“about 60”)", (x + 12.0, y), Letters::new(LETTERS, Side::Right))?;
        }
        Ok(())
    }

    /// The number beside its mark, away from the limits; an anomaly is named.
    fn write_factor(&self, area: &Area, factor: &Factor, (tip, limit): ((f64, f64), f64), color: RGBColor) -> Drawn {
        let number = Digits::Fixed(1).write(factor.computed).replace('-', "−");
        let (x, side) = if factor.verdict == "anomaly" || factor.computed < 1.0 {
            (tip.0 - 10.0, Side::Left)
        } else {
            (tip.0.max(limit) + 10.0, Side::Right)
        };
        let (text, y) =
            if factor.verdict == "anomaly" { (format!("anomaly: {number}"), tip.1 - 11.0) } else { (number, tip.1) };
        let letters = Letters::new(LETTERS, side).color(color);
        write(area, &text, (x, y), letters)
    }
}
