//! Whole torque boxes against the stored stiffness and eigenvalues of NASTRAN-95: the paper's outer loop.

use crate::common::nastran95::{StoredBox, StoredBoxes};
use crate::prelude::*;
use corfem::method::modes;

fn sizes(structure: &Structure) -> Vec<f64> {
    structure
        .elements()
        .iter()
        .map(|element| element.size)
        .collect()
}

/// Element matrices of a box.
fn own_matrices(structure: &Structure) -> Vec<ElementMatrix> {
    element_matrices(structure).collect()
}

/// The same, those of panels that NASTRAN-95 snaps with its factor on them.
fn as_nastran(structure: &Structure, stored: &StoredBox) -> Vec<ElementMatrix> {
    let mut matrices = own_matrices(structure);
    let elements = structure.elements().iter().zip(structure.corners());
    for ((element, corners), matrix) in elements.zip(&mut matrices) {
        if stored.snapped.contains(&element.label) {
            matrix.unit *= snap_factor(corners, &element.material);
        }
    }
    matrices
}

/// Eigenvalues with mass on z of the twelve free grids alone: the crate's own condensation, T selecting those DOF.
fn eigenvalues(matrices: &[ElementMatrix], structure: &Structure, mass: f64) -> Vec<f64> {
    let stiffness = assemble(matrices, &sizes(structure), 36).unwrap();
    let select = DMatrix::from_fn(36, 12, |row, column| f64::from(row == 3 * column + 2));
    let condensed = condense(&stiffness, &select).unwrap();
    let mass = mass * eye(12);
    let modes = modes::solve(&condensed.stiffness, &mass, 12).unwrap();
    modes.omega_squared().iter().copied().collect()
}

fn by_name<'a>(all: &'a StoredBoxes, name: &str) -> &'a StoredBox {
    all.boxes.iter().find(|stored| stored.name == name).unwrap()
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    found
        .iter()
        .zip(expected)
        .map(|(f, e)| relative_error(f, e))
        .largest()
}

#[test]
fn boxes_without_snapped_panels_equal_nastran95() {
    let all = boxes();
    let plain = all
        .boxes
        .iter()
        .filter(|stored| stored.snapped.is_empty())
        .collect_vec();
    assert_eq!((all.boxes.len(), plain.len()), (16, 10));
    for stored in plain {
        let structure = all.structure(stored);
        let matrices = own_matrices(&structure);
        let ours = assemble(&matrices, &sizes(&structure), 36).unwrap();
        let distance = relative_distance(&ours, &stored.stored());
        assert!(
            distance <= NASTRAN_SINGLE_PRECISION,
            "{}: {distance:e}",
            stored.name
        );
    }
}

#[test]
fn snapped_boxes_equal_nastran95_with_its_closed_form_in_their_place() {
    let all = boxes();
    let snapped = all
        .boxes
        .iter()
        .filter(|stored| !stored.snapped.is_empty())
        .collect_vec();
    assert_eq!(snapped.len(), 6);
    for stored in snapped {
        let structure = all.structure(stored);
        let sizes = sizes(&structure);
        let true_one = assemble(&own_matrices(&structure), &sizes, 36).unwrap();
        let theirs = assemble(&as_nastran(&structure, stored), &sizes, 36).unwrap();
        let distance = relative_distance(&theirs, &stored.stored());
        assert!(
            distance <= NASTRAN_SINGLE_PRECISION,
            "{}: {distance:e}",
            stored.name
        );
        let unexplained = relative_distance(&true_one, &stored.stored());
        assert!(
            unexplained > 2.0 * distance,
            "{}: {unexplained:e} {distance:e}",
            stored.name
        );
    }
}

#[test]
fn eigenvalues_of_boxes_equal_nastran95() {
    let all = boxes();
    let mut compared = 0;
    for stored in &all.boxes {
        let Some(expected) = &stored.eigenvalues else {
            continue;
        };
        let structure = all.structure(stored);
        let found = eigenvalues(&as_nastran(&structure, stored), &structure, all.mass);
        let distance = worst(&found, expected);
        assert!(
            distance <= NASTRAN_EIGENVALUE,
            "{}: {distance:e}",
            stored.name
        );
        compared += 1;
    }
    assert_eq!(compared, 10);
}

/// What snapping does to the paper's box, as `golden/nastran95/README.md` has it.
#[test]
fn snapping_moves_an_eigenvalue_by_six_parts_in_ten_thousand_at_most() {
    let all = boxes();
    let moved = |name: &str| {
        let stored = by_name(&all, name);
        let structure = all.structure(stored);
        let found = eigenvalues(&own_matrices(&structure), &structure, all.mass);
        worst(&found, stored.eigenvalues.as_ref().unwrap())
    };
    let most = |names: &[&str]| names.iter().map(|name| moved(name)).largest();
    let shear_covers = most(&["case 1 gvt", "case 1 initial"]);
    assert_eq!(format!("{shear_covers:.1e}"), "5.9e-4");
    let membrane_covers = most(&[
        "case 2 gvt",
        "case 2 initial",
        "case 3 initial",
        "case 4 initial",
    ]);
    assert_eq!(format!("{membrane_covers:.0e}"), "4e-7");
}

#[test]
fn the_round_box_has_the_eigenvalues_another_installation_printed() {
    let all = boxes();
    let stored = by_name(&all, "round");
    let structure = all.structure(stored);
    let found = eigenvalues(&own_matrices(&structure), &structure, all.mass);
    for printed in [&stored.known_eigenvalues, &stored.printed_eigenvalues] {
        let printed = printed.as_ref().unwrap();
        assert_eq!(printed.len(), 6);
        let distance = worst(&found[..6], printed);
        assert!(distance <= NASTRAN_PRINTED_EIGENVALUE, "{distance:e}");
    }
}

/// The boxes of the cases, built by the crate from Table 2 and the reconstruction, are the stored ones: elements,
/// corners, kinds, gages and areas.
#[test]
fn the_cases_are_the_stored_boxes() {
    let all = boxes();
    let assemble =
        |structure: &Structure| assemble(&own_matrices(structure), &sizes(structure), 36).unwrap();
    for number in 1..=4 {
        let case = case_of(number);
        let test = case.model_with(&[TEST_GAGE; PANEL_COUNT]).unwrap();
        let gvt = format!("case {} gvt", number.min(2));
        for (name, model) in [
            (format!("case {number} initial"), case.model().unwrap()),
            (gvt, test),
        ] {
            let stored = by_name(&all, &name);
            let distance = relative_distance(
                &assemble(model.structure()),
                &assemble(&all.structure(stored)),
            );
            assert!(distance <= ROUND_OFF, "{name}: {distance:e}");
        }
    }
}
