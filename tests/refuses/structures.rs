//! Singular structures: whatever nothing holds is named, and nothing that is held is refused.

use crate::common::structures::{free_motions, rod};
use crate::prelude::*;

/// Grid and direction that a singular structure is refused with.
fn refusal(structure: &Structure) -> (usize, char) {
    named(refused(structure, None))
}

fn named(error: Error) -> (usize, char) {
    match error {
        Error::SingularStiffness { grid, direction } => (grid, direction),
        other => panic!("expected a singular stiffness, found {other:?}"),
    }
}

/// A model of the structure with its first DOF as the dynamic one.
fn model_of(structure: &Structure) -> FiniteElementModel {
    let (one, count) = (eye(1), structure.free_dof().len());
    let parameters = vec![Parameter::new(1, &[1])];
    let t = DMatrix::identity(count, 1);
    FiniteElementModel::new(structure.clone(), t, one, parameters).unwrap()
}

/// Why a model of the structure has no matrices, with another stiffness of its elements if one is given.
fn refused(structure: &Structure, units: Option<Vec<DMatrix<f64>>>) -> Error {
    let model = model_of(structure);
    let model = match units {
        Some(units) => model.with_unit_stiffness(units).unwrap(),
        None => model,
    };
    model
        .matrices(&[1.0])
        .map(drop)
        .expect_err("it is singular")
}

fn row_of(structure: &Structure, grid: usize, direction: char) -> usize {
    let direction = DIRECTIONS
        .iter()
        .position(|&name| name == direction)
        .unwrap();
    structure.free_dof_index(grid, direction).unwrap()
}

properties! {
    /// A linkage has one free motion and no DOF without stiffness; the grid named is one of those that move in it.
    #[test]
    fn a_mechanism_is_refused_by_a_grid_that_moves((apex, areas) in linkage_data()) {
        let structure = linkage(apex, areas, false);
        prop_assert_eq!(free_motions(&dense(&structure)).ncols(), 1);
        let (grid, direction) = refusal(&structure);
        prop_assert!([3, 4].contains(&grid), "{grid}{direction}");
        prop_assert!(model_of(&linkage(apex, areas, true)).matrices(&[1.0]).is_ok(), "the braced one");
    }

    /// A chain of rods in space, its first grid fixed, has two free motions a rod; the DOF named takes part in them.
    #[test]
    fn a_chain_in_space_is_refused_by_a_dof_that_moves(
        steps in prop::collection::vec((0.2..1.0_f64, 0.2..1.0_f64, 0.2..1.0_f64), 1..6),
    ) {
        let mut at = [0.0; 3];
        let mut grids = vec![grid(1, at, [true; 3])];
        for (k, &(x, y, z)) in steps.iter().enumerate() {
            let turn = if k % 2 == 0 { 1.0 } else { -1.0 };
            at = [at[0] + x, at[1] + turn * y, at[2] + z];
            grids.push(grid(k + 2, at, [false; 3]));
        }
        let rods = (1..=steps.len()).map(|k| rod(k, [k, k + 1], 1.0)).collect();
        let structure = Structure::new(grids, rods)?;
        let (grid, direction) = refusal(&structure);
        let motions = free_motions(&dense(&structure));
        prop_assert_eq!(motions.ncols(), 2 * steps.len());
        let share = motions.row(row_of(&structure, grid, direction)).norm() / motions.norm();
        prop_assert!(share * (motions.nrows() as f64).sqrt() > TAKES_PART, "{share:e}");
    }
}

#[test]
fn a_dof_without_stiffness_is_refused_by_name() {
    let free_end = |from: [f64; 3]| {
        let grids = vec![
            grid(11, from, [true; 3]),
            grid(12, [1.0, 1.0, 1.0], [false; 3]),
        ];
        Structure::new(grids, vec![rod(1, [11, 12], 1.0)]).unwrap()
    };
    // A rod along x leaves y and z alone, the first of which is named; one along z leaves x and y.
    assert_eq!(refusal(&free_end([0.0, 1.0, 1.0])), (12, 'y'));
    assert_eq!(refusal(&free_end([1.0, 1.0, 0.0])), (12, 'x'));
    assert_eq!(
        refused(&free_end([0.0, 1.0, 1.0]), None).to_string(),
        "nothing holds grid 12 along y"
    );
}

/// Two DOF coupled to within δ of moving freely together have the eigenvalue δ; the last pivot, twice δ, is the smallest. Round-off in a
/// structure of a hundred DOF is more than 3e-14, in one of two it is less.
#[test]
fn a_stiffness_within_round_off_of_singular_is_refused() {
    let coupled = |count: usize, delta: f64| {
        let mut stiffness = eye(count);
        stiffness[(0, 1)] = delta - 1.0;
        stiffness[(1, 0)] = delta - 1.0;
        condense(&stiffness, &DMatrix::identity(count, 1)).map(drop)
    };
    assert!(coupled(2, 3e-14).is_ok());
    assert!(coupled(100, 3e-13).is_ok());
    for (count, delta) in [(2, 3e-15), (100, 3e-14)] {
        let refused = coupled(count, delta);
        assert!(is_not_definite(&refused, 1), "{count}: {refused:?}");
    }
}

/// Whether the structural stiffness is refused by this row.
fn is_not_definite<T>(answer: &Result<T, Error>, row: usize) -> bool {
    matches!(answer, Err(Error::NotPositiveDefinite { what: "structural stiffness", row: found }) if *found == row)
}

/// No element of this crate is indefinite; one handed in is named by the grid of the row where the factorization stops.
#[test]
fn an_indefinite_stiffness_is_refused_where_it_shows() {
    let structure = spring_chain(&[1.0, 1.0], [true, false]);
    let unit = |sign: f64| dmatrix![1.0, -sign; -sign, sign];
    for units in [
        vec![eye(1), unit(-1.0)],
        vec![eye(1), 4.0 * unit(1.0) - 3.5 * eye(2)],
    ] {
        assert_eq!(named(refused(&structure, Some(units))), (3, 'x'));
    }
}

/// Rods 1 and 3 stand on the ground side by side, so that both upper corners move alike, across the rods.
#[test]
fn a_mechanism_is_refused_by_the_dof_that_moves_most_in_it() {
    for (apex, expected) in [
        ([[1.0, 1.0], [0.0, 1.0]], 'x'),
        ([[3.0, 1.0], [2.0, 1.0]], 'z'),
    ] {
        let (grid, direction) = refusal(&linkage(apex, [1.0, 2.0, 0.5, 1.0], false));
        assert!(
            [3, 4].contains(&grid) && direction == expected,
            "{grid}{direction}"
        );
    }
}

/// It is singular for the smallest eigenvalue with a diagonal of ones, in any unit of stiffness.
#[test]
fn a_motion_is_named_in_any_unit() {
    let structure = spring_chain(&[1.0, 1.0], [true, false]);
    for power in [-20, 0, 20] {
        let units = |delta: f64| {
            let coupled = dmatrix![1.0, delta - 1.0; delta - 1.0, 1.0];
            vec![zero_square(1), 2.0_f64.powi(power) * coupled]
        };
        assert_eq!(named(refused(&structure, Some(units(3e-15)))), (3, 'x'));
        let held = model_of(&structure).with_unit_stiffness(units(3e-14));
        assert!(held.and_then(|model| model.matrices(&[1.0])).is_ok());
    }
}
