//! A job before and after: its sensors on the model, everything doubtful, the suspects, and what the test sees of the parameters.

use crate::files::error::FileError;
use crate::files::job::{ComparedModes, Finished, Prepared};
use crate::files::test_data::DIRECTIONS;
use crate::method::model::DynamicModel;
use crate::present::table::{Cell, Digits, Table, counted};
use crate::studies::localization::{by_factor, by_single_fit};
use crate::studies::metrics::coordinate_assurance;
use crate::studies::preflight::{Finding, coarse_condensation, preflight};
use crate::studies::weighted::residuals::residuals;

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;
/// Most parameters in the table of suspects.
pub const MOST_SUSPECTS: usize = 20;

/// Every sensor with its grid, direction and distance, and the coordinate modal assurance criterion (COMAC) of the first model and of
/// the corrected one there.
///
/// # Errors
/// Those of [`coordinate_assurance`].
pub fn places_table(prepared: &Prepared, finished: Option<&Finished>) -> Result<Table, FileError> {
    let models = finished.iter().flat_map(|finished| [&finished.first, &finished.last]);
    let assurance = models.map(|model| {
        let pairs: Vec<Option<usize>> = model.exact.pairing.analysis_mode.iter().copied().map(Some).collect();
        coordinate_assurance(&model.exact.modes.shapes, &model.test.shapes, &pairs)
    });
    let assurance = assurance.collect::<Result<Vec<_>, _>>()?;
    let table = Table::new("sensors", "Sensors on the model", "Sensor").columns(["grid", "direction", "distance"], "");
    let mut table = table.columns(["first COMAC", "corrected COMAC"].into_iter().take(assurance.len()), "");
    for (row, sensor) in prepared.placed.iter().enumerate() {
        let sign = if sensor.sign < 0.0 { "-" } else { "" };
        // An axis of the test's own is told by its components.
        let own = || format!(" ({:.2} {:.2} {:.2})", sensor.axis.x, sensor.axis.y, sensor.axis.z);
        let own = if sensor.axis.amax() < 1.0 { own() } else { String::new() };
        let direction = Cell::text(format!("{sign}{}{own}", DIRECTIONS[sensor.direction]));
        let distance = sensor.distance.map_or(Cell::Blank, |distance| Cell::number(distance, Digits::Fixed(3)));
        let place = [Cell::count(sensor.grid), direction, distance];
        let assurance = assurance.iter().map(|assurance| Cell::number(assurance[row], Digits::Fixed(3)));
        table.row(&sensor.name, place.into_iter().chain(assurance));
    }
    let all = prepared.data.sensors.len();
    if all > prepared.placed.len() {
        table.notes.push(format!("{} of the test's {all} sensors are not used.", all - prepared.placed.len()));
    }
    Ok(table)
}

/// Everything doubtful of a job before its first step: what the pre-flight finds, test modes that are left out, and what the
/// readers left aside.
///
/// # Errors
/// Those of [`preflight`] and of the analyses it needs; a structure that is not held has no condensed model to look at, and a
/// sentence says so.
pub fn doubts_table(prepared: &Prepared) -> Result<Table, FileError> {
    let whole = &prepared.source.whole;
    let ones = vec![1.0; whole.parameters().len()];
    let settings = &prepared.job.correlation;
    let mut sentences = Vec::new();
    match whole.condensed(&ones, &prepared.sensors) {
        Ok((condensed, mass)) => {
            let model = DynamicModel { stiffness: condensed.stiffness, mass, shares: Vec::new() };
            let findings = preflight(&model, &prepared.test, settings, &whole.ranges())?;
            sentences.extend(findings.iter().map(Finding::to_string));
            if prepared.job.compare.modes == ComparedModes::Condensed {
                let count = prepared.test.len().min(model.mass.nrows());
                let coarse = coarse_condensation(whole, &ones, &prepared.sensors, count)?;
                sentences.extend(coarse.iter().map(Finding::to_string));
            }
        }
        Err(error) => {
            sentences.push(format!("the pre-flight looks at condensed matrices, which are not to be had: {error}"))
        }
    }
    for (mode, assurance) in &prepared.unpaired {
        sentences.push(format!(
            "test mode {}: no mode of the first model is like it (modal assurance {assurance:.2} at most); it is left out",
            mode + 1
        ));
    }
    for (mode, report) in &prepared.deleted {
        sentences.push(format!("test mode {}: deleted by Appendix B ({:?})", mode + 1, report.verdict));
    }
    for (mode, phase) in prepared.data.phase_collinearity.iter().enumerate().filter(|(_, phase)| **phase < COLLINEAR) {
        sentences.push(format!("test mode {}: complex, with a phase collinearity of {phase:.2}", mode + 1));
    }
    if !prepared.data.skipped.is_empty() {
        let numbers: Vec<String> = prepared.data.skipped.iter().map(usize::to_string).collect();
        sentences.push(format!("datasets of the Universal File that are not read: {}", numbers.join(", ")));
    }
    if let Some(units) = &prepared.data.units {
        sentences.push(format!("the test's file is in units of {units}; nothing is converted"));
    }
    let mut table = Table::new("doubts", "Before the first step", "Number").column("Finding", "");
    for (row, sentence) in sentences.iter().enumerate() {
        table.row(row + 1, [Cell::text(sentence)]);
    }
    if sentences.is_empty() {
        table.row("", [Cell::text("nothing doubtful")]);
    }
    Ok(table)
}

