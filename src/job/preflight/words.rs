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
        let sensor = |place: &usize| names.sensor(*place);
        let (name, about, question) = match self {
            Self::Reversed(place) => (
                "reversed-",
                vec![sensor(place)],
                format!("Sensor {} reversed?", sensor(place)),
            ),
            Self::Exchanged([a, b]) => {
                let both = [sensor(a), sensor(b)];
                (
                    "exchanged-",
                    both.to_vec(),
                    format!("Sensors {} and {} exchanged?", both[0], both[1]),
                )
            }
            Self::Gain(place, gain) => (
                "gain-",
                vec![sensor(place)],
                format!("Sensor {} reads {gain:.3} times too much?", sensor(place)),
            ),
            Self::Dead(place) => (
                "dead-",
                vec![sensor(place)],
                format!("Sensor {} dead?", sensor(place)),
            ),
        };
        let words = format!(
            "{question} The test's shapes would be 10^{evidence:.1} times as likely, with its noise and a model 30 % wrong."
        );
        Concern::doubt(Check::Readings, name, &about, words)
    }
}
