//! Masses as parameters of structures on supports and of those that hang free: with all modes, rigid-body modes in the basis,
//! derivatives and the perturbation are exact.

use crate::prelude::*;

/// Four springs and three masses of a random net are parameters; all but one point have sensors.
struct Net {
    model: WholeModel,
    sensors: SparseMatrix,
    test: Modes,
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
        let all = links
            .iter()
            .enumerate()
            .map(|(link, &(a, b))| {
                let stiffness = if link < tree { uniform(1e4, 1e5) } else { 3e3 };
                (a, b, stiffness)
            })
            .collect_vec();
        let points = (0..count).map(|_| uniform(1.0, 4.0)).collect_vec();
        let parameter = |name: String, share| WholeParameter {
            name,
            share,
            range: None,
        };
        let mut parameters = (0..4)
            .map(|link| {
                let share = WholeShare::Stiffness(springs(count, &all[link..=link]));
                parameter(format!("spring {link}"), share)
            })
            .collect_vec();
        parameters.extend((0..3).map(|point| {
            let entries = vec![(point, point, points[point])];
            let share = SparseMatrix::new("mass", count, count, entries).unwrap();
            parameter(format!("mass {point}"), WholeShare::Mass(share))
        }));
        let model = WholeModel::new(springs(count, &all), masses(&points), parameters).unwrap();
        let vibrations = count - usize::from(is_free);
        let sensors = sensors_at(&(0..count - 1).collect_vec(), count);
        let truth = (0..7).map(|_| uniform(0.9, 1.1)).collect_vec();
        let found = model.modes(&truth, 4.min(vibrations)).unwrap().vibrations;
        let test = seen_by(&sensors, &found);
        Self {
            model,
            sensors,
            test,
            vibrations,
        }
    }

    fn analyze(&self, factors: &[f64]) -> Result<SensorModel, Error> {
        let pair = by_sorting();
        self.model
            .analyze(factors, &self.sensors, &self.test, pair, self.vibrations)
    }
}

/// Central differences of what `of` says of the exact models beside factors of one, by the logarithm of each factor.
fn differences(net: &Net, step: f64, of: impl Fn(&SensorModel) -> Vec<f64>) -> DMatrix<f64> {
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
            .collect_vec()
    });
    let columns = columns.collect_vec();
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
        let found = jacobian(&Comparison::from(here), &weights).unwrap();
        let exact = differences(&net, 1e-4, |model| {
            let there = Comparison::from(model.clone());
            residuals(&there, &weights).unwrap().data.into()
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

/// In a basis of all modes the steps from the first model end where the exact ones would, masses changed or not.
#[test]
fn with_all_modes_the_first_trial_of_a_weighted_correlation_is_the_last() {
    let settings = WeightedSettings::default();
    for (net, name) in nets().step_by(7) {
        let weights = equal_weights(DEVIATIONS, net.test.omega_squared().len());
        let analyze = |factors: &[f64]| net.analyze(factors).map(Comparison::from);
        let found = gauss_newton(analyze, &[1.0; 7], &[None; 7], &weights, &settings).unwrap();
        assert_eq!(found.analyses, 2, "{name}");
    }
}

/// Factors that change springs and masses by up to a third.
const CHANGED: [f64; 7] = [1.05, 0.95, 1.1, 0.9, 1.3, 0.8, 1.2];

/// The changed stiffness and mass in the basis, of rigid-body modes too, which have no stiffness.
fn in_basis(model: &SensorModel) -> [DMatrix<f64>; 2] {
    let size = model.basis().ncols();
    let k = model
        .exact()
        .modes
        .omega_squared()
        .clone()
        .resize_vertically(size, 0.0);
    let mut both = [DMatrix::from_diagonal(&k), eye(size)];
    for (share, factor) in model.shares().iter().zip(CHANGED) {
        let is_mass = matches!(share, ParameterMatrix::Mass(_));
        both[usize::from(is_mass)] += (factor - 1.0) * share.matrix();
    }
    both
}

/// Squared frequencies of the modes that answer the test modes.
fn paired(state: &State) -> Vec<f64> {
    let mode = |&i: &usize| state.modes.omega_squared()[i];
    state.pairing.analysis_mode.iter().map(mode).collect()
}

/// Largest relative distance of two lists of numbers.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let both = found.iter().zip(expected);
    both.map(|(found, expected)| relative_error(found, expected))
        .largest()
}

#[test]
fn the_perturbation_on_all_modes_reaches_the_exact_modes_of_changed_masses() {
    let [mut converged, mut same_pairs] = [0; 2];
    for (net, name) in nets() {
        let here = net.analyze(&[1.0; 7]).unwrap();
        let exact = net.analyze(&CHANGED).unwrap();
        let expected = exact.exact().modes.omega_squared().as_slice();
        // The basis has them all.
        let [stiffness, mass] = in_basis(&here);
        let (squares, _) = modes_by_nalgebra(&stiffness, &mass);
        let vibrations = &squares.as_slice()[squares.len() - net.vibrations..];
        assert!(apart(vibrations, expected) < CONVERGED_STATE, "{name}");
        // Where modes are close the recursion may not settle, and where it has settled, it may have done so on roots to a millionth.
        let Ok(state) = here.at(&CHANGED) else {
            continue;
        };
        let mut squares = state.modes.omega_squared().as_slice().to_vec();
        squares.sort_by(f64::total_cmp);
        let off = apart(&squares, expected);
        assert!(off < FAR_RECURSION, "{name}: {off:e}");
        converged += usize::from(off < CONVERGED_STATE);
        // Mode by mode they are the same, so the pairs may be compared by their frequencies.
        if apart(&paired(&state), &paired(exact.exact())) > CONVERGED_STATE {
            continue;
        }
        same_pairs += 1;
        // Shapes too, and the error sum with them.
        let (found, expected) = (state.errors, exact.exact().errors);
        assert_within(found.sum(), expected.sum(), CONVERGED_STATE);
        // From there on the derivatives are those of the exact model there.
        let there = exact.at(&[1.0; 7]).unwrap();
        let (found, expected) = (
            here.error_changes(&state).unwrap(),
            exact.error_changes(&there).unwrap(),
        );
        for (found, expected) in found.iter().zip(&expected) {
            let off = (found - expected).abs() / DERIVATIVE_STEP;
            assert!(off < FORWARD_DIFFERENCE, "{name}: {off:e}");
        }
    }
    assert!(
        converged > 135 && same_pairs > 140,
        "{converged} and {same_pairs} of 200 nets"
    );
}
