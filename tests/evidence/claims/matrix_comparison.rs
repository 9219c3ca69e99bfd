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
fn covers_are_the_panels_between_the_spars() {
    // A cover's corners are all upper or all lower grids: odd or even.
    let case = case_of(2);
    let parity = |grids: &[usize]| grids.iter().map(|grid| grid % 2).sum::<usize>();
    let covers = case
        .panels
        .iter()
        .filter(|panel| matches!(parity(&panel.grids), 0 | 4))
        .map(|panel| panel.label)
        .collect_vec();
    assert_eq!(covers, COVERS);
    assert_eq!(COVER_DOUBLER, 0.005);
}

#[test]
fn truth_is_right_and_the_start_is_where_distance_begins() {
    for case in 1..=3 {
        let comparison = compared(case);
        let (truth, initial) = (
            by_name(&comparison, "Truth"),
            by_name(&comparison, "Initial"),
        );
        assert!(largest(&truth.as_tested) <= EIGEN_ROUND_OFF);
        assert!(largest(&truth.after_change) <= EIGEN_ROUND_OFF);
        assert_eq!((truth.distance_left, initial.distance_left), (0.0, 1.0));
        assert_eq!(
            (
                initial.beyond_elements,
                largest(&initial.stiffness_change.concat())
            ),
            (0.0, 0.0)
        );
        let tested = model(case, &[0.010; 15]);
        let frequencies = solve(&tested.stiffness, &tested.mass, 9)
            .unwrap()
            .frequencies_hz();
        assert_eq!(comparison.as_tested_hz, frequencies);
        let factors = comparison
            .factors
            .iter()
            .map(|factor| factor.truth)
            .collect_vec();
        for gage in gages(case, &factors, false) {
            assert!((gage - 0.010).abs() < ROUND_OFF);
        }
        let changed = model(case, &gages(case, &factors, true));
        let frequencies = solve(&changed.stiffness, &changed.mass, 9)
            .unwrap()
            .frequencies_hz();
        assert_alike(
            comparison.after_change_hz.iter(),
            &frequencies,
            EIGEN_ROUND_OFF,
        );
    }
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
                    assert!(
                        (errors[mode] - expected).abs() <= EIGEN_ROUND_OFF,
                        "{name} {mode}"
                    );
                }
            }
            for (i, row) in prediction.stiffness_change.iter().enumerate() {
                for (j, entry) in row.iter().enumerate() {
                    let change = stiffnesses[0][(i, j)] - first.stiffness[(i, j)];
                    let scale = (first.stiffness[(i, i)] * first.stiffness[(j, j)]).sqrt();
                    assert!((entry - change / scale).abs() <= CORRECTION_ROUND_OFF);
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
                assert!(
                    (found - before).abs() < UNMEASURED_MODE,
                    "Case {case} {name}: {found} {before}"
                );
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
