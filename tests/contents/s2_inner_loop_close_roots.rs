//! The inner loop where roots are close or repeated: an eigensolution can follow them, and the recursion says that it cannot.

use crate::prelude::*;

/// Two like oscillators side by side, stiffened together: a repeated root from the first to the last iteration.
#[test]
fn repeated_roots_that_nothing_couples_are_corrected_by_recursion_and_eigensolution() {
    let stiffness = eye(2) * 100.0;
    let model = DynamicModel {
        shares: vec![stiffness.clone()],
        mass: eye(2),
        stiffness,
    };
    let test = solve(&(1.3 * &model.stiffness), &model.mass, 2).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    let settings = InnerSettings {
        tolerance: 1e-3,
        ..InnerSettings::default()
    };
    let settings = inner_for_modes(settings, 2);
    let exactly = Eigensolved(problem.clone());
    let analyses: [&dyn Analysis; 2] = [&problem, &exactly];
    for analysis in analyses {
        let corrected = run(analysis, &[1.0], &[None], &settings).unwrap();
        assert_eq!(corrected.stop, Stop::Tolerance);
        assert!(relative_error(corrected.last.share_factors[0], 1.3) < STOPPED_FACTOR);
    }
}

/// Two oscillators of nearly the same stiffness, and a share that couples them; of it the test structure has `missing` more.
fn coupled(missing: f64) -> ModalModel {
    let stiffness = dmatrix![100.0, 0.0; 0.0, 101.0];
    let coupling = dmatrix![1.0, 1.0; 1.0, 1.0];
    let mass = eye(2);
    let test = solve(&(&stiffness + missing * &coupling), &mass, 2).unwrap();
    let model = DynamicModel {
        shares: vec![coupling],
        stiffness,
        mass,
    };
    model.analyze(&test, Some(2)).unwrap()
}

/// Coupled by much more than their distance: the recursion leaps about, and the eigensolution does not.
#[test]
fn roots_that_do_not_settle_are_an_error_and_not_an_answer() {
    let problem = coupled(20.0);
    match problem.at(&[8.0]) {
        Err(Error::UnsettledRoots {
            orders, root_error, ..
        }) => {
            assert_eq!(orders, MOST_ORDERS);
            assert!(root_error > LARGEST_ROOT_ERROR);
        }
        other => panic!("{other:?}"),
    }
    let exact = Eigensolved(problem.clone()).at(&[8.0]).unwrap();
    // The roots of 107, 7; 7, 108.
    for (found, side) in exact.modes.omega_squared().iter().zip([-1.0, 1.0]) {
        assert_alike([found], [(107.5 + side * 49.25_f64.sqrt())], ROUND_OFF);
    }
    // In the loop such a step is halved; when none settles, the first is an error.
    let by = |halvings| run(&problem, &[1.0], &[None], &far(halvings).inner);
    assert!(matches!(by(0), Err(Error::UnsettledRoots { .. })));
    let halved = by(20).unwrap();
    assert!(halved.iterations[0].halvings > 0);
}

/// Steps to eight times the stiffness at once, and their halvings.
fn far(halvings: usize) -> Settings {
    let inner = InnerSettings {
        halvings,
        first_relaxation: 1e3,
        factor_range: Bounds {
            lower: 0.05,
            upper: 8.0,
        },
        ..InnerSettings::default()
    };
    let settings = Settings {
        inner,
        ..Settings::default()
    };
    settings.for_modes(2)
}

/// Roots settle at 2.75 of the share, uphill of the start, and not at 8 and 4.5.
#[test]
fn a_step_that_is_uphill_after_those_that_did_not_settle_is_a_local_minimum() {
    let found = run(&coupled(0.3), &[1.0], &[None], &far(2).inner).unwrap();
    assert_eq!(found.stop, Stop::LocalMinimum);
    assert!(found.iterations.is_empty());
}

/// The first analysis may be of a spring that lacks seven times its stiffness, which one step finds.
#[test]
fn modes_that_cannot_be_followed_are_an_error_in_the_first_pass_and_the_end_in_a_later_one() {
    let spring = DynamicModel {
        stiffness: eye(1),
        mass: eye(1),
        shares: vec![eye(1)],
    };
    let test = Modes::new(dvector![8.0], eye(1)).unwrap();
    let followed = spring.analyze(&test, None).unwrap();
    let by = |analyses: &[ModalModel]| {
        let mut analyses = analyses.iter().cloned();
        let analyze = |_: &[f64]| Ok::<_, Error>(analyses.next().unwrap());
        correlate(analyze, &[None], &far(0), |_, _| true)
    };
    let first = by(&[coupled(20.0)]);
    assert!(matches!(first, Err(Error::UnsettledRoots { .. })));
    let later = by(&[followed, coupled(20.0)]).unwrap();
    assert_eq!((later.passes.len(), later.converged), (1, false));
}

/// Recursive 1 leads the first two modes to one here, and would miss the other.
#[test]
fn two_modes_that_are_led_to_one_are_named() {
    let change = dmatrix![2.0, 1.0, 2.0; 1.0, 0.5, 1.0; 2.0, 1.0, 2.0];
    let found = recursive_1_converged(&dvector![1.0, 2.0, 4.0], &change);
    match found {
        Err(Error::CoalescingModes {
            first: 0,
            second: 1,
            separation,
        }) => assert!(separation < EIGEN_ROUND_OFF, "{separation}"),
        other => panic!("{other:?}"),
    }
}

/// Units of four times the size scale every number by a power of two, which rounds nothing.
#[test]
fn the_bound_on_the_error_of_roots_has_no_units() {
    let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
    let bound = |unit: f64| {
        let found = recursive_1_converged(&(unit * &k), &(unit * &beta));
        found.unwrap().root_error
    };
    assert!(bound(1.0) > 0.0);
    assert_eq!(bound(4.0), bound(1.0));
}
