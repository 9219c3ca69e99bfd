//! Laws of weighted steps by numbers that are worked out by hand, and both sides of every limit.

use crate::extensions::weighted::at;
use crate::prelude::*;

#[track_caller]
fn assert_close(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance * expected.abs().max(1e-3),
        "{found} for {expected}"
    );
}

fn by_frequency(weight: f64) -> [ModeWeight; 1] {
    [ModeWeight {
        frequency: weight,
        shape: 0.0,
    }]
}

fn with_priors(priors: &[f64]) -> WeightedSettings {
    WeightedSettings {
        prior_deviations: priors.to_vec(),
        ..WeightedSettings::default()
    }
}

/// A mass of one on springs side by side that are one together, beside a test of `ratio` times its frequency. At factors $e^x$ its residual is
/// $w (\sqrt{\sum s e^x}/\text{ratio} - 1)$.
fn side_by_side(shares: &[f64], ratio: f64) -> impl Fn(&[f64]) -> Result<Comparison, Error> {
    let one = |size: f64| DMatrix::from_element(1, 1, size);
    let first = DynamicModel {
        stiffness: one(shares.iter().sum()),
        mass: one(1.0),
        shares: shares.iter().map(|&share| one(share)).collect(),
    };
    let test = Modes::new(DVector::from_element(1, ratio * ratio), one(1.0)).unwrap();
    move |factors| Ok(Comparison::from(&at(&first, factors).analyze(&test, None)?))
}

/// Two masses of one on springs of one and two to ground, and their own modes as a test.
fn two_masses() -> Comparison {
    let stiffness = diagonal([1.0, 2.0]);
    let own = |e: usize| spring(e, stiffness[(e, e)]);
    let (shares, mass) = (vec![own(0), own(1)], eye(2));
    let test = Modes::new(stiffness.diagonal(), dmatrix![2.0, 0.0; 1.0, 1.0]).unwrap();
    let model = DynamicModel {
        stiffness,
        mass,
        shares,
    };
    Comparison::from(&model.analyze(&test, None).unwrap())
}

fn spring(dof: usize, stiffness: f64) -> DMatrix<f64> {
    let mut own = zero_square(2);
    own[(dof, dof)] = stiffness;
    own
}

/// With the weight 2 and the prior 1/2, J = 2/2 and h = 1/(1 + 4): ν = 1 - 0.2, and the quantiles are those of one degree of freedom,
/// $z_{.9995}^2$ and $z_{.5005}^2$. Of two springs the first, at a bound, takes nothing: J = 2/2 · 0.25 and h = 1/16 / (1/16 + 1/4).
#[test]
fn a_fit_takes_away_what_it_has_learned() {
    let weights = [ModeWeight {
        frequency: 2.0,
        shape: 3.0,
    }];
    let one = Misfit::of(
        &side_by_side(&[1.0], 1.0)(&[1.0]).unwrap(),
        &weights,
        &[0.5],
        &[],
    )
    .unwrap();
    assert_close(one.degrees_of_freedom, 0.8, ROUND_OFF);
    assert_close(
        one.largest_by_noise,
        3.290_526_731_491_9_f64.powi(2),
        QUANTILE,
    );
    assert_within(
        one.least_by_noise,
        0.001_253_314_465_4_f64.powi(2),
        QUANTILE,
    );
    // Half off in frequency, and a shape of one reading at right angles: (2/2)² + 3².
    assert_close(one.of_unlike, 10.0, ROUND_OFF);
    let two = side_by_side(&[0.75, 0.25], 1.0)(&[1.0; 2]).unwrap();
    let two = Misfit::of(&two, &weights, &[0.5, 2.0], &[0]).unwrap();
    assert_close(two.degrees_of_freedom, 0.8, ROUND_OFF);
}

/// Nothing is fitted where all parameters are at bounds. Chi-squared of two degrees of freedom exceeds $x$ in $e^{-x/2}$ of the tests. The shape
/// (2, 1) over its largest component has the square 5/4, and (0, 1) has one.
#[test]
fn two_frequencies_are_two_numbers() {
    let weight = |shape| {
        vec![
            ModeWeight {
                frequency: 2.0,
                shape
            };
            2
        ]
    };
    let found =
        |weights: &[ModeWeight]| Misfit::of(&two_masses(), weights, &[1.0; 2], &[0, 1]).unwrap();
    let two = found(&weight(0.0));
    assert_close(two.degrees_of_freedom, 2.0, ROUND_OFF);
    assert_close(two.largest_by_noise, -2.0 * 1e-3_f64.ln(), QUANTILE);
    assert_close(two.least_by_noise, -2.0 * 0.999_f64.ln(), QUANTILE);
    assert_close(two.power, 1e-3_f64.powf(1.0 / 9.0), QUANTILE);
    let four = found(&weight(2.0));
    assert_close(four.degrees_of_freedom, 4.0, ROUND_OFF);
    assert_close(four.of_unlike, 2.0 + 4.0 * 2.25, ROUND_OFF);
    // A frequency without a shape is one number more, whatever its weight of a shape.
    let lone = LoneFrequency {
        frequency_hz: 1.0,
        partner: 1,
    };
    let weights = [
        &weight(2.0)[..1],
        &[ModeWeight {
            frequency: 0.0,
            shape: 2.0,
        }],
        &[ModeWeight::ONE],
    ]
    .concat();
    let five = two_masses().with_lone_frequencies(vec![lone]).unwrap();
    let five = Misfit::of(&five, &weights, &[1.0; 2], &[0, 1]).unwrap();
    assert_close(five.degrees_of_freedom, 2.0 + 1.0 + 1.0, ROUND_OFF);
}

