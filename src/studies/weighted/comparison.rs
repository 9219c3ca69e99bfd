//! The paper's rule and the weighted one on the same structures.

use super::gauss_newton::{WeightedSettings, gauss_newton};
use super::residuals::{DEVIATIONS, Weights};
use crate::cases::error::CaseError;
use crate::cases::torque_box::TEST_GAGE;
use crate::cases::{Case, run_case};
use crate::method::model::FiniteElementModel;
use crate::method::modes::ModeSet;
use crate::studies::delta_wing::DeltaWing;
use crate::studies::delta_wing::correlation::{GROUPS, correlate_wing, first_model, test_modes};
use serde::Serialize;

/// A structure whose true factors are known: the model before its correlation, the exact test, and the truth.
pub struct Known {
    /// What it is.
    pub name: String,
    /// The first model.
    pub model: FiniteElementModel,
    /// Its test modes, without noise.
    pub test: ModeSet,
    /// The factors that make the model right.
    pub truth: Vec<f64>,
}

impl Known {
    /// A case of the paper.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        let truth = case.first_gages().into_iter().map(|gage| TEST_GAGE / gage).collect();
        let (model, test) = (case.model()?, case.test_modes()?.into());
        Ok(Self { name: format!("Case {}", case.number), model, test, truth })
    }

    /// The delta wing with its wrong gages.
    ///
    /// # Errors
    /// Those of the wing and its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let wing = DeltaWing::embedded()?;
        let truth = GROUPS.iter().map(|group| 1.0 / group.first_over_true).collect();
        Ok(Self { name: "Delta wing".to_owned(), model: first_model(&wing)?, test: test_modes(&wing)?, truth })
    }

    fn result(&self, iterations: usize, analyses: usize, factors: &[f64]) -> Result<RuleResult, CaseError> {
        let errors: Vec<f64> = factors.iter().zip(&self.truth).map(|(found, right)| found / right - 1.0).collect();
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        Ok(RuleResult {
            iterations,
            analyses,
            factor_rms: (squares / errors.len() as f64).sqrt(),
            largest: errors.iter().fold(0.0, |largest, error| error.abs().max(largest)),
            error_sum: self.model.analyze(factors, &self.test, None)?.exact.errors.sum(),
        })
    }
}

/// What a rule came to; errors are fractions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RuleResult {
    /// Accepted steps.
    pub iterations: usize,
    /// Exact analyses.
    pub analyses: usize,
    /// RMS error of the factors.
    pub factor_rms: f64,
    /// The largest error of a factor, in magnitude.
    pub largest: f64,
    /// The paper's error sum at the factors.
    pub error_sum: f64,
}

/// Both rules on one structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// The structure.
    pub name: String,
    /// RMS error of the factors before any step.
    pub first_rms: f64,
    /// By the paper's rule, with the settings of the case.
    pub paper: RuleResult,
    /// By Gauss–Newton with weights of [`DEVIATIONS`].
    pub weighted: RuleResult,
}

/// Cases 1 to 3 and the delta wing by the paper's rule and by Gauss–Newton, both within the same bounds.
///
/// # Errors
/// Those of the models and of both rules.
pub fn compare_all(settings: &WeightedSettings) -> Result<Vec<Compared>, CaseError> {
    let of_case = |number| {
        let case = Case::new(number)?;
        Ok((Known::of_case(&case)?, run_case(&case, |_, _| {})?.correlation))
    };
    let wing = || Ok((Known::delta_wing()?, correlate_wing(&DeltaWing::embedded()?, |_, _| {})?.correlation));
    let compared = |run: Result<(Known, _), CaseError>| {
        let (known, paper): (Known, crate::method::outer_loop::Correlation) = run?;
        let weights = Weights::uniform(DEVIATIONS, known.test.len())?;
        let analyze = |factors: &[f64]| known.model.analyze(factors, &known.test, None);
        let ones = vec![1.0; known.truth.len()];
        let weighted = gauss_newton(analyze, &ones, &known.model.factor_ranges()?, &weights, settings)?;
        let iterations = paper.passes.iter().map(|pass| pass.inner.iterations.len()).sum();
        Ok(Compared {
            first_rms: known.result(0, 1, &ones)?.factor_rms,
            paper: known.result(iterations, paper.passes.len() + 1, &paper.best_factors())?,
            weighted: known.result(weighted.iterations.len(), weighted.analyses, &weighted.factors)?,
            name: known.name,
        })
    };
    [of_case(1), of_case(2), of_case(3), wing()].into_iter().map(compared).collect()
}
