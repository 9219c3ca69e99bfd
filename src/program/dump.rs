//! `corfem dump`: all that a case computes, to check another program against.

use super::folder::{check_folder, put_all};
use super::output::say;
use super::place::put;
use clap::Args;
use corfem::cases::Case;
use corfem::present::PresentError;
use corfem::present::dump::dump as open;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct DumpArguments {
    /// Which case
    #[arg(value_name = "CASE")]
    case: usize,
    /// Write dump.json and every matrix in the format of the Matrix Market into this folder, made if it is new, instead of the
    /// JSON document alone to standard output
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// Runs a case and writes its matrices and every iteration.
pub fn dump(arguments: &DumpArguments, quiet: bool) -> Result<(), PresentError> {
    arguments.folder.as_deref().map_or(Ok(()), check_folder)?;
    let dump = open(&Case::new(arguments.case)?)?;
    let Some(folder) = &arguments.folder else { return put(None, &dump.json) };
    let mut files = vec![("dump.json".to_owned(), dump.json.into_bytes())];
    files.extend(dump.matrices.into_iter().map(|(name, text)| (name, text.into_bytes())));
    put_all(folder, &files)?;
    if !quiet {
        say(format_args!("{} files in {}", files.len(), folder.display()));
    }
    Ok(())
}
