//! The modes of a deck as tables.

use super::{Cell, Digits, Table};
use crate::files::deck::{Deck, Reason, Unread};
use crate::method::structure::DIRECTIONS;
use crate::present::table::counted;
use crate::studies::whole_modes::WholeModes;

/// Modes side by side in one table of shapes: as many as a line of text has room for.
const MODES_PER_TABLE: usize = 9;
const FREQUENCY: Digits = Digits::Significant(7);
const MASS: Digits = Digits::Significant(6);
const SHAPE: Digits = Digits::Fixed(5);

/// Frequencies and shapes of the lowest `count` modes, every shape scaled to a largest component of one, after a table
/// of what was left out by request.
///
/// Generalized mass, $v^t M v$, is that of the shape so scaled, lbf·s²/in.
pub fn deck_tables(deck: &Deck, modes: &WholeModes, count: usize) -> Vec<Table> {
    let scaled = UnitShapes::new(modes, count);
    let dof = counted(modes.dof.len(), "degree", "degrees");
    let title = format!("Natural frequencies at {dof} of freedom with mass");
    let mut table =
        Table::new("frequencies", title, "Mode").column("Frequency", "Hz").column("Generalized mass", "lbf·s²/in");
    table.notes = deck.unread.iter().filter(|unread| unread.reason != Reason::Ignored).map(not_read).collect();
    if modes.rigid_body > 0 {
        let rigid = counted(modes.rigid_body, "rigid-body mode is", "rigid-body modes are");
        table = table.note(format!("The structure hangs free: {rigid} not listed."));
    }
    for (mode, frequency) in scaled.frequencies_hz.iter().enumerate() {
        table.row(mode + 1, [Cell::number(*frequency, FREQUENCY), Cell::number(scaled.masses[mode], MASS)]);
    }
    let mut tables: Vec<Table> = ignored(deck).into_iter().chain([table]).collect();
    for (part, shapes) in scaled.shapes.chunks(MODES_PER_TABLE).enumerate() {
        let (first, last) = (MODES_PER_TABLE * part + 1, MODES_PER_TABLE * part + shapes.len());
        let title = format!("Shapes of modes {first} to {last}, largest component one");
        let mut table = Table::new(format!("shapes_{first}_to_{last}"), title, "Grid")
            .columns((first..=last).map(|mode| format!("Mode {mode}")), "");
        for (row, dof) in modes.dof.iter().enumerate() {
            let label = format!("{} {}", dof.grid, DIRECTIONS[dof.direction]);
            table.row(label, shapes.iter().map(|shape| Cell::number(shape[row], SHAPE)));
        }
        tables.push(table);
    }
    tables
}

/// Cards left out by request, where there are any.
fn ignored(deck: &Deck) -> Option<Table> {
    let mut table = Table::new("ignored", "Cards left out by request: these modes lack what they say", "Card")
        .columns(["Cards", "First line"], "");
    for unread in deck.unread.iter().filter(|unread| unread.reason == Reason::Ignored) {
        table.row(&unread.card, [unread.count, unread.line].map(Cell::count));
    }
    (!table.rows.is_empty()).then_some(table)
}

/// One sentence about cards that were not read.
pub fn not_read(unread: &Unread) -> String {
    let why = match unread.reason {
        Reason::Unknown => "not known here",
        Reason::Ignored => "left out by request; these modes lack what they say",
        Reason::WithoutPart => "nothing of stiffness, mass, supports or coordinates",
        Reason::NotSelected => "of a set that case control does not select",
    };
    format!("Not read: {}, {why}.", unread.place())
}

/// Modes scaled for a reader.
pub(in crate::present) struct UnitShapes {
    pub frequencies_hz: Vec<f64>,
    /// Generalized masses.
    pub masses: Vec<f64>,
    /// By mode, then by DOF.
    pub shapes: Vec<Vec<f64>>,
}

impl UnitShapes {
    pub fn new(modes: &WholeModes, count: usize) -> Self {
        let mut frequencies_hz = modes.modes.frequencies_hz();
        frequencies_hz.truncate(count);
        // Shapes come with unit generalized mass and a positive largest component.
        let unit = |shape: nalgebra::DVectorView<f64>| {
            let largest = shape.amax();
            (largest.powi(-2), shape.iter().map(|component| component / largest).collect())
        };
        let (masses, shapes) = modes.modes.shapes.column_iter().take(count).map(unit).unzip();
        Self { frequencies_hz, masses, shapes }
    }
}
