//! What the general formulae of Appendix C refuse, and that the offender is named.

use crate::common::appendix_c::four_modes;
use crate::common::tolerances::{CANCELLED_DIFFERENCE, ROUND_OFF};
use corfem::method::appendix_c::general::{self, ModalChange};
use corfem::method::appendix_c::{eigensolution, normalize_with_mass};
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

#[test]
fn two_roots_brought_together_are_refused_with_both_modes_named() {
    // First-order roots are both 1/2.
    let together = ModalChange::of_vibrations(
        &dvector![5.0, 1.0, 3.0],
        dmatrix![0.0, 0.0, 0.0; 0.0, 1.0, 0.1; 0.0, 0.1, -1.0],
        DMatrix::zeros(3, 3),
    );
    for result in [
        general::first_order(&together),
        general::recursive_1(&together, 2),
        general::recursive_2(&together, 2),
        general::original(&together),
    ] {
        assert!(matches!(
            result,
            Err(Error::CoalescingModes { first: 2, second: 1, separation }) if separation < 1e-9
        ));
    }
    // A separation of one part in a million is enough, and reported when it is not.
    let mut near = together.clone();
    near.beta[(2, 2)] = -1.0 + 2e-6;
    assert!(general::first_order(&near).is_ok());
    near.beta[(2, 2)] = -1.0 + 1e-9;
    assert!(matches!(
        general::first_order(&near),
        Err(Error::CoalescingModes { first: 2, second: 1, separation }) if (separation / 0.5e-9 - 1.0).abs() < CANCELLED_DIFFERENCE
    ));
}

#[test]
fn rows_of_a_shape_without_a_solution_are_refused() {
    // Mode 2 does not couple with the others, which are so coupled that their rows are singular at its root
    // 1/2: (1 + 0.4 − 1/γ)(3 + 0.6 − 1/γ) = β₀₁² with γ = 1/2 gives β₀₁² = −0.96; with mass, choose α₀₁.
    let gamma = 0.5;
    let mut change = ModalChange::of_vibrations(
        &dvector![1.0, 4.0, 2.0],
        DMatrix::zeros(3, 3),
        DMatrix::zeros(3, 3),
    );
    // Row 0 and 1 at γ: (γ·1 − 1)(γ·4 − 1) = −0.5 = r₀₁·r₁₀ with r = −α, unsymmetric.
    change.alpha[(0, 1)] = 1.0;
    change.alpha[(1, 0)] = -0.5;
    assert!((change.roots[2] - gamma).abs() < ROUND_OFF);
    assert!(matches!(
        general::recursive_2(&change, 2),
        Err(Error::CoalescingModes {
            first: 2,
            second: 2,
            ..
        })
    ));
}

