//! Frequency error, shape error and their sum against iteration (Figures 5, 7 and 8).

use super::canvas::*;
use crate::method::error_sum::Errors;
use crate::method::outer_loop::{Correlation, Pass, Settings};
use crate::present::PresentError;
use plotters::prelude::{BindKeyPoints, IntoLogRange, RGBColor, WHITE};

/// The SRSS errors of one pass, fractions.
#[derive(Debug, Clone, PartialEq)]
pub struct PassHistory {
    /// Accepted iterations before it.
    pub from: usize,
    /// Errors of the exact solution it starts from, then after every iteration by perturbation.
    pub inner: Vec<Errors>,
    /// Errors of the exact check at its end.
    pub check: Errors,
    /// Its tolerance on the error sum, a fraction.
    pub tolerance: f64,
}

/// The history of a correlation with its settings.
pub fn error_history(correlation: &Correlation, settings: &Settings) -> Vec<PassHistory> {
    let mut from = 0;
    let history = |(row, pass): (usize, &Pass)| {
        let steps = pass.inner.iterations.iter().map(|step| step.errors);
        let inner: Vec<Errors> = std::iter::once(pass.inner.start).chain(steps).collect();
        let tolerance = if row == 0 { settings.inner.tolerance } else { settings.later_inner_tolerance };
        from += inner.len() - 1;
        PassHistory { from: from + 1 - inner.len(), inner, check: pass.check.errors, tolerance }
    };
    correlation.passes.iter().enumerate().map(history).collect()
}

impl PassHistory {
    /// Accepted iterations at its end.
    pub fn to(&self) -> usize {
        self.from + self.inner.len() - 1
    }
}

/// The three errors as drawn: name, value, color, form and dash.
type Series = (&'static str, fn(&Errors) -> f64, RGBColor, Form, Dash);
const SERIES: [Series; 3] = [
    ("sum of both", Errors::sum, INK, Form::Diamond, Dash::Solid),
    ("frequency error", |e| e.frequency, VERMILION, Form::Square, Dash::Dashed),
    ("shape error", |e| e.shape, BLUE, Form::Circle, Dash::Dotted),
];

/// Most labels of the iterations: more would touch one another.
const MOST_LABELS: usize = 32;
/// Ticks of the error axis, percent.
const TICKS: [f64; 10] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [72.0, 16.0, 88.0, 48.0];
const HEIGHT: f64 = 450.0;

/// The history as SVG: errors on a logarithmic scale, passes side by side.
pub fn draw(name: &str, title: &str, passes: &[PassHistory]) -> Result<String, PresentError> {
    svg(name, title, HEIGHT, |area| on(area, passes))
}

/// The ticks that just hold every error, percent.
fn bounds(passes: &[PassHistory]) -> (f64, f64) {
    let errors = passes.iter().flat_map(|pass| pass.inner.iter().chain([&pass.check]));
    let values = errors.flat_map(|errors| SERIES.map(|(_, value, ..)| 100.0 * value(errors)));
    let (least, most) = values.fold((f64::INFINITY, 0.0), |(low, high), value| (value.min(low), value.max(high)));
    let below = TICKS.iter().rev().find(|tick| **tick < 0.9 * least);
    let above = TICKS.iter().find(|tick| **tick > 1.1 * most);
    (*below.unwrap_or(&TICKS[0]), *above.unwrap_or(&TICKS[9]))
}

fn on(area: &Area, passes: &[PassHistory]) -> Drawn {
    let last = passes.last().map_or(0, PassHistory::to);
    let (low, high) = bounds(passes);
    let ticks = TICKS.iter().copied().filter(|tick| (low..=high).contains(tick));
    let range = (low..high).log_scale().with_key_points(ticks.collect());
    let mut chart = chart(area, MARGINS).build_cartesian_2d(-0.4..last as f64 + 0.4, range)?;
    axes(&mut chart)
        .disable_x_mesh()
        .x_labels((last + 2).min(MOST_LABELS))
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y}"))
        .x_desc("accepted iterations of the inner loop")
        .draw()?;
    let place = |iteration: usize, percent: f64| placed(&chart, iteration as f64, percent);
    for (row, pass) in passes.iter().enumerate() {
        let (from, to, tolerance, number) = (pass.from, pass.to(), 100.0 * pass.tolerance, row + 1);
        let (begin, end) = (place(from, high), place(to, high));
        let name = match end.0 - begin.0 {
            wide if wide > 180.0 => format!("pass {number} (tolerance {tolerance:.1} %)"),
            wide if wide > 50.0 => format!("pass {number}"),
            _ => number.to_string(),
        };
        write(area, &name, (0.5 * (begin.0 + end.0), begin.1 - 11.0), MIDDLE)?;
        line(area, &[place(to, low), end], Pen::dashed(GRAY, 1.0))?;
        line(area, &[place(from, tolerance), place(to, tolerance)], Pen::solid(GRAY, 1.4))?;
    }
    name_upright(area, "SRSS error, percent (log scale)", 0.5 * (HEIGHT + MARGINS[2] - MARGINS[3]))?;
    // Lines first, so that no line crosses the open marks of exact solutions.
    for (_, value, color, form, dash) in SERIES {
        let at = |iteration: usize, errors: &Errors| place(iteration, 100.0 * value(errors));
        for pass in passes {
            let points: Vec<Place> = (pass.from..).zip(&pass.inner).map(|(row, errors)| at(row, errors)).collect();
            line(area, &points, Pen(color, 1.8, dash))?;
            for &point in &points[1..] {
                mark(area, point, Mark(form, 2.6, Some(color), Pen::solid(color, 1.0)))?;
            }
        }
        let start = passes.first().map(|pass| at(pass.from, &pass.inner[0]));
        for exact in start.into_iter().chain(passes.iter().map(|pass| at(pass.to(), &pass.check))) {
            mark(area, exact, Mark(form, 5.5, None, Pen::solid(color, 1.8)))?;
        }
    }
    legend(area)
}

fn legend(area: &Area) -> Drawn {
    let (left, mut x) = (MARGINS[0], MARGINS[0]);
    for (name, _, color, form, dash) in SERIES {
        line(area, &[(x, 18.0), (x + 34.0, 18.0)], Pen(color, 1.8, dash))?;
        mark(area, (x + 17.0, 18.0), Mark(form, 2.6, Some(color), Pen::solid(color, 1.0)))?;
        write(area, name, (x + 41.0, 18.0), START)?;
        x += 58.0 + 7.2 * name.len() as f64;
    }
    let open = Mark(Form::Circle, 5.5, Some(WHITE), Pen::solid(INK, 1.8));
    marked(area, (x + 8.0, 18.0), open, "large, open: exact solution")?;
    line(area, &[(left, 42.0), (left + 34.0, 42.0)], Pen::solid(GRAY, 1.4))?;
    write(area, "tolerance of the pass on the sum", (left + 41.0, 42.0), START)
}
