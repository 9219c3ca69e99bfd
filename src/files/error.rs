//! What can go wrong with files of other programs and with the programs themselves.

use crate::files::deck::Unread;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// An error of a deck, of a run of NASTRAN-95 or of a file.
///
/// The message above a variant is the documentation of its fields. Lines count from one.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum FileError {
    /// The method refuses its input or cannot go on.
    #[error(transparent)]
    Method(#[from] crate::method::error::Error),
    /// A line of a deck or of a test's file that is not what it must be.
    #[error("{file}, line {line}: expected {expected}, found {found}")]
    DeckLine {
        file: String,
        line: usize,
        expected: &'static str,
        found: String,
    },
    /// A field of a bulk data card that is not what it must be: number 2 to 9 on the card's first line, 12 to 19 on its first
    /// continuation, and so on.
    #[error("{file}, line {line}: card {card}, field {field}: expected {expected}, found {found}")]
    DeckField {
        file: String,
        line: usize,
        card: String,
        field: usize,
        expected: String,
        found: String,
    },
    /// Cards that may be part of the model and are not understood.
    #[error(
        "{file}: expected cards that are read here, found {}; they may carry stiffness, mass, supports or coordinates: \
         correct them, or take responsibility for leaving them out with --ignore '{}'",
        .cards.iter().map(Unread::place).collect::<Vec<_>>().join(", "),
        .cards.iter().map(|unread| unread.card.as_str()).collect::<Vec<_>>().join(",")
    )]
    DeckCards { file: String, cards: Vec<Unread> },
    /// Elements so unlike in stiffness that double precision loses the softer one: the largest entry of each one's stiffness
    /// matrix, lbf/in, with its number.
    #[error(
        "stiffness: expected no element more than {most:.0e} times as stiff as another, found {:.3e} in element {} and \
         {:.3e} in element {}",
        .stiffest.0, .stiffest.1, .softest.0, .softest.1
    )]
    StiffnessRange {
        most: f64,
        softest: (f64, usize),
        stiffest: (f64, usize),
    },
    /// Modes whose frequencies are too far above the lowest for double precision; the smallest and the largest mass, lbf·s²/in,
    /// with its grid and direction.
    #[error(
        "modes: expected {expected}, one for every mass that moves by itself, found {found}: frequencies some three \
         million times the lowest are lost, for the masses go from {:.3e} at {} to {:.3e} at {}",
        .lightest.0, .lightest.1, .heaviest.0, .heaviest.1
    )]
    LostModes {
        expected: usize,
        found: usize,
        lightest: (f64, String),
        heaviest: (f64, String),
    },
    /// An element at a degree of freedom that an MPC equation makes dependent.
    #[error(
        "element {element}: expected its grids free of MPC equations, found grid {grid} tied along {direction}"
    )]
    TiedElement {
        element: usize,
        grid: usize,
        direction: char,
    },
    /// A job, what it names, or what else is asked for, that is not what it must be.
    #[error("{of}: expected {expected}, found {found}")]
    Input {
        of: String,
        expected: String,
        found: String,
    },
    /// A job or what it names that is refused, and why.
    #[error("{of}: {reason}")]
    Refused { of: String, reason: String },
    /// A request to stop a correlation.
    #[error("correlation: expected to go on, found a request to stop")]
    Interrupted,
    /// NASTRAN-95 is not in the given folder.
    #[error(
        "NASTRAN-95: expected its folder with bin/nastrn and rf/, found none at {path}; \
         name it with --nastran or the environment variable NASTRAN95"
    )]
    SolverMissing { path: PathBuf },
    /// NASTRAN-95 did not end in time and was stopped.
    #[error("NASTRAN-95: expected it to end within {seconds} s, found it still running")]
    SolverTimeLimit { seconds: f64 },
    /// A request to stop while NASTRAN-95 was running.
    #[error("NASTRAN-95: expected to wait for its end, found a request to stop")]
    SolverInterrupted,
    /// NASTRAN-95 ended with an error status or a signal.
    #[error("NASTRAN-95: expected it to end well, found {status}: {message}")]
    SolverCrashed { status: String, message: String },
    /// NASTRAN-95 refused its input.
    #[error("NASTRAN-95: expected a run without fatal messages, found: {message}")]
    SolverFatal { message: String },
    /// Results of NASTRAN-95 that are not what the deck asks for.
    #[error("NASTRAN-95: expected {expected}, found {found}")]
    SolverAnswer { expected: String, found: String },
    /// A file that the operating system refuses to read, write, run or remove; `named` says where it is named, if it is.
    #[error("cannot {action} {}{named}: {}", .path.display(), why(action, source))]
    File {
        path: PathBuf,
        action: &'static str,
        named: String,
        source: std::io::Error,
    },
}

impl FileError {
    pub(crate) fn line(
        file: &str,
        line: usize,
        expected: &'static str,
        found: impl Into<String>,
    ) -> Self {
        Self::DeckLine {
            file: file.to_owned(),
            line,
            expected,
            found: found.into(),
        }
    }

    /// An error about one of the lines of a file, counted from zero, or about its end.
    pub(crate) fn at(file: &str, lines: &[&str], at: usize, expected: &'static str) -> Self {
        Self::line(
            file,
            at + 1,
            expected,
            lines
                .get(at)
                .map_or("the end of the file", |line| line.trim()),
        )
    }

    pub(crate) fn answer(expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::SolverAnswer {
            expected: expected.into(),
            found: found.into(),
        }
    }

    pub(crate) fn input(
        of: impl ToString,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> Self {
        Self::Input {
            of: of.to_string(),
            expected: expected.into(),
            found: found.into(),
        }
    }

    pub(crate) fn refused(of: impl ToString, reason: impl Into<String>) -> Self {
        Self::Refused {
            of: of.to_string(),
            reason: reason.into(),
        }
    }

    /// Turns the operating system's error about a file into this one, for `map_err`.
    pub fn of_file(path: &Path, action: &'static str) -> impl Fn(std::io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::File {
            path: path.clone(),
            action,
            named: String::new(),
            source,
        }
    }
}

/// Why a file was refused.
fn why(action: &str, source: &std::io::Error) -> String {
    match (source.kind(), action) {
        (std::io::ErrorKind::NotFound, "write") => "no such folder".to_owned(),
        (std::io::ErrorKind::NotFound, _) => "no such file".to_owned(),
        _ => source.to_string(),
    }
}
