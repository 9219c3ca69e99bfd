//! What a run of a job comes to: its verdict, what is told on the way, the best so far, bounds from any start, and the deck.

use super::job_pairs::net;
use crate::common::jobs::said as said_of;
use crate::common::jobs::{of_whole, run, unbroken};
use crate::prelude::*;
use corfem::job::HeldOut;
use corfem::present::page::report_page;
use corfem::weighted::identifiability::PRIOR_DEVIATION;
use std::cell::Cell;

const A: &str = "elements = [1]";
const B: &str = "elements = [\"2-3\"]";
/// Rods 2 and 3 one by one: what the test was made of can be found.
const EACH: &str = "elements = [\"2-3\"]\neach = true";

fn third_higher(files: Files) -> Files {
    retested(files, |data| data.frequencies_hz[2] *= 1.02)
}

/// What comes of a job that nobody stops.
fn ran(files: &Files) -> JobResult {
    finished(&prepared(files))
}

/// The job with the first parameter alone, and this rule for it.
fn alone(rule: &str) -> Files {
    let mut files = rods_with(A, rule);
    let end = files[0].1.rfind("[[parameter]]").unwrap();
    files[0].1.truncate(end);
    files
}

/// The deck with the areas that the test was made of.
fn exact(files: Files) -> Files {
    let own = "CROD,3,3,3,4\nPROD,1,1,.08\nPROD,3,2,.1\n";
    let files = with(files, "model.bdf", "CROD,3,2,3,4\nPROD,1,1,.1\n", own);
    with(files, "model.bdf", "PROD,2,2,.1", "PROD,2,2,.11")
}

/// Minima that noise allows stand in every output, with the starts that failed.
#[test]
fn several_starts_name_their_minima_in_every_output() {
    let mut found = ran(&comparing(rods(), "starts = 4"));
    for failed in [0, 2] {
        let report = report_of(&found);
        let [text, page] = [text(&report.brief()), report_page(&report).unwrap()];
        let words = format!("{failed} starts failed.");
        for shown in [&text, &page] {
            assert!(shown.contains(&words) && shown.contains("Minima that noise allows"));
        }
        let [minimum] = &report.minima[..] else {
            panic!("one minimum")
        };
        assert_eq!(
            (minimum.starts, &minimum.factors),
            (4, &found.found.factors)
        );
        assert!(relative_error(minimum.chi_squared, found.misfit.chi_squared) < MATRIX_ROUND_OFF);
        if let History::GaussNewton(Some(steps)) = &mut found.found.history {
            steps.starts = vec![None; 2];
        }
    }
    let single = text(&report_of(&ran(&rods())).brief());
    assert!(!single.contains("Minima that noise allows"));
}

/// A test is no test where any model would pass: with fewer numbers than factors, with so few that three times the noise would rather be
/// overlooked, and with weights that let everything be.
#[test]
fn a_test_that_no_model_can_fail_confirms_nothing() {
    let outcome = |entries: &str| {
        let found = ran(&comparing(exact(rods()), entries));
        (
            found.verdict.is_within,
            report_of(&found).answer + &report_of(&found).verdict,
        )
    };
    for (entries, reason) in [
        (
            "frequency_weights = [1e-3, 1e-3, 1e-3]\nshape_weights = [1e-3, 1e-3, 1e-3]",
            "a model with every frequency half off and other shapes would pass",
        ),
        (
            "frequency_weights = [1, 0, 0]\nshape_weights = [0, 0, 0]",
            "the fit leaves less than one number over",
        ),
        (
            "frequency_weights = [1, 1, 0]\nshape_weights = [0, 0, 0]\nprior_deviation = 1e-6",
            "so few numbers would show 46 %",
        ),
    ] {
        let (is_within, words) = outcome(entries);
        assert!(
            !is_within && words.starts_with("The test confirms nothing: "),
            "{words}"
        );
        for said in [reason, "Nothing to judge by", "the test confirms nothing"] {
            assert!(words.contains(said), "{words}");
        }
    }
    let (is_within, words) = outcome("");
    assert!(is_within, "{words}");
}

