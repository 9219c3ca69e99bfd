//! The method's specification: one test program, one module per subject, in the order data flows.

mod common;

mod assembly;
mod cases_expected;
mod cli;
mod cli_comparisons;
mod condensation;
mod derivatives;
mod derivatives_side_by_side;
mod elements;
mod elements_nastran95;
mod fewer_modes;
mod groups;
mod inner_loop;
mod matrix_comparison;
mod matrix_correction;
mod modes;
mod objective;
mod outer_loop;
mod perturbation;
mod rank_one_terms;
mod snapshots;
mod sorting;
mod step;
mod structure;
mod tables_published;
mod test_modes;
