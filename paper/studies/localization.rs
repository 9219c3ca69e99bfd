//! How often a panel that is too thin is named: every panel of the box in turn, by both rankings.

use super::noise_words;
use crate::prelude::*;

/// Noise of the study: 1 % of shapes, 0.5 % of frequencies.
pub const NOISE: Noise = Noise {
    shape: 0.01,
    frequency: 0.005,
};
/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=100;
/// Gages of the culprit over the true one: Case 4's error, and one that is not gross.
pub const RATIOS: [f64; 2] = [0.01, 0.5];
/// One culprit by both rankings.
#[derive(Debug, Clone, PartialEq)]
pub struct Located {
    /// Number of the panel.
    pub panel: usize,
    /// Its gage over the true one.
    pub ratio: f64,
    /// Whether the tests have noise.
    pub is_noisy: bool,
    /// Number of tests.
    pub tests: usize,
    /// Tests in which it stands first by [`by_factor`], with Case 4's settings, and in which among the first three.
    pub by_factor: [usize; 2],
    /// The same by [`by_single_fit`], with weights of [`NOISE`].
    pub by_single_fit: [usize; 2],
}

/// Each panel of Case 4's box in turn too thin, all others right: without noise, then with [`NOISE`] of every seed.
///
/// # Errors
/// Those of the model and of the rankings.
pub fn localization(seeds: RangeInclusive<u64>) -> Result<Vec<Located>, CaseError> {
    let case = Case::new(4)?;
    let exact = case.test_modes()?;
    let weights = equal_weights(NOISE, exact.len());
    let noisy = seeds
        .map(|seed| with_noise(&exact, NOISE, seed))
        .collect::<Result<Vec<_>, Error>>()?;
    let mut located = Vec::new();
    for (ratio, culprit) in RATIOS
        .into_iter()
        .flat_map(|ratio| (0..PANEL_COUNT).map(move |panel| (ratio, panel)))
    {
        let mut gages = [TEST_GAGE; PANEL_COUNT];
        gages[culprit] *= ratio;
        let model = case.model_with(&gages)?;
        for (is_noisy, tests) in [(false, from_ref(&exact)), (true, &noisy)] {
            let mut found = [[0; 2]; 2];
            for test in tests {
                let modal = model.analyze(&[1.0; PANEL_COUNT], test, None)?;
                let rankings = [
                    by_factor(&modal, &case.settings.inner)?,
                    by_single_fit(&Comparison::from(&modal), &weights)?,
                ];
                for (found, suspects) in found.iter_mut().zip(rankings) {
                    let place = suspects
                        .iter()
                        .position(|suspect| suspect.parameter == culprit);
                    found[0] += usize::from(place == Some(0));
                    found[1] += usize::from(place.is_some_and(|place| place < 3));
                }
            }
            let (panel, tests, [by_factor, by_single_fit]) =
                (case.panels[culprit].label, tests.len(), found);
            located.push(Located {
                panel,
                ratio,
                is_noisy,
                tests,
                by_factor,
                by_single_fit,
            });
        }
    }
    Ok(located)
}

/// How often each panel that is too thin stands first and among the first three of both rankings; a table for each of [`RATIOS`].
pub fn localization_tables(located: &[Located]) -> Vec<Table> {
    let table = |ratio: f64| {
        let of_ratio = || located.iter().filter(move |of| of.ratio == ratio);
        let tests = of_ratio().find(|of| of.is_noisy).map_or(0, |of| of.tests);
        let title = format!(
            "One panel {ratio} times as thick as it should be: found, of {tests} noisy tests"
        );
        let mut table = Table::new(format!("localization_{ratio}"), title, "Panel")
            .headings(["Factor, no noise", "Factor first", "Factor in three"], "")
            .headings(["Fit, no noise", "Fit first", "Fit in three"], "");
        let mut sums = [0; 6];
        for pair in of_ratio().collect_vec().chunks_exact(2) {
            let (exact, noisy) = (pair[0], pair[1]);
            let ([factor, factor_three], [fit, fit_three]) = (noisy.by_factor, noisy.by_single_fit);
            let counts = [
                exact.by_factor[0],
                factor,
                factor_three,
                exact.by_single_fit[0],
                fit,
                fit_three,
            ];
            sums.iter_mut()
                .zip(counts)
                .for_each(|(sum, count)| *sum += count);
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
