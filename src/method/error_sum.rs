//! The objective (5, 6): how far the analysis modes are from the test modes.

use crate::method::modes::Modes;
use crate::method::pairing::Pairing;
use nalgebra::DVectorView;

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
pub fn errors(analysis: &Modes, pairing: &Pairing, test: &Modes) -> Errors {
    let dof_count = test.shapes.nrows() as f64;
    let (mut frequency, mut shape) = (0.0, 0.0);
    for j in 0..test.len() {
        let i = pairing.analysis_mode[j];
        let ratio = (analysis.omega_squared[i] / test.omega_squared[j]).sqrt();
        frequency += (ratio - 1.0).powi(2);
        let difference = squared_shape_difference(
            analysis.shapes.column(i).as_view(),
            pairing.sign[j],
            test.shapes.column(j).as_view(),
        );
        shape += difference / dof_count;
    }
    Errors {
        frequency: frequency.sqrt(),
        shape: shape.sqrt(),
        mode_count: test.len(),
    }
}

/// $\sum_j (\pm v_j/\max|v| - w_j/\max|w|)^2$.
pub(crate) fn squared_shape_difference(
    analysis: DVectorView<f64>,
    sign: f64,
    test: DVectorView<f64>,
) -> f64 {
    let to_unit = sign / analysis.amax();
    let to_unit_test = 1.0 / test.amax();
    analysis
        .iter()
        .zip(test.iter())
        .map(|(v, w)| (v * to_unit - w * to_unit_test).powi(2))
        .sum()
}