/// Four floors with four sensors: 4 frequencies, and shapes with as many free scales as modes are compared together.
#[test]
fn shapes_compared_together_have_a_scale_for_each_of_them() {
    let stiffness = (0..4).map(|story| spring_stiffness(4, story, 1.0));
    let shares = stiffness.collect_vec();
    let (stiffness, mass) = (shares.iter().sum(), eye(4));
    let model = DynamicModel {
        stiffness,
        mass,
        shares,
    };
    let test = solve(&model.stiffness, &model.mass, 4).unwrap();
    let comparison = Comparison::from(&model.analyze(&test, None).unwrap());
    for (groups, numbers) in [
        (vec![], 4.0 + 4.0 * 3.0),
        (vec![vec![0, 1]], 4.0 + 2.0 * 2.0 + 2.0 * 3.0),
        (vec![vec![0, 2, 3], vec![1]], 4.0 + 3.0 * 1.0 + 3.0),
        (vec![vec![0, 1, 2, 3]], 4.0),
    ] {
        let together = comparison.clone().with_groups(groups).unwrap();
        let found = Misfit::of(&together, &[ModeWeight::ONE; 4], &[1.0; 4], &[0, 1, 2, 3]).unwrap();
        assert_close(found.degrees_of_freedom, numbers, ROUND_OFF);
    }
}

/// Every limit of a verdict from both sides: chi-squared, freedom, power and chi-squared of an unlike model; whether the test can fail, whether
/// noise may have left as much, whether noise leaves more, the widening, and how many times the noise.
#[test]
fn every_limit_of_a_verdict_has_two_sides() {
    let times = |square: f64| Some(square.sqrt());
    for (numbers, answers, widening, of_noise) in [
        (
            [10.0, 10.0, 0.9, 99.0],
            [true, true, false],
            1.0,
            times(1.0),
        ),
        ([1.9, 10.0, 0.9, 99.0], [true, true, true], 1.0, times(0.19)),
        (
            [2.1, 10.0, 0.9, 99.0],
            [true, true, false],
            1.0,
            times(0.21),
        ),
        (
            [30.0, 10.0, 0.9, 99.0],
            [true, true, false],
            1.0,
            times(3.0),
        ),
        (
            [30.1, 10.0, 0.9, 99.0],
            [true, false, false],
            3.01_f64.sqrt(),
            times(3.01),
        ),
        (
            [10.0, 1.0 - 5e-7, 0.9, 99.0],
            [true, true, false],
            1.0,
            None,
        ),
        (
            [0.0, 1.0 - 5e-6, 0.9, 99.0],
            [false, true, false],
            1.0,
            None,
        ),
        ([36.0, 0.25, 0.9, 99.0], [false, false, false], 6.0, None),
        (
            [10.0, 1.0, 0.9, 99.0],
            [true, true, false],
            1.0,
            times(10.0),
        ),
        (
            [10.0, 10.0, 0.5, 99.0],
            [true, true, false],
            1.0,
            times(1.0),
        ),
        (
            [10.0, 10.0, 0.499, 99.0],
            [false, true, false],
            1.0,
            times(1.0),
        ),
        (
            [10.0, 10.0, 0.9, 30.1],
            [true, true, false],
            1.0,
            times(1.0),
        ),
        (
            [10.0, 10.0, 0.9, 30.0],
            [false, true, false],
            1.0,
            times(1.0),
        ),
    ] {
        let [chi_squared, degrees_of_freedom, power, of_unlike] = numbers;
        let (largest_by_noise, least_by_noise) = (30.0, 2.0);
        let own = Misfit {
            chi_squared,
            degrees_of_freedom,
            largest_by_noise,
            least_by_noise,
            power,
            of_unlike,
        };
        assert_eq!(
            [own.can_fail(), own.is_by_noise(), own.is_below_noise()],
            answers,
            "{own:?}"
        );
        assert_close(own.widening(), widening, ROUND_OFF);
        assert_eq!(
            own.times_the_noise().is_some(),
            of_noise.is_some(),
            "{own:?}"
        );
        assert_close(
            own.times_the_noise().unwrap_or(1.0),
            of_noise.unwrap_or(1.0),
            ROUND_OFF,
        );
        for (power, is_said) in [(0.989, true), (0.991, false)] {
            let own = Misfit { power, ..own };
            let (words, is_good) = (own.in_words(), own.can_fail() && own.is_by_noise());
            assert_eq!(
                words.contains("so few numbers would show 99 %"),
                is_said && is_good,
                "{words}"
            );
        }
    }
}

