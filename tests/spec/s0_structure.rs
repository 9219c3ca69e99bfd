//! The structure: its numbering, and every way a description can be wrong.

use crate::common::tolerances::ROUND_OFF;
use corfem::method::error::Error;
use corfem::method::structure::{
    DIRECTIONS, Element, ElementKind, Grid, Material, StructuralDof, Structure,
};
use nalgebra::Vector3;
use proptest::prelude::*;

fn aluminum() -> Material {
    Material::isotropic(1e7, 0.3).unwrap()
}

fn grid(label: usize, position: [f64; 3], constrained: [bool; 3]) -> Grid {
    Grid {
        label,
        position: position.into(),
        constrained,
    }
}

fn element(label: usize, kind: ElementKind, grids: &[usize]) -> Element {
    Element {
        label,
        kind,
        grids: grids.to_vec(),
        size: 0.5,
        material: aluminum(),
    }
}

/// A square of four grids out of numerical order, its base constrained in part, with one element of each kind.
fn square() -> (Vec<Grid>, Vec<Element>) {
    (
        vec![
            grid(7, [0.0, 0.0, 0.0], [true, true, true]),
            grid(3, [1.0, 0.0, 0.0], [false, true, false]),
            grid(5, [1.0, 1.0, 0.0], [false; 3]),
            grid(2, [0.0, 1.0, 0.0], [true, false, true]),
        ],
        vec![
            element(9, ElementKind::Rod, &[7, 5]),
            element(4, ElementKind::ShearPanel, &[7, 3, 5, 2]),
            element(6, ElementKind::Membrane, &[2, 5, 3, 7]),
        ],
    )
}

fn refusal(change: impl Fn(&mut Vec<Grid>, &mut Vec<Element>)) -> Error {
    let (mut grids, mut elements) = square();
    change(&mut grids, &mut elements);
    Structure::new(grids, elements).expect_err("a structure that must be refused")
}

#[test]
fn free_dof_run_grid_by_grid_as_given_x_before_y_before_z() {
    let (grids, elements) = square();
    let structure = Structure::new(grids.clone(), elements.clone()).unwrap();
    let expected = [(3, 0), (3, 2), (5, 0), (5, 1), (5, 2), (2, 1)]
        .map(|(grid, direction)| StructuralDof { grid, direction });
    assert_eq!(structure.free_dof(), expected);
    for (row, dof) in expected.iter().enumerate() {
        assert_eq!(structure.free_dof_index(dof.grid, dof.direction), Some(row));
    }
    for (grid, direction) in [
        (7, 0),
        (7, 1),
        (7, 2),
        (3, 1),
        (2, 0),
        (2, 2),
        (5, 3),
        (8, 0),
    ] {
        assert_eq!(
            structure.free_dof_index(grid, direction),
            None,
            "{grid} {direction}"
        );
    }
    assert_eq!(structure.grids(), grids);
    assert_eq!(structure.elements(), elements);
    assert_eq!(DIRECTIONS, ['x', 'y', 'z']);
}

#[test]
fn corners_are_the_positions_of_an_elements_grids_in_its_order() {
    let (grids, elements) = square();
    let structure = Structure::new(grids, elements.clone()).unwrap();
    assert_eq!(
        structure.corners(&elements[0]),
        [Vector3::zeros(), Vector3::new(1.0, 1.0, 0.0)]
    );
    let membrane: Vec<[f64; 3]> = structure
        .corners(&elements[2])
        .iter()
        .map(|c| (*c).into())
        .collect();
    assert_eq!(
        membrane,
        [
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0]
        ]
    );
}

#[test]
fn kinds_know_their_corners() {
    let kinds = [
        ElementKind::Rod,
        ElementKind::Triangle,
        ElementKind::ShearPanel,
        ElementKind::Membrane,
    ];
    assert_eq!(kinds.map(ElementKind::corner_count), [2, 3, 4, 4]);
}

#[test]
fn a_structure_without_elements_is_refused() {
    assert!(matches!(
        refusal(|_, elements| elements.clear()),
        Error::Empty { what: "elements" }
    ));
}

#[test]
fn repeated_numbers_are_refused_by_name() {
    let refused = refusal(|grids, _| grids[3].label = 3);
    assert!(
        matches!(
            refused,
            Error::Duplicate {
                what: "grid",
                label: 3
            }
        ),
        "{refused:?}"
    );
    let refused = refusal(|_, elements| elements[2].label = 9);
    assert!(
        matches!(
            refused,
            Error::Duplicate {
                what: "element",
                label: 9
            }
        ),
        "{refused:?}"
    );
}

#[test]
fn an_unknown_grid_is_refused_with_the_element_that_asks_for_it() {
    let refused = refusal(|_, elements| elements[1].grids[2] = 8);
    assert!(
        matches!(&refused, Error::Unknown { owner, what: "grid", label: 8 } if owner == "element 4"),
        "{refused:?}"
    );
    assert_eq!(refused.to_string(), "element 4: there is no grid 8");
}

#[test]
fn the_wrong_number_of_grids_is_refused_within_its_element() {
    let refused = refusal(|_, elements| elements[2].grids.truncate(3));
    let Error::InElement { element: 6, source } = refused else {
        panic!("{refused:?}")
    };
    assert!(
        matches!(
            *source,
            Error::WrongCornerCount {
                expected: 4,
                found: 3
            }
        ),
        "{source:?}"
    );
}

#[test]
fn a_coordinate_that_is_not_finite_is_refused_by_its_place() {
    for value in [f64::NAN, f64::INFINITY] {
        let refused = refusal(|grids, _| grids[2].position.y = value);
        assert!(
            matches!(
                refused,
                Error::NotFinite {
                    what: "grid coordinates",
                    row: 2,
                    column: 1,
                    ..
                }
            ),
            "{refused:?}"
        );
    }
}

