//! Coordinate systems of a Universal File: dataset 18 gives them by three points, dataset 2420 by a matrix.

use super::universal_block::{Block, LONG_REAL, VALUES};
use crate::files::axes::Axes;
use crate::files::error::FileError;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// Deviation from a rotation that a matrix may have: the round-off of six digits.
pub const ROTATION: f64 = 1e-4;

/// Coordinate systems by their numbers; 0, and 1 if it is not there, are the global axes.
pub type Systems = BTreeMap<usize, Axes>;

/// Dataset 18: origin, a point on the x axis and one in the xz plane, in an earlier system or in the global one, number zero.
pub fn by_points(block: &mut Block, systems: &mut Systems) -> Result<(), FileError> {
    while !block.is_done() {
        let numbers = block.integers("the number, type and reference of a coordinate system", 3)?;
        let base = if numbers[2] == 0 {
            Some(&Axes::GLOBAL)
        } else {
            systems.get(&numbers[2])
        };
        let base = *base.filter(|base| base.kind == 0).ok_or_else(|| {
            block.is_not(
                numbers[2],
                "zero or the number of a Cartesian coordinate system before this one",
            )
        })?;
        block.line("the name of a coordinate system")?;
        let mut points = block.reals("an origin and a point on the x axis", &VALUES)?;
        points.extend(block.reals("a point in the xz plane", &VALUES[..3])?);
        let points = [0, 3, 6].map(|at| Vector3::from_column_slice(&points[at..at + 3]));
        let own = base.through(points, numbers[1], 0, ROTATION);
        let own = own.ok_or_else(|| {
            block.wrong("the three points of this coordinate system lie on a line")
        })?;
        systems.insert(numbers[0], own);
    }
    Ok(())
}

/// Dataset 2420: the rows of a matrix are unit vectors along the axes, and the origin.
pub fn by_matrices(block: &mut Block, systems: &mut Systems) -> Result<(), FileError> {
    block.line("the number of a part")?;
    block.line("the name of a part")?;
    while !block.is_done() {
        let numbers = block.integers("the number and type of a coordinate system", 2)?;
        block.line("the name of a coordinate system")?;
        let mut row = || block.reals("a row of three numbers", &[LONG_REAL; 3]);
        let rows = [row()?, row()?, row()?, row()?].map(|row| Vector3::from_column_slice(&row));
        let (rotation, origin) = (Matrix3::from_columns(&rows[..3]), rows[3]);
        if (rotation.tr_mul(&rotation) - Matrix3::identity()).amax() > ROTATION {
            return Err(block.wrong("the three rows above are not unit vectors at right angles"));
        }
        systems.insert(
            numbers[0],
            Axes {
                kind: numbers[1],
                origin,
                rotation,
            },
        );
    }
    Ok(())
}
