//! Frequency error, shape error and their sum against iteration (Figures 5, 7 and 8).

use super::canvas::*;
use corfem::method::error_sum::Errors;
use corfem::method::outer_loop::Pass;
use corfem::torque_box::CaseResult;
use plotters::prelude::{BindKeyPoints, IntoLogRange};

/// The SRSS errors of one pass, fractions.
#[derive(Debug, Clone, PartialEq)]
struct PassHistory {
    /// Iterations before the pass.
    from: usize,
    /// Iterations at its end.
    to: usize,
    /// Errors of the exact solution that the pass starts from, then after every iteration by perturbation.
    inner: Vec<Errors>,
    /// Errors of the exact check at the end of the pass.
    check: Errors,
    /// Tolerance of its inner loop on the error sum, a fraction.
    tolerance: f64,
}

/// The history of a case's passes.
fn error_history(result: &CaseResult) -> Vec<PassHistory> {
    let (run, settings) = (&result.correlation, &result.case.settings);
    let (mut from, mut before) = (0, run.initial.errors);
    let history = |(row, pass): (usize, &Pass)| {
        let iterations = pass.inner.iterations.iter();
        let to = from + iterations.len();
        let own = PassHistory {
            from,
            to,
            inner: std::iter::once(before)
                .chain(iterations.map(|own| own.errors))
                .collect(),
            check: pass.check.errors,
            tolerance: match row {
                0 => settings.inner.tolerance,
                _ => settings.later_inner_tolerance,
            },
        };
        (from, before) = (to, pass.check.errors);
        own
    };
    run.passes.iter().enumerate().map(history).collect()
}