/// Of two modes with one root, e1 and e2, every test shape has the square of its part in their plane: 2/3 of (1, 1, 1), 1 of (1, -2, 0). The
/// third mode has its own. Roots are one up to the least distance at which shapes have slopes; two shapes that a sensor set tells apart by less
/// than half the digits are one.
#[test]
fn modes_of_one_root_have_the_squared_cosine_of_their_plane() {
    let tests = dmatrix![1.0, 1.0; 1.0, -2.0; 1.0, 0.0];
    let found = |roots: [f64; 3], shapes: DMatrix<f64>, tests: &DMatrix<f64>| {
        let modes = Modes::new(DVector::from_row_slice(&roots), shapes).unwrap();
        assurance_of_roots(&modes, tests).unwrap()
    };
    let apart = dmatrix![1.0 / 3.0, 0.2; 1.0 / 3.0, 0.8; 1.0 / 3.0, 0.0];
    let plane = dmatrix![2.0 / 3.0, 1.0; 2.0 / 3.0, 1.0; 1.0 / 3.0, 0.0];
    for (gap, expected) in [(0.0, &plane), (0.5, &plane), (2.0, &apart)] {
        let roots = [1.0, 1.0 + gap * SMALLEST_SEPARATION, 2.0];
        let off = found(roots, eye(3), &tests) - expected;
        assert!(off.amax() < ROUND_OFF, "{gap}: {off}");
    }
    for (angle, seen) in [(1e-6_f64, 1.0), (1e-9, 0.0)] {
        let shapes = dmatrix![3.0, angle.cos(), 0.0; 0.0, angle.sin(), 0.0; 0.0, 0.0, 1.0];
        let second = found([1.0, 1.0, 2.0], shapes, &dmatrix![0.0; 1.0; 0.0]);
        assert_within(second[(0, 0)], seen, DIFFERENCE_ROUND_OFF);
    }
    // Two test modes at one root have a partner each: what it lacks of the first is not made up by the other's.
    let (shares, stiffness) = (vec![spring(0, 1.0), spring(1, 1.0)], eye(2));
    let mass = eye(2);
    let model = DynamicModel {
        stiffness,
        mass,
        shares,
    };
    let test = Modes::new(dvector![1.0, 1.0], dmatrix![1.0, 0.0; 0.1, 1.0]).unwrap();
    let comparison = Comparison::from(&model.analyze(&test, None).unwrap());
    let found = residuals(&comparison, &[ModeWeight::ONE; 2]).unwrap();
    let off = found - dvector![0.0, 0.0, -0.1, 0.0, 0.0, 0.0];
    assert!(off.amax() < ROUND_OFF, "{off}");
}

fn columns(angles: &[f64]) -> DMatrix<f64> {
    let unit = angles
        .iter()
        .map(|angle| dvector![angle.cos(), angle.sin()]);
    DMatrix::from_columns(&unit.collect_vec())
}

/// Two columns are parallel above a cosine of 0.98, one way or the other; a~b and b~c are one group though a and c are not parallel, in any order.
#[test]
fn parallel_to_one_another_is_one_group() {
    for (cosine, is_parallel) in [
        (0.979_f64, false),
        (0.981, true),
        (-0.979, false),
        (-0.981, true),
    ] {
        let found = identifiability(&columns(&[0.0, cosine.acos()]), &[1.0; 2])
            .unwrap()
            .parallel;
        assert_eq!(found.len(), usize::from(is_parallel), "{cosine}");
        found
            .iter()
            .for_each(|(.., own)| assert_close(*own, cosine, ROUND_OFF));
    }
    // Ten degrees have a cosine of .985, twenty one of .940.
    let step = 10.0_f64.to_radians();
    for order in [
        vec![0, 1, 2],
        vec![0, 2, 1],
        vec![1, 0, 2],
        vec![0, 1, 3, 2],
        vec![3, 1, 0, 2],
        vec![1, 3, 0, 2],
    ] {
        let angles = order
            .iter()
            .map(|&place| f64::from(place) * step)
            .collect_vec();
        let found = identifiability(&columns(&angles), &vec![1.0; order.len()]).unwrap();
        assert_eq!(
            found.parallel_groups(),
            [(0..order.len()).collect_vec()],
            "{order:?}"
        );
    }
}

