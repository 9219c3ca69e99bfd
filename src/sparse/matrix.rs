//! A real matrix by its nonzero entries.

use crate::method::error::{Error, at_least_one, check_count, require};
use crate::method::linear_algebra::{check_length, check_shape, symmetric_part};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// Largest difference between two entries that should be equal, relative to the largest of the matrix: files carry twelve digits.
pub(super) const GIVEN: f64 = 1e-11;

/// Part of an entry by which assembling rounds it: a sum of some thirty parts.
pub(super) const ASSEMBLED: f64 = 30.0 * f64::EPSILON;

/// Half the unit of the last place with which a matrix's entries are written: a part of each, or one number for all. Zeros are exact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct HalfUnit {
    part: f64,
    fixed: f64,
}

impl HalfUnit {
    /// Half a unit of so large a part of each entry, and never less than assembling rounds.
    pub(crate) fn of_each(part: f64) -> Self {
        let part = part.max(ASSEMBLED);
        Self { part, fixed: 0.0 }
    }

    /// One number for all entries.
    pub(crate) fn of_all(fixed: f64) -> Self {
        Self {
            fixed,
            ..Self::of_each(0.0)
        }
    }

    /// The most by which rounding moves an entry.
    pub(crate) fn of(self, value: f64) -> f64 {
        match value == 0.0 {
            true => 0.0,
            false => self.fixed.max(self.part * value.abs()),
        }
    }

    /// True if it is more than assembling rounds.
    pub(crate) fn is_written(self) -> bool {
        self.fixed > 0.0 || self.part > ASSEMBLED
    }

    /// Digits or decimals in words.
    pub(crate) fn words(self) -> String {
        match (1.0 - (2.0 * self.part).log10()).round() {
            _ if self.fixed > 0.0 => format!("numbers written to {:.0e}", 2.0 * self.fixed),
            _ if !self.is_written() => "the digits of a double".to_owned(),
            count => format!("{count} digits"),
        }
    }
}

/// A real matrix by its nonzero entries, column by column and in each from the first row down; no place is given twice.
///
/// A symmetric one has both triangles. Clones share the places.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseMatrix {
    rows: usize,
    columns: usize,
    /// Row and column of every entry.
    places: Arc<Vec<[u32; 2]>>,
    values: Vec<f64>,
    half_unit: HalfUnit,
}

impl SparseMatrix {
    /// A matrix of the given size from its entries (row, column, value) in any order; entries at one place add up, and zeros are
    /// left out.
    ///
    /// # Errors
    /// [`Error::Count`] without rows or columns, and for more than $2^{32} - 1$; [`Error::Count`] for a place outside; [`Error::Value`].
    pub fn new(
        what: &'static str,
        rows: usize,
        columns: usize,
        entries: Vec<(usize, usize, f64)>,
    ) -> Result<Self, Error> {
        at_least_one(what, rows.min(columns))?;
        check_count("rows of a matrix", rows, 1, u32::MAX as usize)?;
        check_count("columns of a matrix", columns, 1, u32::MAX as usize)?;
        for &(row, column, _) in &entries {
            check_count("rows of a matrix", row.saturating_add(1), 1, rows)?;
            check_count("columns of a matrix", column.saturating_add(1), 1, columns)?;
        }
        let matrix = Self::of(rows, columns, entries, |value| value != 0.0);
        let wrong = matrix.entries().find(|entry| !entry.2.is_finite());
        let Some((row, column, value)) = wrong else {
            return Ok(matrix);
        };
        let owner = || format!("entry ({row}, {column})");
        require(false, what, owner, value, "a finite number").map(|()| matrix)
    }

    /// The matrix of entries in any order, those at one place as their sum in the order given, if it is one to keep.
    fn of(
        rows: usize,
        columns: usize,
        mut entries: Vec<(usize, usize, f64)>,
        is_kept: fn(f64) -> bool,
    ) -> Self {
        entries.sort_by_key(|&(row, column, _)| (column, row));
        entries.dedup_by(|next, kept| {
            let is_same = (next.0, next.1) == (kept.0, kept.1);
            if is_same {
                kept.2 += next.2;
            }
            is_same
        });
        entries.retain(|entry| is_kept(entry.2));
        let place = |&(row, column, _): &(usize, usize, f64)| [row as u32, column as u32];
        Self {
            rows,
            columns,
            places: Arc::new(entries.iter().map(place).collect()),
            values: entries.iter().map(|entry| entry.2).collect(),
            half_unit: HalfUnit::of_each(0.0),
        }
    }

    /// The matrix of entries that were rounded so when they were written.
    pub(crate) fn with_half_unit(self, half_unit: HalfUnit) -> Self {
        Self { half_unit, ..self }
    }

