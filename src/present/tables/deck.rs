//! The modes of a deck as tables.

use crate::files::deck::{Reason, Unread};
use crate::files::test_data::row_name;
use crate::job::concerns::OPEN;
use crate::job::of_bodies;
use crate::present::table::{Cell, Digits, Table, counted, numbers};
use crate::sparse::rigid_bodies::BodyFinding;
use crate::sparse::whole_modes::WholeModes;

/// Modes side by side in one table of shapes: as many as a line of text has room for.
const MODES_PER_TABLE: usize = 9;
const FREQUENCY: Digits = Digits::Significant(7);
const MASS: Digits = Digits::Significant(6);
const SHAPE: Digits = Digits::Fixed(5);

/// Frequencies and shapes of the lowest `count` modes, every shape scaled to a largest component of one, after a table of the cards
/// that were left out by request.
///
/// Generalized mass, $v^t M v$, is that of the shape so scaled, in the model's own unit.
pub fn deck_tables(unread: &[Unread], modes: &WholeModes, count: usize) -> Vec<Table> {
    let (masses, shapes) = unit_shapes(modes, count);
    let rows = modes.modes.shapes.nrows();
    let dof = counted(rows, "degree", "degrees");
    let title = format!("Natural frequencies at {dof} of freedom with mass");
    let (left_out, others): (Vec<&Unread>, Vec<&Unread>) = unread
        .iter()
        .partition(|unread| unread.reason == Reason::Ignored);
    let rigid = counted(
        modes.rigid_body,
        "rigid-body mode is",
        "rigid-body modes are",
    );
    let by_digits = |finding: &BodyFinding| matches!(finding, BodyFinding::ByDigits { .. });
    let is_free = modes.rigid_body > 0 && !modes.doubtful.iter().any(by_digits);
    let rigid = is_free.then(|| format!("The structure hangs free: {rigid} not listed."));
    let open = (1..=count).zip(&modes.open).filter(|own| *own.1 > OPEN);
    let open = open.map(|(mode, part)| {
        let percent = Digits::Significant(2).write(100.0 * part);
        format!(
            "The digits of the matrices leave the frequency of mode {mode} open by {percent} %."
        )
    });
    let frequencies = Table::new("frequencies", title, "Mode")
        .labels(1..=masses.len())
        .column(
            "Frequency",
            "Hz",
            numbers(modes.modes.frequencies_hz(), FREQUENCY),
        )
        .column("Generalized mass", "", numbers(masses, MASS))
        .notes(others.into_iter().map(not_read))
        .notes(open)
        .notes(rigid)
        .notes(
            modes
                .doubtful
                .iter()
                .map(|finding| of_bodies(finding).words),
        );
    let counts = |of: fn(&Unread) -> usize| {
        let counts = left_out.iter().map(move |unread| Cell::count(of(unread)));
        counts.collect::<Vec<_>>()
    };
    let ignored = Table::new(
        "ignored",
        "Cards left out by request: these modes lack what they say",
        "Card",
    )
    .labels(left_out.iter().map(|unread| &unread.card))
    .column("Cards", "", counts(|unread| unread.count))
    .column("First line", "", counts(|unread| unread.line));
    let mut tables = if left_out.is_empty() {
        vec![frequencies]
    } else {
        vec![ignored, frequencies]
    };
    // Matrices that do not name their rows have numbers for them.
    let label = |row| row_name(row, &modes.dof);
    let labels = || (0..rows).map(label);
    for (part, shapes) in shapes.chunks(MODES_PER_TABLE).enumerate() {
        let (first, last) = (
            MODES_PER_TABLE * part + 1,
            MODES_PER_TABLE * part + shapes.len(),
        );
        let title = format!("Shapes of modes {first} to {last}, largest component one");
        let mut table =
            Table::new(format!("shapes_{first}_to_{last}"), title, "Grid").labels(labels());
        for (mode, shape) in (first..).zip(shapes) {
            table = table.column(
                format!("Mode {mode}"),
                "",
                numbers(shape.iter().copied(), SHAPE),
            );
        }
        tables.push(table);
    }
    tables
}

/// One sentence about cards that were not read.
pub fn not_read(unread: &Unread) -> String {
    let why = match unread.reason {
        Reason::Unknown | Reason::Elsewhere | Reason::Lacking => "not known here",
        Reason::Ignored => "left out by request; these modes lack what they say",
        Reason::WithoutPart => "nothing of stiffness, mass, supports or coordinates",
        Reason::NotSelected => "of a set that the first subcase does not select",
        Reason::Torsion => "torsion of rods: grids have no rotations here",
        Reason::Untouched => "grids that no element, mass or equation touches; they are held",
    };
    format!("Not read: {}, {why}.", unread.place())
}

/// Generalized masses and shapes (by mode, then by DOF) of the lowest modes, of a largest component of one.
pub(in crate::present) fn unit_shapes(
    modes: &WholeModes,
    count: usize,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    // Shapes come with unit generalized mass and a positive largest component.
    let unit = |shape: nalgebra::DVectorView<f64>| {
        let largest = shape.amax();
        (
            largest.powi(-2),
            shape.iter().map(|component| component / largest).collect(),
        )
    };
    modes
        .modes
        .shapes
        .column_iter()
        .take(count)
        .map(unit)
        .unzip()
}
