//! The finite element analysis by NASTRAN-95 instead of the crate's own elements: the paper's arrangement, with the
//! inner loop here and the finite elements there.
//!
//! For every analysis a deck is written at the present gages and run once. Beside the structure it holds every element
//! a second time, alone, on fixed grids of its own: its matrix is then a block of KGG, while KAA and MAA are the
//! structure's alone. Taken over is each element's stiffness; their sum is $K_S$, which must be NASTRAN's own KAA. Of
//! the mass nothing is taken over, but MAA must be $T M T^t$, as NASTRAN's elimination of the MPC equations makes it,
//! with the lumped mass of elements that have a density.
//!
//! Appendix A, the eigensolution and everything else is computed here from these matrices: $M_S$ is singular, and
//! NASTRAN's own eigenvalues are good to five or six digits only.
//!
//! NASTRAN-95 keeps coordinates, gages and material in single precision: its matrices differ from the crate's by up to
//! 1.5e-7 of the largest entry, and by more where its shear panel takes sides that are nearly parallel for parallel.

mod matrices;
mod output5;
mod process;

use crate::files::deck::{BulkData, Task, write};
use crate::files::error::FileError;
use crate::method::model::FiniteElementModel;
use nalgebra::Vector3;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

pub use output5::{Matrices, read_output5};

/// The program's name in reports.
pub const NAME: &str = "NASTRAN-95";

/// How long a run may take unless told otherwise; the box takes half a second.
pub const DEFAULT_TIME_LIMIT: Duration = Duration::from_secs(60);

/// Bytes that a run may print, and write on Fortran unit 15, unless told otherwise; the box takes a few thousandths.
pub const DEFAULT_OUTPUT_LIMIT: u64 = 1 << 28;

/// Where the Python wheel `nastran95` ends up when it is unpacked by the commands in `golden/nastran95/README.md`.
pub fn default_folder() -> PathBuf {
    std::env::home_dir().unwrap_or_default().join(".cache/nastran95/nastran95/_data")
}

/// What a run leaves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answer {
    /// The printed output.
    pub printed: String,
    /// What was written on Fortran unit 15, if anything.
    pub unit_15: Option<String>,
}

/// An installed NASTRAN-95.
#[derive(Debug, Clone)]
pub struct Nastran95 {
    home: PathBuf,
    /// When a run counts as hanging and is stopped.
    pub time_limit: Duration,
    /// Bytes of a file of a run above which the run is stopped and nothing read.
    pub output_limit: u64,
    /// Set from outside, for example by a signal, it stops the run and removes its files.
    pub stop: Arc<AtomicBool>,
}

impl Nastran95 {
    /// The program in a folder that holds `bin/nastrn` and `rf/`, the rigid formats.
    ///
    /// # Errors
    /// [`FileError::SolverMissing`] if the folder does not hold them.
    pub fn in_folder(home: &Path) -> Result<Self, FileError> {
        let missing = || FileError::SolverMissing { path: home.to_owned() };
        // A relative path would mean another folder once the program runs in its scratch folder.
        let home = home.canonicalize().map_err(|_| missing())?;
        if !home.join(process::PROGRAM).is_file() || !home.join(process::RIGID_FORMATS).is_dir() {
            return Err(missing());
        }
        Ok(Self { home, time_limit: DEFAULT_TIME_LIMIT, output_limit: DEFAULT_OUTPUT_LIMIT, stop: Arc::default() })
    }

    /// Runs a deck in a temporary folder that is removed, however the run ends.
    ///
    /// # Errors
    /// [`FileError::SolverTimeLimit`], [`FileError::SolverInterrupted`], [`FileError::SolverCrashed`],
    /// [`FileError::SolverFatal`] with NASTRAN's own message; [`FileError::SolverAnswer`] when it writes too much or
    /// something else than files; [`FileError::File`].
    pub fn run(&self, deck: &str) -> Result<Answer, FileError> {
        process::run(self, deck)
    }

    /// The matrices that a deck has NASTRAN write with module OUTPUT5 on Fortran unit 15, with no more than `numbers`
    /// entries in all.
    ///
    /// # Errors
    /// Those of [`Self::run`]; [`FileError::SolverAnswer`] when it writes nothing or something else.
    pub fn matrices(&self, deck: &str, numbers: usize) -> Result<Matrices, FileError> {
        let answer = self.run(deck)?;
        let found = || format!("none; printed last: {}", process::last_lines(&answer.printed));
        let unit_15 = answer.unit_15.ok_or_else(|| FileError::answer("matrices on Fortran unit 15", found()))?;
        read_output5(&unit_15, numbers)
    }

    /// The same model with NASTRAN's elements, from an analysis at the given parameter factors.
    ///
    /// # Errors
    /// Those of [`Self::matrices`] and [`BulkData::of`]; [`FileError::SolverAnswer`] when KAA is not the sum of the
    /// elements to 1e-9 or MAA not $T M T^t$ to 1e-6 of its largest entry.
    pub fn elements(&self, model: &FiniteElementModel, factors: &[f64]) -> Result<FiniteElementModel, FileError> {
        // Where a dynamic point lies does not enter: its MPC equation alone ties it to the structure.
        let points = vec![Vector3::zeros(); model.mass().nrows()];
        let bulk = BulkData::of(model, factors, &points)?;
        let all = matrices::with_single_elements(&bulk);
        let deck = write(&all, "ANALYSIS", &Task::Matrices)?;
        let answer = self.matrices(&deck, matrices::numbers_in_answer(&all))?;
        let units = matrices::unit_stiffness(model, &bulk, &answer)?;
        let model = model.with_unit_stiffness(units)?;
        matrices::check_assembled(&model, factors, &answer)?;
        Ok(model)
    }
}
