//! Drawn structures with a place for every row, held or free, as matrices that a program writes with so many digits.

use crate::prelude::*;
use corfem::files::matrices::read;
use corfem::sparse::Places;
use std::fmt::Write;

/// A structure by its stiffness and mass, with place and direction of every row, and how many motions nothing resists.
pub struct Drawn {
    pub stiffness: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    pub rows: Vec<(Vector3<f64>, usize)>,
    pub free: usize,
}

/// Kinds of drawn structures.
pub const KINDS: usize = 4;

/// A structure of a kind, of which the first grids are held or none.
pub fn drawn(draws: &mut Draws, kind: usize, is_held: bool) -> Drawn {
    match kind {
        0 => chain(draws, is_held),
        1 => beam(draws, is_held),
        2 => frame(draws, is_held),
        _ => truss(draws, is_held),
    }
}

/// The structure without its first rows.
fn without(all: Drawn, first: usize, free: usize) -> Drawn {
    let cut = |matrix: &DMatrix<f64>| matrix.view_range(first.., first..).into_owned();
    Drawn {
        stiffness: cut(&all.stiffness),
        mass: cut(&all.mass),
        rows: all.rows[first..].to_vec(),
        free,
    }
}

fn nothing(rows: Vec<(Vector3<f64>, usize)>, free: usize) -> Drawn {
    let zeros = zero_square(rows.len());
    Drawn {
        stiffness: zeros.clone(),
        mass: zeros,
        rows,
        free,
    }
}

fn add(into: &mut DMatrix<f64>, rows: &[usize], part: &DMatrix<f64>) {
    for (i, &row) in rows.iter().enumerate() {
        for (j, &column) in rows.iter().enumerate() {
            into[(row, column)] += part[(i, j)];
        }
    }
}

fn chain(draws: &mut Draws, is_held: bool) -> Drawn {
    let count = 5 + draws.below(40);
    let place = |at: usize| (Vector3::new(at as f64, 0.0, 0.0), 0);
    let mut all = nothing((0..count).map(place).collect(), 1);
    let spring = dmatrix![1.0, -1.0; -1.0, 1.0];
    for at in 0..count {
        all.mass[(at, at)] = draws.between(1.0, 5.0);
        if at > 0 {
            let size = 10_f64.powf(draws.between(4.0, 7.0));
            add(&mut all.stiffness, &[at - 1, at], &(size * &spring));
        }
    }
    if is_held { without(all, 1, 0) } else { all }
}

/// Stiffness of a beam of a length in deflection and slope at both ends, with a bending stiffness of one.
fn bending(length: f64) -> DMatrix<f64> {
    let (l, square) = (length, length * length);
    #[rustfmt::skip]
    let matrix = [
        12.0, 6.0 * l, -12.0, 6.0 * l,
        6.0 * l, 4.0 * square, -6.0 * l, 2.0 * square,
        -12.0, -6.0 * l, 12.0, -6.0 * l,
        6.0 * l, 2.0 * square, -6.0 * l, 4.0 * square,
    ];
    DMatrix::from_row_slice(4, 4, &matrix) / l.powi(3)
}

/// A beam along x in z and about y, in meters or millimeters.
fn beam(draws: &mut Draws, is_held: bool) -> Drawn {
    let (count, unit) = (10 + draws.below(40), [1.0, 1e3][draws.below(2)]);
    let lengths = (0..count)
        .map(|_| draws.between(0.5, 2.0) * unit * 10.0 / count as f64)
        .collect_vec();
    let mut x = 0.0;
    let mut rows = Vec::new();
    for at in 0..=count {
        rows.extend([2, 4].map(|direction| (Vector3::new(x, 0.0, 0.0), direction)));
        x += lengths.get(at).copied().unwrap_or(0.0);
    }
    let mut all = nothing(rows, 2);
    // A slope dw/dx turns about -y.
    let sign = DMatrix::from_fn(4, 4, |i, j| if (i + j) % 2 == 0 { 1.0 } else { -1.0 });
    for (at, &length) in lengths.iter().enumerate() {
        let size = 1e5 * draws.between(0.5, 2.0) * unit * unit;
        let own = (2 * at..2 * at + 4).collect_vec();
        add(
            &mut all.stiffness,
            &own,
            &(size * bending(length).component_mul(&sign)),
        );
        let mass = draws.between(0.5, 2.0) * length / unit;
        for row in own {
            let turned = if row % 2 == 1 {
                length * length / 12.0
            } else {
                1.0
            };
            all.mass[(row, row)] += 0.5 * mass * turned;
        }
    }
    if is_held { without(all, 2, 0) } else { all }
}

