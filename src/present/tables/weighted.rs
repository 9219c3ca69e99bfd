//! Which parameter is wrong, two rules of the step side by side, and how often intervals hold the truth, as tables.

use super::{PERCENT, RMS_PERCENT, noise_words};
use crate::present::table::{Cell, Table, percents};
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
            .headings(["Factor, no noise", "Factor first", "Factor in three"], "")
            .headings(["Fit, no noise", "Fit first", "Fit in three"], "");
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
        noise_words(NOISE)
    ));
    tables.to_vec()
}

/// Cases 1 to 3 and the delta wing at the start, by the paper's rule, and by the weighted one.
pub fn rules_table(compared: &[[Compared; 3]]) -> Table {
    let note = "Analyses: exact ones, by the finite element model. Factor: its error beside the one that makes the model right. The \
        paper's rule stops within the tolerances of its case, the weighted one where nothing falls any more.";
    let title = "The paper's rule and weighted Gauss\u{2013}Newton steps, without noise";
    let mut table = Table::new("rules", title, "Structure")
        .headings(["Steps", "Analyses"], "")
        .headings(["Factor RMS", "Factor worst"], "%")
        .notes([note]);
    for of in compared.as_flattened() {
        let rule = match of.rule {
            "none" => "first model",
            "paper" => "paper's rule",
            _ => "weighted",
        };
        let counts = [of.steps, of.analyses].map(Cell::count).into_iter();
        table.row(format!("{}, {rule}", of.name), counts.chain(percents([of.factor_rms, of.largest], RMS_PERCENT)));
    }
    table
}

/// How often 95 % intervals hold the truth: a line for each structure, then a table of each one's parameters.
pub fn coverage_tables(coverages: &[Coverage]) -> Vec<Table> {
    let tests = coverages.first().map_or(0, |of| of.tests);
    let title = format!("95 % intervals that hold the true factor, over {tests} noisy tests");
    let note = format!(
        "Noise: {}. Seen: parameters of whose prior variance the test takes away {:.0} % or more. Least held: of the one of them \
        whose intervals hold the truth least often.",
        noise_words(Noise::USUAL),
        100.0 * SEEN
    );
    let mut all = Table::new("coverage", title, "Structure")
        .headings(["Parameters", "Seen"], "")
        .headings(["Held, seen", "Least held, seen", "Held, all"], "%")
        .notes([note]);
    let mut tables = Vec::new();
    for of in coverages {
        let held = |tests: usize| tests as f64 / of.tests.max(1) as f64;
        let seen = || of.parameters.iter().filter(|held| held.learned >= SEEN);
        let least = seen().map(|seen| seen.tests).min();
        let fractions = [least.map(|_| of.overall(SEEN)), least.map(held), Some(of.overall(f64::NEG_INFINITY))];
        let counts = [of.parameters.len(), seen().count()].map(Cell::count);
        all.row(&of.name, counts.into_iter().chain(percents(fractions, PERCENT)));
        let name = format!("coverage_{}", of.name.to_lowercase().replace(' ', "_"));
        let title = format!("{}: intervals that hold the truth, and what the test says", of.name);
        let parameters = || of.parameters.iter();
        tables.push(
            Table::new(name, title, "Parameter")
                .labels(parameters().map(|of| &of.parameter))
                .column("Held", "%", percents(parameters().map(|of| held(of.tests)), PERCENT))
                .column("Learned", "%", percents(parameters().map(|of| of.learned), PERCENT)),
        );
    }
    tables.insert(0, all);
    tables
}