    /// Half the unit of the last written place of its entries.
    pub(crate) fn half_unit(&self) -> HalfUnit {
        self.half_unit
    }

    /// The matrix with another value at each place.
    fn map(&self, value: impl Fn(f64) -> f64) -> Self {
        let values = self.values.iter().map(|own| value(*own)).collect();
        Self {
            values,
            ..self.clone()
        }
    }

    /// The half units of all entries at their places.
    pub(super) fn half_units(&self) -> Self {
        self.map(|value| self.half_unit.of(value))
    }

    /// The matrix with zeros at the places of these entries where it has none.
    pub(super) fn with_places_of(self, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let new = entries.filter(|entry| self.place(entry.0, entry.1).is_none());
        let mut new: Vec<_> = new.map(|entry| (entry.0, entry.1, 0.0)).collect();
        if new.is_empty() {
            return self;
        }
        new.extend(self.entries());
        Self::of(self.rows, self.columns, new, |_| true).with_half_unit(self.half_unit)
    }

    /// Place of a row and column among all entries, if there is one.
    pub(super) fn place(&self, row: usize, column: usize) -> Option<usize> {
        let places = self.places.as_slice();
        let found =
            places.binary_search_by_key(&[column as u32, row as u32], |own| [own[1], own[0]]);
        found.ok()
    }

    /// The entry at a row and column.
    fn at(&self, row: usize, column: usize) -> f64 {
        self.place(row, column)
            .map_or(0.0, |place| self.values[place])
    }

    /// Adds values, each times a number, at their places among the entries.
    pub(super) fn add(&mut self, number: f64, values: &[(usize, f64)]) {
        for &(place, value) in values {
            self.values[place] += number * value;
        }
    }

    /// A matrix from the rows and values of every column.
    ///
    /// # Errors
    /// [`Error::Count`] and [`Error::Value`], as in [`Self::new`].
    pub fn of_columns(
        what: &'static str,
        rows: usize,
        columns: &[Vec<(usize, f64)>],
    ) -> Result<Self, Error> {
        let all = columns.iter().enumerate();
        let entries =
            all.flat_map(|(j, column)| column.iter().map(move |&(i, value)| (i, j, value)));
        Self::new(what, rows, columns.len(), entries.collect())
    }

    /// A matrix from a dense one.
    ///
    /// # Errors
    /// [`Error::Count`] and [`Error::Value`], as in [`Self::new`].
    pub fn of_dense(what: &'static str, matrix: &DMatrix<f64>) -> Result<Self, Error> {
        let columns = matrix.column_iter();
        let columns = columns.map(|column| column.iter().copied().enumerate().collect());
        Self::of_columns(what, matrix.nrows(), &columns.collect::<Vec<_>>())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Row, column (from zero) and value of every entry, column by column.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = (usize, usize, f64)> + Clone {
        let both = self.places.iter().zip(&self.values);
        both.map(|(&[row, column], &value)| (row as usize, column as usize, value))
    }

    /// The rows and values of one column.
    pub(super) fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        let up_to = |end| {
            self.places
                .partition_point(|place| (place[1] as usize) < end)
        };
        let own = up_to(column)..up_to(column + 1);
        let both = self.places[own.clone()].iter().zip(&self.values[own]);
        both.map(|(place, &value)| (place[0] as usize, value))
    }

    /// True if the matrix is square and every entry exactly that of the other triangle.
    pub fn is_symmetric(&self) -> bool {
        let is_mirrored = |(row, column, value)| self.at(column, row) == value;
        self.rows == self.columns && self.entries().all(is_mirrored)
    }

    /// The transpose.
    #[doc(hidden)]
    pub fn transposed(&self) -> Self {
        let turned = self
            .entries()
            .map(|(row, column, value)| (column, row, value));
        let turned = Self::of(self.columns, self.rows, turned.collect(), |_| true);
        turned.with_half_unit(self.half_unit)
    }

    /// The product with a dense matrix (columns × m), rows × m.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when they do not fit.
    pub fn times(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape("right factor", right, self.columns, right.ncols())?;
        let mut product = DMatrix::zeros(self.rows, right.ncols());
        for (mut product, right) in product.column_iter_mut().zip(right.column_iter()) {
            self.entries()
                .for_each(|(row, column, value)| product[row] += value * right[column]);
        }
        Ok(product)
    }

    /// Columns that have entries, ascending.
    pub(super) fn occupied(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self.entries().map(|entry| entry.1).collect();
        columns.dedup();
        columns
    }

