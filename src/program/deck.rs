//! `corfem deck` and `corfem modes`: the box as a NASTRAN deck, and the modes of any deck.

use super::output::{OutputArguments, note, reconstruction, write};
use clap::Args;
use corfem::files::deck::{self, BulkData};
use corfem::files::error::FileError;
use corfem::files::read_bytes;
use corfem::job::{matrix_modes, of_bodies};
use corfem::method::error::Error;
use corfem::present::deck::{deck_tables, not_read};
use corfem::present::{PresentError, json};
use corfem::torque_box::wing_box::dynamic_points;
use corfem::torque_box::{Case, run_case};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// The deck asks for eigenvalues between these multiples of the lowest and the highest frequency.
const RANGE: [f64; 2] = [0.9, 1.1];

/// Modes of a deck when their number is not given.
const USUAL_COUNT: usize = 100;

#[derive(Debug, Args)]
pub struct DeckArguments {
    /// Number of the case, 1 to 4
    #[arg(value_name = "CASE")]
    case: usize,
    /// Use the gages after this pass of the correlation instead of the first ones
    #[arg(long, value_name = "N", default_value_t = 0)]
    pass: usize,
    /// Write the deck to this file instead of standard output (-)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Torque box to use instead of the built-in one (a file like paper/reconstruction.toml)
    #[arg(long = "box", value_name = "FILE")]
    box_file: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct ModesArguments {
    /// The deck: bulk data, with or without executive and case control
    #[arg(value_name = "DECK", required_unless_present = "stiffness")]
    deck: Option<PathBuf>,
    /// Stiffness matrix instead of a deck: Matrix Market, DMIG or OUTPUT4; FILE#NAME takes one of several
    #[arg(long, value_name = "FILE", requires = "mass", conflicts_with_all = ["deck", "ignore"])]
    stiffness: Option<PathBuf>,
    /// Mass matrix in the same rows
    #[arg(long, value_name = "FILE", requires = "stiffness")]
    mass: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArguments,
    /// Number of the lowest modes, 100 if not given; all with a finite frequency if there are fewer
    #[arg(short, long, value_name = "N")]
    count: Option<NonZeroUsize>,
    /// Leave out cards of these names although corfem does not read them; the report lists them
    #[arg(long, value_name = "CARD", value_delimiter = ',')]
    ignore: Vec<String>,
}

/// Writes the deck of a case.
pub fn deck(arguments: &DeckArguments) -> Result<bool, PresentError> {
    let case = Case::from_reconstruction(
        arguments.case,
        reconstruction(arguments.box_file.as_deref())?,
    )?;
    let model = case.model()?;
    let mut factors = vec![1.0; model.parameters().len()];
    if arguments.pass > 0 {
        let passes = run_case(&case, |_, _| ())?.correlation.passes;
        let none = Error::Count {
            what: "pass",
            found: arguments.pass,
            least: 0,
            most: passes.len(),
        };
        factors = passes.get(arguments.pass - 1).ok_or(none)?.factors.clone();
    }
    let modes = model.modes(&factors)?;
    let frequencies = modes.frequencies_hz();
    let (lowest, highest) = (frequencies[0], frequencies[frequencies.len() - 1]);
    // A deck is easier to read with round numbers.
    let range_hz = [(RANGE[0] * lowest).floor(), (RANGE[1] * highest).ceil()];
    let bulk = BulkData::from_model(&model, &factors, &dynamic_points(&case.reconstruction)?)?;
    let title = format!("corfem case {}, pass {}", arguments.case, arguments.pass);
    let text = deck::write(&bulk, &title, modes.len(), range_hz)?;
    write(arguments.output.as_deref(), text.as_bytes())?;
    Ok(true)
}

/// Prints the modes of a deck or of matrices; true if none is lost and no doubt stands.
pub fn modes(arguments: &ModesArguments) -> Result<bool, PresentError> {
    let most = arguments.count.map_or(USUAL_COUNT, NonZeroUsize::get);
    let of_matrices = arguments.stiffness.as_ref().zip(arguments.mass.as_ref());
    let (unread, modes, model) = if let Some((stiffness, mass)) = of_matrices {
        (Vec::new(), matrix_modes(stiffness, mass, most)?, None)
    } else {
        let path = arguments.deck.as_deref().unwrap_or(Path::new(""));
        let name = path.display().to_string();
        let bytes = read_bytes(path).map_err(FileError::of_file(path, "read"))?;
        let deck = deck::read(&name, &bytes, &arguments.ignore)?;
        for card in &deck.unread {
            note(format_args!("corfem: {name}: {}", not_read(card)));
        }
        let modes = deck::modes(&deck.model, most)?;
        (deck.unread, modes, Some(deck.model))
    };
    let found = modes.modes.len();
    let is_short = found < most && modes.counted != Some(found);
    let are_lost = is_short && modes.counted.is_some();
    match modes.counted {
        Some(counted) if are_lost => note(format_args!(
            "corfem: {found} of {counted} modes of finite frequency were found; frequencies some three million times the lowest are lost"
        )),
        None if is_short && arguments.count.is_some() => note(format_args!(
            "corfem: {most} modes asked for; {found} were found, and how many there are was not counted"
        )),
        _ if found < most && arguments.count.is_some() => note(format_args!(
            "corfem: {most} modes asked for; all {found} of finite frequency are given"
        )),
        _ => (),
    }
    let tables = deck_tables(&unread, &modes, found);
    let document = || {
        let moving = model.as_ref().map(|model| deck::moving(model, &modes));
        json::deck_modes(
            &unread,
            &modes,
            &moving.transpose()?.unwrap_or_default(),
            found,
        )
    };
    arguments.output.write(&tables, document)?;
    let has_doubt = modes.doubtful.iter().any(|found| of_bodies(found).stands());
    Ok(!are_lost && !has_doubt)
}
