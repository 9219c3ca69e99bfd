//! Where weighted correlations begin, and what their Jacobian holds of modes that are all but one.

use crate::extensions::weighted::compare;
use crate::prelude::*;
use corfem::weighted::starts::{Minimum, StartEnd};

#[test]
fn random_starts_are_log_uniform_from_half_to_twice_the_first_factors() {
    let known = Known::of_case(2);
    let weights = equal_weights(DEVIATIONS, known.test.len());
    // Without trials there is one analysis a start.
    let settings = WeightedSettings {
        trials: 0,
        ..WeightedSettings::default()
    };
    let mut firsts: Vec<Vec<f64>> = Vec::new();
    let analyze = |factors: &[f64]| {
        firsts.push(factors.to_vec());
        compare(&known, factors)
    };
    let best = from_several_starts(analyze, &[None; 15], &weights, &settings, (41, 7), || true)
        .unwrap()
        .best;
    assert_eq!(
        (best.stop, firsts.len(), &firsts[0]),
        (WeightedStop::Trials, 41, &vec![1.0; 15])
    );
    let logs = firsts[1..]
        .iter()
        .flatten()
        .map(|factor| factor.log2())
        .collect_vec();
    assert!(logs.iter().all(|log| (-1.0..=1.0).contains(log)));
    // Moments of the uniform distribution from minus one to one, with the variance of what is averaged.
    let mean =
        |of: fn(f64) -> f64| logs.iter().map(|&log| of(log)).sum::<f64>() / logs.len() as f64;
    for (found, expected, variance) in [
        (mean(|x| x), 0.0, 1.0 / 3.0),
        (mean(|x| x * x), 1.0 / 3.0, 4.0 / 45.0),
    ] {
        assert_within(
            found,
            expected,
            STANDARD_ERRORS * (variance / logs.len() as f64).sqrt(),
        );
    }
}

/// Of three starts the second has no model, and later a trial has none: the others end where all of them do.
#[test]
fn a_start_or_a_trial_without_a_model_is_rejected_and_the_others_stand() {
    let known = Known::of_case(2);
    let weights = equal_weights(DEVIATIONS, known.test.len());
    let settings = WeightedSettings::default();
    let starts = |count: usize, fails: &dyn Fn(usize, &[f64]) -> bool| {
        let (mut calls, mut failed) = (0, 0);
        let analyze = |factors: &[f64]| {
            calls += 1;
            if fails(calls, factors) {
                failed += 1;
                return Err(Error::no_convergence("modes"));
            }
            compare(&known, factors)
        };
        let found = from_several_starts(
            analyze,
            &[None; 15],
            &weights,
            &settings,
            (count, 7),
            || true,
        );
        (found, failed)
    };
    let (all, _) = starts(3, &|_, _| false);
    let failures = |ends: &[Option<StartEnd>]| ends.iter().filter(|end| end.is_none()).count();
    let WeightedHistory {
        best: all,
        minima,
        starts: ends,
    } = all.unwrap();
    let reached = |minima: &[Minimum]| minima.iter().map(|of| of.starts).collect_vec();
    assert_eq!((reached(&minima), failures(&ends)), (vec![3], 0));
    // The second start comes after all analyses of the first.
    let of_one = starts(1, &|_, _| false).0.unwrap().best;
    let (without, failed) = starts(3, &|call, _| call == of_one.analyses + 1);
    let WeightedHistory {
        best: without,
        minima,
        starts: ends,
    } = without.unwrap();
    assert_eq!((failed, failures(&ends), reached(&minima)), (1, 1, vec![2]));
    assert!(ends[1].is_none());
    assert_relative_eq!(
        &without.factors[..],
        &all.factors[..],
        max_relative = WEIGHTED_FACTOR
    );
    // The first trial fails.
    let (trial, failed) = starts(1, &|call, _| call == 2);
    let trial = trial.unwrap().best;
    assert_eq!((failed, trial.stop), (1, WeightedStop::Gradient));
    assert_relative_eq!(
        &trial.factors[..],
        &of_one.factors[..],
        max_relative = WEIGHTED_FACTOR
    );
    // All of them fail.
    let (none, failed) = starts(3, &|_, _| true);
    assert!(none.is_err());
    assert_eq!(failed, 3);
}

