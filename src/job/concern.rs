//! Concerns, which lower the trust in a job's result: what each is about, in a sentence, and the question that it answers.

use crate::files::error::FileError;
use serde::Serialize;

/// The effect of a concern on a result, what matters most first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Grade {
    /// It names a mistake.
    Doubt,
    /// It names a mistake, for which the user answers.
    #[serde(rename = "doubt, accepted")]
    Accepted,
    /// A selected test mode is not compared.
    #[serde(rename = "left out")]
    LeftOut,
    /// A question could not be answered.
    #[serde(rename = "not checked")]
    NotChecked,
    /// It limits what is known.
    #[default]
    Remark,
}

/// A question that the look at a job before its first step, or the account after a run, asks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Check {
    #[default]
    FreeMotions,
    ModesMeasuredTwice,
    CommonFactor,
    Readings,
    Settings,
    PlacesOfSensors,
    Units,
    Pairs,
    Reach,
    PartsOfTheModel,
    ComplexShapes,
    Inputs,
    Deviations,
    Sight,
    Fit,
    Intervals,
}

/// The answer to a question: there is something to say, there is nothing, or it cannot be told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// There is something to say.
    Yes,
    /// There is nothing.
    No,
    /// It cannot be told, and a concern says why.
    NotChecked,
}

/// A question by its name, and its answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Answered {
    /// The name.
    pub check: &'static str,
    /// The answer.
    pub answer: Answer,
}

/// Names of all questions, those of a result last.
const NAMES: [&str; 16] = [
    "free motions",
    "modes measured twice",
    "factor of all frequencies",
    "readings of sensors",
    "settings",
    "places of sensors",
    "units of the test",
    "pairs",
    "frequencies in reach",
    "parts of the model",
    "complex shapes",
    "use of the inputs",
    "deviations of the test",
    "what the test sees",
    "the fit",
    "intervals",
];

impl Check {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        NAMES[self as usize]
    }
}

/// Something that a reader must know before trusting a result.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Concern {
    /// Its effect.
    pub grade: Grade,
    /// The question that it answers.
    pub check: Check,
    /// The name of it on the command line: words, numbers and names joined by hyphens.
    pub identifier: String,
    /// The sensors, parameters or entries that it is about, by name, or the test modes by number.
    pub about: Vec<String>,
    /// A sentence that says it.
    pub words: String,
}

/// About nothing in particular.
pub(super) const NONE: [&str; 0] = [];

/// Most names that a sentence lists.
const MOST_LISTED: usize = 8;

/// Names in a sentence, at most eight of them.
pub(crate) fn some(names: &[impl ToString]) -> String {
    let words = names.iter().take(MOST_LISTED).map(ToString::to_string);
    let words = words.collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(MOST_LISTED) {
        0 => words,
        more => format!("{words} and {more} more"),
    }
}

/// Places from zero as numbers from one.
pub(super) fn numbers(places: impl IntoIterator<Item = usize>) -> Vec<usize> {
    places.into_iter().map(|place| place + 1).collect()
}

/// A remark with a list at its end, if there is anything in it.
pub(super) fn listed(
    check: Check,
    name: &str,
    words: &str,
    about: &[impl ToString],
) -> Option<Concern> {
    (!about.is_empty())
        .then(|| Concern::remark(check, name, about, format!("{words}: {}.", some(about))))
}

impl Concern {
    /// A concern with a sentence; its identifier is `name`, and the names of what it is about where it is about some things among many.
    pub fn new(
        grade: Grade,
        check: Check,
        name: &str,
        about: &[impl ToString],
        words: impl Into<String>,
    ) -> Self {
        let about: Vec<String> = about.iter().map(ToString::to_string).collect();
        let mut identifier = name.to_owned();
        if name.ends_with('-') {
            identifier += &about.join("-");
        }
        Self {
            grade,
            check,
            identifier: identifier.replace(char::is_whitespace, "-"),
            about,
            words: words.into(),
        }
    }

