//! The error sum (5, 6): how far the analysis modes are from the test modes.
//! Tour: [chapter 3](crate::tour::chapter_03_error_sum).

use crate::method::error::Error;
use crate::method::linear_algebra::check_shape;
use crate::method::modes::ModeSet;
use crate::method::pairing::Pairing;
use nalgebra::{DVector, DVectorView};
use serde::{Deserialize, Serialize};

/// Square-root-of-sum-of-squares (SRSS) errors over the test modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Frequency error $e_f$ (5), a fraction.
    pub frequency: f64,
    /// Mode shape error $e_v$ (6), a fraction.
    pub shape: f64,
    /// Number of test modes.
    pub mode_count: usize,
    /// Number of further frequencies of the test without a shape, which are in the first.
    pub lone_count: usize,
}

impl Errors {
    /// The error sum $e_S = e_f + e_v$.
    pub fn sum(&self) -> f64 {
        self.frequency + self.shape
    }

    /// Root mean square frequency error, $e_f/\sqrt n$.
    pub fn frequency_rms(&self) -> f64 {
        self.frequency / ((self.mode_count + self.lone_count).max(1) as f64).sqrt()
    }

    /// Root mean square shape error, $e_v/\sqrt n$.
    pub fn shape_rms(&self) -> f64 {
        self.shape / (self.mode_count.max(1) as f64).sqrt()
    }
}

/// How errors over the test modes are measured by tolerances and by the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorMeasure {
    /// As a sum over the modes compared, whatever their number: the paper's.
    Sum,
    /// As the sum that nine modes of the same RMS error would have, $3 e/\sqrt n$. The paper's settings were found with nine
    /// modes; so they mean the same for any other number, and the step (13) is as long.
    #[default]
    NineModes,
}

impl ErrorMeasure {
    /// What the errors over `modes` test modes are multiplied with.
    pub fn scale(self, modes: usize) -> f64 {
        match self {
            Self::Sum => 1.0,
            Self::NineModes => 3.0 / (modes.max(1) as f64).sqrt(),
        }
    }
}

/// The errors of one test mode.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ModeError {
    /// Relative difference of its frequency, with its sign.
    pub frequency: f64,
    /// Root mean square difference of its shape over the DOF, both of unit largest component; none where the test has no shape.
    pub shape: Option<f64>,
}

impl ModeError {
    /// What it adds to the squares of (5) and (6).
    pub(crate) fn square(&self) -> f64 {
        self.frequency.powi(2) + self.shape.unwrap_or_default().powi(2)
    }
}

/// The errors of every test mode, whose squares (5) and (6) add up.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::TooMany`] for modes other than those paired; [`Error::NotPositive`] for an analysis mode that
/// moves at none of the DOF compared; [`Error::NotFinite`] for frequencies so far apart, or shapes so small, that their squares are
/// not finite.
pub fn mode_errors(
    analysis: &ModeSet,
    pairing: &Pairing,
    test: &ModeSet,
) -> Result<Vec<ModeError>, Error> {
    check_shape(
        "test mode shapes",
        &test.shapes,
        analysis.shapes.nrows(),
        test.len(),
    )?;
    pairing.check(analysis, test.len())?;
    let mut difference = DVector::zeros(test.shapes.nrows());
    let of_mode = |(j, &i): (usize, &usize)| {
        let ratio = (analysis.omega_squared[i] / test.omega_squared[j]).sqrt();
        let (analyzed, tested) = (analysis.shapes.column(i), test.shapes.column(j));
        unit_shape_difference(analyzed, pairing.sign[j], tested, difference.as_mut_slice());
        let mean_square = difference.norm_squared() / difference.len() as f64;
        ModeError {
            frequency: ratio - 1.0,
            shape: Some(mean_square.sqrt()),
        }
    };
    let errors: Vec<ModeError> = pairing
        .analysis_mode
        .iter()
        .enumerate()
        .map(of_mode)
        .collect();
    let sum = errors.iter().map(ModeError::square).sum();
    let is_still = |mode: &&usize| analysis.shapes.column(**mode).amax() == 0.0;
    check_error_sum(sum).map_err(|error| match pairing.analysis_mode.iter().find(is_still) {
        Some(mode) => {
            let owner = format!("analysis mode {mode} (from zero)");
            Error::NotPositive {
                what: "largest component where it is compared",
                owner,
                value: 0.0,
            }
        }
        None => error,
    })?;
    Ok(errors)
}

