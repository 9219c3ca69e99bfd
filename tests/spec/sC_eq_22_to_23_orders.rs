//! Orders of approximation of Appendix C: by log-log slope with changes of mass, and when the recursion stops.
//!
//! With ε the size of the change relative to the stiffness, the relative errors of roots and the errors of shapes are
//! O(ε^s) with the s below, by expansion and by measurement. Two modes alone do better: there a shape is exact but
//! for its root, and the theorem is in `sC_eq_20_two_dof`.
//!
//! | rule | roots | shapes |
//! |---|---|---|
//! | first order | 2 | 2 |
//! | original | 3 | 2 |
//! | Recursive 1, order r | r + 1 | r + 1 |
//! | Recursive 2, order r ≥ 2 | 2r − 1 | 2r |

use crate::common::appendix_c::errors;
use crate::prelude::*;

fn pencil_of(change: &ModalChange) -> Pencil<f64> {
    change.pencil().expect("a pencil")
}

/// Slopes of both errors over change sizes for which every order is above round-off.
fn slopes(rule: impl Fn(&Pencil<f64>) -> Result<Perturbed, Error>) -> (f64, f64) {
    let points: Vec<(f64, f64, f64)> = [0.04, 0.02, 0.01]
        .into_iter()
        .map(|size| {
            let change = four_modes(size);
            let exact = eigensolution(&change).expect("separate modes");
            let perturbed = rule(&pencil_of(&change)).expect("separate modes");
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
        let (root, shape) = slopes(|pencil| pencil.recursive_1(order));
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
    let (root, shape) = slopes(Pencil::original);
    assert!((root - 3.0).abs() < 2.0 * ORDER_SLACK, "{root}");
    assert!((shape - 2.0).abs() < ORDER_SLACK, "{shape}");
    let pencil = pencil_of(&four_modes(0.05));
    let original = pencil.original().unwrap();
    assert_eq!(original.roots, pencil.recursive_2(2).unwrap().roots);
    assert_eq!(original.shapes, pencil.first_order().unwrap().shapes);
}

/// Recursive 2 solves the rows of the shapes exactly, so its errors fall two orders at a time after the first.
#[test]
fn recursive_2_gains_two_orders_each_time() {
    let (root, shape) = slopes(|pencil| pencil.recursive_2(2));
    assert!((root - 3.0).abs() < 2.0 * ORDER_SLACK, "{root}");
    assert!(shape > 4.0 - ORDER_SLACK, "{shape}");
    let (root, _) = slopes(|pencil| pencil.recursive_2(3));
    assert!(root > 5.0 - ORDER_SLACK, "{root}");
}

/// The recursion stops after two quiet orders in a row and is the recursion of the order it names.
#[test]
fn recursion_stops_at_the_second_quiet_order() {
    let pencil = pencil_of(&four_modes(0.2));
    let of_order = |order| pencil.recursive_1(order).unwrap();
    let moved_by = |order| largest_change(&of_order(order).roots, &of_order(order - 1).roots);
    let settled = pencil.recursive_1_converged().unwrap();
    assert!(settled.order > 4 && settled.last_change < ROOT_TOLERANCE);
    assert_eq!(settled.perturbed, of_order(settled.order));
    assert!((settled.last_change - moved_by(settled.order)).abs() < ROUND_OFF);
    assert!(
        moved_by(settled.order - 1) < ROOT_TOLERANCE,
        "the first quiet order"
    );
    assert!(moved_by(settled.order - 2) >= ROOT_TOLERANCE);
}

/// At its last order it stops too: without an error when the roots hardly moved in it, with one that says how far otherwise.
#[test]
fn recursion_stops_at_its_last_order() {
    let moved_by = |pencil: &Pencil<f64>| {
        let of_order = |order| pencil.recursive_1(order).unwrap().roots;
        largest_change(&of_order(MOST_ORDERS), &of_order(MOST_ORDERS - 1))
    };
    let pencil = pencil_of(&four_modes(0.7));
    match pencil.recursive_1_converged() {
        Err(Error::UnsettledRoots {
            orders,
            last_change,
        }) => {
            assert_eq!(orders, MOST_ORDERS);
            assert!((last_change - moved_by(&pencil)).abs() < ROUND_OFF);
            assert!(last_change > LARGEST_UNSETTLED_CHANGE);
        }
        other => panic!("{other:?}"),
    }
    let pencil = pencil_of(&four_modes(0.63));
    let settled = pencil.recursive_1_converged().unwrap();
    assert_eq!(settled.order, MOST_ORDERS);
    assert!((settled.last_change - moved_by(&pencil)).abs() < ROUND_OFF);
    assert!((ROOT_TOLERANCE..LARGEST_UNSETTLED_CHANGE).contains(&settled.last_change));
}

/// Two modes coupled by mass alone move their roots in every second order only, and the recursion waits for it.
#[test]
fn quiet_order_between_two_others_does_not_stop_the_recursion() {
    let change = ModalChange::of_vibrations(
        &dvector![1.0, 1.5],
        DMatrix::zeros(2, 2),
        dmatrix![0.0, 0.02; 0.02, 0.0],
    );
    let pencil = pencil_of(&change);
    let of_order = |order| pencil.recursive_1(order).unwrap().roots;
    assert_eq!(of_order(3), of_order(2));
    assert!(largest_change(&of_order(4), &of_order(3)) > 1e-7);
    let exact = eigensolution(&change).unwrap();
    let found = pencil.recursive_1_converged().unwrap();
    assert!(errors(&found.perturbed, &exact).0 < EIGEN_ROUND_OFF);
    assert!(found.order > 4);
}

/// A massless motion has λ = 0: a change of stiffness leaves it there, and the recursion comes to rest beside it.
#[test]
fn root_of_a_massless_motion_stays_zero() {
    let modes = LeftRightModes {
        roots: dvector![1.0, 0.0],
        right: DMatrix::identity(2, 2),
        left: DMatrix::identity(2, 2),
    };
    let (stiffness, change) = (dmatrix![1.0, 0.0; 0.0, 2.0], dmatrix![0.1, 0.2; 0.2, 0.3]);
    let pencil = Pencil::new(&stiffness, &modes, &change, &DMatrix::zeros(2, 2)).unwrap();
    let exact: f64 = {
        // (k + β)x λ = diag(1, 0)x: λ is the first entry of the flexibility.
        let flexibility = dmatrix![1.1, 0.2; 0.2, 2.3].try_inverse().unwrap();
        flexibility[(0, 0)]
    };
    let converged = pencil.recursive_1_converged().unwrap();
    assert!((converged.perturbed.roots[0] / exact - 1.0).abs() < ROUND_OFF);
    assert_eq!(converged.perturbed.roots[1], 0.0);
    assert!(converged.order < MOST_ORDERS);
}

properties! {
    #[test]
    fn the_first_order_root_errs_by_the_second_order_term(change in full_change(4)) {
        // Rayleigh and Schroedinger: 1/γ_i = k_i + β_ii − Σ_j β_ij²/(k_j − k_i) + O(ε³).
        let size = 1e-4;
        let (k, beta) = (&change.stiffness, change.beta(size));
        let first = first_order(k, &beta).unwrap();
        let second = original(k, &beta).unwrap();
        for i in 0..4 {
            let term: f64 = (0..4)
                .filter(|&j| j != i)
                .map(|j| beta[(i, j)].powi(2) / (k[j] - k[i]))
                .sum();
            let series = k[i] + beta[(i, i)] - term;
            let bound = SECOND_ORDER_REMAINDER * size.powi(3) * k.amax();
            prop_assert!((1.0 / second.roots[i] - series).abs() <= bound);
            prop_assert!((1.0 / first.roots[i] - term - series).abs() <= bound);
        }
    }

    #[test]
    fn every_order_of_recursive_1_is_nearer_the_eigensolution(change in full_change(4)) {
        let beta = change.beta(0.004);
        let exact = exact(&change.stiffness, &beta).unwrap();
        let mut before = errors(&first_order(&change.stiffness, &beta).unwrap(), &exact);
        for order in 2..=4 {
            let found = recursive_1(&change.stiffness, &beta, order).unwrap();
            let now = errors(&found, &exact);
            prop_assert!(now.0 <= before.0 && now.1 <= before.1, "{order}: {now:?} {before:?}");
            before = now;
        }
    }
}
