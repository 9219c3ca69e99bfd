//! Masses as parameters of structures on supports and of those that hang free: with all modes, rigid-body modes in the basis,
//! derivatives and the perturbation are exact.

use crate::common::draws::Draws;
use crate::common::measured::equal_weights;
use crate::common::tolerances::{CENTRAL_DIFFERENCE_GRADIENT, CONVERGED_STATE, FORWARD_DIFFERENCE};
use crate::common::whole_models::{masses, seen_by, sensors_at, springs};
use corfem::method::derivatives::{DERIVATIVE_STEP, by_definition, gradient};
use corfem::method::error::Error;
use corfem::method::model::ModalModel;
use corfem::method::modes::ModeSet;
use corfem::method::pairing::{Pairing, pair_modes};
use corfem::method::state::{ModalState, UpdateRule};
use corfem::nalgebra::DMatrix;
use corfem::sparse::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use corfem::weighted::gauss_newton::{WeightedSettings, gauss_newton};
use corfem::weighted::residuals::{DEVIATIONS, jacobian, residuals};

/// Four springs and three masses of a random net are parameters; all but one point have sensors.
struct Net {
    model: WholeModel,
    sensors: SparseMatrix,
    test: ModeSet,
    vibrations: usize,
}

impl Net {
    fn new(seed: u64, is_free: bool) -> Self {
        let mut draws = Draws(seed);
        let mut uniform = |low: f64, high: f64| low + (high - low) * draws.unit();
        let count = 5 + uniform(0.0, 12.0) as usize;
        let mut pick = |below: usize| uniform(0.0, below as f64) as usize;
        let mut links = Vec::new();
        for point in usize::from(is_free)..count {
            links.push((point, point.checked_sub(1).map(|_| pick(point))));
        }
        let tree = links.len();
        for _ in 0..count {
            let (a, b) = (pick(count), pick(count));
            if a != b {
                links.push((a, Some(b)));
            }
        }
        let all: Vec<_> = links
            .iter()
            .enumerate()
            .map(|(link, &(a, b))| {
                let stiffness = if link < tree { uniform(1e4, 1e5) } else { 3e3 };
                (a, b, stiffness)
            })
            .collect();
        let points: Vec<f64> = (0..count).map(|_| uniform(1.0, 4.0)).collect();
        let parameter = |name: String, share| WholeParameter {
            name,
            share,
            range: None,
        };
        let mut parameters: Vec<_> = (0..4)
            .map(|link| {
                let share = WholeShare::Stiffness(springs(count, &all[link..=link]));
                parameter(format!("spring {link}"), share)
            })
            .collect();
        parameters.extend((0..3).map(|point| {
            let entries = vec![(point, point, points[point])];
            let share = SparseMatrix::new("mass", count, count, entries).unwrap();
            parameter(format!("mass {point}"), WholeShare::Mass(share))
        }));
        let model = WholeModel::new(springs(count, &all), masses(&points), parameters).unwrap();
        let vibrations = count - usize::from(is_free);
        let sensors = sensors_at(&(0..count - 1).collect::<Vec<_>>(), count);
        let truth: Vec<f64> = (0..7).map(|_| uniform(0.9, 1.1)).collect();
        let found = model.modes(&truth, 4.min(vibrations)).unwrap().vibrations;
        let test = seen_by(&sensors, &found);
        Self {
            model,
            sensors,
            test,
            vibrations,
        }
    }

    fn analyze(&self, factors: &[f64]) -> Result<ModalModel, Error> {
        let test = (&self.test, pair_modes as _);
        self.model
            .analyze(factors, &self.sensors, test, [self.vibrations, 0])
    }
}

/// Central differences of what `of` says of the exact models beside factors of one, by the logarithm of each factor.
fn differences(net: &Net, step: f64, of: impl Fn(&ModalModel) -> Vec<f64>) -> DMatrix<f64> {
    let columns = (0..7).map(|e| {
        let beside = |log: f64| {
            let mut factors = [1.0; 7];
            factors[e] = log.exp();
            of(&net.analyze(&factors).unwrap())
        };
        let (up, down) = (beside(step), beside(-step));
        up.iter()
            .zip(down)
            .map(|(up, down)| (up - down) / (2.0 * step))
            .collect::<Vec<_>>()
    });
    let columns: Vec<_> = columns.collect();
    DMatrix::from_fn(columns[0].len(), 7, |row, e| columns[e][row])
}

/// A hundred nets on a support and a hundred free ones.
fn nets() -> impl Iterator<Item = (Net, String)> {
    (1..=100).flat_map(|seed| {
        [false, true].map(|is_free| {
            (
                Net::new(seed, is_free),
                format!("seed {seed}, free {is_free}"),
            )
        })
    })
}

