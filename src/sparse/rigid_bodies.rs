//! The motions that a stiffness does not resist as far as its numbers tell, and which of them are those of a rigid body.

use super::brackets::{self, bracket};
use super::factorization::FactorizationPlan;
use super::matrix::{ASSEMBLED, HalfUnit};
use super::random::random_block;
use super::visibility::open_squares;
use super::{Factor, SparseMatrix, places_above};
use crate::method::error::Error;
use crate::method::linear_algebra::{cholesky, pencil_eigen, symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Steps of inverse iteration. In each a motion whose resistance is $k$ slacks loses a factor of $1 + k$ beside those that nothing
/// resists: of [`GAP`] slacks six leave less than the round-off of doubles.
const STEPS: usize = 6;
/// Motions sought beyond those counted, so that these converge by the resistance of motions further up.
const BEYOND: usize = 8;
/// Slacks up to which there is no other motion where a count is sure: a gap in the spectrum that no rounding of the file makes.
const GAP: f64 = 30.0;

/// Motions of a rigid body at the rows of a matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// Three translations and three rotations about the middle (rows × 6).
    motions: DMatrix<f64>,
    /// Their largest errors by the rounding of the places.
    errors: DMatrix<f64>,
}

impl Places {
    /// The motions at rows of which each has a place and a direction, 0 to 5; `rounding` is the largest part of the farthest coordinate
    /// by which one is rounded.
    pub fn new(rows: &[(Vector3<f64>, usize)], rounding: f64) -> Self {
        let middle = rows.iter().map(|row| row.0).sum::<Vector3<f64>>() / rows.len().max(1) as f64;
        let farthest = rows.iter().map(|row| row.0.amax()).fold(0.0, f64::max);
        let mut motions = DMatrix::zeros(rows.len(), 6);
        let mut errors = motions.clone();
        for (row, &(place, direction)) in rows.iter().enumerate() {
            motions[(row, direction)] = 1.0;
            for axis in (0..3).filter(|_| direction < 3) {
                let turned = Vector3::ith(axis, 1.0).cross(&(place - middle));
                motions[(row, 3 + axis)] = turned[direction];
                errors[(row, 3 + axis)] = rounding.max(ASSEMBLED) * farthest;
            }
        }
        Self { motions, errors }
    }

    /// The motions at some of the rows.
    pub(super) fn at(&self, rows: &[usize]) -> Self {
        let [motions, errors] = [&self.motions, &self.errors].map(|all| all.select_rows(rows));
        Self { motions, errors }
    }
}

/// Knowledge of a structure's free motions beside its stiffness.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Support {
    /// A matrix with the null space of the stiffness at any factors, if one better than the stiffness is known.
    pub resisting: Option<SparseMatrix>,
    /// Motions of a rigid body, if all rows have places.
    pub places: Option<Places>,
    /// The number of motions that nothing resists, if somebody says it.
    pub count: Option<usize>,
}

/// The null space of a semidefinite stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBodies {
    /// Motions that span the null space (rows × r): each is one at a row of its own in `rows` and zero at the others. Without these rows
    /// they are the lowest modes, nearly, which the digits do not tell from free among others of as little resistance.
    pub motions: DMatrix<f64>,
    /// Rows at which one of the motions is one and the others are zero.
    pub rows: Vec<usize>,
    /// Rows that move most in those of the motions that are none of a rigid body: mechanisms.
    pub mechanisms: Vec<usize>,
    /// The row with most force in a motion of a rigid body that is held while others are free.
    pub held: Option<usize>,
    /// True if places, or somebody, tell how many motions are free.
    pub is_told: bool,
    /// True if thirty times the rounding leaves as many.
    pub is_sure: bool,
    /// Half the unit of the last written place of the entries.
    half_unit: HalfUnit,
    /// $D$ ([`slack`]).
    slack: DVector<f64>,
}

