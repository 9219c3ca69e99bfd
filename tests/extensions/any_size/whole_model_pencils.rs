//! Sparse pencils that are hard to find modes of: in unlike units, with loose parts, with few masses, and with roots that repeat.

use crate::prelude::*;

/// More than are solved as dense matrices.
const ROWS: usize = MOST_DENSE_ROWS + 50;

fn assert_roots(found: &CountedModes, expected: &[f64], what: &str) {
    assert_eq!(found.vibrations.len(), expected.len(), "{what}");
    for (found, expected) in found.vibrations.omega_squared().iter().zip(expected) {
        assert!(
            relative_error(found, expected) < COUNTED_ROOT,
            "{what}: {found} {expected}"
        );
    }
}

/// Each spring of its own stands between one mass and the ground.
fn oscillators(omega_squared: &[f64]) -> SparseMatrix {
    springs(
        omega_squared.len(),
        &omega_squared
            .iter()
            .enumerate()
            .map(|(row, &k)| (row, None, k))
            .collect_vec(),
    )
}

#[test]
fn units_of_stiffness_and_mass_only_scale_the_roots_and_shapes() {
    for ends in [ChainEnds::FreeFree, ChainEnds::FixedFree] {
        for (spring, mass) in [
            (1.0, 1.0),
            (1e9, 1e-9),
            (1e-9, 1e9),
            (1e12, 1e12),
            (1e-12, 1e-12),
        ] {
            let what = format!("{ends:?} {spring:e} {mass:e}");
            let matrix = chain_of_springs(ends, ROWS, spring);
            let found = lowest_modes(&matrix, &masses(&[mass; ROWS]), 10)
                .unwrap_or_else(|error| panic!("{what}: {error}"));
            let rigid = usize::from(ends == ChainEnds::FreeFree);
            assert_eq!(found.rigid_body.ncols(), rigid, "{what}");
            assert_roots(
                &found,
                &chain_eigenvalues(ends, ROWS, spring, mass)[rigid..rigid + 10],
                &what,
            );
            let shapes = found.vibrations.shapes();
            assert!(
                (mass * shapes.tr_mul(shapes) - eye(10)).amax() < WHOLE_SHAPE,
                "{what}"
            );
        }
    }
}

#[test]
fn every_loose_part_has_a_rigid_body_motion() {
    // Eight chains side by side, more than the modes beyond those asked for.
    let (parts, length) = (8, ROWS / 8);
    let stiffness_of = |part: usize| 1.0 + 0.2 * part as f64;
    let all = (0..parts).flat_map(|part| {
        (1..length).map(move |row| {
            (
                part * length + row,
                Some(part * length + row - 1),
                stiffness_of(part),
            )
        })
    });
    let stiffness = springs(parts * length, &all.collect_vec());
    let mass = masses(&vec![0.5; parts * length]);
    let vibrations = |part: usize| {
        chain_eigenvalues(ChainEnds::FreeFree, length, stiffness_of(part), 0.5).split_off(1)
    };
    let mut expected = (0..parts).flat_map(vibrations).collect_vec();
    expected.sort_by(f64::total_cmp);
    for count in [1, 2, 12] {
        let found = lowest_modes(&stiffness, &mass, count).unwrap();
        assert_eq!(found.rigid_body.ncols(), parts);
        assert_roots(&found, &expected[..count], &count.to_string());
    }
}

#[test]
fn a_root_more_often_repeated_than_modes_are_asked_for_is_found_whole() {
    for unit in [1e-9, 1.0, 1e9, 1e15] {
        let repeated = |times: usize| {
            let others = (times..ROWS).map(|place| unit * (4.5 + 0.1 * (place - times) as f64));
            oscillators(
                &[4.0 * unit]
                    .repeat(times)
                    .into_iter()
                    .chain(others)
                    .collect_vec(),
            )
        };
        let mass = masses(&[1.0; ROWS]);
        for times in [5, 6, 40] {
            let found = lowest_modes(&repeated(times), &mass, 1).unwrap();
            assert_roots(&found, &[4.0 * unit], &times.to_string());
        }
    }
}

#[test]
fn roots_are_found_that_lie_ten_thousandfold_apart() {
    let expected = chain_eigenvalues(ChainEnds::FixedFree, 2 * ROWS, 7.0, 2.0);
    assert!(expected[79] > 1e4 * expected[0]);
    let stiffness = chain_of_springs(ChainEnds::FixedFree, 2 * ROWS, 7.0);
    assert_roots(
        &lowest_modes(&stiffness, &masses(&[2.0; 2 * ROWS]), 80).unwrap(),
        &expected[..80],
        "80 modes",
    );
}

#[test]
fn a_difference_between_triangles_is_told_relative_to_the_rows_it_is_in() {
    // A soft pair of rows beside a row a million million times as stiff.
    let soft = |above: f64| {
        let entries = vec![
            (0, 0, 1e12),
            (1, 1, 4.0),
            (2, 2, 1.0),
            (1, 2, above),
            (2, 1, 1.0),
        ];
        SparseMatrix::new("m", 3, 3, entries).unwrap()
    };
    let found = |above: f64| match soft(above).check_symmetric("m") {
        Err(Error::Value { owner, value, .. }) => {
            assert_eq!(owner, "m, entry (2, 1) beside its mirror");
            Some(value)
        }
        _ => None,
    };
    assert_eq!(found(1.5), Some(0.25), "over the root of 4 times 1");
    assert_eq!(
        found(5.0),
        Some(1.0),
        "over the difference, which is larger"
    );
    assert_eq!(found(1.0 + 1e-12), None, "round-off");
    // Without a diagonal an entry is its own scale.
    let saddle = |above: f64| {
        SparseMatrix::new("m", 2, 2, vec![(0, 1, above), (1, 0, 2.0)])
            .unwrap()
            .check_symmetric("m")
    };
    assert!(saddle(2.0 + 1e-12).is_ok() && saddle(2.0 + 1e-9).is_err());
}
