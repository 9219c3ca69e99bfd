//! Shapes of a correlation as a Universal File, for programs that draw and compare modes.

use super::report::Report;
use crate::job::LoadedJob;
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
pub fn universal(report: &Report, loaded: &LoadedJob) -> String {
    let placed = &loaded.placed;
    let mut text = frame(loaded);
    let has_rotation = placed.iter().any(|sensor| sensor.direction > 2);
    let (count, kind) = if has_rotation { (6, 3) } else { (3, 2) };
    let shapes = || {
        report
            .readings
            .chunks(placed.len().max(1))
            .zip(&report.modes)
    };
    for (at, set) in SETS.iter().enumerate() {
        for (shape, mode) in shapes() {
            let mut motions: BTreeMap<usize, Vector6<f64>> = BTreeMap::new();
            for (sensor, own) in placed.iter().zip(shape) {
                let motion = motions.entry(sensor.grid).or_default();
                let mut along = motion.fixed_rows_mut::<3>(sensor.direction / 3 * 3);
                along += [own.test, own.first, own.corrected][at] * sensor.axis;
            }
            let number = mode.mode;
            let hertz = [mode.test_hz, mode.first_hz, mode.corrected_hz][at];
            let _ = writeln!(
                text,
                "    -1\n    55\n{set}\nmode {number}\nNONE\nNONE\nNONE"
            );
            text += &integers(&[1, 2, kind, 8, 2, count]);
            text += &integers(&[2, 4, 1, number]);
            text += &(real(hertz, 5) + &real(1.0, 5) + &real(0.0, 5).repeat(2) + "\n");
            for (grid, motion) in &motions {
                let parts = motion.iter().take(count).map(|value| real(*value, 5));
                text += &format!("{grid:10}\n{}\n", parts.collect::<String>());
            }
            text += "    -1\n";
        }
    }
    text
}

/// Integers in columns of ten on a line.
fn integers(all: &[usize]) -> String {
    all.iter()
        .map(|own| format!("{own:10}"))
        .collect::<String>()
        + "\n"
}

/// Axes, the grids of the sensors and the lines between them.
fn frame(loaded: &LoadedJob) -> String {
    let places = loaded
        .placed
        .iter()
        .map(|own| (own.grid, loaded.source.places.get(&own.grid).copied()));
    let places: BTreeMap<usize, Option<Vector3<f64>>> = places.collect();
    let mut text = format!(
        "    -1\n  2420\n{:10}\nNONE\n{}Global\n",
        1,
        integers(&[SYSTEM, 0, 11])
    );
    let row = |numbers: [f64; 3]| numbers.map(|number| real(number, 16)).concat() + "\n";
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
    text += &axes.map(row).concat();
    text += "    -1\n    -1\n  2411\n";
    for (grid, place) in &places {
        text += &integers(&[*grid, SYSTEM, SYSTEM, 11]);
        text += &row(place.unwrap_or_default().into());
    }
    text += "    -1\n";
    let lines = lines(loaded, &places);
    if !lines.is_empty() {
        // A pen that goes through the nodes is lifted by a zero.
        let nodes = lines.into_iter().flat_map(|[from, to]| [from, to, 0]);
        let nodes: Vec<usize> = nodes.collect();
        text += &format!("    -1\n    82\n{}NONE\n", integers(&[1, nodes.len(), 11]));
        text += &nodes.chunks(8).map(integers).collect::<String>();
        text += "    -1\n";
    }
    text
}

/// Lines between grids of sensors: those of the test's wire frame, or else lines that join each to the nearest one that is joined already.
fn lines(
    loaded: &LoadedJob,
    places: &BTreeMap<usize, Option<Vector3<f64>>>,
) -> BTreeSet<[usize; 2]> {
    let of_node = loaded.placed.iter();
    let of_node = of_node.filter_map(|own| Some((loaded.data.sensors[own.row].grid?, own.grid)));
    let of_node: HashMap<usize, usize> = of_node.collect();
    let between = |[from, to]: [usize; 2]| (from != to).then(|| [from.min(to), from.max(to)]);
    let of_test = loaded.data.lines.iter();
    let of_test =
        of_test.filter_map(|[from, to]| between([*of_node.get(from)?, *of_node.get(to)?]));
    let of_test: BTreeSet<[usize; 2]> = of_test.collect();
    if !of_test.is_empty() {
        return of_test;
    }
    let left = places
        .iter()
        .filter_map(|(grid, place)| Some((*grid, (*place)?)));
    let mut left: Vec<(usize, Vector3<f64>)> = left.collect();
    let mut done: Vec<_> = left.pop().into_iter().collect();
    let mut lines = BTreeSet::new();
    while !left.is_empty() {
        let pairs = (0..left.len()).flat_map(|next| (0..done.len()).map(move |from| (next, from)));
        let far = |&(next, from): &(usize, usize)| (left[next].1 - done[from].1).norm_squared();
        let nearest = pairs.min_by(|one, other| far(one).total_cmp(&far(other)));
        let (next, from) = nearest.unwrap_or_default();
        let one = left.swap_remove(next);
        lines.extend(between([one.0, done[from].0]));
        done.push(one);
    }
    lines
}

/// A number in columns of 13 with five digits behind the point, or of 25 with sixteen.
fn real(value: f64, digits: usize) -> String {
    let written = format!("{value:.digits$e}");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let width = if digits == 5 { 13 } else { 25 };
    format!("{:>width$}", format!("{mantissa}E{exponent:+03}"))
}
