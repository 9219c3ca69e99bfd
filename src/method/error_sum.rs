//! The error sum (5, 6): how far the analysis modes are from the test modes.

use crate::method::modes::ModeSet;
use crate::method::pairing::Pairing;
use nalgebra::{DVector, DVectorView};

/// Square-root-of-sum-of-squares (SRSS) errors over the test modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Frequency error $e_f$ (5), a fraction.
    pub frequency: f64,
    /// Mode shape error $e_v$ (6), a fraction.
    pub shape: f64,
    /// Number of test modes.
    pub mode_count: usize,
}

impl Errors {
    /// The error sum $e_S = e_f + e_v$.
    pub fn sum(&self) -> f64 {
        self.frequency + self.shape
    }

    /// Root mean square frequency error, $e_f/\sqrt n$.
    pub fn frequency_rms(&self) -> f64 {
        self.frequency / (self.mode_count as f64).sqrt()
    }

    /// Root mean square shape error, $e_v/\sqrt n$.
    pub fn shape_rms(&self) -> f64 {
        self.shape / (self.mode_count as f64).sqrt()
    }
}

/// SRSS errors of the paired analysis modes against the test modes.
///
/// $$ e_f = \Big[\sum_i \Big(\frac{f_{Fi} - f_{Gi}}{f_{Gi}}\Big)^2\Big]^{1/2}, \qquad
///    e_v = \Big[\sum_i \sum_{j=1}^{d} \frac{(V_{Fij} - V_{Gij})^2}{d}\Big]^{1/2} $$
///
/// with every shape scaled to unit largest component and the analysis shape signed like its test mode. The
/// frequency error is relative: the paper prints a difference but its tables hold the relative one
/// (`paper/errata.md`).
pub fn errors(analysis: &ModeSet, pairing: &Pairing, test: &ModeSet) -> Errors {
    let dof_count = test.shapes.nrows();
    let (mut frequency, mut shape) = (0.0, 0.0);
    let mut difference = DVector::zeros(dof_count);
    for j in 0..test.len() {
        let i = pairing.analysis_mode[j];
        let ratio = (analysis.omega_squared[i] / test.omega_squared[j]).sqrt();
        frequency += (ratio - 1.0).powi(2);
        let (analyzed, tested) = (analysis.shapes.column(i), test.shapes.column(j));
        unit_shape_difference(analyzed, pairing.sign[j], tested, difference.as_mut_slice());
        shape += difference.norm_squared() / dof_count as f64;
    }
    Errors { frequency: frequency.sqrt(), shape: shape.sqrt(), mode_count: test.len() }
}

/// $\pm v/\max|v| - w/\max|w|$, the difference (d) of two shapes scaled to unit largest component.
pub(crate) fn unit_shape_difference(
    analysis: DVectorView<f64>,
    sign: f64,
    test: DVectorView<f64>,
    difference: &mut [f64],
) {
    let (v, w) = (analysis.as_slice(), test.as_slice());
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let largest = |shape: &[f64]| shape.iter().fold(0.0, |largest, component| larger(largest, component.abs()));
    let (to_unit, to_unit_test) = (sign / largest(v), 1.0 / largest(w));
    for ((difference, v), w) in difference.iter_mut().zip(v).zip(w) {
        *difference = v * to_unit - w * to_unit_test;
    }
}
