//! What the general formulae of Appendix C refuse, and that the offender is named.

use crate::prelude::*;

fn pencil(change: &ModalChange) -> Pencil<f64> {
    change.pencil().unwrap()
}

fn first_order(change: &ModalChange) -> Result<Perturbed, Error> {
    pencil(change).first_order()
}

#[test]
fn two_roots_brought_together_are_refused_with_both_modes_named() {
    // First-order roots are both 1/2.
    let together = ModalChange::of_vibrations(
        &dvector![5.0, 1.0, 3.0],
        dmatrix![0.0, 0.0, 0.0; 0.0, 1.0, 0.1; 0.0, 0.1, -1.0],
        zero_square(3),
    );
    let found = pencil(&together);
    for result in [
        found.first_order(),
        found.recursive_1(2),
        found.recursive_2(2),
        found.original(),
    ] {
        assert!(matches!(
            result,
            Err(Error::CoalescingModes { first: 2, second: 1, separation }) if separation < 1e-9
        ));
    }
    // A separation of one part in a million is enough, and reported when it is not.
    let mut near = together.clone();
    near.beta[(2, 2)] = -1.0 + 2e-6;
    assert!(first_order(&near).is_ok());
    near.beta[(2, 2)] = -1.0 + 1e-9;
    assert!(matches!(
        first_order(&near),
        Err(Error::CoalescingModes { first: 2, second: 1, separation }) if (separation / 0.5e-9 - 1.0).abs() < CANCELLED_DIFFERENCE
    ));
}

#[test]
fn rows_of_a_shape_without_a_solution_are_refused() {
    // Mode 2 does not couple with the others, which are so coupled that their rows are singular at its root
    // 1/2: (1 + 0.4 − 1/γ)(3 + 0.6 − 1/γ) = β₀₁² with γ = 1/2 gives β₀₁² = −0.96; with mass, choose α₀₁.
    let gamma = 0.5;
    let mut change =
        ModalChange::of_vibrations(&dvector![1.0, 4.0, 2.0], zero_square(3), zero_square(3));
    // Row 0 and 1 at γ: (γ·1 − 1)(γ·4 − 1) = −0.5 = r₀₁·r₁₀ with r = −α, unsymmetric.
    change.alpha[(0, 1)] = 1.0;
    change.alpha[(1, 0)] = -0.5;
    let change = pencil(&change);
    assert_within(change.first_order().unwrap().roots[2], gamma, ROUND_OFF);
    assert!(matches!(
        change.recursive_2(2),
        Err(Error::CoalescingModes {
            first: 2,
            second: 2,
            ..
        })
    ));
}

#[test]
fn a_change_that_does_not_fit_its_modes_is_refused() {
    let refused = |edit: fn(&mut ModalChange)| {
        let mut change = four_modes(0.05);
        edit(&mut change);
        said(change.pencil())
    };
    type Edit = fn(&mut ModalChange);
    let table: [(Edit, &str); 7] = [
        (
            |change| change.generalized_stiffness = DVector::zeros(0),
            "modes: 0 given or asked for; there must be at least 1",
        ),
        (
            |change| change.generalized_stiffness = DVector::zeros(3),
            "generalized stiffness change: 4 x 4 instead of 3 x 3",
        ),
        (
            |change| change.beta = DMatrix::zeros(4, 3),
            "generalized stiffness change: 4 x 3 instead of 4 x 4",
        ),
        (
            |change| change.alpha = DMatrix::zeros(5, 4),
            "generalized mass change: 5 x 4 instead of 4 x 4",
        ),
        (
            |change| change.alpha[(2, 3)] = f64::NAN,
            "generalized mass change of entry (2, 3) is NaN; it must be a finite number",
        ),
        (
            |change| change.beta[(1, 0)] = f64::INFINITY,
            "generalized stiffness change of entry (1, 0) is inf; it must be a finite number",
        ),
        (|_| {}, "an answer"),
    ];
    for (edit, words) in table {
        assert_eq!(refused(edit), words);
    }
}