impl RigidBodies {
    /// The null space of a symmetric matrix $K$ of which each entry is rounded by up to $h_{ij}$.
    ///
    /// The exact matrix is within $K \pm D$ ([`slack`]). If $K + D$ has a negative pivot, that is not semidefinite. If $K - D$ has n,
    /// no more than n motions are free, and as many count as free unless `support` has a number. Where places are known, those
    /// combinations $R t$ of rigid motions are free of which rounding explains every force,
    ///
    /// $$ \lvert K R t \rvert \le h \lvert R \rvert + \lvert K \rvert \lvert \delta R \rvert, $$
    ///
    /// $t$ being the singular vectors of $K R$ in units of the right side; other motions among the n are mechanisms. A better matrix of the
    /// same null space that `support` has stands for $K$. `plan` is for whichever tells it, among others.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] for a matrix that is not semidefinite whatever its rounding; [`Error::Count`] for a number of motions
    /// beyond n; the errors of the factorization.
    pub(super) fn of(
        plan: &Arc<FactorizationPlan>,
        matrix: &SparseMatrix,
        support: &Support,
    ) -> Result<Self, Error> {
        let what = "stiffness";
        let matrix = support.resisting.as_ref().unwrap_or(matrix);
        let (rows, half_unit) = (matrix.rows(), matrix.half_unit());
        let sizes = SparseMatrix::unit_scale(&matrix.diagonal());
        // A row without entries has nothing that could be rounded; with any slack its motion counts.
        let slack =
            brackets::slack(matrix, &sizes).map(|own| if own == 0.0 { ASSEMBLED } else { own });
        let root = slack.map(f64::sqrt);
        // In units of displacement that give every row a slack of one.
        let in_units = |matrix: &SparseMatrix| {
            let entries = matrix.entries();
            let entries = entries.map(|(i, j, value)| (i, j, value / root[i] / root[j]));
            SparseMatrix::new(what, rows, rows, entries.collect())
        };
        let unit = in_units(matrix)?;
        let ones = DVector::from_element(rows, 1.0);
        let at = |number: f64| bracket(plan, what, &[(1.0, &unit)], (number, &ones));
        let most = at(-1.0)?.negative_count();
        let count = support.count.unwrap_or(most);
        if count > most {
            let (what, found) = ("motions that the stiffness leaves free", count);
            return Err(Error::Count {
                what,
                found,
                least: 0,
                most,
            });
        }
        let mut found = Self {
            motions: DMatrix::zeros(rows, 0),
            rows: Vec::new(),
            mechanisms: Vec::new(),
            held: None,
            is_told: support.count.is_some() || support.places.is_some(),
            is_sure: true,
            half_unit,
            slack,
        };
        if most == 0 {
            // Nothing is negative at the upper end of the bracket either.
            return Ok(found);
        }
        let weakest = weakest(&unit, &at(1.0)?.check_signs(what)?, count)?;
        match &support.places {
            _ if support.count.is_some() => (),
            Some(places) => {
                let rounded = in_units(&matrix.half_units())?;
                found.judge([&unit, &rounded], places, &root, &weakest)?;
            }
            None => found.is_sure = at(-GAP)?.negative_count() == most,
        }
        // Motions among others of as little resistance are no null space: as modes they are exact, where doubles hold them.
        if !found.is_sure {
            let doubles = brackets::slack(&unit, &SparseMatrix::unit_scale(&unit.diagonal()));
            if bracket(plan, what, &[(1.0, &unit)], (-1.0, &doubles))?.negative_count() == 0 {
                found.motions = per_row(weakest, &root);
                return Ok(found);
            }
        }
        found.rows = moving_rows(&weakest);
        // Held by springs at these rows, one of which is displaced by one, the structure moves by a motion that nothing
        // resists. A solution gives all its digits; a decomposition mixes in motions that strain little beside the stiffest.
        let diagonal = unit.diagonal();
        let mut ground = DVector::zeros(rows);
        let mut displacements = DMatrix::zeros(rows, count);
        for (at, &row) in found.rows.iter().enumerate() {
            ground[row] = diagonal[row].max(1.0);
            displacements[(row, at)] = ground[row];
        }
        let held = bracket(plan, what, &[(1.0, &unit)], (1.0, &ground))?;
        let motions = per_row(held.solve(&displacements)?, &root);
        let own = motions.select_rows(&found.rows).try_inverse();
        found.motions = motions * own.ok_or(Error::no_convergence("rigid-body modes"))?;
        Ok(found)
    }

