//! The paper's rule and the weighted one on the same structures.

use super::gauss_newton::{WeightedSettings, gauss_newton};
use super::residuals::{DEVIATIONS, equal_weights};
use crate::cases::error::CaseError;
use crate::cases::fit::rms;
use crate::cases::torque_box::TEST_GAGE;
use crate::cases::{Case, run_case};
use crate::method::model::{FiniteElementModel, Parameter};
use crate::method::modes::ModeSet;
use crate::studies::delta_wing::DeltaWing;
use crate::studies::delta_wing::correlation::{GROUPS, correlate_wing, first_model, test_modes};
use serde::Serialize;

/// Upper and lower cover of each bay, inboard to outboard.
const BAYS: [[usize; 2]; 3] = [[2, 15], [9, 11], [4, 8]];

/// A structure whose true factors are known.
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
    pub fn of_case(number: usize) -> Result<Self, CaseError> {
        let case = Case::new(number)?;
        let truth = case.first_gages().into_iter().map(|gage| TEST_GAGE / gage).collect();
        Ok(Self { name: format!("Case {number}"), model: case.model()?, test: case.test_modes()?.into(), truth })
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

    /// Case 2 with the two covers of each bay, which its modes do not tell apart, as one parameter.
    ///
    /// # Errors
    /// Those of the case and its model.
    pub fn case_2_by_bays() -> Result<Self, CaseError> {
        let known = Self::of_case(2)?;
        let (structure, t, mass) = (known.model.structure(), known.model.load_distribution(), known.model.mass());
        let elements = known.model.parameters().iter().zip(&known.truth);
        let alone = elements.filter(|(element, _)| !BAYS.as_flattened().contains(&element.members[0]));
        let (mut parameters, mut truth): (Vec<Parameter>, Vec<f64>) =
            alone.map(|(element, truth)| (element.clone(), *truth)).unzip();
        for bay in BAYS {
            parameters.push(Parameter::group(&format!("{} and {}", bay[0], bay[1]), &bay));
            truth.push(known.truth[bay[0] - 1]);
        }
        let model = FiniteElementModel::with_loads(structure.clone(), t.clone(), mass.clone(), parameters)?;
        Ok(Self { name: "Case 2 by bays".to_owned(), model, test: known.test, truth })
    }

    fn compared(&self, rule: &'static str, [steps, analyses]: [usize; 2], factors: &[f64]) -> Compared {
        let errors: Vec<f64> = factors.iter().zip(&self.truth).map(|(found, right)| found / right - 1.0).collect();
        let largest = errors.iter().fold(0.0, |largest, error| error.abs().max(largest));
        Compared { name: self.name.clone(), rule, steps, analyses, factor_rms: rms(&errors), largest }
    }
}

/// What a rule came to on a structure; errors are fractions.
#[derive(Debug, Clone, PartialEq, Serialize)]
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

/// Cases 1 to 3 and the delta wing before correction, by the paper's rule and by Gauss–Newton, within the same bounds.
///
/// # Errors
/// Those of the models and of both rules.
pub fn compare_all(settings: &WeightedSettings) -> Result<Vec<[Compared; 3]>, CaseError> {
    let compared = |number| {
        let (known, paper) = match number {
            0 => (Known::delta_wing()?, correlate_wing(&DeltaWing::embedded()?, |_, _| {})?.correlation),
            _ => (Known::of_case(number)?, run_case(&Case::new(number)?, |_, _| {})?.correlation),
        };
        let weights = equal_weights(DEVIATIONS, known.test.len())?;
        let analyze = |factors: &[f64]| known.model.analyze(factors, &known.test, None);
        let ones = vec![1.0; known.truth.len()];
        let found = gauss_newton(analyze, &ones, &known.model.factor_ranges()?, &weights, settings)?;
        let steps = paper.passes.iter().map(|pass| pass.inner.iterations.len()).sum();
        Ok([
            known.compared("none", [0, 1], &ones),
            known.compared("paper", [steps, paper.passes.len() + 1], &paper.best_factors()),
            known.compared("gauss_newton", [found.iterations.len(), found.analyses], &found.factors),
        ])
    };
    [1, 2, 3, 0].into_iter().map(compared).collect()
}
