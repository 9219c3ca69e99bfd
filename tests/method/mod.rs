//! The method, in the order of the text.

pub mod linear_algebra;

pub mod singular_structures;
pub mod structure;

pub mod elements;
pub mod elements_membrane;
pub mod elements_nastran95;
pub mod elements_shear;
pub mod mass_lumping;
pub mod panel_geometry;
pub mod quadrature;

pub mod assembly;
pub mod factorization;

pub mod appendix_a;
pub mod appendix_a_box;
pub mod condensation_bounds;

pub mod modes;
pub mod modes_bad_input;
pub mod supports;

pub mod appendix_b;

pub mod groups;
pub mod mass_parameters;
pub mod mass_parameters_bad_input;
pub mod modal;
pub mod model;
pub mod model_refusals;

pub mod pairing;
pub mod pairing_bad_input;

pub mod error_sum;

pub mod appendix_c;
pub mod appendix_c_bad_input;
pub mod appendix_c_distinct;
pub mod appendix_c_orders;
pub mod appendix_c_recursion_orders;
pub mod appendix_c_rows;
pub mod appendix_c_series;
pub mod appendix_c_table_1;
pub mod appendix_c_two_dof;

pub mod appendix_c_close_roots;

pub mod appendix_c_clusters;
pub mod appendix_c_complex;
pub mod appendix_c_general;
pub mod appendix_c_general_errors;
pub mod appendix_c_general_limits;
pub mod appendix_c_wing_section;
pub mod strategies_of_vibrations;

pub mod appendix_c_inner_loop;

pub mod derivatives;
pub mod gradient;

pub mod step;
pub mod step_matrix;
pub mod step_scale;

pub mod inner_loop;
pub mod inner_loop_bad_input;
pub mod inner_loop_close_roots;
pub mod inner_loop_stops;

pub mod mass_correlation;
pub mod no_panic;
pub mod metamorphic;
pub mod outer_loop;
pub mod outer_loop_bad_input;
pub mod outer_loop_stops;
pub mod verdict;

pub mod alternatives;
pub mod errata;
pub mod errata_appendix_c;
