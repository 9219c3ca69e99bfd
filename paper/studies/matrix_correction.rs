//! Corrections of whole matrices: what the method does not do, and is to be compared with.
//!
//! In closed form, with the smallest change in a weighted norm, they give a model that has the measured modes exactly. Nothing says
//! which element the change belongs to, nor that any could make it.
//!
//! Sources: Baruch, "Optimization Procedure to Correct Stiffness and Flexibility Matrices Using Vibration Tests", *AIAA
//! Journal* 16 (1978), 1208–1210; Berman and Nagy, "Improvement of a Large Analytical Model Using Test Data", *AIAA
//! Journal* 21 (1983), 1168–1173.

use crate::prelude::*;

/// Baruch's correction of the stiffness, lbf/in (d × d):
///
/// $$ K = K_A + \Delta + \Delta^t, \qquad
///    \Delta = \tfrac12 M \Phi (\Phi^t K_A \Phi + \Omega^2) \Phi^t M - K_A \Phi \Phi^t M $$
///
/// with the analysis stiffness $K_A$, the mass $M$, and test shapes $\Phi$ (d × g, $\Phi^t M \Phi = I$) of squared
/// circular frequencies $\Omega^2$. Of all symmetric $K$ with $K\Phi = M\Phi \Omega^2$ it is the one of smallest
/// [`weighted_norm`] of $K - K_A$. With the corrected mass for $M$ it is Berman and Nagy's too, who write it so.
pub fn baruch_stiffness(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    test: &Modes,
) -> DMatrix<f64> {
    let (inertia, forces) = (mass * test.shapes(), stiffness * test.shapes());
    let generalized = test.shapes().tr_mul(&forces) + DMatrix::from_diagonal(test.omega_squared());
    let half = 0.5 * &inertia * generalized * inertia.transpose() - forces * inertia.transpose();
    symmetric_part(&(stiffness + &half + half.transpose()))
}

/// Berman and Nagy's correction of the mass, lbf·s²/in (d × d):
///
/// $$ M = M_A + M_A \Phi m_A^{-1} (I - m_A) m_A^{-1} \Phi^t M_A, \qquad m_A = \Phi^t M_A \Phi $$
///
/// with the analysis mass $M_A$ and measured shapes $\Phi$ (d × g) at the scale they are to keep. Of all symmetric $M$
/// with $\Phi^t M \Phi = I$ it is the one of smallest [`weighted_norm`] of $M - M_A$.
pub fn berman_nagy_mass(mass: &DMatrix<f64>, shapes: &DMatrix<f64>) -> DMatrix<f64> {
    let inertia = mass * shapes;
    let generalized = symmetric_part(&shapes.tr_mul(&inertia));
    let lower = cholesky("generalized mass", &generalized, 0.0).unwrap();
    // X = m⁻¹ Φᵗ M, and Xᵗ (I − m) X is the change.
    let mut solved = inertia.transpose();
    lower.solve_lower_triangular_unchecked_mut(&mut solved);
    lower.tr_solve_lower_triangular_unchecked_mut(&mut solved);
    let missing = eye(shapes.ncols()) - generalized;
    symmetric_part(&(mass + solved.tr_mul(&(missing * &solved))))
}

/// The norm in which the corrections are the smallest possible, $\lVert M^{-1/2} \Delta M^{-1/2} \rVert$: the root of
/// the sum of squares of all entries, each divided by the masses of its row and column when $M$ is diagonal.
///
/// For a change of stiffness in lbf/in it is in rad²/s², for a change of mass a fraction.
pub fn weighted_norm(change: &DMatrix<f64>, mass: &DMatrix<f64>) -> f64 {
    mass_weighted(change, mass).norm()
}

/// $L^{-1} \Delta L^{-t}$ with $M = L L^t$: up to a rotation the same as $M^{-1/2} \Delta M^{-1/2}$.
pub fn mass_weighted(change: &DMatrix<f64>, mass: &DMatrix<f64>) -> DMatrix<f64> {
    let lower = cholesky("dynamic mass", mass, 0.0).unwrap();
    let mut reduced = change.clone();
    lower.solve_lower_triangular_unchecked_mut(&mut reduced);
    reduced.transpose_mut();
    lower.solve_lower_triangular_unchecked_mut(&mut reduced);
    reduced
}