/// Refuses an error sum that is no finite number.
pub(crate) fn check_error_sum(value: f64) -> Result<(), Error> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Error::NotFinite {
            what: "error sum",
            row: 0,
            column: 0,
            value,
        })
    }
}

/// What the errors of one test mode are multiplied with in the error sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeWeight {
    /// Its frequency error.
    pub frequency: f64,
    /// Its shape error.
    pub shape: f64,
}

impl ModeWeight {
    /// The paper's: every test mode counts as much.
    pub const ONE: Self = Self {
        frequency: 1.0,
        shape: 1.0,
    };
}

/// SRSS errors of the paired analysis modes against the test modes.
///
/// $$ e_f = \Big[\sum_i \Big(\frac{f_{Fi} - f_{Gi}}{f_{Gi}}\Big)^2\Big]^{1/2}, \qquad
///    e_v = \Big[\sum_i \sum_{j=1}^{d} \frac{(V_{Fij} - V_{Gij})^2}{d}\Big]^{1/2} $$
///
/// with every shape scaled to unit largest component and the analysis shape signed like its test mode. The frequency
/// error is relative: the paper prints a difference but its tables hold the relative one (`paper/errata.md`).
///
/// # Errors
/// Those of [`mode_errors`].
///
/// # Example
///
/// ```rust
/// use corfem::method::error_sum::errors;
/// use corfem::method::modes::ModeSet;
/// use corfem::method::pairing::Pairing;
/// use nalgebra::{DMatrix, dvector};
///
/// // Frequencies 30 % and 40 % too high, shapes alike: √(0.3² + 0.4²).
/// let shapes = DMatrix::identity(2, 2);
/// let analysis = ModeSet::new(dvector![1.3 * 1.3, 1.4 * 1.4], shapes.clone())?;
/// let test = ModeSet::new(dvector![1.0, 1.0], shapes)?;
/// let pairing = Pairing::new(vec![0, 1], vec![1.0, 1.0])?;
/// let errors = errors(&analysis, &pairing, &test)?;
/// assert!((errors.frequency - 0.5).abs() < 1e-15 && errors.shape == 0.0);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn errors(analysis: &ModeSet, pairing: &Pairing, test: &ModeSet) -> Result<Errors, Error> {
    weighted_errors(analysis, pairing, test, &vec![ModeWeight::ONE; test.len()])
}

/// The same with every test mode's errors multiplied by its weights; there is one weight a test mode.
pub(crate) fn weighted_errors(
    analysis: &ModeSet,
    pairing: &Pairing,
    test: &ModeSet,
    weights: &[ModeWeight],
) -> Result<Errors, Error> {
    let each = mode_errors(analysis, pairing, test)?;
    let srss = |of: fn(&ModeError, &ModeWeight) -> f64| {
        each.iter()
            .zip(weights)
            .map(|(error, weight)| of(error, weight).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let frequency = srss(|error, weight| weight.frequency * error.frequency);
    let errors = Errors {
        frequency,
        shape: srss(|error, weight| weight.shape * error.shape.unwrap_or_default()),
        mode_count: each.len(),
        lone_count: 0,
    };
    check_error_sum(errors.sum()).map(|()| errors)
}

/// $\pm v/\max|v| - w/\max|w|$, the difference (d) of two shapes scaled to unit largest component; returns $\max|v|$.
pub(crate) fn unit_shape_difference(
    analysis: DVectorView<f64>,
    sign: f64,
    test: DVectorView<f64>,
    difference: &mut [f64],
) -> f64 {
    let (v, w) = (analysis.as_slice(), test.as_slice());
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let largest = |shape: &[f64]| {
        shape
            .iter()
            .fold(0.0, |largest, component| larger(largest, component.abs()))
    };
    let (most, most_of_test) = (largest(v), largest(w));
    let (to_unit, to_unit_test) = (sign / most, 1.0 / most_of_test);
    for ((difference, v), w) in difference.iter_mut().zip(v).zip(w) {
        *difference = v * to_unit - w * to_unit_test;
    }
    most
}
