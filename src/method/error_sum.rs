//! The error sum (5, 6): how far the analysis modes are from the test modes.
//! Tour: [chapter 3](crate::tour::chapter_03_error_sum).

use super::{
    error::{Result, positive, require},
    linear_algebra::check_shape,
    modes::{Modes, mode},
    sorting::Pairing,
};

/// Errors of one test mode.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ModeError {
    /// Relative difference of its frequency, with its sign.
    pub frequency: f64,
    /// Root mean square difference of its shape over the DOF, both of unit largest component.
    pub shape: f64,
}

/// Errors of every test mode, whose squares (5) and (6) add up.
///
/// # Errors
/// Test shapes at other DOF, modes other than those paired, and an analysis mode that moves at none of the DOF compared.
pub fn mode_errors(analysis: &Modes, pairing: &Pairing, test: &Modes) -> Result<Vec<ModeError>> {
    let (paired, dof_count) = (pairing.paired(analysis)?, analysis.shapes.nrows());
    check_shape(
        "test mode shapes",
        &test.shapes,
        dof_count,
        pairing.sign.len(),
    )?;
    let error = |j: usize| {
        let (v, w) = (paired.shapes.column(j), test.shapes.column(j));
        let owner = || format!("analysis {}", mode(pairing.analysis_mode[j]));
        positive("largest component where it is compared", owner, v.amax())?;
        let difference = v * (1.0 / v.amax()) - w * (1.0 / w.amax());
        Ok(ModeError {
            frequency: (paired.omega_squared[j] / test.omega_squared[j]).sqrt() - 1.0,
            shape: (difference.norm_squared() / dof_count as f64).sqrt(),
        })
    };
    (0..test.len()).map(error).collect()
}

/// Square-root-of-sum-of-squares (SRSS) errors over the test modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Frequency error $e_f$ (5), a fraction.
    pub frequency: f64,
    /// Mode shape error $e_v$ (6), a fraction.
    pub shape: f64,
    /// Number of frequencies compared.
    pub frequency_count: usize,
    /// Number of shapes compared.
    pub shape_count: usize,
}

impl Errors {
    /// Sums over the errors of test modes.
    ///
    /// # Errors
    /// Errors so large that their squares are not finite.
    pub fn of(each: &[ModeError]) -> Result<Self> {
        let srss = |of: fn(&ModeError) -> f64| {
            each.iter()
                .map(|error| of(error).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let errors = Self {
            frequency: srss(|error| error.frequency),
            shape: srss(|error| error.shape),
            frequency_count: each.len(),
            shape_count: each.len(),
        };
        let sum = errors.sum();
        require(
            sum.is_finite(),
            "error sum",
            || "these modes".into(),
            sum,
            "a finite number",
        )?;
        Ok(errors)
    }

    /// Error sum $e_S = e_f + e_v$.
    pub fn sum(&self) -> f64 {
        self.frequency + self.shape
    }

    /// Root mean square frequency error, $e_f/\sqrt n$.
    pub fn frequency_rms(&self) -> f64 {
        self.frequency / (self.frequency_count.max(1) as f64).sqrt()
    }

    /// Root mean square shape error, $e_v/\sqrt n$.
    pub fn shape_rms(&self) -> f64 {
        self.shape / (self.shape_count.max(1) as f64).sqrt()
    }
}

/// SRSS errors of the paired analysis modes against the test modes.
///
/// $$ e_f = \Big[\sum_i \Big(\frac{f_{Fi} - f_{Gi}}{f_{Gi}}\Big)^2\Big]^{1/2}, \qquad
///    e_v = \Big[\sum_i \sum_{j=1}^{d} \frac{(V_{Fji} - V_{Gji})^2}{d}\Big]^{1/2} $$
///
/// with every shape scaled to unit largest component and the analysis shape signed like its test mode. The frequency
/// error is relative: the paper prints a difference but its tables hold the relative one (`paper/errata.md`).
///
/// # Errors
/// Every error of [`mode_errors`] and [`Errors::of`].
///
/// # Example
///
/// ```rust
/// use corfem::method::error_sum::errors;
/// use corfem::method::modes::Modes;
/// use corfem::method::sorting::Pairing;
/// use nalgebra::{DMatrix, dvector};
///
/// // Frequencies 30 % and 40 % too high, shapes alike: √(0.3² + 0.4²).
/// let shapes = DMatrix::identity(2, 2);
/// let analysis = Modes::new(dvector![1.3 * 1.3, 1.4 * 1.4], shapes.clone())?;
/// let test = Modes::new(dvector![1.0, 1.0], shapes)?;
/// let pairing = Pairing { analysis_mode: vec![0, 1], sign: vec![1.0, 1.0] };
/// let errors = errors(&analysis, &pairing, &test)?;
/// assert!((errors.frequency - 0.5).abs() < 1e-15 && errors.shape == 0.0);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn errors(analysis: &Modes, pairing: &Pairing, test: &Modes) -> Result<Errors> {
    Errors::of(&mode_errors(analysis, pairing, test)?)
}
