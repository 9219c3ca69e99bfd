//! A test beside the first and the corrected model: rows of modes and errors, agreement of shapes, and derivatives.

use crate::job::HeldOut;
use crate::method::derivatives::DERIVATIVE_STEP;
use crate::method::error::Error;
use crate::method::error_sum::Errors;
use crate::method::modes::Modes;
use crate::method::sorting::cross_orthogonality;
use crate::sparse::modal_assurance;
use crate::weighted::close_modes::turned;
use crate::weighted::comparison::{Comparison, ExactResult};
use nalgebra::DMatrix;
use serde::{Serialize, Serializer};

/// A test mode with its partners.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Mode {
    /// Its number in the test's file.
    pub mode: usize,
    /// Its frequency.
    pub test_hz: f64,
    /// Its partner among the modes of the first model, from one.
    pub first_mode: usize,
    /// The partner's frequency.
    pub first_hz: f64,
    /// Difference of this from the test's.
    pub first_error_percent: f64,
    /// Modal assurance criterion of the two, which knows no mass; none of a frequency alone.
    pub first_mac: Option<f64>,
    /// Its partner in the corrected model.
    pub corrected_mode: usize,
    /// The partner's frequency.
    pub corrected_hz: f64,
    /// Difference of this from the test's.
    pub corrected_error_percent: f64,
    /// Modal assurance criterion of the two.
    pub corrected_mac: Option<f64>,
    /// Residual of the frequency in its standard deviations, predicted ones of a mode that is held out; positive where the model's is higher.
    pub residual: Option<f64>,
    /// Standard deviation that the fit predicts of the frequency of a mode that is held out.
    pub predicted_deviation_percent: Option<f64>,
    /// Weight of the frequency in the fit: one over its standard deviation, times the job's own.
    pub frequency_weight: Option<f64>,
    /// Weight of the shape.
    pub shape_weight: Option<f64>,
    /// Mark of all its residuals: `good` as noise alone leaves them in 95 of 100 tests, `acceptable` in 999 of 1000, or `poor`.
    pub fit: Option<&'static str>,
}

/// A component of a test mode's shape beside those of its partners, each shape of a largest component of one and of the test's sign.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Reading {
    /// The test mode's number.
    pub mode: usize,
    /// The sensor's name.
    pub sensor: String,
    /// Its reading.
    pub test: f64,
    /// The component of the first model.
    pub first: f64,
    /// The component of the corrected model.
    pub corrected: f64,
    /// Residual in standard deviations, predicted ones of a mode that is held out.
    pub residual: Option<f64>,
}

/// Root mean square error of some modes.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Rms {
    /// Error of `frequency` or `shape`, of modes fitted or `held out`.
    pub error: &'static str,
    /// The error of the first model.
    pub first_percent: f64,
    /// The error of the corrected model.
    pub corrected_percent: f64,
}

/// Agreement of analysis modes (rows), up to the highest that is paired by shape, and test modes (columns).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Modal assurance criterion, which uses no mass.
    #[serde(rename = "modal_assurance", serialize_with = "by_rows")]
    pub assurance: DMatrix<f64>,
    /// Cross-orthogonality (4) of shapes of unit generalized mass, where the mass at the sensors is known.
    #[serde(
        rename = "cross_orthogonality",
        serialize_with = "by_rows_if_any",
        skip_serializing_if = "Option::is_none"
    )]
    pub orthogonality: Option<DMatrix<f64>>,
}

/// Derivatives at the first model by the relative stiffness or mass of each parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Derivatives {
    /// $\partial \ln f_i/\partial \ln s_e$ of the mode paired with test mode $i$ (parameters × test modes, those without shapes last).
    #[serde(rename = "frequency_percent_per_percent", serialize_with = "by_rows")]
    pub frequency: DMatrix<f64>,
    /// $\partial e_S/\partial \ln s_e$ of the error sum, by (12).
    #[serde(rename = "error_sum_per_percent")]
    pub error_sum: Vec<f64>,
}

