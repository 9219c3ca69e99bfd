//! New modes after a change of stiffness (9 to 11), without an eigensolution.
//! Tour: [chapter 6](crate::tour::chapter_06_inner_loop).

use super::{
    error::Result,
    linear_algebra::Matrix,
    modes::Modes,
    perturbation::{Perturbed, recursive_1_converged},
};

/// Modes after a change $\beta = V^t \Delta K V$ (n × n), by Recursive 1 (C.22) carried until its roots have settled, and their shapes $p$ in
/// terms of the modes before (n × n), of unit generalized mass.
///
/// # Errors
/// Every error of [`recursive_1_converged`].
///
/// # Example
///
/// ```rust
/// use corfem::method::changed_modes::changed_modes;
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // Twice the stiffness of two modes of their own: the shapes stay.
/// let before = Modes::new(dvector![1.0, 5.0], DMatrix::identity(2, 2))?;
/// let (after, p) = changed_modes(&before, &dmatrix![1.0, 0.0; 0.0, 5.0])?;
/// assert!((after.omega_squared() - dvector![2.0, 10.0]).amax() < 1e-14);
/// assert_eq!((after.shapes(), p), (before.shapes(), DMatrix::identity(2, 2)));
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn changed_modes(before: &Modes, beta: &Matrix) -> Result<(Modes, Matrix)> {
    let mut changed = recursive_1_converged(&before.omega_squared, beta)?.perturbed;
    for mut p in changed.shapes.column_iter_mut() {
        p.normalize_mut();
    }
    Ok((modes_of(&changed, before), changed.shapes))
}

/// Modes of changed roots and shapes: $\omega^2 = 1/\gamma$ (10) and $V p$ (11), without the difference $\Delta V = V (p - I)$ (9).
pub(crate) fn modes_of(changed: &Perturbed, before: &Modes) -> Modes {
    // The perturbation has refused what is no mode.
    Modes {
        omega_squared: changed.roots.map(f64::recip),
        shapes: &before.shapes * &changed.shapes,
    }
}
