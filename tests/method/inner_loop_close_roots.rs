//! The inner loop where roots are close or repeated: which rule can follow them, and what the others say.

use crate::common::tolerances::{
    FIRST_FACTOR, ROUND_OFF, STOPPED_FACTOR, STOPPED_FACTOR_BY_DEFAULT,
};
use corfem::method::appendix_c::{CloseRootsSettings, LARGEST_UNSETTLED_CHANGE, UpdateRule};
use corfem::method::error::Error;
use corfem::method::inner_loop::{InnerSettings, Stop, run};
use corfem::method::modal::{DynamicModel, ModalProblem, Share};
use corfem::method::modes::solve;
use corfem::method::outer_loop::{Settings, correlate};
use nalgebra::{DMatrix, dmatrix};

/// Two like oscillators side by side, stiffened together: a repeated root from the first to the last iteration.
#[test]
fn repeated_roots_are_corrected_by_the_rule_that_holds_them() {
    let stiffness = DMatrix::identity(2, 2) * 100.0;
    let model = DynamicModel {
        shares: vec![Share::Stiffness(stiffness.clone())],
        mass: DMatrix::identity(2, 2),
        stiffness,
    };
    let test = solve(&(1.3 * &model.stiffness), &model.mass, 2).unwrap();
    let problem = ModalProblem::new(&model, &test, 2).unwrap();
    let by = |update| {
        let settings = InnerSettings {
            update,
            tolerance: 1e-3,
            ..InnerSettings::default()
        };
        run(&problem, &[1.0], &[None], &settings)
    };
    let corrected = by(UpdateRule::CloseRoots(CloseRootsSettings::default())).unwrap();
    assert_eq!(corrected.stop, Stop::Tolerance);
    assert!((corrected.last.factors[0] / 1.3 - 1.0).abs() < STOPPED_FACTOR);
    // The recursions divide by the roots' distance.
    assert!(matches!(
        by(UpdateRule::default()),
        Err(Error::CoalescingModes { .. })
    ));
}

/// Two oscillators of nearly the same stiffness, and a share that couples them; of it the test structure has `missing` more.
fn coupled(missing: f64) -> ModalProblem {
    let stiffness = dmatrix![100.0, 0.0; 0.0, 101.0];
    let coupling = dmatrix![1.0, 1.0; 1.0, 1.0];
    let mass = DMatrix::identity(2, 2);
    let test = solve(&(&stiffness + missing * &coupling), &mass, 2).unwrap();
    let model = DynamicModel {
        shares: vec![Share::Stiffness(coupling)],
        stiffness,
        mass,
    };
    ModalProblem::new(&model, &test, 2).unwrap()
}

/// Coupled by much more than their distance: the recursion leaps about.
#[test]
fn roots_that_do_not_settle_are_an_error_and_not_an_answer() {
    let problem = coupled(20.0);
    let at = |update| problem.state_at(vec![1.6], update);
    let exact = at(UpdateRule::Eigensolution).unwrap();
    for orders in [2, 3] {
        let rule = UpdateRule::Recursive1Converged {
            tolerance: 1e-13,
            orders,
        };
        match at(rule) {
            Err(Error::UnsettledRoots {
                largest,
                orders: most,
                last_change,
            }) => {
                assert_eq!((largest, most), (LARGEST_UNSETTLED_CHANGE, orders));
                assert!(last_change > largest);
            }
            other => panic!("{other:?}"),
        }
        // To a fixed order, an order is all that was asked for.
        assert!(at(UpdateRule::Recursive1 { order: orders }).is_ok());
        // A tolerance of one's own above the limit counts.
        let coarse = UpdateRule::Recursive1Converged {
            tolerance: 0.5,
            orders,
        };
        assert!(at(coarse).is_ok());
    }
    let held = at(UpdateRule::CloseRoots(CloseRootsSettings::default())).unwrap();
    assert!((held.errors.sum() - exact.errors.sum()).abs() < ROUND_OFF);
    let without_blocks = UpdateRule::CloseRoots(CloseRootsSettings {
        separation: 0.0,
        orders: 3,
        ..CloseRootsSettings::default()
    });
    assert!(matches!(
        at(without_blocks),
        Err(Error::UnsettledRoots { orders: 3, .. })
    ));
    // In the loop such a step is halved; when none settles, the first is an error.
    let by = |orders, halvings| {
        let settings = InnerSettings {
            halvings,
            update: UpdateRule::Recursive1Converged {
                tolerance: 1e-13,
                orders,
            },
            ..InnerSettings::default()
        };
        run(&problem, &[1.0], &[None], &settings)
    };
    assert!(matches!(by(2, 0), Err(Error::UnsettledRoots { .. })));
    let halved = by(6, 5).unwrap();
    assert!(halved.iterations[0].halvings > 0);
}

/// A long step does not settle and a short one goes uphill: there is a place to stand, and no error.
#[test]
fn a_step_uphill_among_unsettled_ones_is_a_local_minimum() {
    // A thousandth of the share is missing, and the first step asks for fifty times that.
    let problem = coupled(1e-3);
    let with_halvings = |halvings| {
        let settings = InnerSettings {
            first_relaxation: 100.0,
            halvings,
            update: UpdateRule::Recursive1Converged {
                tolerance: 1e-13,
                orders: 2,
            },
            ..InnerSettings::default()
        };
        run(&problem, &[1.0], &[None], &settings)
    };
    assert!(matches!(
        with_halvings(2),
        Err(Error::UnsettledRoots { .. })
    ));
    let stopped = with_halvings(3).unwrap();
    assert!((stopped.first_unlimited_factors[0] - 1.05).abs() < FIRST_FACTOR);
    assert_eq!(stopped.stop, Stop::LocalMinimum);
    assert!(stopped.iterations.is_empty());
}

/// A model whose modes fall together is an error at the start, and later the end of a correlation that keeps its passes.
#[test]
fn modes_that_fall_together_end_a_correlation_begun() {
    let of = |first: f64, second: f64| {
        let stiffness = dmatrix![first, 0.0; 0.0, second];
        DynamicModel {
            shares: vec![Share::Stiffness(stiffness.clone())],
            mass: DMatrix::identity(2, 2),
            stiffness,
        }
    };
    let (apart, together) = (of(100.0, 400.0), of(100.0, 100.0));
    let test = solve(&(1.3 * &apart.stiffness), &apart.mass, 2).unwrap();
    let run = |models: [&DynamicModel; 2]| {
        let mut analyses = 0;
        let analyze = |_: &[f64]| {
            analyses += 1;
            Ok(models[usize::from(analyses > 1)].clone())
        };
        correlate(analyze, &test, &[None], &Settings::default(), |_, _| {})
    };
    assert!(matches!(
        run([&together, &apart]),
        Err(Error::CoalescingModes { .. })
    ));
    let found = run([&apart, &together]).unwrap();
    assert_eq!(found.passes.len(), 1);
    assert!((found.passes[0].factors[0] / 1.3 - 1.0).abs() < STOPPED_FACTOR_BY_DEFAULT);
    assert!(!found.converged);
    assert_eq!(run([&apart, &apart]).unwrap().passes.len(), 10);
}
