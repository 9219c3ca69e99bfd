//! (10), frequencies from roots, as printed.

use crate::common::boxes::first_problem;
use crate::common::tolerances::EIGEN_ROUND_OFF;
use approx::assert_relative_eq;
use corfem::method::analysis::Analysis;
use std::f64::consts::PI;

#[test]
fn root_is_the_reciprocal_of_the_squared_circular_frequency() {
    // (10), f = (λ + Δλ)^(−1/2)/2π, agrees with (Kλ − M)v = 0; the line that calls λ = ω² does not.
    let problem = first_problem(1);
    let lambda = problem.exact().modes.omega_squared().map(f64::recip);
    for (root, frequency) in lambda.iter().zip(problem.exact().modes.frequencies_hz()) {
        assert_relative_eq!(
            root.powf(-0.5) / (2.0 * PI),
            frequency,
            max_relative = EIGEN_ROUND_OFF
        );
        let as_printed = (2.0 * PI * frequency).powi(2);
        assert!((as_printed.powf(-0.5) / (2.0 * PI) / frequency - 1.0).abs() > 0.9);
    }
}
