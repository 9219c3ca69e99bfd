//! Appendix C in full on real numbers: equal to the plain path where that applies, and mass changes beside stiffness.

use crate::common::appendix_c::{ascending, separate_change, three_mass_chain};
use crate::common::log_log_slope;
use crate::common::tolerances::{EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, ORDER_SLACK, ROUND_OFF};
use corfem::complex_modes::LeftRightModes;
use corfem::error::Error;
use corfem::perturbation::{
    CloseRootsSettings, ModalChange, Perturbed, UpdateRule, eigensolution, eigensolution_with_mass,
    general, normalize_with_mass, perturb, perturb_with_mass, recursive,
};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;

const EVERY_RULE: [UpdateRule; 6] = [
    UpdateRule::Recursive1Converged {
        tolerance: 1e-13,
        orders: 60,
    },
    UpdateRule::Recursive1 { order: 3 },
    UpdateRule::Recursive2 { order: 3 },
    UpdateRule::FirstOrder,
    UpdateRule::Original,
    UpdateRule::Eigensolution,
];

/// Four modes, stiffness and mass changed together, every entry of both changes at work.
fn four_modes(size: f64) -> ModalChange<f64> {
    let beta = dmatrix![
        0.3, 0.5, -0.4, 0.6;
        0.5, -0.8, 0.9, 0.7;
        -0.4, 0.9, 1.1, -1.3;
        0.6, 0.7, -1.3, 1.7];
    let alpha = dmatrix![
        -0.2, 0.15, 0.1, -0.25;
        0.15, 0.3, -0.2, 0.1;
        0.1, -0.2, 0.25, 0.05;
        -0.25, 0.1, 0.05, -0.1];
    ModalChange::of_vibrations(&dvector![1.0, 2.5, 6.0, 14.0], size * beta, size * alpha)
}

/// Largest relative error of a root and largest error of a shape against the exact solution.
fn errors(perturbed: &Perturbed, exact: &Perturbed) -> (f64, f64) {
    let roots = perturbed
        .roots
        .component_div(&exact.roots)
        .add_scalar(-1.0)
        .amax();
    (roots, (&perturbed.shapes - &exact.shapes).amax())
}

/// Slopes of both errors over change sizes for which every order is above round-off.
fn slopes(rule: UpdateRule) -> (f64, f64) {
    let points: Vec<(f64, f64, f64)> = [0.04, 0.02, 0.01]
        .into_iter()
        .map(|size| {
            let change = four_modes(size);
            let exact = eigensolution_with_mass(&change).expect("separate modes");
            let perturbed = perturb_with_mass(&change, rule).expect("separate modes");
            let (root, shape) = errors(&perturbed, &exact);
            (size, root, shape)
        })
        .collect();
    (
        log_log_slope(&points.iter().map(|p| (p.0, p.1)).collect::<Vec<_>>()),
        log_log_slope(&points.iter().map(|p| (p.0, p.2)).collect::<Vec<_>>()),
    )
}

