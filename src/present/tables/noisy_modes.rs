//! What noise of the test modes does to the gages, with Appendix B and without, as tables.

use super::{PERCENT, RMS_PERCENT, noise_words};
use crate::method::appendix_b::LARGEST_SUSPENSION_RATIO;
use crate::present::table::{Cell, Digits, Table, numbers};
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
    let noise = format!(
        "Noise: {}. Orthogonal: by Appendix B. Screened: those that its limits keep.",
        noise_words(study.noise)
    );
    let balance = study.support_ratio.map_or_else(
        || "The modes are balanced first.".to_owned(),
        |ratio| {
            format!(
                "Balancing does not apply, because supports hold the structure: its stiffness against rigid-body motion is \
                {ratio:.0} times the inertia at the lowest frequency, where a suspension's is at most {LARGEST_SUSPENSION_RATIO}."
            )
        },
    );
    let gains = format!(
        "Of {} seeds, orthogonal modes give better gages than raw ones with {}, screened ones with {}.",
        noisy.len(),
        better(orthogonal),
        better(screened)
    );
    let met = format!(
        "Error sum: beside the test modes given. The case's tolerances are met with {} seeds raw, {} orthogonal, {} screened.",
        converged(raw),
        converged(orthogonal),
        converged(screened)
    );
    let kept = study.runs.iter().map(|run| Cell::count(run.kept.len()));
    vec![
        table(study, "gages", "RMS gage errors", &GAGES).notes([noise, balance, gains]),
        table(study, "course", "how the correlations went", &COURSE).column("Modes kept", "", kept).notes([met]),
        table(study, "truth", "RMS errors beside the modes without noise", &TRUE_ERRORS),
    ]
}

/// Quantities of all correlations run by run, and their median and largest value over the seeds.
fn table(study: &NoisyModes, name: &str, what: &str, quantities: &[Quantity]) -> Table {
    let title = format!("Case {} with noisy test modes: {what}", study.case);
    let labels = study.runs.iter().map(|run| run.seed.map_or_else(|| "no noise".to_owned(), |seed| seed.to_string()));
    let mut table = Table::new(format!("noisy_{name}"), title, "Seed").labels(labels).labels(["median", "worst"]);
    for (name, unit, digits, value) in quantities {
        for (side_name, side) in SIDES {
            let values = study.runs.iter().map(|run| value(side(run)));
            let of_seeds = study.runs.iter().filter(|run| run.seed.is_some()).map(|run| value(side(run)));
            let mut of_seeds: Vec<f64> = of_seeds.collect();
            of_seeds.sort_by(f64::total_cmp);
            let last = of_seeds.len().checked_sub(1);
            let median = last.map(|last| 0.5 * (of_seeds[last / 2] + of_seeds[last.div_ceil(2)]));
            let all = values.map(Some).chain([median, of_seeds.last().copied()]);
            table = table.column(format!("{side_name} {name}"), unit, numbers(all, *digits));
        }
    }
    table
}
