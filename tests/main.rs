//! The method's specification: one test program, one module per subject, in the order data flows.

mod common;

mod structure;
mod elements;
mod elements_nastran95;
mod assembly;
mod condensation;
mod modes;
mod test_modes;
mod sorting;
mod objective;
mod perturbation;
mod appendix_c_general;
mod appendix_c_general_errors;
mod appendix_c_orders;
mod appendix_c_complex;
mod appendix_c_wing_section;
mod appendix_c_close_roots;
mod appendix_c_close_roots_errors;
mod appendix_c_clusters;
mod appendix_c_inner_loop;
mod appendix_c_table_1;
mod derivatives;
mod step;
mod inner_loop;
mod outer_loop;