proptest! {
    #![proptest_config(crate::common::config())]

    /// The general formulae with α = 0, k = 1/λ are the plain ones, order by order.
    #[test]
    fn general_path_is_the_plain_path_for_stiffness_alone(mut change in separate_change(), order in 1..6_usize) {
        change.alpha.fill(0.0);
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        for (general, plain) in [
            (general::first_order(&change)?, recursive::first_order(k, beta)?),
            (general::recursive_1(&change, order)?, recursive::recursive_1(k, beta, order)?),
            (general::recursive_2(&change, order)?, recursive::recursive_2(k, beta, order)?),
            (general::original(&change)?, recursive::original(k, beta)?),
        ] {
            let (root, shape) = errors(&general, &plain);
            prop_assert!(root < ROUND_OFF && shape < MATRIX_ROUND_OFF, "{root:e} {shape:e}");
            prop_assert_eq!(general.order, plain.order);
            prop_assert!(
                general.last_change == plain.last_change
                    || (general.last_change - plain.last_change).abs() < ROUND_OFF
            );
        }
    }

    /// The same through the dispatcher, so that every rule is the function of its name.
    #[test]
    fn rules_with_mass_are_the_plain_rules_for_stiffness_alone(mut change in separate_change()) {
        change.alpha.fill(0.0);
        for rule in EVERY_RULE {
            let general = perturb_with_mass(&change, rule)?;
            let plain = perturb(&change.generalized_stiffness, &change.beta, rule)?;
            let (root, shape) = errors(&general, &plain);
            prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{rule:?} {root:e} {shape:e}");
            // The general recursion waits for a second quiet order in a row.
            let converges = matches!(rule, UpdateRule::Recursive1Converged { .. });
            prop_assert!(general.order == plain.order || (converges && general.order > plain.order));
        }
    }

    /// Mass enters through α: carried to convergence, the recursion solves (k + β)p = ω²(I + α)p.
    #[test]
    fn converged_recursion_is_the_exact_eigensolution_with_mass(change in separate_change()) {
        let converged = perturb_with_mass(&change, UpdateRule::default())?;
        let exact = eigensolution_with_mass(&change)?;
        let (root, shape) = errors(&converged, &exact);
        prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{root:e} {shape:e}");
        prop_assert!(converged.last_change < 1e-13);
    }

    /// More stiffness and as much more mass everywhere: the modes stay as they are, by every rule.
    #[test]
    fn scaling_stiffness_and_mass_alike_changes_nothing(change in separate_change(), scale in -0.5..1.0_f64) {
        let size = change.len();
        let k = change.generalized_stiffness.clone();
        let alike = ModalChange::of_vibrations(
            &k,
            scale * DMatrix::from_diagonal(&k),
            scale * DMatrix::identity(size, size),
        );
        for rule in EVERY_RULE {
            let same = perturb_with_mass(&alike, rule)?;
            let root = same.roots.component_mul(&k).add_scalar(-1.0).amax();
            prop_assert!(root < MATRIX_ROUND_OFF, "{rule:?} {root:e}");
            prop_assert!((same.shapes - DMatrix::identity(size, size)).amax() < MATRIX_ROUND_OFF);
        }
    }

    /// After normalization the shapes are orthonormal in the changed mass.
    #[test]
    fn normalized_shapes_are_orthonormal_in_the_changed_mass(change in separate_change()) {
        let mut shapes = perturb_with_mass(&change, UpdateRule::default())?.shapes;
        normalize_with_mass(&mut shapes, &change.alpha)?;
        let size = change.len();
        let mass = DMatrix::identity(size, size) + &change.alpha;
        let product = shapes.tr_mul(&(mass * &shapes));
        prop_assert!((product - DMatrix::identity(size, size)).amax() < EIGEN_ROUND_OFF);
        prop_assert!((0..size).all(|j| shapes[(j, j)] > 0.0));
    }
}

/// Point masses on a chain of springs: from matrices through the modes to the exact modes of the changed chain.
#[test]
fn mass_added_to_a_chain_lowers_its_frequencies_as_the_eigensolution_says() {
    let stiffness = three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 1.5, 0.8]);
    let modes = corfem::modes::solve(&stiffness, &mass, 3).unwrap();
    let base = LeftRightModes::from(&modes);
    assert_eq!(base.left, base.right);
    assert_eq!(base.right, modes.shapes);
    let share_change = three_mass_chain([0.05, 0.0, 0.0], [0.0, 0.1, -0.2]);
    let mass_change = DMatrix::from_diagonal(&dvector![0.0, 0.15, -0.03]);
    let change = ModalChange::new(&stiffness, &base, &share_change, &mass_change).unwrap();
    assert!((&change.generalized_stiffness - &modes.omega_squared).amax() < MATRIX_ROUND_OFF);
    let converged = perturb_with_mass(&change, UpdateRule::default()).unwrap();
    let exact =
        corfem::modes::solve(&(&stiffness + &share_change), &(&mass + &mass_change), 3).unwrap();
    let found = ascending(converged.roots.map(f64::recip).iter());
    for (found, exact) in found.iter().zip(exact.omega_squared.iter()) {
        assert!(
            (found / exact - 1.0).abs() < EIGEN_ROUND_OFF,
            "{found} {exact}"
        );
    }
    let mut shapes = converged.shapes;
    normalize_with_mass(&mut shapes, &change.alpha).unwrap();
    let mut structural = &modes.shapes * shapes;
    corfem::modes::apply_sign_rule(&mut structural);
    assert!((structural - exact.shapes).amax() < EIGEN_ROUND_OFF);
}

/// A mass added alone: first order is Rayleigh's quotient on the old shapes, (1 + α_ii)/ω_i².
#[test]
fn first_order_is_rayleighs_quotient_on_the_old_shapes() {
    let change = four_modes(0.05);
    let roots = general::first_order(&change).unwrap().roots;
    for i in 0..4 {
        let quotient =
            (1.0 + change.alpha[(i, i)]) / (change.generalized_stiffness[i] + change.beta[(i, i)]);
        assert!((roots[i] / quotient - 1.0).abs() < ROUND_OFF);
    }
}

