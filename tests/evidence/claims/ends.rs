//! Laws of the ends of weighted steps.

use crate::evidence::ends::{corrected, network, oscillators, steepness, steps};
use crate::evidence::five_structures::{TOWER, corrections};
use crate::prelude::*;
use corfem::job::verdict::Stationary;

/// A stop by gradient is stationary: on a hundred drawn structures the exact objective has no slope there but what the stop leaves and what
/// the error of slopes does to residuals of this size.
#[test]
fn a_stop_by_gradient_is_stationary() {
    let mut by_gradient = 0;
    // The number of starts and the round-off that is allowed were chosen on seeds below a thousand.
    for seed in 1_000..1_100 {
        let result = corrected(&network(seed), 1.0, seed);
        let is_gradient = steps(&result).stop == WeightedStop::Gradient;
        assert_eq!(
            result.verdict.stationary.is_some(),
            is_gradient,
            "network {seed}"
        );
        if is_gradient {
            by_gradient += 1;
            let most = STATIONARY + SLOPES_TOLD * result.misfit.chi_squared.sqrt();
            let found = steepness(&result);
            assert!(found <= most, "network {seed}: {found:e} beyond {most:e}");
        } else {
            // What is no minimum says so.
            let outcome = result.verdict.outcome;
            assert_eq!(outcome, Outcome::Short, "network {seed}");
            assert!(!result.verdict.is_within, "network {seed}");
        }
    }
    assert!(by_gradient >= 95, "{by_gradient} of 100");
}

/// True if nothing is said against a result.
fn is_silent(result: &JobResult) -> bool {
    result.verdict.is_within && !result.trust.stands_against()
}

/// Jobs of light oscillators by exact data: those that end in the truth, and those that end elsewhere without a word.
fn light_oscillators(draws: Range<u64>, noise: Noise) -> (usize, Vec<u64>) {
    let (mut right, mut silent) = (0, Vec::new());
    for seed in draws {
        let result = corrected(&oscillators(seed, noise), 0.0, seed);
        match result.misfit.chi_squared < 0.5 {
            true => right += 1,
            false if is_silent(&result) => silent.push(seed),
            false => (),
        }
    }
    (right, silent)
}

/// Exact data and a right model end in the truth or with a doubt, light oscillators among the masses too.
#[test]
fn exact_data_of_a_right_model_end_in_the_truth_or_in_a_doubt() {
    let noise = Noise {
        frequency: 0.002,
        shape: 0.01,
    };
    let (right, silent) = light_oscillators(1_000..1_040, noise);
    assert_eq!(silent, [0; 0]);
    assert!(right >= 36, "{right} of 40");
}

/// Modes of a tower of 32 parameters change places between the first model and the truth, and every other of its right tests once ended in
/// another valley that noise does not explain, of these six three. At most one does now, and of six with three times the noise none is
/// accepted.
#[test]
fn a_minimum_that_noise_does_not_explain_is_left() {
    let noise = Noise {
        frequency: 0.005,
        shape: 0.03,
    };
    let found = corrections(TOWER, noise, 6);
    assert!(found.accepted >= 5 && found.found == 6, "{found:?}");
}

/// With wider deviations one job in fifty may stay in a valley of its own whose chi-squared the noise allows: twenty places do not find all.
#[test]
#[ignore = "a minute: two hundred draws of light oscillators with two noises"]
fn few_jobs_of_light_oscillators_end_elsewhere_without_a_word() {
    for (frequency, shape, most) in [(0.002, 0.01, 0), (0.005, 0.02, 4)] {
        let (right, silent) = light_oscillators(2_000..2_200, Noise { shape, frequency });
        println!("{frequency} {shape}: {right} of 200 right, without a word {silent:?}");
        assert!(silent.len() <= most, "{silent:?}");
    }
}

/// GARTEUR's frequencies, whose partners are followed by their likeness, lead to a wall: no minimum, and said to be none.
#[test]
fn frequencies_of_garteur_end_at_a_wall() {
    let result = worked("garteur");
    assert_eq!(steps(result).stop, WeightedStop::Short);
    assert_eq!(result.verdict.outcome, Outcome::Short);
    assert_eq!(result.verdict.stationary, None::<Stationary>);
    // The objective jumps there: its slope across the wall is no slope.
    assert!(steepness(result) > 1.0);
    assert!(!result.verdict.is_within);
    assert!(result.intervals.iter().all(Result::is_err));
}