/// The three errors as drawn: name, value, color, form and dash.
type Measure = (&'static str, fn(&Errors) -> f64, RGBColor, Form, Dash);
const SERIES: [Measure; 3] = [
    ("sum of both", Errors::sum, INK, Form::Diamond, Dash::Solid),
    (
        "frequency error",
        |e| e.frequency,
        VERMILION,
        Form::Square,
        Dash::Dashed,
    ),
    ("shape error", |e| e.shape, BLUE, Form::Circle, Dash::Dotted),
];

/// Powers of ten that the error axis begins and ends with at most, percent.
const DECADES: (i32, i32) = (-3, 4);
/// Decades up to which an axis has ticks at two and five times their powers of ten.
const FEW_DECADES: f64 = 3.1;
/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [72.0, 150.0, 64.0, 48.0];
const HEIGHT: f64 = 426.0;

/// The history as SVG: errors on a logarithmic scale, passes side by side.
pub fn draw(name: &str, title: &str, result: &CaseResult) -> Result<String, PresentError> {
    svg(name, title, HEIGHT, |area| {
        draw_on(area, &error_history(result))
    })
}

/// An error in percent as it is drawn: a logarithmic scale has no zero.
fn percent(error: f64) -> f64 {
    (100.0 * error).clamp(1.2 * 10f64.powi(DECADES.0), 0.8 * 10f64.powi(DECADES.1))
}

/// Ends of the axis that just hold every error, and its ticks, percent.
fn ticks(passes: &[PassHistory]) -> (f64, f64, Vec<f64>) {
    let errors = passes
        .iter()
        .flat_map(|pass| pass.inner.iter().chain([&pass.check]));
    let values = errors.flat_map(|errors| SERIES.iter().map(|it| percent(it.1(errors))));
    let (least, most) = values.fold((f64::INFINITY, 0.0), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    // Parsed from decimal text: a product of powers of ten may be off in the last digit.
    let tick = |part: u8, decade| Some((part, format!("{part}e{decade}").parse::<f64>().ok()?));
    let decades =
        (DECADES.0..=DECADES.1).flat_map(|decade| [1, 2, 5].map(|part| tick(part, decade)));
    let all: Vec<(u8, f64)> = decades.flatten().collect();
    let low = all
        .iter()
        .rposition(|(_, tick)| *tick < 0.9 * least)
        .unwrap_or(0);
    let high = all
        .iter()
        .position(|(_, tick)| *tick > 1.1 * most)
        .unwrap_or(low);
    let (low, high) = (all[low].1, all[high].1);
    let few = (high / low).log10() < FEW_DECADES;
    let shown = all
        .into_iter()
        .filter(|(part, tick)| (low..=high).contains(tick) && (few || *part == 1));
    (low, high, shown.map(|(_, tick)| tick).collect())
}

fn draw_on(area: &Area, passes: &[PassHistory]) -> Drawn {
    let last = passes.last().map_or(0, |pass| pass.to);
    let (low, high, ticks) = ticks(passes);
    let [left, right, top, bottom] = MARGINS;
    // As many as there is room for.
    let room = WIDE - left - right - 12.0;
    let most_labels = (room / (10.0 + 7.8 * last.to_string().len() as f64)) as usize;
    let range = (low..high).log_scale().with_key_points(ticks);
    let mut chart = chart(area, [left, right, top, bottom])
        .build_cartesian_2d(-0.4..last as f64 + 0.4, range)?;
    axes(&mut chart)
        .disable_x_mesh()
        .x_labels((last + 1).min(most_labels))
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| y.to_string())
        .x_desc("accepted iterations of the inner loop")
        .draw()?;
    let place = |iteration: usize, percent: f64| placed(area, &chart, iteration as f64, percent);
    for (row, pass) in passes.iter().enumerate() {
        let (from, to, number) = (pass.from, pass.to, row + 1);
        let (begin, end) = (place(from, high), place(to, high));
        let name = match end.0 - begin.0 > 180.0 {
            true => format!("pass {number} (tolerance {:.1} %)", 100.0 * pass.tolerance),
            false => format!("pass {number}"),
        };
        write(
            area,
            &name,
            (0.5 * (begin.0 + end.0), begin.1 - 11.0),
            MIDDLE,
        )?;
        line(area, &[place(to, low), end], Pen::dashed(GRAY, 1.0))?;
        let most = percent(pass.tolerance).clamp(low, high);
        line(
            area,
            &[place(from, most), place(to, most)],
            Pen::solid(GRAY, 1.4),
        )?;
    }
    name_upright(
        area,
        "SRSS error, percent (log scale)",
        0.5 * (HEIGHT + top - bottom),
    )?;
    // Lines first, so that no line crosses the open marks of exact solutions.
    let mut ends = Vec::new();
    for (name, value, color, form, dash) in SERIES {
        let at = |iteration: usize, errors: &Errors| place(iteration, percent(value(errors)));
        let pen = Pen(color, 1.8, dash);
        let dot = Mark(form, 2.6, Some(color), Pen::solid(color, 1.0));
        for pass in passes {
            let points = (pass.from..)
                .zip(&pass.inner)
                .map(|(row, errors)| at(row, errors));
            let points: Vec<Place> = points.collect();
            line(area, &points, pen)?;
            for &point in &points[1..] {
                mark(area, point, dot)?;
            }
        }
        let start = passes.first().map(|pass| at(pass.from, &pass.inner[0]));
        let checks = passes.iter().map(|pass| at(pass.to, &pass.check));
        let exact: Vec<Place> = start.into_iter().chain(checks).collect();
        for &exact in &exact {
            mark(area, exact, Mark(form, 5.5, None, Pen::solid(color, 1.8)))?;
        }
        let end = exact.last();
        ends.extend(end.map(|&end| Named(end, name, Some(pen), Some(dot))));
    }
    name_ends(area, ends)?;
    let open = Mark(Form::Circle, 5.5, Some(WHITE), Pen::solid(INK, 1.8));
    let left = left + 8.0;
    marked(area, (left, 18.0), open, "large, open: exact solution")?;
    let (x, y) = (left + 242.0, 18.0);
    line(area, &[(x, y), (x + 34.0, y)], Pen::solid(GRAY, 1.4))?;
    let words = "tolerance of the pass on the sum";
    write(area, words, (x + 41.0, y), START)
}
