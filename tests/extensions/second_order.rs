//! The part of the curvature that Gauss and Newton leave out, learned from gradients.

use crate::prelude::*;
use corfem::weighted::second_order::SecondOrder;

/// A symmetric curvature with eigenvalues from one up and a symmetric second order less than a half, in three parameters, and steps.
fn drawn() -> impl Strategy<Value = (DMatrix<f64>, DMatrix<f64>, Vec<DVector<f64>>)> {
    let numbers = |count| prop::collection::vec(-1.0..1.0_f64, count);
    let steps = prop::collection::vec(numbers(3), 1..8);
    (numbers(9), numbers(9), steps).prop_map(|(root, second, steps)| {
        let [root, second] = [root, second].map(|of| DMatrix::from_vec(3, 3, of));
        let plain = eye(3) + &root * root.transpose();
        let second = (&second + second.transpose()) / 12.0;
        let long = |step: &Vec<f64>| step.iter().any(|part| part.abs() > 1e-3);
        (
            plain,
            second,
            steps
                .into_iter()
                .filter(long)
                .map(DVector::from_vec)
                .collect(),
        )
    })
}

properties! {
    #[test]
    fn a_second_order_foretells_the_last_step_and_is_symmetric((plain, second, steps) in drawn()) {
        let mut learned = SecondOrder::new(3);
        for step in &steps {
            let own = &second * step;
            learned.learn(step, &(&plain * step + &own), own.clone());
            // A step that its like has foretold exactly is learned without being used.
            learned.learn(step, &(&plain * step + &own), own.clone());
            let of = learned.told().unwrap();
            prop_assert!((of * step - &own).norm() <= MATRIX_ROUND_OFF * (1.0 + own.norm()));
            prop_assert!((of - of.transpose()).amax() <= MATRIX_ROUND_OFF);
        }
    }

    /// Linear residuals have none, and a step along which the gradient falls teaches none.
    #[test]
    fn no_second_order_is_learned_of_linear_residuals((plain, second, steps) in drawn()) {
        let mut learned = SecondOrder::new(3);
        for step in &steps {
            learned.learn(step, &(&plain * step), 0.0 * step);
            prop_assert!(learned.told().is_none());
            learned.learn(step, &(-&plain * step), &second * step);
            prop_assert!(learned.told().is_none());
        }
    }
}
