//! Residuals between analysis and test, each over its standard deviation, and their Jacobian.

use crate::method::appendix_c::SMALLEST_SEPARATION;
use crate::method::error::Error;
use crate::method::error_sum::ModeWeight;
use crate::method::linear_algebra::{finite, finite_list};
use crate::method::model::{ModalModel, ParameterMatrix, check_weights};
use crate::method::modes::ModeSet;
use crate::method::pairing::Pairing;
use crate::weighted::close_modes::{Nearest, members, nearest};
use crate::weighted::noise::Noise;
use nalgebra::{DMatrix, DVector, RowDVector};

/// Standard deviations unless others are known: 0.5 % of a frequency, 2 % of a shape's largest component. They are about twice
/// [`Noise::USUAL`], for what repeats in a test and is wrong all the same: supports, the place of a sensor.
pub const DEVIATIONS: Noise = Noise {
    shape: 0.02,
    frequency: 0.005,
};

/// Weighted residuals of an exact analysis, $(1 + d)$ for each test mode: its frequency, then its $d$ sensors. Frequencies without
/// shapes follow, one each; so do their weights those of the test modes.
///
/// $$ r_{fj} = w_{fj} \Big(\frac{f_{Fi}}{f_{Gj}} - 1\Big), \qquad r_{vj} = w_{vj} (a_j v_i - u_j), \qquad
///    a_j = \frac{v_i^t u_j}{v_i^t v_i} $$
///
/// with $v_i$ the paired analysis shape and $u_j$ the test shape of unit largest component. Of test modes that are compared
/// together ([`ModalModel::with_groups`]) $V V^+ u_j$ stands for $a_j v_i$, with the shapes of all their partners in $V$. The analysis shape's scale is that
/// of least squares (the modal scale factor) instead of the paper's: it gives the sign, has no kink where the largest component
/// changes its place, and the noise of one component does not enter all others. Eliminating a linear unknown in this way
/// leaves the covariance of the others as it is with the scale among the unknowns, on which intervals depend.
///
/// # Errors
/// [`Error::WrongShape`] and [`Error::Setting`] for weights that do not fit; [`Error::NotFinite`].
///
/// Source: Golub and Pereyra, *SIAM Journal on Numerical Analysis* 10 (1973), 413.
pub fn residuals(model: &ModalModel, weights: &[ModeWeight]) -> Result<DVector<f64>, Error> {
    check_weights(weights, model.test.len() + model.exact.lone.len())?;
    let residuals = residuals_of(&model.exact.modes, &model.exact.pairing, model, weights);
    finite_list("residuals", residuals.data.into()).map(DVector::from_vec)
}

/// The residuals of any modes beside a model's test, of weights that fit.
pub(crate) fn residuals_of(
    modes: &ModeSet,
    pairing: &Pairing,
    ModalModel { test, exact, .. }: &ModalModel,
    weights: &[ModeWeight],
) -> DVector<f64> {
    let rows = 1 + test.shapes.nrows();
    let mut residuals = DVector::zeros(rows * test.len() + exact.lone.len());
    for (j, &i) in pairing.analysis_mode.iter().enumerate() {
        residuals[rows * j] =
            weights[j].frequency * ((modes.omega_squared[i] / test.omega_squared[j]).sqrt() - 1.0);
        let members = members(pairing, &exact.together, j);
        let apart = nearest(&modes.shapes, &members, &unit_shape(test, j)).apart;
        residuals
            .rows_mut(rows * j + 1, rows - 1)
            .copy_from(&(weights[j].shape * apart));
    }
    for (place, (lone, weight)) in exact.lone.iter().zip(&weights[test.len()..]).enumerate() {
        residuals[rows * test.len() + place] = weight.frequency * lone.error(modes);
    }
    residuals
}

/// A test shape of unit largest component.
fn unit_shape(test: &ModeSet, j: usize) -> DVector<f64> {
    let tested = test.shapes.column(j);
    tested / tested.amax()
}

