//! The paper's rule and the weighted one on the same structures, without noise.

use super::{delta_wing, rows};
use crate::prelude::*;

/// Cases 1 to 3 and the delta wing before correction, by the paper's rule and by Gauss–Newton, within the same bounds.
///
/// Of each rule: accepted steps, exact analyses, and the RMS and the largest error of the factors, percent.
pub fn compare_all() -> Vec<(String, [[f64; 4]; 3])> {
    let of = |number| {
        let (known, paper) = match number {
            0 => (Known::delta_wing(), delta_wing::RUN.0.clone()),
            _ => (
                Known::of_case(number),
                case_run(&case_of(number)).correlation,
            ),
        };
        let weights = equal_weights(DEVIATIONS, known.test.len());
        let analyze = |factors: &[f64]| {
            let model = known.model.analyze(factors, &known.test)?;
            Ok::<_, Error>(Comparison::from(&model))
        };
        let (ones, ranges) = (
            vec![1.0; known.truth.len()],
            known.model.factor_ranges().unwrap(),
        );
        let weighted = gauss_newton(
            analyze,
            &ones,
            &ranges,
            &weights,
            &WeightedSettings::default(),
        )
        .unwrap();
        let compared = |steps: usize, analyses: usize, factors: &[f64]| {
            let errors = factors.iter().zip(&known.truth);
            let errors = errors
                .map(|(found, right)| found / right - 1.0)
                .collect_vec();
            let largest = errors.iter().map(|error| error.abs()).largest();
            [
                steps as f64,
                analyses as f64,
                100.0 * rms(&errors),
                100.0 * largest,
            ]
        };
        let passes = paper.passes.iter();
        let steps = passes.map(|pass| pass.inner.iterations.len()).sum();
        let all = [
            compared(0, 1, &ones),
            compared(steps, paper.passes.len() + 1, &paper.best_factors),
            compared(
                weighted.iterations.len(),
                weighted.analyses,
                &weighted.factors,
            ),
        ];
        (known.name, all)
    };
    [1, 2, 3, 0].into_iter().map(of).collect()
}

/// Cases 1 to 3 and the delta wing at the start, by the paper's rule, and by the weighted one.
pub fn tables() -> Vec<Table> {
    let ways = ["first model", "paper's rule", "weighted"];
    let found = compare_all().into_iter();
    let found = found.flat_map(|(name, all)| {
        let of = move |(way, found): (&str, [f64; 4])| (format!("{name}, {way}"), found.to_vec());
        ways.into_iter().zip(all).map(of)
    });
    let columns = ["Steps", "Analyses", "Factor RMS %", "Factor worst %"];
    vec![rows("rules", &columns, found)]
}
