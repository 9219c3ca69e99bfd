//! Test modes closer than their deviations tell: what is compared is the subspace of their shapes.

use crate::prelude::*;

/// Two towers of three floors side by side, one stiffer than the other by `split`, and a test of both in which every pair of modes is
/// turned by an angle (radians) and its stiffer tower is stiffer by `truth`.
pub fn towers([split, truth, angle]: [f64; 3]) -> Files {
    let tower = |first: usize, size: f64| {
        let spring =
            move |row: usize| (first + row, row.checked_sub(1).map(|row| first + row), size);
        springs(6, &[0, 1, 2].map(spring)).dense()
    };
    let parts = [tower(0, 1e5), tower(3, 1e5 * split)];
    // Roots and shapes of a fixed and free chain of three.
    let (mut hertz, mut shapes) = (Vec::new(), zero_square(6));
    let (sine, cosine) = angle.sin_cos();
    for mode in 0..3 {
        let phase = PI * (2 * mode + 1) as f64 / 7.0;
        let frequency = (2e3_f64 * (2.0 - 2.0 * phase.cos())).sqrt() / TAU;
        hertz.extend([frequency, frequency * truth.sqrt()]);
        for floor in 0..3 {
            let moved = (phase * (floor + 1) as f64).sin();
            let turned = moved * dmatrix![cosine, -sine; sine, cosine];
            for (part, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                shapes[(floor + 3 * part, 2 * mode + column)] = turned[(part, column)];
            }
        }
    }
    let modes = Modes::from_measured(&hertz, &shapes).unwrap();
    of_matrices(&parts, &(50.0 * eye(6)), &modes)
}

/// What comes of a job in which every test mode is its partner's, whatever the combination.
fn all_alike(files: &Files) -> JobResult {
    let result = finished(&prepared(files));
    let modes = report_of(&result).modes;
    assert!(modes.iter().all(|own| own.corrected_mac > Some(1.0 - 1e-9)));
    assert!(!result.trust.has_doubt(), "{:?}", result.trust);
    result
}

#[test]
fn turned_shapes_of_close_modes_are_no_error() {
    // Equal in the model or a little apart; in the test apart by half the least that it tells.
    for (split, angle) in [(1.0, 0.6), (1.0, 0.785), (1.002, -0.4)] {
        let files = towers([split, 1.014, angle]);
        let result = all_alike(&files);
        assert_eq!(
            prepared(&files).together,
            [vec![0, 1], vec![2, 3], vec![4, 5]]
        );
        assert_eq!(about(&result.trust, "close-modes-3-4"), ["3", "4"]);
        assert!(!result.trust.stands_against());
        assert!(result.verdict.is_within);
        // Turned shapes leave nothing: every factor follows the frequencies of both towers.
        for factor in &result.found.factors {
            assert_within(factor, 1.007, 0.01);
        }
        assert!(result.misfit.chi_squared < 1.0);
    }
}

/// A ring of six masses has two shapes at each of two roots, and its parameters leave it a ring: a test that has one of the two may have
/// any of their combinations.
#[test]
fn one_mode_of_a_double_root_is_compared_with_the_whole_of_it() {
    let ring = DMatrix::from_fn(6, 6, |a, b| match (a + 6 - b) % 6 {
        0 => 6e4,
        1 | 5 => -3e4,
        _ => 0.0,
    });
    let (parts, mass) = (
        [ring, 1e4 * DMatrix::identity(6, 6)],
        DMatrix::identity(6, 6),
    );
    let truth = [1.12, 0.9];
    let all = solve(&(truth[0] * &parts[0] + truth[1] * &parts[1]), &mass, 6).unwrap();
    for angle in [0.3_f64, 1.0, 2.2] {
        let mix = |first: usize| {
            let both = all.shapes().columns(first, 2);
            both * dvector![angle.cos(), angle.sin()]
        };
        let shapes = DMatrix::from_columns(&[all.shapes().column(0).into_owned(), mix(1), mix(3)]);
        let squares = all.omega_squared();
        let test = Modes::new(dvector![squares[0], squares[1], squares[3]], shapes).unwrap();
        let result = all_alike(&of_matrices(&parts, &mass, &test));
        // What is left is the pull of the prior.
        assert!(result.misfit.chi_squared < 1e-3);
        assert_alike(&result.found.factors, truth, 1e-3);
    }
}
