//! The entries of a job's `[correlation]`, and numbers that a parameter's say.

use super::{Job, ParameterRule, Scales};
use crate::{
    files::error::{FileError, ensure},
    method::{
        inner_loop::InnerSettings,
        outer_loop::Settings,
        step::{Accumulation, Bounds, StepRule},
    },
    weighted::identifiability::PRIOR_DEVIATION,
};
use serde::Deserialize;

/// Entries of `[correlation]`; skipped fields keep the library's value.
#[derive(Deserialize)]
#[serde(
    remote = "Settings",
    default = "Settings::default",
    deny_unknown_fields
)]
pub struct CorrelationEntries {
    #[serde(with = "InnerEntries")]
    inner: InnerSettings,
    later_inner_tolerance: f64,
    error_sum_tolerance: f64,
    frequency_tolerance: f64,
    shape_tolerance: f64,
    #[serde(skip)]
    least_passes: usize,
    most_passes: usize,
}

#[derive(Deserialize)]
#[serde(
    remote = "InnerSettings",
    default = "InnerSettings::default",
    deny_unknown_fields
)]
struct InnerEntries {
    #[serde(skip)]
    first_relaxation: f64,
    #[serde(skip)]
    relaxation: f64,
    factor_range: Bounds,
    tolerance: f64,
    #[serde(skip)]
    halvings: usize,
    #[serde(skip)]
    iterations: usize,
    step: StepRule,
    #[serde(skip)]
    accumulation: Accumulation,
}

impl ParameterRule {
    /// The bounds on a parameter's factor: its own, and those that keep elements of the given first sizes within the bounds on sizes.
    pub(super) fn range(&self, job: &Job, sizes: &[f64]) -> Result<Option<Bounds>, FileError> {
        let name = &self.name;
        let both = |[lower, upper]: [Option<f64>; 2], names: &str, what: &str| match (lower, upper)
        {
            (None, None) => Ok(None),
            (Some(lower), Some(upper)) => Ok(Some(Bounds::positive(
                &format!("{what} of parameter {name}"),
                lower,
                upper,
            )?)),
            _ => Err(job.refused(format!(
                "parameter \"{name}\" needs both {names}, or neither"
            ))),
        };
        let own = both([self.lower, self.upper], "lower and upper", "factor")?;
        let of_sizes = both(
            [self.lower_size, self.upper_size],
            "lower_size and upper_size",
            "sizes",
        )?;
        let Some(of_sizes) = of_sizes else {
            return Ok(own);
        };
        ensure(
            !sizes.is_empty() && self.scales == Scales::Stiffness,
            || {
                job.refused(format!(
                    "parameter \"{name}\": bounds on sizes are for the stiffness of a deck's elements"
                ))
            },
        )?;
        let (lower, upper) = own.map_or((0.0, f64::INFINITY), |own| (own.lower, own.upper));
        let all = || sizes.iter();
        let lower = all().fold(lower, |lower, size| lower.max(of_sizes.lower / size));
        let upper = all().fold(upper, |upper, size| upper.min(of_sizes.upper / size));
        let what = format!("factor of parameter {name}");
        Ok(Some(Bounds::positive(&what, lower, upper)?))
    }

    /// The prior deviation of a parameter: its own, or that of all.
    pub(super) fn prior(&self, job: &Job) -> Result<f64, FileError> {
        let given = self.prior_deviation.or(job.compare.prior_deviation);
        let prior = given.unwrap_or(PRIOR_DEVIATION);
        ensure(prior > 0.0 && prior.is_finite(), || {
            let name = &self.name;
            job.refused(format!(
                "parameter \"{name}\": prior_deviation is {prior}; it must be positive and finite"
            ))
        })?;
        Ok(prior)
    }
}
