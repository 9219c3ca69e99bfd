//! The entries of a job's `[correlation]`, and those that jobs no longer have.

use crate::files::error::FileError;
use crate::method::inner_loop::InnerSettings;
use crate::method::outer_loop::Settings;
use crate::method::step::{Accumulation, Bounds, StepRule};
use serde::Deserialize;
use std::path::Path;
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

/// Entries that jobs no longer have, and the rules in their place.
const REMOVED: [(&str, &str); 13] = [
    (
        "test.orthogonalize",
        "test modes are compared as they were measured",
    ),
    (
        "compare.modes",
        "the whole model's modes are compared at the sensors",
    ),
    (
        "compare.pairing",
        "modes are paired for the largest sum of modal assurance",
    ),
    (
        "compare.floor",
        "test modes with a modal assurance below 0.5 with the first model are left out and named",
    ),
    (
        "correlation.least_passes",
        "the loop ends after the first pass within tolerance",
    ),
    (
        "correlation.inner.first_relaxation",
        "the first iteration of a pass takes 0.8 of its step",
    ),
    (
        "correlation.inner.relaxation",
        "iterations after the first take their whole step",
    ),
    (
        "correlation.inner.halvings",
        "a step that does not lower the error sum is halved up to five times",
    ),
    (
        "correlation.inner.iterations",
        "a pass takes at most 30 iterations",
    ),
    (
        "correlation.inner.derivatives",
        "derivatives are taken by definition (12)",
    ),
    (
        "correlation.inner.accumulation",
        "changes of stiffness within a pass add up",
    ),
    (
        "correlation.inner.measure",
        "errors are sums over nine modes, whatever the number compared",
    ),
    (
        "correlation.inner.update",
        "modes follow the factors by Recursive 1",
    ),
];

/// The message for a step rule that is gone.
pub fn removed_step(name: &str) -> Option<String> {
    ["sum", "steepest_descent"]
        .contains(&name)
        .then(|| format!("the step rule {name} is gone; choose matrix, own, relative or gage"))
}

/// The value of an entry in a table within the file, such as `compare.seed`.
pub(super) fn entry_of<'a>(file: &'a Table, entry: &str) -> Option<&'a Value> {
    let (first, rest) = entry.split_once('.')?;
    rest.split('.')
        .try_fold(file.get(first)?, |value, key| value.get(key))
}

/// Refuses a job that names an entry or a rule that jobs no longer have.
///
/// # Errors
/// [`FileError::Refused`].
pub(super) fn refuse_removed(path: &Path, file: &Table) -> Result<(), FileError> {
    let at = |entry: &str| entry_of(file, entry);
    let removed = REMOVED.iter().find(|(entry, _)| at(entry).is_some());
    let removed =
        removed.map(|(entry, instead)| format!("{entry} is no longer an entry: {instead}"));
    let step = at("correlation.inner.step").and_then(Value::as_str);
    let reason = removed.or_else(|| {
        let removed = step.and_then(removed_step)?;
        Some(format!("correlation.inner.step: {removed}"))
    });
    match reason {
        Some(reason) => Err(FileError::refused(path.display(), reason)),
        None => Ok(()),
    }
}
