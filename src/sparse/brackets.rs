//! What the rounding of a matrix's numbers may do to its energy, proven by the signs of pivots.

use super::factorization::FactorizationPlan;
use super::matrix::GIVEN;
use super::{Factor, SparseMatrix};
use crate::method::error::Error;
use nalgebra::DVector;
use std::sync::Arc;

/// Numbers by which a slack is taken: another only where a pivot vanishes at those before.
const NUMBERS: [f64; 3] = [1.0, 1.25, 1.5];

/// The diagonal $D$ that bounds the energy $y^t E y$ of any rounding $\lvert E_{ij} \rvert \le h_{ij}$ of a symmetric matrix with the half
/// units $h$ of its last written places,
///
/// $$ \lvert y^t E y \rvert \le y^t D y, \qquad D_i = \sum_j h_{ij} \frac{s_i}{s_j}, $$
///
/// for any sizes $s$, since $2 \lvert y_i y_j \rvert \le y_i^2 s_i / s_j + y_j^2 s_j / s_i$. With $s_i = \sqrt{K_{ii}}$ of a whole
/// matrix no unit of displacement is in it.
pub(crate) fn slack(matrix: &SparseMatrix, sizes: &DVector<f64>) -> DVector<f64> {
    let mut slack = DVector::zeros(matrix.rows());
    for (row, column, value) in matrix.entries() {
        slack[row] += matrix.half_unit().of(value) * (sizes[row] / sizes[column]);
    }
    slack
}

/// The factor of a sum of symmetric matrices, each times its number, and of a number times a slack: by the law of inertia no fewer
/// negative pivots than a matrix within the slack has negative eigenvalues where the number is negative, and no more where it is
/// positive.
///
/// # Errors
/// Errors of the factorization, where it fails at one and a half times the slack too.
pub(crate) fn bracket(
    plan: &Arc<FactorizationPlan>,
    what: &'static str,
    terms: &[(f64, &SparseMatrix)],
    (number, slack): (f64, &DVector<f64>),
) -> Result<Factor, Error> {
    let rows = slack.len();
    let diagonal = (0..rows).map(|row| (row, row, slack[row])).collect();
    let diagonal = SparseMatrix::new(what, rows, rows, diagonal)?;
    let of = |larger: f64| {
        Factor::of_sum(
            plan,
            what,
            &[terms, &[(larger * number, &diagonal)]].concat(),
        )
    };
    let mut factors = NUMBERS.into_iter().map(of);
    let first = factors.next().unwrap_or_else(|| of(1.0));
    factors.fold(first, Result::or)
}

/// A matrix, and whether parts of it exceed it whatever the rounding of all.
pub(crate) struct Excess<'a> {
    what: &'static str,
    whole: &'a SparseMatrix,
    sizes: DVector<f64>,
    plan: Arc<FactorizationPlan>,
}

impl<'a> Excess<'a> {
    /// The check of parts that have entries where the whole has some, zeros among them.
    ///
    /// # Errors
    /// Errors of the plan of a factorization.
    pub(crate) fn beside(what: &'static str, whole: &'a SparseMatrix) -> Result<Self, Error> {
        Ok(Self {
            what,
            whole,
            sizes: SparseMatrix::unit_scale(&whole.diagonal()),
            plan: Arc::new(FactorizationPlan::of_sum(&[whole])?),
        })
    }

    /// A motion of negative energy of a sum of the whole and parts, each times its number, if there is one whatever their rounding.
    ///
    /// # Errors
    /// Errors of [`bracket`].
    pub(crate) fn of(
        &self,
        number: f64,
        parts: &[(f64, &SparseMatrix)],
    ) -> Result<Option<DVector<f64>>, Error> {
        let terms = [&[(number, self.whole)], parts].concat();
        let all = terms.iter().filter(|(number, _)| *number != 0.0);
        // An entry may be left of a sum whose terms were as large as the diagonal, and carry their rounding as a mirrored one does.
        let cancelled = |matrix: &SparseMatrix| {
            let mut all = slack(matrix, &self.sizes);
            let entries = matrix.entries().filter(|entry| entry.2 != 0.0);
            entries.for_each(|(row, ..)| all[row] += GIVEN * self.sizes[row].powi(2));
            all
        };
        let sum = all.map(|(_, matrix)| cancelled(matrix));
        let sum = sum.fold(DVector::zeros(self.whole.rows()), |sum, own| sum + own);
        // A row where nothing is rounded has no entries.
        let sum = sum.map(|own| if own == 0.0 { 1.0 } else { own });
        Ok(bracket(&self.plan, self.what, &terms, (1.0, &sum))?.negative_motion())
    }
}
