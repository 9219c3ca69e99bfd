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
    let by = |halvings| {
        let factor_range = Bounds {
            lower: 0.05,
            upper: 8.0,
        };
        let settings = InnerSettings {
            halvings,
            first_relaxation: 1e3,
            factor_range,
            ..InnerSettings::default()
        };
        let settings = inner_for_modes(settings, 2);
        run(&problem, &[1.0], &[None], &settings)
    };
    assert!(matches!(by(0), Err(Error::UnsettledRoots { .. })));
    let halved = by(20).unwrap();
    assert!(halved.iterations[0].halvings > 0);
}
