//! Errors of files of other programs.

use crate::files::deck::{Reason, Unread};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// An error of a deck, a job or a file.
///
/// The message above a variant is the documentation of its fields. Lines count from one.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum FileError {
    /// The method refuses its input or cannot go on.
    #[error(transparent)]
    Method(#[from] crate::method::error::Error),
    /// A line of a file that cannot be read, and the reason.
    #[error("{file}, line {line}: {reason}")]
    DeckLine {
        file: String,
        line: usize,
        reason: String,
    },
    /// Cards that are not read, some of which may be part of the model and are not understood.
    #[error("{}", of_cards(.file, .cards))]
    DeckCards { file: String, cards: Vec<Unread> },
    /// A job, a name in it or another request that is refused, and the reason.
    #[error("{of}: {reason}")]
    Refused { of: String, reason: String },
    /// A request to stop a correlation.
    #[error("the correlation was stopped by request")]
    Interrupted,
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
    pub(crate) fn line(file: &str, line: usize, reason: impl Into<String>) -> Self {
        Self::DeckLine {
            file: file.to_owned(),
            line,
            reason: reason.into(),
        }
    }

    /// An error about one of the lines of a file, counted from zero, or about its end.
    pub(crate) fn at(file: &str, lines: &[&str], at: usize, what: &str) -> Self {
        let end = || format!("the file ends before {what}");
        let reason = lines
            .get(at)
            .map_or_else(end, |line| is_not(line.trim(), what));
        Self::line(file, at + 1, reason)
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

/// Ends a function with an error unless something is met: `ensure(is_met, || error)?`.
pub(crate) fn ensure<E>(is_met: bool, error: impl FnOnce() -> E) -> Result<(), E> {
    if is_met { Ok(()) } else { Err(error()) }
}

/// Says that a text is missing, or that it is not what belongs there.
pub(crate) fn is_not(text: &str, what: &str) -> String {
    if text.is_empty() {
        format!("{what} is missing")
    } else {
        format!("\"{text}\" is not {what}")
    }
}

/// Reason for which the operating system refused a file.
fn why(action: &str, source: &std::io::Error) -> String {
    match (source.kind(), action) {
        (std::io::ErrorKind::NotFound, "write") => "no such folder".to_owned(),
        (std::io::ErrorKind::NotFound, _) => "no such file".to_owned(),
        (std::io::ErrorKind::AlreadyExists, _) => "it is there already".to_owned(),
        _ => source.to_string(),
    }
}

/// Message about cards that are not read: of elements that the crate lacks, names of other files, those that it does not know, and
/// those without part in the model.
fn of_cards(file: &str, cards: &[Unread]) -> String {
    let of = |reason| cards.iter().filter(move |card| card.reason == reason);
    let coupled = match of(Reason::Lacking).any(|card| card.card == "PARAM COUPMASS") {
        true => {
            "; and PARAM COUPMASS couples masses, and its modes differ from those of the lumped masses here; remove it if lumped ones will do"
        }
        false => "",
    };
    let unknown: Vec<&str> = of(Reason::Unknown).map(|card| &card.card[..]).collect();
    let said = [
        (
            Reason::Lacking,
            "corfem lacks what ",
            format!(
                " stand for, and without them the modes are others; let the program that the deck is for write the stiffness and mass, \
                 and give these (paper/matrices.md){coupled}"
            ),
        ),
        (
            Reason::Elsewhere,
            "corfem reads one file, and any of the model may be in those that ",
            " name; paste their text in place of these lines".to_owned(),
        ),
        (
            Reason::Unknown,
            "corfem does not read ",
            format!(
                ", which may carry stiffness, mass, supports or coordinates; correct them, or take responsibility for leaving them out \
                 with --ignore '{}'",
                unknown.join(",")
            ),
        ),
        (
            Reason::WithoutPart,
            "no part in the model, so left out: ",
            String::new(),
        ),
    ].into_iter().filter_map(|(reason, before, behind)| {
        let places: Vec<String> = of(reason).map(Unread::place).collect();
        (!places.is_empty()).then(|| format!("{before}{}{behind}", places.join(", ")))
    });
    format!("{file}: {}", said.collect::<Vec<_>>().join("; and "))
}
