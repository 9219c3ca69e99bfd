//! Mass parameters that cannot be are refused.

use crate::prelude::*;

/// A part of the structure may have its stiffness in one parameter and its mass in another.
#[test]
fn masses_of_parameters_their_factors_and_bounds_are_refused_by_name() {
    // Two unit masses on two springs with these shares.
    let whole = |shares: &[ParameterMatrix]| {
        let stiffness = spring_stiffness(2, 0, 1.0) + spring_stiffness(2, 1, 1.0);
        of_dense(&stiffness, &eye(2), shares)
    };
    let mass = |share| said(whole(&[ParameterMatrix::Mass(share)]));
    let spring = ParameterMatrix::Stiffness(spring_stiffness(2, 1, 1.0));
    let (both, _) = whole(&[spring, ParameterMatrix::Mass(eye(2))]).unwrap();
    let modes = |factors: &[f64]| said(both.modes(factors, 1));
    let bounded = |lower: f64, upper: f64| {
        let one = || sparse(&dmatrix![1.0]).unwrap();
        let parameter = WholeParameter {
            range: Some(Bounds { lower, upper }),
            ..whole_parameter("fuel", WholeShare::Mass(one()))
        };
        said(WholeModel::new(one(), one(), vec![parameter]))
    };
    for (found, words) in [
        (mass(eye(2)), "an answer"),
        (mass(eye(3)), "mass of a parameter: 3 x 1 instead of 2 x 1"),
        (
            mass(DMatrix::identity(2, 3)),
            "mass of a parameter: 3 x 1 instead of 2 x 1",
        ),
        (
            mass(dmatrix![1.0, 0.0; 0.25, 1.0]),
            "relative difference of mass of a parameter, entry (1, 0) beside its mirror is 0.25; it must be at most 1e-11: the matrix must be symmetric, and a file of one triangle alone must call it symmetric, not general",
        ),
        (
            mass(dmatrix![1.0, 0.0; 0.0, f64::NAN]),
            "matrix of entry (1, 1) is NaN; it must be a finite number",
        ),
        (modes(&[1.0, 0.5]), "an answer"),
        (modes(&[1.0]), "parameter factors: 1 x 1 instead of 2 x 1"),
        (
            modes(&[1.0, 0.0]),
            "factor of parameter 1 is 0; it must be positive and finite",
        ),
        (
            modes(&[1.0, f64::NAN]),
            "factor of parameter 1 is NaN; it must be positive and finite",
        ),
        (bounded(0.5, 2.0), "an answer"),
        (bounded(0.5, 0.9999999999999999), "an answer"),
        (
            bounded(1.5, 2.0),
            "factor of parameter fuel: 1.5 to 2 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them",
        ),
        (
            bounded(2.0, 0.5),
            "factor of parameter fuel: 2 to 0.5 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them",
        ),
    ] {
        assert_eq!(found, words);
    }
}
