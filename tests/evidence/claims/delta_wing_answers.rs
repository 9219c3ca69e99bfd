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
    let elements = wing().structure().unwrap().elements().len();
    assert_eq!(elements, 60 + 36 + 14 + 3);
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

/// Modes 8 and 9, the closest of the lowest twelve, are left out of the test: the wrong gages exchange them.
#[test]
fn modes_left_out_are_close_and_exchanged_by_the_wrong_gages() {
    let whole = deck::modes(&wing(), usize::MAX).unwrap();
    let hertz = whole.modes.frequencies_hz();
    let separation = |mode: usize| hertz[mode] / hertz[mode - 1] - 1.0;
    assert_eq!(format!("{:.4}", separation(8)), "0.0160");
    assert!((1..12).all(|mode| mode == 8 || separation(mode) > 0.06));
    let model = first_model();
    let right = GROUPS.iter().map(|group| 1.0 / group.first_over_true);
    let [first, right] = [vec![1.0; GROUPS.len()], right.collect_vec()]
        .map(|factors| model.matrices(&factors).unwrap());
    let modes = solve(&first.stiffness, &first.mass, 19).unwrap();
    let truth = solve(&right.stiffness, &right.mass, 12).unwrap();
    let cross = cross_orthogonality(&modes, &truth, &first.mass).unwrap();
    let mut expected = (0..12).collect_vec();
    expected.swap(7, 8);
    assert_eq!(pair_modes(&cross).unwrap().analysis_mode, expected);
}
