//! Modes that join a correction, stay out of it or are told by frequency alone, by both methods.

use crate::common::jobs::{of_parts, of_whole, said, unbroken};
use crate::prelude::*;
use crate::readers::job_pairs::{net, noisy, normal};
use corfem::job::concern::Grade;

/// Masses, each on a spring to the ground, joined weakly in a row: where their springs are alike they move together.
fn oscillators(own: &[f64], joint: f64) -> DMatrix<f64> {
    let joints = chain_of_springs(ChainEnds::FreeFree, own.len(), joint);
    joints.dense() + DMatrix::from_diagonal(&DVector::from_column_slice(own))
}

/// The job of unit masses with this stiffness, of parameters with these parts of it, and of a test with these modes.
fn job_of_matrices(
    method: &str,
    stiffness: &DMatrix<f64>,
    parts: &[DMatrix<f64>],
    modes: &Modes,
) -> Files {
    let files = of_parts(stiffness, parts, &eye(stiffness.nrows()), modes);
    comparing(files, &format!("method = \"{method}\""))
}

/// All modes of unit masses with this stiffness.
fn modes_of(stiffness: &DMatrix<f64>) -> Modes {
    solve(stiffness, &eye(stiffness.nrows()), stiffness.nrows()).unwrap()
}

/// A job of joined masses, with a factor on every spring and the modes of other springs.
fn joined(method: &str, [first, real]: [&[f64]; 2], joint: f64) -> Files {
    let modes = modes_of(&oscillators(real, joint));
    let part = |place: usize| {
        let mut own = vec![0.0; first.len()];
        own[place] = first[place];
        oscillators(&own, 0.0)
    };
    let parts = (0..first.len()).map(part).collect_vec();
    job_of_matrices(method, &oscillators(first, joint), &parts, &modes)
}

/// A job one of whose test modes resembles no mode of the first model, until the two others have told the springs apart.
pub fn mixed(method: &str) -> Files {
    let (first, real) = ([1000.0, 1050.0, 1100.0], [1000.0, 1300.0, 1650.0]);
    joined(method, [&first, &real], 60.0)
}

#[test]
fn a_mode_left_out_is_compared_once_it_resembles_a_mode_of_the_model() {
    for method in ["paper", "gauss_newton"] {
        let loaded = prepared(&mixed(method));
        let [left] = loaded.unpaired[..] else {
            panic!("{method}")
        };
        assert!(
            left.why.starts_with("it resembles no mode of the model"),
            "{method}"
        );
        let left = left.mode;
        let result = finished(&loaded);
        assert!(result.found.prepared.modes.contains(&left), "{method}");
        let mut all = result.trust.all().iter();
        assert!(all.all(|own| own.grade != Grade::LeftOut));
        let report = report_of(&result);
        let numbers = report.modes.iter().map(|own| own.mode).collect_vec();
        assert_eq!(numbers, [1, 2, 3], "{method}");
        // From where the others have led the paper's loops find a minimum of their own.
        let is_within = result.verdict.is_within;
        assert_eq!(is_within, method != "paper", "{}", report.verdict);
    }
}

/// Eight oscillators that stand alone or in pairs by what their springs are, with the usual noise. What the shape of one close mode alone
/// says of them depends on springs a hundredth apart, and goes once its neighbor is compared with it: no reason to refuse that.
#[test]
fn a_right_mode_is_not_refused_for_good() {
    let first = [1.0, 1.0, 1.3, 1.3, 1.6, 1.6, 1.9, 1.9].map(|own| 1e4 * own);
    let mut draws = Draws(1);
    for _ in 0..40 {
        let real = first.map(|own| own * (0.15 * normal(&mut draws)).exp());
        let files = noisy(joined("gauss_newton", [&first, &real], 500.0), &mut draws);
        let words = unbroken(&answered(&files).words);
        let is_refused = words.contains("the others worse");
        assert!(words.contains("Chi-squared") && !is_refused, "{words}");
    }
}

