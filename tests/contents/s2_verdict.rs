//! The verdict on a correlation.

use crate::common::jobs::run;
use crate::paper::words::verdict_in_words;
use crate::prelude::*;

const TRUTH: [f64; 3] = [1.3, 0.8, 1.1];

fn chain_with(change: impl Fn(&mut Settings)) -> (Correlation, Verdict) {
    let mut settings = Settings::default();
    change(&mut settings);
    judged(&Chain::uniform(3), &TRUTH, &settings)
}

/// A chain's correlation by settings for nine modes, and the verdict on it.
fn judged(chain: &Chain, truth: &[f64], settings: &Settings) -> (Correlation, Verdict) {
    let found = correlate_chain(chain, truth, &settings.for_modes(truth.len()));
    let free = vec![None; truth.len()];
    let verdict = verdict_of(&found, &chain_problem(chain, truth), &free);
    (found, verdict)
}

#[test]
fn every_outcome_is_said_as_what_it_is() {
    let (_, within) = chain_with(|_| {});
    assert_eq!((within.end, within.is_within), (End::Tolerance, true));
    assert!(verdict_in_words(&within, &[], &[]).starts_with("Correlated: error sum "));
    let (_, capped) = chain_with(|settings| {
        settings.most_passes = 1;
        settings.inner.iterations = 1;
    });
    assert_eq!((capped.end, capped.is_within), (End::Cap, false));
    assert!(verdict_in_words(&capped, &[], &[]).contains("Try more iterations or passes."));
    let (_, none) = chain_with(|settings| settings.most_passes = 0);
    assert_eq!((none.end, none.is_within), (End::Nothing, false));
    assert!(verdict_in_words(&none, &[], &[]).contains("No step from the first model lowered it"));
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
        &settings.for_modes(3),
        |_, _| true,
    )
    .unwrap();
    let held = verdict_of(&held, &chain_problem(&chain, &TRUTH), &ranges);
    assert_eq!((held.end, held.is_within), (End::LocalMinimum, false));
    assert_eq!(held.at_bound, [0]);
    let words = verdict_in_words(
        &held,
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
    let (_, found) = judged(&Chain::uniform(3), &[1.0; 3], &settings);
    assert_eq!((found.end, found.is_within), (End::LocalMinimum, true));
}

/// A frequency without a shape sees of a parameter what part of its mode's stiffness it has, whatever the unit.
#[test]
fn what_no_frequency_without_a_shape_sees_is_unseen() {
    // Beside the first of three springs one a hundred-thousandth as stiff.
    let parts = [(0, 1e5), (1, 1e5), (2, 1e5), (0, 1.0)];
    let parts = parts.map(|(spring, stiffness)| spring_stiffness(3, spring, stiffness));
    let mass = eye(3);
    let modes = solve(&parts.iter().sum(), &mass, 3).unwrap();
    // The first mode, and the third's frequency.
    let squares = modes.omega_squared();
    let squares = dvector![squares[0], 1.01_f64.powi(2) * squares[2]];
    let test = Modes::new(squares, modes.shapes().columns(0, 2).into_owned()).unwrap();
    let files = of_matrices(&parts, &mass, &test);
    let files = with(
        files,
        "job.toml",
        "file = \"test.csv\"",
        "file = \"test.csv\"\npartners = [0, 3]\n[compare]\nanalysis_modes = 3",
    );
    let found = of_job(&without_last_shape(files));
    assert_eq!(found.found.prepared.modes, [0]);
    assert_eq!(found.verdict.unseen, [3]);
}

/// Files of a job whose test has no shape in its last column.
fn without_last_shape(mut files: Files) -> Files {
    let (_, test) = files
        .iter_mut()
        .find(|(name, _)| name == "test.csv")
        .unwrap();
    let cut = |line: &str| match line.starts_with(|first: char| first.is_ascii_digit()) {
        true => line.rsplit_once(',').unwrap().0.to_owned() + ",\n",
        false => line.to_owned() + "\n",
    };
    *test = test.lines().map(cut).collect();
    files
}

fn of_job(files: &Files) -> JobResult {
    let (_folder, path) = placed(files);
    prepare(&path)
        .and_then(|loaded| run(&loaded, |_| {}, || true))
        .unwrap()
}

/// A job's tolerances are for sums over nine modes, whatever the number compared, and so is the sum that its verdict tells.
#[test]
fn a_job_tells_the_error_sum_that_nine_modes_would_have() {
    let method = "[compare]\nmethod = \"paper\"";
    let found = of_job(&with(building(), "job.toml", "[compare]", method));
    let History::Paper(run) = &found.found.history else {
        panic!("{:?}", found.found.history)
    };
    let sum = 3.0 / 5_f64.sqrt() * run.best_check().errors.sum();
    assert!(relative_error(found.verdict.error_sum, sum) <= ROUND_OFF);
    assert_eq!(found.verdict.is_within, run.converged);
}

#[test]
fn the_worst_mode_and_its_errors_are_those_of_the_error_sum() {
    let (found, verdict) = chain_with(|settings| settings.inner.iterations = 2);
    let best = found.best_check();
    let test = Chain::uniform(3).modes(&TRUTH);
    let each = mode_errors(&best.modes, &best.pairing, &test).unwrap();
    let whole = errors(&best.modes, &best.pairing, &test).unwrap();
    let sum = |of: fn(&ModeError) -> f64| each.iter().map(|e| of(e).powi(2)).sum::<f64>().sqrt();
    assert_within(sum(|e| e.frequency), whole.frequency, ROUND_OFF);
    assert_within(sum(|e| e.shape), whole.shape, ROUND_OFF);
    let size = |mode: usize| each[mode].frequency.powi(2) + each[mode].shape.powi(2);
    assert!((0..3).all(|mode| size(mode) <= size(verdict.worst_mode)));
    let (worst, expected) = (verdict.worst, each[verdict.worst_mode]);
    assert_within(worst.frequency, expected.frequency, ROUND_OFF);
    assert_within(worst.shape.unwrap(), expected.shape, ROUND_OFF);
}

properties! {
    /// Of frequency and shape together: the one may be large where the other is small.
    #[test]
    fn no_mode_of_the_first_model_is_worse_than_the_worst((chain, truth) in chain_and_truth()) {
        let settings = Settings { most_passes: 0, ..Settings::default() };
        let (found, verdict) = judged(&chain, &truth, &settings);
        let each = mode_errors(&found.initial.modes, &found.initial.pairing, &chain.modes(&truth))?;
        let size = |error: &ModeError| error.frequency.powi(2) + error.shape.powi(2);
        let worst = size(&each[verdict.worst_mode]);
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
        let soft = 1e-3 * factors[3] * &model.shares[1];
        model.stiffness += &soft;
        model.shares.push(soft);
        model.analyze(&test, None)
    };
    let settings = Settings::default().for_modes(3);
    let found = correlate(analyze, &[None; 4], &settings, |_, _| true).unwrap();
    let found = verdict_of(&found, &analyze(&[1.0; 4]).unwrap(), &[None; 4]);
    assert_eq!(found.unseen, [3]);
    assert!(
        verdict_in_words(&found, &[], &[])
            .contains("Hardly seen by the test modes, and so not to be trusted: 4.")
    );
}

#[test]
fn case_4_is_never_called_within_tolerance() {
    let result = case_run(&case_of(4));
    let verdict = Verdict::of_case(&result);
    assert_eq!((verdict.end, verdict.is_within), (End::Cap, false));
    assert!(!result.correlation.converged);
}
