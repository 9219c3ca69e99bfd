//! What can go wrong with files of other programs and with the programs themselves.

use crate::files::deck::Unread;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// An error of a deck, of a run of NASTRAN-95 or of a file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The method refuses its input or cannot go on.
    #[error(transparent)]
    Method(#[from] crate::method::error::Error),
    /// A line of a deck or of a test's file that is not what it must be.
    #[error("{file}, line {line}: expected {expected}, found {found}")]
    DeckLine {
        /// The file.
        file: String,
        /// The line, from one.
        line: usize,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        found: String,
    },
    /// A field of a bulk data card that is not what it must be.
    #[error("{file}, line {line}: card {card}, field {field}: expected {expected}, found {found}")]
    DeckField {
        /// The deck.
        file: String,
        /// The line of the field, from one.
        line: usize,
        /// Name of the card.
        card: String,
        /// Number of the field: 2 to 9 on the card's first line, 12 to 19 on its first continuation, and so on.
        field: usize,
        /// What it must be.
        expected: String,
        /// What it is.
        found: String,
    },
    /// Cards that may be part of the model and are not understood.
    #[error(
        "{file}: expected cards that are read here, found {}; they may carry stiffness, mass, supports or coordinates: \
         correct them, or take responsibility for leaving them out with --ignore '{}'",
        .cards.iter().map(Unread::place).collect::<Vec<_>>().join(", "),
        .cards.iter().map(|unread| unread.card.as_str()).collect::<Vec<_>>().join(",")
    )]
    DeckCards {
        /// The deck.
        file: String,
        /// All of them, by name.
        cards: Vec<Unread>,
    },
    /// A card to be ignored that is read.
    #[error("--ignore: expected a card that is not read here, found {card}")]
    IgnoredCard {
        /// Its name.
        card: String,
    },
    /// More masses than memory has room for.
    #[error(
        "modes: expected dense matrices of at most {most:.1} GiB, found {needed:.1} GiB for {masses} degrees of \
         freedom with mass among {free} free ones"
    )]
    TooManyMasses {
        /// Most memory, GiB.
        most: f64,
        /// Memory that they need, GiB.
        needed: f64,
        /// Degrees of freedom with mass.
        masses: usize,
        /// Free structural degrees of freedom.
        free: usize,
    },
    /// Elements so unlike in stiffness that double precision loses the softer one.
    #[error(
        "stiffness: expected no element more than {most:.0e} times as stiff as another, found {:.3e} in element {} and \
         {:.3e} in element {}",
        .stiffest.0, .stiffest.1, .softest.0, .softest.1
    )]
    StiffnessRange {
        /// Largest ratio.
        most: f64,
        /// Smallest largest entry of an element's stiffness matrix, lbf/in, and the element.
        softest: (f64, usize),
        /// Largest one, lbf/in, and the element.
        stiffest: (f64, usize),
    },
    /// Modes whose frequencies are too far above the lowest for double precision.
    #[error(
        "modes: expected {expected}, one for every mass that moves by itself, found {found}: frequencies some three \
         million times the lowest are lost, for the masses go from {:.3e} at {} to {:.3e} at {}",
        .lightest.0, .lightest.1, .heaviest.0, .heaviest.1
    )]
    LostModes {
        /// Masses that move independently.
        expected: usize,
        /// Modes with a finite frequency.
        found: usize,
        /// Smallest mass, lbf·s²/in, and its grid and direction.
        lightest: (f64, String),
        /// Largest mass, lbf·s²/in, and its grid and direction.
        heaviest: (f64, String),
    },
    /// An element at a degree of freedom that an MPC equation makes dependent.
    #[error("element {element}: expected its grids free of MPC equations, found grid {grid} tied along {direction}")]
    TiedElement {
        /// The element.
        element: usize,
        /// The grid.
        grid: usize,
        /// The dependent direction: `x`, `y` or `z`.
        direction: char,
    },
    /// A job, or what it names, that is not what it must be.
    #[error("{file}: expected {expected}, found {found}")]
    Job {
        /// The file.
        file: String,
        /// What it must say.
        expected: String,
        /// What it says.
        found: String,
    },
    /// A request to stop a correlation.
    #[error("correlation: expected to go on, found a request to stop")]
    Interrupted,
    /// NASTRAN-95 is not in the given folder.
    #[error(
        "NASTRAN-95: expected its folder with bin/nastrn and rf/, found none at {path}; \
         name it with --nastran or the environment variable NASTRAN95"
    )]
    SolverMissing {
        /// The folder looked in.
        path: PathBuf,
    },
    /// NASTRAN-95 did not end in time and was stopped.
    #[error("NASTRAN-95: expected it to end within {seconds} s, found it still running")]
    SolverTimeLimit {
        /// The limit.
        seconds: f64,
    },
    /// A request to stop while NASTRAN-95 was running.
    #[error("NASTRAN-95: expected to wait for its end, found a request to stop")]
    SolverInterrupted,
    /// NASTRAN-95 ended with an error status or a signal.
    #[error("NASTRAN-95: expected it to end well, found {status}: {message}")]
    SolverCrashed {
        /// How it ended.
        status: String,
        /// The last lines it printed.
        message: String,
    },
    /// NASTRAN-95 refused its input.
    #[error("NASTRAN-95: expected a run without fatal messages, found: {message}")]
    SolverFatal {
        /// Its first fatal message.
        message: String,
    },
    /// Results of NASTRAN-95 that are not what the deck asks for.
    #[error("NASTRAN-95: expected {expected}, found {found}")]
    SolverAnswer {
        /// What the answer must be.
        expected: String,
        /// What it is.
        found: String,
    },
    /// A file that the operating system refuses to read, write, run or remove.
    #[error("{path}: expected to {action} it, found an error: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// `read`, `write`, `run` or `remove`.
        action: &'static str,
        /// The operating system's message.
        source: std::io::Error,
    },
}

impl FileError {
    pub(crate) fn line(file: &str, line: usize, expected: &'static str, found: impl Into<String>) -> Self {
        Self::DeckLine { file: file.to_owned(), line, expected, found: found.into() }
    }

    pub(crate) fn answer(expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::SolverAnswer { expected: expected.into(), found: found.into() }
    }

    pub(crate) fn job(file: &Path, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::Job { file: file.display().to_string(), expected: expected.into(), found: found.into() }
    }

    /// Turns the operating system's error about a file into this one, for `map_err`.
    pub fn of_file(path: &Path, action: &'static str) -> impl Fn(std::io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::File { path: path.clone(), action, source }
    }
}
