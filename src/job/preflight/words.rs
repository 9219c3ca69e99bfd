//! Names of sensors, parameters and test modes, and a change of the readings as a concern.

use super::shapes::Change;
use crate::files::test_data::DIRECTIONS;
use crate::job::concern::{Concern, Kind};

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
        let (kind, about) = match self {
            Self::Reversed(place) => (Kind::Reversed, vec![sensor(place)]),
            Self::Exchanged(both) => (Kind::Exchanged, both.iter().map(sensor).collect()),
            Self::Reordered(order) => {
                let numbers = order.iter().map(|place| (place + 1).to_string());
                (Kind::Reordered, numbers.collect())
            }
            Self::Gain(place, gain) => {
                return Concern::new(Kind::Gain, &[sensor(place)], &[evidence, *gain]);
            }
            Self::Dead(place) => (Kind::Dead, vec![sensor(place)]),
            Self::Direction(place, along) => (
                Kind::Direction,
                vec![sensor(place), DIRECTIONS[*along].to_owned()],
            ),
        };
        Concern::new(kind, &about, &[evidence])
    }
}