/// Columns at right angles: known mostly from the prior where less than half its
/// variance is taken away, so shorter than one over its deviation; in the subset where longer than that, by length in prior deviations, of equals
/// the first.
#[test]
fn columns_at_right_angles_tell_by_their_lengths() {
    let of = |lengths: &[f64], priors: &[f64]| {
        let columns = diagonal(lengths);
        identifiability(&columns, priors).unwrap()
    };
    for prior in [0.2, 1.0, 5.0] {
        let found = of(&[0.99 / prior, 1.01 / prior], &[prior; 2]);
        assert_eq!([0, 1].map(|e| found.is_mostly_prior(e)), [true, false]);
        assert_eq!(found.subset, [1]);
        let [less, more] = [0.99_f64, 1.01].map(|length| length * length / (1.0 + length * length));
        assert_close(found.learned[0], less, ROUND_OFF);
        assert_close(found.learned[1], more, ROUND_OFF);
        assert_close(found.condition, 1.01 / 0.99, MATRIX_ROUND_OFF);
    }
    // Three columns that are multiples of one leave round-off of the others.
    let one = dvector![0.1, 0.3, 0.7];
    assert_eq!(
        identifiability(&(&one * one.transpose()), &[1.0; 3])
            .unwrap()
            .condition,
        f64::INFINITY
    );
    assert_eq!(of(&[1.1, 0.9], &[0.9, 1.2]).subset, [1]);
    assert_eq!(of(&[2.0, 3.0, 2.0, 3.0], &[1.0; 4]).subset, [1, 3, 0, 2]);
}

/// Two columns of a cosine of .995 are told apart where they are a hundred deviations long, and not where they are one: of the combination that
/// they do alike and of that which undoes it then 1/3 and 1 of the prior's variance is left, 2/3 of each factor's.
#[test]
fn parallel_parameters_are_untold_by_their_own_deviations() {
    let all = [
        (100.0, vec![], 2),
        (5.0, vec![], 1),
        (1.0, vec![vec![0, 1]], 0),
    ];
    for (size, groups, told) in all {
        let found = identifiability(&(size * columns(&[0.0, 0.1])), &[1.0; 2]).unwrap();
        assert_eq!(found.parallel_groups(), [[0, 1]]);
        assert_eq!(
            (found.untold_groups(), found.subset.len()),
            (groups, told),
            "{size}"
        );
    }
}

/// With $r = w (e^{x/2} - 1)$ and a prior the ends are where $r^2 + (x/\tau)^2 = 1.96^2$.
#[test]
fn ends_are_where_the_objective_has_risen() {
    for (weight, prior) in [
        (4.0, 1e6),
        (3.5, 1e6),
        (2.0, 0.4_f64.powf(-0.5)),
        (40.0, 1.0),
    ] {
        let (analyze, settings) = (side_by_side(&[1.0], 1.0), with_priors(&[prior]));
        let weights = by_frequency(weight);
        let found = intervals(&analyze, &[1.0], &[None], &weights, &settings, 1.0).unwrap();
        let Bounds { lower, upper } = found[0].unwrap();
        for (end, side) in [(lower, -1.0), (upper, 1.0)] {
            let root = (weight * (end.sqrt() - 1.0)).hypot(end.ln() / prior);
            assert_close(side * end.ln().signum() * root, NORMAL_95, LINE_TO_AN_END);
        }
    }
}

