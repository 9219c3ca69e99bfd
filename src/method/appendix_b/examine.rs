//! Which test modes are fit for correlation: both steps, the report, and the deletion of deviant modes.

use super::balance::{Balanced, balance};
use super::orthogonalize::{Movement, orthogonalize};
use crate::method::error::{Error, at_least_one, positive_setting, setting};
use crate::method::modes::ModeSet;
use nalgebra::DMatrix;

/// How far a mode may move before it is deleted, in fractions chosen by engineering judgment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovementLimits {
    /// Change of shape by balancing, [`super::Balanced::change`]; between 0 and 1.
    pub balance: f64,
    /// Change of frequency by orthogonalization, up or down, [`Movement::frequency`].
    pub frequency: f64,
    /// Change of shape by orthogonalization, [`Movement::shape`].
    pub shape: f64,
}

impl Default for MovementLimits {
    /// 10 % of shape for each step, the customary bound on the off-diagonal generalized masses of test modes, and 2 %
    /// of frequency, several times what a resonance is measured to.
    fn default() -> Self {
        Self {
            balance: 0.10,
            frequency: 0.02,
            shape: 0.10,
        }
    }
}

impl MovementLimits {
    fn check(&self) -> Result<(), Error> {
        let is_met = self.balance > 0.0 && self.balance < 1.0;
        setting("balance", "a number between 0 and 1", self.balance, is_met)?;
        positive_setting("frequency", self.frequency)?;
        positive_setting("shape", self.shape)
    }

    /// The larger movement in units of its limit.
    fn excess(&self, movement: &Movement) -> f64 {
        (movement.frequency.abs() / self.frequency).max(movement.shape / self.shape)
    }
}

/// How the tested structure was held.
#[derive(Debug, Clone, Copy)]
pub enum Supports<'a> {
    /// By supports, whose reactions balance the forces: the modes are not balanced.
    Held,
    /// Not at all, or by a soft suspension: the modes are balanced first.
    Free {
        /// Dynamic stiffness with the suspension's springs, lbf/in (d × d).
        stiffness: &'a DMatrix<f64>,
        /// Rigid-body vectors (d × m), see [`super::rigid_body_vectors`].
        rigid_body: &'a DMatrix<f64>,
    },
}

/// Whether a test mode is kept, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeVerdict {
    /// Kept.
    Kept,
    /// Deleted: balancing changed its shape by more than the limit.
    Unbalanced,
    /// Deleted: with it among the modes, orthogonalization moved some mode past a limit.
    NotOrthogonal,
}

/// What became of one test mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeReport {
    /// Relative change of shape by balancing; none when the structure was held.
    pub balance: Option<f64>,
    /// Movement by orthogonalization among the modes not yet deleted; none when balancing deleted it.
    pub movement: Option<Movement>,
    /// Kept or deleted.
    pub verdict: ModeVerdict,
}

/// Test modes fit for correlation, and the report on all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Examination {
    /// The modes kept, balanced and orthonormal, in the order of the raw ones.
    pub modes: ModeSet,
    /// Which raw modes they are, from zero.
    pub kept: Vec<usize>,
    /// One report for every raw mode.
    pub reports: Vec<ModeReport>,
}

/// Balances the test modes, orthogonalizes them, and deletes those that do not fit.
///
/// A mode that balancing changes by more than its limit is deleted at once. Orthogonalization moves good modes with a
/// wrong one that overlaps them, and may move them farther. So while any mode moves past a limit, the one is deleted
/// that overlaps most with all others together, $\max_i \sum_{j \ne i} m_{1,ij}^2$ (on a tie the one that moved
/// farthest, the higher of two), and the rest are orthogonalized anew from their balanced shapes. This finds a single
/// wrong mode anywhere in the spectrum; several that are mixed with each other are not always told from good ones.
///
/// # Errors
/// [`Error::Setting`] for a bad limit; [`Error::Empty`] when no mode is left; those of [`balance`] and
/// [`orthogonalize`], with modes numbered as they came.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::{MovementLimits, Supports, examine};
/// use corfem::method::modes::ModeSet;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The third shape has a fifth of either of the others in it.
/// let shapes = dmatrix![1.0, 0.0, 0.2; 0.0, 1.0, 0.2; 0.0, 0.0, 1.0];
/// let raw = ModeSet::new(dvector![1.0, 4.0, 9.0], shapes)?;
/// let mass = DMatrix::identity(3, 3);
/// let examination = examine(&raw, &mass, Supports::Held, &MovementLimits::default())?;
/// assert_eq!(examination.kept, [0, 1]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn examine(
    raw: &ModeSet,
    mass: &DMatrix<f64>,
    supports: Supports,
    limits: &MovementLimits,
) -> Result<Examination, Error> {
    limits.check()?;
    raw.generalized_masses(mass)?;
    let unmoved = ModeReport {
        balance: None,
        movement: None,
        verdict: ModeVerdict::Kept,
    };
    let (mut balanced, mut reports) = (raw.clone(), vec![unmoved; raw.len()]);
    if let Supports::Free {
        stiffness,
        rigid_body,
    } = supports
    {
        let Balanced { shapes, change, .. } = balance(raw, stiffness, mass, rigid_body)?;
        balanced.shapes = shapes;
        for (report, change) in reports.iter_mut().zip(change) {
            report.balance = Some(change);
            if change > limits.balance {
                report.verdict = ModeVerdict::Unbalanced;
            }
        }
    }
    let mut kept: Vec<usize> = (0..raw.len())
        .filter(|&mode| reports[mode].verdict == ModeVerdict::Kept)
        .collect();
    at_least_one("test modes within the limits", kept.len())?;
    loop {
        let result = orthogonalize(&balanced.select(&kept), mass).map_err(|error| match error {
            Error::Dependent { what, index } => Error::Dependent {
                what,
                index: kept[index],
            },
            other => other,
        })?;
        for (&mode, &movement) in kept.iter().zip(&result.movement) {
            reports[mode].movement = Some(movement);
        }
        if !result
            .movement
            .iter()
            .any(|movement| limits.excess(movement) > 1.0)
        {
            return Ok(Examination {
                modes: result.modes,
                kept,
                reports,
            });
        }
        let moved = |i: usize| limits.excess(&result.movement[i]);
        let others = |i: usize| (0..kept.len()).filter(move |&j| j != i);
        let overlaps =
            |i: usize| -> f64 { others(i).map(|j| result.overlap[(j, i)].powi(2)).sum() };
        let order = |a: &usize, b: &usize| {
            overlaps(*a)
                .total_cmp(&overlaps(*b))
                .then(moved(*a).total_cmp(&moved(*b)))
        };
        let deleted = kept.remove((0..kept.len()).max_by(order).unwrap_or(0));
        reports[deleted].verdict = ModeVerdict::NotOrthogonal;
    }
}
