//! Weighted residuals, their Jacobian, and Gauss–Newton steps on them.

use crate::evidence::rules::compare_all;
use crate::prelude::*;

/// The box of Case 2 by its matrices, with a stiffness parameter for every panel.
fn by_matrices() -> DynamicModel {
    let model = case_of(2).model().unwrap();
    model.matrices(&[1.0; 15]).unwrap()
}

/// The same with a mass parameter for every point as well, and a sensor there.
fn with_masses() -> (WholeModel, SparseMatrix) {
    let model = by_matrices();
    let own_mass = |dof: usize| {
        let mut mass = zero_square(9);
        mass[(dof, dof)] = model.mass[(dof, dof)];
        ParameterMatrix::Mass(mass)
    };
    let panels = model.shares.iter().cloned().map(ParameterMatrix::Stiffness);
    let shares = panels.chain((0..9).map(own_mass)).collect_vec();
    of_dense(&model.stiffness, &model.mass, &shares).unwrap()
}

/// The model at other factors.
pub fn at(first: &DynamicModel, factors: &[f64]) -> DynamicModel {
    let mut model = first.clone();
    for ((share, first), factor) in model.shares.iter_mut().zip(&first.shares).zip(factors) {
        model.stiffness += (factor - 1.0) * first;
        *share *= *factor;
    }
    model
}

/// A structure whose factors are known, at others beside its test.
pub fn compare(known: &Known, factors: &[f64]) -> Result<Comparison, Error> {
    let model = known.model.analyze(factors, &known.test)?;
    Ok(Comparison::from(&model))
}

/// A model beside a test, all its modes.
fn beside(model: &DynamicModel, test: &Modes) -> Comparison {
    Comparison::from(&model.analyze(test, None).unwrap())
}

fn modes(model: &DynamicModel) -> Modes {
    solve(&model.stiffness, &model.mass, model.mass.nrows()).unwrap()
}

fn weights(modes: usize) -> Vec<ModeWeight> {
    equal_weights(DEVIATIONS, modes)
}

#[test]
fn the_jacobian_is_the_derivative_of_exact_analyses() {
    let (first, sensors) = with_masses();
    let exact = modes(&by_matrices());
    let step = 1e-5_f64;
    for seed in 1..=6 {
        let mut draws = Draws(seed);
        let factors = (0..24).map(|_| 0.8 + 0.4 * draws.unit()).collect_vec();
        let test = with_noise(&exact, Noise::USUAL, seed).unwrap();
        let weight = |_| ModeWeight {
            frequency: 100.0 + 200.0 * draws.unit(),
            shape: 30.0 + 70.0 * draws.unit(),
        };
        let weights = (0..9).map(weight).collect_vec();
        // Every mode by itself, or some as subspaces.
        let groups = if seed % 2 == 0 {
            vec![vec![0, 1], vec![2, 5, 3], vec![4]]
        } else {
            Vec::new()
        };
        // And components alike, or each with a weight of its own.
        let own = DMatrix::from_fn(9, 9, |_, _| {
            if seed % 3 == 0 {
                1.0
            } else {
                draws.between(0.2, 5.0)
            }
        });
        let analyzed = |factors: &[f64]| {
            let model = first.analyze(factors, &sensors, &test, by_sorting(), 9);
            let model = Comparison::from(model.unwrap());
            let model = model.with_groups(groups.clone()).unwrap();
            model.with_component_weights(own.clone()).unwrap()
        };
        let here = analyzed(&factors);
        let slopes = jacobian(&here, &weights).unwrap();
        assert_eq!(slopes.shape(), (90, 24));
        for e in 0..24 {
            let beside = |log: f64| {
                let mut factors = factors.clone();
                factors[e] *= log.exp();
                let model = analyzed(&factors);
                let pairs = [&model, &here].map(|of| &of.model().exact().pairing);
                assert_eq!(pairs[0].analysis_mode, pairs[1].analysis_mode);
                residuals(&model, &weights).unwrap()
            };
            let difference = (beside(step) - beside(-step)) / (2.0 * step);
            let off = (difference - slopes.column(e)).amax();
            assert!(
                off < CENTRAL_DIFFERENCE_GRADIENT * slopes.amax(),
                "seed {seed}, parameter {e}: {off}"
            );
        }
    }
}

