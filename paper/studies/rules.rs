//! The paper's rule and the weighted one on the same structures.

use super::RMS_PERCENT;
use crate::prelude::*;

/// What a rule came to on a structure; errors are fractions.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// The structure.
    pub name: String,
    /// Nothing, the paper's with the settings of the case, or Gauss–Newton with weights of [`DEVIATIONS`].
    pub rule: &'static str,
    /// Accepted steps.
    pub steps: usize,
    /// Exact analyses.
    pub analyses: usize,
    /// RMS error of the factors.
    pub factor_rms: f64,
    /// The largest error of a factor, in magnitude.
    pub largest: f64,
}

/// How far factors are from the true ones, and what it took to find them.
fn compared(
    known: &Known,
    rule: &'static str,
    [steps, analyses]: [usize; 2],
    factors: &[f64],
) -> Compared {
    let errors = factors
        .iter()
        .zip(&known.truth)
        .map(|(found, right)| found / right - 1.0)
        .collect_vec();
    let largest = errors
        .iter()
        .fold(0.0, |largest, error| error.abs().max(largest));
    Compared {
        name: known.name.clone(),
        rule,
        steps,
        analyses,
        factor_rms: rms(&errors),
        largest,
    }
}

/// Cases 1 to 3 and the delta wing before correction, by the paper's rule and by Gauss–Newton, within the same bounds.
///
/// # Errors
/// Those of the models and of both rules.
pub fn compare_all(settings: &WeightedSettings) -> Result<Vec<[Compared; 3]>, CaseError> {
    let of = |number| {
        let (known, paper) = match number {
            0 => (
                Known::delta_wing()?,
                correlate_wing(&DeltaWing::embedded(), |_, _| {})?.correlation,
            ),
            _ => (
                Known::of_case(number)?,
                run_case(&Case::new(number)?, |_, _| {})?.correlation,
            ),
        };
        let weights = equal_weights(DEVIATIONS, known.test.len());
        let analyze = |factors: &[f64]| {
            let model = known.model.analyze(factors, &known.test, None)?;
            Ok::<_, CaseError>(Comparison::from(&model))
        };
        let ones = vec![1.0; known.truth.len()];
        let found = gauss_newton(
            analyze,
            &ones,
            &known.model.factor_ranges()?,
            &weights,
            settings,
        )?;
        let steps = paper
            .passes
            .iter()
            .map(|pass| pass.inner.iterations.len())
            .sum();
        Ok([
            compared(&known, "none", [0, 1], &ones),
            compared(
                &known,
                "paper",
                [steps, paper.passes.len() + 1],
                &paper.best_factors,
            ),
            compared(
                &known,
                "gauss_newton",
                [found.iterations.len(), found.analyses],
                &found.factors,
            ),
        ])
    };
    [1, 2, 3, 0].into_iter().map(of).collect()
}

/// Cases 1 to 3 and the delta wing at the start, by the paper's rule, and by the weighted one.
pub fn rules_table(compared: &[[Compared; 3]]) -> Table {
    let note = "Analyses: exact ones, by the finite element model. Factor: its error beside the one that makes the model right. The \
        paper's rule stops within the tolerances of its case, the weighted one where nothing falls any more.";
    let title = "The paper's rule and weighted Gauss\u{2013}Newton steps, without noise";
    let mut table = Table::new("rules", title, "Structure")
        .headings(["Steps", "Analyses"], "")
        .headings(["Factor RMS", "Factor worst"], "%")
        .notes([note]);
    for of in compared.as_flattened() {
        let rule = match of.rule {
            "none" => "first model",
            "paper" => "paper's rule",
            _ => "weighted",
        };
        let counts = [of.steps, of.analyses].map(Cell::count).into_iter();
        table.row(
            format!("{}, {rule}", of.name),
            counts.chain(percents([of.factor_rms, of.largest], RMS_PERCENT)),
        );
    }
    table
}