/// Derivatives of [`residuals`] with respect to the logarithm of every parameter's factor, one column a parameter.
///
/// With $\beta = V^t K_e V$ of the parameter at its present factor, first order gives $\mathrm d\omega_i^2 = \beta_{ii}$ and
/// $\mathrm d v_i = \sum_{r \ne i} v_r \beta_{ri}/(\omega_i^2 - \omega_r^2)$. A mass enters as $\beta_{ri} = -\omega_i^2 \alpha_{ri}$. With
/// $e = a v - u$, which is orthogonal to $v$,
///
/// $$ \mathrm d e = a \Big(I - \frac{v v^t}{v^t v}\Big) \mathrm d v - v \frac{e^t \mathrm d v}{v^t v}, \qquad
///    \mathrm d e = (I - V V^+) \mathrm d V V^+ u - (V^+)^t \mathrm d V^t e , $$
///
/// the second of modes compared together.
///
/// The sum goes over the whole basis, rigid-body modes with $\omega_r^2 = 0$ among it. It is exact with all modes, unless a
/// condensation's $B$ moves mass. Modes closer than [`SMALLEST_SEPARATION`] keep their own shapes.
///
/// # Errors
/// Those of [`residuals`].
///
/// Source: Fox and Kapoor, *AIAA Journal* 6 (1968), 2426.
pub fn jacobian(model: &ModalModel, weights: &[ModeWeight]) -> Result<DMatrix<f64>, Error> {
    let (modes, test, lone) = (&model.basis, &model.test, &model.exact.lone);
    check_weights(weights, test.len() + lone.len())?;
    let (k, rows, count) = (
        &modes.omega_squared,
        1 + test.shapes.nrows(),
        model.shares.len(),
    );
    let change = |r: usize, i: usize, share: &ParameterMatrix| match share {
        ParameterMatrix::Stiffness(beta) => beta[(r, i)],
        ParameterMatrix::Mass(alpha) => -k[i] * alpha[(r, i)],
    };
    // Of the frequency of mode i, which is so many times the test's (1 × p).
    let of_frequency = |weight: &ModeWeight, ratio: f64, i: usize| {
        let slope = |share| weight.frequency * ratio * change(i, i, share) / (2.0 * k[i]);
        RowDVector::from_iterator(count, model.shares.iter().map(slope))
    };
    let mut jacobian = DMatrix::zeros(rows * test.len() + lone.len(), count);
    for (j, &i) in model.exact.pairing.analysis_mode.iter().enumerate() {
        let ratio = (k[i] / test.omega_squared[j]).sqrt();
        let members = members(&model.exact.pairing, &model.exact.together, j);
        let Nearest {
            inverse,
            shares,
            apart,
        } = nearest(&modes.shapes, &members, &unit_shape(test, j));
        let v = modes.shapes.select_columns(&members);
        let mut shape = DMatrix::zeros(rows - 1, count);
        for (place, &i) in members.iter().enumerate() {
            // The share of every other mode that each parameter adds to this one (n × p).
            let added = DMatrix::from_fn(k.len(), count, |r, e| {
                let (apart, held) = (k[i] - k[r], SMALLEST_SEPARATION * k[i].max(k[r]));
                if apart.abs() > held && !members.contains(&r) {
                    change(r, i, &model.shares[e]) / apart
                } else {
                    0.0
                }
            });
            let moved = &modes.shapes * added;
            let out = &moved - &v * (&inverse * &moved);
            shape +=
                shares[place] * out - inverse.row(place).transpose() * (apart.transpose() * moved);
        }
        let shape = weights[j].shape * shape;
        jacobian
            .view_mut((rows * j + 1, 0), (rows - 1, count))
            .copy_from(&shape);
        jacobian.set_row(rows * j, &of_frequency(&weights[j], ratio, i));
    }
    for (place, (lone, weight)) in lone.iter().zip(&weights[test.len()..]).enumerate() {
        let row = of_frequency(weight, 1.0 + lone.error(modes), lone.partner);
        jacobian.set_row(rows * test.len() + place, &row);
    }
    finite("Jacobian", jacobian)
}
