//! What a run of a job comes to: its verdict, what is told on the way, the best so far, bounds from any start, and the deck.

use crate::common::jobs::run;
use crate::common::jobs::said as said_of;
use crate::prelude::*;
use corfem::job::{Study, Vary};
use corfem::present::json;
use corfem::present::page::report_page;
use corfem::present::tables::report::minima_table;
use corfem::weighted::identifiability::PRIOR_DEVIATION;
use std::cell::Cell;

const A: &str = "elements = [1]";
const B: &str = "elements = [\"2-3\"]";
/// Rods 2 and 3 one by one: what the test was made of can be found.
const EACH: &str = "elements = [\"2-3\"]\neach = true";

/// The job with the third frequency of its test two percent higher.
fn third_higher(mut files: Files) -> Files {
    let mut data = prepared(&files).loaded.data.clone();
    data.frequencies_hz[2] *= 1.02;
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    test.expect("a test").1 = write_csv(&data);
    files
}

fn ran(files: &Files) -> JobResult {
    run(&prepared(files), |_| {}, || true).unwrap()
}

/// The job with the first parameter alone, and this rule for it.
fn alone(rule: &str) -> Files {
    let mut files = with(rods(), "job.toml", A, rule);
    let end = files[0].1.rfind("[[parameter]]").expect("two parameters");
    files[0].1.truncate(end);
    files
}

/// The deck with the areas that the test was made of.
fn exact(files: Files) -> Files {
    let own = "CROD,3,3,3,4\nPROD,1,1,.08\nPROD,3,2,.1\n";
    let files = with(files, "model.bdf", "CROD,3,2,3,4\nPROD,1,1,.1\n", own);
    with(files, "model.bdf", "PROD,2,2,.1", "PROD,2,2,.11")
}

#[test]
fn every_rod_is_found_within_tolerance() {
    let found = ran(&with(rods(), "job.toml", B, EACH));
    for (factor, truth) in found.found.factors.iter().zip([0.8, 1.1, 1.0]) {
        assert!(
            relative_error(factor, truth) < WEIGHTED_FACTOR,
            "{:?}",
            found.found.factors
        );
    }
    assert_eq!(
        (found.verdict.outcome, found.verdict.is_within),
        (Outcome::Tolerance, true)
    );
}

#[test]
fn several_starts_name_their_minima_in_every_output() {
    let files = with(rods(), "job.toml", "[compare]", "[compare]\nstarts = 4");
    let found = ran(&files);
    let report = Report::from_job(&found.found.prepared, Some(&found)).expect("a report");
    let table = minima_table(&report).expect("minima");
    let labels: Vec<&str> = table.rows.iter().map(|row| &row.label[..]).collect();
    assert_eq!(labels, ["chi-squared", "starts", "a", "b"]);
    let text = render::text(from_ref(&table));
    assert!(text.contains("Minima that noise allows"), "{text}");
    let document = json::report(&report).expect("a document");
    let minima = document["minima"].as_array().expect("minima");
    let starts = minima
        .iter()
        .map(|of| of["starts"].as_u64().expect("a count"));
    assert_eq!((minima.len(), starts.sum::<u64>()), (1, 4));
    assert_eq!(
        minima[0]["factors"][0].as_f64(),
        Some(found.found.factors[0])
    );
    let misfit = found.misfit.chi_squared;
    let chi_squared = minima[0]["chi_squared"].as_f64().expect("a number");
    assert!(relative_error(chi_squared, misfit) < MATRIX_ROUND_OFF);
    let page = report_page(&report, &[table], "corfem correlate job.toml", "").expect("a page");
    assert!(page.contains("Minima that noise allows"));
    assert!(text.contains("0 starts failed.") && document["failed_starts"] == 0);
    let mut failing = found;
    if let History::GaussNewton(Some(steps)) = &mut failing.found.history {
        steps.starts = vec![None; 2];
    }
    let report = Report::from_job(&failing.found.prepared, Some(&failing)).expect("a report");
    let table = minima_table(&report).expect("minima");
    assert!(render::text(from_ref(&table)).contains("2 starts failed."));
    assert_eq!(
        json::report(&report).expect("a document")["failed_starts"],
        2
    );
    let page = report_page(&report, &[table], "corfem correlate job.toml", "").expect("a page");
    assert!(page.contains("2 starts failed."));
    let one = ran(&rods());
    let report = Report::from_job(&one.found.prepared, Some(&one)).expect("a report");
    assert!(minima_table(&report).is_none());
}

