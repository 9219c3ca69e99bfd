//! Every element kind against the stored stiffness of NASTRAN-95, the last release of the paper's own program.
//!
//! Two things are NASTRAN's and not the theory's (`golden/nastran95/README.md`): it takes the sides of a shear panel for
//! parallel when they nearly are, and its general closed form loses digits in slender panels.

use crate::common::nastran95::elements;
use crate::prelude::*;

#[test]
fn every_stored_element_is_one_of_a_known_kind() {
    let elements = elements();
    for (kind, count) in [("rod", 5), ("shear", 19), ("membrane", 16), ("triangle", 5)] {
        let found = elements
            .iter()
            .filter(|element| element.kind == kind)
            .count();
        assert_eq!(found, count, "{kind}");
    }
}

#[test]
fn elements_equal_nastran95() {
    for element in elements().iter().filter(|element| !element.snap) {
        let bar = element.tolerance.unwrap_or(NASTRAN_SINGLE_PRECISION);
        let distance = relative_distance(&element.computed(), &element.stored());
        assert!(distance <= bar, "{}: {distance:e}", element.name);
    }
}

#[test]
fn only_the_slender_taper_needs_a_bar_of_its_own() {
    let elements = elements();
    let own = elements
        .iter()
        .filter(|element| element.tolerance.is_some())
        .collect_vec();
    assert_eq!(own.len(), 1);
    assert_eq!(
        (own[0].name.as_str(), own[0].tolerance),
        ("shear_slender_taper_from_1", Some(1e-6))
    );
    let distance = relative_distance(&own[0].computed(), &own[0].stored());
    assert!(
        distance > NASTRAN_SINGLE_PRECISION,
        "an exception without need: {distance:e}"
    );
}

/// A snapped panel has the true panel's pattern of forces and another energy: one factor on the whole matrix, that of
/// the parallel closed form.
#[test]
fn a_snapped_panel_differs_by_the_factor_of_its_closed_form_alone() {
    let elements = elements();
    let snapped = elements.iter().filter(|element| element.snap).collect_vec();
    assert_eq!(snapped.len(), 2);
    for (element, published) in snapped.iter().zip(["1.001", "0.982"]) {
        let (ours, theirs) = (element.computed(), element.stored());
        let distance = relative_distance(&ours, &theirs);
        assert!(
            distance > 1e3 * NASTRAN_SINGLE_PRECISION,
            "{}: does not differ: {distance:e}",
            element.name
        );
        let factor = ours.dot(&theirs) / ours.norm_squared();
        assert_eq!(format!("{factor:.3}"), published, "{}", element.name);
        let rest = relative_distance(&(factor * &ours), &theirs);
        assert!(
            rest <= NASTRAN_SINGLE_PRECISION,
            "{}: {rest:e}",
            element.name
        );
        let explained = snap_factor(&element.corners(), &element.material());
        assert!(
            relative_error(explained, factor) <= NASTRAN_SINGLE_PRECISION,
            "{}: {explained} {factor}",
            element.name
        );
    }
}
