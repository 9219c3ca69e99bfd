//! What noise of the test modes does to the gages, with Appendix B and without, as tables.

use super::{Cell, Digits, PERCENT, RMS_PERCENT, Table};
use crate::method::appendix_b::LARGEST_SUSPENSION_RATIO;
use crate::studies::noisy_modes::{Found, NoisyModes, NoisyRun};

/// A quantity of a correlation: its name, its unit, how it is written, and its value in that unit.
type Quantity = (&'static str, &'static str, Digits, fn(&Found) -> f64);

const GAGES: [Quantity; 3] = [
    ("shear", "%", PERCENT, |found| 100.0 * found.shear_gage_rms),
    ("membrane", "%", PERCENT, |found| 100.0 * found.membrane_gage_rms),
    ("all", "%", PERCENT, |found| 100.0 * found.gage_rms),
];
const COURSE: [Quantity; 2] = [
    ("iterations", "", Digits::Fixed(0), |found| found.iterations as f64),
    ("error sum", "%", RMS_PERCENT, |found| 100.0 * found.error_sum),
];
const TRUE_ERRORS: [Quantity; 2] = [
    ("frequency", "%", RMS_PERCENT, |found| 100.0 * found.true_frequency_rms),
    ("shape", "%", RMS_PERCENT, |found| 100.0 * found.true_shape_rms),
];

/// One of a run's three correlations.
type Side = fn(&NoisyRun) -> &Found;

/// The names of the test modes that they are given.
const SIDES: [(&str, Side); 3] =
    [("Raw", |run| &run.raw), ("Orthogonal", |run| &run.orthogonal), ("Screened", |run| &run.screened)];

/// The study's tables: the gages found, how the correlations went, and how far they end from the true modes; a row
/// without noise, one for every seed, and the median and the worst over the seeds.
pub fn noisy_tables(study: &NoisyModes) -> Vec<Table> {
    let noisy: Vec<&NoisyRun> = study.runs.iter().filter(|run| run.seed.is_some()).collect();
    let count = |fits: &dyn Fn(&NoisyRun) -> bool| noisy.iter().filter(|run| fits(run)).count();
    let better = |side: Side| count(&|run| side(run).gage_rms < run.raw.gage_rms);
    let [raw, orthogonal, screened] = SIDES.map(|(_, side)| side);
    let converged = |side: Side| count(&|run| side(run).converged);
    let gages = table(study, "gages", "RMS gage errors", &GAGES)
        .note(format!(
            "Noise: {:.1} % of its shape's largest component on every component, {:.1} % on every frequency (standard \
            deviations). Orthogonal: by Appendix B. Screened: those that its limits keep.",
            100.0 * study.noise.shape,
            100.0 * study.noise.frequency
        ))
        .note(study.support_ratio.map_or_else(
            || "The modes are balanced first.".to_owned(),
            |ratio| {
                format!(
                    "Balancing does not apply, because supports hold the structure: its stiffness against rigid-body \
                    motion is {ratio:.0} times the inertia at the lowest frequency, where a suspension's is at most \
                    {LARGEST_SUSPENSION_RATIO}."
                )
            },
        ))
        .note(format!(
            "Of {} seeds, orthogonal modes give better gages than raw ones with {}, screened ones with {}.",
            noisy.len(),
            better(orthogonal),
            better(screened)
        ));
    let mut course = table(study, "course", "how the correlations went", &COURSE).column("Modes kept", "").note(format!(
        "Error sum: beside the test modes given. The case's tolerances are met with {} seeds raw, {} orthogonal, {} \
        screened.",
        converged(raw),
        converged(orthogonal),
        converged(screened)
    ));
    let kept = study.runs.iter().map(|run| Cell::count(run.kept.len())).chain(std::iter::repeat(Cell::Blank));
    course.rows.iter_mut().zip(kept).for_each(|(row, kept)| row.cells.push(kept));
    let truth = table(study, "truth", "RMS errors beside the modes without noise", &TRUE_ERRORS);
    vec![gages, course, truth]
}

/// Quantities of all correlations run by run, and their median and largest value over the seeds.
fn table(study: &NoisyModes, name: &str, what: &str, quantities: &[Quantity]) -> Table {
    let title = format!("Case {} with noisy test modes: {what}", study.case);
    let mut table = Table::new(format!("noisy_{name}"), title, "Seed");
    for (name, unit, ..) in quantities {
        table = table.columns(SIDES.map(|(side, _)| format!("{side} {name}")), unit);
    }
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); table.columns.len()];
    let digits = |at: usize| quantities[at / SIDES.len()].2;
    for run in &study.runs {
        let values = quantities.iter().flat_map(|(.., value)| SIDES.map(|(_, side)| value(side(run))));
        let values: Vec<f64> = values.collect();
        let label = run.seed.map_or_else(|| "no noise".to_owned(), |seed| seed.to_string());
        table.row(label, values.iter().enumerate().map(|(at, &value)| Cell::number(value, digits(at))));
        if run.seed.is_some() {
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
    }
    columns.iter_mut().for_each(|column| column.sort_by(f64::total_cmp));
    let last = study.runs.len().saturating_sub(2);
    for (label, places) in [("median", [last / 2, last.div_ceil(2)]), ("worst", [last; 2])] {
        let mean = |column: &Vec<f64>| Some(0.5 * (column.get(places[0])? + column.get(places[1])?));
        let cell = |(at, column)| mean(column).map_or(Cell::Blank, |value| Cell::number(value, digits(at)));
        table.row(label, columns.iter().enumerate().map(cell));
    }
    table
}