#[test]
fn of_modes_compared_together_the_subspace_alone_counts() {
    let first = by_matrices();
    let exact = modes(&first);
    for seed in 1..=20 {
        let mut draws = Draws(seed);
        // Any three independent combinations of three shapes, in a test that has six others too.
        let mut test = exact.clone();
        let mixed = exact.shapes().columns(2, 3)
            * DMatrix::from_fn(3, 3, |i, j| {
                draws.between(-0.4, 0.4) + f64::from(u8::from(i == j))
            });
        alter(&mut test, |_, shapes| {
            shapes.columns_mut(2, 3).copy_from(&mixed)
        });
        let model = beside(&first, &test);
        let alone = residuals(&model, &weights(9)).unwrap();
        assert!(alone.amax() > 1.0, "{}", alone.amax());
        let model = model.with_groups(vec![vec![0], vec![3, 2, 4]]).unwrap();
        let together = residuals(&model, &weights(9)).unwrap();
        assert!(
            together.amax() < MATRIX_ROUND_OFF,
            "seed {seed}: {}",
            together.amax()
        );
    }
}

#[test]
fn shapes_turned_to_the_test_are_modes_of_the_same_subspace() {
    let first = by_matrices();
    let exact = modes(&first);
    for seed in 1..=20 {
        let mut draws = Draws(seed);
        let turn = DMatrix::from_fn(3, 3, |_, _| draws.between(-1.0, 1.0))
            .qr()
            .q();
        let mut test = exact.clone();
        let mixed = exact.shapes().columns(4, 3) * turn;
        alter(&mut test, |_, shapes| {
            shapes.columns_mut(4, 3).copy_from(&mixed)
        });
        let model = first.analyze(&test, None).unwrap();
        let State { modes, pairing, .. } = model.exact();
        let found = turned(modes, pairing, &[vec![4, 5, 6]], &test).unwrap();
        for (j, &i) in pairing.analysis_mode.iter().enumerate() {
            let sign = pairing.sign[j];
            let off = (found.shapes().column(i) * sign - test.shapes().column(j)).amax();
            assert!(
                off < MATRIX_ROUND_OFF * test.shapes().amax(),
                "seed {seed}, mode {j}: {off}"
            );
        }
        let generalized = found.shapes().tr_mul(&(&first.mass * found.shapes()));
        assert!((generalized - eye(9)).amax() < MATRIX_ROUND_OFF);
    }
}

#[test]
fn modes_are_told_apart_by_twice_the_deviation_of_their_difference() {
    // Of one percent each: 100 and 102.8 are within 2.84, and 107 is not.
    let groups = |hertz: &[f64]| indistinct_groups(hertz, &vec![0.01; hertz.len()]);
    assert_eq!(groups(&[100.0, 102.8, 107.0]), [vec![0, 1], vec![2]]);
    assert_eq!(groups(&[100.0, 102.9, 107.0]), [vec![0], vec![1], vec![2]]);
    // A chain of neighbors is one group, in any order.
    assert_eq!(groups(&[104.0, 100.0, 102.0]), [vec![1, 2, 0]]);
    assert_eq!(groups(&[]), [[0; 0]; 0]);
}

