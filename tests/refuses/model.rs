//! What cannot be a model, a parameter or a factor: each refusal names who is at fault.

use crate::common::structures::chain_model as chain;
use crate::prelude::*;

/// Bounds on the factor of a spring; what equals the start but for round-off does not exclude it.
#[test]
fn bounds_that_no_factor_or_not_the_start_satisfies_are_refused_by_their_parameter() {
    let just_below = 0.9999999999999999;
    for (lower, upper, is_refused) in [
        (1.5, 1.0, true),
        (1.5, 2.0, true),
        (0.25, 0.5, true),
        (0.0, 2.0, true),
        (0.5, 0.999999999, true),
        (0.5, just_below, false),
        (1.0 / just_below, 1.5, false),
    ] {
        let some = Parameter {
            factor_range: Some(Bounds { lower, upper }),
            ..Parameter::new("some", &[1])
        };
        let words = format!(
            "factor of parameter some: {lower} to {upper} is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them"
        );
        let found = said(chain(vec![some]).unwrap().factor_ranges());
        assert_eq!(found == words, is_refused, "{found}");
        assert!(is_refused || found == "an answer", "{found}");
    }
}

#[test]
fn models_parameters_and_factors_are_refused_by_name() {
    let of = |own: &[(&str, &[usize])]| {
        let own = own
            .iter()
            .map(|(name, elements)| Parameter::new(name, elements));
        chain(own.collect())
    };
    let parameters = |own: &[(&str, &[usize])]| said(of(own));
    let model = of(&[("wing", &[1, 2]), ("3", &[3])]).unwrap();
    let factors = |own: &[f64]| said(model.matrices(own));
    let with = |t, mass| {
        let structure = spring_chain(&[2.0, 4.0, 8.0], [true, false]);
        said(FiniteElementModel::new(
            structure,
            t,
            mass,
            vec![Parameter::new(1, &[1])],
        ))
    };
    let units = |last: DMatrix<f64>| said(model.with_unit_stiffness(vec![eye(1), eye(2), last]));
    let mut data = case_of(1).reconstruction;
    data.masses[4] = f64::NAN;
    let nan = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, f64::NAN, 1.0];
    let skew = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.5, 1.0];
    for (found, words) in [
        (
            parameters(&[]),
            "parameters: 0 given or asked for; there must be at least 1",
        ),
        (
            parameters(&[("1", &[1]), ("wing", &[])]),
            "elements of a parameter: 0 given or asked for; there must be at least 1",
        ),
        (
            parameters(&[("wing", &[1, 4])]),
            "parameter wing: there is no element 4",
        ),
        (
            parameters(&[("wing", &[1, 2]), ("tail", &[3, 2])]),
            "parameters wing and tail: element 2 is given twice",
        ),
        (
            parameters(&[("wing", &[1, 1])]),
            "parameters wing and wing: element 1 is given twice",
        ),
        (
            said(model.sizes(&[1.0])),
            "parameter factors: 1 x 1 instead of 2 x 1",
        ),
        (
            said(model.sizes(&[1.0; 3])),
            "parameter factors: 3 x 1 instead of 2 x 1",
        ),
        (
            factors(&[0.0, 1.0]),
            "factor of parameter wing is 0; it must be positive and finite",
        ),
        (
            factors(&[1.0, -1.0]),
            "factor of parameter 3 is -1; it must be positive and finite",
        ),
        (
            factors(&[f64::NAN, 1.0]),
            "factor of parameter wing is NaN; it must be positive and finite",
        ),
        (
            factors(&[1.0, f64::INFINITY]),
            "factor of parameter 3 is inf; it must be positive and finite",
        ),
        (
            with(eye(3), diagonal([1.0, 0.0, 1.0])),
            "dynamic mass is not positive definite: row 1 (from zero) is a combination of those before it, or not positive",
        ),
        (
            with(eye(3), diagonal([1.0, 1.0, -0.5])),
            "dynamic mass is not positive definite: row 2 (from zero) is a combination of those before it, or not positive",
        ),
        (
            said(Case::from_reconstruction(1, data).unwrap().model()),
            "dynamic mass of entry (4, 4) is NaN; it must be a finite number",
        ),
        (
            with(DMatrix::zeros(2, 3), eye(3)),
            "load distribution: 2 x 3 instead of 3 x 3",
        ),
        (
            with(eye(3), eye(2)),
            "load distribution: 3 x 3 instead of 3 x 2",
        ),
        (
            with(nan, eye(3)),
            "load distribution of entry (2, 1) is NaN; it must be a finite number",
        ),
        (
            with(eye(3), skew),
            "relative asymmetry of dynamic mass is 0.5; it must be at most 1e-8",
        ),
        (
            with(DMatrix::zeros(3, 0), eye(0)),
            "dynamic degrees of freedom: 0 given or asked for; there must be at least 1",
        ),
        // Element matrices of another program.
        (units(eye(2)), "an answer"),
        (units(eye(1)), "element stiffness: 1 x 1 instead of 2 x 2"),
        (
            units(dmatrix![1.0, 0.0; 0.25, 1.0]),
            "relative asymmetry of element stiffness is 0.25; it must be at most 1e-8",
        ),
        (
            said(model.with_unit_stiffness(vec![eye(1), eye(2)])),
            "element matrices: 2 x 1 instead of 3 x 1",
        ),
    ] {
        assert_eq!(found, words);
    }
}
