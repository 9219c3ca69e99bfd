//! Tables, figures, the page, and the program from outside.

pub mod figures;
pub mod figures_drawing;
pub mod job_subject;
pub mod moving;
pub mod page;
pub mod play;
pub mod program;
pub mod published_tables;
pub mod render;
pub mod subject;
pub mod weighted_tables;
