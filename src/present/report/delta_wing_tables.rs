//! The delta wing as tables: its answers beside others', and what a correlation finds of its gages.

use super::correlation_tables::{PERCENT, column};
use super::delta_wing_correlation::correlation_tables;
use super::table::{Cell, Column, Digits, Row, Table};
use crate::cases::published::PublishedTable;
use crate::present::error::PresentError;
use crate::studies::delta_wing::correlation::WingCorrelation;
use crate::studies::delta_wing::{
    DeltaWing, MEASURED_GRIDS, TipLoad, known_deflections, known_frequencies,
};

/// NASTRAN printed seven digits.
const PRINTED: Digits = Digits::Significant(7);
/// Measured and analog deflections are in hundredths or thousandths of an inch.
const READ: Digits = Digits::Fixed(3);
/// Of differences in the seventh digit.
const SMALL_PERCENT: Digits = Digits::Fixed(5);

/// All tables: deflections under both loads, frequencies, and the correlation's groups, frequencies and passes.
///
/// # Errors
/// Those of the wing's analyses; [`Error::Table`] if what others found were damaged.
pub fn delta_wing_tables(
    wing: &DeltaWing,
    run: &WingCorrelation,
) -> Result<Vec<Table>, PresentError> {
    let mut tables = vec![
        deflection_table(wing, TipLoad::TrailingEdge)?,
        deflection_table(wing, TipLoad::LeadingEdge)?,
        frequency_table(wing)?,
    ];
    tables.extend(correlation_tables(run));
    Ok(tables)
}

/// Somebody else's numbers beside ours.
struct Other {
    title: &'static str,
    heading: String,
    digits: Digits,
    difference: Digits,
}

fn other(title: &'static str, heading: String, digits: Digits, difference: Digits) -> Other {
    Other {
        title,
        heading,
        digits,
        difference,
    }
}

/// A table of computed numbers, each with what others have for it and the percent difference from that.
fn beside_others(
    known: &PublishedTable,
    rows: Vec<(String, f64)>,
    unit: &'static str,
    others: &[Other],
) -> Result<(Vec<Column>, Vec<Row>), PresentError> {
    let mut columns = vec![column("Computed", unit)];
    for other in others {
        columns.push(column(other.title, unit));
        columns.push(column(&format!("{} difference", other.title), "%"));
    }
    let rows = rows
        .into_iter()
        .map(|(label, computed)| {
            let mut cells = vec![plain(computed, PRINTED)];
            for other in others {
                let theirs = known.required(&label, &other.heading)?;
                cells.push(plain(theirs, other.digits));
                let percent = 100.0 * (computed / theirs - 1.0);
                cells.push(plain(percent, other.difference));
            }
            Ok(Row { label, cells })
        })
        .collect::<Result<_, PresentError>>()?;
    Ok((columns, rows))
}

fn deflection_table(wing: &DeltaWing, load: TipLoad) -> Result<Table, PresentError> {
    let (short, long) = match load {
        TipLoad::TrailingEdge => ("te", "trailing edge"),
        TipLoad::LeadingEdge => ("le", "leading edge"),
    };
    let mut others = vec![
        other(
            "NASTRAN 1995",
            format!("{short}_1995_in"),
            PRINTED,
            SMALL_PERCENT,
        ),
        other("Measured", format!("{short}_experiment_in"), READ, PERCENT),
    ];
    if load == TipLoad::TrailingEdge {
        others.push(other("Analog", format!("{short}_analog_in"), READ, PERCENT));
    }
    let rows = MEASURED_GRIDS.iter().zip(wing.deflections(load)?);
    let rows = rows.map(|(grid, z)| (grid.to_string(), z)).collect();
    let (columns, rows) = beside_others(&known_deflections()?, rows, "in", &others)?;
    Ok(Table {
        name: format!("delta_wing_deflections_{short}"),
        title: format!(
            "Delta wing: deflections under {} lbf down at the tip's {long}, grid {}",
            wing.tip_load,
            load.grid()
        ),
        label_heading: "Grid",
        columns,
        rows,
        notes: Vec::new(),
    })
}

fn frequency_table(wing: &DeltaWing) -> Result<Table, PresentError> {
    let known = known_frequencies()?;
    let others = [
        other(
            "NASTRAN 1995",
            "frequency_1995_hz".into(),
            PRINTED,
            SMALL_PERCENT,
        ),
        other(
            "Analog",
            "analog_hz".into(),
            Digits::Significant(3),
            PERCENT,
        ),
    ];
    let rows = known
        .labels
        .iter()
        .cloned()
        .zip(wing.modes()?.modes.frequencies_hz());
    let (columns, rows) = beside_others(&known, rows.collect(), "Hz", &others)?;
    Ok(Table {
        name: "delta_wing_frequencies".to_owned(),
        title: "Delta wing: natural frequencies".to_owned(),
        label_heading: "Mode",
        columns,
        rows,
        notes: Vec::new(),
    })
}

/// A number by itself: what others have for it stands in columns of its own.
pub(super) fn plain(computed: f64, digits: Digits) -> Cell {
    Cell::Number {
        computed,
        published: None,
        digits,
    }
}
