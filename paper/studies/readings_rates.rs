//! How often mistakes in a test's readings are named on structures unlike the box: a chain, a symmetric ring and net with repeated
//! modes, a chain with light oscillators, and a truss whose points move in two directions.

use crate::prelude::*;
use corfem::job::concern::Grade;
use corfem::sparse::random::uniform;

/// Tests of each mistake.
pub const TESTS: u64 = 30;
/// Test modes.
const MODES: usize = 5;
/// Standard deviation of the logarithm of the true factors: the first model is that wrong.
const MODEL: f64 = 0.15;

/// What is wrong with a test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slip {
    /// Nothing.
    None,
    /// One sensor reversed.
    Reversed,
    /// Two sensors exchanged.
    Exchanged,
    /// One sensor reads twice as much.
    Twice,
    /// One sensor reads a thousand times as much.
    Thousandfold,
    /// One sensor reads noise alone.
    Dead,
    /// A mode measured twice.
    Repeated,
}

/// All of them.
pub const SLIPS: [Slip; 7] = {
    use Slip::*;
    [
        None,
        Reversed,
        Exchanged,
        Twice,
        Thousandfold,
        Dead,
        Repeated,
    ]
};

/// Stiffness matrices of the parameters, the mass, and the rows that sensors read.
pub type Built = (Vec<DMatrix<f64>>, DMatrix<f64>, Vec<usize>);

/// A structure by a seed.
#[derive(Clone, Copy)]
pub struct Kind {
    /// What it is called.
    pub name: &'static str,
    /// Builds it.
    pub build: fn(&mut u64) -> Built,
}

/// The five structures.
pub const KINDS: [Kind; 5] = [
    Kind {
        name: "Chain",
        build: chain,
    },
    Kind {
        name: "Ring",
        build: ring,
    },
    Kind {
        name: "Net",
        build: net,
    },
    Kind {
        name: "Light oscillators",
        build: oscillators,
    },
    Kind {
        name: "Truss",
        build: truss,
    },
];

/// A normal number (Box and Muller).
pub fn normal(state: &mut u64) -> f64 {
    let radius = (-2.0 * (1.0 - uniform(state)).ln()).sqrt();
    radius * (TAU * uniform(state)).cos()
}

/// A whole number below another.
pub fn below(state: &mut u64, bound: usize) -> usize {
    ((uniform(state) * bound as f64) as usize).min(bound - 1)
}

/// A spring between two rows, or to the ground.
fn spring(matrix: &mut DMatrix<f64>, from: Option<usize>, to: usize, stiffness: f64) {
    matrix[(to, to)] += stiffness;
    if let Some(from) = from {
        matrix[(from, from)] += stiffness;
        matrix[(from, to)] -= stiffness;
        matrix[(to, from)] -= stiffness;
    }
}

fn chain(state: &mut u64) -> Built {
    let parts = (0..10).map(|at| spring_stiffness(10, at, 1e5 * (0.3 * normal(state)).exp()));
    let parts = parts.collect();
    let masses = DVector::from_fn(10, |_, _| 60.0 * (0.3 * normal(state)).exp());
    (parts, DMatrix::from_diagonal(&masses), (0..10).collect())
}

fn ring(_: &mut u64) -> Built {
    let one = |from: usize| {
        let mut part = zero_square(12);
        spring(&mut part, Some(from), (from + 1) % 12, 1e5);
        part
    };
    let ground = eye(12) * 2e4;
    let parts = (0..12).map(one).chain([ground]).collect();
    (parts, eye(12) * 60.0, (0..12).collect())
}

fn net(_: &mut u64) -> Built {
    let (rows, across) = (5, 4);
    let one = |row: usize| {
        let mut part = DMatrix::zeros(rows * across, rows * across);
        for column in 0..across {
            let at = row * across + column;
            if column + 1 < across {
                spring(&mut part, Some(at), at + 1, 1e5);
            }
            if row + 1 < rows {
                spring(&mut part, Some(at), at + across, 1e5);
            }
            if [0, across - 1].contains(&column) {
                spring(&mut part, None, at, 1e5);
            }
            if [0, rows - 1].contains(&row) {
                spring(&mut part, None, at, 1e5);
            }
        }
        part
    };
    (
        (0..rows).map(one).collect(),
        eye(20) * 60.0,
        (0..20).collect(),
    )
}

fn oscillators(_: &mut u64) -> Built {
    let one = |at: usize| {
        let mut part = zero_square(12);
        match at {
            0..8 => spring(&mut part, at.checked_sub(1), at, 1e5),
            _ => spring(&mut part, Some(2 * (at - 8)), at, 300.0),
        }
        part
    };
    let mass = DVector::from_fn(12, |row, _| if row < 8 { 60.0 } else { 0.5 });
    (
        (0..12).map(one).collect(),
        DMatrix::from_diagonal(&mass),
        (0..12).collect(),
    )
}

