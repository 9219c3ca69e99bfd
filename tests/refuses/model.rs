//! What cannot be a model, a parameter or a factor: each refusal names who is at fault.

use crate::common::structures::chain_model as chain;
use crate::prelude::*;

fn with_mass(t: DMatrix<f64>, mass: DMatrix<f64>) -> Result<FiniteElementModel, Error> {
    let structure = spring_chain(&[2.0, 4.0, 8.0], [true, false]);
    FiniteElementModel::new(structure, t, mass, vec![Parameter::new(1, &[1])])
}

#[test]
fn bounds_that_no_factor_or_not_the_start_satisfies_are_refused_by_their_parameter() {
    let refused = |lower: f64, upper: f64| {
        let some = Parameter {
            factor_range: Some(Bounds { lower, upper }),
            ..Parameter::new("some", &[1])
        };
        said(chain(vec![some]).unwrap().factor_ranges())
    };
    let words = "is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them";
    for (lower, upper) in [
        (1.5, 1.0),
        (1.5, 2.0),
        (0.25, 0.5),
        (0.0, 2.0),
        (0.5, 0.999999999),
    ] {
        let expected = format!("factor of parameter some: {lower} to {upper} {words}");
        assert_eq!(refused(lower, upper), expected);
    }
    // What equals the start but for round-off does not exclude it.
    let just_below = 0.9999999999999999;
    for (lower, upper) in [(0.5, just_below), (1.0 / just_below, 1.5)] {
        assert_eq!(refused(lower, upper), "an answer");
    }
}

#[test]
fn parameters_that_cannot_be_are_refused_by_name() {
    let one = || Parameter::new(1, &[1]);
    let wing = |elements: &[usize]| Parameter::new("wing", elements);
    let tail = || Parameter::new("tail", &[3, 2]);
    for (parameters, words) in [
        (
            vec![],
            "parameters: 0 given or asked for; there must be at least 1",
        ),
        (
            vec![one(), wing(&[])],
            "elements of a parameter: 0 given or asked for; there must be at least 1",
        ),
        (vec![wing(&[1, 4])], "parameter wing: there is no element 4"),
        (
            vec![wing(&[1, 2]), tail()],
            "parameters wing and tail: element 2 is given twice",
        ),
        (
            vec![wing(&[1, 1])],
            "parameters wing and wing: element 1 is given twice",
        ),
    ] {
        assert_eq!(said(chain(parameters)), words);
    }
}

#[test]
fn factors_that_cannot_be_are_refused_by_their_parameter() {
    let model = chain(vec![
        Parameter::new("wing", &[1, 2]),
        Parameter::new(3, &[3]),
    ])
    .unwrap();
    for factors in [vec![1.0], vec![1.0; 3]] {
        let words = format!("parameter factors: {} x 1 instead of 2 x 1", factors.len());
        assert_eq!(said(model.sizes(&factors)), words);
    }
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (factors, name) in [([value, 1.0], "wing"), ([1.0, value], "3")] {
            let words =
                format!("factor of parameter {name} is {value}; it must be positive and finite");
            assert_eq!(said(model.matrices(&factors)), words);
        }
    }
}

#[test]
fn a_mass_that_is_not_positive_is_refused_by_its_dof() {
    for value in [0.0, -0.5] {
        for dof in 0..3 {
            let mut mass = eye(3);
            mass[(dof, dof)] = value;
            assert_eq!(
                said(with_mass(eye(3), mass)),
                not_definite("dynamic mass", dof)
            );
        }
    }
    let mut data = case_of(1).reconstruction;
    data.masses[4] = f64::NAN;
    assert_eq!(
        said(Case::from_reconstruction(1, data).unwrap().model()),
        "dynamic mass of entry (4, 4) is NaN; it must be a finite number"
    );
}

#[test]
fn matrices_that_do_not_fit_are_refused_by_name() {
    let identity = || eye(3);
    let nan = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, f64::NAN, 1.0];
    let skew = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.5, 1.0];
    for (t, mass, words) in [
        (
            DMatrix::zeros(2, 3),
            identity(),
            "load distribution: 2 x 3 instead of 3 x 3",
        ),
        (
            identity(),
            eye(2),
            "load distribution: 3 x 3 instead of 3 x 2",
        ),
        (
            nan,
            identity(),
            "load distribution of entry (2, 1) is NaN; it must be a finite number",
        ),
        (
            identity(),
            skew,
            "relative asymmetry of dynamic mass is 0.5; it must be at most 1e-8",
        ),
        (
            DMatrix::zeros(3, 0),
            zero_square(0),
            "dynamic degrees of freedom: 0 given or asked for; there must be at least 1",
        ),
    ] {
        assert_eq!(said(with_mass(t, mass)), words);
    }
}

#[test]
fn a_structure_that_nothing_holds_is_refused_by_a_direction() {
    let (free, t) = (
        spring_chain(&[1.0], [false, false]),
        DMatrix::identity(2, 1),
    );
    let parameters = vec![Parameter::new(1, &[1])];
    let model = FiniteElementModel::new(free, t, eye(1), parameters).unwrap();
    let refused = model.matrices(&[1.0]);
    assert!(
        matches!(
            refused,
            Err(Error::SingularStiffness { direction: 'x', .. })
        ),
        "{refused:?}"
    );
}

/// Element matrices of another program.
#[test]
fn element_matrices_that_do_not_fit_are_refused() {
    let model = chain(vec![Parameter::new(1, &[1])]).unwrap();
    let with = |units: Vec<DMatrix<f64>>| said(model.with_unit_stiffness(units));
    let one = || eye(1);
    let two = || eye(2);
    assert_eq!(with(vec![one(), two(), two()]), "an answer");
    assert_eq!(
        with(vec![one(), two()]),
        "element matrices: 2 x 1 instead of 3 x 1"
    );
    assert_eq!(
        with(vec![one(), two(), one()]),
        "element stiffness: 1 x 1 instead of 2 x 2"
    );
    assert_eq!(
        with(vec![one(), two(), dmatrix![1.0, 0.0; 0.25, 1.0]]),
        "relative asymmetry of element stiffness is 0.25; it must be at most 1e-8"
    );
}
