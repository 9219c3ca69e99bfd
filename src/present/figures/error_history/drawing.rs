//! The history drawn: errors on a logarithmic scale, passes side by side.

use super::{ErrorHistory, Moment};
use crate::method::error_sum::Errors;
use crate::present::error::PresentError;
use crate::present::figures::canvas::{
    Area, BLUE, Dash, Drawn, Form, GRAY, INK, LETTERS, Letters, PALE, Pen, Side, VERMILION, WIDTH, line, mark,
    name_upright, svg, units, write,
};
use plotters::prelude::*;

/// The three errors as drawn: name, value, color and form.
type Series = (&'static str, fn(&Errors) -> f64, RGBColor, Form, Dash);
const SERIES: [Series; 3] = [
    ("sum of both", Errors::sum, INK, Form::Diamond, Dash::Solid),
    ("frequency error", |errors| errors.frequency, VERMILION, Form::Square, Dash::Dashed),
    ("shape error", |errors| errors.shape, BLUE, Form::Circle, Dash::Dotted),
];

/// Ticks of the error axis, percent.
const TICKS: [f64; 10] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [72.0, 16.0, 88.0, 48.0];
const HEIGHT: f64 = 450.0;

impl ErrorHistory {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_errors", self.case);
        let title = format!("Case {}: errors against iteration", self.case);
        svg(&name, &title, (WIDTH, HEIGHT), |area| self.on(area))
    }

    fn moments(&self) -> impl Iterator<Item = &Moment> {
        let passes = self.passes.iter();
        passes.flat_map(|pass| pass.inner.iter().chain([&pass.check]))
    }

    /// The ticks that just hold every error, percent.
    fn bounds(&self) -> (f64, f64) {
        let values = || {
            let each = |moment: &Moment| SERIES.map(|(_, value, ..)| 100.0 * value(&moment.errors));
            self.moments().flat_map(each)
        };
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(0.0, f64::max);
        let below = TICKS.iter().rev().find(|tick| **tick < 0.9 * least);
        let above = TICKS.iter().find(|tick| **tick > 1.1 * most);
        (*below.unwrap_or(&TICKS[0]), *above.unwrap_or(&TICKS[9]))
    }

    fn on(&self, area: &Area) -> Drawn {
        let [left, right, top, bottom] = MARGINS;
        let last = self.moments().map(|moment| moment.iteration).max().unwrap_or(0) as f64;
        let (low, high) = self.bounds();
        let ticks: Vec<f64> = TICKS.into_iter().filter(|tick| (low..=high).contains(tick)).collect();
        let mut chart = ChartBuilder::on(area)
            .margin_right(units(right))
            .margin_top(units(top))
            .x_label_area_size(units(bottom))
            .y_label_area_size(units(left))
            .build_cartesian_2d(-0.4..last + 0.4, (low..high).log_scale().with_key_points(ticks))?;
        let words = Letters::new(LETTERS, Side::Center);
        chart
            .configure_mesh()
            .disable_x_mesh()
            .bold_line_style(Pen::solid(PALE, 0.8).style())
            .light_line_style(TRANSPARENT)
            .axis_style(Pen::solid(INK, 1.0).style())
            .x_labels(last as usize + 2)
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| format!("{y}"))
            .label_style(words.style())
            .axis_desc_style(words.style())
            .x_desc("accepted iterations of the inner loop")
            .set_all_tick_mark_size(units(4.0))
            .draw()?;
        let plot = chart.plotting_area();
        let place = |iteration: f64, percent: f64| {
            let (x, y) = plot.map_coordinate(&(iteration, percent));
            (f64::from(x) / f64::from(units(1.0)), f64::from(y) / f64::from(units(1.0)))
        };
        self.passes_on(area, &place, (low, high))?;
        name_upright(area, "SRSS error, percent (log scale)", 0.5 * (HEIGHT + top - bottom))?;
        // Lines first, so that no line crosses the open marks of exact solutions.
        for (_, value, color, form, dash) in SERIES {
            let at = |moment: &Moment| place(moment.iteration as f64, 100.0 * value(&moment.errors));
            for pass in &self.passes {
                let points: Vec<_> = pass.inner.iter().map(at).collect();
                line(area, &points, Pen { color, width: 1.8, dash })?;
                for &point in points.iter().skip(1) {
                    mark(area, point, (form, 2.6), Some(color), Pen::solid(color, 1.0))?;
                }
            }
            let starts = self.passes.iter().take(1).flat_map(|pass| pass.inner.first());
            for exact in starts.chain(self.passes.iter().map(|pass| &pass.check)) {
                mark(area, at(exact), (form, 5.5), None, Pen::solid(color, 1.8))?;
            }
        }
        legend(area)
    }

    /// Bands, names and tolerances of the passes.
    fn passes_on(&self, area: &Area, place: &dyn Fn(f64, f64) -> (f64, f64), (low, high): (f64, f64)) -> Drawn {
        for pass in &self.passes {
            let from = pass.inner.first().map_or(0, |moment| moment.iteration) as f64;
            let to = pass.check.iteration as f64;
            let (begin, end) = (place(from, high), place(to, high));
            let tolerance = 100.0 * pass.tolerance;
            let name = match end.0 - begin.0 {
                wide if wide > 180.0 => format!("pass {} (tolerance {tolerance:.1} %)", pass.pass),
                wide if wide > 50.0 => format!("pass {}", pass.pass),
                _ => pass.pass.to_string(),
            };
            let at = (0.5 * (begin.0 + end.0), begin.1 - 11.0);
            write(area, &name, at, Letters::new(LETTERS, Side::Center))?;
            let dash = Dash::Dashed;
            line(area, &[place(to, low), end], Pen { color: GRAY, width: 1.0, dash })?;
            let level = [place(from, tolerance), place(to, tolerance)];
            line(area, &level, Pen::solid(GRAY, 1.4))?;
        }
        Ok(())
    }
}

fn legend(area: &Area) -> Drawn {
    let words = Letters::new(LETTERS, Side::Right);
    let mut x = MARGINS[0];
    for (name, _, color, form, dash) in SERIES {
        line(area, &[(x, 18.0), (x + 34.0, 18.0)], Pen { color, width: 1.8, dash })?;
        mark(area, (x + 17.0, 18.0), (form, 2.6), Some(color), Pen::solid(color, 1.0))?;
        write(area, name, (x + 41.0, 18.0), words)?;
        x += 58.0 + 7.2 * name.len() as f64;
    }
    mark(area, (x + 8.0, 18.0), (Form::Circle, 5.5), Some(WHITE), Pen::solid(INK, 1.8))?;
    write(area, "large, open: exact solution", (x + 20.0, 18.0), words)?;
    let left = MARGINS[0];
    line(area, &[(left, 42.0), (left + 34.0, 42.0)], Pen::solid(GRAY, 1.4))?;
    write(area, "tolerance of the pass on the sum", (left + 41.0, 42.0), words)
}
