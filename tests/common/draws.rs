//! Reproducible draws for tests that make more calls than a property would, and how often a strategy's draws reach something.

use crate::prelude::*;

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

/// The number of calls or damaged inputs that `CORFEM_CALLS` asks for.
pub fn asked_calls(otherwise: u64) -> u64 {
    let number = std::env::var("CORFEM_CALLS").ok();
    number.map_or(otherwise, |number| number.parse().unwrap())
}

/// Draws of a strategy that are looked at for how often they reach something.
const LOOKED_AT: usize = 200;

/// The part of a strategy's draws that reaches what a law is about, printed; a test demands how large it is.
pub fn reached<S: Strategy>(
    what: &str,
    strategy: &S,
    is_reached: impl Fn(S::Value) -> bool,
) -> f64 {
    let mut runner = TestRunner::new(super::config());
    let draw = |_| strategy.new_tree(&mut runner).unwrap().current();
    let count = (0..LOOKED_AT)
        .map(draw)
        .map(is_reached)
        .filter(|is| *is)
        .count();
    println!("{what}: in {count} of {LOOKED_AT} draws");
    count as f64 / LOOKED_AT as f64
}