/// Parameters that may be the one that is wrong, by how much of the test's chi-squared each alone can take away, at most
/// [`MOST_SUSPECTS`]; beside it the paper's unlimited factor of the first iteration.
///
/// # Errors
/// Those of [`Prepared::weights`] and of the rankings.
pub fn suspects_table(prepared: &Prepared) -> Result<Table, FileError> {
    let parameters = prepared.source.whole.parameters();
    let (first, weights) = (prepared.analyze(&vec![1.0; parameters.len()])?, prepared.weights()?);
    let suspects = by_single_fit(&first, &weights)?;
    let slopes = by_factor(&first, &prepared.job.correlation.inner)?;
    let residuals = residuals(&first, &weights)?;
    let mut table = Table::new("suspects", "Suspects: what one parameter alone explains", "Parameter")
        .columns(["factor", "evidence", "paper's factor"], "")
        .note(format!(
            "Evidence: how far half the weighted squared error, {:.3e} from {} measured numbers, falls when this parameter alone \
            has this factor: the logarithm of a likelihood ratio, in which less than about three says nothing. Where the first \
            leaves much more than half a unit a number, several are wrong, and it need not be among them. Modes are combined \
            from {} of the first model; far from one, factors are rough where these are few. Paper's factor: unlimited, of the \
            first iteration.",
            0.5 * residuals.norm_squared(),
            residuals.len(),
            first.exact.modes.len(),
        ));
    for suspect in suspects.iter().take(MOST_SUSPECTS) {
        let slope = slopes.iter().find(|slope| slope.parameter == suspect.parameter);
        let [factor, evidence] =
            [suspect.factor, suspect.evidence].map(|value| Cell::number(value, Digits::Significant(3)));
        let slope = slope.map_or(Cell::Blank, |slope| Cell::number(slope.factor, Digits::Fixed(2)));
        table.row(&parameters[suspect.parameter].name, [factor, evidence, slope]);
    }
    if suspects.len() > MOST_SUSPECTS {
        let left = counted(suspects.len() - MOST_SUSPECTS, "parameter explains", "parameters explain");
        table.notes.push(format!("{left} less."));
    }
    Ok(table)
}

/// What the test sees of the parameters, at the first model and at the best factors: 95 % intervals, and who is blind or parallel.
pub fn seen_table(prepared: &Prepared, finished: &Finished) -> Result<Table, FileError> {
    let names: Vec<&str> = prepared.source.whole.parameters().iter().map(|parameter| parameter.name.as_str()).collect();
    let [before, after] = &finished.seen;
    let intervals = after.intervals(&finished.factors)?;
    let table = Table::new("seen", "What the test sees of the parameters", "Parameter");
    let mut table =
        table.columns(["factor", "least (95 %)", "most (95 %)"], "").columns(["deviation", "deviation before"], "%");
    for (e, name) in names.iter().enumerate() {
        let ends = [finished.factors[e], intervals[e].lower, intervals[e].upper];
        let numbers = ends.map(|value| Cell::number(value, Digits::Fixed(4)));
        let deviations = [after, before].map(|seen| Cell::percent(seen.deviations[e], Digits::Significant(3)));
        table.row(*name, numbers.into_iter().chain(deviations));
    }
    table.notes.push(format!(
        "Of {}, the test tells {} apart (singular values {:.3e} to {:.3e}). Deviations are those of the logarithm of the factor, \
         from the standard deviations of the measurement.",
        counted(names.len(), "parameter", "parameters"),
        after.subset.len(),
        after.singular_values.first().copied().unwrap_or_default(),
        after.singular_values.last().copied().unwrap_or_default(),
    ));
    for &(a, b, cosine) in &after.parallel {
        table.notes.push(format!("{} and {} do nearly the same (cosine {cosine:+.3}).", names[a], names[b]));
    }
    for &e in &after.blind {
        table.notes.push(format!("{} is hardly seen.", names[e]));
    }
    Ok(table)
}