/// A root of a mode that has no stiffness left, or whose stiffness is no number.
#[test]
fn a_root_that_is_no_number_is_refused_by_every_formula() {
    let lost = |edit: fn(&mut ModalChange)| {
        let mut change = four_modes(0.05);
        edit(&mut change);
        let found = pencil(&change);
        [
            found.first_order(),
            found.recursive_1(2),
            found
                .recursive_1_converged()
                .map(|settled| settled.perturbed),
            found.recursive_2(2),
            found.original(),
        ]
        .map(said)
    };
    let words = |row: usize, value: &str| {
        format!("perturbed roots of entry ({row}, {row}) is {value}; it must be a finite number")
    };
    assert_eq!(
        lost(|change| change.beta[(2, 2)] = -6.0),
        [(); 5].map(|()| words(2, "inf"))
    );
    let nan = |change: &mut ModalChange| change.generalized_stiffness[1] = f64::NAN;
    assert_eq!(lost(nan), [(); 5].map(|()| words(1, "NaN")));
}

/// Left and right shapes that are not those of the stiffness.
#[test]
fn shapes_that_do_not_fit_a_stiffness_are_refused() {
    let (stiffness, none) = (dmatrix![2.0, -1.0; -1.0, 2.0], zero_square(2));
    let modes = |right: DMatrix<f64>, left: DMatrix<f64>| LeftRightModes {
        roots: dvector![1.0, 0.5],
        right,
        left,
    };
    let own = || dmatrix![1.0, 1.0; 1.0, -1.0];
    let refused =
        |shapes: &LeftRightModes<f64>, stiffness: &DMatrix<f64>, change: &DMatrix<f64>| {
            said(Pencil::new(stiffness, shapes, change, &none))
        };
    let good = modes(own(), own());
    assert_eq!(refused(&good, &stiffness, &none), "an answer");
    assert_eq!(
        refused(&modes(own(), DMatrix::zeros(3, 2)), &stiffness, &none),
        "left shapes: 3 x 2 instead of 2 x 2"
    );
    assert_eq!(
        refused(&good, &zero_square(3), &none),
        "stiffness: 3 x 3 instead of 2 x 2"
    );
    assert_eq!(
        refused(&good, &stiffness, &dmatrix![0.0, f64::NAN; 0.0, 0.0]),
        "stiffness change of entry (0, 1) is NaN; it must be a finite number"
    );
    assert_eq!(
        refused(&modes(eye(2), eye(2)), &stiffness, &none),
        "coupling of left and right shapes of modes 1 and 0 is 0.5; it must be zero"
    );
}

#[test]
fn order_zero_is_refused() {
    let change = four_modes(0.05);
    let (k, beta, found) = (&change.generalized_stiffness, &change.beta, pencil(&change));
    for answer in [
        found.recursive_1(0),
        found.recursive_2(0),
        recursive_1(k, beta, 0),
    ] {
        assert_eq!(
            said(answer),
            "order: 0 given or asked for; there must be at least 1"
        );
    }
}

#[test]
fn generalized_mass_that_loses_its_sign_is_refused() {
    let mut change = four_modes(0.0);
    change.alpha[(1, 1)] = -1.5;
    let root = first_order(&change).unwrap().roots[1];
    assert!((root + 0.5 / 2.5).abs() < ROUND_OFF);
    let normalized = |alpha: &DMatrix<f64>| normalize_with_mass(&mut eye(4), alpha);
    assert_eq!(
        said(normalized(&change.alpha)),
        "changed generalized mass of mode 1 (from zero) is -0.5; it must be positive and finite"
    );
    assert_eq!(
        said(normalized(&DMatrix::zeros(3, 4))),
        "generalized mass change: 3 x 4 instead of 4 x 4"
    );
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
        pencil(&change).recursive_1(500),
        Err(Error::Value {
            what: "perturbed roots" | "perturbed generalized shapes",
            ..
        } | Error::CoalescingModes { .. })
    ));
}
