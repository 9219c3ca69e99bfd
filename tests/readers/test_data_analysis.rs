//! Dataset 2414 of the Universal File, analysis data, in which finite element programs and newer test systems write mode shapes.

use super::test_data_universal::{NONE, dataset, parsed};
use crate::prelude::*;

/// How a program lays out what the format leaves open.
#[derive(Debug, Clone, Copy)]
struct Layout {
    /// Numbers are separated by two blanks instead of standing in columns, as pyuff writes those of records 12 and 13.
    by_blanks: bool,
    /// Exponents have a D.
    fortran: bool,
    is_complex: bool,
    has_rotations: bool,
}

/// A dataset 2414 at a location (1, nodes) with its six codes, the numbers of its two real records, and values by node.
fn analysis(
    location: usize,
    codes: [usize; 6],
    [times, roots]: [[f64; 6]; 2],
    nodes: &[(usize, Vec<f64>)],
    layout: Layout,
) -> String {
    let integers = |values: &[usize]| {
        values
            .iter()
            .map(|value| format!("{value:10}"))
            .collect::<String>()
            + "\n"
    };
    let number = |value: &f64, blanks: bool| {
        let (mantissa, exponent) = format!("{value:.5e}")
            .split_once('e')
            .map(|(m, e)| (m.to_owned(), e.parse::<i32>().unwrap()))
            .unwrap();
        let letter = if layout.fortran { 'D' } else { 'E' };
        let text = format!("{mantissa}{letter}{exponent:+03}");
        if blanks {
            format!("  {text}")
        } else {
            format!("{text:>13}")
        }
    };
    let reals = |values: &[f64], blanks: bool| {
        values
            .chunks(6)
            .map(|line| {
                line.iter()
                    .map(|value| number(value, blanks))
                    .collect::<String>()
                    + "\n"
            })
            .collect::<String>()
    };
    let head = integers(&[1]) + "LOADCASE 1, MODE 1\n" + &integers(&[location]) + NONE;
    let data: String = nodes
        .iter()
        .map(|(node, values)| integers(&[*node]) + &reals(values, false))
        .collect();
    let body = head
        + &integers(&codes)
        + &integers(&[0, 0, 1, 0, 0, 1, 0, 0])
        + &integers(&[0, 0])
        + &reals(&times, layout.by_blanks)
        + &reals(&roots, layout.by_blanks)
        + &data;
    dataset("2414", &body)
}

/// Frequencies, and by node and component a real and an imaginary part for every mode.
fn drawn_modes() -> impl Strategy<Value = (Vec<f64>, Vec<Vec<[f64; 2]>>)> {
    let value = prop_oneof![-1.0..-1e-3_f64, 1e-3..1.0_f64];
    (1..4_usize, 1..4_usize).prop_flat_map(move |(modes, nodes)| {
        (
            prop::collection::vec(1e-2..1e4_f64, modes),
            prop::collection::vec(
                prop::collection::vec(prop::array::uniform2(value.clone()), 6 * nodes),
                modes,
            ),
        )
    })
}

fn layout() -> impl Strategy<Value = Layout> {
    any::<[bool; 4]>().prop_map(|[by_blanks, fortran, is_complex, has_rotations]| Layout {
        by_blanks,
        fortran,
        is_complex,
        has_rotations,
    })
}

/// The file of drawn modes, and what a reader must find: frequencies and shapes.
fn written(frequencies: &[f64], values: &[Vec<[f64; 2]>], layout: Layout) -> String {
    let components = if layout.has_rotations { 6 } else { 3 };
    let modes = frequencies.iter().zip(values).map(|(&frequency, values)| {
        let nodes = values.chunks(6).zip(1..).map(|(values, node)| {
            let parts = values[..components].iter();
            let values: Vec<f64> = if layout.is_complex {
                parts.flatten().copied().collect()
            } else {
                parts.map(|part| part[0]).collect()
            };
            (node, values)
        });
        let codes = [
            1,
            2,
            if layout.has_rotations { 3 } else { 2 },
            8,
            if layout.is_complex { 5 } else { 2 },
            components,
        ];
        analysis(
            1,
            codes,
            [[0.0, frequency, 0.0, 1.0, 0.0, 0.0], [0.0; 6]],
            &nodes.collect_vec(),
            layout,
        )
    });
    modes.collect()
}

properties! {
    /// Three or six values a node, real or complex, in columns or not: what was written is read.
    #[test]
    fn every_layout_of_analysis_data_reads_to_six_digits((frequencies, values) in drawn_modes(), layout in layout()) {
        let data: TestData = parsed(&written(&frequencies, &values, layout));
        let components = if layout.has_rotations { 6 } else { 3 };
        prop_assert_eq!(data.sensors.len(), values[0].len() / 6 * components);
        for (found, given) in data.frequencies_hz.iter().zip(&frequencies) {
            prop_assert!((found - given).abs() <= UNIVERSAL_ROUNDING * given);
        }
        prop_assert_eq!(data.phase_collinearity.is_empty(), !layout.is_complex);
        if !layout.is_complex {
            let row = |row: usize| row / components * 6 + row % components;
            let expected = DMatrix::from_fn(data.sensors.len(), frequencies.len(), |sensor, mode| values[mode][row(sensor)][0]);
            prop_assert!((data.shapes - expected).amax() <= UNIVERSAL_ROUNDING);
        }
    }
}
