//! The studies behind what `paper/*.md` claims of the method: made-up structures, made-up noise, and the tables and figures of
//! the documents. `cargo bench --bench studies -- NAME` prints one; the tests hold them against the goldens and the documents.

pub mod accumulation;
pub mod counted_figures;
pub mod coverage;
pub mod delta_wing_tables;
pub mod detection;
pub mod diagram;
pub mod eigensolutions;
pub mod fit;
pub mod five_structures;
pub mod known;
pub mod linearization;
pub mod localization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod matrix_tables;
pub mod noisy_modes;
pub mod predictions;
pub mod published_counts;
pub mod reading_tables;
pub mod readings;
pub mod rules;
pub mod specimen;
pub mod tour_figures;
pub mod tour_figures_box;

use crate::prelude::*;
use std::error::Error;

/// Name of a study's golden, and the text of it.
pub type Study = (&'static str, fn() -> Result<String, Box<dyn Error>>);

/// Those whose tables are made in seconds.
pub const QUICK: [Study; 11] = [
    ("fit", || {
        Ok(csv(&[fit::fit_table(&fit::fit(
            &Reconstruction::embedded()?,
        )?)]))
    }),
    ("rules", || {
        let compared = rules::compare_all(&WeightedSettings::default())?;
        Ok(csv(&[rules::rules_table(&compared)]))
    }),
    ("noisy_modes", || {
        Ok(csv(&noisy_modes::noisy_tables(noisy_modes::study())))
    }),
    ("matrices_case_1", || matrices(1)),
    ("matrices_case_2", || matrices(2)),
    ("matrices_case_3", || matrices(3)),
    ("delta_wing", || {
        let wing = DeltaWing::embedded();
        let run = correlate_wing(&wing, |_, _| {})?;
        Ok(csv(&delta_wing_tables::delta_wing_tables(&wing, &run)?))
    }),
    ("eigensolutions", || {
        let counted = eigensolutions::count_all(&eigensolutions::ERRORS)?;
        Ok(csv(&[eigensolutions::eigensolution_table(&counted)]))
    }),
    ("linearization", || {
        steps(predictions::Exact::SameCondensation)
    }),
    ("linearization_new", || {
        steps(predictions::Exact::NewCondensation)
    }),
    ("readings", || {
        let this = Reconstruction::embedded()?;
        let detections = readings::READINGS.map(|reading| readings::detection(&this, reading));
        let detections: Vec<_> = detections.into_iter().collect::<Result<_, _>>()?;
        let mut tables = reading_tables::readings_tables(&readings::COLUMNS, &detections)?;
        tables.extend(published_counts::counted_tables(&published_counts::COUNTED));
        tables.push(accumulation::accumulation_table(&this)?);
        Ok(csv(&tables))
    }),
];

/// Those that take minutes.
pub const LONG: [Study; 6] = [
    ("coverage", || {
        Ok(csv(&coverage::coverage_tables(&coverage::all_coverages(
            coverage::SEEDS,
        )?)))
    }),
    ("localization", || {
        let located = localization::localization(localization::SEEDS)?;
        Ok(csv(&localization::localization_tables(&located)))
    }),
    ("detection", || {
        let (boxes, alarms) = detection::all_rates()?;
        Ok(csv(&[detection::detection_table(&boxes, alarms)]))
    }),
    ("wrong_models", || Ok(five_structures::all_wrong_rates())),
    ("intervals_structures", || {
        Ok(five_structures::all_interval_rates())
    }),
    ("intervals_repeats", || {
        Ok(five_structures::all_repeat_rates())
    }),
];

/// A comparison of matrices and elements by as many test modes as a test usually has.
fn matrices(number: usize) -> Result<String, Box<dyn Error>> {
    let case = Case::new(number)?;
    let compared = matrix_comparison::compare_matrices(&case, matrix_comparison::USUAL_TEST_MODES)?;
    Ok(csv(&matrix_tables::matrix_tables(&case, &compared)))
}

/// Errors of steps beside modes that are exact in one sense.
fn steps(exact: predictions::Exact) -> Result<String, Box<dyn Error>> {
    let both = predictions::both_structures(exact)?;
    Ok(csv(&[linearization::linearization_table(&both, exact)]))
}

const HERTZ: Digits = Digits::Significant(4);
const PERCENT: Digits = Digits::Fixed(1);
const RMS_PERCENT: Digits = Digits::Fixed(2);

/// Noise of a test in words.
fn noise_words(noise: Noise) -> String {
    format!(
        "{:.1} % of its shape's largest component on every component, {:.1} % on every frequency (standard deviations)",
        100.0 * noise.shape,
        100.0 * noise.frequency
    )
}
