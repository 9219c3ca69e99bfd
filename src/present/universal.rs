//! Shapes of a correlation as a Universal File, for programs that draw and compare modes.

use super::report::Report;
use super::report::job::joined;
use super::rows::shapes;
use crate::job::LoadedJob;
use crate::method::error::Error;
use nalgebra::{Vector3, Vector6};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Write;

/// Sets of shapes, in the order of the file, with what stands in the first line of each.
const SETS: [&str; 3] = ["test", "first model", "corrected model"];

/// Number of the coordinate system of all places and motions, whose axes are the global ones.
const SYSTEM: usize = 1;

/// A Universal File with the global axes (dataset 2420), the grids of the sensors (2411), lines between them (82) and, at the grids, the
/// shapes of test, first and corrected model (55, real, six digits), each of a largest component of one. A grid's motion is the sum of
/// its sensors' along their axes.
///
/// # Errors
/// Errors of [`Pairing::paired`](crate::method::sorting::Pairing::paired).
pub fn universal(report: &Report, loaded: &LoadedJob) -> Result<String, Error> {
    let placed = &loaded.placed;
    let mut text = frame(report, loaded);
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

/// Axes, the grids of the sensors and the lines between them.
fn frame(report: &Report, loaded: &LoadedJob) -> String {
    let placed = &loaded.placed;
    let places = placed.iter().map(|sensor| (sensor.grid, sensor.place));
    let places: BTreeMap<usize, Option<Vector3<f64>>> = places.collect();
    let mut text = format!(
        "    -1\n  2420\n{:10}\nNONE\n{SYSTEM:10}{:10}{:10}\nGlobal\n",
        1, 0, 11
    );
    let row = |numbers: [f64; 3]| numbers.map(|number| real(number, 16)).concat() + "\n";
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
    text += &axes.map(row).concat();
    text += "    -1\n    -1\n  2411\n";
    for (grid, place) in &places {
        let place = row(place.unwrap_or_default().into());
        text += &format!("{grid:10}{SYSTEM:10}{SYSTEM:10}{:10}\n{place}", 11);
    }
    text += "    -1\n";
    let lines = lines(report, loaded);
    if !lines.is_empty() {
        // A pen that goes through the nodes is lifted by a zero.
        let nodes = lines.into_iter().flat_map(|[from, to]| [from, to, 0]);
        let nodes: Vec<usize> = nodes.collect();
        let _ = writeln!(
            text,
            "    -1\n    82\n{:10}{:10}{:10}\nNONE",
            1,
            nodes.len(),
            11
        );
        for eight in nodes.chunks(8) {
            eight.iter().for_each(|node| text += &format!("{node:10}"));
            text += "\n";
        }
        text += "    -1\n";
    }
    text
}

/// Lines between grids of sensors: those of the test's wire frame, or else edges of the structure, or else, where
/// these are too few, lines that join the sensors.
fn lines(report: &Report, loaded: &LoadedJob) -> BTreeSet<[usize; 2]> {
    let sensors = loaded.placed.iter();
    let of_node = sensors
        .clone()
        .filter_map(|own| Some((loaded.data.sensors[own.row].grid?, own.grid)));
    let of_node: HashMap<usize, usize> = of_node.collect();
    // Minus zero and zero are the same place.
    let bits = |place: Vector3<f64>| place.map(|number| (number + 0.0).to_bits());
    let of_place = sensors.filter_map(|own| Some((bits(own.place?), own.grid)));
    let of_place: HashMap<Vector3<u64>, usize> = of_place.collect();
    let between = |from: Option<&usize>, to: Option<&usize>| {
        let (from, to) = (*from?, *to?);
        (from != to).then_some([from.min(to), from.max(to)])
    };
    let of_test: BTreeSet<[usize; 2]> = loaded
        .data
        .lines
        .iter()
        .filter_map(|[from, to]| between(of_node.get(from), of_node.get(to)))
        .collect();
    if !of_test.is_empty() {
        return of_test;
    }
    let edges = |frame: &[Vec<Vector3<f64>>]| -> BTreeSet<[usize; 2]> {
        let grid = |corner: &Vector3<f64>| of_place.get(&bits(*corner));
        let edges = frame.iter().flat_map(|corners| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next)
        });
        edges
            .filter_map(|(from, to)| between(grid(from), grid(to)))
            .collect()
    };
    let own = edges(&report.frame);
    // Fewer pieces of the structure go from sensor to sensor than join them all.
    if own.len() + 1 < of_place.len() {
        let places = loaded.placed.iter().filter_map(|own| own.place);
        return edges(&joined(places.collect()));
    }
    own
}

/// A number in columns of 13 with five digits behind the point, or of 25 with sixteen.
fn real(value: f64, digits: usize) -> String {
    let written = format!("{value:.digits$e}");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let width = if digits == 5 { 13 } else { 25 };
    format!("{:>width$}", format!("{mantissa}E{exponent:+03}"))
}
