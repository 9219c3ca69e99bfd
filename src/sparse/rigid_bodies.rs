//! The motions that a stiffness does not resist, counted whatever the stiffest of its parts.

use super::factorization::FactorizationPlan;
use super::matrix::GIVEN;
use super::random::random_block;
use super::{Factor, SparseMatrix};
use crate::method::error::Error;
use crate::method::linear_algebra::{round_off, symmetric_eigen, symmetric_part};
use nalgebra::DMatrix;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Strain energy, relative to the root of the sum of its terms' squares, that counts as zero: an entry is the sum of some thirty
/// parts, each rounded, then scaled and multiplied.
const ROUNDED: f64 = 32.0 * f64::EPSILON;
/// Stricter limit of that energy, above which a motion is reported as doubtful. Thirty independent roundings add up to about their
/// root, which is less; more hints at some resistance.
const DOUBTFUL: f64 = 8.0 * f64::EPSILON;
/// Digits of numbers that a program has rounded; shorter ones are somebody's own and taken as exact.
const DIGITS: RangeInclusive<usize> = 6..=12;
/// Steps of inverse iteration. In each a motion whose resistance is $k$ shifts loses a factor of $1 + k$ beside those that nothing
/// resists, and its energy counts by the square: of ten shifts six leave less than $10 \cdot 11^{-12}$ shifts.
const STEPS: usize = 6;
/// Motions sought at first: more than one body has.
const BLOCK: usize = 8;

/// The null space of a semidefinite stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBodies {
    /// Motions that span the null space (rows × r): each is one at a row of its own in `rows` and zero at the others.
    pub motions: DMatrix<f64>,
    /// Rows at which one of the motions is one and the others are zero.
    pub rows: Vec<usize>,
    /// Motions whose resistance can hardly be told from none: the row that moves most, and the resistance relative to the size of
    /// its terms. They count as vibrations, except where the rounding of doubles may be all of the resistance.
    pub doubtful: Vec<(usize, f64)>,
}

/// True if a resistance, relative to the size of its terms, is within the rounding of doubles.
pub(crate) fn is_rounded(resistance: f64) -> bool {
    resistance <= ROUNDED
}

impl RigidBodies {
    /// The null space of a symmetric matrix $K$ as far as its numbers tell.
    ///
    /// In units of displacement that give $K$ a unit diagonal, so that no ratio of stiffness on the diagonal counts, the weakest motions
    /// $y$ are found by inverse iteration. Entries rounded independently by a part $u$ leave an energy with a standard deviation of
    ///
    /// $$ u \sqrt{\sum_{ij} K_{ij}^2 y_i^2 y_j^2}, $$
    ///
    /// and a motion whose energy $y^t K y$ is within it counts as free. Numbers that were written with $n$ digits, six to twelve, as at
    /// least half of them then show, have $u \le 10^{1 - n} / \sqrt{12}$: at twelve digits so much is round-off, at fewer up to three times
    /// as much is doubtful. A negative energy is itself a draw of the round-off, which is taken to be within four of the largest such draw.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] for a matrix that is not semidefinite; the errors of the factorization.
    pub fn of(what: &'static str, matrix: &SparseMatrix) -> Result<Self, Error> {
        Self::by(
            &Arc::new(FactorizationPlan::of_sum(&[matrix])?),
            what,
            matrix,
        )
    }

