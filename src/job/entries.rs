//! The entries of a job's `[correlation]`, and those that jobs no longer have.

use crate::method::inner_loop::InnerSettings;
use crate::method::outer_loop::Settings;
use crate::method::step::{Accumulation, Bounds, StepRule};
use serde::Deserialize;
use toml::{Table, Value};

/// Entries of `[correlation]`; skipped fields keep the library's value.
#[derive(Deserialize)]
#[serde(
    remote = "Settings",
    default = "Settings::default",
    deny_unknown_fields
)]
pub(super) struct CorrelationEntries {
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

/// The value of an entry in a table within the file, such as `compare.seed`.
pub(super) fn entry_of<'a>(file: &'a Table, entry: &str) -> Option<&'a Value> {
    let (first, rest) = entry.split_once('.')?;
    rest.split('.')
        .try_fold(file.get(first)?, |value, key| value.get(key))
}
