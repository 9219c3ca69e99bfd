//! The delta wing as tables: its answers beside others', and what a correlation finds of its gages.

use super::{PERCENT, RMS_PERCENT};
use crate::prelude::*;
use corfem::present::report::Step;

/// NASTRAN printed seven digits.
const PRINTED: Digits = Digits::Significant(7);
/// Measured and analog deflections are in hundredths or thousandths of an inch.
const READ: Digits = Digits::Fixed(3);
/// Of differences in the seventh digit.
const SMALL_PERCENT: Digits = Digits::Fixed(5);
const FACTOR: Digits = Digits::Fixed(4);

/// All tables: deflections under both loads, frequencies, and the correlation's groups, frequencies and passes.
///
/// # Errors
/// Those of the wing's analyses; [`PresentError::Case`] if what others found were damaged.
pub fn delta_wing_tables(
    wing: &DeltaWing,
    run: &WingCorrelation,
) -> Result<Vec<Table>, PresentError> {
    let first = ExactResult::from(&run.correlation.initial);
    let last = ExactResult::from(run.correlation.best_check());
    let mass = first_model(wing)?.matrices(&[1.0; GROUPS.len()])?.mass;
    let compared = Compared {
        test: &run.test,
        numbers: TEST_MODES.to_vec(),
        first: &first,
        last: &last,
        mass: Some(&mass),
    };
    let passes = (1..).zip(&run.correlation.passes).map(|(step, pass)| Step {
        step,
        iterations: Some(pass.inner.iterations.len()),
        ..Step::default()
    });
    Ok(vec![
        deflection_table(wing, TipLoad::TrailingEdge)?,
        deflection_table(wing, TipLoad::LeadingEdge)?,
        frequency_table(wing)?,
        group_table(run),
        Table::of("delta_wing_modes", "Modes", &compared.modes()?, &[]),
        Table::of("delta_wing_errors", "Errors", &compared.errors(&[]), &[]),
        Table::of("delta_wing_passes", "Passes", &passes.collect_vec(), &[]),
    ])
}

/// Somebody else's numbers: who, their heading in the table of known ones, digits of them and of the difference.
type Other = (&'static str, String, Digits, Digits);

/// Computed numbers, each with what others have for it and the percent difference from that.
fn beside_others(
    table: Table,
    known: &PublishedTable,
    unit: &'static str,
    (labels, computed): (&[String], &[f64]),
    others: &[Other],
) -> Result<Table, PresentError> {
    let mut table =
        table
            .labels(labels)
            .column("Computed", unit, numbers(computed.iter().copied(), PRINTED));
    for (who, heading, digits, difference) in others {
        let theirs = labels
            .iter()
            .map(|label| known.required(label, heading))
            .collect::<Result<Vec<_>, _>>()?;
        let differences = computed
            .iter()
            .zip(&theirs)
            .map(|(computed, theirs)| computed / theirs - 1.0);
        let differences = percents(differences, *difference);
        table = table.column(*who, unit, numbers(theirs.iter().copied(), *digits));
        table = table.column(format!("{who} difference"), "%", differences);
    }
    Ok(table)
}

fn deflection_table(wing: &DeltaWing, load: TipLoad) -> Result<Table, PresentError> {
    let (short, long) = match load {
        TipLoad::TrailingEdge => ("te", "trailing edge"),
        TipLoad::LeadingEdge => ("le", "leading edge"),
    };
    let others = [
        (
            "NASTRAN 1995",
            format!("{short}_1995_in"),
            PRINTED,
            SMALL_PERCENT,
        ),
        ("Measured", format!("{short}_experiment_in"), READ, PERCENT),
        ("Analog", format!("{short}_analog_in"), READ, PERCENT),
    ];
    let title = format!(
        "Delta wing: deflections under {} lbf down at the tip's {long}, grid {}",
        wing.tip_load,
        load.grid()
    );
    let table = Table::new(format!("delta_wing_deflections_{short}"), title, "Grid");
    let grids = MEASURED_GRIDS.map(|grid| grid.to_string());
    beside_others(
        table,
        &known_deflections()?,
        "in",
        (&grids, &wing.deflections(load)?),
        &others,
    )
}

fn frequency_table(wing: &DeltaWing) -> Result<Table, PresentError> {
    let known = known_frequencies()?;
    let others: [Other; 2] = [
        (
            "NASTRAN 1995",
            "frequency_1995_hz".to_owned(),
            PRINTED,
            SMALL_PERCENT,
        ),
        (
            "Analog",
            "analog_hz".to_owned(),
            Digits::Significant(3),
            PERCENT,
        ),
    ];
    let table = Table::new(
        "delta_wing_frequencies",
        "Delta wing: natural frequencies",
        "Mode",
    );
    beside_others(
        table,
        &known,
        "Hz",
        (&known.labels, &wing.modes()?.modes.frequencies_hz()),
        &others,
    )
}

fn group_table(run: &WingCorrelation) -> Table {
    let title = "Delta wing with wrong gages: factors that the correlation finds";
    let note = "Coordinates in inches, x outboard from the center and y forward from the trailing edge. Largest share: of the \
        stiffness of any test mode.";
    let found = &run.correlation.best_factors;
    let first_errors = GROUPS.map(|group| group.first_over_true - 1.0);
    let errors = GROUPS
        .iter()
        .zip(found)
        .map(|(group, factor)| factor / group.true_factor() - 1.0);
    Table::new("delta_wing_groups", title, "Group")
        .labels(GROUPS.map(|group| group.name))
        .column("First gage error", "%", percents(first_errors, PERCENT))
        .column(
            "True factor",
            "",
            numbers(GROUPS.iter().map(Group::true_factor), FACTOR),
        )
        .column("Found", "", numbers(found.iter().copied(), FACTOR))
        .column("Last gage error", "%", percents(errors, RMS_PERCENT))
        .column(
            "Largest share",
            "%",
            percents(run.shares.iter().copied(), RMS_PERCENT),
        )
        .notes([note])
}
