//! Tables, figures and the page.

pub mod error;
pub mod figures;
pub mod page;
pub mod report;
