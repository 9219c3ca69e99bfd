//! Modes of sparse pencils by a subspace that counts: closed forms, dense matrices, and a mode that is missing.

use crate::prelude::*;
use chain_of_springs as chain;
use corfem::sparse::BodyFinding;

#[test]
fn a_long_chain_has_the_closed_form_whatever_holds_it() {
    for ends in [
        ChainEnds::FreeFree,
        ChainEnds::FixedFree,
        ChainEnds::FixedFixed,
    ] {
        let (count, spring, mass) = (2000, 3.0e5, 0.02);
        let expected = chain_eigenvalues(ends, count, spring, mass);
        let found =
            lowest_modes(&chain(ends, count, spring), &masses(&vec![mass; count]), 20).unwrap();
        let rigid = usize::from(matches!(ends, ChainEnds::FreeFree));
        assert_eq!(found.rigid_body.ncols(), rigid);
        for (mode, omega_squared) in found.vibrations.omega_squared().iter().enumerate() {
            let expected = expected[mode + rigid];
            assert!(
                relative_error(omega_squared, expected) < COUNTED_ROOT,
                "{ends:?} {mode}: {omega_squared} {expected}"
            );
        }
    }
}

/// In subspaces modes are sought until nothing is left of them outside, where their frequencies would be right long before.
#[test]
fn shapes_are_found_as_well_as_frequencies() {
    for (count, spring, mass) in [(400, 1e9, 1e-3), (300, 1.0, 1.0), (500, 1e-6, 1e3)] {
        let stiffness = chain(ChainEnds::FixedFree, count, spring);
        let mass = masses(&vec![mass; count]);
        for modes in [1, 2, 3, 5, 8, 12, 20, 30] {
            let found = lowest_modes(&stiffness, &mass, modes).unwrap().vibrations;
            for (mode, omega_squared) in found.omega_squared().iter().enumerate() {
                let shape = found.shapes().columns(mode, 1).into_owned();
                let forces = stiffness.times(&shape).unwrap();
                let residual = &forces - *omega_squared * mass.times(&shape).unwrap();
                let part = residual.norm() / forces.norm();
                assert!(part < TWO_PROGRAMS, "{mode} of {modes}: {part:e}");
            }
        }
    }
}

/// A square net of springs has sums of the chain's eigenvalues, most of them twice.
#[test]
fn repeated_roots_of_a_square_net_are_all_found() {
    let side = 31;
    let mut all = Vec::new();
    for i in 0..side {
        for j in 0..side {
            let at = |i: usize, j: usize| i * side + j;
            let right = if i + 1 < side {
                Some(at(i + 1, j))
            } else {
                None
            };
            let up = if j + 1 < side {
                Some(at(i, j + 1))
            } else {
                None
            };
            all.extend([(at(i, j), right, 1.0e4), (at(i, j), up, 1.0e4)]);
            all.extend((i == 0).then_some((at(i, j), None, 1.0e4)));
            all.extend((j == 0).then_some((at(i, j), None, 1.0e4)));
        }
    }
    let one = chain_eigenvalues(ChainEnds::FixedFixed, side, 1.0e4, 0.5);
    let mut expected = one
        .iter()
        .flat_map(|a| one.iter().map(move |b| a + b))
        .collect_vec();
    expected.sort_by(f64::total_cmp);
    for count in [1, 2, 7, 24] {
        let found = lowest_modes(
            &springs(side * side, &all),
            &masses(&vec![0.5; side * side]),
            count,
        )
        .unwrap();
        assert_alike(
            found.vibrations.omega_squared().iter(),
            &expected,
            COUNTED_ROOT,
        );
        let (m, shapes) = (masses(&vec![0.5; side * side]), found.vibrations.shapes());
        let unit = shapes.tr_mul(&m.times(shapes).unwrap());
        assert!((unit - eye(count)).amax() < WHOLE_SHAPE);
    }
}

/// Random nets with massless points and loose parts: the subspace finds what dense matrices do.
#[test]
fn random_sparse_pencils_have_the_modes_of_their_dense_ones() {
    let mut draws = Draws(7);
    for number in 0..30 {
        let count = MOST_DENSE_ROWS + 1 + draws.below(100);
        let is_held = draws.below(2) == 0;
        let mut all = (1..count)
            .map(|row| {
                (
                    row,
                    Some(draws.below(row)),
                    10.0_f64.powf(4.0 + draws.unit()),
                )
            })
            .collect_vec();
        all.extend(
            (0..count).map(|row| (row, Some((row + 7) % count), 1.0e4 * (0.1 + draws.unit()))),
        );
        all.extend(is_held.then_some((0, None, 1.0e4)));
        let massless = draws.below(3);
        let values = (0..count)
            .map(|row| {
                if massless > 0 && row % (massless + 1) == 0 {
                    0.0
                } else {
                    0.1 + draws.unit()
                }
            })
            .collect_vec();
        let (stiffness, mass) = (springs(count, &all), masses(&values));
        let wanted = 1 + draws.below(12);
        let found = lowest_modes(&stiffness, &mass, wanted)
            .unwrap_or_else(|error| panic!("{number}: {error}"));
        let dense = counted_modes(&stiffness.dense(), &mass.dense()).unwrap();
        assert_eq!(found.rigid_body.ncols(), usize::from(!is_held), "{number}");
        for (mode, omega_squared) in found.vibrations.omega_squared().iter().enumerate() {
            let expected = dense.vibrations.omega_squared()[mode];
            assert!(
                relative_error(omega_squared, expected) < COUNTED_ROOT,
                "{number} {mode}: {omega_squared} {expected}"
            );
            let shape = found.vibrations.shapes().columns(mode, 1).into_owned();
            let residual =
                stiffness.times(&shape).unwrap() - *omega_squared * mass.times(&shape).unwrap();
            assert!(
                residual.norm() < WHOLE_SHAPE * stiffness.times(&shape).unwrap().norm(),
                "{number} {mode}"
            );
        }
    }
}

