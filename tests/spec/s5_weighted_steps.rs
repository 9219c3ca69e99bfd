//! Where weighted correlations begin, and what their Jacobian holds of modes that are all but one.

use crate::common::known::Known;
use crate::common::measured::equal_weights;
use crate::common::tolerances::{ROUND_OFF, STANDARD_ERRORS};
use corfem::method::appendix_c::SMALLEST_SEPARATION;
use corfem::method::error_sum::ModeWeight;
use corfem::method::model::{DynamicModel, ParameterMatrix};
use corfem::method::modes::{ModeSet, solve};
use corfem::weighted::gauss_newton::{WeightedSettings, WeightedStop, from_several_starts};
use corfem::weighted::identifiability::identifiability;
use corfem::weighted::residuals::{DEVIATIONS, jacobian};
use nalgebra::{DMatrix, DVector, dmatrix};

#[test]
fn random_starts_are_log_uniform_from_half_to_twice_the_first_factors() {
    let known = Known::of_case(2).unwrap();
    let weights = equal_weights(DEVIATIONS, known.test.len());
    // Without trials there is one analysis a start.
    let settings = WeightedSettings {
        trials: 0,
        ..WeightedSettings::default()
    };
    let mut firsts: Vec<Vec<f64>> = Vec::new();
    let analyze = |factors: &[f64]| {
        firsts.push(factors.to_vec());
        known.model.analyze(factors, &known.test, None)
    };
    let (best, _) = from_several_starts(analyze, &[None; 15], &weights, &settings, 41, 7).unwrap();
    assert_eq!(
        (best.stop, firsts.len(), &firsts[0]),
        (WeightedStop::Trials, 41, &vec![1.0; 15])
    );
    let logs: Vec<f64> = firsts[1..]
        .iter()
        .flatten()
        .map(|factor| factor.log2())
        .collect();
    assert!(logs.iter().all(|log| (-1.0..=1.0).contains(log)));
    // Moments of the uniform distribution from minus one to one, with the variance of what is averaged.
    let mean =
        |of: fn(f64) -> f64| logs.iter().map(|&log| of(log)).sum::<f64>() / logs.len() as f64;
    for (found, expected, variance) in [
        (mean(|x| x), 0.0, 1.0 / 3.0),
        (mean(|x| x * x), 1.0 / 3.0, 4.0 / 45.0),
    ] {
        assert!(
            (found - expected).abs() < STANDARD_ERRORS * (variance / logs.len() as f64).sqrt(),
            "{found}"
        );
    }
}

#[test]
fn shapes_of_modes_closer_than_they_can_be_told_apart_are_held() {
    // Two masses on springs of their own, and a parameter that couples them.
    let share = dmatrix![0.5, 0.5; 0.5, 0.5];
    let slope = |separation: f64| {
        let stiffness =
            DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 4.0 * (1.0 + separation)]));
        let model = DynamicModel {
            stiffness,
            mass: DMatrix::identity(2, 2),
            shares: vec![ParameterMatrix::Stiffness(share.clone())],
        };
        let test: ModeSet = solve(&model.stiffness, &model.mass, 2).unwrap().into();
        let modal = model.analyze(&test, None).unwrap();
        let weights = [ModeWeight::ONE; 2];
        // What the first mode gains of the second.
        jacobian(&modal, &weights).unwrap()[(2, 0)]
    };
    assert_eq!(slope(0.5 * SMALLEST_SEPARATION), 0.0);
    for separation in [0.1, 0.5] {
        assert!(
            (slope(separation) + 0.5 / (4.0 * separation)).abs() < ROUND_OFF,
            "{}",
            slope(separation)
        );
    }
    assert!(slope(2.0 * SMALLEST_SEPARATION).abs() > 0.01 / SMALLEST_SEPARATION);
}

#[test]
fn a_column_of_less_than_a_hundredth_of_the_longest_is_blind() {
    for unit in [1e-3, 1.0, 1e3] {
        let columns =
            unit * DMatrix::from_diagonal(&DVector::from_vec(vec![10.0, 0.11, 0.09, 1.0]));
        assert_eq!(identifiability(&columns, 1.0).unwrap().blind, [2], "{unit}");
    }
}
