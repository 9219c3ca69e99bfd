//! Ends of the corrections of drawn structures: how steep the exact objective is there, and where light oscillators lead them.

use super::five_structures::{Right, measure};
use super::readings_rates::{below, normal};
use crate::common::jobs::of_whole;
use crate::prelude::*;

use corfem::job::{LoadedJob, run};
use corfem::sparse::random::uniform;

/// Drawn structure of springs and masses with a test of it.
pub struct Drawn {
    model: WholeModel,
    truth: Vec<f64>,
    sensors: Vec<usize>,
    modes: usize,
    rigid: usize,
    noise: Noise,
    /// Prior deviation of every factor.
    prior: f64,
}

/// Springs by parameter, masses by parameter where some scale masses, and all masses.
struct Network<'a> {
    springs: &'a [Vec<(usize, Option<usize>, f64)>],
    scaled: &'a [Vec<usize>],
    masses: &'a [f64],
}

impl Network<'_> {
    fn model(&self) -> WholeModel {
        let count = self.masses.len();
        let of_springs = self.springs.iter();
        let of_springs = of_springs.map(|own| WholeShare::Stiffness(springs(count, own)));
        let of_masses = self.scaled.iter().map(|rows| {
            let own = |row: usize| f64::from(u8::from(rows.contains(&row))) * self.masses[row];
            WholeShare::Mass(masses(&(0..count).map(own).collect::<Vec<_>>()))
        });
        let all = of_springs.chain(of_masses).enumerate();
        let parameters = all.map(|(number, share)| WholeParameter {
            name: format!("p{number}"),
            share,
            range: None,
        });
        let stiffness: SparseMatrix = springs(count, &self.springs.concat());
        WholeModel::new(stiffness, masses(self.masses), parameters.collect()).expect("a model")
    }
}

/// Factors whose logarithms have this deviation.
fn factors(count: usize, deviation: f64, state: &mut u64) -> Vec<f64> {
    (0..count)
        .map(|_| (deviation * normal(state)).exp())
        .collect()
}

/// Places of a number drawn of all below another, ascending.
fn some_of(all: usize, count: usize, state: &mut u64) -> Vec<usize> {
    let mut left: Vec<usize> = (0..all).collect();
    let mut taken: Vec<usize> = (0..count)
        .map(|_| left.swap_remove(below(state, left.len())))
        .collect();
    taken.sort_unstable();
    taken
}

/// A network of six to 25 masses, a chain with half as many springs across, held or free, of two to six parameters of stiffness and up to
/// two of mass, seen by half of its rows or more in three to six modes with .1 to .5 % of noise on frequencies, .5 to 3 % on shapes.
pub fn network(seed: u64) -> Drawn {
    let mut state = 1_000 + seed;
    let state = &mut state;
    let (count, parts) = (6 + below(state, 20), 2 + below(state, 5));
    let (rigid, scaled) = (below(state, 2), below(state, 3));
    let mut own = vec![Vec::new(); parts];
    for row in 0..count {
        let before = row.checked_sub(1);
        if rigid == 0 || row > 0 {
            own[row * parts / count].push((row, before, 1e5 * (1.0 + uniform(state))));
        }
    }
    for _ in 0..count / 2 {
        let (a, b) = (below(state, count), below(state, count));
        if a != b {
            own[below(state, parts)].push((a, Some(b), 2e4 * (1.0 + uniform(state))));
        }
    }
    let mass: Vec<f64> = (0..count).map(|_| 20.0 + 40.0 * uniform(state)).collect();
    let few = |state: &mut u64| some_of(count, 1 + below(state, count / 3), state);
    let scaled: Vec<Vec<usize>> = (0..scaled).map(|_| few(state)).collect();
    let model = Network {
        springs: &own,
        scaled: &scaled,
        masses: &mass,
    };
    let most = count - count / 2;
    let sensors = some_of(
        count,
        (count / 2 + 1 + below(state, most)).min(count),
        state,
    );
    let noise = Noise {
        frequency: 0.001 + 0.004 * uniform(state),
        shape: 0.005 + 0.025 * uniform(state),
    };
    Drawn {
        truth: factors(parts + scaled.len(), 0.15, state),
        modes: 3 + below(state, 3.min(sensors.len() - 2)),
        model: model.model(),
        sensors,
        rigid,
        noise,
        prior: 0.3,
    }
}

