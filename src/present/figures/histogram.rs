//! Factors over many runs as histograms, one a parameter.

use super::canvas::*;
use crate::job::{Spread, Summary};

/// Histograms side by side.
const ACROSS: usize = 3;
/// Height of one with its name and axis, and the parts of it above and below its bars, px.
const CHART: f64 = 164.0;
const HEAD: f64 = 34.0;
const FOOT: f64 = 34.0;
/// Distance from the left edge of one to that of the next, and the bars' part of it, px.
const PITCH: f64 = 250.0;
const BARS: f64 = 214.0;

/// A summary as SVG: bars for the number of samples whose factor lies in each interval, with lines at the quantiles of 2.5, 50 and
/// 97.5 %.
///
/// # Errors
/// [`PresentError::Drawing`].
pub fn draw(name: &str, title: &str, summary: &Summary) -> Result<String, PresentError> {
    let rows = summary.spreads.len().div_ceil(ACROSS) as f64;
    let height = rows * CHART + FOOT;
    svg(name, title, height, |area| {
        for (place, (name, spread)) in summary.spreads.iter().enumerate() {
            let (left, top) = (
                22.0 + PITCH * (place % ACROSS) as f64,
                CHART * (place / ACROSS) as f64 + HEAD,
            );
            write(area, &shortened(name), (left, top - 14.0), START.bold())?;
            if let Some(spread) = spread {
                draw_on(
                    area,
                    spread,
                    [
                        left,
                        WIDTH - left - BARS,
                        top,
                        height - top - (CHART - HEAD - FOOT),
                    ],
                )?;
            }
        }
        let note = "factor on the first model; lines at 2.5, 50 and 97.5 % of the samples";
        write(area, note, (0.5 * WIDTH, height - 14.0), MIDDLE)
    })
}

fn draw_on(area: &Area, spread: &Spread, margins: [f64; 4]) -> Drawn {
    // Numbers that are equal to four digits need room on either side too.
    let [least, most] = spread.ends;
    let room = if most - least > 5e-4 * least.abs() {
        0.0
    } else {
        0.01 * least.abs().max(f64::MIN_POSITIVE)
    };
    let (low, high) = (least - room, most + room);
    let tallest = spread.bars.iter().copied().max().unwrap_or(0).max(1) as f64;
    let mut chart = chart(area, margins).build_cartesian_2d(low..high, 0.0..1.08 * tallest)?;
    let decimals = (1.0 - (high - low).log10().floor()).clamp(0.0, 9.0) as usize;
    axes(&mut chart)
        .disable_y_mesh()
        .y_labels(0)
        .x_labels(4)
        .x_label_formatter(&|x| signed(format!("{x:.decimals$}")))
        .draw()?;
    let place = |x: f64, y: f64| placed(&chart, x, y);
    let wide = (high - low) / spread.bars.len() as f64;
    for (row, count) in spread
        .bars
        .iter()
        .enumerate()
        .filter(|(_, count)| **count > 0)
    {
        let from = low + wide * row as f64;
        bar(
            area,
            place(from, *count as f64),
            place(from + wide, 0.0),
            between(WHITE, SKY, 0.7),
        )?;
    }
    for (quantile, pen) in spread
        .quantiles
        .iter()
        .zip([Pen::dashed, Pen::solid, Pen::dashed])
    {
        line(
            area,
            &[place(*quantile, 0.0), place(*quantile, 1.08 * tallest)],
            pen(BLUE, 1.4),
        )?;
    }
    Ok(())
}