/// A mode that is held out has no part in the factors, however wrong its frequency, and is told of.
#[test]
fn a_mode_held_out_is_compared_and_not_fitted() {
    let held = |files, modes| {
        with(
            files,
            "job.toml",
            "[test]",
            &format!("[test]\nhold_out = {modes}"),
        )
    };
    let [one, off] = [rods(), third_higher(rods())].map(|files| ran(&held(files, "[3]")));
    assert_alike(&one.found.factors, &off.found.factors, ROUND_OFF);
    let held_of = |found: &JobResult| found.found.held_out().unwrap();
    let [right, wrong] = [&one, &off].map(|found| {
        let [
            HeldOut {
                mode: 3,
                frequency,
                shape: Some(_),
            },
        ] = held_of(found)[..]
        else {
            panic!("mode 3 is held out")
        };
        frequency
    });
    let apart = (1.0 + right[1] / 100.0) / (1.0 + wrong[1] / 100.0);
    assert_within(apart, 1.02, 1e-6);
    // The answer tells it apart from the others, whose errors are those of a job without it.
    let answer = |found: &JobResult| report_of(found).answer;
    let without = with(
        third_higher(rods()),
        "job.toml",
        "[test]",
        "[test]\nmodes = [1, 2]",
    );
    let (without, off) = (answer(&ran(&without)), answer(&off));
    let errors = without.split([',', ';']).next().unwrap();
    let [before, after] = wrong.map(f64::abs);
    let errors = format!("does not hold where it was not fitted: f{}", &errors[1..]);
    let expected = format!("The model {errors}, held out {before:.2} → {after:.2} %");
    assert!(off.starts_with(&expected), "{off} {expected}");
    assert!(held_of(&ran(&rods())).is_empty());
    for (modes, says) in [
        ("[4]", "mode 4 is none of the test modes"),
        ("[1, 2, 3]", "a mode at least must be left"),
        ("[1, 1]", "named twice"),
    ] {
        let words = said_of(&held(rods(), modes));
        assert!(words.contains(says), "{words}");
    }
}

