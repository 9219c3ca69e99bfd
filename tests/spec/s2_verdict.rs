//! What a correlation says it came to.

use crate::common::loops::correlate_chain;
use crate::common::tolerances::ROUND_OFF;
use crate::common::vibrations::{Chain, chain_and_truth};
use crate::common::whole_models::{masses, seen_by, sensors_at, springs};
use corfem::method::error_sum::{ModeError, errors, mode_errors};
use corfem::method::model::{Bounds, LoneFrequency};
use corfem::method::outer_loop::{Correlation, Settings, correlate};
use corfem::method::pairing::pair_modes;
use corfem::method::verdict::{Outcome, Verdict};
use corfem::present::verdict::verdict_in_words;
use corfem::sparse::{WholeModel, WholeParameter, WholeShare};
use corfem::torque_box::{Case, run_case};
use proptest::prelude::*;

const TRUTH: [f64; 3] = [1.3, 0.8, 1.1];

fn chain_with(change: impl Fn(&mut Settings)) -> Correlation {
    let mut settings = Settings::default();
    change(&mut settings);
    correlate_chain(&Chain::uniform(3), &TRUTH, &settings)
}

#[test]
fn every_outcome_is_said_as_what_it_is() {
    let within = chain_with(|_| {}).verdict;
    assert_eq!(
        (within.outcome, within.is_within),
        (Outcome::Tolerance, true)
    );
    assert!(verdict_in_words(&within, None, &[], &[]).starts_with("Correlated: error sum "));
    let capped = chain_with(|settings| {
        settings.most_passes = 1;
        settings.inner.iterations = 1;
    });
    assert_eq!(
        (capped.verdict.outcome, capped.verdict.is_within),
        (Outcome::Cap, false)
    );
    assert!(
        verdict_in_words(&capped.verdict, None, &[], &[])
            .contains("Try more iterations or passes.")
    );
    let none = chain_with(|settings| settings.most_passes = 0);
    assert_eq!(
        (none.verdict.outcome, none.verdict.is_within),
        (Outcome::Nothing, false)
    );
    assert!(
        verdict_in_words(&none.verdict, None, &[], &[])
            .contains("No step from the first model lowered it")
    );
    // Bounds that hold the truth out end in a local minimum at the bound.
    let (chain, ranges) = (
        Chain::uniform(3),
        [
            Some(Bounds {
                lower: 0.9,
                upper: 1.1,
            }),
            None,
            None,
        ],
    );
    let test = chain.modes(&TRUTH);
    let settings = Settings {
        error_sum_tolerance: 1e-3,
        ..Settings::default()
    };
    let held = correlate(
        |factors| chain.model(factors).analyze(&test, None),
        &ranges,
        &settings,
        |_, _| {},
    )
    .unwrap();
    assert_eq!(
        (held.verdict.outcome, held.verdict.is_within),
        (Outcome::LocalMinimum, false)
    );
    assert_eq!(held.verdict.at_bound, [0]);
    let words = verdict_in_words(
        &held.verdict,
        None,
        &["wall".to_owned(), "b".to_owned(), "c".to_owned()],
        &[],
    );
    assert!(
        words.starts_with("Outside tolerance")
            && words.contains("No further step lowered it.")
            && words.contains("At a bound: wall.")
    );
}

#[test]
fn a_right_model_that_is_stepped_once_is_a_local_minimum_within_tolerance() {
    let settings = Settings {
        least_passes: 1,
        ..Settings::default()
    };
    let found = correlate_chain(&Chain::uniform(3), &[1.0; 3], &settings).verdict;
    assert_eq!(
        (found.outcome, found.is_within),
        (Outcome::LocalMinimum, true)
    );
}

/// A frequency without a shape sees of a parameter what part of its mode's stiffness it has, whatever the unit.
#[test]
fn what_no_frequency_without_a_shape_sees_is_unseen() {
    // Beside the first of three springs one a hundred-thousandth as stiff.
    let all = [
        (0, None, 1e5),
        (1, Some(0), 1e5),
        (2, Some(1), 1e5),
        (0, None, 1.0),
    ];
    let parameters = all.iter().enumerate().map(|(e, one)| WholeParameter {
        name: format!("spring {e}"),
        share: WholeShare::Stiffness(springs(3, &[*one])),
        range: None,
    });
    let model = WholeModel::new(springs(3, &all), masses(&[1.0; 3]), parameters.collect()).unwrap();
    let sensors = sensors_at(&[0, 1, 2], 3);
    let modes = model.modes(&[1.0; 4], 3).unwrap().vibrations;
    let lone = LoneFrequency {
        frequency_hz: 1.01 * modes.frequencies_hz()[2],
        partner: 2,
    };
    let test = seen_by(&sensors, &model.modes(&[1.0; 4], 1).unwrap().vibrations);
    let analyze = |factors: &[f64]| {
        model
            .analyze(factors, &sensors, (&test, pair_modes as _), [3, 0])?
            .with_lone_frequencies(vec![lone])
    };
    let settings = Settings {
        most_passes: 0,
        ..Settings::default()
    };
    let found = correlate(analyze, &[None; 4], &settings, |_, _| {}).unwrap();
    assert_eq!(found.verdict.unseen, [3]);
}

