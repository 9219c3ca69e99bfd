//! Derivatives of many parameters side by side: each is what its definition gives for it alone.

use crate::common::tolerances::{DERIVATIVE_ROUND_OFF, ROUND_OFF};
use approx::assert_relative_eq;
use corfem::cases::Case;
use corfem::method::appendix_c::{ModalChange, Perturbed, UpdateRule, first_order_held};
use corfem::method::derivatives::{DERIVATIVE_STEP, HELD_SEPARATION, error_derivatives};
use corfem::method::error::Error;
use corfem::method::error_sum::errors;
use corfem::method::modal::{DynamicModel, ModalProblem, ModalState, Share};
use corfem::method::modes::{Modes, solve};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

const SIZE: usize = 5;

/// A model with parameters of either kind and any rank, and test modes that it nearly has.
#[derive(Debug, Clone)]
struct Drawn {
    model: DynamicModel,
    test: Modes,
    analysis_modes: usize,
}

/// One to twenty parameters, so that blocks are full, broken off, and several; ranks from none to full; stiffness well
/// above them on a diagonal of separate entries, so that no modes come close.
fn drawn() -> impl Strategy<Value = Drawn> {
    let entries = prop::collection::vec(-0.4..0.4_f64, SIZE * SIZE);
    let parameter = (0..=SIZE, any::<bool>(), entries, 0.9..1.1_f64);
    let parameters = prop::collection::vec(parameter, 1..=20);
    (
        parameters,
        prop::collection::vec(0.8..1.25_f64, SIZE),
        1..=SIZE,
        1..=SIZE,
    )
        .prop_map(|(parameters, masses, one, other)| {
            let mut mass = DMatrix::from_diagonal(&DVector::from_vec(masses));
            let mut stiffness = DMatrix::from_diagonal(&DVector::from_fn(SIZE, |i, _| {
                50.0 * (i as f64 + 1.0).powi(2)
            }));
            let (mut true_mass, mut true_stiffness) = (mass.clone(), stiffness.clone());
            let mut shares = Vec::new();
            for (rank, is_mass, entries, factor) in parameters {
                let vectors = DMatrix::from_column_slice(SIZE, rank, &entries[..SIZE * rank]);
                let share = &vectors * vectors.transpose();
                if is_mass {
                    // Twenty full ones weigh no more than the structure.
                    let share = 0.05 * share;
                    mass += &share;
                    true_mass += factor * &share;
                    shares.push(Share::Mass(share));
                } else {
                    stiffness += &share;
                    true_stiffness += factor * &share;
                    shares.push(Share::Stiffness(share));
                }
            }
            let all = solve(&true_stiffness, &true_mass, SIZE).expect("positive definite");
            Drawn {
                test: all.lowest(one.min(other)).expect("fewer than there are"),
                analysis_modes: one.max(other),
                model: DynamicModel {
                    stiffness,
                    mass,
                    shares,
                },
            }
        })
}

/// The error sum's change by first order, one parameter alone: (C.20, C.21) with close modes held.
fn by_definition(problem: &ModalProblem, state: &ModalState, parameter: usize) -> f64 {
    let k = &state.modes.omega_squared;
    let present = &state.generalized_shapes;
    let share = &problem.generalized_shares[parameter];
    let size = DERIVATIVE_STEP * state.factors[parameter];
    let change = size * present.tr_mul(&(share.matrix() * present));
    let none = DMatrix::zeros(k.len(), k.len());
    let (beta, alpha) = match share {
        Share::Stiffness(_) => (change, none),
        Share::Mass(_) => (none, change),
    };
    let change = ModalChange::of_vibrations(k, beta, alpha);
    let Perturbed { roots, shapes, .. } =
        first_order_held(&change, HELD_SEPARATION).expect("roots kept");
    let modes = Modes {
        omega_squared: roots.map(f64::recip),
        shapes: &state.modes.shapes * shapes,
    };
    errors(&modes, &state.pairing, &problem.test).sum() - state.errors.sum()
}

fn assert_by_definition(problem: &ModalProblem, state: &ModalState) {
    let found = error_derivatives(problem, state).expect("separate modes");
    assert_eq!(found.error_change.len(), problem.parameter_count());
    for (e, &change) in found.error_change.iter().enumerate() {
        let expected = by_definition(problem, state, e);
        let error = (change - expected).abs();
        assert!(
            error <= DERIVATIVE_ROUND_OFF,
            "{e}: {change:e} {expected:e}"
        );
    }
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn each_derivative_is_that_of_its_definition(drawn in drawn()) {
        let problem = ModalProblem::new(&drawn.model, &drawn.test, drawn.analysis_modes).unwrap();
        assert_by_definition(&problem, &problem.start_state().unwrap());
    }

    #[test]
    fn a_derivative_does_not_depend_on_those_beside_it(drawn in drawn(), turn in 0..20_usize) {
        let derivatives = |model: &DynamicModel| {
            let problem = ModalProblem::new(model, &drawn.test, drawn.analysis_modes).unwrap();
            error_derivatives(&problem, &problem.start_state().unwrap()).unwrap().error_change
        };
        let mut turned = drawn.model.clone();
        let turn = turn % turned.shares.len();
        turned.shares.rotate_left(turn);
        let mut expected = derivatives(&drawn.model);
        expected.rotate_left(turn);
        // To the last bit.
        prop_assert_eq!(derivatives(&turned), expected);
    }
}