    /// Tells the motions of a rigid body among the weakest (rows × n, orthonormal) from mechanisms, of a matrix and the half units of its
    /// entries in units of a `root`.
    fn judge(
        &mut self,
        [unit, rounded]: [&SparseMatrix; 2],
        places: &Places,
        root: &DVector<f64>,
        weakest: &DMatrix<f64>,
    ) -> Result<(), Error> {
        let weighted = |motions: &DMatrix<f64>| {
            DMatrix::from_fn(motions.nrows(), 6, |row, at| root[row] * motions[(row, at)])
        };
        let (motions, errors) = (weighted(&places.motions), weighted(&places.errors));
        let lengths = motions.column_iter().map(|motion| motion.norm());
        let lengths: Vec<f64> = lengths
            .map(|length| if length > 0.0 { 1.0 / length } else { 0.0 })
            .collect();
        let lengths = DMatrix::from_diagonal(&DVector::from(lengths));
        let (motions, errors) = (motions * &lengths, errors * lengths);
        // Motions that are the same at the rows count once: their Gram matrix is rounded by no more than sums are.
        let (sizes, vectors) =
            symmetric_eigen("rigid motions", &symmetric_part(&motions.tr_mul(&motions)))?;
        let apart = vectors.select_columns(&places_above(&sizes, ASSEMBLED));
        let (motions, errors) = (motions * &apart, errors * apart.abs());
        let mut explained: DVector<f64> = DVector::zeros(motions.nrows());
        for (matrix, all) in [(unit, errors), (rounded, motions.abs())] {
            let slack = all.column_sum();
            let entries = matrix.entries();
            entries.for_each(|(row, column, value)| explained[row] += value.abs() * slack[column]);
        }
        let mut forces = unit.times(&motions)?;
        for (mut forces, explained) in forces.row_iter_mut().zip(&explained) {
            forces /= explained.max(f64::MIN_POSITIVE);
        }
        let (_, turn) = symmetric_eigen(
            "forces of rigid motions",
            &symmetric_part(&forces.tr_mul(&forces)),
        )?;
        let (forces, motions) = (forces * &turn, motions * turn);
        let is_free = |at: &usize| forces.column(*at).amax() <= 1.0;
        let (free, held): (Vec<usize>, Vec<usize>) = (0..forces.ncols()).partition(is_free);
        if let Some(&most) = held.last().filter(|_| !free.is_empty()) {
            self.held = Some(forces.column(most).iamax());
        }
        let count = weakest.ncols().saturating_sub(free.len());
        // What of the weakest motions is none of a free rigid body.
        let free = motions.select_columns(&free).qr().q();
        let rest = weakest - &free * free.tr_mul(weakest);
        let (_, vectors) = symmetric_eigen("mechanisms", &symmetric_part(&rest.tr_mul(&rest)))?;
        let rest = rest * vectors.columns(vectors.ncols() - count, count);
        self.mechanisms = moving_rows(&rest);
        Ok(())
    }

    /// Number of motions of a rigid body among those that are free.
    pub fn rigid(&self) -> usize {
        self.rows.len() - self.mechanisms.len()
    }

    /// Findings that the digits of the stiffness leave open, with stiffness and mass and the rows' names.
    ///
    /// # Errors
    /// Errors of an eigensolution of the motions.
    pub(crate) fn findings(
        &self,
        [stiffness, mass]: [&SparseMatrix; 2],
        name: impl Fn(usize) -> String,
    ) -> Result<Vec<BodyFinding>, Error> {
        let names = |rows: &[usize]| rows.iter().map(|&row| name(row)).collect();
        let mut all = Vec::new();
        if !self.mechanisms.is_empty() {
            all.push(BodyFinding::Mechanisms(names(&self.mechanisms)));
        }
        if let Some(row) = self.held {
            all.push(BodyFinding::Held {
                row: name(row),
                free: self.rigid(),
            });
        }
        if self.motions.ncols() > 0 && !self.is_told {
            all.push(BodyFinding::ByDigits {
                count: self.motions.ncols(),
                digits: self.half_unit.words(),
                if_held: match self.rows.len() {
                    0 => Vec::new(),
                    _ => self.if_held([stiffness, mass])?,
                },
                hidden_hz: self.hidden(mass).sqrt() / TAU,
                is_sure: self.is_sure,
            });
        }
        Ok(all)
    }