#[test]
fn shapes_of_modes_closer_than_they_can_be_told_apart_are_held() {
    // Below it slopes of shapes leave no digit of a prior in the curvature.
    const SEPARATION: f64 = 1e-6;
    // Two masses on springs of their own, and a parameter that couples them.
    let share = dmatrix![0.5, 0.5; 0.5, 0.5];
    let slope = |separation: f64| {
        let stiffness = diagonal([4.0, 4.0 * (1.0 + separation)]);
        let model = DynamicModel {
            stiffness,
            mass: eye(2),
            shares: vec![share.clone()],
        };
        let test = solve(&model.stiffness, &model.mass, 2).unwrap();
        let modal = Comparison::from(&model.analyze(&test, None).unwrap());
        let weights = [ModeWeight::ONE; 2];
        // What the first mode gains of the second.
        jacobian(&modal, &weights).unwrap()[(2, 0)]
    };
    assert_eq!(slope(0.5 * SEPARATION), 0.0);
    for separation in [0.1, 0.5] {
        assert!(
            (slope(separation) + 0.5 / (4.0 * separation)).abs() < ROUND_OFF,
            "{}",
            slope(separation)
        );
    }
    assert!(slope(2.0 * SEPARATION).abs() > 0.01 / SEPARATION);
}

/// It is a Gauss–Newton step: what it leaves of the error of the factors falls as that error's square.
#[test]
fn one_step_from_near_the_truth_leaves_an_error_of_second_order() {
    let case = Case {
        grouping: Grouping::Substructures,
        ..case_of(2)
    };
    let (model, test) = (case.model().unwrap(), case.test_modes().unwrap());
    let off = [0.4, -1.0, 0.8];
    let left = |size: f64| {
        // All first gages are half too thick.
        let factors = off.map(|off: f64| (size * off).exp() / 1.5);
        let there = Comparison::from(&model.analyze(&factors, &test, None).unwrap());
        let next = NextStep::at(&there, Noise::USUAL, 1e6).unwrap();
        let errors = off.iter().zip(&next.step);
        errors.fold(0.0_f64, |most, (off, step)| {
            most.max((size * off + step).abs())
        })
    };
    let order = (left(0.02) / left(0.01)).log2();
    assert_within(order, 2.0, ORDER_SLACK);
}

/// At the truth nothing is left to move; far from it everything that is not moved is hardly seen.
#[test]
fn what_a_step_moves_is_more_than_its_deviation() {
    let known = Known::of_case(2);
    let next = |factors: &[f64]| {
        let there = compare(&known, factors).unwrap();
        NextStep::at(&there, Noise::USUAL, 1.0).unwrap()
    };
    assert_eq!(next(&known.truth).moved(), []);
    let next = next(&[1.0; 15]);
    let moved = next.moved();
    assert!(!moved.is_empty());
    for e in 0..15 {
        let size = (next.step[e] / next.seen.deviations[e]).abs();
        let found = moved.iter().find(|(moved, _)| *moved == e);
        assert_eq!(found, (size > 1.0).then_some(&(e, size)));
    }
}

#[test]
fn a_step_by_a_test_without_errors_is_refused() {
    let known = Known::of_case(2);
    let there = compare(&known, &known.truth).unwrap();
    for noise in [
        Noise {
            shape: 0.0,
            frequency: 0.0,
        },
        Noise {
            shape: -0.01,
            ..Noise::USUAL
        },
    ] {
        let found = NextStep::at(&there, noise, 1.0);
        let is_refused = matches!(found, Err(Error::Value { what: "weight", .. }));
        assert!(is_refused, "{found:?}");
    }
}
