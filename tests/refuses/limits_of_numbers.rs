//! What would leave the range of numbers is refused, and named.

use crate::common::structures::{chain_model, rod};
use crate::prelude::*;
use deck::modes;

/// A rod along x, held at one end.
fn rod_of(length: f64, area: f64, material: Material) -> Structure {
    let ends = vec![
        grid(1, [0.0; 3], [true; 3]),
        grid(2, [length, 0.0, 0.0], [false, true, true]),
    ];
    let element = Element {
        material,
        ..rod(7, [1, 2], area)
    };
    Structure::new(ends, vec![element]).unwrap()
}

/// What is too large is refused, and what is large is not.
#[test]
fn what_would_be_too_large_for_a_number_is_refused() {
    let stiff = |length: f64| {
        let structure = rod_of(length, 1.0, Material::isotropic(1e308, 0.25).unwrap());
        let parameters = vec![Parameter::new(7, &[7])];
        let model = FiniteElementModel::new(structure, eye(1), eye(1), parameters);
        said(model.and_then(|model| model.condense(&[1.0])))
    };
    let heavy = |density: f64| {
        let material = Material {
            density,
            ..Material::isotropic(1.0, 0.25).unwrap()
        };
        said(modes(
            &BulkData::from_structure(&rod_of(1.0, 10.0, material)),
            1,
        ))
    };
    // Its size is two.
    let model = chain_model(vec![Parameter::new("some", &[1])]).unwrap();
    let suspended = |size: f64| {
        let raw = Modes::new(dvector![2.0], dmatrix![1.0; -0.9]).unwrap();
        let stiffness = size * dmatrix![1.0, -1.0; -1.0, 1.0];
        said(balance(&raw, &stiffness, &eye(2), &dmatrix![1e10; 1e10]))
    };
    let problem = SensorModel::from(&chain_problem(&Chain::uniform(2), &[1.2, 0.8]));
    let weighted = |frequency: f64| {
        let weight = ModeWeight {
            frequency,
            ..ModeWeight::ONE
        };
        said(problem.clone().weighted(&[weight; 2]))
    };
    // Nothing couples back, so that the roots stay what they are; the second order adds two parts of 10³⁰⁸ for the shape of the first mode.
    let beta = dmatrix![0.0, 0.0, 0.0; 1e307, 0.0, -1e307; 2.0, 0.0, 0.0];
    let pencil = Pencil::of_vibrations(&dvector![0.1, 1.0, 2.0], &beta, &zero_square(3)).unwrap();
    for (large, found, words) in [
        (
            stiff(1.0),
            stiff(0.1),
            "structural stiffness of entry (0, 0) is inf; it must be a finite number",
        ),
        (
            heavy(1.0),
            heavy(1e308),
            "mass of entry (0, 0) is inf; it must be a finite number",
        ),
        (
            said(model.sizes(&[f64::MAX / 2.0])),
            said(model.sizes(&[f64::MAX])),
            "scaled size of parameter some is inf; it must be positive and finite",
        ),
        (
            suspended(1.0),
            suspended(1e308),
            "rigid-body stiffness of entry (0, 0) is NaN; it must be a finite number",
        ),
        (
            weighted(1e100),
            weighted(1e200),
            "error sum of these modes is inf; it must be a finite number",
        ),
        (
            said(pencil.recursive_1(1)),
            said(pencil.recursive_1(2)),
            "perturbed generalized shapes of entry (1, 0) is -inf; it must be a finite number",
        ),
    ] {
        assert_eq!((&large[..], &found[..]), ("an answer", words));
    }
}
