//! The outer loop: exact checks between inner loops, until analysis and test agree or there is no more to try.

use crate::common::loops::chain_problem;
use crate::common::tolerances::{CONVERGED_STATE, MATRIX_ROUND_OFF, ROUND_OFF};
use crate::common::vibrations::{Chain, chain_and_truth, error_sum_by_definition};
use corfem::cases::Case;
use corfem::inner_loop::{InnerSettings, Stop, run};
use corfem::outer_loop::{Correlation, Settings, check, correlate};
use corfem::perturbation::UpdateRule;
use corfem::step::Range;
use nalgebra::DMatrix;
use proptest::prelude::*;
use std::cell::RefCell;

/// Correlates a chain with its truth, without bounds.
fn correlate_chain(chain: &Chain, truth: &[f64], settings: &Settings) -> Correlation {
    let ranges = vec![None; truth.len()];
    correlate(|factors| Ok(chain.model(factors)), &chain.modes(truth), &ranges, settings, |_, _| {})
        .unwrap()
}

/// Settings with tolerances from loose to strict and up to four passes, so that loops end for every reason.
fn settings() -> impl Strategy<Value = Settings> {
    (
        (0.01..0.2_f64, 0.01..0.1_f64),
        (0.005..0.3_f64, 0.005..0.3_f64, 0.005..0.3_f64),
        (0..=3_usize, 0..=4_usize, 0..=8_usize),
    )
        .prop_map(|(inner, outer, (least_passes, most_passes, iterations))| Settings {
            inner: InnerSettings { tolerance: inner.0, iterations, ..InnerSettings::default() },
            later_inner_tolerance: inner.1,
            error_sum_tolerance: outer.0,
            frequency_tolerance: outer.1,
            shape_tolerance: outer.2,
            least_passes,
            most_passes,
            analysis_modes: None,
        })
}

