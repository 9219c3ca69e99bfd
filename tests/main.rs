//! The method's specification: one test program, one module per subject, in the order data flows.

mod common;

mod quadrature;
mod linalg;
mod structure;
mod panel_geometry;
mod elements;
mod elements_shear;
mod elements_membrane;
mod elements_nastran95;
mod torque_box_nastran95;
mod assembly;
mod singular_structures;
mod condensation;
mod condensation_box;
mod analytical;
mod torque_box;
mod torque_box_data;
mod model;
mod model_refusals;
mod modes;
mod test_modes;
mod sorting;
mod objective;
mod perturbation;
mod derivatives;
mod step;
mod inner_loop;
mod outer_loop;
