//! How many eigenvalues of a pencil lie below a number, in integers: nothing is rounded, and nothing can be missed.
//!
//! By Sylvester's law of inertia $A - bM$ has as many negative eigenvalues as the pencil has below $b$, and as many as the signs of
//! its leading minors change. Bareiss's elimination finds those minors without a fraction.

use num_bigint::{BigInt, Sign};
use std::mem::swap;

/// Numbers are held as integers in units of $2^{-256}$; products of two numbers of double precision above $10^{-45}$ are exact so.
const UNIT: u64 = 256;
/// Bits after the point of a flexibility, which is cut off there: its eigenvalues are above $2^{-30}$, so that a count can only be
/// wrong where a root is nearer to the number asked about than $2^{-380}$ of itself.
const FLEXIBILITY: u64 = 420;

/// The integer $x 2^{u}$; fails unless it is one.
pub fn scaled(x: f64, unit: u64) -> BigInt {
    if x == 0.0 {
        return BigInt::from(0);
    }
    let bits = x.abs().to_bits();
    let (exponent, fraction) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
    let mantissa = if exponent == 0 {
        fraction
    } else {
        fraction | 1 << 52
    };
    let shift = exponent.max(1) - 1075 + unit as i64;
    assert!(
        shift >= 0 || mantissa.trailing_zeros() as i64 >= -shift,
        "{x} is no multiple of the unit"
    );
    let magnitude = if shift >= 0 {
        BigInt::from(mantissa) << shift
    } else {
        BigInt::from(mantissa >> -shift)
    };
    if x < 0.0 { -magnitude } else { magnitude }
}

/// The product of two numbers in the unit, exactly.
pub fn product(x: f64, y: f64) -> BigInt {
    scaled(x, UNIT / 2) * scaled(y, UNIT / 2)
}

/// Rows of the lower triangle of a symmetric matrix.
pub type Lower = Vec<Vec<BigInt>>;

/// Eliminates the first rows of a symmetric matrix by Bareiss's rule, and returns their minors; what is left are minors of one row
/// and column more.
pub fn eliminate(matrix: &mut Lower, count: usize) -> Vec<BigInt> {
    let mut minors: Vec<BigInt> = Vec::new();
    let mut before = BigInt::from(1);
    for pivot in 0..count {
        let mut minor = matrix[pivot][pivot].clone();
        assert!(minor.sign() != Sign::NoSign, "a minor is zero");
        let column: Vec<BigInt> = matrix
            .iter()
            .skip(pivot)
            .map(|row| row[pivot].clone())
            .collect();
        for i in pivot + 1..matrix.len() {
            for j in pivot + 1..=i {
                matrix[i][j] =
                    (&matrix[i][j] * &minor - &column[i - pivot] * &column[j - pivot]) / &before;
            }
        }
        minors.push(minor.clone());
        swap(&mut before, &mut minor);
    }
    minors
}

/// Negative eigenvalues of a symmetric matrix: changes of sign in its leading minors, of which the empty one is positive.
pub fn negative_eigenvalues(mut matrix: Lower) -> usize {
    let size = matrix.len();
    let minors = eliminate(&mut matrix, size);
    let is_negative = |minor: &BigInt| minor.sign() == Sign::Minus;
    let before = std::iter::once(false).chain(minors.iter().map(is_negative));
    before
        .zip(minors.iter().map(is_negative))
        .filter(|(before, now)| before != now)
        .count()
}

/// A pencil of dynamic stiffness and diagonal mass, known by its flexibility $T^t K_S^{-1} T$ in units of $2^{-420}$.
pub struct Flexible {
    flexibility: Lower,
    mass: Vec<f64>,
}

impl Flexible {
    /// From the structural stiffness in the unit (lower triangle), the load distribution (rows) and the masses.
    pub fn new(stiffness: Lower, loads: &[Vec<f64>], mass: &[f64]) -> Self {
        let (size, count) = (stiffness.len(), mass.len());
        let mut bordered = stiffness;
        for column in 0..count {
            let row = loads
                .iter()
                .map(|row| scaled(row[column], UNIT))
                .chain((0..count).map(|_| BigInt::from(0)));
            bordered.push(row.take(size + column + 1).collect());
        }
        let minors = eliminate(&mut bordered, size);
        let determinant = minors.last().expect("at least one");
        // Bordered minors are −det(K) TᵗK⁻¹T, in the unit.
        let entry = |minor: &BigInt| (-minor << (FLEXIBILITY - UNIT)) / determinant;
        let flexibility = bordered[size..]
            .iter()
            .map(|row| row[size..].iter().map(entry).collect())
            .collect();
        Self {
            flexibility,
            mass: mass.to_vec(),
        }
    }

    /// How many $\omega^2$ are below a number: negative eigenvalues of $M - \omega^2 M F M$, which by the inertia of the pencil
    /// bordered with $T$ are those of $K_D - \omega^2 M$.
    pub fn below(&self, omega_squared: f64) -> usize {
        let mass: Vec<BigInt> = self.mass.iter().map(|&mass| scaled(mass, UNIT)).collect();
        let number = scaled(omega_squared, UNIT);
        let entry = |i: usize, j: usize| {
            let own = if i == j {
                &mass[i] << (2 * UNIT + FLEXIBILITY)
            } else {
                BigInt::from(0)
            };
            own - &number * &mass[i] * &mass[j] * &self.flexibility[i][j]
        };
        negative_eigenvalues(
            (0..mass.len())
                .map(|i| (0..=i).map(|j| entry(i, j)).collect())
                .collect(),
        )
    }

    /// The flexibility as numbers, with a rest each: two of double precision.
    pub fn entry(&self, i: usize, j: usize) -> (f64, f64) {
        let exact = &self.flexibility[i.max(j)][i.min(j)];
        let high = nearest(exact, FLEXIBILITY);
        (
            high,
            nearest(&(exact - scaled(high, FLEXIBILITY)), FLEXIBILITY),
        )
    }
}

/// A number of double precision within a unit of its last place of an integer times $2^{-u}$.
pub fn nearest(integer: &BigInt, unit: u64) -> f64 {
    let spare = integer.bits().saturating_sub(53);
    let (sign, digits) = (integer >> spare).to_u64_digits();
    let magnitude = digits.first().map_or(0.0, |&digits| digits as f64);
    let value = magnitude * 2f64.powi(spare as i32 - unit as i32);
    if sign == Sign::Minus { -value } else { value }
}