/// The rows of a matrix.
#[doc(hidden)]
pub fn matrix_rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let rows = matrix.row_iter();
    rows.map(|row| row.iter().copied().collect()).collect()
}

/// A matrix as the list of its rows.
fn by_rows<S: Serializer>(matrix: &DMatrix<f64>, to: S) -> Result<S::Ok, S::Error> {
    matrix_rows(matrix).serialize(to)
}

/// As [`by_rows`], or nothing.
fn by_rows_if_any<S: Serializer>(matrix: &Option<DMatrix<f64>>, to: S) -> Result<S::Ok, S::Error> {
    matrix.as_ref().map(matrix_rows).serialize(to)
}

impl Derivatives {
    /// Derivatives at a model: $V_i^t K_e V_i/2\omega_i^2$, or $-V_i^t M_e V_i/2$ of a mass.
    ///
    /// # Errors
    /// [`Error::CoalescingModes`] and [`Error::NotAVibration`] where a thousandth of a parameter is too much.
    pub fn at(comparison: &Comparison) -> Result<Self, Error> {
        let (first, partners) = (comparison.model(), comparison.partners());
        let frequency = 0.5 * first.moves.select_rows(&partners).transpose();
        let changes = comparison.error_changes()?;
        let error_sum = changes.iter().map(|change| change / DERIVATIVE_STEP);
        Ok(Self {
            frequency,
            error_sum: error_sum.collect(),
        })
    }
}

/// A test beside its models.
#[derive(Debug, Clone)]
pub struct Compared<'a> {
    /// Test modes, sensors × modes.
    pub test: &'a Modes,
    /// The numbers in the test's file of the test modes, then of those without shapes.
    pub numbers: Vec<usize>,
    /// The exact solution of the first model.
    pub first: &'a ExactResult,
    /// The exact solution of the corrected model.
    pub last: &'a ExactResult,
    /// Mass at the sensors, if it is known.
    pub mass: Option<&'a DMatrix<f64>>,
}