/// Two springs side by side, known by their sum and by priors: at an end of one the other has moved to where the objective is least, which a
/// search by thirds finds. A widening w divides the measurement and the pull to the prior by w², and holds the rest of the prior at the factors.
#[test]
fn at_an_end_the_others_have_moved_and_the_prior_is_as_it_was() {
    let (weight, ratio, priors) = (40.0, 1.6, [2.0, 0.5]);
    let (analyze, weights, settings) = (
        side_by_side(&[0.5, 0.5], ratio),
        by_frequency(weight),
        with_priors(&priors),
    );
    let best = gauss_newton(&analyze, &[1.0; 2], &[None; 2], &weights, &settings)
        .unwrap()
        .factors;
    let (mut followed, at) = (0, [best[0].ln(), best[1].ln()]);
    for widening in [1.0, 2.0] {
        let objective = |logs: [f64; 2]| {
            let residual = weight * ((0.5 * (logs[0].exp() + logs[1].exp())).sqrt() / ratio - 1.0);
            let square = |of: [f64; 2]| (of[0] / priors[0]).powi(2) + (of[1] / priors[1]).powi(2);
            let held = square([logs[0] - at[0], logs[1] - at[1]]);
            let share = f64::powi(widening, -2);
            0.5 * (share * (residual * residual + square(logs)) + (1.0 - share) * held)
        };
        let least = |e: usize, log: f64| {
            let (mut low, mut high) = (-6.0, 6.0);
            let value = |other: f64| objective(if e == 0 { [log, other] } else { [other, log] });
            for _ in 0..200 {
                let third = (high - low) / 3.0;
                if value(low + third) < value(high - third) {
                    high -= third
                } else {
                    low += third
                }
            }
            value(low)
        };
        let found = intervals(&analyze, &best, &[None; 2], &weights, &settings, widening).unwrap();
        for (e, interval) in found.into_iter().enumerate() {
            let Ok(Bounds { lower, upper }) = interval else {
                continue;
            };
            if (lower * upper / best[e].powi(2)).ln().abs() > 1e-6 {
                followed += 1;
                for end in [lower, upper] {
                    let root = (2.0 * (least(e, end.ln()) - objective(at))).sqrt();
                    assert_close(root, NORMAL_95, END_OF_INTERVAL);
                }
            }
        }
    }
    assert!(followed >= 2, "{followed}");
}

/// No end lies beyond the prior's own, $e^{\pm 1.96 \tau}$, unless the factor does. With priors so narrow that slopes hold: $s = 1/\sqrt{w^2/4 +
/// \tau^{-2}}$, to a percent.
#[test]
fn no_end_is_beyond_the_priors_unless_the_factor_is() {
    let (prior, weight) = (0.01, 220.0);
    let (settings, weights) = (with_priors(&[prior]), by_frequency(weight));
    for wanted in [0.0, 1.5, -1.5, 3.0, -3.0] {
        let analyze = side_by_side(&[1.0], (0.5 * prior * wanted / 0.5475_f64).exp());
        let best = gauss_newton(&analyze, &[1.0], &[None], &weights, &settings).unwrap();
        let (log, width) = (
            best.factors[0].ln(),
            NORMAL_95 * best.identifiability.deviations[0],
        );
        let Bounds { lower, upper } =
            intervals(&analyze, &best.factors, &[None], &weights, &settings, 1.0).unwrap()[0]
                .unwrap();
        let most = NORMAL_95 * prior;
        let near = |end: f64, expected: f64| assert!((end - expected).abs() < 0.01 * width);
        near(lower.ln(), (log - width).max((-most).min(log)));
        near(upper.ln(), (log + width).min(most.max(log)));
        assert!(lower.ln() >= (-most).min(log) && upper.ln() <= most.max(log) + ROUND_OFF);
        assert_within(log / prior, wanted, SET_UP);
    }
}

/// At either bound, to a billionth, there is no interval; nor is there one where the prior keeps more than half of its variance.
#[test]
fn an_interval_is_withheld_on_one_side_of_each_limit() {
    let analyze = side_by_side(&[1.0], 1.0);
    let found = |range, weight: f64| {
        let settings = with_priors(&[1.0]);
        intervals(
            &analyze,
            &[1.0],
            &[range],
            &by_frequency(weight),
            &settings,
            1.0,
        )
        .unwrap()[0]
            .err()
    };
    for (lower, upper, is_at_end) in [
        (1.0 - 1e-10, 9.0, true),
        (1.0 - 1e-7, 9.0, false),
        (0.1, 1.0 + 1e-10, true),
        (0.1, 1.0 + 1e-7, false),
    ] {
        // Whether the prior alone says where it is or not.
        for weight in [0.1, 40.0] {
            let withheld = found(Some(Bounds { lower, upper }), weight);
            let is_said = withheld == Some(Withheld::AtBound);
            assert_eq!(is_said, is_at_end, "{lower} {upper} {weight}");
        }
    }
    // J is half the weight, and the prior keeps 1/(1 + J²).
    assert_eq!(found(None, 2.0 * 0.99), Some(Withheld::MostlyPrior));
    assert_ne!(found(None, 2.0 * 1.01), Some(Withheld::MostlyPrior));
}

/// Two hundred parameters are followed beyond their slopes, and no more: only the first is seen.
#[test]
fn two_hundred_parameters_are_followed() {
    for (count, is_followed) in [(200, true), (201, false)] {
        let mut shares = vec![1e-6; count];
        shares[0] = 1.0 - 1e-6 * (count - 1) as f64;
        let analyze = side_by_side(&shares, 1.0);
        let mut priors = vec![0.5; count];
        priors[0] = 1e3;
        let settings = with_priors(&priors);
        let found = intervals(
            &analyze,
            &vec![1.0; count],
            &vec![None; count],
            &by_frequency(3.0),
            &settings,
            1.0,
        )
        .unwrap();
        assert_eq!(found.iter().filter(|own| own.is_ok()).count(), 1);
        let Bounds { lower, upper } = found[0].unwrap();
        assert_eq!((lower * upper).ln().abs() > 1e-3, is_followed, "{count}");
    }
}

