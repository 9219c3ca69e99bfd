//! Structures unlike the box, by a seed: a chain, a symmetric ring and net with repeated modes, a chain with light oscillators, and a truss
//! whose points move in two directions.

use crate::prelude::*;
use corfem::sparse::random::uniform;

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

/// Shapes of unit largest component, as a test has them.
pub fn unit(mut shapes: DMatrix<f64>) -> DMatrix<f64> {
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        shape /= largest;
    }
    shapes
}
