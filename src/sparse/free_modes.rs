//! Modes of structures that hang free, as an aircraft in its test, and where some degrees of freedom have no mass: found by a shift, and
//! counted. Zero and infinite eigenvalues of the pencil must neither be lost nor counted as vibrations.

use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_shape, check_symmetric, cholesky, symmetric_eigen, symmetric_part,
};
use crate::method::modes::ModeSet;
use nalgebra::{DMatrix, DVector};

/// Mass of a direction relative to the largest, and squared frequency relative to the shift, below which either counts as zero.
const ZERO: f64 = 1e-9;

/// Modes of a pencil, the rigid-body modes apart.
#[derive(Debug, Clone, PartialEq)]
pub struct CountedModes {
    /// Motions without strain, of unit generalized mass and orthogonal to each other (d × r).
    pub rigid_body: DMatrix<f64>,
    /// Every vibration of finite frequency, ascending, of unit generalized mass.
    pub vibrations: ModeSet,
}

impl CountedModes {
    /// Of modes in ascending order the first ones, which are rigid-body modes, and the `count` vibrations behind them.
    pub(crate) fn of(modes: &ModeSet, rigid: usize, count: usize) -> Self {
        let vibrations: Vec<usize> = (rigid..rigid + count).collect();
        Self {
            rigid_body: modes.shapes.columns(0, rigid).into_owned(),
            vibrations: modes.select(&vibrations),
        }
    }
}

/// Every mode of finite frequency of $K v = \omega^2 M v$ for semidefinite `stiffness` (lbf/in) and `mass` (lbf·s²/in), d × d.
///
/// With $M = F F^t$ and a shift $\sigma > 0$,
///
/// $$ F^t (K + \sigma M)^{-1} F y = \mu y, \qquad \omega^2 = \frac{1}{\mu} - \sigma, \qquad v = \frac{1}{\mu} (K + \sigma M)^{-1} F y , $$
///
/// so that rigid-body modes are the roots $\mu = 1/\sigma$ and massless motions do not enter. The number found is
/// compared with [`count_below`] a bound twice the highest, and that of the rigid-body modes below the lowest
/// vibration. Source: Sylvester's law of inertia; Parlett, *The Symmetric Eigenvalue Problem* (1980), chapter 3 and
/// section 15.
///
/// # Errors
/// Those of [`check_symmetric`]; [`Error::Empty`] without mass; [`Error::NotPositiveDefinite`] for a motion that has neither
/// stiffness nor mass, or a matrix that is not semidefinite; [`Error::Miscounted`] when a count by inertia differs.
pub fn counted_modes(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Result<CountedModes, Error> {
    check_symmetric("stiffness", stiffness)?;
    check_shape("mass", mass, stiffness.nrows(), stiffness.nrows())?;
    let (values, directions) = symmetric_eigen("mass", mass)?;
    let largest = values
        .iter()
        .fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if let Some(dof) = values.iter().position(|value| *value < -ZERO * largest) {
        return Err(Error::NotPositiveDefinite { what: "mass", dof });
    }
    let massive: Vec<usize> = (0..values.len())
        .filter(|&row| values[row] > ZERO * largest)
        .collect();
    at_least_one("degrees of freedom with mass", massive.len())?;
    let mut f = directions.select_columns(&massive);
    f.column_iter_mut()
        .zip(&massive)
        .for_each(|(mut column, &row)| column *= values[row].sqrt());
    // A shift of the size of the lower frequencies: a thousandth of the mean of all.
    let sigma = 1e-3 * stiffness.trace().max(f64::MIN_POSITIVE) / mass.trace();
    let shifted = stiffness + sigma * mass;
    let lower = cholesky("stiffness shifted by the mass", &shifted, f64::EPSILON)?;
    let mut deflections = f.clone();
    lower.solve_lower_triangular_unchecked_mut(&mut deflections);
    lower.tr_solve_lower_triangular_unchecked_mut(&mut deflections);
    let (roots, vectors) = symmetric_eigen(
        "shifted flexibility",
        &symmetric_part(&f.tr_mul(&deflections)),
    )?;
    // Ascending roots are descending frequencies.
    let order: Vec<usize> = (0..roots.len()).rev().collect();
    let omega_squared = roots.select_rows(&order).map(|root| 1.0 / root - sigma);
    let mut shapes = deflections * vectors.select_columns(&order);
    shapes
        .column_iter_mut()
        .zip(&order)
        .for_each(|(mut shape, &row)| shape /= roots[row]);
    let rigid = omega_squared
        .iter()
        .take_while(|value| **value < 1e3 * ZERO * sigma)
        .count();
    let last = omega_squared.len() - 1;
    let bound = 2.0 * omega_squared[last].max(sigma);
    let lowest = if rigid <= last {
        0.5 * omega_squared[rigid]
    } else {
        bound
    };
    for (bound, found) in [(bound, last + 1), (lowest, rigid)] {
        let counted = count_below(stiffness, mass, bound)?;
        if counted != found {
            return Err(Error::Miscounted {
                bound,
                counted,
                found,
            });
        }
    }
    Ok(CountedModes::of(
        &ModeSet {
            omega_squared,
            shapes,
        },
        rigid,
        last + 1 - rigid,
    ))
}

/// How many eigenvalues $\omega^2$ of the pencil lie below a bound that is none of them: the number of negative eigenvalues of
/// $K - b M$, which no congruence changes. Massless motions have infinite ones and do not count.
///
/// # Errors
/// Those of [`symmetric_eigen`].
pub fn count_below(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    bound: f64,
) -> Result<usize, Error> {
    let difference = stiffness - bound * mass;
    // A congruence that brings the diagonal to one keeps the signs and takes the spread of units out of the round-off.
    let scale = DVector::from_fn(difference.nrows(), |i, _| {
        let size = stiffness[(i, i)].abs() + bound * mass[(i, i)].abs();
        if size > 0.0 { 1.0 / size.sqrt() } else { 1.0 }
    });
    let scaled = symmetric_part(&difference.component_mul(&(&scale * scale.transpose())));
    let (values, _) = symmetric_eigen("shifted pencil", &scaled)?;
    Ok(values.iter().filter(|value| **value < 0.0).count())
}
