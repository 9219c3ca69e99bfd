//! The outer loop by hand: when it begins, goes on and ends, and what its settings mean.

use crate::prelude::*;

#[test]
fn a_model_that_is_right_needs_no_pass() {
    let chain = Chain::uniform(3);
    let settings = Settings {
        least_passes: 0,
        ..Settings::default()
    };
    let found = correlate_chain(&chain, &[1.0; 3], &settings.for_modes(3));
    assert!(found.converged);
    assert!(found.passes.is_empty());
    assert_eq!(found.best_factors, [1.0; 3]);
}

#[test]
fn a_pass_without_a_step_is_the_last() {
    let settings = Settings {
        least_passes: 3,
        ..Settings::default()
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.0; 3], &settings.for_modes(3));
    assert_eq!(found.passes.len(), 1);
    assert!(found.converged);
    let pass = &found.passes[0];
    assert_eq!(pass.inner.stop, Stop::LocalMinimum);
    assert!(pass.inner.iterations.is_empty());
    assert_eq!(pass.factors, [1.0; 3]);
    assert_eq!(found.best_factors, [1.0; 3]);
}

#[test]
fn every_tolerance_counts() {
    // One pass; the errors it leaves meet every tolerance just above them, and none just below any one.
    let (chain, truth) = (Chain::uniform(3), [1.3, 0.8, 1.1]);
    let once = |change: &dyn Fn(&mut Settings)| {
        let settings = Settings {
            most_passes: 1,
            ..Settings::default()
        };
        let mut settings = settings.for_modes(3);
        change(&mut settings);
        correlate_chain(&chain, &truth, &settings)
    };
    let errors = once(&|_| {}).passes[0].check.errors;
    assert!(errors.frequency > 0.0 && errors.shape > 0.0);
    let within = |sum: f64, frequency: f64, shape: f64| {
        once(&|settings| {
            settings.error_sum_tolerance = sum * errors.sum();
            settings.frequency_tolerance = frequency * errors.frequency;
            settings.shape_tolerance = shape * errors.shape;
        })
        .converged
    };
    let above = 1.0 + ROUND_OFF;
    assert!(within(above, above, above));
    assert!(!within(0.99, 1.0, 1.0));
    assert!(!within(1.0, 0.99, 1.0));
    assert!(!within(1.0, 1.0, 0.99));
}

/// A tolerance is the largest error that is accepted; the next smaller number is one that is not met.
#[test]
fn a_tolerance_met_exactly_is_met() {
    let (chain, truth) = (Chain::uniform(3), [1.3, 0.8, 1.1]);
    let converged = |sum: f64, frequency: f64, shape: f64| {
        let settings = Settings {
            error_sum_tolerance: sum,
            frequency_tolerance: frequency,
            shape_tolerance: shape,
            most_passes: 0,
            ..Settings::default()
        };
        correlate_chain(&chain, &truth, &settings)
    };
    let errors = converged(1.0, 1.0, 1.0).initial.errors;
    let (sum, frequency, shape) = (errors.sum(), errors.frequency, errors.shape);
    assert!(converged(sum, frequency, shape).converged);
    assert!(!converged(sum.next_down(), frequency, shape).converged);
    assert!(!converged(sum, frequency.next_down(), shape).converged);
    assert!(!converged(sum, frequency, shape.next_down()).converged);
}

#[test]
fn passes_after_the_first_have_their_own_tolerance() {
    let chain = Chain::uniform(4);
    let settings = Settings {
        inner: InnerSettings {
            tolerance: 0.1,
            ..InnerSettings::default()
        },
        later_inner_tolerance: 0.02,
        least_passes: 2,
        most_passes: 2,
        ..Settings::default()
    };
    let found = correlate_chain(&chain, &[1.4, 0.8, 1.2, 0.7], &settings.for_modes(4));
    let sums = found
        .passes
        .iter()
        .map(|pass| pass.inner.last.errors.sum())
        .collect_vec();
    // As the sums of nine modes: four are compared.
    assert!(1.5 * sums[0] < 0.1 && 1.5 * sums[0] > 0.02);
    assert!(1.5 * sums[1] < 0.02);
    assert!(
        found
            .passes
            .iter()
            .all(|pass| pass.inner.stop == Stop::Tolerance)
    );
}

