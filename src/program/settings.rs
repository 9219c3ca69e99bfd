//! Settings of the loops from the command line, so that a reader tries another reading without writing Rust.

use clap::Args;
use corfem::method::outer_loop::Settings;
use corfem::method::step::{Bounds, StepRule};
use corfem::present::PresentError;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::{Error, StrDeserializer};
use std::num::NonZeroUsize;

#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Settings of the loops")]
pub struct SettingsArguments {
    /// Reading of the step (13), which measures the change of stiffness of an element:
    ///   own       by its stiffness in each test mode
    ///   matrix    by that and what it couples between test modes
    ///   relative  by the relative change alone, so that every element counts the same
    ///   gage      by the change of its gage, so that thin panels change more
    #[arg(long, value_name = "RULE", value_parser = named, verbatim_doc_comment)]
    rule: Option<StepRule>,
    /// Relaxation R of a pass's first iteration, and of the others
    #[arg(long, value_name = "FIRST,OTHERS", value_parser = pair)]
    relaxation: Option<(f64, f64)>,
    /// Tolerance on the error sum of the inner loop in the first pass, and in the others; fractions
    #[arg(long, value_name = "FIRST,OTHERS", value_parser = pair)]
    tolerance: Option<(f64, f64)>,
    /// Bounds on the factor of one iteration
    #[arg(long, value_name = "LOWER,UPPER", value_parser = pair)]
    limits: Option<(f64, f64)>,
    /// Most inner iterations of a pass
    #[arg(long, value_name = "N")]
    iterations: Option<NonZeroUsize>,
    /// Most passes
    #[arg(long, value_name = "N")]
    passes: Option<NonZeroUsize>,
}

/// A rule by its name in JSON, so that what the report prints can be typed.
fn named(text: &str) -> Result<StepRule, Error> {
    let from: StrDeserializer<Error> = text.into_deserializer();
    StepRule::deserialize(from)
}

impl SettingsArguments {
    /// Replaces a run's settings by those that were given.
    pub fn apply(&self, settings: &mut Settings) -> Result<(), PresentError> {
        let inner = &mut settings.inner;
        inner.step = self.rule.unwrap_or(inner.step);
        if let Some((first, others)) = self.relaxation {
            (inner.first_relaxation, inner.relaxation) = (first, others);
        }
        if let Some((first, others)) = self.tolerance {
            (inner.tolerance, settings.later_inner_tolerance) = (first, others);
        }
        if let Some((lower, upper)) = self.limits {
            inner.factor_range = Bounds::positive("--limits", lower, upper)?;
        }
        inner.iterations = self.iterations.map_or(inner.iterations, NonZeroUsize::get);
        settings.most_passes = self.passes.map_or(settings.most_passes, NonZeroUsize::get);
        settings.least_passes = settings.least_passes.min(settings.most_passes);
        Ok(())
    }
}

/// The two numbers of an option.
fn pair(text: &str) -> Result<(f64, f64), String> {
    let numbers = text.split_once(',');
    let numbers = numbers.and_then(|(one, other)| Some((one.parse().ok()?, other.parse().ok()?)));
    numbers.ok_or("two numbers with a comma between them are needed".to_owned())
}
