//! The studies behind what `paper/*.md` claims of the method: made-up structures, made-up noise, and the tables that the documents
//! quote. Nothing here runs a user's structure; the tests beside each room hold the numbers against the goldens.

pub mod accumulation;
pub mod appendices_expected;
pub mod claims;
pub mod coverage;
pub mod delta_wing_tables;
pub mod detection;
pub mod eigensolutions;
pub mod enclosed;
pub mod fit;
pub mod ends;
pub mod five_structures;
pub mod linearization;
pub mod localization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod matrix_tables;
pub mod next_step;
pub mod noisy_modes;
pub mod predictions;
pub mod published_counts;
pub mod reading_tables;
pub mod readings;
pub mod readings_rates;
pub mod rules;
pub mod specimen;

use crate::prelude::*;

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