/// The test without its second mode: the model's is named, with its frequency.
#[test]
fn modes_of_the_model_that_no_test_mode_answers_are_said() {
    let unanswered = |entry: &str| {
        let found = ran(&rods_with("[test]", entry));
        let before = trust_in(&found.found.prepared);
        let [before, after] = [&before, &found.trust].map(|trust| about(trust, "unanswered-modes"));
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
    let below = |files: &Files| {
        let trust = ran(files).trust;
        trust
            .all()
            .iter()
            .any(|own| own.identifier == "below-noise")
    };
    assert!(below(&exact(rods())));
    assert!(!below(&alone(B)));
}

/// Interval ends, residuals by sensor and mode, and how every start ended stand in the rows.
#[test]
fn the_rows_have_the_ends_of_intervals_the_residuals_and_how_starts_ended() {
    let found = ran(&comparing(rods(), "starts = 3"));
    let report = report_of(&found);
    for (row, interval) in report.parameters.iter().zip(&found.intervals) {
        let ends = interval.as_ref().ok();
        assert_eq!(
            row.low.zip(row.high),
            ends.map(|own| (own.lower, own.upper))
        );
        assert!(ends.is_some() || !row.remark.is_empty());
    }
    let all = residuals(&found.found.last, &found.found.prepared.weights()).unwrap();
    let shapes = report.readings.chunks(3).zip(&report.modes);
    let told = shapes
        .flat_map(|(shape, mode)| once(mode.residual).chain(shape.iter().map(|own| own.residual)));
    assert_eq!(told.flatten().collect_vec(), all.as_slice());
    assert_eq!(report.starts.len(), 3);
    let mut starts = report.starts.iter().flatten();
    assert!(starts.all(|own| own.stop == WeightedStop::Gradient && own.analyses > 1));
}

/// Without a step because none is needed, without a step because none is possible, and after the best that one factor can do. At a bound
/// there is no interval.
#[test]
fn a_verdict_tells_what_is_good_from_what_cannot_be_better() {
    let bounded = alone("elements = [1]\nlower = 1.0\nupper = 2.0");
    for (files, is_within, is_first, at_bound) in [
        (exact(rods()), true, true, &[][..]),
        (bounded, false, true, &[0]),
        (alone(B), false, false, &[]),
        (rods_with(B, EACH), true, false, &[]),
    ] {
        let found = ran(&files);
        let History::GaussNewton(Some(steps)) = found.found.history else {
            panic!("by steps")
        };
        assert!(found.verdict.end.is_stationary());
        assert_eq!(
            (found.verdict.is_within, steps.best.iterations.is_empty()),
            (is_within, is_first)
        );
        assert_eq!(found.verdict.at_bound, at_bound);
        for e in found.verdict.at_bound {
            assert_eq!(found.intervals[e], Err(Withheld::AtBound));
        }
        if files == rods_with(B, EACH) {
            assert_alike(found.found.factors, [0.8, 1.1, 1.0], WEIGHTED_FACTOR);
        }
    }
}

#[test]
fn no_interval_stands_where_the_papers_rule_stops() {
    let found = ran(&rods_with("gauss_newton", "paper"));
    assert!(matches!(found.found.history, History::Paper(_)));
    assert!(
        found
            .intervals
            .iter()
            .all(|one| *one == Err(Withheld::NoOptimum))
    );
    let mut said = found.trust.all().iter();
    assert!(said.any(|own| own.words.contains("minimum of weighted steps alone")));
}

/// A prior of a millionth leaves its factor at one and keeps all of its variance; the others have the job's, and these the test decides.
#[test]
fn a_prior_is_the_parameters_own_or_that_of_all() {
    let files = comparing(rods_with(B, EACH), "prior_deviation = 0.5");
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
    assert_eq!(found.verdict.unseen, [0]);
    assert_eq!(found.intervals[0], Err(Withheld::MostlyPrior));
}

/// What is weighed otherwise than by its deviation is said, and an entry that only the other method reads is not passed over.
#[test]
fn own_weights_are_said() {
    let words = |entries: &str| -> String {
        let files = rods_with("[compare]", entries);
        let trust = ran(&files).trust;
        trust.all().iter().map(|own| &own.words[..]).collect()
    };
    for (entries, divides) in [
        ("[compare]", false),
        ("[compare]\nshape_weights = [1, 0, 1]", true),
        ("[compare]\nshape_weights = [1, 2, 1]", true),
    ] {
        let words = words(entries);
        assert_eq!(
            words.contains("weights count as dividing"),
            divides,
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
    let interval = found.intervals[0].unwrap();
    let slopes = jacobian(&found.found.last, &found.found.prepared.weights()).unwrap();
    let alone = (times / slopes.norm()).powi(-2) + PRIOR_DEVIATION.powi(-2);
    let deviation = found.seen.deviations[0];
    assert_within(alone.sqrt() * deviation, 1.0, MATRIX_ROUND_OFF);
    let wide = (interval.upper / interval.lower).ln();
    assert!(
        relative_error(wide, 2.0 * NORMAL_95 * deviation) < END_OF_INTERVAL,
        "{wide}"
    );
}

/// Ten stories from five floors and five modes, with the noise that the weights assume.
#[test]
fn the_chi_squared_of_a_right_model_is_its_degrees_of_freedom_in_the_mean() {
    let files = comparing(building(), "method = \"gauss_newton\"");
    let loaded = prepared(&files).loaded;
    let exact = Modes::from_measured(&loaded.data.frequencies_hz, &loaded.data.shapes).unwrap();
    let noise = (0..exact.len())
        .map(|mode| loaded.deviations(mode))
        .collect_vec();
    let [mut chi_squared, mut degrees] = [0.0; 2];
    for seed in 0..300 {
        let noisy = with_noise_by_mode(&exact, &noise, seed).unwrap();
        let noisy = retested(files.clone(), |data| {
            (data.frequencies_hz, data.shapes) = (noisy.frequencies_hz(), noisy.shapes().clone());
        });
        let misfit = ran(&noisy).misfit;
        chi_squared += misfit.chi_squared;
        degrees += misfit.degrees_of_freedom;
    }
    let mean = chi_squared / degrees;
    assert_within(mean, 1.0, MEAN_MISFIT);
}

/// Told are falling sums alone, and when it is stopped, the last of them is that of the factors it gives. It is never within tolerance then,
/// but by the paper's loop, which needed no more.
#[test]
fn a_stopped_correlation_gives_the_best_that_it_has_told() {
    let each = prepared(&rods_with(B, EACH));
    let stopped_after = |most: usize| {
        let (mut told, asked) = (Vec::new(), Cell::new(0));
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() < most
        };
        let found = run(&each, |words| told.push(words.to_owned()), go_on).unwrap();
        assert!(found.found.is_interrupted);
        assert!(matches!(found.found.history, History::GaussNewton(None)));
        let sum = residuals(&found.found.last, &each.weights())
            .unwrap()
            .norm_squared();
        assert_eq!(told.last(), Some(&format!("sum of squares {sum:.4e}")));
        let sums = told
            .iter()
            .map(|words| words.rsplit(' ').next().unwrap().parse::<f64>().unwrap());
        assert!(sums.is_sorted_by(|a, b| b < a), "{told:?}");
        (told.len(), found)
    };
    let (count, first) = stopped_after(1);
    assert_eq!((count, first.verdict.end), (1, End::Request));
    assert_eq!(first.found.factors, [1.0; 3]);
    let (count, second) = stopped_after(2);
    assert!(
        count > 1 && second.found.factors != first.found.factors,
        "{count} told"
    );
    let exact = run(&prepared(&exact(rods())), |_| {}, || false).unwrap();
    assert!(exact.found.is_interrupted && !exact.verdict.is_within);
    assert_eq!(exact.verdict.end, End::Request);
    let paper = rods_with("gauss_newton", "paper");
    for (files, is_requested) in [(self::exact(paper.clone()), false), (paper, true)] {
        let found = run(&prepared(&files), |_| {}, || false).unwrap();
        assert_eq!(found.verdict.end == End::Request, is_requested);
    }
}

#[test]
fn a_pass_of_the_papers_loop_is_told_by_its_errors_in_percent() {
    let mut told = Vec::new();
    let prepared = prepared(&rods_with("gauss_newton", "paper"));
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
        let percents = percents.collect_vec();
        assert_eq!(percents.len(), 2, "{words}");
        let errors = &pass.check.errors;
        for (percent, error) in percents
            .iter()
            .zip([errors.frequency_rms(), errors.shape_rms()])
        {
            assert_within(percent / 100.0, error, PRINTED_RMS);
        }
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
    let mass = with(
        dense.clone(),
        "job.toml",
        A,
        "elements = [1]\nscales = \"mass\"",
    );
    for (files, factors, expected) in [
        (
            dense,
            [2.5, 0.5],
            [(0.25, 1.6e-3), (0.05, 0.0), (0.05, 0.0)],
        ),
        (mass, [2.5, 1.0], [(0.1, 0.01), (0.1, 0.0), (0.1, 0.0)]),
    ] {
        let written = prepared(&files).loaded.corrected_model(&factors).unwrap();
        let deck = deck::read("corrected", &written[0].1, &[]).unwrap();
        let elements = deck.model.elements.iter();
        let sizes = elements.map(|element| (element.size, element.material.density));
        assert_eq!(sizes.collect_vec(), expected);
    }
}

/// The law: the first line counts the factors whose interval leaves out 1, names each of them and no other, and counts the rest.
#[test]
fn the_answer_names_every_factor_that_differs_from_one() {
    for seed in 0..5 {
        let mut draws = Draws(seed);
        let (model, ..) = net(&mut draws, 6);
        let truth = (0..6)
            .map(|_| draws.between(0.8, 1.4).min(1.0))
            .collect_vec();
        let found = answered(&of_whole(&model, &truth, &[0, 2, 4, 6], 4, Noise::USUAL));
        let is_told = |own: &Option<[f64; 2]>| own.is_some();
        let differs =
            |own: &Option<[f64; 2]>| own.is_some_and(|[low, high]| low > 1.0 || high < 1.0);
        let all = |is: &dyn Fn(&Option<[f64; 2]>) -> bool| {
            found.intervals.iter().filter(|own| is(own)).count()
        };
        let (count, told) = (all(&differs), all(&is_told));
        let line = unbroken(found.words.split("\n\n").next().unwrap());
        let said = format!("; {count} of 6 factors differ from 1 beyond their interval, ");
        let rest = format!("; {} unchanged, {} unknown.", told - count, 6 - told);
        assert!(
            line.contains(&said) && line.ends_with(&rest),
            "{line}\n{}",
            found.words
        );
        for (number, own) in found.intervals.iter().enumerate() {
            assert_eq!(
                line.contains(&format!(" p{number} ")),
                differs(own),
                "{line}"
            );
        }
    }
}