impl Compared<'_> {
    /// A row for every test mode, those without shapes last; what residuals say is left open.
    ///
    /// # Errors
    /// The errors of [`Self::agreement`].
    pub fn modes(&self) -> Result<Vec<Mode>, Error> {
        let partners = |check: &ExactResult| {
            let (found, hertz) = (self.agreement(check)?, check.modes.frequencies_hz());
            let paired = check.pairing.analysis_mode.iter().enumerate();
            let paired = paired.map(|(mode, &own)| (own, Some(found.assurance[(own, mode)])));
            let alone = check.lone.iter().map(|lone| (lone.partner, None));
            let all = paired.chain(alone);
            let all: Vec<_> = all.map(|(own, mac)| (own + 1, hertz[own], mac)).collect();
            Ok::<_, Error>(all)
        };
        let (first, last) = (partners(self.first)?, partners(self.last)?);
        let alone = self.first.lone.iter().map(|lone| lone.frequency_hz);
        let test_hz = self.test.frequencies_hz().into_iter().chain(alone);
        let row = |(place, (mode, test_hz)): (usize, (&usize, f64))| {
            let percent = |hertz: f64| 100.0 * (hertz / test_hz - 1.0);
            let (first_mode, first_hz, first_mac) = first[place];
            let (corrected_mode, corrected_hz, corrected_mac) = last[place];
            Mode {
                mode: *mode,
                test_hz,
                first_mode,
                first_hz,
                first_error_percent: percent(first_hz),
                first_mac,
                corrected_mode,
                corrected_hz,
                corrected_error_percent: percent(corrected_hz),
                corrected_mac,
                residual: None,
                predicted_deviation_percent: None,
                frequency_weight: None,
                shape_weight: None,
                fit: None,
            }
        };
        Ok(self
            .numbers
            .iter()
            .zip(test_hz)
            .enumerate()
            .map(row)
            .collect())
    }

    /// Rows of the shapes at sensors of these names, mode by mode; residuals are left open.
    ///
    /// # Errors
    /// Errors of [`Pairing::paired`](crate::method::sorting::Pairing::paired).
    pub fn readings(&self, sensors: &[String]) -> Result<Vec<Reading>, Error> {
        let paired = |check: &ExactResult| check.pairing.paired(&check.modes);
        let all = [self.test.clone(), paired(self.first)?, paired(self.last)?];
        let mut rows = Vec::new();
        for (mode, number) in (0..self.test.len()).zip(&self.numbers) {
            let unit = |modes: &Modes| modes.shapes.column(mode) / modes.shapes.column(mode).amax();
            let [test, first, corrected] = all.each_ref().map(unit);
            rows.extend(sensors.iter().enumerate().map(|(row, sensor)| Reading {
                mode: *number,
                sensor: sensor.clone(),
                test: test[row],
                first: first[row],
                corrected: corrected[row],
                residual: None,
            }));
        }
        Ok(rows)
    }

    /// Root mean square errors before and after, those of modes held out apart.
    pub fn errors(&self, held: &[HeldOut]) -> Vec<Rms> {
        let ends = [self.first, self.last].map(|check| &check.errors);
        let frequency = (ends[0].frequency_count, ends.map(Errors::frequency_rms));
        let shape = (ends[0].shape_count, ends.map(Errors::shape_rms));
        let of_frequency: Vec<_> = held.iter().map(|own| own.frequency).collect();
        let of_shape: Vec<_> = held.iter().filter_map(|own| own.shape).collect();
        let mut rows = Vec::new();
        for (names, (count, rms), held) in [
            (
                ["frequency", "frequency, held out"],
                frequency,
                of_frequency,
            ),
            (["shape", "shape, held out"], shape, of_shape),
        ] {
            let out = [0, 1].map(|end| held.iter().map(|own| own[end].powi(2)).sum::<f64>());
            let rest = [0, 1].map(|end| count as f64 * (100.0 * rms[end]).powi(2) - out[end]);
            let parts = [(rest, count - held.len()), (out, held.len())];
            for (error, (sums, count)) in names.into_iter().zip(parts).filter(|own| own.1.1 > 0) {
                let [first_percent, corrected_percent] =
                    sums.map(|sum| (sum.max(0.0) / count as f64).sqrt());
                rows.push(Rms {
                    error,
                    first_percent,
                    corrected_percent,
                });
            }
        }
        rows
    }

    /// Agreement of the modes of an exact solution with the test's; paired ones are signed like them.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when shapes and mass do not fit; [`Error::Value`] for a shape that is zero or has no mass.
    pub fn agreement(&self, check: &ExactResult) -> Result<Agreement, Error> {
        let Some(highest) = check.pairing.analysis_mode.iter().max() else {
            return Ok(Agreement {
                assurance: DMatrix::zeros(0, 0),
                orthogonality: None,
            });
        };
        let modes = turned(&check.modes, &check.pairing, &check.together, self.test)?;
        let mut modes = modes.lowest(highest + 1)?;
        for (&mode, &sign) in check.pairing.analysis_mode.iter().zip(&check.pairing.sign) {
            modes.shapes.column_mut(mode).scale_mut(sign);
        }
        // The paired modes are brought to unit generalized mass as well; the mass need not know of the others.
        let orthogonality = |mass: &DMatrix<f64>| {
            let mut unit = modes.clone();
            for &mode in &check.pairing.analysis_mode {
                let mut shape = unit.shapes.column_mut(mode);
                let generalized_mass = shape.dot(&(mass * &shape));
                if generalized_mass > 0.0 {
                    shape /= generalized_mass.sqrt();
                }
            }
            cross_orthogonality(&unit, &self.test.scaled_with(mass)?, mass)
        };
        Ok(Agreement {
            assurance: modal_assurance(&modes.shapes, &self.test.shapes)?,
            orthogonality: self.mass.map(orthogonality).transpose()?,
        })
    }
}
