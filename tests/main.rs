//! The method's specification: one test program, one module per subject, in the order data flows.

mod common;

mod alternatives;
mod assembly;
mod cases_expected;
mod cli;
mod condensation;
mod derivatives;
mod elements;
mod elements_nastran95;
mod inner_loop;
mod inner_loop_bad_input;
mod inner_loop_stops;
mod modal;
mod modes;
mod modes_bad_input;
mod objective;
mod outer_loop;
mod outer_loop_bad_input;
mod outer_loop_stops;
mod perturbation;
mod perturbation_bad_input;
mod perturbation_orders;
mod perturbation_rows;
mod perturbation_two_dof;
mod snapshots;
mod sorting;
mod sorting_bad_input;
mod step;
mod strategies_of_vibrations;
mod structure;
mod tables_published;
mod test_modes;