#[test]
fn a_gage_or_area_that_is_not_positive_is_refused_by_its_element() {
    for (row, what, owner) in [
        (0, "area", "element 9"),
        (1, "gage", "element 4"),
        (2, "gage", "element 6"),
    ] {
        for value in [0.0, -0.01, f64::NAN, f64::INFINITY] {
            let refused = refusal(|_, elements| elements[row].size = value);
            let named = matches!(&refused, Error::NotPositive { what: w, owner: o, value: v }
                if *w == what && o == owner && v.to_bits() == value.to_bits());
            assert!(named, "{refused:?}");
        }
    }
    assert_eq!(
        refusal(|_, elements| elements[0].size = -0.5).to_string(),
        "area of element 9 is -0.5; it must be positive and finite"
    );
}

#[test]
fn a_material_that_cannot_be_is_refused_by_its_element() {
    let with = |change: fn(&mut Material)| {
        let refused = refusal(|_, elements| change(&mut elements[1].material));
        assert!(
            matches!(refused, Error::InElement { element: 4, .. }),
            "{refused:?}"
        );
        refused.to_string()
    };
    let message =
        "element 4: Young's modulus of the material is NaN; it must be positive and finite";
    assert_eq!(with(|material| material.youngs_modulus = f64::NAN), message);
    let message =
        "element 4: shear modulus of the material is -4000000; it must be positive and finite";
    assert_eq!(with(|material| material.shear_modulus = -4e6), message);
    let message = "element 4: density of the material is -0.5; it must be positive and finite";
    assert_eq!(with(|material| material.density = -0.5), message);
    let message = "element 4: Poisson's ratio is 0.6; it must be more than -1 and at most 0.5";
    assert_eq!(with(|material| material.poissons_ratio = 0.6), message);
}

#[test]
fn an_isotropic_material_needs_a_positive_modulus_and_a_stable_poissons_ratio() {
    for value in [0.0, -1e7, f64::NAN, f64::INFINITY] {
        let refused = Material::isotropic(value, 0.3);
        assert!(
            matches!(&refused, Err(Error::NotPositive { what: "Young's modulus", owner, .. }) if owner == "the material"),
            "{refused:?}"
        );
    }
    for value in [-1.0, -2.0, 0.5 + 1e-12, f64::NAN] {
        let refused = Material::isotropic(1e7, value);
        let Err(Error::Setting {
            name: "Poisson's ratio",
            found,
            ..
        }) = refused
        else {
            panic!("{refused:?}")
        };
        assert_eq!(found.to_bits(), value.to_bits());
    }
    assert!(Material::isotropic(1e7, 0.5).is_ok());
    assert!(Material::isotropic(1e7, -0.999).is_ok());
}

properties! {
    #![proptest_config(crate::common::config())]

    /// E, G and ν of an isotropic material are two numbers: E = 2G(1 + ν).
    #[test]
    fn an_isotropic_materials_moduli_fit(modulus in 1e5..1e8_f64, nu in -0.9..0.5_f64) {
        let material = Material::isotropic(modulus, nu).unwrap();
        prop_assert_eq!((material.youngs_modulus, material.poissons_ratio), (modulus, nu));
        let found = 2.0 * material.shear_modulus * (1.0 + nu);
        prop_assert!((found / modulus - 1.0).abs() <= ROUND_OFF);
    }
}

/// (A.3): a dynamic DOF moves by the weighted motion of its rows, and loads them by the same weights.
#[test]
fn a_load_distribution_takes_every_row_and_refuses_what_does_not_move() {
    let (grids, elements) = square();
    let structure = Structure::new(grids, elements).unwrap();
    let points = [
        vec![(3, 'x', 0.25), (5, 'y', -2.0)],
        vec![(2, 'y', 0.5), (2, 'y', 0.75)],
    ];
    let t = structure.load_distribution(&points).unwrap();
    // Free are 3x, 3z, 5x, 5y, 5z and 2y.
    let expected =
        nalgebra::dmatrix![0.25, 0.0; 0.0, 0.0; 0.0, 0.0; -2.0, 0.0; 0.0, 0.0; 0.0, 1.25];
    assert_eq!(t, expected);
    for (grid, direction) in [(3, 'y'), (7, 'x'), (4, 'z'), (5, 'w')] {
        let refused =
            structure.load_distribution(&[vec![(5, 'x', 1.0)], vec![(grid, direction, 1.0)]]);
        let said = refused.expect_err("no such motion").to_string();
        assert_eq!(
            said,
            format!("dynamic DOF 1, direction {direction}: there is no free grid {grid}")
        );
    }
}

/// The rows of the paper's box, read off its T, make it again.
#[test]
fn rows_of_the_torque_box_make_its_load_distribution() {
    let model = corfem::torque_box::Case::new(1)
        .and_then(|case| case.model())
        .unwrap();
    let (structure, t) = (model.structure(), model.load_distribution());
    let row =
        |(dof, weight): (&StructuralDof, &f64)| (dof.grid, DIRECTIONS[dof.direction], *weight);
    let rows = |column: usize| {
        let column = t.column(column);
        let rows = structure.free_dof().iter().zip(column.iter()).map(row);
        rows.filter(|(_, _, weight)| *weight != 0.0)
            .collect::<Vec<_>>()
    };
    let points: Vec<_> = (0..t.ncols()).map(rows).collect();
    assert_eq!(structure.load_distribution(&points).unwrap(), *t);
}
