//! Numbers side by side: arithmetic on one number per parameter, which the compiler turns into vector instructions.
//!
//! Everything here is inlined into its caller, so that it is compiled for the caller's vector unit.

/// Parameters side by side.
pub(super) const LANES: usize = 8;

/// One number per parameter.
pub(super) type Lanes = [f64; LANES];

/// No change in any lane.
pub(super) const ZERO: Lanes = [0.0; LANES];

/// Rows of a product that are formed together: each vector is then read once for all of them.
const ROWS: usize = 3;

/// A number for every lane.
#[inline(always)]
pub(super) fn lanes(value: impl Fn(usize) -> f64) -> Lanes {
    let mut lanes = ZERO;
    for (lane, number) in lanes.iter_mut().enumerate() {
        *number = value(lane);
    }
    lanes
}

/// $c_r = \sum_i a_{ri} v_i$ for every row $r$ of a matrix of numbers, stored row by row, and vectors $v_i$ of lanes.
#[inline(always)]
pub(super) fn combinations_into(rows: &[f64], vectors: &[Lanes], combinations: &mut [Lanes]) {
    let count = vectors.len();
    let mut triples = combinations.chunks_exact_mut(ROWS);
    let mut rows_of_triples = rows.chunks_exact(ROWS * count);
    for (sums, rows) in triples.by_ref().zip(rows_of_triples.by_ref()) {
        let mut triple = [ZERO; ROWS];
        let (first, others) = rows.split_at(count);
        let (second, third) = others.split_at(count);
        for (((vector, a), b), c) in vectors.iter().zip(first).zip(second).zip(third) {
            for (sum, factor) in triple.iter_mut().zip([a, b, c]) {
                *sum = lanes(|l| sum[l] + factor * vector[l]);
            }
        }
        sums.copy_from_slice(&triple);
    }
    let rest = rows_of_triples.remainder().chunks_exact(count);
    for (sum, row) in triples.into_remainder().iter_mut().zip(rest) {
        *sum = ZERO;
        for (vector, a) in vectors.iter().zip(row) {
            *sum = lanes(|l| sum[l] + a * vector[l]);
        }
    }
}
