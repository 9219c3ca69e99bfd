//! How far the steps can be trusted: errors of predicted modes, as a table.

use super::predictions::{Exact, MEASURES, METHODS, Prediction};
use crate::prelude::*;

/// RMS errors of predicted frequencies and shapes, a whole step, a quarter and a sixteenth, beside exact ones.
pub fn linearization_table(structures: &[(&str, Vec<Prediction>)], exact: Exact) -> Table {
    let (name, against) = match exact {
        Exact::SameCondensation => ("linearization", "with the same condensation"),
        Exact::NewCondensation => ("linearization_new", "condensed anew"),
    };
    let title = format!("Errors of modes predicted for a step, beside exact ones {against}");
    let mut table = Table::new(name, title, "Structure, step").headings(METHODS, "%");
    for (structure, predictions) in structures {
        for (what, measure) in MEASURES {
            for of in predictions.iter().step_by(2).take(3) {
                let errors = of.errors.iter().map(|error| error.as_ref().map(measure));
                table.row(
                    format!("{structure}, {}, {what}", of.step),
                    percents(errors, Digits::Scientific(1)),
                );
            }
        }
    }
    table
}
