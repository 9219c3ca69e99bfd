//! The motions that a stiffness does not resist, counted whatever the stiffest of its parts.

use super::factorization::FactorizationPlan;
use super::factorization::round_off;
use super::lowest_modes::BLOCK;
use super::matrix::GIVEN;
use super::random::random_block;
use super::{Factor, SparseMatrix};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use nalgebra::DMatrix;
use std::sync::Arc;

/// Standard deviations of an energy's round-off within which it counts as zero, times a double's relative rounding: an entry is the sum
/// of some thirty parts, each rounded, then scaled and multiplied.
const ROUNDED: f64 = 32.0 * f64::EPSILON;
/// The same of numbers written with twelve digits: half a unit of the twelfth, as evenly distributed (over the root of three).
const WRITTEN: f64 = 0.5e-11 / 1.732_050_807_568_877_2;
/// Digits of such numbers.
const DIGITS: usize = 12;
/// Steps of inverse iteration: a shift of round-off damps the motions that strain by ten and more in each.
const STEPS: usize = 6;

/// The null space of a semidefinite stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBodies {
    /// Motions that span it (rows × r): each has one at a row of its own in `rows` and zero at those of the others.
    pub motions: DMatrix<f64>,
    /// These rows.
    pub rows: Vec<usize>,
    /// Motions that the matrix resists by less than twelve digits tell from nothing, and which count as vibrations: the row that moves
    /// most, and the resistance relative to the entries that it is left of.
    pub doubtful: Vec<(usize, f64)>,
}

impl RigidBodies {
    /// The null space of a symmetric matrix $K$ as far as its numbers tell.
    ///
    /// In units of displacement that give $K$ a unit diagonal, so that no ratio of stiffness on the diagonal counts, the weakest motions
    /// $y$ are found by inverse iteration. Entries rounded independently by a part $u$ leave an energy with a standard deviation of
    ///
    /// $$ u \sqrt{\sum_{ij} K_{ij}^2 y_i^2 y_j^2}, $$
    ///
    /// and a motion whose energy $y^t K y$ is within it counts as free. A matrix whose numbers all have twelve digits or fewer may be
    /// rounded to as many, and one with a negative energy shows its own rounding.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] for a matrix that is not semidefinite; those of the factorization.
    pub fn of(what: &'static str, matrix: &SparseMatrix) -> Result<Self, Error> {
        let (count, entries) = (matrix.rows(), matrix.entries());
        let size = SparseMatrix::unit_scale(&matrix.diagonal());
        let unit = entries
            .iter()
            .map(|&(row, column, value)| (row, column, value / size[row] / size[column]));
        let unit = SparseMatrix::new(what, count, count, unit.collect())?;
        let ones = (0..count).map(|row| (row, row, 1.0)).collect();
        let ones = SparseMatrix::new(what, count, count, ones)?;
        let plan = Arc::new(FactorizationPlan::of_sum(&[&unit])?);
        let shifted =
            |shift| Factor::of_sum(&plan, what, &[(1.0, &unit), (shift, &ones)])?.check_signs(what);
        let factor = shifted(round_off(count)).or_else(|_| shifted(GIVEN))?;
        let written = if entries.iter().all(|entry| digits(entry.2) <= DIGITS) {
            WRITTEN
        } else {
            ROUNDED
        };
        let (mut block, mut state) = (BLOCK.min(count), 0);
        loop {
            let mut weakest = random_block(count, block, &mut state);
            for _ in 0..STEPS {
                weakest = factor.solve(&weakest)?.qr().q();
            }
            let energies = symmetric_part(&weakest.tr_mul(&unit.times(&weakest)?));
            weakest *= symmetric_eigen(what, &energies)?.1;
            let forces = unit.times(&weakest)?;
            let resisted: Vec<f64> = (0..block)
                .map(|at| {
                    let motion = weakest.column(at);
                    let part = |&(row, column, value): &(usize, usize, f64)| {
                        (value * motion[row] * motion[column]).powi(2)
                    };
                    let parts: f64 = unit.entries().iter().map(part).sum();
                    motion.dot(&forces.column(at)) / parts.sqrt().max(f64::MIN_POSITIVE)
                })
                .collect();
            let negative = resisted.iter().fold(0.0_f64, |most, part| most.max(-part));
            let limit = written.max(4.0 * negative);
            let (free, held): (Vec<usize>, Vec<usize>) =
                (0..block).partition(|&at| resisted[at] <= limit);
            if held.is_empty() && block < count {
                block = (2 * block).min(count);
                continue;
            }
            let doubtful = held.into_iter().filter(|&at| resisted[at] <= GIVEN);
            let doubtful = doubtful
                .map(|at| {
                    (
                        weakest.column(at).component_div(&size).iamax(),
                        resisted[at],
                    )
                })
                .collect();
            let free = weakest.select_columns(&free);
            // The row that moves most, then the one that moves most in what the first leaves free.
            let (mut rest, mut rows) = (free.transpose(), Vec::new());
            for _ in 0..free.ncols() {
                let moved = |row: usize| rest.column(row).norm_squared();
                let Some(row) = (0..count)
                    .rev()
                    .max_by(|&a, &b| moved(a).total_cmp(&moved(b)))
                else {
                    break;
                };
                let direction = rest.column(row).normalize();
                let taken = &direction * (direction.transpose() * &rest);
                rest -= taken;
                rows.push(row);
            }
            // A motion that nothing resists is that of one spring at its row, displaced by one, whatever springs stand at the other rows:
            // to the digits of a solution, where a decomposition mixes in what strains little beside the stiffest.
            let ground = rows.iter().map(|&row| (row, row, 1.0)).collect();
            let ground = SparseMatrix::new(what, count, count, ground)?;
            let held = Factor::of_sum(&plan, what, &[(1.0, &unit), (1.0, &ground)])?;
            let mut displacements = DMatrix::zeros(count, rows.len());
            rows.iter()
                .enumerate()
                .for_each(|(at, &row)| displacements[(row, at)] = 1.0);
            let mut motions = held.solve(&displacements)?;
            for mut motion in motions.column_iter_mut() {
                motion.component_div_assign(&size);
            }
            let own = motions.select_rows(&rows).try_inverse();
            let own = own.ok_or(Error::NoConvergence("rigid-body modes"))?;
            return Ok(Self {
                motions: motions * own,
                rows,
                doubtful,
            });
        }
    }
}

/// Significant decimal digits of a number as short as it can be written.
fn digits(number: f64) -> usize {
    let text = format!("{:e}", number.abs());
    text.find('e')
        .map_or(0, |end| text[..end].len() - usize::from(text.contains('.')))
}