#[test]
fn shapes_are_scaled_by_least_squares_and_the_tests_scale_and_sign_do_not_matter() {
    let first = by_matrices();
    let test = with_noise(&modes(&first), Noise::USUAL, 3).unwrap();
    let mut other = test.clone();
    alter(&mut other, |_, shapes| *shapes *= -7.0);
    let weights = weights(9);
    let model = beside(&first, &test);
    let (one, two) = (
        residuals(&model, &weights).unwrap(),
        residuals(&beside(&first, &other), &weights).unwrap(),
    );
    let State { modes, pairing, .. } = model.model().exact();
    for j in 0..9 {
        let i = pairing.analysis_mode[j];
        let (v, r) = (modes.shapes().column(i), one.rows(10 * j + 1, 9));
        let other = two.rows(10 * j + 1, 9);
        assert!(v.dot(&r).abs() < MATRIX_ROUND_OFF * v.norm() * weights[j].shape);
        // The least distance from any multiple of the shape: that of no other scale is less.
        let unit = test.shapes().column(j) / test.shapes().column(j).amax();
        let scale = v.dot(&unit) / v.norm_squared();
        for scale in [0.999 * scale, 1.001 * scale] {
            assert!((scale * v - &unit).norm() * weights[j].shape > r.norm());
        }
        assert!((r + other).amax() < MATRIX_ROUND_OFF * weights[j].shape);
        let ratio = (modes.omega_squared()[i] / test.omega_squared()[j]).sqrt();
        assert_within(
            one[10 * j],
            (ratio - 1.0) * weights[j].frequency,
            ROUND_OFF * weights[j].frequency,
        );
    }
}

#[test]
fn of_components_with_deviations_of_their_own_the_scale_is_that_of_weighted_least_squares() {
    let first = by_matrices();
    let test = with_noise(&modes(&first), Noise::USUAL, 3).unwrap();
    for seed in 1..=5 {
        let mut draws = Draws(seed);
        let own = DMatrix::from_fn(9, 9, |_, _| draws.between(0.2, 5.0));
        let model = beside(&first, &test);
        let model = model.with_component_weights(own.clone()).unwrap();
        let found = residuals(&model, &weights(9)).unwrap();
        let State { modes, pairing, .. } = model.model().exact();
        for (j, &i) in pairing.analysis_mode.iter().enumerate() {
            let v = modes.shapes().column(i);
            let unit = test.shapes().column(j) / test.shapes().column(j).amax();
            let squares = own.column(j).map(|weight| weight * weight);
            let scale = v.component_mul(&squares).dot(&unit) / v.component_mul(&squares).dot(&v);
            let expected = (scale * v - unit).component_mul(&own.column(j)) / DEVIATIONS.shape;
            let off = (found.rows(10 * j + 1, 9) - expected).amax();
            assert!(off < MATRIX_ROUND_OFF / DEVIATIONS.shape, "{j}: {off:e}");
        }
    }
}

#[test]
fn components_of_one_weight_are_as_a_mode_of_that_weight() {
    let first = by_matrices();
    let test = with_noise(&modes(&first), Noise::USUAL, 3).unwrap();
    let model = beside(&first, &test);
    let own = DMatrix::from_fn(9, 9, |_, j| 0.5 + j as f64);
    let all = weights(9);
    let of_modes = (0..9)
        .map(|j| ModeWeight {
            shape: own[(0, j)] * all[j].shape,
            ..all[j]
        })
        .collect_vec();
    let of_components = model.clone().with_component_weights(own).unwrap();
    let off = residuals(&of_components, &all).unwrap() - residuals(&model, &of_modes).unwrap();
    assert!(off.amax() < MATRIX_ROUND_OFF * of_modes[8].shape);
    let [one, two] = [(&of_components, &all), (&model, &of_modes)]
        .map(|(model, weights)| jacobian(model, weights).unwrap());
    assert!((&one - &two).amax() < MATRIX_ROUND_OFF * two.amax());
    for wrong in [
        DMatrix::from_element(9, 8, 1.0),
        zero_square(9),
        DMatrix::from_element(9, 9, f64::NAN),
    ] {
        assert!(model.clone().with_component_weights(wrong).is_err());
    }
}

fn corrected(
    known: &Known,
    ranges: &[Option<Bounds>],
    settings: &WeightedSettings,
) -> WeightedCorrelation {
    gauss_newton(
        |factors| compare(known, factors),
        &vec![1.0; ranges.len()],
        ranges,
        &weights(known.test.len()),
        settings,
    )
    .unwrap()
}

