//! Unlimited stiffness change factors of a first iteration with the limits drawn.

use super::canvas::*;
use crate::method::model::Range;
use crate::present::PresentError;
use crate::present::table::Digits;
use crate::present::tables::correlation::{JudgedFactor, Judgment};
use plotters::style::WHITE;

/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [64.0, 24.0, 44.0, 46.0];
const ROW: f64 = 24.0;

/// The factors as SVG; `published` says what the published ones are.
pub fn draw(
    name: &str,
    title: &str,
    factors: &[JudgedFactor],
    limits: Range,
    published: &str,
) -> Result<String, PresentError> {
    let height = MARGINS[2] + MARGINS[3] + ROW * factors.len() as f64;
    svg(name, title, height, |area| on(area, factors, limits, published))
}

/// Tens that hold every factor with room for its number.
fn bounds(factors: &[JudgedFactor], limits: Range) -> (f64, f64) {
    let each = |factor: &JudgedFactor| [Some(factor.computed), factor.published];
    let values = || factors.iter().flat_map(each).flatten();
    let least = values().fold(0.0, f64::min);
    let most = values().fold(limits.upper, f64::max);
    (10.0 * (least / 10.0 - 0.4).floor(), 10.0 * (most / 10.0 + 0.4).ceil())
}

fn on(area: &Area, factors: &[JudgedFactor], limits: Range, published: &str) -> Drawn {
    let (low, high) = bounds(factors, limits);
    let count = factors.len() as f64;
    let mut chart = chart(area, MARGINS).build_cartesian_2d(low..high, count..0.0)?;
    axes(&mut chart)
        .disable_y_mesh()
        .x_labels(((high - low) / 10.0) as usize + 2)
        .y_labels(0)
        .x_label_formatter(&|x| signed(format!("{x:.0}")))
        .x_desc("unlimited stiffness change factor, first iteration")
        .draw()?;
    let place = |factor: f64, row: f64| placed(&chart, factor, row);
    name_upright(area, "panel", MARGINS[2] + 0.5 * ROW * count)?;
    let (upper, lower) = (place(limits.lower, 0.0), place(limits.upper, count));
    rectangle(area, upper, lower, between(WHITE, SKY, 0.6))?;
    let text = format!("limits {:.2} to {:.2}", limits.lower, limits.upper);
    let at = (0.5 * (upper.0 + lower.0), upper.1 - 13.0);
    write(area, &text, at, MIDDLE.color(BLUE))?;
    let diamond = Mark(Form::Diamond, 5.0, Some(ORANGE), Pen::solid(INK, 0.9));
    for (row, factor) in factors.iter().enumerate() {
        let row = row as f64 + 0.5;
        let (x, y) = place(low, row);
        write(area, &factor.parameter, (x - 8.0, y), END)?;
        let is_anomaly = factor.judgment == Judgment::Anomaly;
        let color = if is_anomaly { VERMILION } else { INK };
        let tip = place(factor.computed, row);
        line(area, &[place(1.0, row), tip], Pen::solid(color, 2.0))?;
        if let Some(published) = factor.published {
            mark(area, place(published, row), diamond)?;
        }
        mark(area, tip, Mark(Form::Circle, 4.0, Some(color), Pen::solid(color, 1.0)))?;
        // The number stands beside its mark, away from the limits; an anomaly is named.
        let number = signed(Digits::Fixed(1).write(factor.computed));
        let (text, at, letters) = if is_anomaly {
            (format!("anomaly: {number}"), (tip.0 - 10.0, tip.1 - 11.0), END)
        } else if factor.computed < 1.0 {
            (number, (tip.0 - 10.0, tip.1), END)
        } else {
            (number, (tip.0.max(lower.0) + 10.0, tip.1), START)
        };
        write(area, &text, at, letters.color(color))?;
    }
    if factors.iter().any(|factor| factor.published.is_some()) {
        let (x, y) = (place(high, 0.0).0 - 230.0, upper.1 - 13.0);
        marked(area, (x, y), diamond, published)?;
    }
    Ok(())
}
