//! Tables of any correlation: paired modes, factors, and its history.

use super::{Cell, Digits, HERTZ, RMS_PERCENT, Table};
use crate::cases::BUILT_IN;
use crate::method::error::Error;
use crate::method::model::Check;
use crate::present::subject::{Agreement, Subject};

/// Three decimals, of criteria between zero and one and of factors.
const THREE: Digits = Digits::Fixed(3);
/// Words for a pair of modes, with the least of it and the most of any other pair of its two modes.
pub const MARKS: [(&str, f64, f64); 2] = [("good", 0.95, 0.05), ("acceptable", 0.90, 0.10)];

/// Paired modes, factors and history.
///
/// # Errors
/// Those of [`Subject::agreement`].
pub fn subject_tables(subject: &Subject) -> Result<Vec<Table>, Error> {
    Ok(vec![paired_table(subject)?, factor_table(subject), history_table(subject)])
}

/// Every test mode with its partner in the first and in the corrected model: frequencies and their differences, modal assurance
/// criterion, cross-orthogonality and the largest other entry of the two modes, and what is to be thought of the last.
///
/// # Errors
/// Those of [`Subject::agreement`].
pub fn paired_table(subject: &Subject) -> Result<Table, Error> {
    let title = format!("{}: test modes and their partners", subject.title);
    let mut table = Table::new(format!("{}_modes", subject.name), title, "Mode").column("Test", "Hz");
    let mut states = vec![("First", &subject.initial)];
    states.extend((!subject.stages.is_empty()).then(|| ("Corrected", subject.corrected())));
    let weighted = subject.mass.is_some();
    for (name, _) in &states {
        table = table.column(*name, "Hz").column(format!("{name} error"), "%").column(format!("{name} MAC"), "");
        table = table.columns(weighted.then(|| format!("{name} cross")), "");
        table = table.column(format!("{name} others"), "");
    }
    let last = states.last().map_or("", |(name, _)| name);
    table = table.column(format!("{last} is"), "");
    let agreements = states.iter().map(|(_, check)| subject.agreement(check)).collect::<Result<Vec<_>, _>>()?;
    for (mode, test_hz) in subject.test.frequencies_hz().into_iter().enumerate() {
        let mut cells = vec![Cell::number(test_hz, HERTZ)];
        let mut mark = "";
        for ((_, check), agreement) in states.iter().zip(&agreements) {
            let hertz = check.frequencies_hz[mode];
            let pair = agreement.pair(check, mode);
            cells.extend([Cell::number(hertz, HERTZ), Cell::percent(hertz / test_hz - 1.0, RMS_PERCENT)]);
            cells.push(Cell::number(agreement.assurance[(check.pairing.analysis_mode[mode], mode)], THREE));
            cells.extend(weighted.then_some(Cell::number(pair.0, THREE)));
            cells.push(Cell::number(pair.1, THREE));
            mark = MARKS.iter().find(|(_, least, most)| pair.0 >= *least && pair.1 <= *most).map_or("poor", |m| m.0);
        }
        table.row(mode + 1, cells.into_iter().chain([Cell::text(mark)]));
    }
    let rms = states.iter().map(|(_, check)| [check.errors.frequency_rms(), check.errors.shape_rms()]);
    for (row, label) in ["frequency RMS", "shape RMS"].into_iter().enumerate() {
        let state = |rms: [f64; 2]| {
            let blanks = vec![Cell::Blank; 2 + usize::from(weighted)];
            [Cell::Blank, Cell::percent(rms[row], RMS_PERCENT)].into_iter().chain(blanks)
        };
        table.row(label, [Cell::Blank].into_iter().chain(rms.clone().flat_map(state)).chain([Cell::Blank]));
    }
    let measure = if weighted { "cross-orthogonality" } else { "modal assurance criterion (no mass is known)" };
    table.notes.extend(solver_note(&subject.solver, " of the model", ";"));
    Ok(table.note(format!(
        "Others: the largest {measure} of either mode with any but its partner. Good: at least 0.95, others at most 0.05; \
        acceptable: 0.90 and 0.10. MAC is not mass-weighted. Shape RMS: of components, largest one, over all modes."
    )))
}

impl Agreement {
    /// Of a test mode and its partner: the magnitude of their cross-orthogonality, or their assurance without mass, and the largest
    /// other entry of either's row and column.
    pub fn pair(&self, check: &Check, mode: usize) -> (f64, f64) {
        let (matrix, i) = (self.orthogonality.as_ref().unwrap_or(&self.assurance), check.pairing.analysis_mode[mode]);
        let row = (0..matrix.ncols()).filter(|&j| j != mode).map(|j| matrix[(i, j)].abs());
        let column = (0..matrix.nrows()).filter(|&k| k != i).map(|k| matrix[(k, mode)].abs());
        (matrix[(i, mode)].abs(), row.chain(column).fold(0.0, f64::max))
    }
}

