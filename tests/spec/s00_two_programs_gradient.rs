//! The packed gradient of `sparse` is the plain one of `method` (12).

use crate::common::boxes::first_problem;
use crate::common::tolerances::SAME_GRADIENT;
use crate::common::vibrations::chain_and_truth;
use corfem::method::derivatives::{DerivativeRule, error_changes, gradient};
use corfem::method::error::Error;
use corfem::method::error_sum::ModeWeight;
use corfem::method::model::{DynamicModel, ModalModel, ParameterMatrix};
use corfem::method::modes::ModeSet;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::sparse::{PackedModel, derivative};
use corfem::torque_box::CASES;
use nalgebra::{DMatrix, dmatrix, dvector};
use proptest::prelude::*;

/// The largest difference of two lists relative to the largest number of the first.
fn distance(plain: &[f64], packed: &[f64]) -> f64 {
    assert_eq!(plain.len(), packed.len());
    let differences = plain.iter().zip(packed).map(|(a, b)| (a - b).abs());
    let largest = plain
        .iter()
        .fold(f64::MIN_POSITIVE, |largest, slope| largest.max(slope.abs()));
    differences.fold(0.0, f64::max) / largest
}

fn assert_same(model: &ModalModel, state: &ModalState) {
    let plain = gradient(model, state).expect("a gradient");
    let packed = PackedModel::new(model).gradient(state).expect("a gradient");
    let distance = distance(&plain, &packed);
    assert!(
        distance <= SAME_GRADIENT,
        "{distance:e}: {plain:?} {packed:?}"
    );
}

properties! {
    #![proptest_config(crate::common::config())]

    /// Of any number of modes, some of the parameters masses, at the exact modes and away from them, with weights.
    #[test]
    fn the_packed_gradient_is_the_plain_one(
        (chain, truth) in chain_and_truth(),
        analysis_modes in 3..=5_usize,
        factors in prop::collection::vec(0.95..1.05_f64, 10),
        moved in any::<bool>(),
        weights in prop::collection::vec((0.0..2.0_f64, 0.1..2.0_f64), 3),
    ) {
        let count = truth.len();
        let mut dynamic = chain.model(&vec![1.0; count]);
        for mass in 0..count {
            let mut own = 0.0 * &dynamic.mass;
            own[(mass, mass)] = dynamic.mass[(mass, mass)];
            dynamic.shares.push(ParameterMatrix::Mass(own));
        }
        let (squares, shapes) = ModeSet::from(chain.modes(&truth)).into_parts();
        let places = [0, 2, 1];
        let test = ModeSet::new(squares.select_rows(&places), shapes.select_columns(&places)).unwrap();
        let model = dynamic.analyze(&test, Some(analysis_modes.min(count))).unwrap();
        let weights: Vec<ModeWeight> = weights
            .into_iter()
            .map(|(frequency, shape)| ModeWeight { frequency, shape })
            .collect();
        let model = model.weighted(&weights).unwrap();
        let state = if moved {
            ModalState::at(&model, factors[..2 * count].to_vec(), UpdateRule::Eigensolution).unwrap()
        } else {
            ModalState::start(&model)
        };
        assert_same(&model, &state);
    }
}

#[test]
fn every_case_has_the_same_gradient() {
    for number in CASES {
        let model = first_problem(number);
        assert_same(&model, &ModalState::start(&model));
        let factors = (0..15).map(|e| 0.9 + 0.013 * f64::from(e)).collect();
        let moved = ModalState::at(&model, factors, UpdateRule::Recursive1).expect("followed");
        assert_same(&model, &moved);
    }
}

/// Where an error is zero its root has a kink, and counts as constant: frequencies alone, shapes alone, both.
#[test]
fn an_error_of_zero_counts_as_constant() {
    let shares = [
        dmatrix![4.0, 0.0; 0.0, 0.0],
        dmatrix![0.0, 0.0; 0.0, 9.0],
        dmatrix![1.0, 0.5; 0.5, 1.0],
    ];
    let apart = DynamicModel {
        stiffness: dmatrix![4.0, 0.0; 0.0, 9.0],
        mass: DMatrix::identity(2, 2),
        shares: shares.map(ParameterMatrix::Stiffness).to_vec(),
    };
    let unit = DMatrix::identity(2, 2);
    let alike = ModeSet::new(dvector![4.0, 9.0], unit.clone()).unwrap();
    let frequencies = ModeSet::new(dvector![5.0, 8.0], unit).unwrap();
    let shapes = alike.with_shapes(dmatrix![1.0, 0.1; 0.2, 1.0]).unwrap();
    for (test, has_slope) in [(frequencies, true), (shapes, true), (alike, false)] {
        let model = apart.analyze(&test, None).unwrap();
        let errors = model.exact().errors;
        assert!(errors.frequency == 0.0 || errors.shape == 0.0);
        let state = ModalState::start(&model);
        assert_same(&model, &state);
        let slopes = gradient(&model, &state).unwrap();
        assert_eq!(slopes.iter().any(|slope| *slope != 0.0), has_slope);
    }
}

/// Squared frequencies of a trillionth are apart by as much of themselves as those of a trillion.
#[test]
fn the_packed_gradient_is_the_plain_one_in_any_unit() {
    for unit in [1e-12, 1.0, 1e12] {
        let [first, second] = [dmatrix![4.0, 1.0; 1.0, 2.0], dmatrix![1.0, 0.5; 0.5, 7.0]];
        let shares = [unit * &first, unit * &second];
        let coupled = DynamicModel {
            stiffness: unit * (first + second),
            mass: DMatrix::identity(2, 2),
            shares: shares.map(ParameterMatrix::Stiffness).to_vec(),
        };
        let shapes = dmatrix![1.0, 0.1; -0.5, 1.0];
        let test = ModeSet::new(unit * dvector![5.0, 8.0], shapes).unwrap();
        let model = coupled.analyze(&test, None).unwrap();
        assert_same(&model, &ModalState::start(&model));
    }
}

/// The loops of a job take the derivative that the rule names.
#[test]
fn the_derivative_of_a_model_is_the_rules() {
    let model = first_problem(2);
    let state = ModalState::start(&model);
    for rule in [DerivativeRule::Definition, DerivativeRule::Gradient] {
        let plain = error_changes(&model, &state, rule).expect("changes");
        let found = derivative(&model, rule)(&state).expect("changes");
        assert!(distance(&plain, &found) <= SAME_GRADIENT, "{rule:?}");
    }
    let [definition, gradient] = [DerivativeRule::Definition, DerivativeRule::Gradient]
        .map(|rule| derivative(&model, rule)(&state).expect("changes"));
    assert!(distance(&definition, &gradient) > 100.0 * SAME_GRADIENT);
}

#[test]
fn a_state_of_another_model_is_refused() {
    let (dynamic, chain) = (
        first_problem(2),
        crate::common::vibrations::Chain::uniform(3),
    );
    let none = DynamicModel {
        shares: Vec::new(),
        ..chain.model(&[1.0; 3])
    };
    let none = none
        .analyze(&chain.modes(&[1.2; 3]), None)
        .expect("analyzed");
    let of_none = ModalState::start(&none);
    let refused = PackedModel::new(&dynamic).gradient(&of_none);
    assert!(matches!(refused, Err(Error::WrongShape { .. })));
    let empty = derivative(&none, DerivativeRule::Gradient)(&of_none);
    assert!(matches!(empty, Err(Error::Empty { .. })));
}