/// A plane frame of stories, turned in its plane.
fn frame(draws: &mut Draws, is_held: bool) -> Drawn {
    let (bays, unit) = (2 + draws.below(6), [1.0, 1e3][draws.below(2)]);
    let [wide, high] = [(); 2].map(|()| draws.between(0.5, 3.0) * unit);
    let (sin, cos) = draws.between(0.0, TAU).sin_cos();
    let place = |at: usize| {
        let (x, y) = ((at % 2) as f64 * wide, (at / 2) as f64 * high);
        Vector3::new(cos * x - sin * y, sin * x + cos * y, 0.0)
    };
    let rows = (0..2 * bays + 2).flat_map(|at| [0, 1, 5].map(|direction| (place(at), direction)));
    let mut all = nothing(rows.collect(), 3);
    let stories = (0..bays).flat_map(|at| {
        [
            (2 * at, 2 * at + 2),
            (2 * at + 1, 2 * at + 3),
            (2 * at + 2, 2 * at + 3),
        ]
    });
    let bent = 10_f64.powf(draws.between(3.0, 6.0));
    let stretched = bent * 10_f64.powf(draws.between(0.5, 3.0));
    for (a, b) in stories.chain([(0, 1)]) {
        let along = place(b) - place(a);
        let length = along.norm();
        let (c, s) = (along.x / length, along.y / length);
        let mut own = zero_square(6);
        let bar = dmatrix![1.0, -1.0; -1.0, 1.0];
        add(&mut own, &[0, 3], &(stretched * unit / length * bar));
        let size = bent * unit * unit * draws.between(0.5, 2.0);
        add(&mut own, &[1, 2, 4, 5], &(size * bending(length)));
        let turn = dmatrix![c, s, 0.0; -s, c, 0.0; 0.0, 0.0, 1.0];
        let mut turns = zero_square(6);
        add(&mut turns, &[0, 1, 2], &turn);
        add(&mut turns, &[3, 4, 5], &turn);
        let own = turns.tr_mul(&own) * turns;
        let places = [a, b]
            .iter()
            .flat_map(|at| [3 * at, 3 * at + 1, 3 * at + 2])
            .collect_vec();
        add(
            &mut all.stiffness,
            &places,
            &(0.5 * (&own + own.transpose())),
        );
        for row in places {
            let turned = if row % 3 == 2 {
                length * length / 12.0
            } else {
                1.0
            };
            all.mass[(row, row)] += 0.5 * length / unit * turned;
        }
    }
    if is_held { without(all, 6, 0) } else { all }
}

/// A space truss of braced cells.
fn truss(draws: &mut Draws, is_held: bool) -> Drawn {
    let cells = 1 + draws.below(4);
    let lattice: Vec<[usize; 3]> = (0..4 * cells + 4)
        .map(|at| [at / 4, at / 2 % 2, at % 2])
        .collect();
    let sizes = Vector3::from_fn(|_, _| draws.between(0.5, 2.0));
    let places = lattice
        .iter()
        .map(|at| {
            Vector3::from_fn(|axis, _| at[axis] as f64 * sizes[axis] + draws.between(-0.05, 0.05))
        })
        .collect_vec();
    let rows = places
        .iter()
        .flat_map(|&place| [0, 1, 2].map(|direction| (place, direction)));
    let mut all = nothing(rows.collect(), 6);
    for a in 0..places.len() {
        for b in 0..a {
            let steps = |axis: usize| lattice[a][axis].abs_diff(lattice[b][axis]);
            if (0..3).any(|axis| steps(axis) > 1) || (0..3).map(steps).sum::<usize>() > 2 {
                continue;
            }
            let along = places[a] - places[b];
            let unit = along.normalize();
            let way = DMatrix::from_fn(
                6,
                1,
                |row, _| if row < 3 { -unit[row] } else { unit[row - 3] },
            );
            let size = 1e6 * draws.between(0.5, 2.0) / along.norm();
            let own = [b, a]
                .iter()
                .flat_map(|at| [3 * at, 3 * at + 1, 3 * at + 2])
                .collect_vec();
            add(&mut all.stiffness, &own, &(size * &way * way.transpose()));
        }
    }
    for row in 0..all.rows.len() {
        all.mass[(row, row)] = draws.between(1.0, 3.0);
    }
    if is_held { without(all, 12, 0) } else { all }
}

/// The text of a symmetric matrix with so many digits.
pub fn written(matrix: &DMatrix<f64>, digits: usize) -> String {
    let size = matrix.nrows();
    let lower = (0..size).flat_map(|column| (column..size).map(move |row| (row, column)));
    let lower = lower.filter(|at| matrix[*at] != 0.0).collect_vec();
    let mut text = format!(
        "%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {}\n",
        lower.len()
    );
    for at in lower {
        let _ = writeln!(
            text,
            "{} {} {:.*e}",
            at.0 + 1,
            at.1 + 1,
            digits - 1,
            matrix[at]
        );
    }
    text
}

/// The matrix as read from a file with so many digits.
pub fn rewritten(matrix: &DMatrix<f64>, digits: usize) -> SparseMatrix {
    let text = written(matrix, digits);
    read("matrix", text.as_bytes(), None).unwrap().matrix
}

impl Drawn {
    /// What places of so many digits tell of its motions.
    pub fn support(&self, digits: usize) -> Support {
        let rounded = |part: f64| format!("{part:.*e}", digits - 1).parse().unwrap();
        let rows = self
            .rows
            .iter()
            .map(|(place, direction)| (place.map(rounded), *direction))
            .collect_vec();
        Support {
            places: Some(Places::new(&rows, 0.5 * 10_f64.powf(1.0 - digits as f64))),
            ..Support::default()
        }
    }
}