/// Order r of Recursive 1 leaves an error of order r + 1 in roots and shapes.
#[test]
fn recursive_1_gains_an_order_each_time() {
    for order in 1..=4 {
        let (root, shape) = slopes(UpdateRule::Recursive1 { order });
        let expected = order as f64 + 1.0;
        assert!(root > expected - ORDER_SLACK, "order {order}: roots {root}");
        assert!(
            shape > expected - ORDER_SLACK,
            "order {order}: shapes {shape}"
        );
        assert!(shape < expected + 1.0, "order {order}: shapes {shape}");
    }
}

/// The original formulae: second-order roots (error of order three) with first-order shapes (error of order two).
#[test]
fn original_roots_are_an_order_better_than_their_shapes() {
    let (root, shape) = slopes(UpdateRule::Original);
    assert!((root - 3.0).abs() < 2.0 * ORDER_SLACK, "{root}");
    assert!((shape - 2.0).abs() < ORDER_SLACK, "{shape}");
    let change = four_modes(0.05);
    let original = general::original(&change).unwrap();
    assert_eq!(
        original.roots,
        general::recursive_2(&change, 2).unwrap().roots
    );
    assert_eq!(
        original.shapes,
        general::first_order(&change).unwrap().shapes
    );
    assert_eq!(original.order, 2);
}

/// Recursive 2 solves the rows of the shapes exactly, so its errors fall two orders at a time after the first.
#[test]
fn recursive_2_gains_two_orders_each_time() {
    let (root, shape) = slopes(UpdateRule::Recursive2 { order: 2 });
    assert!((root - 3.0).abs() < 2.0 * ORDER_SLACK, "{root}");
    assert!(shape > 4.0 - ORDER_SLACK, "{shape}");
    let (root, _) = slopes(UpdateRule::Recursive2 { order: 3 });
    assert!(root > 5.0 - ORDER_SLACK, "{root}");
}

/// Scaling the left shapes scales k, α and β of a row alike and must not matter.
#[test]
fn scale_of_the_left_shapes_does_not_matter() {
    let change = four_modes(0.05);
    let scale = DMatrix::from_diagonal(&dvector![2.0, -3.0, 0.5, 7.0]);
    let scaled = ModalChange {
        generalized_stiffness: &scale * &change.generalized_stiffness,
        roots: change.roots.clone(),
        beta: &scale * &change.beta,
        alpha: &scale * &change.alpha,
    };
    for (one, other) in [
        (general::first_order(&change), general::first_order(&scaled)),
        (
            general::recursive_1(&change, 4),
            general::recursive_1(&scaled, 4),
        ),
        (
            general::recursive_2(&change, 3),
            general::recursive_2(&scaled, 3),
        ),
        (general::original(&change), general::original(&scaled)),
    ] {
        let (root, shape) = errors(&one.unwrap(), &other.unwrap());
        assert!(
            root < ROUND_OFF && shape < MATRIX_ROUND_OFF,
            "{root:e} {shape:e}"
        );
    }
}

/// The recursion stops at its tolerance or at its last order, whichever comes first, and says which.
#[test]
fn recursion_stops_at_its_tolerance_or_its_last_order() {
    let change = four_modes(0.1);
    let loose = general::recursive_1_converged(&change, 1e-3, 60).unwrap();
    assert!(loose.order > 3 && loose.last_change < 1e-3);
    let before = general::recursive_1(&change, loose.order - 1).unwrap();
    assert_eq!(before.order, loose.order - 1);
    assert!(before.last_change < 1e-3, "the first quiet order");
    assert!(
        general::recursive_1(&change, loose.order - 2)
            .unwrap()
            .last_change
            >= 1e-3
    );
    let change_of_roots = loose
        .roots
        .component_div(&before.roots)
        .add_scalar(-1.0)
        .amax();
    assert!((loose.last_change - change_of_roots).abs() < ROUND_OFF);
    let short = general::recursive_1_converged(&change, 1e-13, 3).unwrap();
    assert_eq!(short.order, 3);
    assert!(short.last_change > 1e-13);
    assert_eq!(general::first_order(&change).unwrap().order, 1);
    assert_eq!(
        general::first_order(&change).unwrap().last_change,
        f64::INFINITY
    );
    assert_eq!(general::recursive_1(&change, 1).unwrap().order, 1);
    let second = general::recursive_2(&change, 2).unwrap();
    assert_eq!(second.order, 2);
    let first = general::recursive_2(&change, 1).unwrap();
    let change_of_roots = second
        .roots
        .component_div(&first.roots)
        .add_scalar(-1.0)
        .amax();
    assert!((second.last_change - change_of_roots).abs() < ROUND_OFF);
}