/// Log of the factor of one spring after some of Nielsen's steps from one, none longer than one, with what the last step has shown of the
/// second order where it foretold that step.
fn nielsen(weight: f64, ratio: f64, prior: f64, steps: usize) -> f64 {
    let place = |log: f64| {
        let (quotient, pull) = ((0.5 * log).exp() / ratio, log / (prior * prior));
        let (residual, slope) = (weight * (quotient - 1.0), 0.5 * weight * quotient);
        let objective = 0.5 * (residual * residual + pull * log);
        (
            objective,
            slope * residual + pull,
            slope * slope + prior.powi(-2),
            [slope, residual],
        )
    };
    let (mut log, mut damping, mut growth) = (0.0, 1e-3, 2.0);
    let (mut second, mut is_told) = (0.0, false);
    for _ in 0..steps {
        let (objective, gradient, plain, [slope, _]) = place(log);
        if gradient.abs() <= 1e-5 * plain.sqrt() {
            break;
        }
        let with = plain + second;
        let curvature = if is_told && with > 0.0 { with } else { plain };
        let step = (-gradient / (curvature * (1.0 + damping))).clamp(-1.0, 1.0);
        let promised = -gradient * step - 0.5 * curvature * step * step;
        let (after, gradient_after, _, [slope_after, residual_after]) = place(log + step);
        let fall = objective - after;
        if fall > 0.0 {
            log += step;
            // Of one parameter the secant is all that there is.
            let shown = (slope_after - slope) * residual_after / step;
            is_told = (shown - second).abs() < shown.abs();
            if (gradient_after - gradient) * step > 0.0 {
                second = shown;
            }
            damping *= (1.0 - (2.0 * fall / promised - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
            growth = 2.0;
        } else {
            damping *= growth;
            growth *= 2.0;
        }
    }
    log
}

/// A trial of n steps goes to where n of Nielsen's lead from the first damping of a thousandth.
#[test]
fn a_trial_goes_to_where_damped_steps_of_at_most_one_lead() {
    for (weight, ratio, prior) in [
        (10.0, 0.2, 3.0),
        (10.0, 4.0, 3.0),
        (2.0, 1.5, 0.7),
        (3.0, 0.3, 9.0),
    ] {
        for trials in 1..=4 {
            let settings = WeightedSettings {
                trials,
                ..with_priors(&[prior])
            };
            let found = gauss_newton(
                side_by_side(&[1.0], ratio),
                &[1.0],
                &[None],
                &by_frequency(weight),
                &settings,
            )
            .unwrap();
            let first = found.iterations[0].factors[0].ln();
            let expected = nielsen(weight, ratio, prior, trials);
            assert_within(first, expected, MATRIX_ROUND_OFF);
        }
    }
}

/// A step beyond a bound stops there, and the other solves $A_{11} (1 + \mu) h_1 = -(g_1 + A_{10} h_0)$.
#[test]
fn what_stops_at_a_bound_is_on_the_right_hand_side_of_the_others() {
    let (weight, shares, priors) = (10.0, [0.6, 0.4], [3.0_f64, 2.0]);
    for (ratio, bound) in [(1.15, 1.1_f64), (0.8, 0.95)] {
        let range = Bounds {
            lower: bound.min(0.999),
            upper: bound.max(1.001),
        };
        let settings = WeightedSettings {
            trials: 1,
            ..with_priors(&priors)
        };
        let ranges = [Some(range), None];
        let found = gauss_newton(
            side_by_side(&shares, ratio),
            &[1.0; 2],
            &ranges,
            &by_frequency(weight),
            &settings,
        )
        .unwrap();
        let slopes = shares.map(|share| 0.5 * weight * share / ratio);
        let residual = weight * (1.0 / ratio - 1.0);
        let held = bound.ln();
        let curvature = (slopes[1].powi(2) + priors[1].powi(-2)) * 1.001;
        let other = -(slopes[1] * residual + slopes[0] * slopes[1] * held) / curvature;
        let first = &found.iterations[0].factors;
        assert_close(first[0], bound, ROUND_OFF);
        assert_within(first[1].ln(), other, MATRIX_ROUND_OFF);
    }
}

/// Steps end where what is left to fall is ½ tolerance²: by a nearly linear problem, less than the tolerance in deviations away.
#[test]
fn steps_end_within_the_tolerance_in_deviations() {
    for tolerance in [0.1, 0.01] {
        for (away, analyses) in [(0.95, 1), (1.05, 2)] {
            let weight = 1e4;
            let settings = WeightedSettings {
                tolerance,
                ..with_priors(&[1e3])
            };
            let analyze = side_by_side(&[1.0], 1.0 + away * tolerance / weight);
            let found =
                gauss_newton(analyze, &[1.0], &[None], &by_frequency(weight), &settings).unwrap();
            assert_eq!(
                (found.stop, found.analyses),
                (WeightedStop::Gradient, analyses),
                "{tolerance} {away}"
            );
        }
    }
}

/// After k trials without a model the damping is $10^{-3} \cdot 2 \cdot 4 \cdots 2^k$, and holds the factor at its place: the next trial goes to
/// where ½ r² + ½ (x/τ)² + ½ μ A x² is least, found by thirds.
#[test]
fn every_rejection_on_end_doubles_what_damping_is_multiplied_by() {
    let (weight, ratio, prior) = (10.0, 1.6, 2.0_f64);
    let slope: f64 = 0.5 * weight / ratio;
    let curvature = slope * slope + prior.powi(-2);
    for (fails, damping) in [(1, 2e-3), (2, 8e-3), (3, 0.064), (4, 1.024)] {
        let (inner, mut calls) = (side_by_side(&[1.0], ratio), 0);
        let analyze = |factors: &[f64]| {
            calls += 1;
            if (2..2 + fails).contains(&calls) {
                Err(Error::no_convergence("modes"))
            } else {
                inner(factors)
            }
        };
        let found = gauss_newton(
            analyze,
            &[1.0],
            &[None],
            &by_frequency(weight),
            &with_priors(&[prior]),
        )
        .unwrap();
        let value = |log: f64| {
            let residual = weight * ((0.5 * log).exp() / ratio - 1.0);
            residual * residual + (log / prior).powi(2) + damping * curvature * log * log
        };
        let (mut low, mut high) = (0.0, 2.0);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if value(low + third) < value(high - third) {
                high -= third
            } else {
                low += third
            }
        }
        // Steps leave a hundredth of the fall of their first one.
        let first = found.iterations[0].factors[0].ln();
        let left = value(first) - value(low);
        assert!(
            left < 0.02 * (value(0.0) - value(low)),
            "{fails}: {first} {low}"
        );
    }
}

/// An end by gradient has one of at most the tolerance in deviations, $|g| \le 10^{-5} \sqrt{A}$.
#[test]
fn an_end_by_gradient_has_one_within_tolerance() {
    let weight = 1e3;
    for tenths in 5..25 {
        let ratio = f64::from(tenths) / 10.0;
        let analyze = side_by_side(&[1.0], ratio);
        let settings = with_priors(&[3.0]);
        let found =
            gauss_newton(analyze, &[1.0], &[None], &by_frequency(weight), &settings).unwrap();
        let log = found.factors[0].ln();
        let quotient = (0.5 * log).exp() / ratio;
        let slope = 0.5 * weight * quotient;
        let gradient = slope * weight * (quotient - 1.0) + log / 9.0;
        let most = 1.01e-5 * (slope * slope + 1.0 / 9.0).sqrt();
        assert_eq!(found.stop, WeightedStop::Gradient, "{ratio}");
        assert!(gradient.abs() <= most, "{ratio}: {gradient:e} {most:e}");
    }
}

/// An analysis whose last digits come and go, here up to a thousandth of the stiffness, leaves a gradient, and no pairs change ahead: the end
/// is short of a minimum where these digits are a part of a deviation, and one where no test tells them.
#[test]
fn steps_among_digits_end_short_of_a_gradient() {
    for (weight, stop) in [(300.0, WeightedStop::Short), (3.0, WeightedStop::Gradient)] {
        let (inner, mut calls) = (side_by_side(&[1.0], 1.5), 0);
        let analyze = |factors: &[f64]| {
            calls += 1;
            inner(&[factors[0] * (1.0 + 1e-3 * (0.618 * f64::from(calls)).fract())])
        };
        let found = gauss_newton(
            analyze,
            &[1.0],
            &[None],
            &by_frequency(weight),
            &with_priors(&[3.0]),
        )
        .unwrap();
        assert_eq!(found.stop, stop);
    }
}

/// Two masses of one on two springs in a row, beside the frequencies and shapes of factors (1.4, 1): (2, 0.7) has the same frequencies.
fn in_a_row() -> impl Fn(&[f64]) -> Result<Comparison, Error> + Copy {
    move |factors| {
        let first = DynamicModel {
            stiffness: dmatrix![2.0, -1.0; -1.0, 1.0],
            mass: eye(2),
            shares: vec![dmatrix![1.0, 0.0; 0.0, 0.0], dmatrix![1.0, -1.0; -1.0, 1.0]],
        };
        let real = at(&first, &[1.4, 1.0]);
        let test = solve(&real.stiffness, &real.mass, 2)?;
        Ok(Comparison::from(&at(&first, factors).analyze(&test, None)?))
    }
}

/// Ends of steps that were cut short are no minima of their own, though noise allows them; the best is one all the same. Chi-squared is without
/// the prior.
#[test]
fn runs_cut_short_make_no_minima() {
    let weights = [ModeWeight {
        frequency: 16.0,
        shape: 0.0,
    }; 2];
    for (trials, is_cut, count) in [(2, true, 1), (100, false, 2)] {
        let settings = WeightedSettings {
            trials,
            tolerance: 1e-7,
            prior_deviations: vec![10.0],
        };
        let history =
            from_several_starts(in_a_row(), &[None; 2], &weights, &settings, (20, 3), || {
                true
            })
            .unwrap();
        let cut = history
            .starts
            .iter()
            .flatten()
            .filter(|end| end.stop == WeightedStop::Trials);
        let cut = cut.count();
        assert_eq!(cut > 10, is_cut, "{cut}");
        let least = history
            .starts
            .iter()
            .flatten()
            .filter(|end| end.objective < history.best.objective + 1.0);
        assert!(least.count() > 15);
        assert_eq!(history.minima[0].factors, history.best.factors);
        for minimum in &history.minima {
            let there = in_a_row()(&minimum.factors).unwrap();
            let own = residuals(&there, &weights).unwrap().norm_squared();
            assert_within(minimum.chi_squared, own, MATRIX_ROUND_OFF);
        }
        assert_eq!(history.minima.len(), count, "{:?}", history.minima);
    }
    // A prior that pulls: chi-squared is more than a part of what it adds.
    let history = from_several_starts(
        in_a_row(),
        &[None; 2],
        &weights,
        &with_priors(&[0.01]),
        (2, 3),
        || true,
    )
    .unwrap();
    let own = residuals(&history.best.last, &weights)
        .unwrap()
        .norm_squared();
    assert!(own > 1.0 && relative_error(history.minima[0].chi_squared, own) < MATRIX_ROUND_OFF);
}

/// Noise allows a second minimum whose chi-squared is above the least by no more than 5.99, the 95 % quantile of two parameters; that of (2, 0.7)
/// goes with the square of the shapes' weight. Minima half a unit of the objective apart are two, with .03 between them.
#[test]
fn noise_allows_a_minimum_up_to_the_quantile_of_as_many_parameters() {
    let minima = |frequency: f64, shape: f64| {
        let weights = [ModeWeight { frequency, shape }; 2];
        from_several_starts(
            in_a_row(),
            &[None; 2],
            &weights,
            &with_priors(&[1e3]),
            (20, 3),
            || true,
        )
        .unwrap()
        .minima
        .len()
    };
    let of_one = residuals(
        &in_a_row()(&[2.0, 0.7]).unwrap(),
        &[ModeWeight {
            frequency: 1e4,
            shape: 1.0,
        }; 2],
    );
    let of_one = of_one.unwrap().norm_squared();
    assert_eq!(
        [5.8_f64, 6.2].map(|chi_squared| minima(1e4, (chi_squared / of_one).sqrt())),
        [2, 1]
    );
    assert_eq!(minima(16.0, 0.0), 2);
}

/// Two masses on springs of their own. The frequency of the first is known without a shape, at first the higher and in truth the lower of the two:
/// where the modes change places the first trial has followed its own.
#[test]
fn a_frequency_without_a_shape_follows_its_mode_through_a_crossing() {
    let first = DynamicModel {
        stiffness: diagonal([400.0, 200.0]),
        mass: eye(2),
        shares: vec![spring(0, 400.0), spring(1, 200.0)],
    };
    let test = Modes::new(DVector::from_element(1, 200.0), dmatrix![0.0; 1.0]).unwrap();
    let analyze = |factors: &[f64]| {
        let lone = LoneFrequency {
            frequency_hz: 10.0 / TAU,
            partner: usize::from(400.0 * factors[0] > 200.0 * factors[1]),
        };
        Comparison::from(&at(&first, factors).analyze(&test, None)?)
            .with_lone_frequencies(vec![lone])
    };
    let weights = [ModeWeight {
        frequency: 200.0,
        shape: 50.0,
    }; 2];
    let found = gauss_newton(
        analyze,
        &[1.0; 2],
        &[None; 2],
        &weights,
        &with_priors(&[1e3]),
    )
    .unwrap();
    let trial = &found.iterations[0].factors;
    assert_close(trial[0], 0.25, WEIGHTED_FACTOR);
    assert_close(trial[1], 1.0, WEIGHTED_FACTOR);
    assert_eq!(found.last.lone()[0].partner, 0);
}
