//! Gauss-Legendre quadrature: exactness, and the same rule from the eigenvalues of a tridiagonal matrix.

use crate::prelude::*;
use corfem::method::elements::GAUSS_LEGENDRE;

/// Points of the rule.
const COUNT: usize = 20;

/// The rule from −1 to 1, of which the panel has the positive half.
fn rule() -> Vec<(f64, f64)> {
    let negative = GAUSS_LEGENDRE.iter().rev().map(|&(s, weight)| (-s, weight));
    negative.chain(GAUSS_LEGENDRE).collect()
}

/// Integral of s^degree from −1 to 1.
fn monomial(degree: usize) -> f64 {
    if degree.is_multiple_of(2) {
        2.0 / (degree + 1) as f64
    } else {
        0.0
    }
}

fn integrate(function: impl Fn(f64) -> f64) -> f64 {
    rule().iter().map(|&(s, weight)| weight * function(s)).sum()
}

#[test]
fn rule_is_exact_to_degree_2n_minus_1_and_no_further() {
    for degree in 0..2 * COUNT {
        let error = integrate(|s| s.powi(degree as i32)) - monomial(degree);
        assert!(error.abs() <= ROUND_OFF, "degree {degree}: {error:e}");
    }
    // The first error is known: 2^(2n+1) n!^4 / ((2n+1) (2n)!^2) for the monomial of degree 2n.
    let known = (1..=COUNT).fold(2.0 / (2 * COUNT + 1) as f64, |product, k| {
        let k = k as f64;
        product * (2.0 * k * k / (2.0 * k * (2.0 * k - 1.0))).powi(2)
    });
    let error = monomial(2 * COUNT) - integrate(|s| s.powi(2 * COUNT as i32));
    assert_within(error, known, ROUND_OFF);
}

/// Golub and Welsch: points are the eigenvalues of the Jacobi matrix with k/√(4k²−1) beside its diagonal, weights
/// twice the squared first components of its eigenvectors.
#[test]
fn rule_equals_golub_and_welsch() {
    let mut jacobi = zero_square(COUNT);
    for k in 1..COUNT {
        let beside = k as f64 / ((4 * k * k - 1) as f64).sqrt();
        jacobi[(k - 1, k)] = beside;
        jacobi[(k, k - 1)] = beside;
    }
    let eigen = jacobi.symmetric_eigen();
    let weight = |k| 2.0 * eigen.eigenvectors[(0, k)].powi(2);
    let expected = (0..COUNT).map(|k| (eigen.eigenvalues[k], weight(k)));
    let mut expected = expected.collect_vec();
    expected.sort_by(|a, b| a.0.total_cmp(&b.0));
    for ((point, weight), (s, w)) in rule().into_iter().zip(expected) {
        assert_within(point, s, ROUND_OFF);
        assert_within(weight, w, ROUND_OFF);
    }
}
