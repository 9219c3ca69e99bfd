//! What the delta wing does under load and in vibration, beside what NASTRAN printed, what was measured, and what an analog
//! computer gave: an experiment nobody here can tune.

use crate::prelude::*;

fn wing() -> DeltaWing {
    DeltaWing::embedded()
}

#[test]
fn deflections_are_those_nastran_printed_in_1995() {
    let known = known_deflections().unwrap();
    let labels = MEASURED_GRIDS.iter().map(usize::to_string).collect_vec();
    assert_eq!(known.labels, labels);
    assert_eq!(known.number, 0, "it is not of the paper");
    for (load, heading) in [
        (TipLoad::TrailingEdge, "te_1995_in"),
        (TipLoad::LeadingEdge, "le_1995_in"),
    ] {
        let found = wing().deflections(load).unwrap();
        assert_eq!(found.len(), 9);
        for (label, z) in labels.iter().zip(found) {
            let printed = known.required(label, heading).unwrap();
            assert_relative_eq!(z, printed, max_relative = PRINTED_SEVEN_DIGITS);
        }
    }
}

#[test]
fn deflections_are_near_the_measured_ones() {
    let known = known_deflections().unwrap();
    let differences = |load, heading: &str| -> Vec<f64> {
        let found = wing().deflections(load).unwrap();
        let pairs = MEASURED_GRIDS.iter().zip(found);
        pairs
            .map(|(grid, z)| z - known.required(&grid.to_string(), heading).unwrap())
            .collect()
    };
    let largest = |differences: &[f64]| differences.iter().fold(0.0_f64, |w, d| w.max(d.abs()));
    // Nothing is fitted: the largest differences, in, are what the model and its reading from figures leave.
    let trailing = differences(TipLoad::TrailingEdge, "te_experiment_in");
    let leading = differences(TipLoad::LeadingEdge, "le_experiment_in");
    assert_eq!(
        format!("{:.4} {:.4}", largest(&trailing), largest(&leading)),
        "0.0338 0.0197"
    );
    let trailing = differences(TipLoad::TrailingEdge, "te_analog_in");
    let leading = differences(TipLoad::LeadingEdge, "le_analog_in");
    assert_eq!(
        format!("{:.4} {:.4}", largest(&trailing), largest(&leading)),
        "0.0395 0.0097"
    );
    assert!(known.value("55", "te_analog_in") == Some(-0.144));
}

#[test]
fn lowest_eigenvalues_are_those_nastran_printed_in_1995() {
    let known = known_frequencies().unwrap();
    assert_eq!(known.labels, ["1", "2", "3"]);
    let found = wing().modes().unwrap();
    assert_eq!((found.dof.len(), found.modes.len()), (86, 86));
    for (mode, label) in known.labels.iter().enumerate() {
        let printed = |heading: &str| known.required(label, heading).unwrap();
        assert_relative_eq!(
            found.modes.omega_squared()[mode],
            printed("eigenvalue_1995"),
            max_relative = PRINTED_SEVEN_DIGITS
        );
        assert_relative_eq!(
            found.modes.frequencies_hz()[mode],
            printed("frequency_1995_hz"),
            max_relative = PRINTED_SEVEN_DIGITS
        );
        // The analog computer, a coarser model of finite differences.
        assert_relative_eq!(
            found.modes.frequencies_hz()[mode],
            printed("analog_hz"),
            max_relative = ANALOG_FREQUENCY
        );
    }
}

#[test]
fn wing_to_deck_to_wing_is_the_identity() {
    let model = BulkData::from_structure(&wing().structure().unwrap());
    let text = bulk_text(&model).unwrap();
    for (card, count) in [
        ("GRID*", 48),
        ("CROD", 60),
        ("CSHEAR", 36),
        ("CQDMEM", 14),
        ("CTRMEM", 3),
        ("PTRMEM", 3),
        ("MAT1", 2),
    ] {
        let cards = text
            .lines()
            .filter(|line| line.split_whitespace().next() == Some(card));
        assert_eq!(cards.count(), count, "{card}");
    }
    let read = deck::read("wing", text.as_bytes(), &[]).unwrap();
    assert_eq!(read.model, model);
    assert!(read.unread.is_empty());
    assert_eq!(
        deck::modes(&read.model, usize::MAX).unwrap(),
        wing().modes().unwrap()
    );
}