/// A test is no test where any model would pass: with fewer numbers than factors, with so few that three times the noise would rather be
/// overlooked, and with weights that let everything be.
#[test]
fn a_test_that_no_model_can_fail_confirms_nothing() {
    let outcome = |entries: &str| {
        let files = with(exact(rods()), "job.toml", "[compare]", entries);
        let found = ran(&files);
        let words = Report::from_job(&found.found.prepared, Some(&found))
            .expect("a report")
            .words();
        (found.verdict.outcome, found.verdict.is_within, words)
    };
    let weights = |of: &str, weight: &str| format!("{of}_weights = [{weight}, {weight}, {weight}]");
    let hidden = format!(
        "[compare]\n{}\n{}",
        weights("frequency", "1e-3"),
        weights("shape", "1e-3")
    );
    let one = "[compare]\nfrequency_weights = [1, 0, 0]\nshape_weights = [0, 0, 0]";
    let two = "[compare]\nfrequency_weights = [1, 1, 0]\nshape_weights = [0, 0, 0]\nprior_deviation = 1e-6";
    for (entries, reason) in [
        (
            &hidden[..],
            "a model with every frequency half off and other shapes would pass",
        ),
        (one, "the fit leaves less than one number over"),
        (two, "so few numbers would show 46 %"),
    ] {
        let (outcome, is_within, words) = outcome(entries);
        assert_eq!((outcome, is_within), (Outcome::Untested, false), "{words}");
        assert!(
            words.contains(reason) && words.contains("Nothing to judge by"),
            "{words}"
        );
        assert!(words.contains("the test confirms nothing"), "{words}");
    }
    let (outcome, is_within, words) = outcome("[compare]");
    assert_eq!((outcome, is_within), (Outcome::Tolerance, true), "{words}");
}

/// A mode that is held out has no part in the factors, however wrong its frequency, and is told of.
#[test]
fn a_mode_held_out_is_compared_and_not_fitted() {
    let held = |files: Files| with(files, "job.toml", "[test]", "[test]\nhold_out = [3]");
    let one = ran(&held(rods()));
    let off = ran(&held(third_higher(rods())));
    for (own, other) in one.found.factors.iter().zip(&off.found.factors) {
        assert!(relative_error(own, other) < ROUND_OFF);
    }
    let said = |found: &JobResult| {
        found
            .trust
            .of(Kind::HeldOut)
            .next()
            .cloned()
            .expect("it is said")
    };
    let (right, wrong) = (said(&one), said(&off));
    assert_eq!(
        (&right.about[..], right.measure.len()),
        (&["3".to_owned()][..], 4)
    );
    let apart = (1.0 + right.measure[1] / 100.0) / (1.0 + wrong.measure[1] / 100.0);
    assert!((apart - 1.02).abs() < 1e-6, "{apart}");
    assert!(ran(&rods()).trust.of(Kind::HeldOut).next().is_none());
    for (modes, says) in [
        ("[4]", "mode 4 is none of the test modes"),
        ("[1, 2, 3]", "a mode at least must be left"),
        ("[1, 1]", "named twice"),
    ] {
        let files = with(
            rods(),
            "job.toml",
            "[test]",
            &format!("[test]\nhold_out = {modes}"),
        );
        let words = said_of(&files);
        assert!(words.contains(says), "{words}");
    }
}

/// The test without its second mode: the model's is named, with its frequency.
#[test]
fn modes_of_the_model_that_no_test_mode_answers_are_said() {
    let unanswered = |entry: &str| {
        let found = ran(&with(rods(), "job.toml", "[test]", entry));
        let before = trust_in(&found.found.prepared);
        let [before, after] = [&before, &found.trust].map(|trust| trust.about(Kind::Unanswered));
        assert_eq!(before.len(), after.len());
        after
    };
    assert_eq!(unanswered("[test]"), Vec::<String>::new());
    let named = unanswered("[test]\nmodes = [1, 3]");
    assert!(
        named.len() == 1 && named[0].starts_with("mode 2 ("),
        "{named:?}"
    );
    // Beyond the last one nothing is missing.
    assert_eq!(unanswered("[test]\nmodes = [1, 2]"), Vec::<String>::new());
}

/// Exact modes leave residuals of nothing, which noise would not.
#[test]
fn residuals_that_noise_would_not_leave_are_said() {
    let below = |files: &Files| ran(files).trust.of(Kind::BelowNoise).next().is_some();
    assert!(below(&exact(rods())));
    assert!(!below(&alone(B)));
}