    /// A doubt.
    pub fn doubt(
        check: Check,
        name: &str,
        about: &[impl ToString],
        words: impl Into<String>,
    ) -> Self {
        Self::new(Grade::Doubt, check, name, about, words)
    }

    /// A remark.
    pub fn remark(
        check: Check,
        name: &str,
        about: &[impl ToString],
        words: impl Into<String>,
    ) -> Self {
        Self::new(Grade::Remark, check, name, about, words)
    }

    /// The remark that a question could not be answered.
    pub(super) fn not_checked(check: Check, reason: &str) -> Self {
        let name = check.name();
        Self::new(
            Grade::NotChecked,
            check,
            "not-checked-",
            &[name],
            format!("Not checked: {name} ({reason})."),
        )
    }

    /// True if it names a mistake that nobody answers for.
    pub fn stands(&self) -> bool {
        self.grade == Grade::Doubt
    }
}

/// Everything that may lower the trust in a job's result, what matters most first.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(transparent)]
pub struct Trust {
    concerns: Vec<Concern>,
}

impl Trust {
    /// The concerns, what matters most first.
    pub fn new(mut concerns: Vec<Concern>) -> Self {
        concerns.sort_by_key(|own| (own.grade, own.check));
        Self { concerns }
    }

    /// The concerns, what matters most first.
    pub fn all(&self) -> &[Concern] {
        &self.concerns
    }

    /// The answer to every question, of a result's too after a run.
    pub fn answers(&self, is_run: bool) -> Vec<Answered> {
        let asked = if is_run {
            NAMES.len()
        } else {
            Check::Sight as usize
        };
        let answer = |(place, check): (usize, &'static str)| {
            let own = self.concerns.iter();
            // A question that could not be answered in part has an answer.
            let answer = match own
                .filter(|own| own.check as usize == place)
                .map(|own| own.grade)
                .min_by_key(|grade| *grade == Grade::NotChecked)
            {
                None => Answer::No,
                Some(Grade::NotChecked) => Answer::NotChecked,
                Some(_) => Answer::Yes,
            };
            Answered { check, answer }
        };
        NAMES
            .into_iter()
            .enumerate()
            .take(asked)
            .map(answer)
            .collect()
    }

    /// The account after a run, with what is known since; test modes are left out by what it ended with.
    pub(super) fn after(&self, concerns: Vec<Concern>) -> Self {
        let is_of_first = |own: &&Concern| {
            let name = &own.identifier;
            name.starts_with("not-compared-") || name == "unanswered-modes"
        };
        Self::new(
            self.concerns
                .iter()
                .filter(|own| !is_of_first(own))
                .cloned()
                .chain(concerns)
                .collect(),
        )
    }

    /// The account after the user answers for the doubts of these identifiers.
    ///
    /// # Errors
    /// [`FileError::Refused`] for an identifier that names no doubt, with those that there are.
    pub fn accepting(mut self, accepted: &[String]) -> Result<Self, FileError> {
        let doubts = self.concerns.iter().filter(|own| own.stands());
        let doubts: Vec<&str> = doubts.map(|own| &own.identifier[..]).collect();
        if let Some(unknown) = accepted.iter().find(|name| !doubts.contains(&&name[..])) {
            let reason = match &doubts[..] {
                [] => "nothing is doubtful".to_owned(),
                _ => format!("the doubts are {}", doubts.join(", ")),
            };
            return Err(FileError::refused(format!("--accept {unknown}"), reason));
        }
        for own in &mut self.concerns {
            if own.stands() && accepted.contains(&own.identifier) {
                own.grade = Grade::Accepted;
            }
        }
        Ok(self)
    }

    /// True if a doubt stands that nobody answers for.
    pub fn has_doubt(&self) -> bool {
        self.concerns.iter().any(Concern::stands)
    }

    /// True if a doubt or a selected mode that is not compared stands against the result.
    pub fn stands_against(&self) -> bool {
        self.has_doubt() || self.concerns.iter().any(|own| own.grade == Grade::LeftOut)
    }
}
