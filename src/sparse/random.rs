//! Reproducible random numbers.

use nalgebra::DMatrix;

/// Random start vectors with numbers on both sides of zero, not normalized (rows × columns).
pub(super) fn random_block(rows: usize, columns: usize, state: &mut u64) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| {
        split_mix_64(state).cast_signed() as f64
    })
}

/// The next number from zero up to one, by the 53 bits of [`split_mix_64`] that a number holds.
pub fn uniform(state: &mut u64) -> f64 {
    (split_mix_64(state) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The next number of the generator SplitMix64, from its state, which moves on: Steele, Lea and Flood, "Fast Splittable
/// Pseudorandom Number Generators", *OOPSLA* 2014, 453–472, with the constants of Vigna's public-domain `splitmix64.c`.
pub fn split_mix_64(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
