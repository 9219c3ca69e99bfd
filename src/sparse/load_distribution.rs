//! The load distribution $T$, by its coefficients that are not zero.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::check_finite;
use nalgebra::DMatrix;

/// The load distribution $T$ (A.3, free SDOF × d): $Q_S = T Q_D$ distributes dynamic loads to structural ones, and by equal work
/// $q_D = T^t q_S$.
///
/// A dynamic DOF has a handful of structural ones, so that a million of these need no more room than their number times d.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadDistribution {
    rows: usize,
    columns: Vec<Vec<(usize, f64)>>,
}

impl LoadDistribution {
    /// From the row and coefficient of every structural DOF that takes part, by dynamic DOF; `rows` is the number of free SDOF.
    ///
    /// # Errors
    /// [`Error::Empty`] without dynamic DOF; [`Error::Unknown`] for a row that does not exist; [`Error::NotFinite`].
    pub fn new(rows: usize, columns: Vec<Vec<(usize, f64)>>) -> Result<Self, Error> {
        at_least_one("dynamic degrees of freedom", columns.len())?;
        for (column, &(row, value)) in columns
            .iter()
            .enumerate()
            .flat_map(|(j, terms)| terms.iter().map(move |term| (j, term)))
        {
            if row >= rows {
                let owner = format!("dynamic degree of freedom {column} (from zero)");
                return Err(Error::Unknown {
                    owner,
                    what: "row of the load distribution",
                    label: row,
                });
            }
            if !value.is_finite() {
                return Err(Error::NotFinite {
                    what: "load distribution",
                    row,
                    column,
                    value,
                });
            }
        }
        Ok(Self { rows, columns })
    }

    /// From a matrix (free SDOF × d).
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of(matrix: &DMatrix<f64>) -> Result<Self, Error> {
        check_finite("load distribution", matrix)?;
        let terms = |column: usize| {
            let all = (0..matrix.nrows()).map(|row| (row, matrix[(row, column)]));
            all.filter(|term| term.1 != 0.0).collect()
        };
        Self::new(matrix.nrows(), (0..matrix.ncols()).map(terms).collect())
    }

    /// The number of free SDOF.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Row and coefficient of every structural DOF that takes part, by dynamic DOF.
    pub fn columns(&self) -> &[Vec<(usize, f64)>] {
        &self.columns
    }

    /// The same as a matrix (free SDOF × d).
    pub fn dense(&self) -> DMatrix<f64> {
        self.times(&DMatrix::identity(self.columns.len(), self.columns.len()))
    }

    /// Structural loads $T Q_D$ (free SDOF × m) of dynamic ones (d × m).
    pub(crate) fn times(&self, loads: &DMatrix<f64>) -> DMatrix<f64> {
        let mut structural = DMatrix::zeros(self.rows, loads.ncols());
        for (terms, loads) in self.columns.iter().zip(loads.row_iter()) {
            terms.iter().for_each(|&(row, coefficient)| {
                structural
                    .row_mut(row)
                    .zip_apply(&loads, |sum, load| *sum += coefficient * load)
            });
        }
        structural
    }
}