#[test]
fn input_that_does_not_fit_is_refused_by_every_function() {
    let good = four_modes(0.05);
    let broken = |edit: fn(&mut ModalChange<f64>)| {
        let mut change = good.clone();
        edit(&mut change);
        let results = [
            general::first_order(&change),
            general::recursive_1(&change, 2),
            general::recursive_2(&change, 2),
            general::original(&change),
            eigensolution(&change),
        ];
        results.map(|result| result.expect_err("broken input"))
    };
    for error in broken(|change| change.roots = DVector::zeros(0)) {
        assert!(matches!(error, Error::Empty { what: "modes" }));
    }
    for error in broken(|change| change.generalized_stiffness = DVector::zeros(3)) {
        assert!(matches!(
            error,
            Error::WrongShape {
                what: "generalized stiffness",
                expected_rows: 4,
                expected_columns: 1,
                rows: 3,
                columns: 1
            }
        ));
    }
    for error in broken(|change| change.beta = DMatrix::zeros(4, 3)) {
        assert!(matches!(
            error,
            Error::WrongShape {
                what: "generalized stiffness change",
                expected_columns: 4,
                columns: 3,
                ..
            }
        ));
    }
    for error in broken(|change| change.alpha = DMatrix::zeros(5, 4)) {
        assert!(matches!(
            error,
            Error::WrongShape {
                what: "generalized change of mass and aerodynamic terms",
                rows: 5,
                ..
            }
        ));
    }
    for error in broken(|change| change.alpha[(2, 3)] = f64::NAN) {
        assert!(matches!(
            error,
            Error::NotFinite { what: "generalized change of mass and aerodynamic terms", row: 2, column: 3, value } if value.is_nan()
        ));
    }
    for error in broken(|change| change.beta[(1, 0)] = f64::INFINITY) {
        assert!(matches!(
            error,
            Error::NotFinite {
                what: "generalized stiffness change",
                row: 1,
                column: 0,
                value: f64::INFINITY
            }
        ));
    }
    for error in broken(|change| change.generalized_stiffness[1] = f64::NAN) {
        assert!(matches!(
            error,
            Error::NotFinite {
                what: "generalized stiffness",
                row: 1,
                column: 0,
                ..
            }
        ));
    }
    for error in broken(|change| change.roots[3] = f64::INFINITY) {
        assert!(matches!(
            error,
            Error::NotFinite {
                what: "roots",
                row: 3,
                column: 0,
                ..
            }
        ));
    }
    for error in broken(|change| change.beta[(2, 2)] = -6.0) {
        assert!(matches!(
            error,
            Error::LostStiffness {
                mode: 2,
                ratio: 0.0
            }
        ));
    }
}

#[test]
fn stiffness_nearly_lost_is_named_with_what_is_left_of_it() {
    let mut change = four_modes(0.05);
    change.beta[(3, 3)] = -14.0 * (1.0 - 1e-10);
    assert!(matches!(
        general::first_order(&change),
        Err(Error::LostStiffness { mode: 3, ratio }) if (ratio / 1e-10 - 1.0).abs() < CANCELLED_DIFFERENCE
    ));
    change.beta[(3, 3)] = -14.0 * (1.0 - 1e-3);
    assert!(general::first_order(&change).is_ok());
}

#[test]
fn order_zero_is_refused() {
    let change = four_modes(0.05);
    for result in [
        general::recursive_1(&change, 0),
        general::recursive_1_converged(&change, 1e-6, 0).map(|settled| settled.perturbed),
        general::recursive_2(&change, 0),
    ] {
        assert!(matches!(
            result,
            Err(Error::Setting {
                name: "order",
                expected: "at least 1",
                found: 0.0
            })
        ));
    }
}

#[test]
fn generalized_mass_that_loses_its_sign_is_refused() {
    let mut change = four_modes(0.0);
    change.alpha[(1, 1)] = -1.5;
    let root = general::first_order(&change).unwrap().roots[1];
    assert!((root + 0.5 / 2.5).abs() < ROUND_OFF);
    assert!(matches!(
        eigensolution(&change),
        Err(Error::NotPositiveDefinite {
            what: "dynamic mass",
            dof: 1
        })
    ));
    assert!(matches!(
        normalize_with_mass(&mut DMatrix::identity(4, 4), &change.alpha),
        Err(Error::NotPositive { what: "changed generalized mass", owner, value: -0.5 }) if owner == "mode 1 (from zero)"
    ));
    assert!(matches!(
        normalize_with_mass(&mut DMatrix::identity(4, 4), &DMatrix::zeros(3, 4)),
        Err(Error::WrongShape {
            what: "generalized mass change",
            expected_rows: 4,
            rows: 3,
            ..
        })
    ));
}

/// A recursion that diverges ends in an error, never in NaN.
#[test]
fn runaway_recursion_is_an_error() {
    let mut change = four_modes(1.0);
    change.beta *= 1e3;
    change.alpha *= 0.0;
    for i in 0..4 {
        change.beta[(i, i)] = 0.0;
    }
    assert!(matches!(
        general::recursive_1(&change, 500),
        Err(Error::NotFinite { .. } | Error::CoalescingModes { .. })
    ));
}
