//! Reproducible draws for tests that make more calls than a property would.

use corfem::sparse::random::split_mix_64;

/// A stream of draws from a seed.
pub struct Draws(pub u64);

impl Draws {
    /// A number below `count`; zero if that is none.
    pub fn below(&mut self, count: usize) -> usize {
        (split_mix_64(&mut self.0) % count.max(1) as u64) as usize
    }

    /// A number from zero up to one.
    pub fn unit(&mut self) -> f64 {
        (split_mix_64(&mut self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from `low` up to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}
