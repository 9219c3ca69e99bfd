//! The lists of equations and routes, held against the code.

pub mod equations;
pub mod rooms;
pub mod routes;