fn shape(error: &ModeError) -> f64 {
    error.shape.expect("a shape")
}

#[test]
fn the_worst_mode_and_its_errors_are_those_of_the_error_sum() {
    let found = chain_with(|settings| settings.inner.iterations = 2);
    let best = found
        .best
        .map_or(&found.initial, |pass| &found.passes[pass].check);
    let test = Chain::uniform(3).modes(&TRUTH);
    let each = mode_errors(&best.modes, &best.pairing, &test).unwrap();
    let whole = errors(&best.modes, &best.pairing, &test).unwrap();
    let sum = |of: fn(&corfem::method::error_sum::ModeError) -> f64| {
        each.iter().map(|e| of(e).powi(2)).sum::<f64>().sqrt()
    };
    assert!((sum(|e| e.frequency) - whole.frequency).abs() <= ROUND_OFF);
    assert!((sum(shape) - whole.shape).abs() <= ROUND_OFF);
    let size = |mode: usize| each[mode].frequency.powi(2) + shape(&each[mode]).powi(2);
    assert!((0..3).all(|mode| size(mode) <= size(found.verdict.worst_mode)));
    let (worst, expected) = (found.verdict.worst, each[found.verdict.worst_mode]);
    assert!(
        (worst.frequency - expected.frequency).abs() <= ROUND_OFF
            && (shape(&worst) - shape(&expected)).abs() <= ROUND_OFF
    );
}

properties! {
    #![proptest_config(crate::common::config())]

    /// Of frequency and shape together: the one may be large where the other is small.
    #[test]
    fn no_mode_of_the_first_model_is_worse_than_the_worst((chain, truth) in chain_and_truth()) {
        let settings = Settings { most_passes: 0, ..Settings::default() };
        let found = correlate_chain(&chain, &truth, &settings);
        let each = mode_errors(&found.initial.modes, &found.initial.pairing, &chain.modes(&truth)).unwrap();
        let size = |error: &ModeError| error.frequency.powi(2) + shape(error).powi(2);
        let worst = size(&each[found.verdict.worst_mode]);
        prop_assert!(each.iter().all(|error| size(error) <= worst + ROUND_OFF));
    }
}

#[test]
fn an_element_in_no_test_mode_is_named_as_unseen() {
    // A spring a thousand times too soft beside another between the same masses.
    let chain = Chain::uniform(3);
    let test = chain.modes(&[1.3, 0.8, 1.1]);
    let analyze = |factors: &[f64]| {
        let mut model = chain.model(&factors[..3]);
        let soft = model.shares[1].map(|share| 1e-3 * factors[3] * share);
        model.stiffness += soft.matrix();
        model.shares.push(soft);
        model.analyze(&test, None)
    };
    let found = correlate(analyze, &[None; 4], &Settings::default(), |_, _| {}).unwrap();
    assert_eq!(found.verdict.unseen, [3]);
    assert!(
        verdict_in_words(&found.verdict, None, &[], &[])
            .contains("Hardly seen by the test modes, and so not to be trusted: 4.")
    );
}

#[test]
fn case_4_is_never_called_within_tolerance() {
    let result = run_case(&Case::new(4).unwrap(), |_, _| {}).unwrap();
    assert_eq!(
        (
            result.correlation.verdict.outcome,
            result.correlation.converged
        ),
        (Outcome::Cap, false)
    );
}

/// What to try next goes by why the correlation ended, and nothing is to be tried once the model is within tolerance.
#[test]
fn advice_goes_by_the_outcome() {
    let says = |outcome, is_within, at_bound: &[usize]| {
        let worst = ModeError {
            frequency: 0.01,
            shape: Some(0.02),
        };
        let at_bound = at_bound.to_vec();
        verdict_in_words(
            &Verdict {
                outcome,
                is_within,
                error_sum: 0.03,
                worst_mode: 0,
                worst,
                at_bound,
                unseen: Vec::new(),
            },
            None,
            &[],
            &[],
        )
    };
    for (outcome, at_bound, advice) in [
        (Outcome::Cap, vec![0], "Try more iterations or passes."),
        (
            Outcome::Nothing,
            vec![0],
            "Look for a mistake in the test's units",
        ),
        (Outcome::LocalMinimum, vec![0], "Try wider bounds"),
        (Outcome::ShortSteps, vec![0], "need not be a minimum"),
        (
            Outcome::LocalMinimum,
            vec![],
            "Try other parameters or groups",
        ),
    ] {
        let (outside, within) = (
            says(outcome, false, &at_bound),
            says(outcome, true, &at_bound),
        );
        let is_minimum = outside.contains("No further step lowered it");
        assert_eq!(is_minimum, outcome == Outcome::LocalMinimum, "{outside}");
        assert!(outside.contains(advice), "{outside}");
        assert!(
            !within.contains("Try") && !within.contains("Look for"),
            "{within}"
        );
    }
}
