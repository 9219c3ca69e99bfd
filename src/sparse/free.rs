//! The motions that a stiffness does not resist as far as its numbers tell, and which of them are those of a rigid body.
//!
//! A motion cannot be told from free when its energy lies within what the rounding of the entries may do to it. It is free where places,
//! or somebody, say so too, and a mechanism where they do not.

use super::checks::independent;
use super::factorization::FactorizationPlan;
use super::matrix::{ASSEMBLED, HalfUnit};
use super::random::random_block;
use super::visibility::open_squares;
use super::{Factor, SparseMatrix};
use crate::method::error::{Error, check_count};
use crate::method::linear_algebra::{cholesky, pencil_eigen, symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Steps of inverse iteration. In each a motion whose energy is $k$ slacks loses a factor of $1 + k$ beside those that nothing resists:
/// of [`GAP`] slacks six leave less than the round-off of doubles.
const STEPS: usize = 6;
/// Motions sought beyond those counted, so that these converge by the energy of motions further up.
const BEYOND: usize = 8;
/// Slacks up to which there is no other motion where a count is sure: a gap in the spectrum that no rounding of the file makes.
const GAP: f64 = 30.0;
/// Square of the part of a rigid motion that counts as nothing new beside the others: places have six digits.
const ALIKE: f64 = 1e-10;

/// Motions of a rigid body at the rows of a matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// Three translations and three rotations about the middle (rows × 6).
    motions: DMatrix<f64>,
    /// Largest error of a coordinate.
    error: f64,
}

impl Places {
    /// The motions at rows of which each has a place and a direction, 0 to 5; `rounding` is the largest part of the farthest coordinate
    /// by which one is rounded.
    pub fn new(rows: &[(Vector3<f64>, usize)], rounding: f64) -> Self {
        let middle = rows.iter().map(|row| row.0).sum::<Vector3<f64>>() / rows.len().max(1) as f64;
        let farthest = rows.iter().map(|row| row.0.amax()).fold(0.0, f64::max);
        let error = rounding.max(ASSEMBLED) * farthest;
        let motion = |row: usize, motion: usize| match rows[row] {
            (_, direction) if direction == motion => 1.0,
            (place, direction @ 0..3) if motion > 2 => {
                let turned = Vector3::ith(motion - 3, 1.0).cross(&(place - middle))[direction];
                // What rounding of the places makes as well is no motion.
                match turned.abs() > error {
                    true => turned,
                    false => 0.0,
                }
            }
            _ => 0.0,
        };
        let motions = DMatrix::from_fn(rows.len(), 6, motion);
        Self { motions, error }
    }

