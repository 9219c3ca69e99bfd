//! What the perturbation refuses, rule by rule: bad input, lost roots, coalescing modes, roots that do not settle, orders of
//! zero.

use crate::prelude::*;

#[test]
fn every_rule_needs_modes() {
    for rule in FORMULAE {
        let answer = (rule.plain)(&DVector::zeros(0), &zero_square(0));
        assert_eq!(
            said(answer),
            "modes: 0 given or asked for; there must be at least 1",
            "{}",
            rule.name
        );
    }
}

#[test]
fn every_rule_refuses_a_change_that_is_none_of_its_modes() {
    let nan = dmatrix![0.0, f64::NAN; 0.0, 0.0];
    for rule in FORMULAE {
        for (beta, words) in [
            (zero_square(3), ": 3 x 3 instead of 2 x 2"),
            (DMatrix::zeros(2, 3), ": 2 x 3 instead of 2 x 2"),
            (DMatrix::zeros(1, 2), ": 1 x 2 instead of 2 x 2"),
            (
                nan.clone(),
                " of entry (0, 1) is NaN; it must be a finite number",
            ),
        ] {
            let expected = format!("generalized stiffness change{words}");
            let answer = (rule.plain)(&dvector![1.0, 2.0], &beta);
            assert_eq!(said(answer), expected, "{}", rule.name);
        }
    }
}

