//! Closed forms of two degrees of freedom: the exact answers that every approximation is measured against.

use crate::prelude::*;

/// Squared circular frequencies of $K v = \omega^2 M v$ (2 × 2), ascending, rad²/s².
///
/// The characteristic equation $\omega^4 \det M - b \omega^2 + \det K = 0$ has
///
/// $$ b = k_{11} m_{22} + k_{22} m_{11} - 2 k_{12} m_{12}, $$
/// $$ b^2 - 4 \det K \det M = (k_{11} m_{22} - k_{22} m_{11})^2 +
///    4 (k_{12} m_{11} - k_{11} m_{12})(k_{12} m_{22} - k_{22} m_{12}), $$
///
/// the second form without the cancellation of the first. The larger root in magnitude is
/// $q = \big(b \pm \sqrt{b^2 - 4\det K\det M}\big)/(2 \det M)$ with the sign of $b$, the other $\det K/(q \det M)$.
///
/// `stiffness` in lbf/in, `mass` in lbf·s²/in. A motion that nothing holds has the root zero, an unstable one a
/// negative root.
pub fn squared_frequencies(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> [f64; 2] {
    let [k11, k12, k22] = entries(stiffness);
    let [m11, m12, m22] = entries(mass);
    let b = k11 * m22 + k22 * m11 - 2.0 * k12 * m12;
    let discriminant =
        (k11 * m22 - k22 * m11).powi(2) + 4.0 * (k12 * m11 - k11 * m12) * (k12 * m22 - k22 * m12);
    // The discriminant of a symmetric pencil is never negative; round-off may make it so.
    let numerator = (b + discriminant.max(0.0).sqrt().copysign(b)) / 2.0;
    if numerator == 0.0 {
        return [0.0, 0.0];
    }
    let larger = numerator / (m11 * m22 - m12 * m12);
    let other = (k11 * k22 - k12 * k12) / numerator;
    [larger.min(other), larger.max(other)]
}

/// Exact roots and generalized shapes of two modes after a change of stiffness, by Jacobi's rotation.
///
/// With $a = k_{11} + \beta_{11}$, $d = k_{22} + \beta_{22}$, $b = \beta_{12}$ and the tangent of the smaller angle of
/// rotation,
///
/// $$ t = \frac{\mathrm{sign}(\tau)}{|\tau| + \sqrt{1 + \tau^2}}, \qquad \tau = \frac{d - a}{2b}, $$
/// $$ \frac{1}{\gamma_1} = a - t b, \qquad \frac{1}{\gamma_2} = d + t b, \qquad p_{21} = -t, \qquad p_{12} = t. $$
///
/// The smaller angle, at most 45 degrees, is what makes mode $j$ the continuation of mode $j$.
/// `generalized_stiffness` is $k_{ii} = \omega_i^2$ (rad²/s², 2) and `beta` $= V^t \Delta K V$ (2 × 2).
pub fn perturbed(generalized_stiffness: &DVector<f64>, beta: &DMatrix<f64>) -> Perturbed {
    let [beta11, b, beta22] = entries(beta);
    let a = generalized_stiffness[0] + beta11;
    let d = generalized_stiffness[1] + beta22;
    let tau = (d - a) / (2.0 * b);
    let tangent = if b == 0.0 {
        0.0
    } else {
        (1.0 / (tau.abs() + tau.hypot(1.0))).copysign(tau)
    };
    let roots = dvector![1.0 / (a - tangent * b), 1.0 / (d + tangent * b)];
    Perturbed {
        roots,
        shapes: DMatrix::from_row_slice(2, 2, &[1.0, tangent, -tangent, 1.0]),
    }
}

/// The three entries of a symmetric 2 × 2 matrix: first diagonal, off-diagonal, second diagonal.
fn entries(matrix: &DMatrix<f64>) -> [f64; 3] {
    [matrix[(0, 0)], matrix[(1, 0)], matrix[(1, 1)]]
}
