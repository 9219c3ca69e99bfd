//! Residuals between analysis and test, each over its standard deviation, and their Jacobian.

use crate::method::analysis::State;
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::method::sorting::Pairing;
use crate::sparse::{ModeWeight, Pair, check_weights, finite, pair_cheaply};
use crate::weighted::close_modes::{Nearest, members, nearest};
use crate::weighted::comparison::{Comparison, Correction, Test};
use crate::weighted::noise::Noise;
use nalgebra::{DMatrix, DVector};

/// Standard deviations unless others are known: 0.5 % of a frequency, 2 % of a shape's largest component. They are about twice
/// [`Noise::USUAL`], to cover errors that repeat in a test, such as those of supports and of the places of sensors.
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
/// together ([`Comparison::with_groups`]) $V V^+ u_j$ stands for $a_j v_i$, with the shapes of all their partners in $V$. Components with
/// weights of their own ([`Comparison::with_component_weights`]) are multiplied by these in $v_i$, $V$ and $u_j$ first. The analysis shape's scale is that of least squares (the modal
/// scale factor) instead of the paper's: it gives the sign, has no kink where the largest component
/// changes its place, and the noise of one component does not enter all others. Eliminating a linear unknown in this way
/// leaves the covariance of the others as it is with the scale among the unknowns, on which intervals depend.
///
/// # Errors
/// [`Error::WrongShape`] and [`Error::Value`] for weights that do not fit; [`Error::Value`].
///
/// Source: Golub and Pereyra, *SIAM Journal on Numerical Analysis* 10 (1973), 413.
pub fn residuals(comparison: &Comparison, weights: &[ModeWeight]) -> Result<DVector<f64>, Error> {
    let Comparison {
        model,
        test,
        correction,
    } = comparison;
    check_weights(weights, model.test.len() + test.lone.len())?;
    let State { modes, pairing, .. } = &model.exact;
    let mut residuals = residuals_of(modes, pairing, comparison, weights);
    if let Some(Correction { slopes, moved }) = correction {
        residuals += &**slopes * moved;
    }
    let column = DMatrix::from_column_slice(residuals.len(), 1, residuals.as_slice());
    finite("residuals", column).map(|_| residuals)
}

/// The residuals of any modes beside a model's test, of weights that fit.
pub(crate) fn residuals_of(
    modes: &Modes,
    pairing: &Pairing,
    comparison: &Comparison,
    weights: &[ModeWeight],
) -> DVector<f64> {
    let (test, Test { together, lone, .. }) = (&comparison.model.test, &comparison.test);
    let rows = 1 + test.shapes.nrows();
    let mut residuals = DVector::zeros(rows * test.len() + lone.len());
    for (j, &i) in pairing.analysis_mode.iter().enumerate() {
        residuals[rows * j] =
            weights[j].frequency * ((modes.omega_squared[i] / test.omega_squared[j]).sqrt() - 1.0);
        let members = members(&modes.omega_squared, pairing, together, j);
        let apart = compared(&modes.shapes, comparison, &members, j).1.apart;
        residuals
            .rows_mut(rows * j + 1, rows - 1)
            .copy_from(&(weights[j].shape * apart));
    }
    for (place, (lone, weight)) in lone.iter().zip(&weights[test.len()..]).enumerate() {
        residuals[rows * test.len() + place] = weight.frequency * lone.error(modes);
    }
    residuals
}

/// Rule that gives every test mode the partner with which all residuals are least, as the likelihood of factors has it whatever the pairs; of
/// shapes alone, the most alike.
pub(crate) fn pair_by_residuals(test: &Modes, weights: &[ModeWeight]) -> Pair {
    let (weights, roots) = (weights.to_vec(), test.omega_squared.clone());
    let sizes: Vec<f64> = test
        .shapes
        .column_iter()
        .map(|own| own.norm() / own.amax())
        .collect();
    Pair::by(move |of| {
        let costs = of.cross.map_with_location(|i, j, close| {
            let apart = 1.0 - close * close;
            if of.moves.is_none() {
                return apart;
            }
            let ratio = (of.modes.omega_squared[i] / roots[j]).sqrt() - 1.0;
            (weights[j].frequency * ratio).powi(2) + (weights[j].shape * sizes[j]).powi(2) * apart
        });
        let partners = pair_cheaply(&costs)?.0.into_iter().flatten().collect();
        Ok(Pairing::signed(partners, of.cross))
    })
}