#[test]
fn the_most_passes_have_the_last_word() {
    let settings = Settings {
        least_passes: 5,
        most_passes: 2,
        ..Settings::default()
    };
    let settings = settings.for_modes(3);
    let found = correlate_chain(&Chain::uniform(3), &[1.3, 0.8, 1.1], &settings);
    assert_eq!(found.passes.len(), 2);
    let none = Settings {
        most_passes: 0,
        ..settings
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.3, 0.8, 1.1], &none);
    assert!(found.passes.is_empty() && !found.converged);
    assert_eq!(found.best_factors, [1.0; 3]);
}

#[test]
fn frequencies_stand_in_the_order_of_the_test_modes() {
    let chain = Chain::uniform(3);
    let mut test = chain.modes(&[1.0; 3]);
    alter(&mut test, |squares, _| squares.swap_rows(0, 2));
    alter(&mut test, |_, shapes| shapes.swap_columns(0, 2));
    let found = chain
        .model(&[1.0; 3])
        .analyze(&test, None)
        .unwrap()
        .exact()
        .clone();
    assert_eq!(found.pairing.analysis_mode, [2, 1, 0]);
    assert_eq!(
        ExactResult::from(&found).frequencies_hz,
        test.frequencies_hz()
    );
    assert_eq!(found.errors.frequency, 0.0);
}

#[test]
fn the_default_settings_are_as_documented() {
    let settings = Settings::default();
    assert_eq!(settings.inner, InnerSettings::default());
    assert_eq!(settings.later_inner_tolerance, 0.015);
    assert_eq!(settings.error_sum_tolerance, 0.05);
    assert_eq!(settings.frequency_tolerance, 0.015);
    assert_eq!(settings.shape_tolerance, 0.04);
    assert_eq!((settings.least_passes, settings.most_passes), (1, 10));
}

#[test]
fn the_box_needs_a_second_pass_because_b_was_frozen() {
    let case = case_of(1);
    let model = case.model().unwrap();
    let test = case.test_modes().unwrap();
    let ranges = model.factor_ranges().unwrap();
    let found = correlate(
        |f| model.analyze(f, &test, None),
        &ranges,
        &case.settings,
        |_, _| true,
    )
    .unwrap();
    let [first, second] = &found.passes[..] else {
        panic!("{} passes", found.passes.len());
    };
    // The exact check of the first pass shows more error than its inner loop; the second, hardly changed, does not.
    assert!(first.check.errors.sum() > 1.5 * first.inner.last.errors.sum());
    assert!(second.check.errors.sum() < 1.1 * second.inner.last.errors.sum());
    assert_eq!(found.best_factors, second.factors);
}

/// An analysis that knows nothing of the factors: no pass is better than the start, and none better than another.
#[test]
fn of_equal_passes_the_first_is_best() {
    let chain = Chain::uniform(3);
    let model = chain.model(&[1.0; 3]);
    let test = chain.modes(&[1.3, 0.8, 1.1]);
    let settings = Settings {
        least_passes: 2,
        most_passes: 2,
        ..Settings::default()
    };
    let found = correlate(
        |_| model.analyze(&test, None),
        &[None; 3],
        &settings.for_modes(3),
        |_, _| true,
    )
    .unwrap();
    assert_eq!(found.passes.len(), 2);
    for pass in &found.passes {
        assert_eq!(pass.check.errors, found.initial.errors);
        assert_ne!(pass.factors, [1.0; 3]);
    }
    assert_eq!(found.best_factors, [1.0; 3]);
}

/// Errors of nine modes are three root mean squares, and those of n modes are √n of them.
#[test]
fn settings_for_other_modes_are_met_by_the_same_root_mean_square() {
    let nine = Settings::default();
    let tolerances = |settings: &Settings| {
        [
            settings.inner.tolerance,
            settings.later_inner_tolerance,
            settings.error_sum_tolerance,
            settings.frequency_tolerance,
            settings.shape_tolerance,
        ]
    };
    let relaxations = |settings: &Settings| {
        let InnerSettings {
            first_relaxation,
            relaxation,
            ..
        } = settings.inner;
        [first_relaxation, relaxation]
    };
    for count in [1, 4, 9, 36] {
        let (settings, root) = (nine.for_modes(count), (count as f64).sqrt());
        for (found, of_nine) in tolerances(&settings).iter().zip(tolerances(&nine)) {
            assert_relative_eq!(found / root, of_nine / 3.0, max_relative = ROUND_OFF);
        }
        // The step (13) is in proportion to the error sum.
        for (found, of_nine) in relaxations(&settings).iter().zip(relaxations(&nine)) {
            assert_relative_eq!(found * root, of_nine * 3.0, max_relative = ROUND_OFF);
        }
    }
    assert_eq!(nine.for_modes(0), nine.for_modes(1));
}
