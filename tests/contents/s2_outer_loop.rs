//! The outer loop: exact checks between inner loops, until analysis and test agree or there is no more to try.

use crate::prelude::*;

/// Settings with tolerances from loose to strict and up to four passes, so that loops end for every reason.
fn settings() -> impl Strategy<Value = Settings> {
    (
        (0.01..0.2_f64, 0.01..0.1_f64),
        (0.005..0.3_f64, 0.005..0.3_f64, 0.005..0.3_f64),
        (0..=3_usize, 0..=4_usize, 0..=8_usize),
    )
        .prop_map(
            |(inner, outer, (least_passes, most_passes, iterations))| Settings {
                inner: InnerSettings {
                    tolerance: inner.0,
                    iterations,
                    ..InnerSettings::default()
                },
                later_inner_tolerance: inner.1,
                error_sum_tolerance: outer.0,
                frequency_tolerance: outer.1,
                shape_tolerance: outer.2,
                least_passes,
                most_passes,
            },
        )
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn checks_are_exact_solutions((chain, truth) in chain_and_truth()) {
        let settings = Settings { least_passes: 2, most_passes: 2, ..Settings::default() };
        let found = correlate_chain(&chain, &truth, &settings.for_modes(truth.len()));
        let test = chain.modes(&truth);
        let ones = vec![1.0; truth.len()];
        let checks = once((&ones, &found.initial))
            .chain(found.passes.iter().map(|pass| (&pass.factors, &pass.check)));
        for (factors, check) in checks {
            let model = chain.model(factors);
            let expected = error_sum_by_definition(&model.stiffness, &model.mass, &test);
            prop_assert!((check.errors.sum() - expected).abs() <= MATRIX_ROUND_OFF);
            prop_assert_eq!(check.modes.len(), truth.len());
            let (all, paired) = (check.modes.frequencies_hz(), ExactResult::from(check).frequencies_hz);
            prop_assert_eq!(paired.len(), truth.len());
            for (frequency, &i) in paired.iter().zip(&check.pairing.analysis_mode) {
                prop_assert_eq!(*frequency, all[i]);
            }
        }
    }

    #[test]
    fn where_b_never_changes_the_check_confirms_the_inner_loop((chain, truth) in chain_and_truth()) {
        // By eigensolutions: the recursion stops at 60 orders, which a large step among close modes may not be enough for.
        // One step a pass: changes that several steps add are those of another structure than that of the gages, which multiply.
        let inner = InnerSettings { iterations: 1, ..InnerSettings::default() };
        let settings = Settings { inner, least_passes: 3, ..Settings::default() }.for_modes(truth.len());
        let test = chain.modes(&truth);
        let analyze = |factors: &[f64]| chain.model(factors).analyze(&test, None).map(Eigensolved);
        let found = correlate(analyze, &vec![None; truth.len()], &settings, |_, _| true);
        for pass in found.unwrap().passes {
            let difference = pass.check.errors.sum() - pass.inner.last.errors.sum();
            prop_assert!(difference.abs() <= CONVERGED_STATE, "{difference:e}");
        }
    }

    #[test]
    fn the_best_factors_have_the_lowest_exact_error_sum(
        (chain, truth) in chain_and_truth(),
        settings in settings(),
    ) {
        let settings = settings.for_modes(truth.len());
        let found = correlate_chain(&chain, &truth, &settings);
        let verdict = verdict_of(&found, &chain_problem(&chain, &truth), &vec![None; truth.len()]);
        let best = found.best_factors;
        prop_assert_eq!(best.len(), truth.len());
        let test = chain.modes(&truth);
        let sum = |factors: &[f64]| chain.model(factors).analyze(&test, None).unwrap().exact().errors.sum();
        let lowest = sum(&best);
        // The number that the tolerance is compared with.
        prop_assert_eq!(verdict.error_sum, lowest);
        // Of those within tolerance, if there are any.
        let within = |errors: &Errors| {
            errors.sum() <= settings.error_sum_tolerance
                && errors.frequency <= settings.frequency_tolerance
                && errors.shape <= settings.shape_tolerance
        };
        let all = once(&found.initial).chain(found.passes.iter().map(|pass| &pass.check));
        for check in all.filter(|check| !found.converged || within(&check.errors)) {
            prop_assert!(lowest <= check.errors.sum());
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
        let ranges = bounds[..truth.len()]
            .iter()
            .map(|&(lower, upper)| Some(Bounds { lower, upper }))
            .collect_vec();
        let settings = Settings { least_passes: 3, most_passes: 3, ..Settings::default() };
        let settings = settings.for_modes(truth.len());
        let test = chain.modes(&truth);
        let found = correlate(
            |factors| chain.model(factors).analyze(&test, None),
            &ranges,
            &settings,
            |_, _| true,
        );
        // Where roots are so close that no first step settles there is no pass to look at.
        prop_assume!(!matches!(found, Err(Error::UnsettledRoots { .. })));
        for pass in found?.passes {
            for (factor, (lower, upper)) in pass.factors.iter().zip(&bounds) {
                prop_assert!(*factor >= lower * (1.0 - ROUND_OFF));
                prop_assert!(*factor <= upper * (1.0 + ROUND_OFF));
            }
        }
    }
}

#[test]
fn passes_are_told_by_their_number_from_one() {
    let (chain, truth) = (Chain::uniform(3), [1.3, 0.8, 1.1]);
    let test = chain.modes(&truth);
    let settings = Settings {
        least_passes: 3,
        most_passes: 3,
        ..Settings::default()
    };
    let settings = settings.for_modes(3);
    let analyze = |factors: &[f64]| chain.model(factors).analyze(&test, None);
    let mut told = Vec::new();
    let found = correlate(analyze, &[None; 3], &settings, |number, _| {
        told.push(number);
        true
    });
    let found = found.unwrap();
    let count = found.passes.len();
    assert!(count > 1);
    assert_eq!(told, (1..=count).collect_vec());
    // The caller may end it after any pass, and what was found until then is kept.
    let ended = correlate(analyze, &[None; 3], &settings, |_, _| false);
    let ended = ended.unwrap();
    assert_eq!(ended.passes.len(), 1);
    assert_eq!(ended.passes[0].factors, found.passes[0].factors);
}
