//! The specification: the paper's contents as tests, in its order.
//!
//! `s1` the equations of the main text by their numbers; `s2` the loops; `s3` the torque box; `s4` Cases 1 to 4 and Tables 1 to 13; `sA`,
//! `sB`, `sC` the appendices, with the elements before Appendix A. `cargo test -- --list 'contents::'` prints them.

#![allow(
    non_snake_case,
    reason = "appendices keep their letters, and sort after the sections by them"
)]

pub mod sA_eq_00_closed_forms;
pub mod sA_eq_00_elements;
pub mod sA_eq_00_elements_geometry;
pub mod sA_eq_00_elements_mass;
pub mod sA_eq_00_elements_membrane;
pub mod sA_eq_00_elements_nastran95;
pub mod sA_eq_00_elements_quadrature;
pub mod sA_eq_00_elements_shear;
pub mod sA_eq_00_structure;
pub mod s1_eq_01_flexibility;
pub mod s1_eq_03_modes;
pub mod s1_eq_03_supports;
pub mod s1_eq_04_pairing;
pub mod s1_eq_05_printed_error;
pub mod s1_eq_05_to_06_error_sum;
pub mod s1_eq_09_to_11_state;
pub mod s1_eq_12_derivatives;
pub mod s1_eq_13_step;
pub mod s1_eq_13_step_matrix;
pub mod s1_eq_13_step_scale;
pub mod s2_inner_loop;
pub mod s2_inner_loop_alternatives;
pub mod s2_inner_loop_close_roots;
pub mod s2_inner_loop_far;
pub mod s2_inner_loop_pairing;
pub mod s2_inner_loop_recursion;
pub mod s2_inner_loop_stops;
pub mod s2_outer_loop;
pub mod s2_outer_loop_b;
pub mod s2_outer_loop_best;
pub mod s2_outer_loop_mass;
pub mod s2_outer_loop_metamorphic;
pub mod s2_outer_loop_stops;
pub mod s2_parameters;
pub mod s2_parameters_groups;
pub mod s2_parameters_mass;
pub mod s2_verdict;
pub mod s3_torque_box;
pub mod s3_torque_box_data;
pub mod s3_torque_box_nastran95;
pub mod s4_cases_expected;
pub mod s4_covers;
pub mod s4_errata_tables;
pub mod s4_fewer_modes;
pub mod s4_readings;
pub mod s4_sentences;
pub mod s4_snapshots;
pub mod s4_tables_published;
pub mod sA_eq_01_to_04_assembly;
pub mod sA_eq_05_to_08_condensation;
pub mod sA_eq_09_shares;
pub mod sB_eq_01_to_02_rigid_body;
pub mod sB_eq_03_to_04_balance;
pub mod sB_eq_03_to_04_balance_by_hand;
pub mod sB_eq_05_to_07_orthogonalize;
pub mod sB_eq_05_to_07_orthogonalize_by_hand;
pub mod sB_eq_07_then_deletion;
pub mod sB_eq_07_then_examine;
pub mod sB_eq_07_then_examine_by_hand;
pub mod sC_eq_01_to_10_complex;
pub mod sC_eq_02_wing_section;
pub mod sC_eq_14_to_24_rows;
pub mod sC_eq_22_distinct;
pub mod sC_eq_24_table_1;