/// The `members` among shapes as test mode `j` is compared with them, every component over its deviation, and their combination nearest
/// to the test shape of unit largest component.
pub(super) fn compared(
    shapes: &DMatrix<f64>,
    Comparison { model, test, .. }: &Comparison,
    members: &[usize],
    j: usize,
) -> (DMatrix<f64>, Nearest) {
    let (weights, tested) = (
        test.component_weights.column(j),
        model.test.shapes.column(j),
    );
    let mut own = shapes.select_columns(members);
    for mut shape in own.column_iter_mut() {
        shape.component_mul_assign(&weights);
    }
    let unit = tested.component_mul(&weights) / tested.amax();
    let nearest = nearest(&own, &unit);
    (own, nearest)
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
/// the second of modes compared together. Weights of components multiply $v$, $\mathrm d v$ and $u$ alike, so nothing else changes.
///
/// The sum goes over the whole basis, rigid-body modes with $\omega_r^2 = 0$ among it. It is exact with all modes, unless a
/// condensation's $B$ moves mass. Modes whose squared frequencies are closer than a millionth keep their own shapes.
///
/// # Errors
/// Those of [`residuals`].
///
/// Source: Fox and Kapoor, *AIAA Journal* 6 (1968), 2426.
pub fn jacobian(comparison: &Comparison, weights: &[ModeWeight]) -> Result<DMatrix<f64>, Error> {
    let Comparison {
        model,
        test: Test { together, lone, .. },
        correction,
    } = comparison;
    let (test, State { modes, pairing, .. }) = (&model.test, &model.exact);
    check_weights(weights, test.len() + lone.len())?;
    let (rows, count) = (1 + test.shapes.nrows(), model.moves.ncols());
    let roots = &modes.omega_squared;
    // Of the frequency of mode i, which is `ratio` times the test's.
    let of_frequency = |weight: &ModeWeight, ratio: f64, i: usize| {
        0.5 * weight.frequency * ratio * model.moves.row(i)
    };
    let compared_modes = model.compared();
    let slopes: Vec<DMatrix<f64>> = compared_modes.iter().map(|&i| model.slopes_of(i)).collect();
    let mut jacobian = DMatrix::zeros(rows * test.len() + lone.len(), count);
    for (j, of) in weights.iter().enumerate().take(test.len()) {
        let members = members(roots, pairing, together, j);
        let (v, nearest) = compared(&modes.shapes, comparison, &members, j);
        let Nearest {
            inverse,
            shares,
            apart,
        } = nearest;
        let ratio = (roots[members[0]] / test.omega_squared[j]).sqrt();
        jacobian.set_row(rows * j, &of_frequency(of, ratio, members[0]));
        let scale = comparison.test.component_weights.column(j);
        for (place, i) in members.iter().enumerate() {
            // dv, over the components' deviations, and what becomes of it in the residuals.
            let mut moved = slopes[compared_modes.partition_point(|own| own < i)].clone();
            for mut moved in moved.column_iter_mut() {
                moved.component_mul_assign(&scale);
            }
            let turned = inverse.row(place).transpose() * apart.tr_mul(&moved);
            let along = &v * (&inverse * &moved);
            let mut shape = jacobian.rows_mut(rows * j + 1, rows - 1);
            shape += of.shape * (shares[place] * (moved - along) - turned);
        }
    }
    for (place, (lone, weight)) in lone.iter().zip(&weights[test.len()..]).enumerate() {
        let row = of_frequency(weight, 1.0 + lone.error(modes), lone.partner);
        jacobian.set_row(rows * test.len() + place, &row);
    }
    if let Some(correction) = correction {
        jacobian += &*correction.slopes;
    }
    finite("Jacobian", jacobian)
}
