//! Power series with rational coefficients, cut off and otherwise exact, and the roots and shapes of a changed pencil as such.
//!
//! A series of one term is a rational number: what is written for series serves numbers too.

use num_rational::BigRational;
use std::ops::{Add, Div, Mul, Sub};

/// $\sum_m a_m t^m$ up to a number of terms that is the same for all that meet in an expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Series(pub Vec<BigRational>);

/// Rows of series.
pub type Matrix = Vec<Vec<Series>>;

/// Roots $\gamma_j$ and generalized shapes, mode $j$ in column $j$ with $p_{jj} = 1$.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    pub roots: Vec<Series>,
    pub shapes: Matrix,
}

/// A pencil of integers: $k + tB$ and, for $\lambda = 1/k$, $I + tA$.
#[derive(Debug, Clone)]
pub struct IntegerPencil {
    pub k: Vec<i64>,
    pub b: Vec<Vec<i64>>,
    pub a: Vec<Vec<i64>>,
}

pub fn rational(value: i64) -> BigRational {
    BigRational::from_integer(value.into())
}

impl Series {
    pub fn constant(value: BigRational, terms: usize) -> Self {
        Self(
            std::iter::once(value)
                .chain(std::iter::repeat(rational(0)))
                .take(terms)
                .collect(),
        )
    }

    pub fn integer(value: i64, terms: usize) -> Self {
        Self::constant(rational(value), terms)
    }

    /// $v t$.
    pub fn linear(value: i64, terms: usize) -> Self {
        Self(
            [0, value]
                .map(rational)
                .into_iter()
                .chain(std::iter::repeat(rational(0)))
                .take(terms)
                .collect(),
        )
    }

    pub fn sum(mut terms: impl Iterator<Item = Self>) -> Self {
        let first = terms.next().expect("at least one");
        terms.fold(first, |sum, term| sum + term)
    }

    /// How many of the first coefficients agree with another's.
    pub fn agreement(&self, other: &Self) -> usize {
        self.0
            .iter()
            .zip(&other.0)
            .take_while(|(a, b)| a == b)
            .count()
    }

    /// The sum at a number, by Horner's rule.
    pub fn at(&self, t: &BigRational) -> BigRational {
        self.0
            .iter()
            .rev()
            .fold(rational(0), |sum, coefficient| sum * t + coefficient)
    }
}

impl Add for Series {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(
            self.0
                .into_iter()
                .zip(other.0)
                .map(|(a, b)| a + b)
                .collect(),
        )
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(
            self.0
                .into_iter()
                .zip(other.0)
                .map(|(a, b)| a - b)
                .collect(),
        )
    }
}

impl Mul for &Series {
    type Output = Series;
    fn mul(self, other: Self) -> Series {
        let coefficient = |m: usize| {
            (0..=m)
                .map(|l| &self.0[l] * &other.0[m - l])
                .fold(rational(0), |a, b| a + b)
        };
        Series((0..self.0.len()).map(coefficient).collect())
    }
}

impl Div for &Series {
    type Output = Series;
    /// Panics where the divisor has no constant term.
    fn div(self, other: Self) -> Series {
        let mut quotient: Vec<BigRational> = Vec::new();
        for m in 0..self.0.len() {
            let known = (0..m)
                .map(|l| &quotient[l] * &other.0[m - l])
                .fold(rational(0), |a, b| a + b);
            quotient.push((&self.0[m] - known) / &other.0[0]);
        }
        Series(quotient)
    }
}

impl Found {
    /// How many coefficients agree with another's in every root, and in every shape.
    pub fn agreement(&self, other: &Self) -> (usize, usize) {
        let least = |ours: &[Series], theirs: &[Series]| {
            ours.iter()
                .zip(theirs)
                .map(|(a, b)| a.agreement(b))
                .min()
                .expect("at least one")
        };
        (
            least(&self.roots, &other.roots),
            least(&self.shapes.concat(), &other.shapes.concat()),
        )
    }
}

impl IntegerPencil {
    /// The same without a change of mass.
    pub fn of_stiffness(&self) -> Self {
        Self {
            a: vec![vec![0; self.k.len()]; self.k.len()],
            ..self.clone()
        }
    }

    /// Roots and shapes by Rayleigh and Schrödinger's recursion for $w = 1/\gamma$ in $(k + tB)p = w(I + tA)p$, $p_{jj} = 1$.
    ///
    /// The terms of $t^m$ in row $i$ give $(k_i - k_j) p_i^{(m)}$, and in row $j$ itself $w^{(m)}$, from those of lower powers:
    /// an expansion in the eigenvalue, with no formula of Appendix C in it.
    pub fn exact(&self, terms: usize) -> Found {
        let size = self.k.len();
        let modes: Vec<(Series, Vec<Series>)> =
            (0..size).map(|j| self.exact_mode(j, terms)).collect();
        let shapes = (0..size)
            .map(|i| modes.iter().map(|(_, shape)| shape[i].clone()).collect())
            .collect();
        let one = Series::integer(1, terms);
        Found {
            roots: modes.iter().map(|(w, _)| &one / w).collect(),
            shapes,
        }
    }

    fn exact_mode(&self, j: usize, terms: usize) -> (Series, Vec<Series>) {
        let size = self.k.len();
        let mut w = Series::integer(self.k[j], terms);
        let mut p: Vec<Series> = (0..size)
            .map(|i| Series::integer((i == j).into(), terms))
            .collect();
        let row = |matrix: &[Vec<i64>], i: usize, p: &[Series], m: usize| {
            (0..size)
                .map(|s| rational(matrix[i][s]) * &p[s].0[m])
                .fold(rational(0), |a, b| a + b)
        };
        for m in 1..terms {
            // Everything of t^m in row i but (k_i − k_j) p_i and the new term of w.
            let known = |i: usize, w: &Series, p: &[Series]| {
                let of_mass = (0..m)
                    .map(|l| &w.0[l] * row(&self.a, i, p, m - 1 - l))
                    .fold(rational(0), |a, b| a + b);
                let earlier = (1..m)
                    .map(|l| &w.0[l] * &p[i].0[m - l])
                    .fold(rational(0), |a, b| a + b);
                row(&self.b, i, p, m - 1) - of_mass - earlier
            };
            w.0[m] = known(j, &w, &p);
            let next: Vec<BigRational> = (0..size)
                .filter(|&i| i != j)
                .map(|i| -known(i, &w, &p) / rational(self.k[i] - self.k[j]))
                .collect();
            for (i, value) in (0..size).filter(|&i| i != j).zip(next) {
                p[i].0[m] = value;
            }
        }
        (w, p)
    }

    /// $(k + tB)\gamma p - (I + tA)p$ of every mode (n × n): zero for exact ones.
    pub fn residual(&self, found: &Found) -> Matrix {
        let (size, terms) = (self.k.len(), found.roots[0].0.len());
        let entry = |i: usize, j: usize| {
            Series::sum((0..size).map(|s| {
                let (k, one) = if i == s { (self.k[i], 1) } else { (0, 0) };
                let stiffness = Series::integer(k, terms) + Series::linear(self.b[i][s], terms);
                let mass = Series::integer(one, terms) + Series::linear(self.a[i][s], terms);
                &(&stiffness * &found.roots[j] - mass) * &found.shapes[s][j]
            }))
        };
        (0..size)
            .map(|i| (0..size).map(|j| entry(i, j)).collect())
            .collect()
    }
}
