//! What rounding is to a computation in double precision, in one of any size.

use super::elements::number;
use crate::common::double_double::Dd;

/// Numbers between plus and minus a size, the same for the same seed.
pub struct Noise {
    size: Dd,
    state: u64,
}

impl Noise {
    pub fn none() -> Self {
        Self {
            size: Dd::ZERO,
            state: 1,
        }
    }

    pub fn of(size: f64, seed: u64) -> Self {
        Self {
            size: number(size),
            state: seed,
        }
    }

    /// Knuth's linear congruential generator; its upper half is good enough for a noise.
    pub fn next(&mut self) -> Dd {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.size * number((self.state >> 32) as f64 / (1_u64 << 31) as f64 - 1.0)
    }
}
