//! Chi-squared at the best factors, its degrees of freedom, and what is said of them.

use crate::prelude::*;

/// Four equal stories with a sensor on every floor, of a test of stories with these factors.
fn building(truth: &[f64; 4]) -> Comparison {
    let model = |factors: &[f64; 4]| {
        let story = |story: usize| spring_stiffness(4, story, 1e5 * factors[story]);
        let shares = (0..4).map(story).collect_vec();
        DynamicModel {
            stiffness: shares.iter().sum(),
            mass: 60.0 * eye(4),
            shares,
        }
    };
    let real = model(truth);
    let test = solve(&real.stiffness, &real.mass, 4).unwrap();
    Comparison::from(&model(&[1.0; 4]).analyze(&test, None).unwrap())
}

fn misfit(weights: &[ModeWeight], prior: f64, at_bound: &[usize]) -> Misfit {
    Misfit::of(&building(&[1.0; 4]), weights, &[prior; 4], at_bound).unwrap()
}

/// Chi-squared of an even number of degrees of freedom is a sum of exponentials: Abramowitz and Stegun, 26.4.5.
fn upper_tail(chi_squared: f64, degrees: u32) -> f64 {
    let half = 0.5 * chi_squared;
    let term = |k: u32| (1..=k).map(|of| half / f64::from(of)).product::<f64>();
    (-half).exp() * (0..degrees / 2).map(term).sum::<f64>()
}

/// With a prior that lets nothing move the fit takes nothing away: a mode gives its frequency and one less than its sensors.
#[test]
fn one_test_in_a_thousand_of_a_right_model_is_called_wrong() {
    let all = equal_weights(Noise::USUAL, 4);
    let mut half = all.clone();
    half[2].shape = 0.0;
    half[3] = ModeWeight {
        frequency: 0.0,
        shape: 0.0,
    };
    for (weights, numbers) in [(all, 16), (half, 9)] {
        let found = misfit(&weights, 1e-9, &[]);
        assert_within(
            found.degrees_of_freedom,
            f64::from(numbers),
            MATRIX_ROUND_OFF,
        );
        assert!(found.chi_squared < ROUND_OFF && found.is_by_noise());
        if numbers % 2 == 0 {
            assert_within(
                upper_tail(found.largest_by_noise, numbers),
                1e-3,
                1e-3 * MATRIX_ROUND_OFF,
            );
            let ninth = upper_tail(found.largest_by_noise / 9.0, numbers);
            assert_within(found.power, ninth, MATRIX_ROUND_OFF);
        }
    }
}

#[test]
fn parameters_that_a_test_decides_take_one_number_each_and_those_at_a_bound_none() {
    let weights = equal_weights(
        Noise {
            shape: 1e-7,
            frequency: 1e-7,
        },
        4,
    );
    for (at_bound, left) in [(&[][..], 12.0), (&[1], 13.0), (&[0, 1, 2, 3], 16.0)] {
        let found = misfit(&weights, 1.0, at_bound).degrees_of_freedom;
        assert_within(found, left, 1e-6);
    }
}

#[test]
fn a_verdict_says_what_noise_allows_what_no_noise_explains_and_what_so_few_numbers_cannot_tell() {
    let weights = equal_weights(Noise::USUAL, 4);
    let mut one = weights.clone();
    one[1..].fill(ModeWeight {
        frequency: 0.0,
        shape: 0.0,
    });
    one[0].shape = 0.0;
    let [all, few, none] = [(&weights, 1e-9), (&one, 1e-9), (&one, 1e3)]
        .map(|(weights, prior)| misfit(weights, prior, &[]));
    let wrong = Misfit {
        chi_squared: 16.0 * 14.0_f64.powi(2),
        ..all
    };
    for (misfit, says) in [
        (
            all,
            "As good as the noise allows: residuals are 0.00 times the noise. \
               Chi-squared is 0.0 for 16.0 degrees of freedom; noise alone leaves at most 39.3 in 999 of 1000 tests.",
        ),
        (
            wrong,
            "The model cannot explain this test: residuals are 14.0 times the noise.",
        ),
        (
            few,
            "Nothing to judge by: of tests with three times this noise, so few numbers would show 27 %.",
        ),
        (
            none,
            "Nothing to judge by: the fit leaves less than one number over.",
        ),
    ] {
        let words = misfit.in_words();
        assert!(words.contains(says), "{words}");
    }
    // Chi-squared of one number is beyond 3.841 in five tests of a hundred, and beyond 10.828 in one of a thousand.
    let marks =
        [3.84, 3.85, 10.82, 10.84].map(|squares| corfem::weighted::misfit::mark(squares, 1));
    assert_eq!(marks, ["good", "acceptable", "acceptable", "poor"]);
    assert_within(wrong.widening(), 14.0, MATRIX_ROUND_OFF);
    assert_eq!((all.widening(), none.times_the_noise()), (1.0, None));
}

/// The sum is that of the residuals, and no more noise is allowed than noise leaves.
#[test]
fn chi_squared_is_the_sum_of_squared_residuals() {
    let model = building(&[0.9, 1.0, 1.2, 1.0]);
    let weights = equal_weights(Noise::USUAL, 4);
    let found = Misfit::of(&model, &weights, &[1.0; 4], &[]).unwrap();
    let sum = residuals(&model, &weights).unwrap().norm_squared();
    assert_eq!(found.chi_squared, sum);
    assert!(!found.is_by_noise() && found.widening() > 1.0);
}
