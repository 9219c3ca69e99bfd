//! The modes of a deck as tables and as JSON.

use super::json::written;
use super::table::{Cell, Column, Digits, Row, Table};
use crate::files::deck::{Deck, Reason, Unread};
use crate::method::structure::DIRECTIONS;
use crate::method::whole_modes::WholeModes;
use crate::present::error::PresentError;
use serde::Serialize;

/// Modes side by side in one table of shapes: as many as a terminal is wide.
const MODES_PER_TABLE: usize = 9;
const FREQUENCY: Digits = Digits::Significant(7);
const MASS: Digits = Digits::Significant(6);
const SHAPE: Digits = Digits::Fixed(5);

/// Frequencies and shapes of the lowest `count` modes, every shape scaled to a largest component of one.
///
/// Generalized mass, $v^t M v$, is that of the shape so scaled, lbf·s²/in.
pub fn deck_tables(deck: &Deck, modes: &WholeModes, count: usize) -> Vec<Table> {
    let scaled = UnitShapes::new(modes, count);
    let number = |computed, digits| Cell::Number {
        computed,
        published: None,
        digits,
    };
    let column = |name: String, unit| Column { name, unit };
    let rows = scaled.frequencies_hz.iter().zip(&scaled.masses);
    let mut tables = vec![Table {
        name: "frequencies".into(),
        title: format!(
            "Natural frequencies at {} degrees of freedom with mass",
            modes.dof.len()
        ),
        label_heading: "Mode",
        columns: vec![
            column("Frequency".into(), "Hz"),
            column("Generalized mass".into(), "lbf·s²/in"),
        ],
        rows: rows
            .enumerate()
            .map(|(mode, (&frequency, &mass))| Row {
                label: (mode + 1).to_string(),
                cells: vec![number(frequency, FREQUENCY), number(mass, MASS)],
            })
            .collect(),
        notes: deck.unread.iter().map(not_read).collect(),
    }];
    let all: Vec<usize> = (0..scaled.frequencies_hz.len()).collect();
    for part in all.chunks(MODES_PER_TABLE) {
        let (first, last) = (part[0] + 1, part[part.len() - 1] + 1); // A chunk is never empty.
        tables.push(Table {
            name: format!("shapes_{first}_to_{last}"),
            title: format!("Shapes of modes {first} to {last}, largest component one"),
            label_heading: "Grid",
            columns: part
                .iter()
                .map(|mode| column(format!("Mode {}", mode + 1), ""))
                .collect(),
            rows: modes
                .dof
                .iter()
                .enumerate()
                .map(|(row, dof)| Row {
                    label: format!("{} {}", dof.grid, DIRECTIONS[dof.direction]),
                    cells: part
                        .iter()
                        .map(|&mode| number(scaled.shapes[mode][row], SHAPE))
                        .collect(),
                })
                .collect(),
            notes: Vec::new(),
        });
    }
    tables
}

/// One sentence about a card that was not read.
pub fn not_read(unread: &Unread) -> String {
    let Unread { card, line, reason } = unread;
    let why = match reason {
        Reason::Unknown => "is not known here",
        Reason::NotSelected => "belongs to a set that case control does not select",
    };
    format!("Not read: card {card} in line {line} {why}.")
}

/// The same as JSON; components in the order of `dof`.
///
/// # Errors
/// [`Error::Table`] when the writer fails.
pub fn deck_json(deck: &Deck, modes: &WholeModes, count: usize) -> Result<String, PresentError> {
    let scaled = UnitShapes::new(modes, count);
    let document = Document {
        units: "inch, lbf, second; frequencies in Hz",
        dof: modes
            .dof
            .iter()
            .map(|dof| DofDocument {
                grid: dof.grid,
                direction: DIRECTIONS[dof.direction],
            })
            .collect(),
        frequencies_hz: scaled.frequencies_hz,
        generalized_masses: scaled.masses,
        shapes: scaled.shapes,
        not_read: deck.unread.iter().map(not_read).collect(),
    };
    written(&document)
}

#[derive(Debug, Serialize)]
struct Document {
    units: &'static str,
    dof: Vec<DofDocument>,
    frequencies_hz: Vec<f64>,
    generalized_masses: Vec<f64>,
    shapes: Vec<Vec<f64>>,
    not_read: Vec<String>,
}

#[derive(Debug, Serialize)]
struct DofDocument {
    grid: usize,
    direction: char,
}

/// Modes scaled for a reader.
struct UnitShapes {
    frequencies_hz: Vec<f64>,
    /// Generalized masses.
    masses: Vec<f64>,
    /// By mode, then by DOF.
    shapes: Vec<Vec<f64>>,
}

impl UnitShapes {
    fn new(modes: &WholeModes, count: usize) -> Self {
        let mut frequencies_hz = modes.modes.frequencies_hz();
        frequencies_hz.truncate(count);
        let columns = modes.modes.shapes.column_iter().take(count);
        let (masses, shapes) = columns
            .map(|shape| {
                // Shapes come with unit generalized mass and a positive largest component.
                let largest = shape.amax();
                let unit = shape.iter().map(|component| component / largest).collect();
                (largest.powi(-2), unit)
            })
            .unzip();
        Self {
            frequencies_hz,
            masses,
            shapes,
        }
    }
}
