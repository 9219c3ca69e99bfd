//! Names of sensors, parameters and test modes, and a change of the readings as a concern.

use super::shapes::Change;
use crate::job::concern::{Check, Concern};

/// Names of sensors and parameters, their places from one where they have none, and numbers of test modes.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// The sensors' names.
    pub sensors: Vec<String>,
    /// The parameters' names.
    pub parameters: Vec<String>,
    /// Places of the test modes in the test's file.
    pub modes: Vec<usize>,
    /// The test's file.
    pub file: String,
}

fn name(names: &[String], place: usize) -> String {
    let number = || (place + 1).to_string();
    names.get(place).cloned().unwrap_or_else(number)
}

impl Names {
    pub(super) fn sensor(&self, place: usize) -> String {
        name(&self.sensors, place)
    }

    pub(super) fn parameter(&self, place: usize) -> String {
        name(&self.parameters, place)
    }

    /// The number of a test mode in the test's file.
    pub(super) fn mode(&self, place: usize) -> usize {
        self.modes.get(place).copied().unwrap_or(place) + 1
    }
}

impl Change {
    /// The doubt that a change raises which makes the shapes more likely by ten to the power of `evidence`.
    pub fn concern(&self, evidence: f64, names: &Names) -> Concern {
        let (name, places, what) = match self {
            Self::Reversed(place) => (
                "reversed-",
                vec![*place],
                "reversed? Give its row the other sign".to_owned(),
            ),
            Self::Exchanged(both) => (
                "exchanged-",
                both.to_vec(),
                "exchanged? Exchange the readings of their rows".to_owned(),
            ),
            Self::Gain(place, gain) => (
                "gain-",
                vec![*place],
                format!("reads {gain:.3} times too much? Divide its row by that"),
            ),
            Self::Dead(place) => ("dead-", vec![*place], "dead? Leave out its row".to_owned()),
        };
        let about: Vec<String> = places.into_iter().map(|own| names.sensor(own)).collect();
        let words = format!(
            "Sensor{} {} {what} in {}. The test's shapes would be 10^{evidence:.1} times as likely, with its noise and a model 30 % wrong.",
            if about.len() > 1 { "s" } else { "" },
            about.join(" and "),
            names.file
        );
        Concern::doubt(Check::Readings, name, &about, words)
    }
}
