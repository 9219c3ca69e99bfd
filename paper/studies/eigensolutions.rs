//! How many full eigensolutions a correlation takes: perturbation between exact checks against a new analysis after every step.

use super::known::WING_MODES;
use super::known::eigensolved::Eigensolved;
use crate::prelude::*;

/// Error sums to be reached, fractions.
pub const ERRORS: [f64; 2] = [0.05, 0.025];
/// Most passes before a correlation counts as one that does not get there.
const MOST_PASSES: usize = 200;

/// What one way of getting to an error takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Full finite element analyses, each with its eigensolution.
    pub analyses: usize,
    /// Steps of all parameters.
    pub steps: usize,
    /// Whether the error was reached.
    pub reached: bool,
}

/// Both ways on one structure to one error.
#[derive(Debug, Clone, PartialEq)]
pub struct Counted {
    /// The structure.
    pub name: String,
    /// The exact error sum to be reached, a fraction.
    pub error: f64,
    /// How many parameters there are: as many eigensolutions a step would differences take for derivatives.
    pub parameters: usize,
    /// The method's: modes follow the steps by perturbation, and only the end of an inner loop is analyzed.
    pub perturbation: Effort,
    /// By the same rule of the step, with an analysis after every single step.
    pub reanalysis: Effort,
}

/// Counts both ways on one structure to an exact error sum, with the rule of the step of given settings, and what the loops are handed of
/// each analysis.
///
/// # Errors
/// Those of the analysis and of [`correlate`].
pub fn counted<A: Analysis>(
    known: &Known,
    modes: Option<usize>,
    (settings, handed): (&Settings, fn(Model) -> A),
    error: f64,
) -> Result<Counted, Error> {
    let effort = |inner: InnerSettings| {
        let mut settings = Settings {
            inner,
            later_inner_tolerance: 0.5 * error,
            ..settings.clone()
        };
        (settings.inner.tolerance, settings.error_sum_tolerance) = (error, error);
        // Neither error alone exceeds the sum.
        (
            settings.frequency_tolerance,
            settings.shape_tolerance,
            settings.most_passes,
        ) = (error, error, MOST_PASSES);
        let mut analyses = 0;
        let analyze = |factors: &[f64]| {
            analyses += 1;
            let model = known.model.analyze(factors, &known.test, modes)?;
            Ok::<_, Error>(handed(model))
        };
        let found = correlate(analyze, &known.model.factor_ranges()?, &settings, |_, _| {
            true
        })?;
        let steps = found
            .passes
            .iter()
            .map(|pass| pass.inner.iterations.len())
            .sum();
        Ok(Effort {
            analyses,
            steps,
            reached: found.converged,
        })
    };
    let inner = settings.inner.clone();
    let single = InnerSettings {
        iterations: 1,
        first_relaxation: inner.relaxation,
        ..inner.clone()
    };
    let (name, parameters) = (known.name.clone(), known.truth.len());
    Ok(Counted {
        name,
        error,
        parameters,
        perturbation: effort(inner)?,
        reanalysis: effort(single)?,
    })
}

/// Cases 1 to 3, the delta wing and the wing of 1,458 structural DOF, each to all the errors.
///
/// # Errors
/// Those of the models and of [`counted`].
pub fn count_all(errors: &[f64]) -> Result<Vec<Counted>, CaseError> {
    let mut all = Vec::new();
    for number in 1..=3 {
        let (known, settings) = (Known::of_case(number)?, Case::new(number)?.settings);
        for &error in errors {
            all.push(counted(&known, None, (&settings, |model| model), error)?);
        }
    }
    let wings = [
        (Known::delta_wing()?, None),
        (planted(&Wing::default())?, Some(WING_MODES)),
    ];
    for (known, modes) in &wings {
        for &error in errors {
            let settings = (&correlation::settings(), Eigensolved as fn(Model) -> _);
            all.push(counted(known, *modes, settings, error)?);
        }
    }
    Ok(all)
}

/// Full eigensolutions to an exact error sum, by perturbation and with an analysis after every step.
pub fn eigensolution_table(counted: &[Counted]) -> Table {
    let note = "Perturbation: the method, whose steps within a pass take no eigensolution. Re-analysis: the same rule of the step with \
        an analysis after every one. And differences: derivatives by an eigensolution per parameter and step too. A + says that \
        the error was not reached.";
    let mut table = Table::new(
        "eigensolutions",
        "Full eigensolutions to an error sum, counted",
        "Structure, error sum",
    )
    .headings(
        [
            "Steps",
            "Perturbation",
            "Steps one by one",
            "Re-analysis",
            "And differences",
        ],
        "",
    )
    .notes([note]);
    for of in counted {
        let solutions = |analyses: usize, reached| match reached {
            true => Cell::count(analyses),
            false => Cell::text(format!("{analyses}+")),
        };
        let (quick, slow) = (of.perturbation, of.reanalysis);
        let all = slow.analyses + slow.steps * of.parameters;
        let cells = [
            Cell::count(quick.steps),
            solutions(quick.analyses, quick.reached),
            Cell::count(slow.steps),
        ];
        let others = [slow.analyses, all].map(|count| solutions(count, slow.reached));
        table.row(
            format!("{}, {} %", of.name, 100.0 * of.error),
            cells.into_iter().chain(others),
        );
    }
    table
}
