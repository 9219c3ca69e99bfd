//! Roots repeated more often than a block has directions, and other nasty pencils: 144 of them beside dense decompositions.

use crate::prelude::*;

/// Springs between two rows, or one and the ground.
type Springs = Vec<(usize, Option<usize>, f64)>;

struct Pencil {
    kind: &'static str,
    stiffness: SparseMatrix,
    mass: Vec<f64>,
    rigid: usize,
    counts: &'static [usize],
}

/// A random tree of springs of ten to the `decades`, as many again between random rows, and `ground` springs of other decades.
fn network(
    draws: &mut Draws,
    size: usize,
    decades: [f64; 2],
    (ground, of_ground): (usize, [f64; 2]),
) -> Springs {
    let stiffness =
        |draws: &mut Draws, [low, high]: [f64; 2]| 10_f64.powf(draws.between(low, high));
    let mut all = Vec::new();
    for row in 1..size {
        all.push((draws.below(row), Some(row), stiffness(draws, decades)));
    }
    for _ in 0..size {
        let (a, b) = (draws.below(size), draws.below(size));
        if a != b {
            all.push((a, Some(b), stiffness(draws, decades)));
        }
    }
    for _ in 0..ground {
        all.push((draws.below(size), None, stiffness(draws, of_ground)));
    }
    all
}

/// Fifty of the same side by side.
fn fifty(size: usize, one: &Springs) -> Springs {
    let copy = |at: usize| {
        one.iter()
            .map(move |&(a, b, k)| (at * size + a, b.map(|b| at * size + b), k))
    };
    (0..50).flat_map(copy).collect()
}

/// A square net of 13 by 13 equal masses, its border held or free.
fn net(is_held: bool) -> Springs {
    let side = 13;
    let mut all = Vec::new();
    for row in 0..side * side {
        let (x, y) = (row % side, row / side);
        for (at, other) in [(x, row + 1), (y, row + side)] {
            if at + 1 < side {
                all.push((row, Some(other), 1e4));
            } else if is_held {
                all.push((row, None, 1e4));
            }
            if at == 0 && is_held {
                all.push((row, None, 1e4));
            }
        }
    }
    all
}

/// The dozen kinds, once.
fn pencils(draws: &mut Draws) -> Vec<Pencil> {
    const USUAL: [f64; 2] = [4.0, 6.0];
    let held = (1, USUAL);
    let mut all = Vec::new();
    let mut add = |kind, size: usize, of: Springs, mass: Vec<f64>, rigid, counts| {
        all.push(Pencil {
            kind,
            stiffness: springs(size, &of),
            mass,
            rigid,
            counts,
        });
    };
    let size = [40, 151, 200, 260][draws.below(4)];
    let plain = network(draws, size, USUAL, held);
    let mass = (0..size).map(|_| draws.between(1.0, 10.0)).collect();
    add("plain", size, plain, mass, 0, &[1, 5, 20, 30]);
    let size = [30, 155, 220][draws.below(3)];
    let free = network(draws, size, USUAL, (0, USUAL));
    let mass = (0..size).map(|_| draws.between(1.0, 10.0)).collect();
    add("free", size, free, mass, 1, &[8]);
    let size = 3 + draws.below(3);
    let one = network(draws, size, USUAL, held);
    add(
        "50 copies",
        50 * size,
        fifty(size, &one),
        vec![3.0; 50 * size],
        0,
        &[1, 10, 50, 75, 100],
    );
    let one = network(draws, size, USUAL, (0, USUAL));
    add(
        "50 free copies",
        50 * size,
        fifty(size, &one),
        vec![3.0; 50 * size],
        50,
        &[10, 49, 50, 60],
    );
    let one = network(draws, 4, USUAL, held);
    let between = network(draws, 200, [-2.0, 0.0], (0, USUAL));
    let coupled = [fifty(4, &one), between].concat();
    add(
        "50 weakly coupled",
        200,
        coupled,
        vec![2.0; 200],
        0,
        &[10, 49, 50, 51],
    );
    let most = network(draws, 200, USUAL, held);
    let mass = (0..200)
        .map(|_| {
            if draws.unit() < 0.6 {
                0.0
            } else {
                draws.between(1.0, 5.0)
            }
        })
        .collect();
    add("most without mass", 200, most, mass, 0, &[10]);
    let few = network(draws, 170, USUAL, held);
    let mut mass = vec![0.0; 170];
    while mass.iter().filter(|mass| **mass > 0.0).count() < 7 {
        mass[draws.below(170)] = 5.0;
    }
    add("seven masses", 170, few, mass, 0, &[7]);
    let unlike = network(draws, 170, [0.0, 8.0], held);
    add(
        "stiffness over 8 decades",
        170,
        unlike,
        vec![1.0; 170],
        0,
        &[6],
    );
    let usual = network(draws, 170, USUAL, held);
    let mass = (0..170)
        .map(|_| 10_f64.powf(draws.between(-6.0, 3.0)))
        .collect();
    add("mass over 9 decades", 170, usual, mass, 0, &[10]);
    let soft = network(draws, 180, USUAL, (3, [-3.0, -2.0]));
    add("soft supports", 180, soft, vec![1.0; 180], 0, &[6]);
    add(
        "square net",
        169,
        net(true),
        vec![2.0; 169],
        0,
        &[2, 3, 9, 20, 100],
    );
    add(
        "free square net",
        169,
        net(false),
        vec![2.0; 169],
        1,
        &[1, 2, 3, 9, 20],
    );
    all
}

/// Squared frequencies of a pencil with a diagonal mass, ascending, those without mass condensed.
fn reference(stiffness: &DMatrix<f64>, mass: &[f64]) -> Vec<f64> {
    let (heavy, light): (Vec<usize>, Vec<usize>) =
        (0..mass.len()).partition(|&row| mass[row] > 0.0);
    let block =
        |rows: &[usize], columns: &[usize]| stiffness.select_rows(rows).select_columns(columns);
    let mut condensed = block(&heavy, &heavy);
    if !light.is_empty() {
        let factor = block(&light, &light).cholesky().unwrap();
        condensed -= block(&heavy, &light) * factor.solve(&block(&light, &heavy));
    }
    let scaled = |row: usize, column: usize| {
        0.5 * (condensed[(row, column)] + condensed[(column, row)])
            / (mass[heavy[row]] * mass[heavy[column]]).sqrt()
    };
    let mut roots = DMatrix::from_fn(heavy.len(), heavy.len(), scaled)
        .symmetric_eigenvalues()
        .as_slice()
        .to_vec();
    roots.sort_by(f64::total_cmp);
    roots
}

#[test]
fn clusters_wider_than_a_block_are_found_whole() {
    let mut draws = Draws(33);
    for _ in 0..12 {
        for Pencil {
            kind,
            stiffness,
            mass,
            rigid,
            counts,
        } in pencils(&mut draws)
        {
            let count = counts[draws.below(counts.len())];
            let found = lowest_modes(&stiffness, &masses(&mass), count).unwrap_or_else(|error| {
                panic!("{kind}, {} rows, {count} modes: {error}", mass.len())
            });
            assert_eq!(
                (found.rigid_body.ncols(), found.vibrations.len()),
                (rigid, count),
                "{kind}"
            );
            let roots = reference(&stiffness.dense(), &mass);
            let slack = ROUND_OFF_FLOOR * roots[roots.len() - 1];
            let found = found.vibrations.omega_squared().iter();
            for (found, root) in found.zip(&roots[rigid..]) {
                assert_within(found, root, CLUSTERED_ROOT * root + slack);
            }
        }
    }
}
