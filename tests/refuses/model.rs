//! What cannot be a model, a parameter or a factor: each refusal names who is at fault.

use crate::common::structures::{chain_model as chain, group, spring_chain, unit_material};
use corfem::method::error::Error;
use corfem::method::model::{Bounds, FiniteElementModel, Parameter};
use corfem::method::structure::{Element, ElementKind, Structure};
use corfem::torque_box::Case;
use corfem::torque_box::error::CaseError;
use nalgebra::DMatrix;

fn with_mass(t: DMatrix<f64>, mass: DMatrix<f64>) -> Result<FiniteElementModel, Error> {
    let structure = spring_chain(&[2.0, 4.0, 8.0], [true, false]);
    FiniteElementModel::new(structure, t, mass, vec![Parameter::element(1, None)])
}

#[test]
fn bounds_that_no_factor_or_not_the_start_satisfies_are_refused_by_their_parameter() {
    let refused = |elements: &[usize], lower: f64, upper: f64| {
        let model = chain(vec![group("some", elements, Some(Bounds { lower, upper }))]).unwrap();
        match model.factor_ranges() {
            Err(Error::Limits { what, lower, upper }) => (what, lower, upper, "crossed"),
            Err(Error::StartOutside { what, lower, upper }) => (what, lower, upper, "start"),
            other => panic!("expected limits that cannot be met, found {other:?}"),
        }
    };
    let what = || "factor of parameter some".to_owned();
    assert_eq!(
        refused(&[1, 3], 3.0, 8.0),
        (what(), 1.5, 1.0, "crossed"),
        "2 must grow, 8 must not"
    );
    assert_eq!(
        refused(&[1], 3.0, 4.0),
        (what(), 1.5, 2.0, "start"),
        "the start is below"
    );
    assert_eq!(
        refused(&[1], 0.5, 1.0),
        (what(), 0.25, 0.5, "start"),
        "the start is above"
    );
    assert_eq!(
        refused(&[1], 0.0, 4.0),
        (what(), 0.0, 2.0, "crossed"),
        "a bound of zero"
    );
    let error = chain(vec![group(
        "some",
        &[1],
        Some(Bounds {
            lower: 3.0,
            upper: 4.0,
        }),
    )])
    .unwrap()
    .factor_ranges();
    let said = error.unwrap_err().to_string();
    assert_eq!(
        said,
        "factor of parameter some: bounds 1.5 to 2 exclude the starting factor 1"
    );
}

#[test]
fn parameters_that_cannot_be_are_refused_by_name() {
    assert!(matches!(
        chain(vec![]),
        Err(Error::Empty { what: "parameters" })
    ));
    let nothing = chain(vec![Parameter::element(1, None), group("none", &[], None)]);
    assert!(
        matches!(
            nothing,
            Err(Error::Empty {
                what: "members of a parameter"
            })
        ),
        "{nothing:?}"
    );
    let refused = chain(vec![group("wing", &[1, 4], None)]).unwrap_err();
    assert!(
        matches!(&refused, Error::Unknown { owner, what: "element", label: 4 } if owner == "parameter wing"),
        "{refused:?}"
    );
    assert_eq!(refused.to_string(), "parameter wing: there is no element 4");
    let shared = chain(vec![
        group("wing", &[1, 2], None),
        group("tail", &[3, 2], None),
    ])
    .unwrap_err();
    assert!(
        matches!(&shared, Error::SharedElement { element: 2, first, second } if first == "wing" && second == "tail"),
        "{shared:?}"
    );
    let twice = chain(vec![group("wing", &[1, 1], None)]).unwrap_err();
    assert!(
        matches!(&twice, Error::SharedElement { element: 1, first, second } if first == "wing" && second == "wing"),
        "{twice:?}"
    );
}

