//! Which parameter is wrong, two rules of the step side by side, and how often intervals hold the truth, as tables.

use super::{PERCENT, RMS_PERCENT};
use crate::present::table::{Cell, Digits, Table};
use crate::studies::coverage::{Coverage, SEEN};
use crate::studies::localization::{Located, NOISE, RATIOS};
use crate::studies::noisy_modes::Noise;
use crate::studies::weighted::comparison::Compared;

/// How often each panel that is too thin stands first and among the first three of both rankings; a table for each of [`RATIOS`].
pub fn localization_tables(located: &[Located]) -> Vec<Table> {
    let table = |ratio: f64| {
        let of_ratio = || located.iter().filter(move |of| of.ratio == ratio);
        let tests = of_ratio().find(|of| of.is_noisy).map_or(0, |of| of.tests);
        let title = format!("One panel {ratio} times as thick as it should be: found, of {tests} noisy tests");
        let mut table = Table::new(format!("localization_{ratio}"), title, "Panel")
            .columns(["Factor, no noise", "Factor first", "Factor in three"], "")
            .columns(["Fit, no noise", "Fit first", "Fit in three"], "");
        let mut sums = [0; 6];
        for pair in of_ratio().collect::<Vec<_>>().chunks_exact(2) {
            let (exact, noisy) = (pair[0], pair[1]);
            let ([factor, factor_three], [fit, fit_three]) = (noisy.by_factor, noisy.by_single_fit);
            let counts = [exact.by_factor[0], factor, factor_three, exact.by_single_fit[0], fit, fit_three];
            sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
            table.row(exact.panel, counts.map(Cell::count));
        }
        table.row("all", sums.map(Cell::count));
        table
    };
    let mut tables = RATIOS.map(table);
    tables[0].notes.push(format!(
        "Factor: by the paper's unlimited factor of the first iteration. Fit: by how much of the weighted squared error each \
        panel alone can take away. No noise: whether it stands first (1) in the one exact test. Noise: {}.",
        words(NOISE)
    ));
    tables.to_vec()
}

/// Cases 1 to 3 and the delta wing at the start, by the paper's rule, and by the weighted one.
pub fn rules_table(compared: &[[Compared; 3]]) -> Table {
    let mut table = Table::new("rules", "The paper's rule and weighted Gauss\u{2013}Newton steps, without noise", "Structure")
        .columns(["Steps", "Analyses"], "")
        .columns(["Factor RMS", "Factor worst"], "%")
        .note(
            "Analyses: exact ones, by the finite element model. Factor: its error beside the one that makes the model right. The \
            paper's rule stops within the tolerances of its case, the weighted one where nothing falls any more.",
        );
    for of in compared.as_flattened() {
        let rule = match of.rule {
            "none" => "first model",
            "paper" => "paper's rule",
            _ => "weighted",
        };
        let errors = [of.factor_rms, of.largest].map(|error| Cell::percent(error, RMS_PERCENT));
        let counts = [of.steps, of.analyses].map(Cell::count);
        table.row(format!("{}, {rule}", of.name), counts.into_iter().chain(errors));
    }
    table
}

/// How often 95 % intervals hold the truth: a line for each structure, then a table of each one's parameters.
pub fn coverage_tables(coverages: &[Coverage]) -> Vec<Table> {
    let tests = coverages.first().map_or(0, |of| of.tests);
    let title = format!("95 % intervals that hold the true factor, over {tests} noisy tests");
    let mut all = Table::new("coverage", title, "Structure")
        .columns(["Parameters", "Seen"], "")
        .columns(["Held, seen", "Least held, seen", "Held, all"], "%")
        .note(format!(
            "Noise: {}. Seen: parameters of whose prior variance the test takes away {:.0} % or more. Least held: of the one of \
            them whose intervals hold the truth least often.",
            words(Noise::USUAL),
            100.0 * SEEN
        ));
    let held = |of: &Coverage, held: usize| held as f64 / of.tests.max(1) as f64;
    let mut tables = Vec::new();
    for of in coverages {
        let seen = || of.parameters.iter().filter(|held| held.learned >= SEEN);
        let least = seen().map(|seen| seen.tests).min();
        let of_seen = least.map(|least| [of.overall(SEEN), held(of, least)].map(|part| Cell::percent(part, PERCENT)));
        let every = Cell::percent(of.overall(f64::NEG_INFINITY), PERCENT);
        let counts = [of.parameters.len(), seen().count()].map(Cell::count);
        all.row(&of.name, counts.into_iter().chain(of_seen.unwrap_or([Cell::Blank, Cell::Blank])).chain([every]));
        let name = format!("coverage_{}", of.name.to_lowercase().replace(' ', "_"));
        let title = format!("{}: intervals that hold the truth, and what the test says", of.name);
        let mut table = Table::new(name, title, "Parameter").columns(["Held", "Learned"], "%");
        for parameter in &of.parameters {
            let fractions = [held(of, parameter.tests), parameter.learned];
            table.row(&parameter.parameter, fractions.map(|fraction| Cell::percent(fraction, Digits::Fixed(1))));
        }
        tables.push(table);
    }
    tables.insert(0, all);
    tables
}

fn words(noise: Noise) -> String {
    format!(
        "{:.1} % of its shape's largest component on every component, {:.1} % on every frequency (standard deviations)",
        100.0 * noise.shape,
        100.0 * noise.frequency
    )
}
