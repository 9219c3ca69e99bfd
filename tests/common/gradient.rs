//! The gradient of the error sum: the limit of the paper's difference (12) for all parameters at once, and a second route to it.

use crate::prelude::*;

/// Derivative of the error sum with respect to every parameter's factor, relative to the present one: the limit of
/// $\Delta e_e/0.001$ for smaller and smaller changes.
///
/// By first order $\mathrm d\omega_i^2 = \beta_{ii}$ and $\mathrm d v_i = \sum_{r \ne i} v_r \beta_{ri}/(\omega_i^2 - \omega_r^2)$. With
/// $g_i = \partial e_v/\partial v_i$, and because $\beta$ is symmetric,
///
/// $$ \frac{\mathrm d e_S}{\mathrm d c_e} = \sum_{r,i} \Sigma_{ri} \kappa_{ri}, \qquad \kappa = V^t K_e V, \qquad
/// \Sigma_{ii} = \frac{\partial e_f}{\partial \omega_i^2}, \qquad
/// \Sigma_{ri} = \Sigma_{ir} = \frac{v_r^t g_i - v_i^t g_r}{2(\omega_i^2 - \omega_r^2)} . $$
///
/// Where an error is zero its root has a kink and no derivative; that error then counts as constant. Modes closer than
/// [`SMALLEST_SEPARATION`] keep their own shapes.
///
/// # Errors
/// None: states belong to their models here.
pub fn gradient(model: &Model, state: &State) -> Result<Vec<f64>, Error> {
    let (k, p) = (state.modes.omega_squared(), &state.generalized_shapes);
    let mut sensitivity = shape_pull(model, state);
    for i in 0..k.len() {
        sensitivity[(i, i)] = 0.0;
        for r in i + 1..k.len() {
            let apart = k[i] - k[r];
            let both = sensitivity[(r, i)] - sensitivity[(i, r)];
            let are_apart = apart.abs() > SMALLEST_SEPARATION * k[i].max(k[r]);
            sensitivity[(r, i)] = if are_apart { 0.5 * both / apart } else { 0.0 };
            sensitivity[(i, r)] = sensitivity[(r, i)];
        }
    }
    for (j, &i) in state.pairing.analysis_mode.iter().enumerate() {
        if state.errors.frequency > 0.0 {
            let ratio = (k[i] / model.test().omega_squared()[j]).sqrt();
            sensitivity[(i, i)] = (ratio - 1.0) * ratio / (2.0 * k[i] * state.errors.frequency);
        }
    }
    // In the exact modes, to which the shares belong.
    let sensitivity = p * sensitivity * p.transpose();
    let slope = |(share, factor): (&DMatrix<f64>, &f64)| factor * sensitivity.dot(share);
    let shares = model.shares().iter();
    Ok(shares.zip(&state.factors).map(slope).collect())
}

/// $v_r^t \partial e_v/\partial v_i$ (n × n): what mode $r$ added to mode $i$ does to the shape error.
fn shape_pull(model: &Model, state: &State) -> DMatrix<f64> {
    let shapes = state.modes.shapes();
    let mut slopes = DMatrix::zeros(shapes.nrows(), shapes.ncols());
    let pairs = state.pairing.analysis_mode.iter().enumerate();
    for (j, &i) in pairs.filter(|_| state.errors.shape > 0.0) {
        // With u = ±v/|v_m| and the test's w, both of unit largest component: ∂e_v/∂v = ±(u − w)/(d e_v |v_m|), and what
        // the scale takes away at component m.
        let (v, w, sign) = (
            shapes.column(i),
            model.test().shapes().column(j),
            state.pairing.sign[j],
        );
        let (m, largest) = (v.iamax(), v.amax());
        let mut slope = v * (sign / largest) - w / w.amax();
        slope[m] -= slope.dot(&v) / v[m];
        slope *= sign / (shapes.nrows() as f64 * state.errors.shape * largest);
        slopes.set_column(i, &slope);
    }
    shapes.tr_mul(&slopes)
}
