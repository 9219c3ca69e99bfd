//! Results as JSON: every document begins with program, version and units, and a correlation always has the same form.
//!
//! Errors are fractions (RMS and sums alike), gages inches, frequencies hertz in the order of the test modes. Factors
//! of a pass are totals since the first model, those of an iteration totals since the last exact solution. A number
//! that is not finite is `null`. Every function that writes a document has the errors of [`document`].

use super::PresentError;
use super::report::{Report, Stage};
use super::tables::deck::{not_read, unit_shapes};
use crate::files::deck::Unread;
use crate::files::test_data::DIRECTIONS;
use crate::files::turns;
use crate::job::of_bodies;
use crate::method::inner_loop::Iteration;
use crate::method::structure::StructuralDof;
use crate::sparse::whole_modes::WholeModes;
use crate::weighted::comparison::ExactResult;
use nalgebra::RowDVector;
use serde::Serialize;
use serde_json::{Value, json};

/// A document with its heading.
#[derive(Serialize)]
struct Document<T> {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    #[serde(flatten)]
    content: T,
}

/// A document of the paper's structure with its heading as pretty-printed JSON and a final newline.
///
/// # Errors
/// [`PresentError::Json`], which memory alone could cause.
pub fn document(content: impl Serialize) -> Result<String, PresentError> {
    in_units(
        "inch, pound-force, second, hertz; errors are fractions",
        content,
    )
}

/// A document of a user's structure with its heading, as [`document`].
///
/// # Errors
/// [`PresentError::Json`], as [`document`].
pub fn own_document(content: impl Serialize) -> Result<String, PresentError> {
    in_units(
        "the model's own units, hertz; errors are fractions",
        content,
    )
}

fn in_units(units: &'static str, content: impl Serialize) -> Result<String, PresentError> {
    let document = Document {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        units,
        content,
    };
    let mut text = String::new();
    for c in serde_json::to_string_pretty(&document)?.chars() {
        match turns(c) {
            true => text += &format!("\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    Ok(text + "\n")
}

/// Any correlation: its parameters by name, its test, its verdict, and its whole history.
///
/// # Errors
/// The errors of [`Report::agreement`].
pub fn report(report: &Report) -> Result<Value, PresentError> {
    let factors = report.factors();
    let at_bound = factors.iter().enumerate();
    let at_bound = at_bound.map(|(e, factor)| report.is_at_bound(e, *factor));
    let mut initial = solution(&report.initial);
    initial["agreement"] = json!(report.agreement(&report.initial)?);
    let mut value = serde_json::to_value(report)?;
    let follows = json!({
        "answer": report.answer(),
        "converged": report.converged(),
        "checks": report.trust.as_ref().map(|trust| trust.answers(report.verdict.is_some())),
        "verdict_in_words": report.words(),
        "factors": factors,
        "prior_shares": report.prior_shares(),
        "failed_starts": report.failed_starts(),
        "at_bound": at_bound.collect::<Vec<_>>(),
        "best_pass": report.best.map(|best| best + 1),
        "test_frequencies_hz": report.test.frequencies_hz(),
        "frequencies_alone": (0..report.initial.lone.len())
            .map(|place| frequency_alone(report, place))
            .collect::<Value>(),
        "initial": initial,
        "corrected_agreement": report.agreement(report.corrected())?,
        "passes": report.stages.iter().map(pass).collect::<Value>(),
    });
    if let (Some(all), Value::Object(follows)) = (value.as_object_mut(), follows) {
        all.extend(follows);
    }
    Ok(value)
}

/// A frequency of the test without a shape with its partners in the first and the corrected model; places count from one.
fn frequency_alone(report: &Report, place: usize) -> Value {
    let lone = |check: &ExactResult| check.lone[place];
    let hertz = |check: &ExactResult| check.modes.frequencies_hz()[lone(check).partner];
    let both = [&report.initial, report.corrected()];
    json!({
        "mode": report.mode_number(report.test.len() + place),
        "test_hz": lone(&report.initial).frequency_hz,
        "analysis_modes": both.map(|check| lone(check).partner + 1),
        "frequencies_hz": both.map(hertz),
    })
}

fn solution(check: &ExactResult) -> Value {
    json!({
        "frequencies_hz": check.frequencies_hz,
        "frequency_rms": check.errors.frequency_rms(),
        "shape_rms": check.errors.shape_rms(),
    })
}

fn pass(stage: &Stage) -> Value {
    let inner = stage.inner.as_ref();
    let history = inner.map_or(&[][..], |inner| &inner.iterations);
    json!({
        "iterations": inner.map_or(1, |inner| inner.iterations.len()),
        "stop": inner.map_or_else(|| json!(stage.stop), |inner| json!(inner.stop)),
        "unlimited_factors": inner.map(|inner| &inner.first_unlimited_factors),
        "factors": stage.factors,
        "exact": solution(&stage.check),
        "history": history.iter().map(iteration).collect::<Value>(),
    })
}

/// One iteration of an inner loop: its errors, halvings, factors and the limits that held them.
pub fn iteration(iteration: &Iteration) -> Value {
    json!({
        "frequency_error": iteration.errors.frequency,
        "shape_error": iteration.errors.shape,
        "error_sum": iteration.errors.sum(),
        "halvings": iteration.halvings,
        "unlimited_factors": iteration.unlimited_factors,
        "factors": iteration.factors,
        "limits": iteration.limits,
    })
}

/// The lowest `count` modes of a deck or of matrices, every shape scaled to a largest component of one; components in the order of
/// `dof`, which is empty for matrices that do not name their rows. `moving` has them in the same scale at all that moves in a deck.
pub fn deck_modes(
    unread: &[Unread],
    modes: &WholeModes,
    moving: &[(StructuralDof, RowDVector<f64>)],
    count: usize,
) -> Result<String, PresentError> {
    let (masses, shapes) = unit_shapes(modes, count);
    let named =
        |dof: &StructuralDof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]});
    let at = |mode: usize, mass: &f64| {
        let components = moving.iter().map(|(_, shape)| shape[mode] * mass.sqrt());
        components.collect::<Value>()
    };
    own_document(json!({
        "dof": modes.dof.iter().map(named).collect::<Value>(),
        "moving_dof": moving.iter().map(|(dof, _)| named(dof)).collect::<Value>(),
        "moving_shapes": masses.iter().enumerate().map(|(mode, mass)| at(mode, mass)).collect::<Value>(),
        "rigid_body_modes": modes.rigid_body,
        "doubtful": modes.doubtful.iter().map(|found| of_bodies(found).words).collect::<Vec<_>>(),
        "frequencies_hz": modes.modes.frequencies_hz().into_iter().take(count).collect::<Value>(),
        "generalized_masses": masses,
        "shapes": shapes,
        "not_read": unread.iter().map(not_read).collect::<Value>(),
    }))
}
