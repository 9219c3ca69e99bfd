//! The paper's cases.

pub mod torque_box;
pub mod torque_box_data;
pub mod torque_box_nastran95;

pub mod appendices_expected;
pub mod cases_expected;
pub mod plain;
pub mod certified;
pub mod double_double;

pub mod errata_tables;
pub mod tables_published;

pub mod fewer_modes;
pub mod readings;

pub mod snapshots;
