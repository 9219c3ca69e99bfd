//! The program that does the finite element analyses of the outer loop.

use super::signals;
use clap::{Args, ValueEnum};
use corfem::job::nastran95::{NAME, Nastran95, default_folder};
use corfem::method::model::FiniteElementModel;
use corfem::present::PresentError;
use corfem::torque_box::BUILT_IN;
use std::path::PathBuf;
use std::time::Duration;

#[derive(Debug, Default, Args)]
pub struct SolverArguments {
    /// Program that does the finite element analyses of the outer loop
    #[arg(long, value_enum, default_value = "built-in")]
    solver: SolverArgument,
    /// Folder of NASTRAN-95, with bin/nastrn and rf/; without it that of the environment variable NASTRAN95, or
    /// .cache/nastran95/nastran95/_data in the home folder
    #[arg(long, value_name = "FOLDER", requires = "solver")]
    nastran: Option<PathBuf>,
    /// Seconds after which a run of NASTRAN-95 is stopped
    #[arg(long, value_name = "SECONDS", requires = "solver", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    time_limit: u32,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum SolverArgument {
    /// The elements of this program
    #[default]
    BuiltIn,
    /// NASTRAN-95, run once for every analysis
    #[value(name = "nastran95")]
    Nastran95,
}

/// The program that analyzes a model: NASTRAN-95, or without it the elements of this program.
pub struct Solver(Option<Nastran95>);

impl Solver {
    /// The solver asked for. The signals that ask this program to stop also stop NASTRAN-95.
    pub fn from_arguments(arguments: &SolverArguments) -> Result<Self, PresentError> {
        if let SolverArgument::BuiltIn = arguments.solver {
            return Ok(Self(None));
        }
        let set = || {
            std::env::var_os("NASTRAN95")
                .filter(|folder| !folder.is_empty())
                .map(PathBuf::from)
        };
        let folder = arguments
            .nastran
            .clone()
            .or_else(set)
            .unwrap_or_else(default_folder);
        let mut nastran = Nastran95::in_folder(&folder)?;
        nastran.time_limit = Duration::from_secs(arguments.time_limit.into());
        signals::set_on_signal(&nastran.stop);
        Ok(Self(Some(nastran)))
    }

    /// Name of the solver in reports.
    pub fn name(&self) -> &'static str {
        if self.0.is_some() { NAME } else { BUILT_IN }
    }

    /// The model with the solver's elements, at the given factors on the parameters.
    pub fn elements(
        &self,
        model: &FiniteElementModel,
        factors: &[f64],
    ) -> Result<FiniteElementModel, PresentError> {
        let Some(nastran) = &self.0 else {
            return Ok(model.clone());
        };
        // A signal stops the run first, which removes its files, and then this program.
        let _postponed = signals::postpone();
        Ok(nastran.elements(model, factors)?)
    }
}
