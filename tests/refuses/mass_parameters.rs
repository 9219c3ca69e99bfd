//! Mass parameters that cannot be are refused.

use crate::prelude::*;

/// Two unit masses on two springs with these shares.
fn whole(shares: &[ParameterMatrix]) -> Result<(WholeModel, SparseMatrix), Error> {
    let stiffness = spring_stiffness(2, 0, 1.0) + spring_stiffness(2, 1, 1.0);
    of_dense(&stiffness, &eye(2), shares)
}

#[test]
fn shares_of_the_mass_that_cannot_be_are_named() {
    for (share, words) in [
        (eye(2), "an answer"),
        (eye(3), "mass of a parameter: 3 x 1 instead of 2 x 1"),
        (
            DMatrix::identity(2, 3),
            "mass of a parameter: 3 x 1 instead of 2 x 1",
        ),
        (
            dmatrix![1.0, 0.0; 0.25, 1.0],
            "relative difference of mass of a parameter, entry (1, 0) beside its mirror is 0.25; it must be at most 1e-11: the matrix must be symmetric, and a file of one triangle alone must call it symmetric, not general",
        ),
        (
            dmatrix![1.0, 0.0; 0.0, f64::NAN],
            "matrix of entry (1, 1) is NaN; it must be a finite number",
        ),
    ] {
        assert_eq!(said(whole(&[ParameterMatrix::Mass(share)])), words);
    }
}

/// A part of the structure may have its stiffness in one parameter and its mass in another.
#[test]
fn factors_on_masses_are_refused_by_their_parameter() {
    let shares = [
        ParameterMatrix::Stiffness(spring_stiffness(2, 1, 1.0)),
        ParameterMatrix::Mass(eye(2)),
    ];
    let (model, _) = whole(&shares).unwrap();
    assert_eq!(said(model.at(&[1.0, 0.5])), "an answer");
    for (factors, words) in [
        (&[1.0][..], "parameter factors: 1 x 1 instead of 2 x 1"),
        (
            &[1.0, 0.0][..],
            "factor of parameter 1 is 0; it must be positive and finite",
        ),
        (
            &[1.0, f64::NAN][..],
            "factor of parameter 1 is NaN; it must be positive and finite",
        ),
    ] {
        assert_eq!(said(model.modes(factors, 1)), words);
    }
}

#[test]
fn bounds_on_masses_are_refused_by_their_parameter() {
    let one = || sparse(&dmatrix![1.0]).unwrap();
    let bounded = |lower: f64, upper: f64| {
        let parameter = WholeParameter {
            name: "fuel".into(),
            share: WholeShare::Mass(one()),
            range: Some(Bounds { lower, upper }),
        };
        said(WholeModel::new(one(), one(), vec![parameter]))
    };
    assert_eq!(bounded(0.5, 2.0), "an answer");
    assert_eq!(bounded(0.5, 0.9999999999999999), "an answer");
    assert_eq!(
        bounded(1.5, 2.0),
        "factor of parameter fuel: 1.5 to 2 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them"
    );
    assert_eq!(
        bounded(2.0, 0.5),
        "factor of parameter fuel: 2 to 0.5 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them"
    );
}
