//! Shapes of a correlation as a Universal File, for programs that draw and compare modes.

use super::report::Report;
use super::rows::shapes;
use crate::job::PlacedSensor;
use crate::method::error::Error;
use nalgebra::{Vector3, Vector6};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Sets of shapes, in the order of the file, with what stands in the first line of each.
const SETS: [&str; 3] = ["test", "first model", "corrected model"];

/// A Universal File with the grids of the sensors (dataset 2411) and, at these, the shapes of test, first and corrected model (dataset 55,
/// real, six digits), each of a largest component of one. A grid's motion is the sum of its sensors' along their axes.
///
/// # Errors
/// Errors of [`Pairing::paired`](crate::method::sorting::Pairing::paired).
pub fn universal(report: &Report, placed: &[PlacedSensor]) -> Result<String, Error> {
    let places = placed.iter().map(|sensor| (sensor.grid, sensor.place));
    let places: BTreeMap<usize, Option<Vector3<f64>>> = places.collect();
    let mut text = "    -1\n  2411\n".to_owned();
    for (grid, place) in &places {
        let [x, y, z] = place.unwrap_or_default().into();
        let _ = write!(
            text,
            "{grid:10}{:10}{:10}{:10}\n{}{}{}\n",
            0,
            0,
            11,
            real(x, 16),
            real(y, 16),
            real(z, 16)
        );
    }
    text += "    -1\n";
    let count = if placed.iter().any(|sensor| sensor.direction > 2) {
        6
    } else {
        3
    };
    for (set, modes) in SETS.iter().zip(shapes(report)?) {
        for (mode, shape) in modes.shapes.column_iter().enumerate() {
            let shape = shape / shape.amax();
            let mut motions: BTreeMap<usize, Vector6<f64>> = BTreeMap::new();
            for (sensor, value) in placed.iter().zip(&shape) {
                let motion = motions.entry(sensor.grid).or_default();
                let first = sensor.direction / 3 * 3;
                let mut along = motion.fixed_rows_mut::<3>(first);
                along += *value * sensor.axis;
            }
            let number = report.mode_numbers[mode];
            let codes = [1, 2, if count == 3 { 2 } else { 3 }, 8, 2, count];
            let _ = writeln!(
                text,
                "    -1\n    55\n{set}\nmode {number}\nNONE\nNONE\nNONE"
            );
            codes.iter().for_each(|code| text += &format!("{code:10}"));
            let hertz = modes.frequencies_hz()[mode];
            let _ = write!(
                text,
                "\n{:10}{:10}{:10}{number:10}\n{}",
                2,
                4,
                1,
                real(hertz, 5)
            );
            text += &(real(1.0, 5) + &real(0.0, 5).repeat(2) + "\n");
            for (grid, motion) in &motions {
                let _ = writeln!(text, "{grid:10}");
                motion
                    .iter()
                    .take(count)
                    .for_each(|value| text += &real(*value, 5));
                text += "\n";
            }
            text += "    -1\n";
        }
    }
    Ok(text)
}

/// A number in columns of 13 with five digits behind the point, or of 25 with sixteen.
fn real(value: f64, digits: usize) -> String {
    let written = format!("{value:.digits$e}");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let width = if digits == 5 { 13 } else { 25 };
    format!("{:>width$}", format!("{mantissa}E{exponent:+03}"))
}
