//! Baruch's correction: exact for the test modes, symmetric, and the smallest change that is.

use crate::evidence::by_matrix::{baruch_stiffness, mass_weighted};
use crate::prelude::*;

/// Degrees of freedom: enough that tests are fewer than they by several.
const SIZE: usize = 6;

/// An analysis stiffness and mass, a true stiffness, a number of test modes below that of DOF, and any symmetric matrix.
///
/// Conditions up to 100 each: masses and stiffnesses of one structure differ by so much, and the corrections' round-off
/// grows with the product of the conditions.
#[derive(Debug, Clone)]
struct Problem {
    stiffness: DMatrix<f64>,
    mass: DMatrix<f64>,
    test: Modes,
    true_stiffness: DMatrix<f64>,
    other: DMatrix<f64>,
}

fn problem() -> impl Strategy<Value = Problem> {
    (
        positive_definite(SIZE, 2.0),
        positive_definite(SIZE, 2.0),
        positive_definite(SIZE, 2.0),
        1..SIZE,
        symmetric(SIZE),
    )
        .prop_map(
            |((stiffness, _), (mass, _), (true_stiffness, _), count, other)| {
                let all = solve(&true_stiffness, &mass, SIZE).unwrap();
                Problem {
                    test: all.lowest(count).unwrap(),
                    stiffness,
                    mass,
                    true_stiffness,
                    other,
                }
            },
        )
}

/// A change that keeps a corrected matrix admissible: it does not act on the test shapes. `complement` takes their part
/// out of any vector.
fn admissible(problem: &Problem, mass: &DMatrix<f64>, shapes: &DMatrix<f64>) -> DMatrix<f64> {
    let size = mass.nrows();
    let generalized = shapes.tr_mul(&(mass * shapes));
    let inverse = generalized.try_inverse().unwrap();
    let complement = eye(size) - mass * shapes * inverse * shapes.transpose();
    let change = &complement * &problem.other * complement.transpose();
    0.5 * (&change + change.transpose())
}

properties! {
    #[test]
    fn corrected_stiffness_has_the_test_modes_exactly(problem in problem()) {
        let Problem { stiffness, mass, test, .. } = &problem;
        let corrected = baruch_stiffness(stiffness, mass, test);
        prop_assert_eq!(corrected.shape(), (SIZE, SIZE));
        prop_assert_eq!(&corrected, &corrected.transpose());
        let inertia = mass * test.shapes() * DMatrix::from_diagonal(test.omega_squared());
        let left = &corrected * test.shapes();
        let scale = stiffness.amax().max(problem.true_stiffness.amax()) * test.shapes().amax();
        prop_assert!((left - inertia).amax() <= CORRECTION_ROUND_OFF * scale);
    }

    #[test]
    fn corrected_stiffness_is_the_nearest_admissible_one(problem in problem()) {
        // Nearest in an inner product: every admissible change beside the correction is orthogonal to it.
        let Problem { stiffness, mass, test, .. } = &problem;
        let corrected = baruch_stiffness(stiffness, mass, test);
        let beside = admissible(&problem, mass, test.shapes());
        let change = &corrected - stiffness;
        let squares = [
            mass_weighted(&(&change + &beside), mass).norm_squared(),
            mass_weighted(&change, mass).norm_squared(),
            mass_weighted(&beside, mass).norm_squared(),
        ];
        prop_assert!((squares[0] - squares[1] - squares[2]).abs() <= CORRECTION_ROUND_OFF * squares[0]);
    }
}

fn one_mode(shape: DVector<f64>, omega_squared: f64) -> Modes {
    Modes::new(dvector![omega_squared], DMatrix::from_columns(&[shape])).unwrap()
}

#[test]
fn two_degrees_of_freedom_by_hand() {
    // The first DOF is a mode of ω² = 3, so nothing may couple it; what does not touch it stays.
    let stiffness = dmatrix![2.0, -1.0; -1.0, 2.0];
    let identity = eye(2);
    let test = one_mode(dvector![1.0, 0.0], 3.0);
    let expected = dmatrix![3.0, 0.0; 0.0, 2.0];
    assert_eq!(baruch_stiffness(&stiffness, &identity, &test), expected);
}
