//! Gauss-Legendre quadrature: exactness, and the same rule from the eigenvalues of a tridiagonal matrix.

use crate::common::tolerances::ROUND_OFF;
use corfem::method::elements::shear::gauss_legendre;
use nalgebra::DMatrix;
use proptest::prelude::*;

/// Rules up to this many points are tested; the panel uses twelve.
const MOST_POINTS: usize = 24;

/// Integral of s^degree from −1 to 1.
fn monomial(degree: usize) -> f64 {
    if degree.is_multiple_of(2) {
        2.0 / (degree + 1) as f64
    } else {
        0.0
    }
}

fn integrate(rule: &[(f64, f64)], function: impl Fn(f64) -> f64) -> f64 {
    rule.iter().map(|&(s, weight)| weight * function(s)).sum()
}

#[test]
fn rules_are_exact_to_degree_2n_minus_1_and_no_further() {
    for count in 1..=MOST_POINTS {
        let rule = gauss_legendre(count);
        assert_eq!(rule.len(), count);
        for degree in 0..2 * count {
            let error = integrate(&rule, |s| s.powi(degree as i32)) - monomial(degree);
            assert!(
                error.abs() <= ROUND_OFF,
                "{count} points, degree {degree}: {error:e}"
            );
        }
        // The first error is known: 2^(2n+1) n!^4 / ((2n+1) (2n)!^2) for the monomial of degree 2n.
        let known = (1..=count).fold(2.0 / (2 * count + 1) as f64, |product, k| {
            let k = k as f64;
            product * (2.0 * k * k / (2.0 * k * (2.0 * k - 1.0))).powi(2)
        });
        let error = monomial(2 * count) - integrate(&rule, |s| s.powi(2 * count as i32));
        assert!(
            (error - known).abs() <= ROUND_OFF,
            "{count} points: {error:e}, not {known:e}"
        );
    }
}

/// Golub and Welsch: points are the eigenvalues of the Jacobi matrix with k/√(4k²−1) beside its diagonal, weights
/// twice the squared first components of its eigenvectors.
#[test]
fn rules_equal_golub_and_welsch() {
    for count in 1..=MOST_POINTS {
        let mut jacobi = DMatrix::<f64>::zeros(count, count);
        for k in 1..count {
            let beside = k as f64 / ((4 * k * k - 1) as f64).sqrt();
            jacobi[(k - 1, k)] = beside;
            jacobi[(k, k - 1)] = beside;
        }
        let eigen = jacobi.symmetric_eigen();
        let mut expected: Vec<(f64, f64)> = (0..count)
            .map(|k| {
                (
                    eigen.eigenvalues[k],
                    2.0 * eigen.eigenvectors[(0, k)].powi(2),
                )
            })
            .collect();
        expected.sort_by(|a, b| a.0.total_cmp(&b.0));
        for ((point, weight), (s, w)) in gauss_legendre(count).into_iter().zip(expected) {
            assert!(
                (point - s).abs() <= ROUND_OFF,
                "{count} points: {point} {s}"
            );
            assert!(
                (weight - w).abs() <= ROUND_OFF,
                "{count} points: {weight} {w}"
            );
        }
    }
}

#[test]
fn a_rule_without_points_is_empty() {
    assert!(gauss_legendre(0).is_empty());
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn points_ascend_inside_the_interval_with_positive_weights(count in 1..=MOST_POINTS) {
        let rule = gauss_legendre(count);
        prop_assert!(rule.windows(2).all(|pair| pair[0].0 < pair[1].0));
        prop_assert!(rule.iter().all(|&(s, weight)| s.abs() < 1.0 && weight > 0.0));
        for (&(s, weight), &(mirrored, equal)) in rule.iter().zip(rule.iter().rev()) {
            prop_assert!((s + mirrored).abs() <= ROUND_OFF);
            prop_assert!((weight - equal).abs() <= ROUND_OFF);
        }
    }
}
