//! What of a model goes into the deck of an analysis, and what of an analysis into the correlation.

#![cfg(unix)]

use crate::prelude::*;
use crate::readers::nastran95_analysis::disordered;

#[test]
fn a_deck_holds_point_masses_alone() {
    let mut mass = eye(2);
    mass[(0, 1)] = 0.1;
    mass[(1, 0)] = 0.1;
    let model = disordered();
    let coupled = FiniteElementModel::new(
        model.structure().clone(),
        model.load_distribution().clone(),
        mass,
        model.parameters().to_vec(),
    )
    .unwrap();
    let error = BulkData::from_model(&coupled, &[1.0, 1.0], &[Vector3::zeros(); 2]);
    assert!(matches!(
        error,
        Err(FileError::Method(Error::Value {
            what: "coupling",
            expected: "zero: a deck has point masses alone",
            ..
        }))
    ));
}

#[test]
fn element_matrices_of_another_origin_must_fit() {
    let model = disordered();
    let own = model
        .element_matrices()
        .iter()
        .map(|element| element.unit.clone())
        .collect_vec();
    let doubled = own.iter().map(|unit| 2.0 * unit).collect();
    let stiffer = model.with_unit_stiffness(doubled).unwrap();
    let (once, twice) = (
        model.matrices(&[1.0, 1.0]).unwrap(),
        stiffer.matrices(&[1.0, 1.0]).unwrap(),
    );
    let expected = 2.0 * once.stiffness;
    assert_relative_eq!(
        twice.stiffness,
        expected,
        epsilon = MATRIX_ROUND_OFF * expected.amax()
    );
    let changed = |change: &dyn Fn(&mut Vec<DMatrix<f64>>)| {
        let mut units = own.clone();
        change(&mut units);
        model
            .with_unit_stiffness(units)
            .expect_err("they do not fit")
    };
    let error = changed(&|units| drop(units.pop()));
    assert!(
        matches!(
            error,
            Error::WrongShape {
                what: "element matrices",
                expected_rows: 6,
                rows: 5,
                ..
            }
        ),
        "{error}"
    );
    let error = changed(&|units| units[1] = eye(4));
    assert!(
        matches!(
            error,
            Error::WrongShape {
                what: "element stiffness",
                expected_rows: 3,
                rows: 4,
                columns: 4,
                ..
            }
        ),
        "{error}"
    );
    let error = changed(&|units| units[0][(0, 1)] += 1e7);
    assert!(
        matches!(
            error,
            Error::Value {
                what: "relative asymmetry",
                ref owner,
                ..
            } if owner == "element stiffness"
        ),
        "{error}"
    );
    let error = changed(&|units| units[0][(0, 0)] = f64::NAN);
    assert!(
        matches!(
            error,
            Error::Value {
                what: "element stiffness",
                expected: "a finite number",
                ..
            }
        ),
        "{error}"
    );
}

/// Test modes and passes come from the analysis that is given: four times the stiffness on both sides doubles every
/// frequency and leaves every factor alone.
#[test]
fn a_case_runs_with_the_analysis_it_is_given() {
    let case = case_of(2);
    let stiffer = |model: &FiniteElementModel, _: &[f64]| {
        let elements = model.element_matrices().iter();
        let units = elements.map(|element| 4.0 * &element.unit).collect();
        Ok(model.with_unit_stiffness(units)?)
    };
    let own = run_case(&case, |_, _| ()).unwrap();
    let other = correlate_case(&case, stiffer).unwrap();
    for (a, b) in [
        (&own.test, &other.test),
        (
            &own.correlation.passes[1].check.modes,
            &other.correlation.passes[1].check.modes,
        ),
    ] {
        let doubled = b.omega_squared().map(|root| root / 4.0);
        assert_relative_eq!(doubled, a.omega_squared(), max_relative = GOLDEN_RELATIVE);
    }
    for (a, b) in own.pass_gages[1].iter().zip(&other.pass_gages[1]) {
        assert_relative_eq!(a, b, max_relative = GOLDEN_RELATIVE);
    }
}