/// Right tests of structures of all kinds, the fourth mode of each held out. Components of a shape have somewhat less than their predicted
/// deviation, for its scale is fitted to them. One test in a thousand is beyond the quantile.
#[test]
fn predicted_deviations_hold_what_was_held_out() {
    let (mut draws, mut within, mut all, mut missed) = (Draws(4), 0, 0, 0);
    for _ in 0..300 {
        let (model, parts, mass) = net(&mut draws, 6);
        let truth = parts
            .iter()
            .map(|_| (0.3 * normal(&mut draws)).exp())
            .collect_vec();
        let files = of_whole(
            &model,
            &truth,
            &(0..mass.nrows()).collect_vec(),
            4,
            DEVIATIONS,
        );
        let files = noisy(comparing(files, "prior_deviation = 0.3"), &mut draws);
        let found = finished(&prepared(&with(
            files,
            "job.toml",
            "[test]",
            "[test]\nhold_out = [4]",
        )));
        let report = report_of(&found);
        let Some(held) = report.modes.iter().find(|own| own.mode == 4) else {
            continue;
        };
        let shape = report.readings.iter().filter(|own| own.mode == 4);
        let shape = shape.filter_map(|own| own.residual);
        let own = shape.chain(held.residual).collect_vec();
        all += own.len();
        within += own.iter().filter(|own| own.abs() < NORMAL_95).count();
        missed += usize::from(
            report
                .verdict
                .contains("does not hold where it was not fitted"),
        );
    }
    let part = within as f64 / all as f64;
    assert!(
        (0.93..0.97).contains(&part) && missed < 4,
        "{part} of {all}, {missed}"
    );
}

/// In bounds of .5 to 1.6 the second spring, 1.24 times as stiff in the end, may still be 1.29 times that, and its mode 1.136 times as high but for
/// four deviations of .5 %. A mode that joins adds no more to the squares of the others than noise that moves three
/// factors.
#[test]
fn reach_at_the_end_is_what_its_factors_leave_of_the_bounds() {
    let [harm, far] = [
        "compared it makes the others worse",
        "can have its frequency",
    ];
    for (ratio, why) in [(1.03, ""), (1.07, harm), (1.13, harm), (1.17, far)] {
        let mut files = retested(mixed("gauss_newton"), |data| {
            data.frequencies_hz[1] *= ratio
        });
        let job = file(&mut files, "job.toml");
        *job = job.replace("matrix =", "lower = 0.5\nupper = 1.6\nmatrix =");
        let trust = finished(&prepared(&files)).trust;
        let mut left = trust.all().iter();
        let left = left.find(|own| own.grade == Grade::LeftOut);
        let words = left.map_or("", |own| &own.words);
        assert!(
            words.contains(why) && words.is_empty() == why.is_empty(),
            "{ratio}: {words}"
        );
    }
}

/// One root three times, and parts that would split it: no perturbation of single modes can follow.
#[test]
fn repeated_roots_in_the_papers_loops_name_the_other_method() {
    let modes = modes_of(&oscillators(&[1000.0, 1300.0, 1650.0], 60.0));
    let whole = DMatrix::from_diagonal_element(3, 3, 1000.0);
    let part = oscillators(&[300.0, 310.0, 320.0], 60.0);
    let parts = [0.5 * &part, 0.5 * &part, &whole - &part];
    let refused = said(&job_of_matrices("paper", &whole, &parts, &modes));
    let remedy = "compare.method = \"gauss_newton\" needs none";
    assert!(refused.contains(remedy), "{refused}");
}

/// Six equal masses joined by five equal springs and held nowhere, whose shapes are cosines; the sensor of this place is turned.
pub fn free_chain(turned: Option<usize>) -> Files {
    let spring = |place: usize| springs(6, &[(place + 1, Some(place), 1000.0)]).dense();
    let parts = [0, 1, 2, 3, 4].map(spring);
    let angle = |mode: usize| PI * mode as f64 / 12.0;
    // The springs are a tenth softer than the model's.
    let hertz = [1, 2, 3].map(|mode| 2.0 * 900.0_f64.sqrt() * angle(mode).sin() / TAU);
    let shapes = DMatrix::from_fn(6, 3, |place, mode| {
        let sign = if turned == Some(place) { -1.0 } else { 1.0 };
        sign * (angle(mode + 1) * (2.0 * place as f64 + 1.0)).cos()
    });
    let modes = Modes::from_measured(&hertz, &shapes).unwrap();
    job_of_matrices("gauss_newton", &parts.iter().sum(), &parts, &modes)
}