#[test]
fn with_all_modes_the_jacobian_is_exact_for_springs_and_masses_of_held_and_free_structures() {
    for (net, name) in nets() {
        let here = net.analyze(&[1.0; 7]).unwrap();
        let weights = equal_weights(DEVIATIONS, net.test.len());
        let found = jacobian(&here, &weights).unwrap();
        let exact = differences(&net, 1e-4, |model| {
            residuals(model, &weights).unwrap().data.into()
        });
        for e in 0..7 {
            let off = (found.column(e) - exact.column(e)).norm() / exact.column(e).norm();
            assert!(
                off < FORWARD_DIFFERENCE / 2.0,
                "{name}, parameter {e}: {off:e}"
            );
        }
    }
}

#[test]
fn the_gradient_and_the_papers_difference_follow_masses_of_free_structures() {
    let mut apart = 0;
    for (net, name) in nets() {
        let here = net.analyze(&[1.0; 7]).unwrap();
        let squares = here.exact().modes.omega_squared().as_slice();
        let is_apart = squares.windows(2).all(|pair| pair[0] < 0.95 * pair[1]);
        let start = ModalState::start(&here);
        let slopes = gradient(&here, &start).unwrap();
        let by_step = by_definition(&here, &start).unwrap();
        let exact = differences(&net, 1e-5, |model| vec![model.exact().errors.sum()]);
        for e in 0..7 {
            let off = (slopes[e] - exact[(0, e)]).abs() / exact.amax();
            assert!(
                off < CENTRAL_DIFFERENCE_GRADIENT,
                "{name}, parameter {e}: {off:e}"
            );
            let mut factors = [1.0; 7];
            factors[e] += DERIVATIVE_STEP;
            let there = net.analyze(&factors).unwrap().exact().errors.sum();
            let off = (by_step[e] - (there - start.errors().sum())).abs();
            let off = off / (DERIVATIVE_STEP * exact.amax());
            // A step of a thousandth is far where modes are close.
            assert!(
                off < 10.0 * DERIVATIVE_STEP || !is_apart,
                "{name}, parameter {e}: {off:e}"
            );
        }
        apart += usize::from(is_apart);
    }
    assert!(apart > 40, "{apart} of 200 nets have modes apart");
}

/// In a basis of all modes the steps from the first model end where the exact ones would, masses changed or not.
#[test]
fn with_all_modes_the_first_trial_of_a_weighted_correlation_is_the_last() {
    let settings = WeightedSettings::default();
    for (net, name) in nets().step_by(7) {
        let weights = equal_weights(DEVIATIONS, net.test.omega_squared().len());
        let analyze = |factors: &[f64]| net.analyze(factors);
        let found = gauss_newton(analyze, &[1.0; 7], &[None; 7], &weights, &settings).unwrap();
        assert_eq!(found.analyses, 2, "{name}");
    }
}

#[test]
fn the_perturbation_on_all_modes_reaches_the_exact_modes_of_changed_masses() {
    let mut same_pairs = 0;
    for (net, name) in nets() {
        let here = net.analyze(&[1.0; 7]).unwrap();
        let factors = [1.05, 0.95, 1.1, 0.9, 1.3, 0.8, 1.2];
        let exact = net.analyze(&factors).unwrap();
        let state = ModalState::at(&here, factors.to_vec(), UpdateRule::Eigensolution).unwrap();
        let mut squares: Vec<f64> = state.modes().omega_squared().iter().copied().collect();
        squares.retain(|square| *square > 0.0);
        squares.sort_by(f64::total_cmp);
        for (found, expected) in squares.iter().zip(exact.exact().modes.omega_squared()) {
            assert!((found / expected - 1.0).abs() < CONVERGED_STATE, "{name}");
        }
        // Mode by mode they are the same, so the pairs may be compared by their frequencies.
        let pairs = |modes: &ModeSet, pairing: &Pairing| {
            let mode = |&i: &usize| modes.omega_squared()[i];
            pairing.analysis_mode().iter().map(mode).collect::<Vec<_>>()
        };
        let there = exact.exact();
        let (found, expected) = (
            pairs(state.modes(), state.pairing()),
            pairs(&there.modes, &there.pairing),
        );
        let mut both = found.iter().zip(&expected);
        if both.any(|(found, expected)| (found / expected - 1.0).abs() > CONVERGED_STATE) {
            continue;
        }
        same_pairs += 1;
        // Shapes too, and the error sum with them.
        let (found, expected) = (state.errors(), exact.exact().errors);
        assert!(
            (found.sum() - expected.sum()).abs() < CONVERGED_STATE,
            "{name}"
        );
        // From there on the derivatives are those of the exact model there.
        let (found, expected) = (
            gradient(&here, &state).unwrap(),
            gradient(&exact, &ModalState::start(&exact)).unwrap(),
        );
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < FORWARD_DIFFERENCE, "{name}");
        }
    }
    assert!(same_pairs > 180, "{same_pairs} of 200 nets");
}
