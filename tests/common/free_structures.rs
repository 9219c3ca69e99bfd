//! Drawn structures with a place for every row, held or free, as matrices that a program writes with so many digits.

use crate::prelude::*;
use corfem::files::matrices::read;
use corfem::sparse::Places;

/// A structure by its stiffness and mass, with place and direction of every row, and how many motions nothing resists.
pub struct Drawn {
    pub stiffness: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    pub rows: Vec<(Vector3<f64>, usize)>,
    pub free: usize,
}

/// Kinds of drawn structures.
pub const KINDS: usize = 2;

/// A structure of a kind, of which the first grids are held or none.
pub fn drawn(draws: &mut Draws, kind: usize, is_held: bool) -> Drawn {
    match kind {
        0 => frame(draws, is_held),
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

/// The text of a symmetric matrix with so many digits, none standing for six decimals, and with its zeros if they are asked for.
pub fn written(matrix: &DMatrix<f64>, digits: usize, zeros: bool) -> String {
    let size = matrix.nrows();
    let places = (0..size).flat_map(|j| (j..size).map(move |i| (i, j)));
    let places = places
        .filter(|&at| zeros || matrix[at] != 0.0)
        .collect_vec();
    let lines = places.iter().map(|&(i, j)| match digits {
        0 => format!("{} {} {:.6}\n", i + 1, j + 1, matrix[(i, j)]),
        _ => format!("{} {} {:.*e}\n", i + 1, j + 1, digits - 1, matrix[(i, j)]),
    });
    let head = "%%MatrixMarket matrix coordinate real symmetric";
    format!(
        "{head}\n{size} {size} {}\n{}",
        places.len(),
        lines.collect::<String>()
    )
}

/// The matrix as read from a file with so many digits.
pub fn rewritten(matrix: &DMatrix<f64>, digits: usize) -> SparseMatrix {
    let text = written(matrix, digits, false);
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
