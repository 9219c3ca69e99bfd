//! The structure: its numbering, and every way a description can be wrong.

use crate::prelude::*;

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

/// Words of the refusal of a square with one change.
fn refusal(change: impl Fn(&mut Vec<Grid>, &mut Vec<Element>)) -> String {
    let (mut grids, mut elements) = square();
    change(&mut grids, &mut elements);
    said(Structure::new(grids, elements))
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
    let structure = Structure::new(grids, elements).unwrap();
    let corners = structure.corners();
    assert_eq!(corners.len(), 3);
    assert_eq!(corners[0], [Vector3::zeros(), Vector3::new(1.0, 1.0, 0.0)]);
    let membrane: Vec<[f64; 3]> = corners[2].iter().map(|c| (*c).into()).collect();
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
fn what_refers_wrongly_is_refused_by_name() {
    type Change = fn(&mut Vec<Grid>, &mut Vec<Element>);
    let table: [(Change, &str); 5] = [
        (
            |_, elements| elements.clear(),
            "elements: 0 given or asked for; there must be at least 1",
        ),
        (
            |grids, _| grids[3].label = 3,
            "structure: grid 3 is given twice",
        ),
        (
            |_, elements| elements[2].label = 9,
            "structure: element 9 is given twice",
        ),
        (
            |_, elements| elements[1].grids[2] = 8,
            "element 4: there is no grid 8",
        ),
        (
            |_, elements| elements[2].grids.truncate(3),
            "corners of an element: 3 given or asked for; there must be 4 to 4",
        ),
    ];
    for (change, words) in table {
        assert_eq!(refusal(change), words);
    }
}

#[test]
fn a_coordinate_that_is_not_finite_is_refused_by_its_grid() {
    for value in [f64::NAN, f64::INFINITY] {
        assert_eq!(
            refusal(|grids, _| grids[2].position.y = value),
            format!("coordinate of grid 5 is {value}; it must be finite")
        );
    }
}

#[test]
fn a_gage_or_area_that_is_not_positive_is_refused_by_its_element() {
    for (row, label) in [(0, 9), (1, 4), (2, 6)] {
        for value in [0.0, -0.01, f64::NAN, f64::INFINITY] {
            assert_eq!(
                refusal(|_, elements| elements[row].size = value),
                format!(
                    "gage or area of element {label} is {value}; it must be positive and finite"
                )
            );
        }
    }
}

#[test]
fn a_material_that_cannot_be_is_refused_by_its_element() {
    type Change = fn(&mut Material);
    let table: [(Change, &str); 6] = [
        (
            |material| material.youngs_modulus = f64::NAN,
            "Young's modulus of element 4 is NaN; it must be positive and finite",
        ),
        (
            |material| material.shear_modulus = -4e6,
            "shear modulus of element 4 is -4000000; it must be positive and finite",
        ),
        (
            |material| material.density = -0.5,
            "density of element 4 is -0.5; it must be positive and finite",
        ),
        (
            |material| material.density = f64::INFINITY,
            "density of element 4 is inf; it must be positive and finite",
        ),
        (
            |material| material.poissons_ratio = 0.6,
            "Poisson's ratio of element 4 is 0.6; it must be more than -1 and at most 0.5",
        ),
        (|material| material.density = 0.0, "an answer"),
    ];
    for (change, words) in table {
        let (grids, mut elements) = square();
        change(&mut elements[1].material);
        assert_eq!(said(Structure::new(grids, elements)), words);
    }
}

#[test]
fn an_isotropic_material_needs_a_positive_modulus_and_a_stable_poissons_ratio() {
    for value in [0.0, -1e7, f64::NAN, f64::INFINITY] {
        assert_eq!(
            said(Material::isotropic(value, 0.3)),
            format!("Young's modulus of the material is {value}; it must be positive and finite")
        );
    }
    for value in [-1.0, -2.0, 0.5 + 1e-12, f64::NAN] {
        assert_eq!(
            said(Material::isotropic(1e7, value)),
            format!(
                "Poisson's ratio of the material is {value}; it must be more than -1 and at most 0.5"
            )
        );
    }
    assert!(Material::isotropic(1e7, 0.5).is_ok());
    assert!(Material::isotropic(1e7, -0.999).is_ok());
}

properties! {
    /// E, G and ν of an isotropic material are two numbers: E = 2G(1 + ν).
    #[test]
    fn an_isotropic_materials_moduli_fit(modulus in 1e5..1e8_f64, nu in -0.9..0.5_f64) {
        let material = Material::isotropic(modulus, nu)?;
        prop_assert_eq!((material.youngs_modulus, material.poissons_ratio), (modulus, nu));
        let found = 2.0 * material.shear_modulus * (1.0 + nu);
        prop_assert!(relative_error(found, modulus) <= ROUND_OFF);
    }
}
