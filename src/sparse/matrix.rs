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
#[derive(Debug, Clone, Copy, PartialEq)]
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
        let mut entries = summed(entries);
        entries.retain(|entry| entry.2 != 0.0);
        Self::of_sorted(rows, columns, &entries, HalfUnit::of_each(0.0)).finite(what)
    }

    /// This matrix, unless an entry is beyond the range of numbers.
    fn finite(self, what: &'static str) -> Result<Self, Error> {
        let wrong = self.entries().find(|entry| !entry.2.is_finite());
        if let Some((row, column, value)) = wrong {
            let owner = || format!("entry ({row}, {column})");
            require(false, what, owner, value, "a finite number")?;
        }
        Ok(self)
    }

    /// The sum (`size` × `size`) of small matrices with their rows, each times its number; entries of these no larger than `least` count as
    /// nothing, and zeros are left out.
    ///
    /// Column by column, so that no more than one of them waits to be sorted.
    pub(super) fn of_parts(
        what: &'static str,
        size: usize,
        parts: &[(f64, &[usize], &DMatrix<f64>)],
        least: f64,
    ) -> Result<Self, Error> {
        let mut starts = vec![0; size + 1];
        let all = || parts.iter().flat_map(|(_, rows, _)| rows.iter());
        all().for_each(|row| starts[row + 1] += 1);
        (0..size).for_each(|row| starts[row + 1] += starts[row]);
        let (mut next, mut owners) = (starts.clone(), vec![(0, 0); starts[size]]);
        for (part, (_, rows, _)) in parts.iter().enumerate() {
            for (column, &row) in rows.iter().enumerate() {
                owners[next[row]] = (part, column);
                next[row] += 1;
            }
        }
        let (mut places, mut values) = (Vec::new(), Vec::new());
        let (mut sums, mut is_met, mut met) = (vec![0.0; size], vec![false; size], Vec::new());
        for column in 0..size {
            for &(part, own) in &owners[starts[column]..starts[column + 1]] {
                let (scale, rows, matrix) = parts[part];
                let entries = rows.iter().enumerate();
                let entries = entries.map(|(at, &row)| (row, scale * matrix[(at, own)]));
                for (row, value) in entries.filter(|entry| entry.1.abs() > least) {
                    if !is_met[row] {
                        is_met[row] = true;
                        met.push(row);
                    }
                    sums[row] += value;
                }
            }
            met.sort_unstable();
            for row in met.drain(..) {
                if sums[row] != 0.0 {
                    places.push([row as u32, column as u32]);
                    values.push(sums[row]);
                }
                (sums[row], is_met[row]) = (0.0, false);
            }
        }
        let matrix = Self {
            rows: size,
            columns: size,
            places: Arc::new(places),
            values,
            half_unit: HalfUnit::of_each(0.0),
        };
        matrix.finite(what)
    }

    fn of_sorted(
        rows: usize,
        columns: usize,
        entries: &[(usize, usize, f64)],
        half_unit: HalfUnit,
    ) -> Self {
        let place = |&(row, column, _): &(usize, usize, f64)| [row as u32, column as u32];
        Self {
            rows,
            columns,
            places: Arc::new(entries.iter().map(place).collect()),
            values: entries.iter().map(|entry| entry.2).collect(),
            half_unit,
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

    /// The half units of all entries at their places.
    pub(super) fn half_units(&self) -> Self {
        let own = self.values.iter().map(|value| self.half_unit.of(*value));
        Self {
            values: own.collect(),
            ..self.clone()
        }
    }

    /// The matrix with zeros at the places of these entries where it has none.
    pub(super) fn with_places_of(self, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let starts = self.starts();
        let new = entries.filter(|&entry| self.place(&starts, entry).is_none());
        let mut new: Vec<_> = new.map(|entry| (entry.0, entry.1, 0.0)).collect();
        if new.is_empty() {
            return self;
        }
        new.extend(self.entries());
        Self::of_sorted(self.rows, self.columns, &summed(new), self.half_unit)
    }

    /// Places of the first entry of every column, and of the end.
    pub(super) fn starts(&self) -> Vec<usize> {
        let mut starts = vec![0; self.columns + 1];
        self.places
            .iter()
            .for_each(|place| starts[place[1] as usize + 1] += 1);
        for column in 0..self.columns {
            starts[column + 1] += starts[column];
        }
        starts
    }

    /// Place of an entry's row and column among all, if there is one.
    pub(super) fn place(&self, starts: &[usize], entry: (usize, usize, f64)) -> Option<u32> {
        let own = starts[entry.1]..starts[entry.1 + 1];
        let found = self.places[own.clone()].binary_search_by_key(&entry.0, |own| own[0] as usize);
        found
            .ok()
            .and_then(|place| u32::try_from(own.start + place).ok())
    }

    /// Adds values, each times a number, at places among the entries.
    pub(super) fn add(&mut self, number: f64, places: &[u32], values: &Self) {
        for (&place, value) in places.iter().zip(&values.values) {
            self.values[place as usize] += number * value;
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
        let (rows, all) = (matrix.nrows(), matrix.iter().enumerate());
        let entries = all.map(|(at, &value)| (at % rows, at / rows, value));
        Self::new(what, rows, matrix.ncols(), entries.collect())
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
        let up_to = |end: usize| {
            self.places
                .partition_point(|place| (place[1] as usize) < end)
        };
        let own = up_to(column)..up_to(column + 1);
        let both = self.places[own.clone()].iter().zip(&self.values[own]);
        both.map(|(place, &value)| (place[0] as usize, value))
    }

    /// True if the matrix is square and every entry exactly that of the other triangle.
    pub fn is_symmetric(&self) -> bool {
        if self.rows != self.columns {
            return false;
        }
        // The mirrors of the entries, column by column, are those of every row from the left.
        let mut next = self.starts();
        self.entries().all(|(row, column, value)| {
            let mirror = next[row];
            next[row] += 1;
            self.places.get(mirror) == Some(&[column as u32, row as u32])
                && self.values[mirror] == value
        })
    }

    /// The transpose.
    #[doc(hidden)]
    pub fn transposed(&self) -> Self {
        let turned = self
            .entries()
            .map(|(row, column, value)| (column, row, value));
        let entries = summed(turned.collect());
        Self::of_sorted(self.columns, self.rows, &entries, self.half_unit)
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
        let modes = transposed_shapes.nrows();
        let mut loads = DMatrix::zeros(modes, self.occupied().len());
        let (mut at, mut last) = (0, self.places.first().map(|place| place[1]));
        let entries = self.places.iter().zip(&self.values);
        let entries = entries.map(|(&[row, column], &value)| {
            at += usize::from(last != Some(column));
            last = Some(column);
            (row as usize, at, value)
        });
        add_columns(entries, transposed_shapes, &mut loads);
        loads
    }

    /// $V^t A V$ of a symmetric matrix for the transposed shapes $V^t$ (m × rows), m × m.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when they do not fit.
    pub fn through(&self, transposed_shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        let modes = transposed_shapes.nrows();
        check_shape("transposed shapes", transposed_shapes, modes, self.rows)?;
        check_shape("transposed shapes", transposed_shapes, modes, self.columns)?;
        let own = transposed_shapes.select_columns(&self.occupied());
        Ok(symmetric_part(
            &(self.loads(transposed_shapes) * own.transpose()),
        ))
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
        if self.is_symmetric() {
            return Ok(());
        }
        let (starts, diagonal) = (self.starts(), self.diagonal().map(|own| own.abs().sqrt()));
        let apart = |entry: (usize, usize, f64)| {
            let (row, column, value) = entry;
            let mirror = self.place(&starts, (column, row, value));
            let mirror = mirror.map_or(0.0, |place| self.values[place as usize]);
            let difference = (value - mirror).abs();
            let scale = difference.max(value.abs().min(mirror.abs()));
            let part = difference / scale.max(diagonal[row] * diagonal[column]);
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
        Ok(self
            .at_columns(rows)?
            .transposed()
            .at_columns(rows)?
            .transposed())
    }

    /// The largest entry in size, and the squares of all entries over it.
    pub(super) fn squares(&self) -> (f64, Self) {
        let sizes = self.values.iter().map(|value| value.abs());
        let largest = sizes.fold(f64::MIN_POSITIVE, f64::max);
        let mut squares = self.clone();
        for value in &mut squares.values {
            *value = (*value / largest).powi(2);
        }
        (largest, squares)
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

/// Adds some columns, each times a number, to others: from one, into one, the number.
fn add_columns(
    all: impl Iterator<Item = (usize, usize, f64)>,
    from: &DMatrix<f64>,
    into: &mut DMatrix<f64>,
) {
    let count = from.nrows();
    let (from, into) = (from.as_slice(), into.as_mut_slice());
    for (a, b, number) in all {
        let into = into[b * count..][..count].iter_mut();
        let both = into.zip(&from[a * count..][..count]);
        both.for_each(|(into, from)| *into += number * from);
    }
}

/// Entries column by column and in each from the first row down, those at one place as their sum in the order given.
fn summed(mut entries: Vec<(usize, usize, f64)>) -> Vec<(usize, usize, f64)> {
    entries.sort_by_key(|&(row, column, _)| (column, row));
    entries.dedup_by(|next, kept| {
        let is_same = (next.0, next.1) == (kept.0, kept.1);
        if is_same {
            kept.2 += next.2;
        }
        is_same
    });
    entries
}