#[test]
fn what_is_at_a_bound_is_pressed_there_and_all_else_is_stationary() {
    let known = Known::of_case(2);
    let settings = WeightedSettings::default();
    // The truth is 2/3 of the first gages.
    let bound = Bounds {
        lower: 0.8,
        upper: 1.2,
    };
    let mut ranges = vec![None; 15];
    (ranges[0], ranges[9]) = (Some(bound), Some(bound));
    let found = corrected(&known, &ranges, &settings);
    assert_eq!(
        (found.factors[0], found.factors[9], found.stop),
        (0.8, 0.8, WeightedStop::Gradient)
    );
    let objective = |factors: &[f64]| {
        let model = compare(&known, factors).unwrap();
        let logs: f64 = factors.iter().map(|factor| factor.ln().powi(2)).sum();
        0.5 * (residuals(&model, &weights(9)).unwrap().norm_squared() + logs)
    };
    assert!(relative_error(objective(&found.factors), found.objective) < MATRIX_ROUND_OFF);
    for e in 0..15 {
        for change in [0.999, 1.001] {
            let mut factors = found.factors.clone();
            factors[e] *= change;
            let is_out = ranges[e].is_some_and(|range| !range.contains(factors[e]));
            assert_eq!(
                objective(&factors) < found.objective,
                is_out,
                "{e} {change}"
            );
        }
    }
}

#[test]
fn gauss_newton_needs_fewer_steps_than_the_papers_rule_and_ends_nearer_to_the_truth() {
    let all = compare_all();
    let names = all.iter().map(|(name, _)| &name[..]).collect_vec();
    assert_eq!(names, ["Case 1", "Case 2", "Case 3", "Delta wing"]);
    for (name, [none, paper, weighted]) in &all {
        let [steps, _, rms, largest] = *weighted;
        assert!(
            steps < paper[0] && rms < paper[2],
            "{name}: {weighted:?} {paper:?}"
        );
        assert!(paper[2] < none[2] && none[0] == 0.0);
        assert!(largest < paper[3] && rms <= largest);
    }
}

#[test]
fn input_out_of_range_is_refused() {
    let known = Known::of_case(2);
    let analyze = |factors: &[f64]| compare(&known, factors);
    let (ones, free, usual) = ([1.0; 15], [None; 15], WeightedSettings::default());
    let vague = WeightedSettings {
        prior_deviations: vec![f64::INFINITY],
        ..usual.clone()
    };
    let idle = WeightedSettings {
        tolerance: 0.0,
        ..usual.clone()
    };
    let (lower, upper) = (2.0, 1.0);
    let upside_down = [Some(Bounds { lower, upper }); 15];
    let zeros = [0.0; 15];
    for (first, ranges, modes, settings, words) in [
        (&ones, &free[..], 9, &usual, "an answer"),
        (
            &ones,
            &free[..],
            9,
            &vague,
            "prior_deviation of the weighted steps is inf; it must be positive and finite",
        ),
        (
            &ones,
            &free[..],
            9,
            &idle,
            "tolerance of the weighted steps is 0; it must be positive and finite",
        ),
        (
            &ones,
            &free[1..],
            9,
            &usual,
            "parameter limits: 14 x 1 instead of 15 x 1",
        ),
        (
            &ones,
            &free[..],
            8,
            &usual,
            "weights: 8 x 1 instead of 9 x 1",
        ),
        (
            &zeros,
            &free[..],
            9,
            &usual,
            "factor of parameter 1 is 0; it must be positive and finite",
        ),
        (
            &ones,
            &upside_down[..],
            9,
            &usual,
            "parameter limits: 2 to 1 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them",
        ),
    ] {
        let found = gauss_newton(analyze, first, ranges, &weights(modes), settings);
        assert_eq!(said(found), words);
    }
    assert!(matches!(
        identifiability(&DMatrix::zeros(0, 3), &[1.0; 3]),
        Err(Error::Count { found: 0, .. })
    ));
    let few = WeightedSettings { trials: 1, ..usual };
    let stopped = gauss_newton(analyze, &ones, &free, &weights(9), &few).unwrap();
    assert_eq!((stopped.stop, stopped.analyses), (WeightedStop::Trials, 2));
}
