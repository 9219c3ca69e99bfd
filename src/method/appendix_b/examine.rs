//! Which test modes are fit for correlation: both steps, the report, and the deletion of deviant modes.

use super::balance::balance;
use super::checked_generalized_masses;
use super::orthogonalize::{Movement, Orthogonalized, orthogonalize};
use crate::method::error::Error;
use crate::method::modes::ModeSet;
use nalgebra::DMatrix;

/// How far a mode may move before it is deleted. All are fractions, and a matter of engineering judgment.
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
    /// 10 % of shape for each step, the customary bound on the off-diagonal generalized masses of test modes, and 2 % of
    /// frequency, several times what a resonance is measured to.
    fn default() -> Self {
        Self { balance: 0.10, frequency: 0.02, shape: 0.10 }
    }
}

impl MovementLimits {
    fn check(&self) -> Result<(), Error> {
        let positive = "a positive finite number";
        for (name, found, upper, expected) in [
            ("balance", self.balance, 1.0, "a number between 0 and 1"),
            ("frequency", self.frequency, f64::INFINITY, positive),
            ("shape", self.shape, f64::INFINITY, positive),
        ] {
            if !(found > 0.0 && found < upper) {
                return Err(Error::Setting { name, expected, found });
            }
        }
        Ok(())
    }

    /// The larger movement in units of its limit.
    fn excess(&self, movement: &Movement) -> f64 {
        (movement.frequency.abs() / self.frequency).max(movement.shape / self.shape)
    }

    fn any_exceeded(&self, movements: &[Movement]) -> bool {
        movements.iter().any(|movement| self.excess(movement) > 1.0)
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
pub enum Verdict {
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
    pub verdict: Verdict,
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
/// A mode that balancing changes by more than its limit is deleted at once: nothing but its own measurement is to
/// blame. Orthogonalization moves both of two overlapping modes, and a wrong one moves the good ones with it, those
/// above it even farther than itself. So while any mode moves past a limit, the mode is deleted that overlaps most with
/// all the others together, $\max_i \sum_{j \ne i} m_{1,ij}^2$, and the rest are orthogonalized anew from their balanced
/// shapes, as if it had never been measured. A single wrong mode with something of several others in it is thus
/// found wherever it lies in the spectrum. Two modes that overlap each other alone do not tell which is wrong; then
/// the one that moved farther goes, which is the higher. Several
/// wrong modes that are mixed among each other are not always told apart from good ones.
///
/// Every combination of balanced modes of a free structure is balanced; on a soft suspension it is nearly so.
///
/// # Errors
/// [`Error::Setting`] for a bad limit; [`Error::Empty`] when no mode is left; those of [`balance`] and [`orthogonalize`],
/// with modes numbered as they came.
pub fn examine(
    raw: &ModeSet,
    mass: &DMatrix<f64>,
    supports: Supports,
    limits: &MovementLimits,
) -> Result<Examination, Error> {
    limits.check()?;
    checked_generalized_masses(raw, mass)?;
    let (balanced, changes) = match supports {
        Supports::Held => (raw.clone(), vec![None; raw.len()]),
        Supports::Free { stiffness, rigid_body } => {
            let balanced = balance(raw, stiffness, mass, rigid_body)?;
            let modes = ModeSet { omega_squared: raw.omega_squared.clone(), shapes: balanced.shapes };
            (modes, balanced.change.into_iter().map(Some).collect())
        }
    };
    let mut reports: Vec<ModeReport> = changes
        .into_iter()
        .map(|balance: Option<f64>| ModeReport {
            balance,
            movement: None,
            verdict: match balance {
                Some(change) if change > limits.balance => Verdict::Unbalanced,
                _ => Verdict::Kept,
            },
        })
        .collect();
    let mut kept: Vec<usize> = (0..raw.len()).filter(|&mode| reports[mode].verdict == Verdict::Kept).collect();
    if kept.is_empty() {
        return Err(Error::Empty { what: "test modes within the limits" });
    }
    let mut result = orthogonalize_kept(&balanced, &kept, mass)?;
    while limits.any_exceeded(&result.movement) {
        let place = most_overlapping(&result, limits);
        let report = &mut reports[kept.remove(place)];
        report.movement = Some(result.movement[place]);
        report.verdict = Verdict::NotOrthogonal;
        result = orthogonalize_kept(&balanced, &kept, mass)?;
    }
    for (&mode, &movement) in kept.iter().zip(&result.movement) {
        reports[mode].movement = Some(movement);
    }
    Ok(Examination { modes: result.modes, kept, reports })
}

/// Orthogonalizes the modes kept; an error names a mode by its place among all.
fn orthogonalize_kept(balanced: &ModeSet, kept: &[usize], mass: &DMatrix<f64>) -> Result<Orthogonalized, Error> {
    orthogonalize(&balanced.select(kept), mass).map_err(|error| match error {
        Error::Dependent { what, index } => Error::Dependent { what, index: kept[index] },
        other => other,
    })
}

/// The place of the mode with the largest root sum of squares of its overlaps with the others; of equal ones, that
/// which moved farthest.
fn most_overlapping(result: &Orthogonalized, limits: &MovementLimits) -> usize {
    let count = result.movement.len();
    let total = |place: usize| -> f64 {
        let others = (0..count).filter(|&other| other != place);
        others.map(|other| result.overlap[(other, place)].powi(2)).sum()
    };
    let own = |place: usize| limits.excess(&result.movement[place]);
    (0..count)
        .max_by(|&a, &b| {
            let by_movement = || own(a).total_cmp(&own(b));
            total(a).total_cmp(&total(b)).then_with(by_movement)
        })
        .unwrap_or(0)
}
