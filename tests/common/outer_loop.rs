//! The outer loop through NASTRAN-95: the program that does it, and its stored answers.

#[path = "../../paper/nastran95.rs"]
pub mod program;

use crate::prelude::*;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    case: Vec<StoredCase>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredCase {
    pub number: usize,
    pub test_frequencies_hz: Vec<f64>,
    pub initial: StoredCheck,
    pub passes: Vec<StoredCheck>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredCheck {
    pub iterations: Option<usize>,
    pub gages_in: Vec<f64>,
    pub frequencies_hz: Vec<f64>,
    pub frequency_rms: f64,
    pub shape_rms: f64,
}

/// The delta wing's correlation, `golden/nastran95/delta_wing.toml`.
#[derive(Debug, Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct StoredWing {
    pub test_frequencies_hz: Vec<f64>,
    pub initial: StoredWingCheck,
    pub passes: Vec<StoredWingCheck>,
}

#[derive(Debug, Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct StoredWingCheck {
    pub iterations: Option<usize>,
    pub factors: Vec<f64>,
    pub frequencies_hz: Vec<f64>,
    pub frequency_rms: f64,
    pub shape_rms: f64,
}

impl StoredWing {
    /// The exact solutions: the initial one, and that after every pass.
    pub fn checks(&self) -> impl Iterator<Item = &StoredWingCheck> {
        once(&self.initial).chain(&self.passes)
    }
}

pub fn stored_wing() -> StoredWing {
    let text = include_str!("../../golden/nastran95/delta_wing.toml");
    toml::from_str(text).unwrap()
}

pub fn stored() -> Vec<StoredCase> {
    let cases = read_cases(include_str!("../../golden/nastran95/outer_loop.toml"));
    assert!(cases.iter().map(|case| case.number).eq(CASES));
    cases
}

/// Cases of a text such as the golden's.
pub fn read_cases(text: &str) -> Vec<StoredCase> {
    let stored: Stored = toml::from_str(text).unwrap();
    stored.case
}

/// Frequencies of the modes that answer the test's, in its order, Hz.
pub fn paired_hz(state: &State) -> Vec<f64> {
    let paired = state.pairing.paired(&state.modes);
    paired.unwrap().frequencies_hz()
}

pub fn assert_near(found: &[f64], expected: &[f64], relative: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        assert_within(a, b, relative * b.abs());
    }
}