/// Two modes coupled by mass alone move their roots in every second order only, and the recursion waits for it.
#[test]
fn quiet_order_between_two_others_does_not_stop_the_recursion() {
    let change = ModalChange::of_vibrations(
        &dvector![1.0, 1.5],
        DMatrix::zeros(2, 2),
        dmatrix![0.0, 0.02; 0.02, 0.0],
    );
    assert_eq!(general::recursive_1(&change, 3).unwrap().last_change, 0.0);
    assert!(general::recursive_1(&change, 4).unwrap().last_change > 1e-7);
    let exact = eigensolution_with_mass(&change).unwrap();
    for rule in [
        UpdateRule::default(),
        UpdateRule::CloseRoots(CloseRootsSettings::default()),
    ] {
        let found = perturb_with_mass(&change, rule).unwrap();
        assert!(errors(&found, &exact).0 < EIGEN_ROUND_OFF, "{rule:?}");
        assert!(found.order > 4);
    }
}

/// A massless motion has λ = 0: a change of stiffness leaves it there, and the recursion comes to rest beside it.
#[test]
fn root_of_a_massless_motion_stays_zero() {
    let change = ModalChange {
        generalized_stiffness: dvector![1.0, 2.0],
        roots: dvector![1.0, 0.0],
        beta: dmatrix![0.1, 0.2; 0.2, 0.3],
        alpha: DMatrix::zeros(2, 2),
    };
    let exact: f64 = {
        // (k + β)x λ = diag(1, 0)x: λ is the first entry of the flexibility.
        let flexibility = dmatrix![1.1, 0.2; 0.2, 2.3].try_inverse().unwrap();
        flexibility[(0, 0)]
    };
    let converged = general::recursive_1_converged(&change, 1e-14, 60).unwrap();
    assert!((converged.roots[0] / exact - 1.0).abs() < ROUND_OFF);
    assert_eq!(converged.roots[1], 0.0);
    assert!(converged.order < 60);
}

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
        Err(Error::CoalescingModes { first: 2, second: 1, separation }) if (separation / 0.5e-9 - 1.0).abs() < 1e-3
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
            eigensolution_with_mass(&change),
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
    assert!(good.len() == 4 && !good.is_empty());
}

#[test]
fn stiffness_nearly_lost_is_named_with_what_is_left_of_it() {
    let mut change = four_modes(0.05);
    change.beta[(3, 3)] = -14.0 * (1.0 - 1e-10);
    assert!(matches!(
        general::first_order(&change),
        Err(Error::LostStiffness { mode: 3, ratio }) if (ratio / 1e-10 - 1.0).abs() < 1e-3
    ));
    change.beta[(3, 3)] = -14.0 * (1.0 - 1e-3);
    assert!(general::first_order(&change).is_ok());
}

#[test]
fn order_zero_is_refused() {
    let change = four_modes(0.05);
    for result in [
        general::recursive_1(&change, 0),
        general::recursive_1_converged(&change, 1e-6, 0),
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
fn root_that_loses_its_sign_is_refused_for_vibrations() {
    let mut change = four_modes(0.0);
    change.alpha[(1, 1)] = -1.5;
    let root = general::first_order(&change).unwrap().roots[1];
    assert!((root + 0.5 / 2.5).abs() < ROUND_OFF);
    for rule in [
        UpdateRule::FirstOrder,
        UpdateRule::Original,
        UpdateRule::default(),
        UpdateRule::Recursive2 { order: 2 },
    ] {
        assert!(matches!(
            perturb_with_mass(&change, rule),
            Err(Error::LostRoot { mode: 1, value }) if (value - root).abs() < ROUND_OFF
        ));
    }
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

/// The eigensolution keeps each mode in its place with unit own component, with mass as without.
#[test]
fn eigensolution_with_mass_continues_every_mode() {
    let change = four_modes(0.1);
    let exact = eigensolution_with_mass(&change).unwrap();
    assert_eq!(exact.shapes.shape(), (4, 4));
    assert!((0..4).all(|j| exact.shapes[(j, j)] == 1.0));
    assert_eq!((exact.order, exact.last_change), (0, 0.0));
    let stiffness = DMatrix::from_diagonal(&change.generalized_stiffness) + &change.beta;
    let mass = DMatrix::identity(4, 4) + &change.alpha;
    let residual =
        stiffness * &exact.shapes * DMatrix::from_diagonal(&exact.roots) - mass * &exact.shapes;
    assert!(residual.amax() < EIGEN_ROUND_OFF);
    let plain = eigensolution(&change.generalized_stiffness, &change.beta).unwrap();
    assert!((plain.roots - exact.roots).amax() > 1e-3);
}