/// Eight masses in a chain, four of which carry an oscillator a hundred and twenty times lighter, each spring a parameter: a model that is
/// 25 % off, and exact data of five modes at all rows.
pub fn oscillators(seed: u64, noise: Noise) -> Drawn {
    let mut state = 5_000 + seed;
    let chain = (0..8usize).map(|row| vec![(row, row.checked_sub(1), 1e5)]);
    let light = (0..4usize).map(|own| vec![(8 + own, Some(2 * own), 300.0)]);
    let own: Vec<_> = chain.chain(light).collect();
    let mass = [vec![60.0; 8], vec![0.5; 4]].concat();
    let model = Network {
        springs: &own,
        scaled: &[],
        masses: &mass,
    };
    Drawn {
        truth: factors(own.len(), 0.25, &mut state),
        modes: 5,
        model: model.model(),
        sensors: (0..mass.len()).collect(),
        rigid: 0,
        noise,
        prior: 1.0,
    }
}

/// The correction of a drawn structure by a test with a part of the noise that is declared.
pub fn corrected(drawn: &Drawn, part: f64, seed: u64) -> JobResult {
    let Drawn {
        model,
        truth,
        sensors,
        noise,
        ..
    } = drawn;
    let ones = vec![1.0; truth.len()];
    let files = of_whole(model, &ones, sensors, drawn.modes, *noise);
    let (_folder, path) = placed(&supposing(files, drawn.prior, drawn.rigid));
    let mut loaded = LoadedJob::new(&path).unwrap_or_else(|error| panic!("{error}"));
    let actual = Noise {
        frequency: part * noise.frequency,
        shape: part * noise.shape,
    };
    let right = Right {
        model,
        factors: truth,
        rows: sensors,
        modes: drawn.modes,
    };
    measure(&mut loaded, &right, actual, &mut (9_000 + seed));
    let prepared = loaded.prepare().unwrap_or_else(|error| panic!("{error}"));
    let trust = Trust::before(&prepared).unwrap_or_else(|error| panic!("{error}"));
    run(&prepared, &trust, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"))
}

/// Weighted steps of a result.
pub fn steps(result: &JobResult) -> &WeightedCorrelation {
    match &result.found.history {
        History::GaussNewton(Some(found)) => &found.best,
        _ => panic!("weighted steps"),
    }
}

/// Largest slope of the exact objective at the end of a result, over the root of the parameter's curvature: deviations by which it alone
/// would move. Central differences of analyses anew over steps of two and four hundredths of a deviation, the truncation of which is
/// taken out (Richardson).
pub fn steepness(result: &JobResult) -> f64 {
    let found = &result.found;
    let prior = found.prepared.loaded.source.priors[0];
    let weights = found.prepared.weights();
    let jacobian = jacobian(&found.last, &weights).expect("slopes");
    let objective = |factors: &[f64]| {
        let model = found.prepared.analyze(factors).expect("a model");
        let pulls = factors.iter().map(|own| (own.ln() / prior).powi(2));
        let own = residuals(&model, &weights).expect("residuals");
        0.5 * (own.norm_squared() + pulls.sum::<f64>())
    };
    let slope = |e: usize| {
        let deviation = (jacobian.column(e).norm_squared() + prior.powi(-2)).powf(-0.5);
        let central = |part: f64| {
            let beside = |log: f64| {
                let mut factors = found.factors.clone();
                factors[e] *= log.exp();
                objective(&factors)
            };
            (beside(part * deviation) - beside(-part * deviation)) / (2.0 * part)
        };
        ((4.0 * central(0.02) - central(0.04)) / 3.0).abs()
    };
    let free = (0..found.factors.len()).filter(|e| !result.verdict.at_bound.contains(e));
    free.map(slope).fold(0.0, f64::max)
}
