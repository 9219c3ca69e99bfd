//! The delta wing of NACA TN 3114 (MacNeal and Benscoter), tested in NACA TN 3913 (Zender), NASTRAN's demonstration
//! problem D01-01-1. Upper grids by number, the same less ten in the mid-plane; x outboard, y forward:
//!
//! ```text
//!  y 80   91--92----93
//!                      \   (triangles behind the leading edge)
//!  y 60   71--72----73----74
//!                            \
//!  y 40   51--52----53----54----55
//!                                  \
//!  y 20   31--32----33----34----35----36
//!                                      |
//!  y 0    11--12----13----14----15----16
//!      x  0   10    30    50    70    90
//! ```

use crate::prelude::*;

const DATA: &str = include_str!("../../../paper/delta_wing.toml");

fn wing() -> DeltaWing {
    DeltaWing::embedded()
}

fn structure() -> Structure {
    wing().structure().unwrap()
}

fn element(label: usize) -> Element {
    let structure = structure();
    let mut elements = structure.elements().iter();
    elements.find(|e| e.label == label).unwrap().clone()
}

#[test]
fn wing_is_counted_and_numbered_as_in_the_demonstration() {
    let structure = structure();
    let labels = structure
        .grids()
        .iter()
        .map(|grid| grid.label)
        .collect_vec();
    let expected = [
        1..=6,
        11..=16,
        21..=26,
        31..=36,
        41..=45,
        51..=55,
        61..=64,
        71..=74,
        81..=83,
        91..=93,
    ]
    .into_iter()
    .flatten()
    .collect_vec();
    assert_eq!(labels, expected);
    assert_eq!(labels.len(), 48);
    let of = |kind: ElementKind| -> Vec<usize> {
        let elements = structure.elements().iter();
        elements
            .filter(|e| e.kind == kind)
            .map(|e| e.label)
            .collect()
    };
    assert_eq!(of(ElementKind::Triangle), [10, 14, 17]);
    let membranes = (1..=16)
        .filter(|label| ![10, 14].contains(label))
        .collect_vec();
    assert_eq!(of(ElementKind::Membrane), membranes);
    assert_eq!(membranes.len(), 14);
    assert_eq!(of(ElementKind::ShearPanel), (18..=53).collect_vec());
    assert_eq!(
        of(ElementKind::Rod),
        (60..=83).chain(100..=135).collect_vec()
    );
    assert_eq!(of(ElementKind::Rod).len(), 60);
    assert_eq!(structure.free_dof().len(), 86);
}

#[test]
fn grids_lie_behind_the_leading_edge_at_half_the_depth() {
    let structure = structure();
    let grid = |label: usize| {
        let mut grids = structure.grids().iter();
        grids.find(|grid| grid.label == label).unwrap()
    };
    for (label, [x, y, z]) in [
        (1, [0.0, 0.0, 0.0]),
        (16, [90.0, 0.0, 0.67]),
        (36, [90.0, 20.0, 0.67]),
        (35, [70.0, 20.0, 1.42]),
        (45, [70.0, 40.0, 0.0]),
        (53, [30.0, 40.0, 2.42]),
        (74, [50.0, 60.0, 0.795]),
        (92, [10.0, 80.0, 0.82]),
    ] {
        assert_eq!(grid(label).position, Vector3::new(x, y, z), "grid {label}");
    }
    for grid in structure.grids() {
        let [x, y, z] = grid.position.into();
        assert!(x + y <= 110.0);
        let expected = match grid.label {
            11 | 31 | 51 | 71 | 91 => [true, false, false],
            13 | 33 | 53 | 73 | 93 => [false, false, true],
            _ if z == 0.0 => [true, true, false],
            _ => [false; 3],
        };
        assert_eq!(grid.constrained, expected, "grid {}", grid.label);
    }
}

#[test]
fn elements_join_the_grids_of_the_demonstration() {
    for (label, grids, size) in [
        (1, vec![11, 12, 32, 31], 0.16),
        (5, vec![15, 16, 36, 35], 0.16),
        (10, vec![35, 36, 55], 0.16),
        (13, vec![53, 54, 74, 73], 0.16),
        (17, vec![73, 74, 93], 0.16),
        (18, vec![1, 2, 12, 11], 0.14),
        (22, vec![5, 6, 16, 15], 0.14),
        (36, vec![82, 83, 93, 92], 0.14),
        (37, vec![2, 22, 32, 12], 0.14),
        (44, vec![63, 83, 93, 73], 0.14),
        (50, vec![6, 26, 36, 16], 0.14),
        (51, vec![26, 45, 55, 36], 0.14),
        (53, vec![64, 83, 93, 74], 0.14),
        (60, vec![1, 11], 2.1),
        (68, vec![23, 33], 5.6),
        (83, vec![83, 93], 4.2),
        (100, vec![11, 12], 0.035),
        (113, vec![54, 55], 0.0563),
        (118, vec![92, 93], 0.035),
        (119, vec![12, 32], 0.063),
        (128, vec![34, 54], 0.0805),
        (132, vec![16, 36], 0.028),
        (133, vec![93, 74], 0.0344),
        (135, vec![55, 36], 0.03),
    ] {
        let element = element(label);
        assert_eq!(
            (element.grids, element.size),
            (grids, size),
            "element {label}"
        );
    }
}

#[test]
fn covers_fill_the_planform() {
    // Chord 80 in inboard of x = 30 in, then a trapezoid to the 20 in of the tip at x = 90 in.
    let expected = 30.0 * 80.0 + 60.0 * (80.0 + 20.0) / 2.0;
    let structure = structure();
    let mut area = 0.0;
    let elements = structure.elements().iter().zip(structure.corners());
    for (_, corners) in elements.filter(|(element, _)| element.label <= 17) {
        let flat = corners.iter().map(|corner| corner.xy()).collect_vec();
        for n in 0..flat.len() {
            area += 0.5 * flat[n].perp(&flat[(n + 1) % flat.len()]);
        }
    }
    assert_relative_eq!(area, expected, max_relative = ROUND_OFF);
}

#[test]
fn data_say_what_the_wing_is_made_of() {
    let other = DATA
        .replace("cover_gage = 0.16", "cover_gage = 0.2")
        .replace("web_gage = 0.14", "web_gage = 0.1")
        .replace("youngs_modulus = 1.04e7", "youngs_modulus = 2.0e7")
        .replace("poissons_ratio = 0.3", "poissons_ratio = 0.25");
    let other = toml::from_str::<DeltaWing>(&other).unwrap();
    for element in other.structure().unwrap().elements() {
        match element.kind {
            ElementKind::Membrane | ElementKind::Triangle => assert_eq!(element.size, 0.2),
            ElementKind::ShearPanel => assert_eq!(element.size, 0.1),
            ElementKind::Rod => {}
        }
        let density = if element.kind == ElementKind::Rod {
            0.0
        } else {
            2.523e-4
        };
        let material = element.material;
        assert_eq!(
            (
                material.youngs_modulus,
                material.poissons_ratio,
                material.shear_modulus,
                material.density
            ),
            (2.0e7, 0.25, 8.0e6, density)
        );
    }
}
