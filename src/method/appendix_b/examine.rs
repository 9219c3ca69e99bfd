//! Examination of test modes: both steps, the report, and the deletion of deviant modes.

use super::{Balanced, Movement, balance, orthogonalize};
use crate::method::error::{Error, at_least_one, positive, require};
use crate::method::modes::Modes;
use nalgebra::DMatrix;

/// Movements beyond which a mode is deleted, in fractions chosen by engineering judgment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovementLimits {
    /// Change of shape by balancing, [`Balanced::change`]; between 0 and 1.
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
        let owner = || "the movement limits".to_owned();
        let (value, expected) = (self.balance, "a number between 0 and 1");
        require(
            value > 0.0 && value < 1.0,
            "balance",
            owner,
            value,
            expected,
        )?;
        positive("frequency", owner, self.frequency)?;
        positive("shape", owner, self.shape)
    }

    /// The larger movement in units of its limit.
    fn excess(&self, movement: &Movement) -> f64 {
        (movement.frequency.abs() / self.frequency).max(movement.shape / self.shape)
    }
}

/// Supports of the tested structure.
#[derive(Debug, Clone, Copy)]
pub enum Supports<'a> {
    /// By supports, whose reactions balance the forces: the modes are not balanced.
    Held,
    /// Not at all, or by a soft suspension: the modes are balanced first.
    Free {
        /// Dynamic stiffness with the suspension's springs, lbf/in (d × d).
        stiffness: &'a DMatrix<f64>,
        /// Rigid-body vectors (d × m), see [`rigid_body_vectors`](crate::method::appendix_b::rigid_body_vectors).
        rigid_body: &'a DMatrix<f64>,
    },
}

/// Verdict on a test mode: kept, or why not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeVerdict {
    /// Kept.
    Kept,
    /// Deleted: balancing changed its shape by more than the limit.
    Unbalanced,
    /// Deleted: with it among the modes, orthogonalization moved some mode past a limit.
    NotOrthogonal,
}

/// Report on one test mode.
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
    pub modes: Modes,
    /// Places of these among the raw modes, from zero.
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
/// [`Error::Value`] for a bad limit; [`Error::Count`] when no mode is left; what [`balance`] and [`orthogonalize`] refuse.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::{MovementLimits, Supports, examine};
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The third shape has a fifth of either of the others in it.
/// let shapes = dmatrix![1.0, 0.0, 0.2; 0.0, 1.0, 0.2; 0.0, 0.0, 1.0];
/// let raw = Modes::new(dvector![1.0, 4.0, 9.0], shapes)?;
/// let mass = DMatrix::identity(3, 3);
/// let examination = examine(&raw, &mass, Supports::Held, &MovementLimits::default())?;
/// assert_eq!(examination.kept, [0, 1]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn examine(
    raw: &Modes,
    mass: &DMatrix<f64>,
    supports: Supports,
    limits: &MovementLimits,
) -> Result<Examination, Error> {
    limits.check()?;
    let mut balanced = raw.clone();
    let mut change = vec![None; raw.len()];
    if let Supports::Free {
        stiffness,
        rigid_body,
    } = supports
    {
        let Balanced {
            shapes,
            change: moved,
            ..
        } = balance(raw, stiffness, mass, rigid_body)?;
        balanced.shapes = shapes;
        change = moved.into_iter().map(Some).collect();
    }
    let report = |&balance: &Option<f64>| ModeReport {
        balance,
        movement: None,
        verdict: match balance {
            Some(change) if change > limits.balance => ModeVerdict::Unbalanced,
            _ => ModeVerdict::Kept,
        },
    };
    let mut reports: Vec<ModeReport> = change.iter().map(report).collect();
    let is_kept = |&mode: &usize| reports[mode].verdict == ModeVerdict::Kept;
    let mut kept: Vec<usize> = (0..raw.len()).filter(is_kept).collect();
    loop {
        at_least_one("test modes within the limits", kept.len())?;
        let result = orthogonalize(&balanced.select(&kept), mass)?;
        let excess: Vec<f64> = result
            .movement
            .iter()
            .map(|moved| limits.excess(moved))
            .collect();
        for (&mode, &movement) in kept.iter().zip(&result.movement) {
            reports[mode].movement = Some(movement);
        }
        if !excess.iter().any(|excess| *excess > 1.0) {
            let modes = result.modes;
            return Ok(Examination {
                modes,
                kept,
                reports,
            });
        }
        let m = &result.overlap;
        let overlaps = |i: usize| m.column(i).norm_squared() - m[(i, i)].powi(2);
        let rank = |&a: &usize, &b: &usize| {
            let most = overlaps(a).total_cmp(&overlaps(b));
            most.then(excess[a].total_cmp(&excess[b]))
        };
        let deleted = kept.remove((0..kept.len()).max_by(rank).unwrap_or(0));
        reports[deleted].verdict = ModeVerdict::NotOrthogonal;
    }
}
