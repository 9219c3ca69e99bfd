//! A job before its first step: what is doubtful of it, its model, sensors and modes, the suspects, and where to measure next.

use super::PresentError;
use super::report::{facts, places};
use super::table::{Table, counted};
use super::views::{KNOW, PARTNERS, trust_table};
use crate::files::error::FileError;
use crate::job::localization::{Suspect, by_single_fit, unexplained};
use crate::job::{PreparedJob, Trust, mean_deviation};
use crate::weighted::residuals::residuals;
use nalgebra::DVector;
use serde_json::{Value, json};

/// Most parameters in the table of suspects.
pub const MOST_SUSPECTS: usize = 20;
/// Most changes of one kind in the table of where to measure next.
const MOST_CHANGES: usize = 3;
/// Columns of the modes of the first model.
const FIRST: [&str; 6] = [
    "mode",
    "test_hz",
    "first_mode",
    "first_hz",
    "first_error_percent",
    "first_mac",
];

/// Everything that is known of a job before its first step.
///
/// # Errors
/// The errors of the first analysis.
pub fn check_tables(prepared: &PreparedJob, trust: &Trust) -> Result<Vec<Table>, PresentError> {
    let first = prepared.analyze(&prepared.loaded.ones())?.result()?;
    let modes = prepared.compared_with(&first, &first).modes()?;
    let mut tables = vec![
        trust_table(KNOW, trust),
        Table::of("model", "The model", &facts(prepared)?, &[]),
        Table::of(
            "sensors",
            "Sensors on the model",
            &places(&prepared.loaded),
            &[],
        ),
        Table::of("modes", PARTNERS, &modes, &FIRST),
    ];
    // A test that is doubtful accuses any parameter.
    if !trust.has_doubt() {
        tables.push(suspects_table(prepared));
    }
    tables.push(measurement_table(prepared));
    Ok(tables)
}

/// Parameters that may be the one that is wrong, by how much of the test's chi-squared each alone can take away, at most
/// [`MOST_SUSPECTS`]. What keeps them from being ranked is a note.
pub fn suspects_table(prepared: &PreparedJob) -> Table {
    let title = "Suspects: what one parameter alone explains";
    let (rows, notes) =
        suspects(prepared).unwrap_or_else(|why| (Vec::new(), vec![format!("Not ranked: {why}.")]));
    Table::of("suspects", title, &rows, &[]).notes(notes)
}

fn suspects(prepared: &PreparedJob) -> Result<(Vec<Value>, Vec<String>), FileError> {
    let loaded = &prepared.loaded;
    let names: Vec<&str> = loaded.parameter_names().collect();
    let far = prepared.far_from_first()?;
    let first = far.analyze(&loaded.ones())?;
    let weights = far.weights();
    let suspects = by_single_fit(&first, &weights)?;
    let note = format!(
        "Evidence: how far half the weighted squared error, {:.3e} from {} measured numbers, falls when this parameter alone has \
        this factor: the logarithm of a likelihood ratio, in which less than about three says nothing. Where the first leaves much \
        more than half a unit a number, several are wrong, and it need not be among them. Modes are combined from {} of the first \
        model; far from one, factors are rough where these are few.",
        unexplained(&first, &weights)?,
        residuals(&first, &weights)?.len(),
        first.model.exact.modes.len(),
    );
    let (shown, rest) = suspects.split_at(suspects.len().min(MOST_SUSPECTS));
    let mut notes = vec![note];
    let at_edge = shown.iter().filter(|suspect| suspect.is_at_edge());
    let at_edge: Vec<&str> = at_edge.map(|suspect| names[suspect.parameter]).collect();
    if !at_edge.is_empty() {
        let edge = "At the edge of the search, beyond which more may be explained";
        notes.push(format!("{edge}: {}.", at_edge.join(", ")));
    }
    if !rest.is_empty() {
        notes.push(format!(
            "{} less.",
            counted(rest.len(), "parameter explains", "parameters explain")
        ));
    }
    let row = |own: &Suspect| json!({"parameter": names[own.parameter], "factor": own.factor, "evidence": own.evidence});
    Ok((shown.iter().map(row).collect(), notes))
}

/// Changes of a test that lower the deviations of the factors most, or raise them least, at most three of a kind. What keeps them from
/// being ranked is a note.
pub fn measurement_table(prepared: &PreparedJob) -> Table {
    let note = "Deviation: root mean square of the factors' standard deviations (of logarithms, with priors), by the slopes at the \
        first model. A new sensor is taken to read what the model says. Every reading has the noise that it has in this test, a fraction of its \
        largest one, and a new one that of its shape.";
    let names: Vec<&str> = prepared.loaded.parameter_names().collect();
    let row = |(test, deviations): (String, Vec<f64>)| {
        let worst = DVector::from_column_slice(&deviations).imax();
        let [mean, largest] =
            [mean_deviation(&deviations), deviations[worst]].map(|own| 100.0 * own);
        json!({"test": test, "deviation_percent": mean, "largest_percent": largest, "parameter": names[worst]})
    };
    let (rows, notes) = match prepared.next_measurement() {
        Err(why) => (Vec::new(), vec![format!("Not ranked: {why}.")]),
        Ok(next) => {
            let shown = next
                .changes
                .into_iter()
                .flat_map(|own| own.into_iter().take(MOST_CHANGES));
            (shown.map(row).collect(), next.unranked)
        }
    };
    let is_ranked = !rows.is_empty();
    Table::of("next_measurement", "Where to measure next", &rows, &[])
        .notes(is_ranked.then_some(note))
        .notes(notes)
}
