//! What would leave the range of numbers is refused, and named.

use crate::common::structures::{chain_model, rod};
use crate::prelude::*;
use deck::modes;

/// A rod along x, held at one end.
fn rod_of(length: f64, area: f64, material: Material) -> Result<Structure, Error> {
    let ends = vec![
        grid(1, [0.0; 3], [true; 3]),
        grid(2, [length, 0.0, 0.0], [false, true, true]),
    ];
    let element = Element {
        material,
        ..rod(7, [1, 2], area)
    };
    Structure::new(ends, vec![element])
}

#[test]
fn an_element_too_stiff_for_a_number_is_refused() {
    let stiff = Material::isotropic(1e308, 0.25).unwrap();
    let model = |length: f64| {
        let (one, parameters) = (eye(1), vec![Parameter::new(7, &[7])]);
        let model =
            FiniteElementModel::new(rod_of(length, 1.0, stiff)?, one.clone(), one, parameters);
        model?.condense(&[1.0])
    };
    assert!(model(1.0).is_ok());
    assert_eq!(
        said(model(0.1)),
        "structural stiffness of entry (0, 0) is inf; it must be a finite number"
    );
}

#[test]
fn a_mass_too_large_for_a_number_is_refused() {
    let of_density = |density: f64| {
        let material = Material {
            density,
            ..Material::isotropic(1.0, 0.25).unwrap()
        };
        let structure = rod_of(1.0, 10.0, material).unwrap();
        modes(&BulkData::from_structure(&structure), 1)
    };
    assert!(of_density(1.0).is_ok());
    assert_eq!(
        said(of_density(1e308)),
        "mass of entry (0, 0) is inf; it must be a finite number"
    );
}

#[test]
fn a_factor_that_takes_a_size_beyond_the_largest_number_is_refused() {
    // The size is two.
    let model = chain_model(vec![Parameter::new("some", &[1])]).unwrap();
    assert!(model.sizes(&[f64::MAX / 2.0]).is_ok());
    assert_eq!(
        said(model.sizes(&[f64::MAX])),
        "scaled size of parameter some is inf; it must be positive and finite"
    );
}

#[test]
fn a_suspension_too_stiff_for_a_number_is_refused() {
    let raw = Modes::new(dvector![2.0], dmatrix![1.0; -0.9]).unwrap();
    let balanced = |size: f64| {
        let stiffness = size * dmatrix![1.0, -1.0; -1.0, 1.0];
        let both = dmatrix![1e10; 1e10];
        balance(&raw, &stiffness, &eye(2), &both)
    };
    assert!(balanced(1.0).is_ok());
    assert_eq!(
        said(balanced(1e308)),
        "rigid-body stiffness of entry (0, 0) is NaN; it must be a finite number"
    );
}

#[test]
fn a_weight_whose_square_is_no_number_is_refused() {
    let problem = SensorModel::from(&chain_problem(&Chain::uniform(2), &[1.2, 0.8]));
    let weighted = |frequency: f64| {
        let weight = ModeWeight {
            frequency,
            ..ModeWeight::ONE
        };
        problem.clone().weighted(&[weight; 2])
    };
    assert!(weighted(1e100).is_ok());
    assert_eq!(
        said(weighted(1e200)),
        "error sum of these modes is inf; it must be a finite number"
    );
}

/// Nothing couples back, so that the roots stay what they are; the second order adds two parts of 10³⁰⁸ for the shape of the first mode.
#[test]
fn shapes_that_leave_the_range_of_numbers_at_a_later_order_are_refused() {
    let beta = dmatrix![0.0, 0.0, 0.0; 1e307, 0.0, -1e307; 2.0, 0.0, 0.0];
    let pencil = Pencil::of_vibrations(&dvector![0.1, 1.0, 2.0], &beta, &zero_square(3));
    let pencil = pencil.unwrap();
    assert!(pencil.recursive_1(1).is_ok());
    assert_eq!(
        said(pencil.recursive_1(2)),
        "perturbed generalized shapes of entry (1, 0) is -inf; it must be a finite number"
    );
}