#[test]
fn every_formula_of_the_loops_starts_from_vibrations() {
    for rule in stiffness_rules() {
        for (bad, value) in [
            (0.0, "0.000000e0"),
            (-1.0, "-1.000000e0"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            let answer = (rule.plain)(&dvector![1.0, bad], &zero_square(2));
            let words = format!(
                "mode 1 (from zero) is no vibration: its eigenvalue is {value}; it must be positive and finite"
            );
            assert_eq!(said(answer), words, "{}", rule.name);
        }
    }
}

/// Roots of any sign are theirs, but none without a stiffness that is a number.
#[test]
fn the_general_formulae_start_from_roots_that_are_numbers() {
    for rule in FORMULAE {
        for (bad, value) in [(0.0, "inf"), (f64::NAN, "NaN")] {
            let change = of_stiffness(&dvector![1.0, bad], &zero_square(2));
            let answer = (rule.general)(&change);
            let words =
                format!("perturbed roots of entry (1, 1) is {value}; it must be a finite number");
            assert_eq!(said(answer), words, "{}", rule.name);
        }
    }
}

#[test]
fn a_change_that_takes_all_stiffness_loses_the_root() {
    for (lost, root) in [(-2.0, "inf"), (-3.0, "-1.000000e0")] {
        let beta = dmatrix![0.0, 0.0; 0.0, lost];
        for rule in stiffness_rules() {
            let answer = (rule.plain)(&dvector![1.0, 2.0], &beta);
            let words = format!(
                "mode 1 (from zero) is no vibration: its eigenvalue is {root}; it must be positive and finite"
            );
            assert_eq!(said(answer), words, "{}", rule.name);
        }
    }
}

#[test]
fn a_strong_coupling_loses_the_root_in_a_higher_order() {
    // First order gives roots 1 and 1/2, p = (1, -2; 2, 1); the second order of mode 1 is 1/2 - 4/2 < 0.
    let (k, beta) = (dvector![1.0, 2.0], dmatrix![0.0, 2.0; 2.0, 0.0]);
    assert!(first_order(&k, &beta).is_ok());
    match recursive_1(&k, &beta, 2) {
        Err(Error::NotAVibration { mode, value }) => {
            assert_eq!(mode, 1);
            assert_within(value, 0.5 - 0.5 * 2.0 * 2.0 / 2.0, f64::EPSILON);
        }
        other => panic!("{other:?}"),
    }
    // The explicit root of mode 0 is 1/(1 + S) with S = 2 (-2) = -4; the general formulae know roots of either sign.
    for found in [original(&k, &beta), recursive_2(&k, &beta, 2)] {
        assert_within(
            found.unwrap().roots[0],
            1.0 / (1.0 - 4.0),
            4.0 * f64::EPSILON,
        );
    }
}

#[test]
fn modes_that_come_together_are_named() {
    // k + β is 2 for both modes, so that the denominator of row 1 in mode 0 vanishes.
    let beta = dmatrix![1.0, 0.1; 0.1, 0.0];
    for rule in FORMULAE {
        let answer = (rule.plain)(&dvector![1.0, 2.0], &beta);
        let words = "modes 1 and 0 (from zero) come too close to tell apart (0.0e0)";
        assert_eq!(said(answer), words, "{}", rule.name);
    }
    // What the recursion cannot do, the eigensolution can: 2 -+ 0.1.
    let exact = exact(&dvector![1.0, 2.0], &beta).unwrap();
    let sum: f64 = exact.roots.iter().map(|root| 1.0 / root).sum();
    assert_within(sum, 4.0, 10.0 * ROUND_OFF);
}

/// Two modes that a change couples slightly count as coalescing when their roots are closer than the smallest separation, a
/// fraction of the stiffness whatever its size.
#[test]
fn coupled_modes_coalesce_below_the_smallest_separation() {
    let coupling = 1e-12;
    let separated_by = |fraction: f64, scale: f64| {
        let k = scale * dvector![1.0, 1.0 + fraction * SMALLEST_SEPARATION];
        first_order(&k, &(scale * dmatrix![0.0, coupling; coupling, 0.0]))
    };
    for scale in [1e-6, 1.0, 1e6] {
        let shapes = separated_by(2.0, scale).unwrap().shapes;
        let turn = coupling / (2.0 * SMALLEST_SEPARATION);
        assert!(relative_error(shapes[(0, 1)], turn) < CANCELLED_DIFFERENCE);
        assert!((shapes[(1, 0)] / turn + 1.0).abs() < CANCELLED_DIFFERENCE);
        match separated_by(0.5, scale) {
            Err(Error::CoalescingModes {
                first,
                second,
                separation,
            }) => {
                assert_eq!((first, second), (1, 0));
                let ratio = separation / SMALLEST_SEPARATION;
                assert!(relative_error(ratio, 0.5) < CANCELLED_DIFFERENCE, "{ratio}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_mode_on_a_root_of_the_others_makes_the_linear_system_singular() {
    // Mode 0 stays at 1; modes 1 and 2 become [2, 2; 2, 5] with the roots 1 and 6.
    let k = dvector![1.0, 2.0, 5.0];
    let beta = dmatrix![0.0, 0.0, 0.0; 0.0, 0.0, 2.0; 0.0, 2.0, 0.0];
    assert!(original(&k, &beta).is_ok());
    assert_eq!(
        said(recursive_2(&k, &beta, 2)),
        "modes 0 and 0 (from zero) come too close to tell apart (0.0e0)"
    );
}

/// Mode 0 comes down to mode 1 at the second order: with mode 2 its root is 1 + 1/2, with mode 1 it changes by 0.01/(k₁ - 1), and k₁ is
/// chosen so that the two together are 1/k₁.
#[test]
fn modes_that_an_order_after_the_first_brings_together_are_refused() {
    let k1 = (2.49 - (2.49_f64.powi(2) - 6.0).sqrt()) / 3.0;
    let k = dvector![1.0, k1, 3.0];
    let beta = dmatrix![0.0, 0.1, 1.0; 0.1, 0.0, 0.0; 1.0, 0.0, 0.0];
    let second = recursive_1(&k, &beta, 2).unwrap();
    assert_within(second.roots[0] * k1, 1.0, ROUND_OFF);
    let refused = recursive_1(&k, &beta, 3);
    assert!(
        matches!(
            refused,
            Err(Error::CoalescingModes {
                first: 1,
                second: 0,
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn a_change_of_mass_that_is_none_of_its_modes_is_refused() {
    for (alpha, words) in [
        (
            DMatrix::zeros(5, 4),
            "generalized mass change: 5 x 4 instead of 4 x 4",
        ),
        (
            f64::NAN * eye(4),
            "generalized mass change of entry (0, 0) is NaN; it must be a finite number",
        ),
    ] {
        let change = ModalChange {
            alpha,
            ..four_modes(0.05)
        };
        assert_eq!(said(change.pencil()), words);
    }
}

/// Left and right shapes that are not those of the stiffness.
#[test]
fn shapes_that_do_not_fit_a_stiffness_are_refused() {
    let (stiffness, none) = (dmatrix![2.0, -1.0; -1.0, 2.0], zero_square(2));
    let (own, nan) = (
        dmatrix![1.0, 1.0; 1.0, -1.0],
        dmatrix![0.0, f64::NAN; 0.0, 0.0],
    );
    for (right, left, change, words) in [
        (&own, &own, &none, "an answer"),
        (
            &own,
            &DMatrix::zeros(3, 2),
            &none,
            "left shapes: 3 x 2 instead of 2 x 2",
        ),
        (
            &own,
            &own,
            &nan,
            "stiffness change of entry (0, 1) is NaN; it must be a finite number",
        ),
        (
            &eye(2),
            &eye(2),
            &none,
            "coupling of left and right shapes of modes 1 and 0 is 0.5; it must be zero",
        ),
    ] {
        let (right, left) = (right.clone(), left.clone());
        let roots = dvector![1.0, 0.5];
        let shapes = LeftRightModes { roots, right, left };
        assert_eq!(said(Pencil::new(&stiffness, &shapes, change, &none)), words);
    }
}

#[test]
fn order_zero_is_refused() {
    let change = four_modes(0.05);
    let (k, beta, found) = (
        &change.generalized_stiffness,
        &change.beta,
        change.pencil().unwrap(),
    );
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
    let root = change.pencil().unwrap().first_order().unwrap().roots[1];
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
