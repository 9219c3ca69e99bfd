//! A parameter's part of the stiffness or mass of a whole model.

use super::SparseMatrix;
use super::sensor_model::ParameterMatrix;
use crate::method::error::{Error, check_count};
use nalgebra::DMatrix;

/// A parameter's part of the stiffness or mass, at the rows where it has entries.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) is_mass: bool,
    /// Rows of the whole, ascending.
    pub(super) rows: Vec<usize>,
    /// The part at these rows.
    matrix: SparseMatrix,
    /// Places of its entries among those of the whole.
    places: Vec<u32>,
}

impl Part {
    /// The part with entries (row, column, value) in a matrix of `count` rows.
    pub(super) fn of(
        is_mass: bool,
        entries: Vec<(usize, usize, f64)>,
        count: usize,
    ) -> Result<Self, Error> {
        let mut place_of = vec![usize::MAX; count];
        entries.iter().for_each(|entry| place_of[entry.0] = 0);
        let rows: Vec<usize> = (0..count).filter(|&row| place_of[row] == 0).collect();
        rows.iter()
            .enumerate()
            .for_each(|(place, &row)| place_of[row] = place);
        let own = entries
            .into_iter()
            .map(|(row, column, value)| (place_of[row], place_of[column], value));
        let size = rows.len().max(1);
        Ok(Self {
            is_mass,
            matrix: SparseMatrix::new("part of a parameter", size, size, own.collect())?,
            places: Vec::new(),
            rows,
        })
    }

    /// Row, column and value of every entry in the whole.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let entries = self.matrix.entries();
        entries.map(|(row, column, value)| (self.rows[row], self.rows[column], value))
    }

    /// This part with the places of its entries among those of the whole.
    pub(super) fn placed(mut self, whole: &SparseMatrix, starts: &[usize]) -> Result<Self, Error> {
        let places = self
            .entries()
            .filter_map(|entry| whole.place(starts, entry));
        self.places = places.collect();
        let all = self.matrix.entries().len();
        check_count("entries of a matrix", all, 0, self.places.len())?;
        Ok(self)
    }

    /// Adds the part times a number to the whole.
    pub(super) fn add_to(&self, whole: &mut SparseMatrix, number: f64) {
        whole.add(number, &self.places, &self.matrix);
    }

    /// Loads of the part in shapes that are given transposed at its rows (m × rows), at these too.
    pub(super) fn loads(&self, own: &DMatrix<f64>) -> DMatrix<f64> {
        self.matrix.loads(own)
    }

    /// The part at a factor, in shapes (DOF × m), m × m.
    pub(super) fn seen_by(
        &self,
        factor: f64,
        shapes: &DMatrix<f64>,
    ) -> Result<ParameterMatrix, Error> {
        let own = shapes.select_rows(&self.rows).transpose();
        let share = factor * self.matrix.through(&own)?;
        Ok(match self.is_mass {
            true => ParameterMatrix::Mass(share),
            false => ParameterMatrix::Stiffness(share),
        })
    }
}