proptest! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn derivatives_of_the_box_away_from_its_start_are_those_of_their_definition(
        case in 1..=4_usize,
        factors in prop::collection::vec(0.9..1.1_f64, 15),
    ) {
        let case = Case::new(case).unwrap();
        let dynamic = case.model().unwrap().analyze(&[1.0; 15]).unwrap();
        let test = case.test_modes().unwrap();
        let problem = ModalProblem::new(&dynamic, &test, test.len()).unwrap();
        let state = problem.state_at(factors, UpdateRule::Eigensolution).unwrap();
        assert_by_definition(&problem, &state);
    }
}

/// Two separate oscillators of ω² = 1 and 4, and a share of the second.
fn oscillators(share: Share) -> ModalProblem {
    let stiffness = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 4.0]));
    let mass = DMatrix::identity(2, 2);
    let test = solve(&stiffness, &mass, 2).expect("solved");
    let model = DynamicModel {
        stiffness,
        mass,
        shares: vec![share],
    };
    ModalProblem::new(&model, &test, 2).expect("a problem")
}

#[test]
fn a_lost_root_is_named() {
    let mut share = DMatrix::zeros(2, 2);
    // A thousandth of it is −6, which leaves −2 of the second mode's 4: a root of −1/2.
    share[(1, 1)] = -6000.0;
    let problem = oscillators(Share::Stiffness(share));
    match error_derivatives(&problem, &problem.start_state().unwrap()) {
        Err(Error::LostRoot { mode, value }) => {
            assert_eq!(mode, 1);
            assert!((value + 0.5).abs() < ROUND_OFF, "{value}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_root_lost_to_a_mass_is_named() {
    let mut share = DMatrix::zeros(2, 2);
    // The whole mass is one and the share takes more than that away: of the second root, 1/4, it leaves −1/4.
    share[(1, 1)] = -2000.0;
    let problem = oscillators(Share::Mass(share));
    match error_derivatives(&problem, &problem.start_state().unwrap()) {
        Err(Error::LostRoot { mode, value }) => {
            assert_eq!(mode, 1);
            assert!((value + 0.25).abs() < ROUND_OFF, "{value}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn modes_that_a_change_brings_together_are_held() {
    // A hundredth of ω² apart after a thousandth of the share, and a little less or more.
    for (second, is_held) in [(1.0, true), (1.0 / 0.9899, false), (1.0 / 0.9901, true)] {
        let mut share = DMatrix::zeros(2, 2);
        let coupling = 1.0;
        share[(1, 1)] = 1000.0 * (second - 4.0);
        share[(0, 1)] = coupling;
        share[(1, 0)] = coupling;
        let problem = oscillators(Share::Stiffness(share));
        let state = problem.start_state().unwrap();
        assert_by_definition(&problem, &state);
        let found = error_derivatives(&problem, &state).unwrap().error_change[0];
        // Held, the shapes are those of the test, and the error is that of the second frequency.
        let of_frequency = 1.0 - (second / 4.0).sqrt();
        if is_held {
            assert_relative_eq!(found, of_frequency, epsilon = ROUND_OFF);
        } else {
            assert!(found > 1.1 * of_frequency, "{found} {of_frequency}");
        }
    }
}

/// Two equal oscillators and a third of four times their ω², and shares that see the equal ones.
fn repeated(share: fn(DMatrix<f64>) -> Share) -> ModalProblem {
    let of = |entries: &[f64; 3]| DMatrix::from_diagonal(&DVector::from_row_slice(entries));
    let stiffness = of(&[1.0, 1.0, 4.0]);
    let mass = DMatrix::identity(3, 3);
    let test = solve(&of(&[1.1, 1.2, 4.4]), &mass, 3).expect("solved");
    let model = DynamicModel {
        shares: vec![share(of(&[1.0, 0.0, 0.0])), share(of(&[1.0, 1.0, 1.0]))],
        stiffness,
        mass,
    };
    ModalProblem::new(&model, &test, 3).expect("a problem")
}

#[test]
fn a_repeated_root_has_derivatives() {
    for (share, sign) in [
        (Share::Stiffness as fn(DMatrix<f64>) -> Share, 1.0),
        (Share::Mass, -1.0),
    ] {
        let problem = repeated(share);
        let state = problem.start_state().unwrap();
        assert_by_definition(&problem, &state);
        let found = error_derivatives(&problem, &state).unwrap().error_change;
        // Shapes stay, so the error is that of the frequencies, with ω² as the share changes it.
        let error = |factors: [f64; 3]| {
            let ratios = [1.1, 1.2, 4.4].iter().zip([1.0, 1.0, 4.0]).zip(factors);
            ratios
                .map(|((test, start), factor)| ((start * factor / test).sqrt() - 1.0).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let up = 1.0 + DERIVATIVE_STEP;
        let (one, all) = if sign > 0.0 {
            ([up, 1.0, 1.0], [up; 3])
        } else {
            // A mass of one changes alike in every oscillator; the third's share is its whole mass too.
            ([1.0 / up, 1.0, 1.0], [1.0 / up; 3])
        };
        let all = if sign > 0.0 {
            [up, up, 1.0 + 0.25 * DERIVATIVE_STEP]
        } else {
            all
        };
        for (found, factors) in found.iter().zip([one, all]) {
            assert_relative_eq!(
                *found,
                error(factors) - error([1.0; 3]),
                epsilon = ROUND_OFF
            );
        }
    }
}
