//! Orders of approximation of Appendix C with mass changes: by log-log slope, and when the recursion stops.

use crate::common::appendix_c::{errors, four_modes};
use crate::common::log_log_slope;
use crate::common::tolerances::{EIGEN_ROUND_OFF, ORDER_SLACK, ROUND_OFF};
use corfem::method::appendix_c::{
    CloseRootsSettings, ModalChange, UpdateRule, eigensolution_with_mass, general,
    perturb_with_mass,
};
use nalgebra::{DMatrix, dmatrix, dvector};

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
