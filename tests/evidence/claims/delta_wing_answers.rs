//! What the delta wing does under load and in vibration, beside what NASTRAN printed, what was measured, and what an analog
//! computer gave: an experiment nobody here can tune.

use crate::common::delta_wing::{
    LOADS, MEASURED_GRIDS, deck as wing, deflections, known_deflections, known_frequencies,
};
use crate::prelude::*;

#[test]
fn deflections_are_those_nastran_printed_in_1995() {
    let known = known_deflections();
    let labels = MEASURED_GRIDS.iter().map(usize::to_string).collect_vec();
    assert_eq!(known.labels, labels);
    assert_eq!(known.number, 0, "it is not of the paper");
    for (load, grid) in LOADS {
        for (label, z) in labels.iter().zip(deflections(grid)) {
            let printed = known.required(label, &format!("{load}_1995_in")).unwrap();
            assert_relative_eq!(z, printed, max_relative = PRINTED_SEVEN_DIGITS);
        }
    }
}

#[test]
fn deflections_are_near_the_measured_ones() {
    let known = known_deflections();
    // Nothing is fitted: the largest differences, in, are what the model and its reading from figures leave.
    for (who, expected) in [("experiment", "0.0338 0.0197"), ("analog", "0.0395 0.0097")] {
        let largest = LOADS.map(|(load, grid)| {
            let pairs = known.labels.iter().zip(deflections(grid));
            let off = pairs
                .map(|(label, z)| z - known.required(label, &format!("{load}_{who}_in")).unwrap());
            off.map(f64::abs).largest()
        });
        assert_eq!(format!("{:.4} {:.4}", largest[0], largest[1]), expected);
    }
    assert!(known.value("55", "te_analog_in") == Some(-0.144));
}

#[test]
fn lowest_eigenvalues_are_those_nastran_printed_in_1995() {
    let known = known_frequencies();
    assert_eq!(known.labels, ["1", "2", "3"]);
    let found = deck::modes(&wing(), usize::MAX).unwrap();
    assert_eq!((found.dof.len(), found.modes.len()), (86, 86));
    for (mode, label) in known.labels.iter().enumerate() {
        let (square, hz) = (
            found.modes.omega_squared()[mode],
            found.modes.frequencies_hz()[mode],
        );
        // The analog computer's is a coarser model of finite differences.
        for (own, heading, allowed) in [
            (square, "eigenvalue_1995", PRINTED_SEVEN_DIGITS),
            (hz, "frequency_1995_hz", PRINTED_SEVEN_DIGITS),
            (hz, "analog_hz", ANALOG_FREQUENCY),
        ] {
            let printed = known.required(label, heading).unwrap();
            assert_relative_eq!(own, printed, max_relative = allowed);
        }
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
        let lines = text.lines();
        let cards = lines.filter(|line| line.split_whitespace().next() == Some(card));
        assert_eq!(cards.count(), count, "{card}");
    }
    let read = deck::read("wing", text.as_bytes(), &[]).unwrap();
    assert_eq!(read.model, model);
    assert!(read.unread.is_empty());
}