proptest! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn the_record_is_the_loop((chain, truth) in chain_and_truth(), settings in settings()) {
        let (test, ranges) = (chain.modes(&truth), vec![None; truth.len()]);
        let (asked, told) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
        let found = correlate(
            |factors| {
                asked.borrow_mut().push(factors.to_vec());
                Ok(chain.model(factors))
            },
            &test,
            &ranges,
            &settings,
            |number, pass| told.borrow_mut().push((number, pass.factors.clone())),
        )
        .unwrap();
        let meets = |check: &corfem::outer_loop::Check| {
            check.errors.sum() <= settings.error_sum_tolerance
                && check.errors.frequency <= settings.frequency_tolerance
                && check.errors.shape <= settings.shape_tolerance
        };
        let mut factors = vec![1.0; truth.len()];
        let mut analyses = vec![factors.clone()];
        let mut tolerance = settings.inner.tolerance;
        let (mut converged, mut stuck) = (meets(&found.initial), false);
        prop_assert_eq!(found.parameter_count, truth.len());
        for (number, pass) in found.passes.iter().enumerate() {
            prop_assert!(number < settings.most_passes && !stuck);
            prop_assert!(number < settings.least_passes || !converged);
            // The inner loop of this pass begins at the factors so far, with this pass's tolerance.
            let model = chain.model(&factors);
            let problem = corfem::modal::ModalProblem::new(&model, &test, truth.len()).unwrap();
            let inner = InnerSettings { tolerance, ..settings.inner.clone() };
            let expected = run(&problem, &factors, &ranges, &inner).unwrap();
            prop_assert_eq!(&pass.inner.last.factors, &expected.last.factors);
            prop_assert_eq!(pass.inner.stop, expected.stop);
            prop_assert_eq!(pass.inner.iterations.len(), expected.iterations.len());
            for (factor, step) in factors.iter_mut().zip(&expected.last.factors) {
                *factor *= step;
            }
            prop_assert_eq!(&pass.factors, &factors);
            prop_assert_eq!(&told.borrow()[number], &(number + 1, factors.clone()));
            analyses.push(factors.clone());
            tolerance = settings.later_inner_tolerance;
            converged = meets(&pass.check);
            stuck = pass.inner.iterations.is_empty();
        }
        // It went on for as long as it had to.
        let count = found.passes.len();
        prop_assert!(stuck || count == settings.most_passes || (count >= settings.least_passes && converged));
        prop_assert_eq!(found.converged, converged);
        prop_assert_eq!(told.borrow().len(), count);
        prop_assert_eq!(&*asked.borrow(), &analyses);
    }

    #[test]
    fn checks_are_exact_solutions((chain, truth) in chain_and_truth()) {
        let settings = Settings { least_passes: 2, most_passes: 2, ..Settings::default() };
        let found = correlate_chain(&chain, &truth, &settings);
        let test = chain.modes(&truth);
        let ones = vec![1.0; truth.len()];
        let checks = std::iter::once((&ones, &found.initial))
            .chain(found.passes.iter().map(|pass| (&pass.factors, &pass.check)));
        for (factors, check) in checks {
            let model = chain.model(factors);
            let expected = error_sum_by_definition(&model.stiffness, &model.mass, &test);
            prop_assert!((check.errors.sum() - expected).abs() <= MATRIX_ROUND_OFF);
            prop_assert_eq!(check.modes.len(), truth.len());
            prop_assert_eq!(check.frequencies_hz.len(), truth.len());
            let all = check.modes.frequencies_hz();
            for (frequency, &i) in check.frequencies_hz.iter().zip(&check.pairing.analysis_mode) {
                prop_assert_eq!(*frequency, all[i]);
            }
        }
    }

    #[test]
    fn where_b_never_changes_the_check_confirms_the_inner_loop((chain, truth) in chain_and_truth()) {
        // By eigensolutions: the recursion stops at 60 orders, which a large step among close modes may not be enough for.
        let inner = InnerSettings { update: UpdateRule::Eigensolution, ..InnerSettings::default() };
        let settings = Settings { inner, least_passes: 3, ..Settings::default() };
        for pass in correlate_chain(&chain, &truth, &settings).passes {
            let difference = pass.check.errors.sum() - pass.inner.last.errors.sum();
            prop_assert!(difference.abs() <= CONVERGED_STATE, "{difference:e}");
        }
    }

    #[test]
    fn the_best_factors_have_the_lowest_exact_error_sum(
        (chain, truth) in chain_and_truth(),
        settings in settings(),
    ) {
        let found = correlate_chain(&chain, &truth, &settings);
        let best = found.best_factors();
        prop_assert_eq!(best.len(), truth.len());
        let test = chain.modes(&truth);
        let sum = |factors: &[f64]| check(&chain.model(factors), &test, truth.len()).unwrap().errors.sum();
        let lowest = sum(&best);
        prop_assert!(lowest <= found.initial.errors.sum());
        for pass in &found.passes {
            prop_assert!(lowest <= pass.check.errors.sum());
        }
        let known = best.iter().all(|&factor| factor == 1.0)
            || found.passes.iter().any(|pass| pass.factors == best);
        prop_assert!(known);
    }

    #[test]
    fn total_limits_hold_over_all_passes(
        (chain, truth) in chain_and_truth(),
        bounds in prop::collection::vec((0.8..0.95_f64, 1.05..1.2_f64), 5),
    ) {
        let ranges: Vec<Option<Range>> = bounds[..truth.len()]
            .iter()
            .map(|&(lower, upper)| Some(Range { lower, upper }))
            .collect();
        let settings = Settings { least_passes: 3, most_passes: 3, ..Settings::default() };
        let found = correlate(
            |factors| Ok(chain.model(factors)),
            &chain.modes(&truth),
            &ranges,
            &settings,
            |_, _| {},
        )
        .unwrap();
        for pass in found.passes {
            for (factor, (lower, upper)) in pass.factors.iter().zip(&bounds) {
                prop_assert!(*factor >= lower * (1.0 - ROUND_OFF));
                prop_assert!(*factor <= upper * (1.0 + ROUND_OFF));
            }
        }
    }
}

#[test]
fn a_model_that_is_right_needs_no_pass() {
    let chain = Chain::uniform(3);
    let settings = Settings {
        least_passes: 0,
        ..Settings::default()
    };
    let found = correlate_chain(&chain, &[1.0; 3], &settings);
    assert!(found.converged);
    assert!(found.passes.is_empty());
    assert_eq!(found.best_factors(), [1.0; 3]);
}

#[test]
fn a_pass_without_a_step_is_the_last() {
    let settings = Settings {
        least_passes: 3,
        ..Settings::default()
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.0; 3], &settings);
    assert_eq!(found.passes.len(), 1);
    assert!(found.converged);
    let pass = &found.passes[0];
    assert_eq!(pass.inner.stop, Stop::LocalMinimum);
    assert!(pass.inner.iterations.is_empty());
    assert_eq!(pass.factors, [1.0; 3]);
    assert_eq!(found.best_factors(), [1.0; 3]);
}