    /// Frequencies of the motions, and their deviations by the digits, if the stiffness as it is written holds them.
    fn if_held(&self, pencil: [&SparseMatrix; 2]) -> Result<Vec<[f64; 2]>, Error> {
        let of = |matrix: &SparseMatrix| {
            let forces = matrix.times(&self.motions)?;
            Ok(symmetric_part(&self.motions.tr_mul(&forces)))
        };
        let lower = cholesky("mass of rigid-body motions", &of(pencil[1])?, 0.0)?;
        let (squares, vectors) = pencil_eigen("motions", &of(pencil[0])?, &lower, self.rows.len())?;
        let modes = Modes {
            omega_squared: squares.map(|own| own.max(0.0)),
            shapes: &self.motions * vectors,
        };
        let open = open_squares(pencil, &modes)?;
        let squares = modes.omega_squared.iter().zip(&open);
        let hertz = |own: f64| own.sqrt() / TAU;
        Ok(squares
            .map(|(own, open)| [hertz(*own), hertz(own + open) - hertz(*own)])
            .collect())
    }

    /// A bound on the squared frequency of a suspension that the rounding of the stiffness would hide, with the mass: of the motions'
    /// slack $S$ and mass $M_r$ the trace of $M_r^{-1} S$, rad²/s².
    pub(crate) fn hidden(&self, mass: &SparseMatrix) -> f64 {
        let mut weighted = self.motions.clone();
        weighted
            .column_iter_mut()
            .for_each(|mut motion| motion.component_mul_assign(&self.slack));
        let slack = self.motions.tr_mul(&weighted);
        let mass = mass
            .times(&self.motions)
            .ok()
            .and_then(|forces| symmetric_part(&self.motions.tr_mul(&forces)).cholesky());
        mass.map_or(f64::INFINITY, |mass| mass.solve(&slack).trace())
    }
}

/// Something that the digits of a stiffness leave open about the motions that it leaves free.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyFinding {
    /// Motions of these rows are none of a rigid body.
    Mechanisms(Vec<String>),
    /// So many motions of a rigid body are free, and another meets most force at this row.
    Held {
        /// The row.
        row: String,
        /// The number of those that are free.
        free: usize,
    },
    /// Places do not tell which motions are free.
    ByDigits {
        /// The number of motions.
        count: usize,
        /// The digits that leave them free, in words.
        digits: String,
        /// Their frequencies if they are held, and the deviations of these by the digits, Hz; none where they are listed as modes.
        if_held: Vec<[f64; 2]>,
        /// A frequency below which a suspension would not show, Hz.
        hidden_hz: f64,
        /// True if the digits of a double leave as many free.
        is_sure: bool,
    },
}

impl BodyFinding {
    /// Finding beside the lowest frequency found: where a suspension higher than that would not show, the count is not sure.
    pub(crate) fn beside(mut self, lowest_hz: Option<f64>) -> Self {
        if let Self::ByDigits {
            hidden_hz, is_sure, ..
        } = &mut self
        {
            *is_sure &= lowest_hz.is_some_and(|lowest| *hidden_hz < lowest);
        }
        self
    }
}

/// Motions (rows × `count`) of least energy, orthonormal, by inverse iteration with a factor of the matrix and a slack of one.
fn weakest(unit: &SparseMatrix, factor: &Factor, count: usize) -> Result<DMatrix<f64>, Error> {
    let block = (count + BEYOND).min(unit.rows());
    let mut weakest = random_block(unit.rows(), block, &mut 0);
    for _ in 0..STEPS {
        weakest = factor.solve(&weakest)?.qr().q();
    }
    let energies = symmetric_part(&weakest.tr_mul(&unit.times(&weakest)?));
    let (_, vectors) = symmetric_eigen("resistance of motions", &energies)?;
    Ok(weakest * vectors.columns(0, count))
}

/// Motions over a unit of displacement of every row.
fn per_row(mut motions: DMatrix<f64>, unit: &DVector<f64>) -> DMatrix<f64> {
    let each = motions.column_iter_mut();
    each.for_each(|mut motion| motion.component_div_assign(unit));
    motions
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
