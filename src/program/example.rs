//! `corfem init --example`: the jobs of `tests/jobs`, with all their files.

use super::output::{note, write_files};
use clap::ValueEnum;
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::io::{Error, ErrorKind};
use std::path::Path;

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Example {
    /// Ten stories of a building as matrices, five sensors in a table: every story comes back
    Building,
    /// A delta wing of 113 elements as a NASTRAN deck, its test as a Universal File: Gauss-Newton steps
    Wing,
    /// A real test: an airplane of aluminum bars, eight frequencies, and a model that its parameters cannot make right
    Garteur,
}

macro_rules! files {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../tests/jobs/", $folder, "/", $name)))),*]
    };
}

impl Example {
    fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Building => {
                files!("building": "job.toml" "rows.csv" "test.csv" "mass.mtx" "stiffness.mtx" "story_1.mtx"
                "story_2.mtx" "story_3.mtx" "story_4.mtx" "story_5.mtx" "story_6.mtx" "story_7.mtx" "story_8.mtx"
                "story_9.mtx" "story_10.mtx")
            }
            Self::Wing => files!("wing": "job.toml" "model.bdf" "test.unv"),
            Self::Garteur => {
                files!("garteur": "job.toml" "rows.csv" "test.csv" "mass.mtx" "stiffness.mtx" "damping_layer.mtx"
                "drums_mass.mtx" "fin.mtx" "fuselage.mtx" "joint.mtx" "tailplane.mtx" "wing_bending.mtx" "wing_torsion.mtx")
            }
        }
    }

    /// Writes the job and its files into a folder, made if it is new, and over none that is there.
    pub fn write(self, folder: &Path, quiet: bool) -> Result<(), PresentError> {
        let is_there = |(name, _): &&(&str, &str)| folder.join(name).exists();
        if let Some((name, _)) = self.files().iter().find(is_there) {
            let found = Error::from(ErrorKind::AlreadyExists);
            return Err(FileError::of_file(&folder.join(name), "write")(found).into());
        }
        write_files(folder, self.files().iter().copied())?;
        if !quiet {
            let job = folder.join("job.toml");
            note(format_args!(
                "next: corfem correlate {} --folder results",
                job.display()
            ));
        }
        Ok(())
    }
}
