//! Strategies of mode sets that are the same but for order and sign, and of cross-orthogonality matrices.

use crate::prelude::*;

/// A rearrangement of modes: position j holds mode `order[j]` times `sign[j]`.
#[derive(Debug, Clone)]
pub struct Rearrangement {
    /// Which mode stands in each place.
    pub order: Vec<usize>,
    /// +1 or −1 for each place.
    pub sign: Vec<f64>,
}

impl Rearrangement {}

/// Any order of `count` modes with any signs; shrinks towards no change.
pub fn rearrangement(count: usize) -> impl Strategy<Value = Rearrangement> {
    (
        Just((0..count).collect_vec()).prop_shuffle(),
        prop::collection::vec(prop::bool::ANY, count),
    )
        .prop_map(|(order, flips)| Rearrangement {
            order,
            sign: flips
                .into_iter()
                .map(|flip| if flip { -1.0 } else { 1.0 })
                .collect(),
        })
}

/// Numbers of analysis modes (1 to 7) and of test modes (1 to as many).
pub fn counts() -> impl Strategy<Value = (usize, usize)> {
    (1..=7_usize).prop_flat_map(|analysis| (Just(analysis), 1..=analysis))
}

/// A cross-orthogonality matrix of any numbers between −1.2 and 1.2: measured shapes are not quite orthogonal, so
/// that entries beyond one occur.
pub fn cross() -> impl Strategy<Value = DMatrix<f64>> {
    counts().prop_flat_map(|(analysis, test)| {
        prop::collection::vec(-1.2..1.2_f64, analysis * test)
            .prop_map(move |entries| DMatrix::from_vec(analysis, test, entries))
    })
}

/// The same with only nine different values, so that most pairs tie with others.
pub fn cross_with_ties() -> impl Strategy<Value = DMatrix<f64>> {
    counts().prop_flat_map(|(analysis, test)| {
        prop::collection::vec(-4..=4_i32, analysis * test).prop_map(move |entries| {
            DMatrix::from_iterator(
                analysis,
                test,
                entries.into_iter().map(|entry| f64::from(entry) / 3.0),
            )
        })
    })
}

/// Test modes that are analysis modes in another order and sign, with noise: entries of a pair between 0.65 and
/// 1.35, all others below 0.35, so that every pair is nearer to one than any other entry.
pub fn noisy_pairs() -> impl Strategy<Value = (DMatrix<f64>, Rearrangement)> {
    counts().prop_flat_map(|(analysis, test)| {
        (
            rearrangement(analysis),
            prop::collection::vec(-0.35..0.35_f64, analysis * test),
        )
            .prop_map(move |(mut pairs, noise)| {
                pairs.order.truncate(test);
                pairs.sign.truncate(test);
                let mut cross = DMatrix::from_vec(analysis, test, noise);
                for j in 0..test {
                    cross[(pairs.order[j], j)] += pairs.sign[j];
                }
                (cross, pairs)
            })
    })
}

/// The slow, obvious pairing: all pairs in the order of their claims, each made unless one of its modes is taken.
pub fn pairs_by_sorting(cross: &DMatrix<f64>) -> Vec<usize> {
    let mut claims = (0..cross.ncols())
        .flat_map(|j| (0..cross.nrows()).map(move |i| (j, i)))
        .map(|(j, i)| ((cross[(i, j)].abs() - 1.0).abs(), j, i))
        .collect_vec();
    claims.sort_by(|a, b| a.partial_cmp(b).unwrap());
    let mut pairs = vec![None; cross.ncols()];
    for (_, j, i) in claims {
        if pairs[j].is_none() && !pairs.contains(&Some(i)) {
            pairs[j] = Some(i);
        }
    }
    pairs.into_iter().map(Option::unwrap).collect()
}