#[test]
fn factors_that_cannot_be_are_refused_by_their_parameter() {
    let model = chain(vec![
        group("wing", &[1, 2], None),
        Parameter::element(3, None),
    ])
    .unwrap();
    for factors in [vec![1.0], vec![1.0; 3]] {
        let refused = model.at(&factors).unwrap_err();
        assert!(
            matches!(refused, Error::WrongShape {
                what: "parameter factors", expected_rows: 2, expected_columns: 1, rows, columns: 1
            } if rows == factors.len()),
            "{refused:?}"
        );
    }
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (factors, name) in [
            ([value, 1.0], "parameter wing"),
            ([1.0, value], "parameter 3"),
        ] {
            let refused = model.matrices(&factors).unwrap_err();
            assert!(
                matches!(&refused, Error::NotPositive { what: "factor", owner, .. } if owner == name),
                "{refused:?}"
            );
        }
    }
}

#[test]
fn a_mass_that_is_not_positive_is_refused_by_its_dof() {
    for value in [0.0, -0.5] {
        for dof in 0..3 {
            let mut mass = DMatrix::identity(3, 3);
            mass[(dof, dof)] = value;
            let refused = with_mass(DMatrix::identity(3, 3), mass).unwrap_err();
            assert!(
                matches!(refused, Error::NotPositiveDefinite { what: "dynamic mass", dof: found } if found == dof),
                "{refused:?}"
            );
        }
    }
    let mut data = Case::new(1).unwrap().reconstruction;
    data.masses[4] = f64::NAN;
    let refused = Case::from_reconstruction(1, data)
        .unwrap()
        .model()
        .unwrap_err();
    assert!(
        matches!(
            refused,
            CaseError::Method(Error::NotFinite {
                what: "dynamic mass",
                row: 4,
                column: 4,
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn matrices_that_do_not_fit_are_refused_by_name() {
    let identity = || DMatrix::identity(3, 3);
    let refused = with_mass(DMatrix::zeros(2, 3), identity()).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::WrongShape {
                what: "load distribution",
                expected_rows: 3,
                expected_columns: 3,
                rows: 2,
                columns: 3
            }
        ),
        "{refused:?}"
    );
    let refused = with_mass(identity(), DMatrix::identity(2, 2)).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::WrongShape {
                what: "dynamic mass",
                expected_rows: 3,
                expected_columns: 3,
                rows: 2,
                columns: 2
            }
        ),
        "{refused:?}"
    );
    let mut t = identity();
    t[(2, 1)] = f64::NAN;
    let refused = with_mass(t, identity()).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::NotFinite {
                what: "load distribution",
                row: 2,
                column: 1,
                ..
            }
        ),
        "{refused:?}"
    );
    let mut mass = identity();
    mass[(2, 1)] = 0.5;
    let refused = with_mass(identity(), mass).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::NotSymmetric {
                what: "dynamic mass",
                row: 2,
                column: 1,
                ..
            }
        ),
        "{refused:?}"
    );
    let nothing = with_mass(DMatrix::zeros(3, 0), DMatrix::zeros(0, 0)).unwrap_err();
    assert!(
        matches!(
            nothing,
            Error::Empty {
                what: "dynamic degrees of freedom"
            }
        ),
        "{nothing:?}"
    );
}

#[test]
fn what_is_wrong_with_an_element_or_the_structure_comes_through() {
    let grids = spring_chain(&[1.0], [true, false]).grids().to_vec();
    let looped = Element {
        label: 5,
        kind: ElementKind::Rod,
        grids: vec![2, 2],
        size: 1.0,
        material: unit_material(),
    };
    let one = DMatrix::identity(1, 1);
    let refused = Structure::new(grids, vec![looped]);
    let Err(Error::InElement { element: 5, source }) = refused else {
        panic!("{refused:?}")
    };
    assert!(matches!(*source, Error::ZeroLength(0.0)), "{source:?}");
    let free = spring_chain(&[1.0], [false, false]);
    let t = DMatrix::identity(2, 1);
    let refused = FiniteElementModel::new(free, t, one, vec![Parameter::element(1, None)])
        .unwrap()
        .matrices(&[1.0]);
    assert!(
        matches!(
            refused,
            Err(Error::SingularStiffness { direction: 'x', .. })
        ),
        "{refused:?}"
    );
}
