//! Which single change of test shapes or model makes them agree.

use super::comparison::{Comparison, paired_values, reordered};
use super::order::{best_order, flexibility_order};
use crate::method::error::Error;
use crate::method::model::DynamicModel;
use crate::method::modes::ModeSet;
use crate::method::pairing::pair_modes;
use nalgebra::DMatrix;
use serde::Serialize;

/// Least gain of the agreement that names a change. On good data, clean and noisy, no change gains at all; to exchange
/// the right two sensors gains 0.003 and more, least where they lie close together.
pub const LEAST_GAIN: f64 = 0.002;
/// Least part of the missing agreement that a change must restore. The right change mostly restores three quarters, since the
/// model's own errors remain; in a model with an element a hundred times too thin, the best wrong change restores 0.18.
pub const LEAST_SHARE: f64 = 0.3;
/// By how much columns of $T$ must agree better than sensors in the same order to be named first. The two differ by the
/// masses alone; where these are alike, noise decides between them.
pub const LEAST_DIFFERENCE: f64 = 0.005;
/// Cross-orthogonality below which a pair is doubtful, the customary bound.
pub const LOW_PAIR: f64 = 0.90;

/// One change of the test shapes or of the model; places count from zero.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// The sign of one sensor.
    Reversed(usize),
    /// Two sensors exchanged.
    Exchanged([usize; 2]),
    /// All points in another order: the places of the rows given, in the model's order.
    Reordered(Vec<usize>),
    /// Rows for columns.
    Transposed,
    /// Columns of $T$ in another order, while the masses keep theirs: the places of the columns given, in the test's
    /// order.
    Columns(Vec<usize>),
    /// A sensor whose readings are so many times too large.
    Gain(usize, f64),
    /// A sensor that reads nothing but noise.
    Dead(usize),
    /// A sensor that measures along another direction of its grid, 0 to 5.
    Direction(usize, usize),
}

/// What a change does to the agreement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mended {
    /// The change.
    pub change: Change,
    /// Agreement as given.
    pub before: f64,
    /// Agreement after the change.
    pub after: f64,
    /// The next best single change and its agreement.
    pub next: Option<(Change, f64)>,
}

/// The test shapes after a change.
pub(super) fn changed(shapes: &DMatrix<f64>, change: &Change) -> DMatrix<f64> {
    let mut changed = shapes.clone();
    match change {
        Change::Reversed(sensor) => changed.row_mut(*sensor).neg_mut(),
        Change::Exchanged([a, b]) => changed.swap_rows(*a, *b),
        Change::Reordered(order) => return shapes.select_rows(order),
        Change::Transposed => return shapes.transpose(),
        Change::Gain(sensor, gain) => changed.row_mut(*sensor).unscale_mut(*gain),
        Change::Columns(_) | Change::Dead(_) | Change::Direction(..) => {}
    }
    changed
}

/// Whether a change from one agreement to another is enough to be named.
fn is_enough(before: f64, after: f64) -> bool {
    after - before >= LEAST_GAIN && after - before >= LEAST_SHARE * (1.0 - before)
}

/// The change that mends the agreement most, if one mends it enough.
///
/// All reversals, exchanges of sensors, and the transposition are tried. Where they leave a pair below [`LOW_PAIR`], so
/// is another order of the points, and where that leaves one, another order of the columns of $T$, for which the model
/// is solved anew. An order of the points is always compared with the same order of the columns: they differ by the
/// masses alone.
pub(super) fn mend(
    model: &DynamicModel,
    comparison: &Comparison,
    test: &ModeSet,
) -> Result<Option<Mended>, Error> {
    let shapes = &test.shapes;
    let (points, modes) = shapes.shape();
    let Some(before) = comparison.agreement_above(shapes, 0.0) else {
        return Ok(None);
    };
    let mut best: Vec<(Change, f64)> = Vec::new();
    let reversals = (0..points).map(Change::Reversed);
    let exchanges = (0..points).flat_map(|b| (0..b).map(move |a| Change::Exchanged([a, b])));
    let transposition = (points == modes).then_some(Change::Transposed);
    for change in reversals.chain(exchanges).chain(transposition) {
        let least = best.get(1).map_or(0.0, |second| second.1);
        if let Some(agreement) = comparison.agreement_above(&changed(shapes, &change), least) {
            add(&mut best, change, agreement);
        }
    }
    let enough = best
        .first()
        .filter(|single| is_enough(before, single.1))
        .cloned();
    let (mut chosen, mut after) =
        enough.map_or((None, before), |(change, after)| (Some(change), after));
    if is_low(comparison, shapes, chosen.as_ref()) {
        let (order, agreement) = best_order(comparison, test);
        if is_enough(after, agreement) {
            add(&mut best, Change::Reordered(order.clone()), agreement);
            (chosen, after) = (Some(Change::Reordered(order)), agreement);
        }
    }
    let as_columns = if is_low(comparison, shapes, chosen.as_ref()) {
        Some(flexibility_order(model, test)?)
    } else if let Some(order) = chosen.as_ref().and_then(|change| order_of(change, points)) {
        let comparison = Comparison::new(&reordered(&model.stiffness, &order), &model.mass)?;
        comparison
            .agreement_above(shapes, 0.0)
            .map(|agreement| (order, agreement))
    } else {
        None
    };
    if let Some((order, agreement)) = as_columns.filter(|found| is_enough(before, found.1)) {
        let change = Change::Columns(order);
        best.insert(0, (change.clone(), agreement));
        if agreement - after >= LEAST_DIFFERENCE {
            (chosen, after) = (Some(change), agreement);
        }
    }
    let Some(change) = chosen else {
        return Ok(None);
    };
    let next = best.into_iter().find(|(other, _)| *other != change);
    Ok(Some(Mended {
        change,
        before,
        after,
        next,
    }))
}

/// Adds a change and its agreement to the two best so far, of which the better stands first.
fn add(best: &mut Vec<(Change, f64)>, change: Change, agreement: f64) {
    best.push((change, agreement));
    best.sort_by(|a, b| b.1.total_cmp(&a.1));
    best.truncate(2);
}

/// Whether a pair is below [`LOW_PAIR`] after a change of the shapes.
fn is_low(comparison: &Comparison, shapes: &DMatrix<f64>, change: Option<&Change>) -> bool {
    let shapes = change.map_or_else(|| shapes.clone(), |change| changed(shapes, change));
    let low = |cross: DMatrix<f64>| {
        pair_modes(&cross).is_ok_and(|pairing| {
            paired_values(&cross, &pairing)
                .iter()
                .any(|value| *value < LOW_PAIR)
        })
    };
    comparison.cross(&shapes).is_some_and(low)
}

/// The order of the points that a change makes, if it makes one.
fn order_of(change: &Change, points: usize) -> Option<Vec<usize>> {
    match change {
        Change::Exchanged([a, b]) => {
            let mut order: Vec<usize> = (0..points).collect();
            order.swap(*a, *b);
            Some(order)
        }
        Change::Reordered(order) => Some(inverse(order)),
        _ => None,
    }
}

/// The order that undoes another.
fn inverse(order: &[usize]) -> Vec<usize> {
    let mut inverse = vec![0; order.len()];
    order
        .iter()
        .enumerate()
        .for_each(|(place, &of)| inverse[of] = place);
    inverse
}
