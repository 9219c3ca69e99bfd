//! What a run of a job comes to: what is told on the way, the best so far, its report beside its numbers, and the deck.

use super::job_pairs::net;
use crate::common::jobs::{of_whole, run, unbroken};
use crate::prelude::*;
use corfem::weighted::identifiability::PRIOR_DEVIATION;
use std::cell::Cell;

const A: &str = "elements = [1]";
const B: &str = "elements = [\"2-3\"]";
/// Rods 2 and 3 one by one: what the test was made of can be found.
const EACH: &str = "elements = [\"2-3\"]\neach = true";

/// What comes of a job that nobody stops.
fn ran(files: &Files) -> JobResult {
    finished(&prepared(files))
}

/// The deck with the areas that the test was made of.
fn exact(files: Files) -> Files {
    let own = "CROD,3,3,3,4\nPROD,1,1,.08\nPROD,3,2,.1\n";
    let files = with(files, "model.bdf", "CROD,3,2,3,4\nPROD,1,1,.1\n", own);
    with(files, "model.bdf", "PROD,2,2,.1", "PROD,2,2,.11")
}

/// A mode that is held out has no part in the factors, however wrong its frequency. The answer tells it apart from the others, whose errors are
/// those of a job without it.
#[test]
fn a_mode_held_out_is_compared_and_not_fitted() {
    let test = |higher: f64, entry: &str| {
        let files = retested(rods(), |data| data.frequencies_hz[2] *= higher);
        ran(&with(
            files,
            "job.toml",
            "[test]",
            &format!("[test]\n{entry}"),
        ))
    };
    let held = "hold_out = [3]";
    let [one, off, without] = [(1.0, held), (1.02, held), (1.02, "modes = [1, 2]")]
        .map(|(higher, entry)| test(higher, entry));
    assert_alike(&one.found.factors, &off.found.factors, ROUND_OFF);
    let [right, wrong] = [&one, &off].map(|own| own.found.held_out().unwrap()[0].frequency);
    let apart = (1.0 + right[1] / 100.0) / (1.0 + wrong[1] / 100.0);
    assert_within(apart, 1.02, 1e-6);
    let [off, without] = [off, without].map(|found| report_of(&found).answer);
    let errors = &without.split([',', ';']).next().unwrap()[1..];
    let [before, after] = wrong.map(f64::abs);
    let expected = format!(
        "The model does not hold where it was not fitted: f{errors}, held out {before:.2} → {after:.2} %"
    );
    assert!(off.starts_with(&expected), "{off} {expected}");
}

/// Interval ends, and residuals by sensor and mode.
#[test]
fn the_rows_have_the_ends_of_intervals_and_the_residuals() {
    let found = ran(&rods());
    let report = report_of(&found);
    for (row, interval) in report.parameters.iter().zip(&found.intervals) {
        let ends = interval.as_ref().ok().map(|own| (own.lower, own.upper));
        assert_eq!(row.low.zip(row.high), ends);
        assert!(ends.is_some() || !row.remark.is_empty());
    }
    let all = residuals(&found.found.last, &found.found.prepared.weights()).unwrap();
    let shapes = report.readings.chunks(3).zip(&report.modes);
    let told = shapes
        .flat_map(|(shape, mode)| once(mode.residual).chain(shape.iter().map(|own| own.residual)));
    assert_eq!(told.flatten().collect_vec(), all.as_slice());
}

/// One factor for rods that are 0.8 and 1.1 of the model's: no factor explains the test. The deviation that is told has the residuals in
/// it, and the prior as it is.
#[test]
fn an_interval_is_that_of_as_much_noise_as_there_is() {
    let mut files = rods_with(A, B);
    let end = files[0].1.rfind("[[parameter]]").unwrap();
    files[0].1.truncate(end);
    let found = ran(&files);
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
    assert!(
        report_of(&exact)
            .verdict
            .contains("It was stopped by request.")
    );
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
        let start = format!("pass {number}: frequencies ");
        let percents = words
            .split_whitespace()
            .filter_map(|word| word.parse::<f64>().ok());
        let percents = percents.collect_vec();
        assert!(words.starts_with(&start) && percents.len() == 2, "{words}");
        let errors = &pass.check.errors;
        assert_within(percents[0] / 100.0, errors.frequency_rms(), PRINTED_RMS);
        assert_within(percents[1] / 100.0, errors.shape_rms(), PRINTED_RMS);
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
        let truth = [(); 6].map(|()| draws.between(0.8, 1.4).min(1.0));
        let found = answered(&of_whole(&model, &truth, &[0, 2, 4, 6], 4, Noise::USUAL));
        let told = found.intervals.iter().flatten().count();
        let differs =
            |own: &Option<[f64; 2]>| own.is_some_and(|[low, high]| low > 1.0 || high < 1.0);
        let count = found.intervals.iter().filter(|own| differs(own)).count();
        let line = unbroken(found.words.split("\n\n").next().unwrap());
        let said = format!("; {count} of 6 factors differ from 1 beyond their interval, ");
        let rest = format!("; {} unchanged, {} unknown.", told - count, 6 - told);
        assert!(line.contains(&said) && line.ends_with(&rest), "{line}");
        for (number, own) in found.intervals.iter().enumerate() {
            assert_eq!(
                line.contains(&format!(" p{number} ")),
                differs(own),
                "{line}"
            );
        }
    }
}