/// A soft spring to the ground, a thousand-billionth of a millionth of the others: no double tells it.
#[test]
fn what_counts_as_free_by_its_digits_says_what_they_would_hide() {
    let stiffness = springs(2, &[(0, Some(1), 1.5e4 / 0.7), (0, None, 1e-11 / 0.7)]);
    let at = MassDof {
        dof: Vec::new(),
        load_distribution: masses(&[1.0, 1.0]),
        mass: DVector::from_vec(vec![2.0, 3.0]),
    };
    let name = |row: usize| format!("row {row}");
    let found = whole_modes(&stiffness, at, 2, &Support::default(), name).unwrap();
    let [
        BodyFinding::ByDigits {
            count: 1,
            hidden_hz,
            ..
        },
    ] = found.doubtful[..]
    else {
        panic!("{:?}", found.doubtful)
    };
    assert_eq!(found.rigid_body, 1);
    // The slack, 30 roundings of twice the spring at both rows, on the whole mass.
    let slack = 4.0 * 30.0 * f64::EPSILON * 1.5e4 / 0.7;
    let hertz = (slack / 5.0).sqrt() / TAU;
    assert!(
        relative_error(hidden_hz, hertz) < JOB_RESULTS,
        "{hidden_hz} {hertz}"
    );
}

#[test]
fn a_factor_counts_negative_eigenvalues_and_solves() {
    let mut draws = Draws(3);
    for count in [1, 2, 5, 40, 300] {
        let entries = (0..count).flat_map(|row| {
            let other = draws.below(count);
            let (own, off) = (4.0 * draws.unit() - 2.0, draws.unit() - 0.5);
            let pair = if other == row {
                vec![]
            } else {
                vec![(row, other, off), (other, row, off)]
            };
            [vec![(row, row, own)], pair].concat()
        });
        let matrix = SparseMatrix::new("random", count, count, entries.collect()).unwrap();
        let eigenvalues = matrix.dense().symmetric_eigenvalues();
        let factor = Factor::new("random", &matrix).unwrap();
        assert_eq!(
            factor.negative_count(),
            eigenvalues.iter().filter(|value| **value < 0.0).count()
        );
        let right = DMatrix::from_fn(count, 2, |_, _| draws.unit());
        let solved = factor.solve(&right).unwrap();
        let residual = matrix.times(&solved).unwrap() - &right;
        assert!(
            residual.amax() < COUNTED_ROOT * (1.0 + solved.amax()),
            "{count}: {}",
            residual.amax()
        );
    }
}

/// What a search costs is how many loads the factor is solved for. The numbers are this program's own, of November 2026. A mass on a
/// spring far softer than the chain's has a root so large that its round-off hides what is left of the others; nine chains that do not
/// touch have every root nine times, more often than a block has directions.
#[test]
fn a_search_takes_as_many_solutions_as_it_took() {
    let (held, free) = (ChainEnds::FixedFree, ChainEnds::FreeFree);
    let link = |row: usize| (row, row.checked_sub(1), 1.0);
    let beside = |soft| {
        springs(
            401,
            &[(0..400).map(link).collect(), vec![(400, None, soft)]].concat(),
        )
    };
    let nine = (0..9 * 40).map(|row| (row, (row % 40 > 0).then(|| row - 1), 1.0));
    let nine = springs(9 * 40, &nine.collect_vec());
    let solutions = |stiffness: &SparseMatrix, count| {
        let mass = masses(&vec![1.0; stiffness.rows()]);
        let found = lowest_modes(stiffness, &mass, count).unwrap();
        found.solutions
    };
    let took = [
        solutions(&chain(held, 120, 1.0), 3),
        solutions(&chain(held, 400, 1.0), 1),
        solutions(&chain(held, 400, 1.0), 20),
        solutions(&chain(free, 400, 1.0), 6),
        solutions(&chain(held, 2000, 1.0), 40),
        solutions(&beside(1e-14), 8),
        solutions(&beside(1e-18), 26),
        solutions(&nine, 5),
    ];
    assert_eq!(took, [120, 93, 128, 106, 204, 104, 151, 121]);
}
