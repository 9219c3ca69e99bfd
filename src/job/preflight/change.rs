//! Single changes of the test's shapes.

use super::Names;
use crate::job::concern::{Check, Concern};
use nalgebra::DMatrix;

/// One change of the test shapes; places count from zero.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The sign of one sensor.
    Reversed(usize),
    /// Two sensors exchanged.
    Exchanged([usize; 2]),
    /// A sensor whose readings are so many times too large.
    Gain(usize, f64),
    /// A sensor that reads nothing but noise.
    Dead(usize),
}

impl Change {
    /// The test shapes after it.
    pub(super) fn of(&self, shapes: &DMatrix<f64>) -> DMatrix<f64> {
        let mut changed = shapes.clone();
        match self {
            Self::Reversed(sensor) => changed.row_mut(*sensor).neg_mut(),
            Self::Exchanged([a, b]) => changed.swap_rows(*a, *b),
            Self::Gain(sensor, gain) => changed.row_mut(*sensor).unscale_mut(*gain),
            Self::Dead(_) => {}
        }
        changed
    }

    /// The doubt that a change raises which makes the shapes more likely by ten to the power of `evidence`.
    pub fn concern(&self, evidence: f64, names: &Names) -> Concern {
        let (name, places, what) = match self {
            Self::Reversed(place) => (
                "reversed-",
                vec![place],
                "reversed? Give its row the other sign".to_owned(),
            ),
            Self::Exchanged([a, b]) => (
                "exchanged-",
                vec![a, b],
                "exchanged? Exchange the readings of their rows".to_owned(),
            ),
            Self::Gain(place, gain) => (
                "gain-",
                vec![place],
                format!("reads {gain:.3} times too much? Divide its row by that"),
            ),
            Self::Dead(place) => ("dead-", vec![place], "dead? Leave out its row".to_owned()),
        };
        let about: Vec<String> = places.into_iter().map(|own| names.sensor(*own)).collect();
        let words = format!(
            "Sensor{} {} {what} in {}. The test's shapes would be 10^{evidence:.1} times as likely, with its noise and a model 30 % wrong.",
            if about.len() > 1 { "s" } else { "" },
            about.join(" and "),
            names.file
        );
        Concern::doubt(Check::Readings, name, &about, words)
    }
}
