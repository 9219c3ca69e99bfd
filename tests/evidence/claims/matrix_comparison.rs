//! Why elements and not matrices: the comparison's numbers by other routes, and what they show.

use crate::evidence::matrix_comparison::{
    COVER_DOUBLER, MatrixComparison, Prediction, USUAL_TEST_MODES, compare_matrices,
};
use crate::evidence::matrix_correction::baruch_stiffness;
use crate::prelude::*;

pub const TEST_MODES: usize = USUAL_TEST_MODES;

pub fn compared(case: usize) -> MatrixComparison {
    compare_matrices(&case_of(case), TEST_MODES).unwrap()
}

pub fn model(case: usize, gages: &[f64]) -> DynamicModel {
    let case = case_of(case);
    case.model_with(gages)
        .unwrap()
        .matrices(&[1.0; 15])
        .unwrap()
}

pub fn by_name<'a>(comparison: &'a MatrixComparison, name: &str) -> &'a Prediction {
    comparison
        .predictions
        .iter()
        .find(|p| p.model == name)
        .unwrap()
}

fn largest(errors: &[f64]) -> f64 {
    errors
        .iter()
        .fold(0.0, |worst, error| error.abs().max(worst))
}

/// Gages that factors on the first ones give, with doublers on the covers or without.
pub fn gages(case: usize, factors: &[f64], doublers: bool) -> Vec<f64> {
    let first = case_of(case).first_gages();
    let mut gages = first
        .iter()
        .zip(factors)
        .map(|(gage, factor)| gage * factor)
        .collect_vec();
    if doublers {
        for cover in COVERS {
            gages[cover - 1] += COVER_DOUBLER;
        }
    }
    gages
}

#[test]
fn element_factors_are_analyzed_anew_and_matrices_are_added_to() {
    for case in 1..=3 {
        let comparison = compared(case);
        let found = comparison
            .factors
            .iter()
            .map(|factor| factor.found)
            .collect_vec();
        let first = model(case, &gages(case, &[1.0; 15], false));
        let design_change =
            model(case, &gages(case, &[1.0; 15], true)).stiffness - &first.stiffness;
        let test = case_of(case)
            .test_modes()
            .unwrap()
            .lowest(TEST_MODES)
            .unwrap();
        let baruch = baruch_stiffness(&first.stiffness, &first.mass, &test);
        let elements =
            [false, true].map(|doublers| model(case, &gages(case, &found, doublers)).stiffness);
        let matrices = [baruch.clone(), &baruch + design_change];
        for (name, stiffnesses) in [("Element factors", elements), ("Baruch", matrices)] {
            let prediction = by_name(&comparison, name);
            let states = [
                (&comparison.as_tested_hz, &prediction.as_tested),
                (&comparison.after_change_hz, &prediction.after_change),
            ];
            for (stiffness, (truth, errors)) in stiffnesses.iter().zip(states) {
                // Modes keep their order here, so that pairing them is no more than counting.
                let modes = solve(stiffness, &first.mass, 9).unwrap().frequencies_hz();
                for mode in 0..9 {
                    let expected = modes[mode] / truth[mode] - 1.0;
                    assert_within(errors[mode], expected, EIGEN_ROUND_OFF);
                }
            }
            for (i, row) in prediction.stiffness_change.iter().enumerate() {
                for (j, entry) in row.iter().enumerate() {
                    let change = stiffnesses[0][(i, j)] - first.stiffness[(i, j)];
                    let scale = (first.stiffness[(i, i)] * first.stiffness[(j, j)]).sqrt();
                    assert_within(entry, change / scale, CORRECTION_ROUND_OFF);
                }
            }
            assert_eq!(largest(&prediction.mass_change.concat()), 0.0);
        }
    }
}

#[test]
fn matrix_corrections_have_the_test_modes_and_leave_the_others() {
    for case in 1..=3 {
        let comparison = compared(case);
        let initial = by_name(&comparison, "Initial");
        for name in ["Baruch", "Berman and Nagy"] {
            let corrected = by_name(&comparison, name);
            let (fitted, others) = corrected.as_tested.split_at(TEST_MODES);
            assert!(largest(fitted) <= CORRECTION_ROUND_OFF, "{name}");
            for (found, before) in others.iter().zip(&initial.as_tested[TEST_MODES..]) {
                assert_within(found, before, UNMEASURED_MODE);
            }
        }
        let elements = by_name(&comparison, "Element factors");
        assert!(
            largest(&elements.as_tested[TEST_MODES..])
                < 0.5 * largest(&initial.as_tested[TEST_MODES..])
        );
    }
}

#[test]
fn reading_errors_become_coupled_masses() {
    let comparison = compared(2);
    let change = &by_name(&comparison, "Berman and Nagy").mass_change;
    let coupling = (0..9).flat_map(|i| (0..9).filter(move |j| *j != i).map(move |j| (i, j)));
    // The box's masses are lumps; every pair of points gets a mass between them, up to one percent.
    let entries = coupling.map(|(i, j)| change[i][j].abs()).collect_vec();
    assert!(entries.iter().all(|entry| *entry > 1e-5));
    assert!((0.005..0.02).contains(&largest(&entries)));
}
