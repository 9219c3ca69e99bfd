//! Numbers of 106 bits as the unevaluated sum of two of 53, for chains of computation beside the crate's own.
//!
//! Sums and products by the error-free transformations of Knuth and Dekker. Source: Hida, Li and Bailey, *Algorithms for
//! Quad-Double Precision Floating Point Arithmetic*, 15th IEEE Symposium on Computer Arithmetic (2001), 155.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// $\text{high} + \text{low}$, $\lvert\text{low}\rvert$ at most half a unit in the last place of high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dd {
    pub high: f64,
    pub low: f64,
}

/// $2^{-104}$: what one operation may lose, relative to its result.
pub const DD_EPSILON: f64 = 4.930_380_657_631_324e-32;

/// The sum of two numbers and what its rounding lost.
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The same for numbers of which the first is the larger.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let high = a + b;
    Dd {
        high,
        low: b - (high - a),
    }
}

/// The two halves of a number, of 26 bits each.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

/// The product of two numbers and what its rounding lost. A fused multiplication has the same, but is a call where the processor
/// is not known to have one.
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    (
        product,
        ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low,
    )
}

impl Dd {
    pub const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };
    pub const ONE: Self = Self {
        high: 1.0,
        low: 0.0,
    };

    pub fn to_f64(self) -> f64 {
        self.high + self.low
    }

    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    pub fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        // Newton's step doubles the digits of a root in double precision; the second makes sure of the last bits.
        (0..2).fold(Self::from(self.high.sqrt()), |root, _| {
            root + (self - root * root) / (root + root)
        })
    }

    pub fn recip(self) -> Self {
        Self::ONE / self
    }

    pub fn larger(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    pub fn smaller(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

impl From<f64> for Dd {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, mut low) = two_sum(self.high, other.high);
        let (lost_high, lost_low) = two_sum(self.low, other.low);
        low += lost_high;
        let sum = quick_two_sum(high, low);
        quick_two_sum(sum.high, sum.low + lost_low)
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        quick_two_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Dd {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        quick_two_sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl AddAssign for Dd {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dd {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl PartialOrd for Dd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let (high, low) = (
            self.high.partial_cmp(&other.high)?,
            self.low.partial_cmp(&other.low)?,
        );
        Some(high.then(low))
    }
}

impl std::iter::Sum for Dd {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |sum, term| sum + term)
    }
}