    /// $V^t A$ for transposed shapes $V^t$ (m × rows) at the columns that have entries.
    pub(super) fn loads(&self, transposed_shapes: &DMatrix<f64>) -> DMatrix<f64> {
        let count = transposed_shapes.nrows();
        let mut loads = DMatrix::zeros(count, self.occupied().len());
        let (mut at, mut last) = (0, self.places.first().map_or(0, |place| place[1] as usize));
        for (row, column, value) in self.entries() {
            at += usize::from(last != column);
            last = column;
            let load = loads.as_mut_slice()[at * count..].iter_mut();
            let both = load.zip(&transposed_shapes.as_slice()[row * count..][..count]);
            both.for_each(|(load, shape)| *load += value * shape);
        }
        loads
    }

    /// $V^t A V$ of a symmetric matrix for the transposed shapes $V^t$ (m × rows), m × m.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when they do not fit.
    pub fn through(&self, transposed_shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        let (count, own) = (transposed_shapes.nrows(), self.occupied());
        check_shape("transposed shapes", transposed_shapes, count, self.rows)?;
        check_shape("transposed shapes", transposed_shapes, count, self.columns)?;
        let own = transposed_shapes.select_columns(&own).transpose();
        Ok(symmetric_part(&(self.loads(transposed_shapes) * own)))
    }

    /// Refuses a matrix that is not square and symmetric to within round-off, row by row.
    ///
    /// Every part of a sum of semidefinite matrices has $|a_{ij}| \le \sqrt{a_{ii} a_{jj}}$, and so has their sum by the
    /// inequality of Cauchy and Schwarz: $\sqrt{a_{ii} a_{jj}}$ is the scale of an entry's round-off, in any units of the
    /// degrees of freedom. A larger entry, which a semidefinite matrix does not have, is a scale of its own.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless it is square; [`Error::Value`] with the difference of an entry from its mirror.
    pub fn check_symmetric(&self, what: &'static str) -> Result<(), Error> {
        check_length(what, self.columns, self.rows)?;
        let diagonal = self.diagonal().map(|own| own.abs().sqrt());
        let apart = |(row, column, value): (usize, usize, f64)| {
            let mirror = self.at(column, row);
            let difference = (value - mirror).abs();
            let scale = difference.max(value.abs().min(mirror.abs()));
            let scale = scale.max(diagonal[row] * diagonal[column]);
            let part = if difference > 0.0 {
                difference / scale
            } else {
                0.0
            };
            (row.max(column), row.min(column), part)
        };
        let wrong = self.entries().map(apart).filter(|entry| entry.2 > GIVEN);
        let Some((row, column, part)) = wrong.min_by_key(|entry| (entry.1, entry.0)) else {
            return Ok(());
        };
        let owner = || format!("{what}, entry ({row}, {column}) beside its mirror");
        let expected = "at most 1e-11: the matrix must be symmetric, and a file of one triangle alone must call it symmetric, not general";
        require(false, "relative difference", owner, part, expected)
    }

    /// The diagonal of a square matrix.
    pub(super) fn diagonal(&self) -> DVector<f64> {
        let mut diagonal = DVector::zeros(self.rows);
        let own = self.entries().filter(|entry| entry.0 == entry.1);
        own.for_each(|(row, _, value)| diagonal[row] = value);
        diagonal
    }

    /// Sizes $s_i$ by which rows and columns are divided to give a semidefinite matrix a unit diagonal, of one that has this diagonal; one
    /// where it is zero.
    pub(super) fn unit_scale(diagonal: &DVector<f64>) -> DVector<f64> {
        diagonal.map(|entry| {
            if entry == 0.0 {
                1.0
            } else {
                entry.abs().sqrt()
            }
        })
    }

    /// The matrix at some of its rows, ascending, and the same columns.
    ///
    /// # Errors
    /// [`Error::Count`] without rows.
    pub(crate) fn at_rows(&self, rows: &[usize]) -> Result<Self, Error> {
        let turned = self.at_columns(rows)?.transposed();
        Ok(turned.at_columns(rows)?.transposed())
    }

    /// The largest entry in size, and the squares of all entries over it.
    pub(super) fn squares(&self) -> (f64, Self) {
        let sizes = self.values.iter().map(|value| value.abs());
        let largest = sizes.fold(f64::MIN_POSITIVE, f64::max);
        (largest, self.map(|value| (value / largest).powi(2)))
    }

    /// The matrix at some of its columns, ascending.
    ///
    /// # Errors
    /// [`Error::Count`] without columns.
    pub(crate) fn at_columns(&self, columns: &[usize]) -> Result<Self, Error> {
        let place = |(row, column, value): (usize, usize, f64)| {
            Some((row, columns.binary_search(&column).ok()?, value))
        };
        let entries = self.entries().filter_map(place).collect();
        let part = Self::new("part of a matrix", self.rows, columns.len(), entries)?;
        Ok(part.with_half_unit(self.half_unit))
    }

    /// The matrix as a dense one.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows, self.columns);
        self.entries()
            .for_each(|(row, column, value)| dense[(row, column)] = value);
        dense
    }
}
