//! Tests as files, written: a table as a spreadsheet has it, and a Universal File with nodes (dataset 15), wire frame (82) and
//! every mode as a real normal one (55).

use crate::prelude::*;
use corfem::files::test_data::DIRECTIONS;

/// Writes a test in the layout that the reader takes, with commas; every number reads back as it is.
///
/// Wire frame, units and skipped datasets have no place in it. Line ends in a name become blanks.
pub fn write_csv(data: &TestData) -> String {
    let joined = |values: &mut dyn Iterator<Item = &f64>| {
        values
            .map(|value| format!(",{value:?}"))
            .collect::<String>()
    };
    let phase = Some(&data.phase_collinearity).filter(|list| !list.is_empty());
    let lists = [
        Some(&data.frequencies_hz),
        data.frequency_deviation.as_ref(),
        data.shape_deviation.as_ref(),
        phase,
    ];
    let mut text = String::new();
    let rows = [
        "frequency_hz",
        "frequency_deviation",
        "shape_deviation",
        "phase_collinearity",
    ];
    for (name, values) in rows
        .iter()
        .zip(lists)
        .filter_map(|(name, values)| Some((name, values?)))
    {
        text += &format!("{name},,,,,,{}\n", joined(&mut values.iter()));
    }
    let modes: String = (1..=data.frequencies_hz.len())
        .map(|mode| format!(",mode {mode}"))
        .collect();
    let own = &data.component_deviation;
    let deviations: String = own
        .keys()
        .map(|mode| format!(",deviation {}", mode + 1))
        .collect();
    text += &format!("grid,name,direction,sign,x,y,z{modes}{deviations}\n");
    for (place, (sensor, row)) in data.sensors.iter().zip(data.shapes.row_iter()).enumerate() {
        let grid = sensor.grid.map(|grid| grid.to_string()).unwrap_or_default();
        let at = sensor
            .place
            .map_or(",,,".to_owned(), |place| joined(&mut place.iter()));
        let direction = DIRECTIONS.get(sensor.direction).unwrap_or(&"?");
        let quoted = format!(
            "\"{}\"",
            sensor.name.replace(['\n', '\r'], " ").replace('"', "\"\"")
        );
        text += &format!(
            "{grid},{},{direction},+{at}{}\n",
            quoted,
            joined(&mut row.iter().chain(own.values().map(|own| &own[place])))
        );
    }
    text
}

/// Writes a test that the reader and other programs read, places with all digits (dataset 2411), other
/// numbers with six (E13.5).
///
/// A sensor without a grid gets a node of its own behind the others. Names, deviations and phase collinearity have no place in the
/// format, and a sensor that is zero in all modes counts as not measured when it is read.
pub fn write_universal(data: &TestData) -> String {
    let last = data
        .sensors
        .iter()
        .filter_map(|sensor| sensor.grid)
        .max()
        .unwrap_or(0);
    let mut free = last.saturating_add(1)..;
    let nodes = data
        .sensors
        .iter()
        .filter_map(|sensor| sensor.grid.or_else(|| free.next()))
        .collect_vec();
    let places = nodes
        .iter()
        .zip(&data.sensors)
        .rev()
        .filter_map(|(node, sensor)| Some((*node, sensor.place?)));
    let places: BTreeMap<usize, Vector3<f64>> = places.collect();
    let record = |(node, place): (usize, Vector3<f64>)| {
        integers(&[node, 0, 0, 0]) + "\n" + &long_reals(place.as_slice()) + "\n"
    };
    let mut text = String::new();
    let mut dataset =
        |number: usize, body: String| text += &format!("    -1\n{number:6}\n{body}    -1\n");
    if !places.is_empty() {
        dataset(2411, places.into_iter().map(record).collect());
    }
    for (number, line) in data.lines.iter().enumerate() {
        dataset(
            82,
            format!(
                "{}\nNONE\n{}\n",
                integers(&[number + 1, 2, 0]),
                integers(line)
            ),
        );
    }
    let width = if data.sensors.iter().any(|sensor| sensor.direction > 2) {
        6
    } else {
        3
    };
    for (number, (frequency, shape)) in data
        .frequencies_hz
        .iter()
        .zip(data.shapes.column_iter())
        .enumerate()
    {
        let mut at_nodes: BTreeMap<usize, [f64; 6]> = BTreeMap::new();
        for ((node, sensor), value) in nodes.iter().zip(&data.sensors).zip(shape.iter()) {
            let values = at_nodes.entry(*node).or_default();
            values
                .get_mut(sensor.direction)
                .into_iter()
                .for_each(|component| *component = *value);
        }
        // Structural model, normal mode, vector of three or six components, displacement, real.
        let (kind, mode) = (
            integers(&[1, 2, width / 3 + 1, 8, 2, width]),
            integers(&[2, 4, 0, number + 1]),
        );
        let values =
            |(node, values): (usize, [f64; 6])| format!("{node:10}\n{}\n", reals(&values[..width]));
        let rows: String = at_nodes.into_iter().map(values).collect();
        let head = "NONE\n".repeat(5);
        dataset(
            55,
            format!(
                "{head}{kind}\n{mode}\n{}\n{rows}",
                reals(&[*frequency, 0.0, 0.0, 0.0])
            ),
        );
    }
    text
}

/// Numbers in the format I10.
fn integers(values: &[usize]) -> String {
    values.iter().map(|value| format!("{value:10}")).collect()
}

/// Numbers in the format E13.5, with an exponent of at least two digits.
fn reals(values: &[f64]) -> String {
    in_columns(values, 13, 5)
}

/// Numbers in the format D25.16, all digits of a double.
fn long_reals(values: &[f64]) -> String {
    in_columns(values, 25, 16)
}

fn in_columns(values: &[f64], width: usize, digits: usize) -> String {
    let one = |value: &f64| {
        let text = format!("{value:.digits$e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let exponent: i32 = exponent.parse().unwrap_or(0);
        format!("{:>width$}", format!("{mantissa}E{exponent:+03}"))
    };
    values.iter().map(one).collect()
}
