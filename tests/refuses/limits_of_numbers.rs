//! What would leave the range of numbers is refused, and named.

use crate::common::loops::chain_problem;
use crate::common::structures::{chain_model, grid, group, rod};
use crate::common::vibrations::Chain;
use corfem::method::appendix_b::balance;
use corfem::method::appendix_c::general::{ModalChange, recursive_1};
use corfem::method::error::Error;
use corfem::method::error_sum::ModeWeight;
use corfem::method::model::{FiniteElementModel, Parameter};
use corfem::method::modes::ModeSet;
use corfem::method::structure::{Element, Material, Structure};
use nalgebra::{DMatrix, dmatrix, dvector};

/// A rod along x, held at one end.
fn rod_of(length: f64, area: f64, material: Material) -> Result<FiniteElementModel, Error> {
    let ends = vec![
        grid(1, [0.0; 3], [true; 3]),
        grid(2, [length, 0.0, 0.0], [false, true, true]),
    ];
    let element = Element {
        material,
        ..rod(7, [1, 2], area)
    };
    let one = DMatrix::identity(1, 1);
    let parameters = vec![Parameter::element(7, None)];
    FiniteElementModel::new(
        Structure::new(ends, vec![element])?,
        one.clone(),
        one,
        parameters,
    )
}

#[test]
fn an_element_too_stiff_for_a_number_is_named() {
    let stiff = Material::isotropic(1e308, 0.25).expect("a material");
    assert!(rod_of(1.0, 1.0, stiff).is_ok());
    let Err(Error::InElement { element: 7, source }) = rod_of(0.1, 1.0, stiff) else {
        panic!("its stiffness is finite");
    };
    assert!(matches!(
        *source,
        Error::NotFinite {
            what: "element stiffness",
            ..
        }
    ));
}

#[test]
fn a_mass_too_large_for_a_number_is_refused() {
    let material = Material::isotropic(1.0, 0.25).expect("a material");
    let heavy = material.with_density(1e308).expect("a density");
    let refused = rod_of(1.0, 10.0, heavy).and_then(|model| model.matrices(&[1.0]).map(drop));
    assert!(
        matches!(
            refused,
            Err(Error::NotFinite {
                what: "dynamic mass",
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn a_factor_that_takes_a_size_beyond_the_largest_number_is_refused() {
    // The size is two.
    let model = chain_model(vec![group("some", &[1], None)]).expect("a model");
    assert!(model.at(&[f64::MAX / 2.0]).is_ok());
    let refused = model.at(&[f64::MAX]);
    assert!(
        matches!(
            refused,
            Err(Error::NotFinite {
                what: "scaled sizes or masses",
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn a_suspension_too_stiff_for_a_number_is_refused() {
    let raw = ModeSet::new(dvector![2.0], dmatrix![1.0; -0.9]).expect("a mode");
    let balanced = |size: f64| {
        let stiffness = size * dmatrix![1.0, -1.0; -1.0, 1.0];
        let both = dmatrix![1e10; 1e10];
        balance(&raw, &stiffness, &DMatrix::identity(2, 2), &both)
    };
    assert!(balanced(1.0).is_ok());
    let refused = balanced(1e308);
    assert!(
        matches!(
            refused,
            Err(Error::NotFinite {
                what: "rigid-body stiffness",
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn a_weight_whose_square_is_no_number_is_refused() {
    let problem = chain_problem(&Chain::uniform(2), &[1.2, 0.8]);
    let weighted = |frequency: f64| {
        let weight = ModeWeight {
            frequency,
            ..ModeWeight::ONE
        };
        problem.clone().weighted(&[weight; 2]).map(drop)
    };
    assert!(weighted(1e100).is_ok());
    let refused = weighted(1e200);
    assert!(
        matches!(refused, Err(Error::NotFinite { .. })),
        "{refused:?}"
    );
}

/// Nothing couples back, so that the roots stay what they are; the second order adds two parts of 10³⁰⁸ for the shape of the first mode.
#[test]
fn shapes_that_leave_the_range_of_numbers_at_a_later_order_are_refused() {
    let beta = dmatrix![0.0, 0.0, 0.0; 1e307, 0.0, -1e307; 2.0, 0.0, 0.0];
    let change = ModalChange::of_vibrations(&dvector![0.1, 1.0, 2.0], beta, DMatrix::zeros(3, 3));
    assert!(recursive_1(&change, 1).is_ok());
    let refused = recursive_1(&change, 2);
    assert!(
        matches!(
            refused,
            Err(Error::NotFinite {
                what: "perturbed generalized shapes",
                row: 1,
                column: 0,
                ..
            })
        ),
        "{refused:?}"
    );
}
