//! What the studies must show for the documents to say so.

pub mod delta_wing_answers;
pub mod linearization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod noisy_modes;
pub mod published_counts;
