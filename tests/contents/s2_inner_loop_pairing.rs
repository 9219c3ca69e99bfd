//! Pairing that changes inside an inner loop, without a new analysis: as test shapes that noise has turned half way from one mode to
//! another change hands while the modes turn.

use crate::prelude::*;

/// Three unit masses on springs of their own, the first two nearly alike, with soft springs between them that are no parameters; and the
/// test: frequencies of a stiffer structure, and shapes of this one, of which the first two are turned into each other, the way that
/// they turn when the second spring stiffens more than the first.
#[derive(Debug, Clone)]
struct Turned {
    grounds: [f64; 3],
    between: [f64; 2],
    truth: [f64; 3],
    degrees: f64,
}

impl Turned {
    fn model(&self, factors: &[f64]) -> DynamicModel {
        let ground = |mass: usize| {
            let mut stiffness = zero_square(3);
            stiffness[(mass, mass)] = factors[mass] * self.grounds[mass];
            stiffness
        };
        let shares = (0..3).map(ground).collect_vec();
        let between = |spring: usize| spring_stiffness(3, spring, self.between[spring - 1]);
        DynamicModel {
            stiffness: shares.iter().sum::<DMatrix<f64>>() + between(1) + between(2),
            mass: eye(3),
            shares,
        }
    }

    fn test(&self) -> Modes {
        let modes = |factors: &[f64]| {
            let model = self.model(factors);
            solve(&model.stiffness, &model.mass, 3).unwrap()
        };
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let mut turn = eye(3);
        turn.view_mut((0, 0), (2, 2))
            .copy_from(&dmatrix![cos, -sin; sin, cos]);
        let squares = modes(&self.truth).omega_squared().clone();
        let shapes = modes(&[1.0; 3]).shapes() * turn;
        Modes::new(squares, shapes).unwrap()
    }

    fn run(&self) -> (ModalModel, InnerRun) {
        let model = self.model(&[1.0; 3]).analyze(&self.test(), None);
        let exactly = Eigensolved(model.unwrap());
        let settings = InnerSettings {
            iterations: 10,
            ..InnerSettings::default()
        };
        let settings = inner_for_modes(settings, 3);
        let inner = run(&exactly, &[1.0; 3], &[None; 3], &settings).unwrap();
        (exactly.0, inner)
    }
}

fn turned() -> impl Strategy<Value = Turned> {
    (
        (1.0..1.2_f64, 0.02..0.2_f64, 3.0..5.0_f64),
        (0.05..0.1_f64, 0.02..0.1_f64),
        (1.1..1.5_f64, 1.2..1.6_f64, 1.1..1.5_f64),
        44.0..45.0_f64,
    )
        .prop_map(|(grounds, between, truth, degrees)| Turned {
            grounds: [grounds.0, grounds.0 + grounds.1, grounds.2],
            between: [between.0, between.1],
            truth: [truth.0, truth.0 * truth.1, truth.2],
            degrees,
        })
}

#[test]
fn draws_change_the_pairing_inside_a_loop() {
    let share = reached("pairing that changes inside a loop", &turned(), |draw| {
        let (model, inner) = draw.run();
        inner.last.pairing != model.exact().pairing
    });
    assert!(share > LEAST_REACHED, "{share}");
}

properties! {
    #[test]
    fn pairing_that_changes_inside_a_loop_is_that_of_the_eigensolution(draw in turned()) {
        let (model, inner) = draw.run();
        // Where the loop ends, which a wrong pairing would choose for itself, and where the test's stiffness is.
        let at_truth = exact_state(&model, &draw.truth)?;
        for state in [&at_truth, &inner.last] {
            let there = draw.model(&state.share_factors);
            let expected = error_sum_by_definition(&there.stiffness, &there.mass, model.test());
            let found = state.errors.sum();
            prop_assert!((found - expected).abs() <= CONVERGED_STATE, "{found} {expected}");
        }
        let found = inner.last.errors.sum();
        // The derivatives are those of the pairs that there are now: of exact modes paired like these, to second order.
        let changed = |parameter: usize| {
            let mut factors = inner.last.share_factors.clone();
            factors[parameter] *= 1.0 + DERIVATIVE_STEP;
            let there = exact_state(&model, &factors).unwrap();
            // An eigensolution's shapes have places and signs of their own: the same modes are those most alike.
            let alike = inner.last.modes.shapes().tr_mul(there.modes.shapes());
            let now = &inner.last.pairing;
            let (partners, signs) = now
                .analysis_mode
                .iter()
                .zip(&now.sign)
                .map(|(&i, sign)| {
                    let same = alike.row(i).transpose().iamax();
                    (same, sign * alike[(i, same)].signum())
                })
                .unzip();
            let pairing = Pairing { analysis_mode: partners, sign: signs };
            errors(&there.modes, &pairing, model.test()).unwrap().sum() - found
        };
        for (parameter, change) in model.error_changes(&inner.last)?.into_iter().enumerate() {
            let apart = (change - changed(parameter)).abs() / DERIVATIVE_STEP;
            prop_assert!(apart <= SECOND_ORDER_CHANGE, "{parameter}: {apart}");
        }
    }
}