#[test]
fn every_tolerance_counts() {
    // One pass; the errors it leaves meet every tolerance just above them, and none just below any one.
    let (chain, truth) = (Chain::uniform(3), [1.3, 0.8, 1.1]);
    let once = |change: &dyn Fn(&mut Settings)| {
        let mut settings = Settings {
            most_passes: 1,
            ..Settings::default()
        };
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
    assert!(within(1.0, 1.0, 1.0));
    assert!(!within(0.99, 1.0, 1.0));
    assert!(!within(1.0, 0.99, 1.0));
    assert!(!within(1.0, 1.0, 0.99));
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
    let found = correlate_chain(&chain, &[1.4, 0.8, 1.2, 0.7], &settings);
    let sums: Vec<f64> = found
        .passes
        .iter()
        .map(|pass| pass.inner.last.errors.sum())
        .collect();
    assert!(sums[0] < 0.1 && sums[0] > 0.02);
    assert!(sums[1] < 0.02);
    assert!(found.passes.iter().all(|pass| pass.inner.stop == Stop::Tolerance));
}

#[test]
fn the_most_passes_have_the_last_word() {
    let settings = Settings {
        least_passes: 5,
        most_passes: 2,
        ..Settings::default()
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.3, 0.8, 1.1], &settings);
    assert_eq!(found.passes.len(), 2);
    let none = Settings {
        most_passes: 0,
        ..settings
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.3, 0.8, 1.1], &none);
    assert!(found.passes.is_empty() && !found.converged);
    assert_eq!(found.best_factors(), [1.0; 3]);
}

#[test]
fn analysis_modes_may_be_fewer_than_degrees_of_freedom() {
    let chain = Chain::uniform(5);
    let test = chain.modes(&[1.2, 0.9, 1.1, 1.0, 0.8]).lowest(2).unwrap();
    let with = |analysis_modes| {
        let settings = Settings {
            analysis_modes,
            ..Settings::default()
        };
        correlate(|factors| Ok(chain.model(factors)), &test, &[None; 5], &settings, |_, _| {}).unwrap()
    };
    let some = with(Some(3));
    assert_eq!(some.initial.modes.shapes.shape(), (5, 3));
    assert_eq!(some.passes[0].check.modes.len(), 3);
    assert_eq!(some.passes[0].inner.last.generalized_shapes.shape(), (3, 3));
    assert_eq!(some.initial.errors.mode_count, 2);
    let all = with(None);
    assert_eq!(all.initial.modes.shapes.shape(), (5, 5));
    assert_eq!(all.passes[0].inner.last.generalized_shapes.shape(), (5, 5));
    // Exact errors at the start do not depend on modes beyond those paired.
    assert_eq!(some.initial.errors, all.initial.errors);
}

#[test]
fn frequencies_stand_in_the_order_of_the_test_modes() {
    let chain = Chain::uniform(3);
    let mut test = chain.modes(&[1.0; 3]);
    test.omega_squared.swap_rows(0, 2);
    test.shapes.swap_columns(0, 2);
    let found = check(&chain.model(&[1.0; 3]), &test, 3).unwrap();
    assert_eq!(found.pairing.analysis_mode, [2, 1, 0]);
    assert_eq!(found.frequencies_hz, test.frequencies_hz());
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
    assert_eq!(settings.analysis_modes, None);
}

#[test]
fn the_box_needs_a_second_pass_because_b_was_frozen() {
    let case = Case::new(1).unwrap();
    let model = case.model().unwrap();
    let test = case.test_modes().unwrap();
    let ranges = model.factor_ranges().unwrap();
    let found = correlate(|f| model.analyze(f), &test, &ranges, &case.settings, |_, _| {}).unwrap();
    let [first, second] = &found.passes[..] else {
        panic!("{} passes", found.passes.len());
    };
    // The exact check of the first pass shows more error than its inner loop; the second, hardly changed, does not.
    assert!(first.check.errors.sum() > 1.5 * first.inner.last.errors.sum());
    assert!(second.check.errors.sum() < 1.1 * second.inner.last.errors.sum());
    // Each pass begins with a new exact solution.
    assert!((second.inner.start.sum() - first.check.errors.sum()).abs() <= MATRIX_ROUND_OFF);
    assert_eq!(found.best_factors(), second.factors);
}

#[test]
fn the_first_pass_is_the_inner_loop_from_the_first_model() {
    let (chain, truth) = (Chain::uniform(3), [1.3, 0.8, 1.1]);
    let found = correlate_chain(&chain, &truth, &Settings::default());
    let problem = chain_problem(&chain, &truth);
    let inner = run(&problem, &[1.0; 3], &[None; 3], &InnerSettings::default()).unwrap();
    assert_eq!(found.passes[0].inner.last.factors, inner.last.factors);
    assert_eq!(found.initial.errors, inner.start);
    let unit: DMatrix<f64> = DMatrix::identity(3, 3);
    assert_eq!(problem.start_state().unwrap().generalized_shapes, unit);
}
