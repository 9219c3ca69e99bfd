//! Errors of predicted modes against the size of the step, on logarithmic scales.

use super::canvas::*;
use crate::studies::linearization::{LinearPrediction, MEASURES, METHODS};
use plotters::prelude::{BindKeyPoints, IntoLogRange};

const HEIGHT: f64 = 620.0;
/// Ends of the error axis, fractions; what is smaller is round-off.
const ENDS: [f64; 2] = [1e-11, 1.0];
/// Color, form and dash of each of the [`METHODS`].
const STYLES: [(RGBColor, Form, Dash); 4] = [
    (BLUE, Form::Circle, Dash::Solid),
    (VERMILION, Form::Square, Dash::Solid),
    (ORANGE, Form::Diamond, Dash::Dashed),
    (GRAY, Form::Diamond, Dash::Dotted),
];

/// Steps of two structures: frequencies at the left, shapes at the right.
pub fn draw(
    name: &str,
    title: &str,
    structures: &[(&str, Vec<LinearPrediction>); 2],
) -> Result<String, PresentError> {
    svg(name, title, HEIGHT, |area| on(area, structures))
}

fn on(area: &Area, structures: &[(&str, Vec<LinearPrediction>)]) -> Drawn {
    let mut x = 66.0;
    for (&words, (color, form, dash)) in METHODS.iter().zip(STYLES) {
        line(area, &[(x, 18.0), (x + 34.0, 18.0)], Pen(color, 1.8, dash))?;
        mark(
            area,
            (x + 17.0, 18.0),
            Mark(form, 3.0, Some(color), Pen::solid(color, 1.0)),
        )?;
        write(area, words, (x + 41.0, 18.0), START)?;
        x += 62.0 + 7.4 * words.chars().count() as f64;
    }
    for (row, (structure, predictions)) in structures.iter().enumerate() {
        for (column, (what, measure)) in MEASURES.iter().enumerate() {
            let (top, left) = (70.0 + 280.0 * row as f64, 66.0 + 370.0 * column as f64);
            let margins = [left, WIDTH - left - 310.0, top, HEIGHT - top - 220.0];
            let error_axis = (ENDS[0]..ENDS[1])
                .log_scale()
                .with_key_points(vec![1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0]);
            let step_axis = (0.006..1.3)
                .log_scale()
                .with_key_points(vec![0.01, 0.1, 1.0]);
            let mut chart = chart(area, margins).build_cartesian_2d(step_axis, error_axis)?;
            axes(&mut chart)
                .x_label_formatter(&|x| format!("{x}"))
                .y_label_formatter(&|y| format!("1e{:.0}", y.log10()))
                .draw()?;
            write(
                area,
                &format!("{structure}: {what}"),
                (left, top - 14.0),
                START.bold(),
            )?;
            for (method, (color, form, dash)) in STYLES.into_iter().enumerate() {
                let known = predictions
                    .iter()
                    .filter_map(|of| Some((of.step, measure(&of.errors[method]?))));
                let drawn = known.filter(|(_, error)| (ENDS[0]..ENDS[1]).contains(error));
                let places: Vec<Place> = drawn
                    .map(|(step, error)| placed(&chart, step, error))
                    .collect();
                line(area, &places, Pen(color, 1.8, dash))?;
                let dots = Mark(form, 3.0, Some(color), Pen::solid(color, 1.0));
                places.iter().try_for_each(|&at| mark(area, at, dots))?;
            }
        }
    }
    write(
        area,
        "step, as a fraction of the whole correction",
        (0.5 * WIDTH, HEIGHT - 12.0),
        MIDDLE,
    )?;
    name_upright(area, "RMS error, a fraction", 0.5 * HEIGHT)
}
