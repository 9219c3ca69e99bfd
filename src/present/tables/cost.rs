//! What the method saves and how far it can be trusted: eigensolutions counted, and errors of predicted modes.

use crate::present::table::{Cell, Digits, Table, percents};
use crate::studies::eigensolutions::Counted;
use crate::studies::linearization::{Exact, MEASURES, METHODS, Prediction};

/// Full eigensolutions to an exact error sum, by perturbation and with an analysis after every step.
pub fn eigensolution_table(counted: &[Counted]) -> Table {
    let note = "Perturbation: the method, whose steps within a pass take no eigensolution. Re-analysis: the same rule of the step with \
        an analysis after every one. And differences: derivatives by an eigensolution per parameter and step too. A + says that \
        the error was not reached.";
    let mut table =
        Table::new("eigensolutions", "Full eigensolutions to an error sum, counted", "Structure, error sum")
            .headings(["Steps", "Perturbation", "Steps one by one", "Re-analysis", "And differences"], "")
            .notes([note]);
    for of in counted {
        let solutions = |analyses: usize, reached| match reached {
            true => Cell::count(analyses),
            false => Cell::text(format!("{analyses}+")),
        };
        let (quick, slow) = (of.perturbation, of.reanalysis);
        let all = slow.analyses + slow.steps * of.parameters;
        let cells = [Cell::count(quick.steps), solutions(quick.analyses, quick.reached), Cell::count(slow.steps)];
        let others = [slow.analyses, all].map(|count| solutions(count, slow.reached));
        table.row(format!("{}, {} %", of.name, 100.0 * of.error), cells.into_iter().chain(others));
    }
    table
}

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
                table.row(format!("{structure}, {}, {what}", of.step), percents(errors, Digits::Scientific(1)));
            }
        }
    }
    table
}
