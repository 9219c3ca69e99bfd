//! Tables, figures and the page.

pub mod figures;
pub mod page;
pub mod report;