    /// The motions at some of the rows.
    pub(super) fn at(&self, rows: &[usize]) -> Self {
        let motions = self.motions.select_rows(rows);
        Self { motions, ..*self }
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

/// The motions that a semidefinite stiffness leaves free.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RigidBodies {
    /// Motions of least energy, as many as count as free (rows × r).
    pub motions: DMatrix<f64>,
    /// Rows that springs to the ground would hold them at, one a motion. There are none where the digits do not tell these motions from free
    /// among others of as little energy: as modes they are exact, where doubles hold them.
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
    /// The motions that a symmetric matrix $K$ leaves free of which each entry is rounded by up to $h_{ij}$.
    ///
    /// The exact matrix is within $K \pm D$ ([`slack`]). If $K + D$ has a negative pivot, that is not semidefinite. If $K - D$ has n,
    /// n motions have no more energy than rounding, and count as free unless `support` has a number. A better matrix of the same null space
    /// that `support` has stands for $K$. `plan` is for whichever tells it, among others.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] for a matrix that is not semidefinite whatever its rounding; [`Error::Count`] for a number of motions
    /// beyond n; the errors of the factorization.
    pub(super) fn of(
        plan: &Arc<FactorizationPlan>,
        stiffness: &SparseMatrix,
        support: &Support,
    ) -> Result<Self, Error> {
        let matrix = support.resisting.as_ref().unwrap_or(stiffness);
        let (rows, what) = (matrix.rows(), "stiffness");
        let sizes = SparseMatrix::unit_scale(&matrix.diagonal());
        // A row without entries has nothing that could be rounded; with any slack its motion counts.
        let slack = slack(matrix, &sizes).map(|own| if own == 0.0 { ASSEMBLED } else { own });
        let at = |slack| bracket(plan, what, &[(1.0, matrix)], slack);
        let most = at(-&slack)?.negative_count();
        let count = support.count.unwrap_or(most);
        check_count("motions that the stiffness leaves free", count, 0, most)?;
        let mut found = Self {
            is_told: support.count.is_some() || support.places.is_some(),
            is_sure: true,
            half_unit: matrix.half_unit(),
            slack,
            ..Self::default()
        };
        if most == 0 {
            // Nothing is negative at the upper end of the bracket either.
            return Ok(found);
        }
        // By inverse iteration in units of displacement that give every row a slack of one.
        let root = found.slack.map(f64::sqrt);
        let unit = root.map(f64::recip);
        let factor = at(found.slack.clone())?.check_signs(what)?;
        let mut weakest = random_block(rows, (count + BEYOND).min(rows), &mut 0);
        for _ in 0..STEPS {
            let deflections = factor.solve(&each_row(&weakest, &root))?;
            weakest = each_row(&deflections, &root).qr().q();
        }
        let motions = each_row(&weakest, &unit);
        let energies = symmetric_part(&motions.tr_mul(&matrix.times(&motions)?));
        let (_, vectors) = symmetric_eigen("energy of motions", &energies)?;
        weakest *= vectors.columns(0, count);
        found.motions = each_row(&weakest, &unit);
        match &support.places {
            _ if support.count.is_some() => (),
            Some(places) => found.judge(matrix, places, &root, &weakest)?,
            None => found.is_sure = at(-GAP * &found.slack)?.negative_count() == most,
        }
        let doubles = matrix.clone().with_half_unit(HalfUnit::of_each(0.0));
        if found.is_sure || at(-self::slack(&doubles, &sizes))?.negative_count() > 0 {
            found.rows = moving_rows(&weakest);
        }
        Ok(found)
    }

    /// Tells the motions of a rigid body among the weakest (rows × n, orthonormal in units of a slack's `root`) from mechanisms: those
    /// combinations $R t$ of which rounding explains the force at every row,
    ///
    /// $$ \lvert K R t \rvert \le h \lvert R \rvert + \lvert K \rvert \lvert \delta R \rvert, $$
    ///
    /// $t$ being the singular vectors of $K R$ in units of the right side. The energy alone does not tell where one row in many is held.
    fn judge(
        &mut self,
        matrix: &SparseMatrix,
        Places { motions, error }: &Places,
        root: &DVector<f64>,
        weakest: &DMatrix<f64>,
    ) -> Result<(), Error> {
        let rigid = each_row(motions, root);
        // Motions that are the same at the rows count once.
        let gram = rigid.tr_mul(&rigid);
        let lengths = SparseMatrix::unit_scale(&gram.diagonal());
        let units = DMatrix::from_diagonal(&lengths.map(f64::recip));
        let (_, apart) = independent("rigid motions", &(&units * gram * &units), |_| ALIKE)?;
        let apart = units * apart;
        let (motions, moved) = (motions * &apart, motions.columns(0, 3));
        let all = |columns, each| DMatrix::from_element(columns, 1, each);
        let errors = moved * all(3, error * apart.rows(3, 3).abs().sum());
        let sizes = matrix.clone().with_half_unit(HalfUnit::of_each(1.0));
        let explained = matrix
            .half_units()
            .times(&(motions.abs() * all(apart.ncols(), 1.0)))?
            + sizes.half_units().times(&errors)?;
        let explained = explained.map(|own| 1.0 / own.max(f64::MIN_POSITIVE));
        let forces = each_row(&matrix.times(&motions)?, &explained.column(0).into_owned());
        let squares = symmetric_part(&forces.tr_mul(&forces));
        let (_, turn) = symmetric_eigen("forces of rigid motions", &squares)?;
        let (forces, rigid) = (forces * &turn, rigid * apart * turn);
        let is_free = |at: &usize| forces.column(*at).amax() <= 1.0;
        let (free, held): (Vec<usize>, Vec<usize>) = (0..rigid.ncols()).partition(is_free);
        let most = held.last().filter(|_| !free.is_empty());
        self.held = most.map(|at| forces.column(*at).iamax());
        let rigid = rigid.select_columns(&free);
        self.mechanisms = moving_rows(&(weakest - &rigid * rigid.tr_mul(weakest)));
        let count = weakest.ncols().saturating_sub(free.len());
        self.mechanisms.truncate(count);
        Ok(())
    }

    /// Number of motions of a rigid body among those that are free.
    pub fn rigid(&self) -> usize {
        self.rows.len() - self.mechanisms.len()
    }

    /// Findings that the digits of the stiffness leave open, with stiffness and mass, the rows' names and the lowest frequency found: where a
    /// suspension higher than that would not show, a count is not sure.
    ///
    /// # Errors
    /// Errors of an eigensolution of the motions.
    pub(crate) fn findings(
        &self,
        pencil: [&SparseMatrix; 2],
        name: impl Fn(usize) -> String,
        lowest_hz: Option<f64>,
    ) -> Result<Vec<BodyFinding>, Error> {
        let mut all = Vec::new();
        if !self.mechanisms.is_empty() {
            let rows = self.mechanisms.iter().map(|&row| name(row));
            all.push(BodyFinding::Mechanisms(rows.collect()));
        }
        if let Some(row) = self.held {
            let (row, free) = (name(row), self.rigid());
            all.push(BodyFinding::Held { row, free });
        }
        if self.motions.ncols() > 0 && !self.is_told {
            all.push(self.by_digits(pencil, lowest_hz)?);
        }
        Ok(all)
    }

    /// Frequencies of the motions, and their deviations by the digits, if the stiffness as it is written holds them; and a bound on the
    /// squared frequency of a suspension that the rounding of the stiffness would hide, the trace of the slack in motions of unit mass.
    fn by_digits(
        &self,
        pencil: [&SparseMatrix; 2],
        lowest_hz: Option<f64>,
    ) -> Result<BodyFinding, Error> {
        let of = |matrix: &SparseMatrix| {
            let forces = matrix.times(&self.motions)?;
            Ok(symmetric_part(&self.motions.tr_mul(&forces)))
        };
        let count = self.motions.ncols();
        let lower = cholesky("mass of rigid-body motions", &of(pencil[1])?, 0.0)?;
        let (squares, vectors) = pencil_eigen("motions", &of(pencil[0])?, &lower, count)?;
        let modes = Modes {
            omega_squared: squares.map(|own| own.max(0.0)),
            shapes: &self.motions * vectors,
        };
        let hertz = |square: f64| square.sqrt() / TAU;
        let hidden = modes.shapes.map(|own| own * own).tr_mul(&self.slack).sum();
        let hidden_hz = hertz(hidden);
        let open = open_squares(pencil, &modes)?;
        let squares = modes.omega_squared.iter().zip(&open).take(self.rows.len());
        let held = squares.map(|(own, open)| [hertz(*own), hertz(own + open) - hertz(*own)]);
        Ok(BodyFinding::ByDigits {
            count,
            digits: self.half_unit.words(),
            if_held: held.collect(),
            hidden_hz,
            is_sure: self.is_sure && lowest_hz.is_some_and(|lowest| hidden_hz < lowest),
        })
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
        /// True if thirty times the rounding leaves as many, and a suspension that is not seen is below all modes found.
        is_sure: bool,
    },
}

/// Motions with every row times a number.
fn each_row(motions: &DMatrix<f64>, numbers: &DVector<f64>) -> DMatrix<f64> {
    motions.map_with_location(|row, _, value| value * numbers[row])
}

/// The row that moves most in motions, then the one that moves most in what the first leaves free, as many as there are motions.
fn moving_rows(motions: &DMatrix<f64>) -> Vec<usize> {
    let mut rows = DMatrix::from_fn(1, motions.nrows(), |_, row| row);
    if motions.ncols() > 0 {
        let pivots = motions.transpose().col_piv_qr();
        pivots.p().permute_columns(&mut rows);
    }
    rows.iter().take(motions.ncols()).copied().collect()
}

/// The diagonal $D$ that bounds the energy $y^t E y$ of any rounding $\lvert E_{ij} \rvert \le h_{ij}$ of a symmetric matrix with the half
/// units $h$ of its last written places,
///
/// $$ \lvert y^t E y \rvert \le y^t D y, \qquad D_i = \sum_j h_{ij} \frac{s_i}{s_j}, $$
///
/// for any sizes $s$, since $2 \lvert y_i y_j \rvert \le y_i^2 s_i / s_j + y_j^2 s_j / s_i$. With $s_i = \sqrt{K_{ii}}$ of a whole
/// matrix no unit of displacement is in it.
pub(super) fn slack(matrix: &SparseMatrix, sizes: &DVector<f64>) -> DVector<f64> {
    let mut slack = DVector::zeros(matrix.rows());
    for (row, column, value) in matrix.entries() {
        slack[row] += matrix.half_unit().of(value) * (sizes[row] / sizes[column]);
    }
    slack
}

/// The factor of a sum of symmetric matrices, each times its number, and of a slack: by the law of inertia no fewer negative pivots than a
/// matrix within the slack has negative eigenvalues where that is taken away, and no more where it is added.
///
/// # Errors
/// Errors of the factorization, where it fails at one and a half times the slack too.
pub(super) fn bracket(
    plan: &Arc<FactorizationPlan>,
    what: &'static str,
    terms: &[(f64, &SparseMatrix)],
    slack: DVector<f64>,
) -> Result<Factor, Error> {
    let rows = slack.len();
    let diagonal = (0..rows).map(|row| (row, row, slack[row])).collect();
    let diagonal = SparseMatrix::new(what, rows, rows, diagonal)?;
    let of = |larger| Factor::of_sum(plan, what, &[terms, &[(larger, &diagonal)]].concat());
    // Another number only where a pivot vanishes.
    of(1.0).or_else(|_| of(1.25)).or_else(|_| of(1.5))
}
