//! A real matrix by its nonzero entries.

use crate::method::error::Error;
use nalgebra::DMatrix;

/// A real matrix by its nonzero entries, column by column and in each from the first row down; no place is given twice.
///
/// A symmetric one has both triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseMatrix {
    rows: usize,
    columns: usize,
    entries: Vec<(usize, usize, f64)>,
}

impl SparseMatrix {
    /// A matrix of the given size from its entries (row, column, value) in any order; what stands at one place twice adds up,
    /// and zeros are left out.
    ///
    /// # Errors
    /// [`Error::Empty`] without rows or columns; [`Error::TooMany`] for a place outside; [`Error::NotFinite`].
    pub fn new(
        what: &'static str,
        rows: usize,
        columns: usize,
        mut entries: Vec<(usize, usize, f64)>,
    ) -> Result<Self, Error> {
        if rows == 0 || columns == 0 {
            return Err(Error::Empty { what });
        }
        for &(row, column, value) in &entries {
            if row >= rows {
                return Err(Error::TooMany { what: "rows of a matrix", available: rows, requested: row + 1 });
            }
            if column >= columns {
                return Err(Error::TooMany { what: "columns of a matrix", available: columns, requested: column + 1 });
            }
            if !value.is_finite() {
                return Err(Error::NotFinite { what, row, column, value });
            }
        }
        entries.sort_by_key(|&(row, column, _)| (column, row));
        entries.dedup_by(|next, kept| {
            let is_same = (next.0, next.1) == (kept.0, kept.1);
            if is_same {
                kept.2 += next.2;
            }
            is_same
        });
        entries.retain(|entry| entry.2 != 0.0);
        Ok(Self { rows, columns, entries })
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
    pub fn entries(&self) -> &[(usize, usize, f64)] {
        &self.entries
    }

    /// Whether it is square and every entry exactly that of the other triangle.
    pub fn is_symmetric(&self) -> bool {
        let mut mirrored: Vec<_> = self.entries.iter().map(|&(row, column, value)| (column, row, value)).collect();
        mirrored.sort_by_key(|&(row, column, _)| (column, row));
        self.rows == self.columns && mirrored == self.entries
    }

    /// The product with a dense matrix (columns × m), rows × m.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when they do not fit.
    pub fn times(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        crate::method::linear_algebra::check_shape("right factor", right, self.columns, right.ncols())?;
        let mut product = DMatrix::zeros(self.rows, right.ncols());
        for (mut product, right) in product.column_iter_mut().zip(right.column_iter()) {
            for &(row, column, value) in &self.entries {
                product[row] += value * right[column];
            }
        }
        Ok(product)
    }
}
