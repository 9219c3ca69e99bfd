//! The lists of equations, errata and routes, the rooms and their weight, the formulas and sentences of the documentation and the
//! numbers in it, held against the code.

pub mod alternative;
pub mod claims;
pub mod documents;
pub mod equations;
pub mod errata;
pub mod formulas;
pub mod library;
pub mod numbers;
pub mod numbers_said;
pub mod package;
pub mod prose;
pub mod readme;
pub mod rooms;
pub mod scripts;
pub mod routes;
pub mod specification;
pub mod suite;
pub mod superlatives;
pub mod tables;
pub mod tour;
pub mod tour_program;
pub mod weight;
pub mod wrong_forms;

use crate::prelude::*;

/// Every file of a folder and of those in it.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(files_below(&path));
        } else {
            files.push(path);
        }
    }
    files
}