/// Interval ends, residuals by sensor and mode, and how every start ended stand in the document.
#[test]
fn the_document_has_the_ends_of_intervals_the_residuals_and_how_starts_ended() {
    let found = ran(&with(
        rods(),
        "job.toml",
        "[compare]",
        "[compare]\nstarts = 3",
    ));
    let report = Report::from_job(&found.found.prepared, Some(&found)).expect("a report");
    let document = json::report(&report).expect("a document");
    for (said, interval) in document["intervals"]
        .as_array()
        .expect("a list")
        .iter()
        .zip(&found.intervals)
    {
        match interval {
            Ok(ends) => {
                assert_eq!(said["lower"].as_f64(), Some(ends.lower));
                assert_eq!(said["upper"].as_f64(), Some(ends.upper));
            }
            Err(_) => assert!(said["withheld"].is_string(), "{said}"),
        }
    }
    let all = residuals(&found.found.last, &found.found.prepared.weights()).unwrap();
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let told: Vec<f64> = document["residuals"]
        .as_array()
        .expect("a list")
        .iter()
        .flat_map(|mode| {
            let shape = mode["shape"].as_array().expect("a list").iter().map(number);
            std::iter::once(number(&mode["frequency"]))
                .chain(shape)
                .collect_vec()
        })
        .collect();
    assert_eq!(told, all.as_slice());
    let starts = document["starts"].as_array().expect("a list");
    assert_eq!(starts.len(), 3);
    assert!(
        starts
            .iter()
            .all(|start| start["stop"] == "gradient" && start["analyses"].as_u64() > Some(1))
    );
}

/// Without a step because none is needed, without a step because none is possible, and after the best that one factor can do.
#[test]
fn a_verdict_tells_what_is_good_from_what_cannot_be_better() {
    let outcome = |files: &Files| {
        let found = ran(files);
        let History::GaussNewton(Some(steps)) = found.found.history else {
            panic!("by steps")
        };
        assert_eq!(
            found.verdict.is_within,
            found.verdict.outcome == Outcome::Tolerance
        );
        (found.verdict.outcome, steps.best.iterations.is_empty())
    };
    assert_eq!(outcome(&exact(rods())), (Outcome::Tolerance, true));
    assert_eq!(
        outcome(&alone("elements = [1]\nlower = 1.0\nupper = 2.0")),
        (Outcome::Nothing, true)
    );
    assert_eq!(outcome(&alone(B)), (Outcome::LocalMinimum, false));
}

fn intervals(found: &JobResult) -> Vec<Result<Bounds, Withheld>> {
    found.intervals.clone()
}

#[test]
fn no_interval_stands_where_the_papers_rule_stops() {
    let paper = with(rods(), "job.toml", "gauss_newton", "paper");
    let found = ran(&paper);
    assert!(matches!(found.found.history, History::Paper(_)));
    let withheld = Err(Withheld::NoOptimum);
    assert!(intervals(&found).iter().all(|one| *one == withheld));
    let said = found.trust.all().iter().map(Concern::words);
    assert!(
        said.into_iter()
            .any(|words| words.contains("minimum of weighted steps alone"))
    );
}

#[test]
fn no_interval_stands_at_a_bound() {
    let found = ran(&alone("elements = [1]\nlower = 1.0\nupper = 2.0"));
    assert_eq!(found.verdict.at_bound, [0]);
    assert_eq!(intervals(&found), [Err(Withheld::AtBound)]);
}

/// A prior of a millionth leaves its factor at one and keeps all of its variance; the others have the job's, and these the test decides.
#[test]
fn a_prior_is_the_parameters_own_or_that_of_all() {
    let files = with(rods(), "job.toml", B, EACH);
    let of_all = "[compare]\nprior_deviation = 0.5";
    let files = with(files, "job.toml", "[compare]", of_all);
    let found = ran(&with(
        files,
        "job.toml",
        A,
        "elements = [1]\nprior_deviation = 1e-6",
    ));
    assert_eq!(found.found.prepared.loaded.source.priors, [1e-6, 0.5, 0.5]);
    let seen = &found.seen;
    assert!((found.found.factors[0] - 1.0).abs() < 1e-6 && seen.learned[0] < 1e-3);
    for e in [1, 2] {
        let kept = (seen.deviations[e] / 0.5).powi(2);
        assert!((seen.learned[e] - (1.0 - kept)).abs() < ROUND_OFF && seen.learned[e] > 0.9);
    }
    let remarks = found.trust.all().iter().map(Concern::words);
    let said = "Known more from the prior than from the test: a.";
    assert!(remarks.into_iter().any(|words| words == said));
    assert_eq!(found.intervals[0], Err(Withheld::MostlyPrior));
}