/// Factors of the corrected model with their standard deviations, their bounds, and what must be known of each.
pub fn factor_table(subject: &Subject) -> Table {
    let title = format!("{}: factors on the first model", subject.title);
    let mut table = Table::new(format!("{}_factors", subject.name), title, "Parameter").column("Factor", "");
    table = table.columns(subject.deviations.as_ref().map(|_| "Standard deviation"), "");
    table = table.columns(["Lower bound", "Upper bound", "Remark"], "");
    let number = |value: Option<f64>| value.map_or(Cell::Blank, |value| Cell::number(value, THREE));
    for (e, (name, factor)) in subject.parameters.iter().zip(subject.factors()).enumerate() {
        let range = subject.ranges.get(e).copied().flatten();
        let is_unseen = subject.verdict.as_ref().is_some_and(|verdict| verdict.unseen.contains(&e));
        let remarks = [(subject.is_at_bound(e, factor), "at bound"), (is_unseen, "hardly seen")];
        let remarks: Vec<&str> = remarks.into_iter().filter(|(is_so, _)| *is_so).map(|(_, remark)| remark).collect();
        let mut cells = vec![number(Some(factor))];
        cells.extend(subject.deviations.as_ref().map(|deviations| number(deviations.get(e).copied())));
        cells.extend([number(range.map(|range| range.lower)), number(range.map(|range| range.upper))]);
        table.row(name, cells.into_iter().chain([Cell::text(remarks.join(", "))]));
    }
    table
}

/// Stages of a correlation: iterations, why they ended, and the error sum by the inner loop and exactly.
pub fn history_table(subject: &Subject) -> Table {
    let name = format!("{}_passes", subject.name);
    let mut table = Table::new(name, format!("{}: passes", subject.title), "Pass")
        .columns(["Iterations", "Stopped by"], "")
        .columns(["Error sum inner", "Error sum exact"], "%")
        .note(&subject.words);
    for (row, stage) in subject.stages.iter().enumerate() {
        let errors = subject.inner_errors(row);
        let inner = errors.last().filter(|_| stage.inner.is_some()).map(|last| Cell::percent(last.sum(), RMS_PERCENT));
        let iterations = if stage.inner.is_some() { errors.len() - 1 } else { 1 };
        let exact = Cell::percent(stage.check.errors.sum(), RMS_PERCENT);
        table.row(row + 1, [Cell::count(iterations), Cell::text(&stage.stop), inner.unwrap_or(Cell::Blank), exact]);
    }
    let swaps = swaps(subject).into_iter();
    let words = |[pass, test, from, to]: [usize; 4]| format!("in pass {pass} test mode {test} from {from} to {to}");
    let words: Vec<String> = swaps.map(words).collect();
    if !words.is_empty() {
        table.notes.insert(0, format!("Other modes of the model answer: {}.", words.join("; ")));
    }
    table
}

/// Test modes that another mode of the model answers than before: stage, test mode, and the two modes, all from one.
pub fn swaps(subject: &Subject) -> Vec<[usize; 4]> {
    let checks = std::iter::once(&subject.initial).chain(subject.stages.iter().map(|stage| &stage.check));
    let pairs: Vec<&Vec<usize>> = checks.map(|check| &check.pairing.analysis_mode).collect();
    let of_stage = |(stage, both): (usize, &[&Vec<usize>])| {
        let modes = both[0].iter().zip(both[1]).enumerate().filter(|(_, (from, to))| from != to);
        modes.map(|(test, (from, to))| [stage + 1, test + 1, from + 1, to + 1]).collect::<Vec<_>>()
    };
    pairs.windows(2).enumerate().flat_map(of_stage).collect()
}

/// Derivatives at the first model: percent of a frequency, and percent points of the error sum, for one percent of a parameter.
pub fn derivative_table(subject: &Subject) -> Option<Table> {
    let derivatives = subject.derivatives.as_ref()?;
    let title = format!("{}: derivatives at the first model, for one percent of each parameter", subject.title);
    let mut table = Table::new(format!("{}_derivatives", subject.name), title, "Parameter")
        .columns((1..=derivatives.frequency.ncols()).map(|mode| format!("Mode {mode}")), "%")
        .column("Error sum", "points");
    for (e, name) in subject.parameters.iter().enumerate() {
        let values = derivatives.frequency.row(e).iter().copied().chain([derivatives.error_sum[e]]).collect::<Vec<_>>();
        table.row(name, values.into_iter().map(|value| Cell::number(value, THREE)));
    }
    Some(table)
}

/// What did the finite element analyses, when it was not the crate itself.
pub(super) fn solver_note(solver: &str, before: &str, after: &str) -> Option<String> {
    (solver != BUILT_IN)
        .then(|| format!("Finite element analyses{before} by {solver}{after} everything else by this program."))
}