/// Six bays of a plane truss, held at one end; sensors measure every point's y and the upper points' x.
fn truss(_: &mut u64) -> Built {
    let at = |bay: usize, upper: usize| (bay as f64, 0.7 * upper as f64 + 0.1 * bay as f64);
    let mut rods = Vec::new();
    for bay in 1..=6 {
        rods.extend([
            ((bay - 1, 0), (bay, 0)),
            ((bay - 1, 1), (bay, 1)),
            ((bay, 0), (bay, 1)),
            ((bay - 1, 0), (bay, 1)),
        ]);
    }
    let one = |&(from, to): &((usize, usize), (usize, usize))| {
        let (a, b) = (at(from.0, from.1), at(to.0, to.1));
        let (x, y) = (b.0 - a.0, b.1 - a.1);
        let length = x.hypot(y);
        let mut pull = DVector::zeros(24);
        for (point, sign) in [(from, -1.0), (to, 1.0)] {
            if point.0 > 0 {
                let row = 4 * (point.0 - 1) + 2 * point.1;
                pull[row] = sign * x / length;
                pull[row + 1] = sign * y / length;
            }
        }
        1e6 / length * &pull * pull.transpose()
    };
    let sensors = (0..12).map(|point| 2 * point + 1);
    let sensors = sensors.chain((0..6).map(|bay| 4 * bay + 2)).collect();
    (rods.iter().map(one).collect(), eye(24) * 10.0, sensors)
}

/// Of how many tests a slip was named with all its places, and in how many anything else was named.
pub fn named(kind: Kind, slip: Slip, noise: f64) -> (usize, usize) {
    let (mut right, mut wrong, mut state) = (0, 0, 11);
    for test in 0..TESTS {
        let (found, expected) = findings(kind, slip, (noise, 1.0), test, &mut state);
        let is_expected = |found: &Concern| match &expected {
            Some(change) => {
                let named = change.concern(0.0, &Names::default());
                let is_near = match change {
                    Change::Gain(_, given) => {
                        let said = found.words.split(" reads ").nth(1);
                        let said = said.and_then(|words| words.split(' ').next());
                        let said = said.and_then(|gain| gain.parse::<f64>().ok());
                        said.is_some_and(|gain| (gain / given).ln().abs() < 0.5)
                    }
                    _ => true,
                };
                found.identifier == named.identifier && is_near
            }
            None => slip == Slip::Repeated && found.identifier == "same-3-4",
        };
        right += usize::from(found.iter().any(is_expected));
        let is_said = |concern: &Concern| concern.grade != Grade::NotChecked;
        wrong += usize::from(found.iter().any(|own| is_said(own) && !is_expected(own)));
    }
    (right, wrong)
}

/// What is found of one test, and the change that should be. In other units of mass and force shapes of unit generalized mass are other
/// numbers, and else all is the same.
pub fn findings(
    kind: Kind,
    slip: Slip,
    (noise, units): (f64, f64),
    seed: u64,
    state: &mut u64,
) -> (Vec<Concern>, Option<Change>) {
    let (parts, mass, sensors) = (kind.build)(state);
    let first: DMatrix<f64> = parts.iter().sum();
    let mut true_stiffness = zero_square(mass.nrows());
    for part in &parts {
        true_stiffness += part * (MODEL * normal(state)).exp();
    }
    let model = solve(&first, &mass, mass.nrows()).unwrap();
    let modes = solve(&true_stiffness, &mass, MODES).unwrap();
    let a = below(state, sensors.len());
    let b = (a + 1 + below(state, sensors.len() - 1)) % sensors.len();
    // Once chose another direction: the stored counts are of these draws.
    uniform(state);
    let shapes = unit(modes.shapes().select_rows(&sensors));
    let exact = Modes::new(modes.omega_squared().clone(), shapes).unwrap();
    let usual = Noise {
        frequency: 0.003,
        shape: noise,
    };
    let noisy = with_noise(&exact, usual, seed).unwrap();
    let (mut squares, mut shapes) = (noisy.omega_squared().clone(), noisy.shapes().clone());
    let expected = match slip {
        Slip::None => None,
        Slip::Reversed => {
            shapes.row_mut(a).neg_mut();
            Some(Change::Reversed(a))
        }
        Slip::Exchanged => {
            shapes.swap_rows(a, b);
            Some(Change::Exchanged([a.min(b), a.max(b)]))
        }
        Slip::Twice | Slip::Thousandfold => {
            let gain = if slip == Slip::Twice { 2.0 } else { 1000.0 };
            shapes.row_mut(a).scale_mut(gain);
            Some(Change::Gain(a, gain))
        }
        Slip::Dead => {
            shapes
                .row_mut(a)
                .apply(|reading| *reading = 0.001 * normal(state));
            Some(Change::Dead(a))
        }
        Slip::Repeated => {
            let again = shapes
                .column(2)
                .map(|reading| reading + noise * normal(state));
            shapes.set_column(3, &again);
            squares[3] = 1.002 * squares[2];
            None
        }
    };
    let shares = parts
        .iter()
        .map(|part| ParameterMatrix::Stiffness(model.shapes().tr_mul(&(part * model.shapes()))));
    let at_sensors = model.shapes().select_rows(&sensors) * units;
    let seen = SeenModes {
        shares: shares.collect(),
        modes: Modes::new(model.omega_squared().clone(), at_sensors).unwrap(),
    };
    let test = Modes::new(squares, shapes).unwrap();
    let (settings, names) = (Settings::default(), Names::default());
    let found = preflight_at_sensors(&seen, (&test, &[]), &settings, &[], &names).unwrap();
    (found, expected)
}

/// Shapes of unit largest component, as a test has them.
pub fn unit(mut shapes: DMatrix<f64>) -> DMatrix<f64> {
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        shape /= largest;
    }
    shapes
}
