//! The lowest modes of a sparse pencil, none of them missed: of structures on supports and of those that hang free, as an aircraft in
//! its test, and where degrees of freedom have no mass. Zero and infinite eigenvalues are neither lost nor counted as vibrations.

use super::brackets::slack;
use super::matrix::GIVEN;
use super::subspace::{Directions, Found, Growth, Solve, Wanted, subspace};
use super::{
    Factor, RigidBodies, SparseMatrix, places_above, solve_lower, take_product, transposed_product,
};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{check_finite, cholesky, symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::sparse::factorization::FactorizationPlan;
use nalgebra::{DMatrix, DVector};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Most rows of a pencil whose modes are all found at once: a full decomposition of that order takes a few milliseconds.
pub const MOST_DENSE_ROWS: usize = 150;
/// Name, in errors, of modes with a finite frequency.
pub const FINITE: &str = "modes of finite frequency";
/// Directions that are added to the subspace at once, unless a root is repeated more often.
const BLOCK: usize = 8;
/// Extra modes sought, so that two neighbors are found between which counting is safe.
const BEYOND: usize = 4;
/// Root relative to the largest below which it is lost: a decomposition finds each to some tens of roundings of the largest, so that
/// three digits are left at a frequency three million times the lowest.
const SMALLEST_ROOT: f64 = 1e-13;
/// Distance of two neighbors, relative to the higher, from which on modes can be counted between them.
const APART: f64 = 1e-5;
/// Upper end of a cluster without such a distance, relative to its highest squared frequency: two distances.
const JUST_ABOVE: f64 = 1.0 + 2.0 * APART;

/// Modes of a pencil, the rigid-body modes apart.
#[derive(Debug, Clone, PartialEq)]
pub struct CountedModes {
    /// Motions without strain, of unit generalized mass and orthogonal to each other (d × r).
    pub rigid_body: DMatrix<f64>,
    /// Vibrations of finite frequency, ascending, of unit generalized mass.
    pub vibrations: Modes,
    /// The lowest squared frequency of vibrations above those; none where there are no others.
    pub next: Option<f64>,
    /// Number of loads for which the factor was solved to find the vibrations.
    pub solutions: usize,
}

/// The `most` lowest vibrations of $K v = \omega^2 M v$ for semidefinite `stiffness` (lbf/in) and `mass` (lbf·s²/in), or all where they
/// are fewer, with all rigid-body modes and the flexibility that found them, which serves other loads too. The first `exact` are found to
/// round-off and the others nearly.
///
/// They have the largest roots $\mu$ of
///
/// $$ K^{-1} M v = \mu v, \qquad \omega^2 = \frac{1}{\mu} . $$
///
/// The rigid-body modes of a structure that hangs free (`bodies`) are known first, and the vibrations are sought among the motions
/// orthogonal to them in $M$, where the inverse exists. A block of directions is multiplied by this matrix again and
/// again, each new one made orthogonal to those before it in $M$; in the subspace that they span the modes are those of a small
/// matrix, and the best of them begin the next subspace. Pencils of [`MOST_DENSE_ROWS`], and those of which the subspace would be
/// the whole, have all their modes found at once. A factorization of $K - b M$ with $b$ just above the modes found must have as many
/// negative pivots as there are modes below: Sylvester's law of inertia. Where it counts others, a root is repeated more often than the
/// block has directions, and a block of as many directions as modes were counted begins anew.
///
/// Shapes `near` the modes, such as those of a model with other factors, begin the search in place of random ones. They cannot hide a
/// mode: where the inertia counts others, the search begins anew at random. `plan` is for both matrices together.
///
/// # Errors
/// [`Error::Count`] without mass; [`Error::NotPositiveDefinite`] for a motion that has neither stiffness nor mass, or a matrix that is
/// not semidefinite; [`Error::Failed`].
///
/// Source: Bathe, *Finite Element Procedures* (1996), sections 11.2 and 11.6; Parlett, *The Symmetric Eigenvalue Problem* (1980),
/// chapters 3, 13 and 15.
pub(super) fn modes_at_most(
    (stiffness, mass): (&SparseMatrix, &SparseMatrix),
    counts: RangeInclusive<usize>,
    mut near: Option<&DMatrix<f64>>,
    bodies: &RigidBodies,
    plan: &Arc<FactorizationPlan>,
) -> Result<(CountedModes, Flexibility), Error> {
    let (exact, most) = counts.into_inner();
    let count = most.min(stiffness.rows());
    at_least_one("modes", count)?;
    at_least_one("degrees of freedom with mass", mass.entries().len())?;
    plan.count_eigensolution();
    let factor_at = |what, shift| Factor::of_sum(plan, what, &[(1.0, stiffness), (shift, mass)]);
    let flexibility = Flexibility::of(plan, stiffness, mass, bodies)?;
    let rigid = flexibility.rigid.len();
    let (mut wanted, mut block, mut solutions) = (count + BEYOND, BLOCK, 0);
    loop {
        let found = largest(
            &flexibility,
            mass,
            near,
            (exact, wanted, block),
            &mut solutions,
        )?;
        let is_all = found.is_all;
        let (omega_squared, shapes) = frequencies(mass, found)?;
        let needed = omega_squared.len().min(count);
        if needed > 0 {
            let (bound, counted, found) = numbers(&factor_at, &omega_squared, needed, is_all)?;
            let found = rigid + found;
            if counted != found && near.take().is_some() {
                continue;
            }
            if counted != found {
                // A block as wide as all modes below the bound holds every copy of a repeated root, if all are wanted.
                if block.min(wanted) >= counted {
                    let why = format!(
                        "{found} were found below {bound:.6e} rad^2/s^2, but the shifted pencil's inertia counts {counted}"
                    );
                    let what = "modes";
                    return Err(Error::Failed { what, why });
                }
                (wanted, block) = (counted + BEYOND, block.max(counted));
                continue;
            }
        }
        let found = CountedModes {
            next: omega_squared.as_slice().get(needed).copied(),
            vibrations: Modes {
                omega_squared,
                shapes,
            }
            .select(&(0..needed).collect::<Vec<_>>()),
            rigid_body: flexibility.rigid.shapes.clone(),
            solutions,
        };
        return Ok((found, flexibility));
    }
}

/// The factor of $K + \sigma M$, named, for $\sigma$.
type At<'a> = &'a dyn Fn(&'static str, f64) -> Result<Factor, Error>;

/// $K^{-1}$, or its substitute where a structure hangs free: the deflections under loads that balance the inertia of its rigid-body
/// modes $R$, and themselves have none of these,
///
/// $$ (I - R R^t M) K_g^{-1} (I - M R R^t) . $$
///
/// $K_g$ is the stiffness with one spring to the ground for every rigid-body mode. Balanced loads put no force into these springs, so
/// that their stiffness does not matter, and no shift takes digits from the frequencies.
#[derive(Debug)]
pub(super) struct Flexibility {
    factor: Factor,
    /// $R$, of unit generalized mass, with $M R$ (rows × r).
    pub(super) rigid: Directions,
}

impl Flexibility {
    pub(super) fn of(
        plan: &Arc<FactorizationPlan>,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        RigidBodies { rows, .. }: &RigidBodies,
    ) -> Result<Self, Error> {
        let diagonal = stiffness.diagonal();
        let spring = |row: usize| {
            if diagonal[row] > 0.0 {
                diagonal[row]
            } else {
                1.0
            }
        };
        let springs = rows.iter().map(|&row| (row, row, spring(row))).collect();
        let springs = SparseMatrix::new("springs", mass.rows(), mass.rows(), springs)?;
        let what = "stiffness";
        let factor =
            Factor::of_sum(plan, what, &[(1.0, stiffness), (1.0, &springs)])?.check_signs(what)?;
        if rows.is_empty() {
            let rigid = Directions::none(mass.rows());
            return Ok(Self { factor, rigid });
        }
        // With one of its springs displaced by one, the structure moves by motions that nothing resists.
        let mut loads = DMatrix::zeros(mass.rows(), rows.len());
        for (at, &row) in rows.iter().enumerate() {
            loads[(row, at)] = spring(row);
        }
        let motions = factor.solve(&loads)?;
        let gram = symmetric_part(&motions.tr_mul(&mass.times(&motions)?));
        let size = gram
            .diagonal()
            .map(|mass| mass.max(f64::MIN_POSITIVE).sqrt());
        let unit = gram.component_div(&(&size * size.transpose()));
        let what = "mass of rigid-body motions";
        let lower = cholesky(what, &unit, GIVEN).map_err(|error| match error {
            Error::NotPositiveDefinite { what, row } => Error::NotPositiveDefinite {
                what,
                row: rows[row],
            },
            other => other,
        })?;
        let scaled = DMatrix::from_diagonal(&size.map(f64::recip)) * motions.transpose();
        let shapes = solve_lower(&lower, scaled).transpose();
        let weighted = mass.times(&shapes)?;
        let rigid = Directions { shapes, weighted };
        Ok(Self { factor, rigid })
    }

    /// Loads (rows × m) with the inertia of the rigid-body modes that balances them, what the stiffness makes of the deflections under them.
    pub(super) fn balanced(&self, mut loads: DMatrix<f64>) -> DMatrix<f64> {
        let Directions { shapes, weighted } = &self.rigid;
        if self.rigid.len() > 0 {
            let shares = transposed_product(shapes, &loads);
            take_product(&mut loads, weighted, &shares);
        }
        loads
    }

    /// Deflections under loads (rows × m).
    pub(super) fn solve(&self, loads: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        if self.rigid.len() == 0 {
            return self.factor.solve(loads);
        }
        let mut deflections = self.factor.solve(&self.balanced(loads.clone()))?;
        // One pass leaves the round-off of what it takes away; a second one is enough.
        for _ in 0..2 {
            self.rigid.take_from(&mut deflections);
        }
        Ok(deflections)
    }
}

/// The `wanted` largest roots, or all if there are fewer or all are as easily found. `solutions` counts the right-hand sides.
fn largest(
    flexibility: &Flexibility,
    mass: &SparseMatrix,
    near: Option<&DMatrix<f64>>,
    (exact, wanted, block): (usize, usize, usize),
    solutions: &mut usize,
) -> Result<Found, Error> {
    let keep = wanted + block;
    let most = keep + keep.max(8 * block);
    let mut solve = |loads: &DMatrix<f64>| {
        *solutions += loads.ncols();
        flexibility.solve(loads)
    };
    if mass.rows() <= most.max(MOST_DENSE_ROWS) {
        all(&mut solve, flexibility.rigid.len(), mass)
    } else {
        subspace(
            &mut solve,
            (&flexibility.rigid, mass),
            near,
            Wanted { exact, wanted },
            Growth { block, keep, most },
        )
    }
}

/// All roots: with $M = F F^t$ they are those of $F^t K^{-1} F y = \mu y$, and $v = K^{-1} F y$.
fn all(solve: Solve, rigid: usize, mass: &SparseMatrix) -> Result<Found, Error> {
    let f = root(mass)?;
    let deflections = solve(&f)?;
    let small = symmetric_part(&f.tr_mul(&deflections));
    let (roots, vectors) = symmetric_eigen("flexibility weighted by the mass", &small)?;
    let smallest = SMALLEST_ROOT * roots.max();
    // Rigid-body modes have the lowest roots: zero but for round-off.
    let kept = places_above(&roots, smallest).into_iter().rev();
    let kept: Vec<usize> = kept.filter(|&at| at >= rigid).collect();
    Ok(Found {
        roots: roots.select_rows(&kept),
        is_all: kept.len() + rigid == f.ncols(),
        shapes: deflections * vectors.select_columns(&kept),
        forces: f * vectors.select_columns(&kept),
    })
}

/// $F$ (rows × rank) of a semidefinite $M = F F^t$ by the eigenvectors of the matrix scaled to unit diagonal, so that a mass may be as
/// small as it likes beside others; what is negative, or none, is within the rounding of its entries.
fn root(mass: &SparseMatrix) -> Result<DMatrix<f64>, Error> {
    let dense = mass.dense();
    let scale = SparseMatrix::unit_scale(&dense.diagonal());
    let unit = dense.component_div(&(&scale * scale.transpose()));
    let (sizes, vectors) = symmetric_eigen("mass", &unit)?;
    // No eigenvalue moves by more than the largest sum of a row of the roundings.
    let squares = scale.component_mul(&scale);
    let rounded = slack(mass, &scale).component_div(&squares).max();
    if sizes[0] < -rounded.max(GIVEN) {
        let (what, row) = ("mass", vectors.column(0).iamax());
        return Err(Error::NotPositiveDefinite { what, row });
    }
    let own = places_above(&sizes, rounded.max(GIVEN));
    let sizes = DMatrix::from_diagonal(&sizes.select_rows(&own).map(f64::sqrt));
    Ok(DMatrix::from_diagonal(&scale) * vectors.select_columns(&own) * sizes)
}

/// Squared frequencies and shapes of unit generalized mass. Each shape is made orthogonal to those before it, which removes the
/// round-off of lower modes from it. Frequencies are Rayleigh's quotients $v^t K v$ from the forces $K v$.
fn frequencies(mass: &SparseMatrix, found: Found) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
    let unit = found.shapes.column_iter().map(|shape| 1.0 / shape.amax());
    let unit = DMatrix::from_diagonal(&DVector::from_iterator(found.roots.len(), unit));
    let (shapes, forces) = (found.shapes * &unit, found.forces * unit);
    let gram = symmetric_part(&transposed_product(&shapes, &mass.times(&shapes)?));
    let lower = cholesky("generalized mass", &gram, 0.0)?;
    let orthogonal = |columns: DMatrix<f64>| solve_lower(&lower, columns.transpose()).transpose();
    let (shapes, forces) = (orthogonal(shapes), orthogonal(forces));
    let quotient = |mode: usize| shapes.column(mode).dot(&forces.column(mode)).max(0.0);
    let count = shapes.ncols();
    let squares = DMatrix::from_fn(count, 1, |mode, _| quotient(mode));
    check_finite("squared frequencies", &squares)?;
    Ok((squares.column(0).into_owned(), shapes))
}

/// A bound at the first place above the `needed` vibrations where two are apart, the number of modes that the inertia counts below
/// it, and the number of vibrations found there.
fn numbers(
    factor: At,
    omega_squared: &DVector<f64>,
    needed: usize,
    is_all: bool,
) -> Result<(f64, usize, usize), Error> {
    let last = omega_squared.len();
    let gap = |place: &usize| {
        omega_squared[*place] - omega_squared[place - 1] > APART * omega_squared[*place]
    };
    let found = (needed..last).find(gap).unwrap_or(last);
    let next = match is_all {
        _ if found < last => omega_squared[found],
        true => 3.0 * omega_squared[last - 1],
        false => JUST_ABOVE * omega_squared[last - 1],
    };
    let bound = |part: f64| omega_squared[found - 1] + part * (next - omega_squared[found - 1]);
    let factor_at = |bound: f64| {
        factor("pencil at a bound on its frequencies", -bound).map(|factor| (bound, factor))
    };
    // This factorization exchanges no rows: at one bound a part of the structure may vibrate by itself, and at another none does.
    let (bound, factor) = factor_at(bound(0.5))
        .or_else(|_| factor_at(bound(0.4)))
        .or_else(|_| factor_at(bound(0.6)))?;
    Ok((bound, factor.negative_count(), found))
}
