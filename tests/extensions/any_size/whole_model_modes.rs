//! Modes of sparse pencils by a subspace that counts: closed forms, dense matrices, and a mode that is missing.

use crate::prelude::*;
use chain_of_springs as chain;

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