/// What is weighed otherwise than by its deviation is said, and an entry that only the other method reads is not passed over.
#[test]
fn own_weights_and_the_papers_settings_are_said() {
    let words = |entries: &str| -> String {
        let files = with(rods(), "job.toml", "[compare]", entries);
        ran(&files).trust.all().iter().map(Concern::words).collect()
    };
    for (entries, divides, unused) in [
        ("[compare]", false, false),
        ("[compare]\nshape_weights = [1, 0, 1]", false, false),
        ("[compare]\nshape_weights = [1, 2, 1]", true, false),
        ("[correlation]\nmost_passes = 3\n[compare]", false, true),
    ] {
        let words = words(entries);
        assert_eq!(
            words.contains("weights count as dividing"),
            divides,
            "{words}"
        );
        assert_eq!(
            words.contains("correlation.most_passes (of the paper"),
            unused,
            "{words}"
        );
    }
}

/// One factor for rods that are 0.8 and 1.1 of the model's: no factor explains the test. The deviation that is told has the residuals in
/// it, and the prior as it is.
#[test]
fn an_interval_is_that_of_as_much_noise_as_there_is() {
    let found = ran(&alone(B));
    let times = found.misfit.times_the_noise().unwrap();
    assert!(times > 1.0 && !found.misfit.is_by_noise(), "{times}");
    let interval = intervals(&found)[0].expect("an optimum");
    let wide = 2.0 * NORMAL_95 * found.seen.deviations[0];
    let slopes = jacobian(&found.found.last, &found.found.prepared.weights()).unwrap();
    let alone = (times / slopes.norm()).powi(-2) + PRIOR_DEVIATION.powi(-2);
    assert!((alone.sqrt() * found.seen.deviations[0] - 1.0).abs() < MATRIX_ROUND_OFF);
    let found = (interval.upper / interval.lower).ln();
    assert!((found - wide).abs() < ROUND_OFF * wide, "{found} {wide}");
}

/// Ten stories from five floors and five modes, with the noise that the weights assume.
#[test]
fn the_chi_squared_of_a_right_model_is_its_degrees_of_freedom_in_the_mean() {
    let files = with(
        building(),
        "job.toml",
        "[compare]\n",
        "[compare]\nmethod = \"gauss_newton\"\n",
    );
    let loaded = prepared(&files);
    let exact = Modes::from_measured(
        &loaded.loaded.data.frequencies_hz,
        &loaded.loaded.data.shapes,
    )
    .unwrap();
    let noise: Vec<_> = (0..exact.len())
        .map(|mode| loaded.loaded.deviations(mode))
        .collect();
    let [mut chi_squared, mut degrees] = [0.0; 2];
    for seed in 0..300 {
        let noisy = with_noise_by_mode(&exact, &noise, seed).unwrap();
        let mut data = loaded.loaded.data.clone();
        (data.frequencies_hz, data.shapes) = (noisy.frequencies_hz(), noisy.shapes().clone());
        let mut files = files.clone();
        let test = files.iter_mut().find(|(name, _)| name == "test.csv");
        test.expect("a test").1 = write_csv(&data);
        let misfit = ran(&files).misfit;
        chi_squared += misfit.chi_squared;
        degrees += misfit.degrees_of_freedom;
    }
    let mean = chi_squared / degrees;
    assert!((mean - 1.0).abs() < MEAN_MISFIT, "{mean}");
}

/// Told are falling sums alone, and when it is stopped, the last of them is that of the factors it gives.
#[test]
fn a_stopped_correlation_gives_the_best_that_it_has_told() {
    let prepared = prepared(&with(rods(), "job.toml", B, EACH));
    let stopped_after = |most: usize| {
        let (mut told, asked) = (Vec::new(), Cell::new(0));
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() < most
        };
        let found = run(&prepared, |words| told.push(words.to_owned()), go_on).unwrap();
        assert!(
            found.found.is_interrupted && matches!(found.found.history, History::GaussNewton(None))
        );
        let sum = residuals(&found.found.last, &prepared.weights())
            .expect("residuals")
            .norm_squared();
        assert_eq!(told.last(), Some(&format!("sum of squares {sum:.4e}")));
        let number = |words: &String| {
            words
                .rsplit(' ')
                .next()
                .and_then(|word| word.parse().ok())
                .expect("a number")
        };
        let told: Vec<f64> = told.iter().map(number).collect();
        assert!(told.windows(2).all(|pair| pair[1] < pair[0]), "{told:?}");
        (told.len(), found)
    };
    let (count, first) = stopped_after(1);
    assert_eq!(
        (count, &first.found.factors[..], first.verdict.outcome),
        (1, &[1.0; 3][..], Outcome::Request)
    );
    let (count, second) = stopped_after(2);
    assert!(
        count > 1 && second.found.factors != first.found.factors,
        "{count} told"
    );
    let exact = self::prepared(&exact(rods()));
    let found = run(&exact, |_| {}, || false).expect("it runs");
    assert_eq!(
        (found.found.is_interrupted, found.verdict.outcome),
        (true, Outcome::Tolerance)
    );
}

