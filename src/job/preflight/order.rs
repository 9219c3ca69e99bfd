//! Points in another order: a first guess that does not depend on the order of modes or their signs, then exchanges.

use super::comparison::{Comparison, reordered};
use crate::method::error::Error;
use crate::method::model::DynamicModel;
use crate::method::modes::ModeSet;
use crate::method::pairing::{pair_modes, paired};
use nalgebra::DMatrix;

/// Most rounds of guessing the order from the pairs and the pairs from the order; it settles after two or three.
pub(super) const ROUNDS: usize = 10;
/// Least gain of agreement for one more exchange, above round-off.
const LEAST_EXCHANGE: f64 = 1e-9;

/// Exchanges two places at a time, the pair that gains most, until none gains; the order reached and its agreement.
fn exchange(
    mut order: Vec<usize>,
    mut agreement_above: impl FnMut(&[usize], f64) -> Result<Option<f64>, Error>,
) -> Result<(Vec<usize>, f64), Error> {
    let mut reached = agreement_above(&order, 0.0)?.unwrap_or(0.0);
    // Sorting takes far fewer exchanges.
    for _ in 0..2 * order.len() {
        let mut best = None;
        for b in 0..order.len() {
            for a in 0..b {
                order.swap(a, b);
                if let Some(agreement) = agreement_above(&order, reached + LEAST_EXCHANGE)? {
                    (reached, best) = (agreement, Some((a, b)));
                }
                order.swap(a, b);
            }
        }
        let Some((a, b)) = best else { break };
        order.swap(a, b);
    }
    Ok((order, reached))
}

/// The order of the test's points that agrees best with the model, as far as it is found, and its agreement.
///
/// A point is known by what it does in all modes, each scaled to unit largest component. At first the modes are taken
/// in the order of their frequencies and without sign; then they are paired by the order found, and so on.
pub(super) fn best_order(comparison: &Comparison, test: &ModeSet) -> (Vec<usize>, f64) {
    let count = test.len();
    let mut by_frequency: Vec<usize> = (0..count).collect();
    by_frequency.sort_by(|&a, &b| test.omega_squared[a].total_cmp(&test.omega_squared[b]));
    let analysis = unit(comparison.analysis.shapes.columns(0, count).into_owned()).abs();
    let shapes = unit(test.shapes.clone());
    let Some(mut order) = matched(&analysis, &shapes.select_columns(&by_frequency).abs()) else {
        return ((0..test.shapes.nrows()).collect(), 0.0);
    };
    for _ in 0..ROUNDS {
        let pairing = comparison
            .cross(&test.shapes.select_rows(&order))
            .and_then(|cross| pair_modes(&cross).ok());
        let Some(analysis) =
            pairing.and_then(|pairing| paired(&comparison.analysis, &pairing).ok())
        else {
            break;
        };
        match matched(&unit(analysis.shapes), &shapes) {
            Some(next) if next != order => order = next,
            _ => break,
        }
    }
    let agreement = |order: &[usize], least| {
        Ok(comparison.agreement_above(&test.shapes.select_rows(order), least))
    };
    exchange(order.clone(), agreement).unwrap_or((order, 0.0))
}

/// Nonzero shapes scaled to unit largest component.
pub(super) fn unit(mut shapes: DMatrix<f64>) -> DMatrix<f64> {
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        shape /= largest;
    }
    shapes
}

/// For every row the nearest row of the other matrix, each taken once, the closest first.
pub(super) fn matched(rows: &DMatrix<f64>, others: &DMatrix<f64>) -> Option<Vec<usize>> {
    let nearness =
        |other: usize, row: usize| 1.0 / (1.0 + (rows.row(row) - others.row(other)).norm_squared());
    let nearness = DMatrix::from_fn(others.nrows(), rows.nrows(), nearness);
    Some(pair_modes(&nearness).ok()?.analysis_mode)
}

/// The order of the columns of $T$ that agrees best with the test, as far as it is found, and its agreement.
///
/// Single exchanges start from the order given, and from that in which the flexibility of the points,
///
/// $$ \mathrm{diag}(V_F \Omega_F^{-2} V_F^t) \quad \text{and} \quad \mathrm{diag}(V_G \Omega_G^{-2} V_G^t), $$
///
/// has the same rank in model and test. The better of both is taken.
pub(super) fn flexibility_order(
    model: &DynamicModel,
    test: &ModeSet,
) -> Result<(Vec<usize>, f64), Error> {
    let agreement = |order: &[usize], least: f64| {
        let comparison = Comparison::new(&reordered(&model.stiffness, order), &model.mass)?;
        Ok(comparison.agreement_above(&test.shapes, least))
    };
    let count = model.mass.nrows();
    let given = exchange((0..count).collect(), agreement)?;
    let comparison = Comparison::new(&model.stiffness, &model.mass)?;
    let ranks = |modes: &ModeSet| {
        let term = |(shape, omega_squared): (&f64, &f64)| shape * shape / omega_squared;
        let flexibility = |point: usize| -> f64 {
            modes
                .shapes
                .row(point)
                .iter()
                .zip(&modes.omega_squared)
                .map(term)
                .sum()
        };
        let mut points: Vec<usize> = (0..count).collect();
        points.sort_by(|&a, &b| flexibility(a).total_cmp(&flexibility(b)));
        points
    };
    let (of_model, of_test) = (
        ranks(&comparison.analysis),
        ranks(&test.scaled_with(&model.mass)?),
    );
    let mut order = vec![0; count];
    of_test
        .iter()
        .zip(&of_model)
        .for_each(|(&test, &model)| order[test] = model);
    let ranked = exchange(order, agreement)?;
    Ok(if ranked.1 > given.1 { ranked } else { given })
}