    /// The null space by a plan for this matrix among others.
    pub(super) fn by(
        plan: &Arc<FactorizationPlan>,
        what: &'static str,
        matrix: &SparseMatrix,
    ) -> Result<Self, Error> {
        let (count, entries) = (matrix.rows(), matrix.entries());
        let size = SparseMatrix::unit_scale(&matrix.diagonal());
        let unit = entries
            .clone()
            .map(|(row, column, value)| (row, column, value / size[row] / size[column]));
        let unit = SparseMatrix::new(what, count, count, unit.collect())?;
        let ones = (0..count).map(|row| (row, row, 1.0)).collect();
        let ones = SparseMatrix::new(what, count, count, ones)?;
        let shifted =
            |shift| Factor::of_sum(plan, what, &[(1.0, &unit), (shift, &ones)])?.check_signs(what);
        let factor = shifted(round_off(count)).or_else(|_| shifted(GIVEN))?;
        let Limits { least, told, most } = Limits::of(entries);
        let (mut block, mut state) = (BLOCK.min(count), 0);
        loop {
            let mut weakest = random_block(count, block, &mut state);
            for _ in 0..STEPS {
                weakest = factor.solve(&weakest)?.qr().q();
            }
            let energies = symmetric_part(&weakest.tr_mul(&unit.times(&weakest)?));
            weakest *= symmetric_eigen(what, &energies)?.1;
            let resisted = resistances(&unit, &weakest)?;
            let negative = resisted.iter().fold(0.0_f64, |most, part| most.max(-part));
            let draws = 4.0 * negative;
            let (limit, told) = (least.max(draws), told.max(draws));
            let free: Vec<usize> = (0..block).filter(|&at| resisted[at] <= limit).collect();
            if free.len() == block && block < count {
                block = (2 * block).min(count);
                continue;
            }
            let doubtful = (0..block).filter(|&at| resisted[at] > told && resisted[at] <= most);
            let doubtful = doubtful
                .map(|at| {
                    (
                        weakest.column(at).component_div(&size).iamax(),
                        resisted[at],
                    )
                })
                .collect();
            let free = weakest.select_columns(&free);
            let rows = moving_rows(&free);
            // Held by springs at these rows, one of which is displaced by one, the structure moves by a motion that nothing
            // resists. A solution gives all its digits; a decomposition mixes in motions that strain little beside the stiffest.
            let ground = rows.iter().map(|&row| (row, row, 1.0)).collect();
            let ground = SparseMatrix::new(what, count, count, ground)?;
            let held = Factor::of_sum(plan, what, &[(1.0, &unit), (1.0, &ground)])?;
            let mut displacements = DMatrix::zeros(count, rows.len());
            rows.iter()
                .enumerate()
                .for_each(|(at, &row)| displacements[(row, at)] = 1.0);
            let mut motions = held.solve(&displacements)?;
            for mut motion in motions.column_iter_mut() {
                motion.component_div_assign(&size);
            }
            let own = motions.select_rows(&rows).try_inverse();
            let own = own.ok_or(Error::no_convergence("rigid-body modes"))?;
            return Ok(Self {
                motions: motions * own,
                rows,
                doubtful,
            });
        }
    }
}

/// Resistances relative to the size of their terms.
struct Limits {
    /// Resistance up to which a motion counts as free.
    least: f64,
    /// Resistance above which a motion is not certainly free.
    told: f64,
    /// Resistance above which a motion is certainly held.
    most: f64,
}

impl Limits {
    /// Limits for entries of a matrix, by the digits with which they are written.
    fn of(entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let numbers: Vec<usize> = entries.map(|entry| digits(entry.2)).collect();
        let longest = numbers.iter().copied().max().unwrap_or(0);
        let as_long = numbers.iter().filter(|&&digits| digits + 1 >= longest);
        let is_written = DIGITS.contains(&longest) && 2 * as_long.count() >= numbers.len();
        let part_of = |digits: usize| 10_f64.powf(1.0 - digits as f64) / 12_f64.sqrt();
        if is_written {
            Self {
                least: part_of(*DIGITS.end()),
                told: part_of(*DIGITS.end()),
                most: (3.0 * part_of(longest)).max(GIVEN),
            }
        } else {
            Self {
                least: ROUNDED,
                told: DOUBTFUL,
                most: GIVEN,
            }
        }
    }
}

/// Energies $y^t K y$ of motions relative to the root of the sum of their terms' squares.
fn resistances(stiffness: &SparseMatrix, motions: &DMatrix<f64>) -> Result<Vec<f64>, Error> {
    let forces = stiffness.times(motions)?;
    let resistance = |at: usize| {
        let motion = motions.column(at);
        let part = |(row, column, value): (usize, usize, f64)| {
            (value * motion[row] * motion[column]).powi(2)
        };
        let parts: f64 = stiffness.entries().map(part).sum();
        // At a row without stiffness there is only the round-off of other rows.
        motion.dot(&forces.column(at)) / parts.sqrt().max(f64::EPSILON)
    };
    Ok((0..motions.ncols()).map(resistance).collect())
}

/// The row that moves most in motions, then the one that moves most in what the first leaves free, as many as there are motions.
fn moving_rows(motions: &DMatrix<f64>) -> Vec<usize> {
    let (mut rest, mut rows) = (motions.transpose(), Vec::new());
    for _ in 0..motions.ncols() {
        let moved = |row: usize| rest.column(row).norm_squared();
        let Some(row) = (0..motions.nrows())
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
    rows
}

/// Significant decimal digits of a number as short as it can be written.
fn digits(number: f64) -> usize {
    let text = format!("{:e}", number.abs());
    text.find('e')
        .map_or(0, |end| text[..end].len() - usize::from(text.contains('.')))
}
