//! Settings of the loops from the command line, so that a reader tries another reading without writing Rust.

use clap::Args;
use corfem::method::linear_algebra::check_length;
use corfem::method::outer_loop::Settings;
use corfem::method::step::Bounds;
use corfem::method::step::{Accumulation, StepRule};
use corfem::present::PresentError;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::{Error, StrDeserializer};

#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Settings of the loops")]
pub struct SettingsArguments {
    /// Reading of the step (13), which measures the change of stiffness of an element:
    ///   own       by its stiffness in each test mode
    ///   matrix    by that and what it couples between test modes
    ///   relative  by the relative change alone, so that every element counts the same
    ///   gage      by the change of its gage, so that thin panels change more
    #[arg(long, value_name = "RULE", value_parser = named::<StepRule>, verbatim_doc_comment)]
    rule: Option<StepRule>,
    /// Combination of the changes of several iterations:
    ///   sum       each changes the stiffness that the pass began with, as the paper prints
    ///   product   each changes the present stiffness
    #[arg(long, value_name = "HOW", value_parser = named::<Accumulation>, verbatim_doc_comment)]
    accumulation: Option<Accumulation>,
    /// Relaxation R of a pass's first iteration, and of the others
    #[arg(long, value_name = "FIRST,OTHERS", value_delimiter = ',')]
    relaxation: Option<Vec<f64>>,
    /// Tolerance on the error sum of the inner loop in the first pass, and in the others; fractions
    #[arg(long, value_name = "FIRST,OTHERS", value_delimiter = ',')]
    tolerance: Option<Vec<f64>>,
    /// Bounds on the factor of one iteration
    #[arg(long, value_name = "LOWER,UPPER", value_delimiter = ',')]
    limits: Option<Vec<f64>>,
    /// Most inner iterations of a pass
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    iterations: Option<u32>,
    /// Most passes
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    passes: Option<u32>,
}

/// A value by its name in JSON, so that what the report prints can be typed.
fn named<T: for<'a> Deserialize<'a>>(text: &str) -> Result<T, Error> {
    let from: StrDeserializer<Error> = text.into_deserializer();
    T::deserialize(from)
}

impl SettingsArguments {
    /// Replaces a run's settings by those that were given.
    pub fn apply(&self, settings: &mut Settings) -> Result<(), PresentError> {
        let inner = &mut settings.inner;
        inner.step = self.rule.unwrap_or(inner.step);
        inner.accumulation = self.accumulation.unwrap_or(inner.accumulation);
        if let Some((first, others)) = pair("--relaxation", self.relaxation.as_deref())? {
            (inner.first_relaxation, inner.relaxation) = (first, others);
        }
        if let Some((first, others)) = pair("--tolerance", self.tolerance.as_deref())? {
            (inner.tolerance, settings.later_inner_tolerance) = (first, others);
        }
        if let Some((lower, upper)) = pair("--limits", self.limits.as_deref())? {
            inner.factor_range = Bounds::positive("--limits", lower, upper)?;
        }
        inner.iterations = self
            .iterations
            .map_or(inner.iterations, |most| most as usize);
        settings.most_passes = self
            .passes
            .map_or(settings.most_passes, |most| most as usize);
        settings.least_passes = settings.least_passes.min(settings.most_passes);
        Ok(())
    }
}

/// The two numbers of an option.
fn pair(option: &'static str, values: Option<&[f64]>) -> Result<Option<(f64, f64)>, PresentError> {
    let Some(values) = values else {
        return Ok(None);
    };
    check_length(option, values.len(), 2)?;
    Ok(Some((values[0], values[1])))
}
