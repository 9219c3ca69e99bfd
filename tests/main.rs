//! The method's specification: one test program, one module per subject, in the order data flows.

mod common;

mod assembly;
mod cases_expected;
mod cli;
mod cli_pictures;
mod condensation;
mod derivatives;
mod elements;
mod elements_nastran95;
mod figures;
mod figures_drawing;
mod figures_planform;
mod groups;
mod html_report;
mod inner_loop;
mod modes;
mod objective;
mod outer_loop;
mod perturbation;
mod snapshots;
mod sorting;
mod step;
mod structure;
mod tables_published;
mod test_modes;
