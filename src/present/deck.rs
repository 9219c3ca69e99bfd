//! The modes of a deck as tables.

use crate::files::deck::{Reason, Unread};
use crate::files::test_data::row_name;
use crate::job::concerns::OPEN;
use crate::job::of_bodies;
use crate::present::table::{Digits, Table, counted, numbers};
use crate::sparse::BodyFinding;
use crate::sparse::whole_modes::WholeModes;

const FREQUENCY: Digits = Digits::Significant(7);
const MASS: Digits = Digits::Significant(6);
const SHAPE: Digits = Digits::Fixed(5);

/// Frequencies and shapes of the lowest `count` modes, every shape scaled to a largest component of one.
///
/// Generalized mass, $v^t M v$, is that of the shape so scaled, in the model's own unit.
pub fn deck_tables(unread: &[Unread], modes: &WholeModes, count: usize) -> Vec<Table> {
    let (masses, shapes) = unit_shapes(modes, count);
    let rows = modes.modes.shapes.nrows();
    let dof = counted(rows, "degree", "degrees");
    let title = format!("Natural frequencies at {dof} of freedom with mass");
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
        .notes(unread.iter().map(not_read))
        .notes(open)
        .notes(rigid)
        .notes(
            modes
                .doubtful
                .iter()
                .map(|finding| of_bodies(finding).words),
        );
    // Matrices that do not name their rows have numbers for them.
    let labels = (0..rows).map(|row| row_name(row, &modes.dof));
    let table = Table::new("shapes", "Shapes, largest component one", "Grid").labels(labels);
    let shapes = (1..).zip(shapes).fold(table, |table, (mode, shape)| {
        table.column(format!("Mode {mode}"), "", numbers(shape, SHAPE))
    });
    vec![frequencies, shapes]
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
pub(super) fn unit_shapes(modes: &WholeModes, count: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
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