#[test]
fn a_pass_of_the_papers_loop_is_told_by_its_errors_in_percent() {
    let mut told = Vec::new();
    let prepared = prepared(&with(
        rods(),
        "job.toml",
        "method = \"gauss_newton\"",
        "method = \"paper\"",
    ));
    let found = run(&prepared, |words| told.push(words.to_owned()), || true).unwrap();
    let History::Paper(run) = found.found.history else {
        panic!("by the paper's loops")
    };
    assert_eq!(told.len(), run.passes.len());
    for ((number, pass), words) in (1..).zip(&run.passes).zip(&told) {
        assert!(
            words.starts_with(&format!("pass {number}: frequencies ")),
            "{words}"
        );
        let percents = words
            .split_whitespace()
            .filter_map(|word| word.parse::<f64>().ok());
        let errors = [
            pass.check.errors.frequency_rms(),
            pass.check.errors.shape_rms(),
        ];
        let percents: Vec<f64> = percents.collect();
        assert_eq!(percents.len(), 2, "{words}");
        for (percent, error) in percents.iter().zip(errors) {
            assert!(
                (percent / 100.0 - error).abs() <= PRINTED_RMS,
                "{words}: {error}"
            );
        }
    }
}

#[test]
fn the_papers_loop_says_that_it_was_stopped_by_request() {
    let files = with(
        rods(),
        "job.toml",
        "method = \"gauss_newton\"",
        "method = \"paper\"",
    );
    let outcome = |files: &Files| {
        let found = run(&prepared(files), |_| {}, || false).expect("it runs");
        found.verdict.outcome
    };
    assert_eq!(outcome(&files), Outcome::Request);
    // A result within tolerance needed no more passes.
    assert_ne!(outcome(&exact(files)), Outcome::Request);
}

/// The paper's loop counts factors from its start; the bounds are those of the first model all the same.
#[test]
fn bounds_hold_from_wherever_the_papers_loop_starts() {
    let bounds = "elements = [1]\nlower = 0.9\nupper = 1.2";
    let each =
        "elements = [2]\nlower = 0.8\nupper = 1.02\n[[parameter]]\nname = \"c\"\nelements = [3]";
    let files = with(with(rods(), "job.toml", A, bounds), "job.toml", B, each);
    let (_folder, path) = placed(&with(files, "job.toml", "method = \"gauss_newton\"", ""));
    let study = Study::new(&path, 5, &[Vary::Start], &[]).unwrap();
    for sample in 1..=6 {
        let (line, failure) = study.run(sample, || true).expect("a sample");
        assert!(failure.is_none(), "{line}");
        let factors: Vec<f64> = line
            .split(',')
            .skip(5)
            .take(3)
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        // The rods that the test was made of are beyond both.
        assert!(
            (factors[0] - 0.9).abs() < ROUND_OFF && (factors[1] - 1.02).abs() < ROUND_OFF,
            "{factors:?}"
        );
    }
}

/// A factor on stiffness keeps an element's mass, and one on mass its size.
#[test]
fn a_corrected_deck_has_factors_in_sizes_and_densities() {
    let dense = with(
        rods(),
        "model.bdf",
        "MAT1,1,1.+6,,.3",
        "MAT1,1,1.+6,,.3,4.-3",
    );
    let corrected = |files: &Files, factors: &[f64]| {
        let bytes = prepared(files)
            .loaded
            .corrected_deck(factors)
            .expect("it can be written")
            .expect("a deck");
        let elements = deck::read("corrected", &bytes, &[])
            .expect("it reads")
            .model
            .elements;
        elements
            .iter()
            .map(|element| (element.size, element.material.density))
            .collect_vec()
    };
    assert_eq!(
        corrected(&dense, &[2.5, 0.5]),
        [(0.25, 1.6e-3), (0.05, 0.0), (0.05, 0.0)]
    );
    let mass = with(dense, "job.toml", A, "elements = [1]\nscales = \"mass\"");
    assert_eq!(
        corrected(&mass, &[2.5, 1.0]),
        [(0.1, 0.01), (0.1, 0.0), (0.1, 0.0)]
    );
}
