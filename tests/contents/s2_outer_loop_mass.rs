//! Correlation by mass, and by stiffness and mass together.

use crate::contents::s2_parameters_mass::{analyze, both, boxed, modes, point_masses};
use crate::prelude::*;

/// The correlation of a model by the paper's loops, whole.
fn correlated(
    model: &(WholeModel, SparseMatrix),
    test: &Modes,
    settings: &Settings,
) -> Correlation {
    let analyze = |factors: &[f64]| analyze(model, factors, test);
    correlate(analyze, &model.0.ranges(), settings, |_, _| true).unwrap()
}

#[test]
fn wrong_point_masses_are_found() {
    let (truth, _) = boxed(&point_masses(), 1e-12, [1.0; 9]);
    let wrong = [1.2, 0.85, 1.15, 0.8, 1.25, 0.9, 1.1, 0.85, 1.15];
    let model = boxed(&point_masses(), 1e-12, wrong);
    let mut settings = Settings {
        least_passes: 2,
        ..Settings::default()
    };
    settings.inner.tolerance = 0.002;
    settings.later_inner_tolerance = 0.002;
    let test = modes(&truth);
    let result = correlated(&model, &test, &settings);
    assert!(result.converged);
    let last = result.passes.last().unwrap();
    for (dof, (factor, wrong)) in last.factors.iter().zip(wrong).enumerate() {
        // The tip's front mass of 0.0001 is a hundredth of its neighbors and hardly felt: 10 %.
        let bar = if dof == 2 { 0.1 } else { 0.02 };
        assert_within(factor * wrong, 1.0, bar);
    }
}

#[test]
fn stiffness_and_mass_change_together() {
    let (model, test) = both();
    let result = correlated(&model, &test, &Settings::default());
    assert!(result.converged);
    // Stiffness and mass scaled alike leave every mode alone, so the factors themselves need not be the true ones.
    let last = result.passes.last().unwrap();
    assert!(last.factors[..15].iter().any(|f| (f - 1.0).abs() > 0.01));
    assert!(last.factors[15..].iter().any(|f| (f - 1.0).abs() > 0.01));
}
