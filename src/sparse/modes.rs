//! The lowest modes of a sparse pencil, none of them missed: of structures on supports and of those that hang free, as an aircraft in
//! its test, and where degrees of freedom have no mass. Zero and infinite eigenvalues are neither lost nor counted as vibrations.

use super::checks::independent;
use super::free::slack;
use super::matrix::GIVEN;
use super::random::random_block;
use super::{
    Factor, RigidBodies, SparseMatrix, places_above, solve_lower, take_product, transposed_product,
};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{check_finite, cholesky, symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::sparse::factorization::FactorizationPlan;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// Most rows of a pencil whose modes are all found at once: a full decomposition of that order takes a few milliseconds.
pub const MOST_DENSE_ROWS: usize = 150;
/// Name, in errors, of modes with a finite frequency.
pub const FINITE: &str = "modes of finite frequency";
/// Directions that are added to the subspace at once, unless a root is repeated more often.
const BLOCK: usize = 8;
/// Extra modes sought, so that two neighbors are found between which counting is safe.
const BEYOND: usize = 4;
/// Residual of a mode relative to its root at which it counts as found.
const FOUND: f64 = 1e-10;
/// Square of the part of a direction that counts as nothing new: what it leaves out of a residual is as small as a mode's may be.
const NOTHING: f64 = FOUND * FOUND;
/// Residual, relative to its root, that the round-off of a softer mode excuses at most: a root errs by the square of it.
const ROUNDED: f64 = 1e-5;
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
}

/// The `most` lowest vibrations of $K v = \omega^2 M v$ for semidefinite `stiffness` (lbf/in) and `mass` (lbf·s²/in), or all where they
/// are fewer, with all rigid-body modes and the flexibility that found them, which serves other loads too.
///
/// They have the largest roots $\mu$ of
///
/// $$ K^{-1} M v = \mu v, \qquad \omega^2 = \frac{1}{\mu} . $$
///
/// The rigid-body modes of a structure that hangs free (`bodies`) are known first, and the vibrations are sought among the motions
/// orthogonal to them in $M$, where the inverse exists. A factorization of $K - b M$ with $b$ just above the modes found must have as many
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
    most: usize,
    mut near: Option<&DMatrix<f64>>,
    bodies: &RigidBodies,
    plan: &Arc<FactorizationPlan>,
) -> Result<(CountedModes, Flexibility), Error> {
    let count = most.min(stiffness.rows());
    at_least_one("modes", count)?;
    at_least_one("degrees of freedom with mass", mass.entries().len())?;
    plan.count_eigensolution();
    let flexibility = Flexibility::of(plan, stiffness, mass, bodies)?;
    let rigid = &flexibility.rigid;
    let (mut wanted, mut block) = (count + BEYOND, BLOCK);
    loop {
        let (all, is_all) = flexibility.lowest(mass, near, wanted, block)?;
        let squares = all.omega_squared.as_slice();
        let needed = squares.len().min(count);
        if needed > 0 {
            let gap = |at: &usize| squares[*at] - squares[at - 1] > APART * squares[*at];
            let found = (needed..squares.len()).find(gap).unwrap_or(squares.len());
            let last = squares[found - 1];
            let next = match squares.get(found) {
                Some(next) => *next,
                None if is_all => 3.0 * last,
                None => JUST_ABOVE * last,
            };
            // This factorization exchanges no rows: at one bound a part of the structure may vibrate by itself, and at another none does.
            let what = "pencil at a bound on its frequencies";
            let below = |part: f64| -> Result<(f64, usize), Error> {
                let bound = last + part * (next - last);
                let factor = Factor::of_sum(plan, what, &[(1.0, stiffness), (-bound, mass)])?;
                Ok((bound, factor.negative_count()))
            };
            let counted = below(0.5).or_else(|_| below(0.4));
            let (bound, counted) = counted.or_else(|_| below(0.6))?;
            let found = rigid.len() + found;
            if counted != found {
                // A block as wide as all modes below the bound holds every copy of a repeated root, if all are wanted.
                if near.take().is_none() {
                    if block.min(wanted) >= counted {
                        let why = format!(
                            "{found} were found below {bound:.6e} rad^2/s^2, but the shifted pencil's inertia counts {counted}"
                        );
                        return Err(Error::Failed { what: "modes", why });
                    }
                    (wanted, block) = (counted + BEYOND, block.max(counted));
                }
                continue;
            }
        }
        let found = CountedModes {
            next: squares.get(needed).copied(),
            rigid_body: rigid.shapes.clone(),
            vibrations: all.select(&(0..needed).collect::<Vec<_>>()),
        };
        return Ok((found, flexibility));
    }
}

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
    rigid: Directions,
}

impl Flexibility {
    pub(super) fn of(
        plan: &Arc<FactorizationPlan>,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        RigidBodies { rows, .. }: &RigidBodies,
    ) -> Result<Self, Error> {
        let (count, what) = (mass.rows(), "stiffness");
        let sizes = SparseMatrix::unit_scale(&stiffness.diagonal());
        let spring = |&row: &usize| (row, row, sizes[row].powi(2));
        let springs =
            SparseMatrix::new("springs", count, count, rows.iter().map(spring).collect())?;
        let factor =
            Factor::of_sum(plan, what, &[(1.0, stiffness), (1.0, &springs)])?.check_signs(what)?;
        let mut rigid = Directions::none(count);
        if !rows.is_empty() {
            // With one of its springs displaced by one, the structure moves by motions that nothing resists.
            let mut loads = DMatrix::zeros(count, rows.len());
            for (at, row) in rows.iter().enumerate() {
                loads[(*row, at)] = spring(row).2;
            }
            let motions = factor.solve(&loads)?;
            let what = "mass of rigid-body motions";
            let weighted = mass.times(&motions)?;
            let own = orthogonal(what, mass, [motions, weighted]).map_err(|error| match error {
                Error::NotPositiveDefinite { what, row } => Error::NotPositiveDefinite {
                    what,
                    row: rows[row],
                },
                other => other,
            });
            let [shapes, weighted] = own?;
            rigid = Directions { shapes, weighted };
        }
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

    /// All vibrations, and whether none is lost: with $M = F F^t$ their roots are those of $F^t K^{-1} F y = \mu y$, and $v = K^{-1} F y$.
    fn all(&self, mass: &SparseMatrix) -> Result<(Modes, bool), Error> {
        let f = root(mass)?;
        let deflections = self.solve(&f)?;
        let small = symmetric_part(&f.tr_mul(&deflections));
        let (roots, vectors) = symmetric_eigen("flexibility weighted by the mass", &small)?;
        // Rigid-body modes have the lowest roots: zero but for round-off.
        let most = roots.len().saturating_sub(self.rigid.len());
        let kept = largest(&roots, most);
        let vectors = vectors.select_columns(&kept);
        let modes = frequencies(mass, deflections * &vectors, f * vectors)?;
        Ok((modes, kept.len() == most))
    }

    /// The `wanted` lowest vibrations of unit generalized mass, or all if there are fewer, and whether there are no others. The first
    /// directions are `block` combinations of the shapes `near`, if there are any.
    ///
    /// With the directions $V$ found so far, which are orthonormal in the mass, and the next $Q$, every block gives the next columns of $H$ in
    ///
    /// $$ K^{-1} M V = V H + Q R . $$
    ///
    /// For a root $\mu$ and vector $y$ of $H$, the shape $V y$ leaves the residual $Q R y$, whose size needs no product with the structure's
    /// matrices. Pencils of [`MOST_DENSE_ROWS`], and those of which the subspace would be the whole, have all their modes found at once.
    fn lowest(
        &self,
        mass: &SparseMatrix,
        near: Option<&DMatrix<f64>>,
        wanted: usize,
        block: usize,
    ) -> Result<(Modes, bool), Error> {
        let rows = mass.rows();
        if rows <= MOST_DENSE_ROWS.max(2 * (wanted + 5 * block)) {
            return self.all(mass);
        }
        let mut basis = Directions::none(rows);
        let mut small = DMatrix::zeros(0, 0);
        let mut state = 0;
        let mut fresh = |basis: &Directions| {
            let mut random = random_block(rows, block, &mut state);
            basis.take_from(&mut random);
            Ok(basis.split(mass, self.solve(&mass.times(&random)?)?)?.0)
        };
        let mut next = match near {
            Some(near) => {
                let mut mixed = near * random_block(near.ncols(), block, &mut 0);
                self.rigid.take_from(&mut mixed);
                basis.split(mass, mixed)?.0
            }
            None => fresh(&basis)?,
        };
        let mut look = wanted;
        loop {
            let (begin, width) = (basis.len(), next.len());
            let image = self.solve(&next.weighted)?;
            basis.extend(&next);
            let (shares, mut rest);
            (next, shares, rest) = basis.split(mass, image)?;
            small = small.resize(basis.len(), basis.len(), 0.0);
            small.columns_mut(begin, width).copy_from(&shares);
            small.rows_mut(begin, width).tr_copy_from(&shares);
            if next.len() == 0 {
                // The subspace of this block is complete; its roots may have other copies outside.
                next = fresh(&basis)?;
                rest = DMatrix::zeros(next.len(), width);
            }
            let is_whole = next.len() == 0;
            if basis.len() < look && !is_whole {
                continue;
            }
            let (values, vectors) = symmetric_eigen("subspace", &symmetric_part(&small))?;
            let kept = largest(&values, wanted);
            let (roots, vectors) = (values.select_rows(&kept), vectors.select_columns(&kept));
            let residuals = &rest * vectors.rows(begin, width);
            let is_found = |mode: usize| {
                let round_off = (100.0 * f64::EPSILON * roots[0]).min(ROUNDED * roots[mode]);
                residuals.column(mode).norm() <= FOUND * roots[mode] + round_off
            };
            if is_whole || (0..kept.len()).all(is_found) {
                // Once more through the flexibility, so that massless motions are right too.
                let forces = &basis.weighted * vectors;
                let shapes = self.solve(&forces)?;
                let is_all = is_whole && kept.len() == values.len();
                return Ok((frequencies(mass, shapes, forces)?, is_all));
            }
            // A decomposition at every block would cost more than the blocks that one too late adds.
            look = basis.len() + basis.len() / 4;
        }
    }
}

/// Places of the largest of roots in ascending order, at most so many, those that are lost left out.
fn largest(roots: &DVector<f64>, most: usize) -> Vec<usize> {
    let all = (0..roots.len()).rev().take(most);
    all.take_while(|at| roots[*at] > SMALLEST_ROOT * roots.max())
        .collect()
}

/// Shapes that are orthonormal in the mass, and their products with it (rows × m).
#[derive(Debug, Clone)]
struct Directions {
    shapes: DMatrix<f64>,
    weighted: DMatrix<f64>,
}

impl Directions {
    fn none(rows: usize) -> Self {
        let none = DMatrix::zeros(rows, 0);
        Self {
            shapes: none.clone(),
            weighted: none,
        }
    }

    fn len(&self) -> usize {
        self.shapes.ncols()
    }

    /// Subtracts from every column its part in these shapes, and returns the parts (m × columns).
    fn take_from(&self, block: &mut DMatrix<f64>) -> DMatrix<f64> {
        let shares = transposed_product(&self.weighted, block);
        take_product(block, &self.shapes, &shares);
        shares
    }

    fn extend(&mut self, next: &Self) {
        self.shapes.extend(next.shapes.column_iter());
        self.weighted.extend(next.weighted.column_iter());
    }

    /// New directions $Q$ in the columns of a block beside these, $V$, with $S$ and $R$ in
    ///
    /// $$ W = V S + Q R . $$
    ///
    /// Columns that are combinations of others are left out.
    fn split(
        &self,
        mass: &SparseMatrix,
        mut block: DMatrix<f64>,
    ) -> Result<(Self, DMatrix<f64>, DMatrix<f64>), Error> {
        let shares = self.take_from(&mut block);
        let mut again = orthonormal(mass, &block, &shares)?.shapes;
        // One pass leaves the round-off of what it takes away; a second one is enough.
        let taken = self.take_from(&mut again);
        let next = orthonormal(mass, &again, &taken)?;
        let rest = transposed_product(&next.weighted, &block);
        Ok((next, shares, rest))
    }
}

/// The columns of a block made orthonormal in the mass to each other; those that are combinations are left out, and those of which next to
/// nothing is left beside what was `taken` from them.
fn orthonormal(
    mass: &SparseMatrix,
    block: &DMatrix<f64>,
    taken: &DMatrix<f64>,
) -> Result<Directions, Error> {
    if block.is_empty() {
        return Ok(Directions::none(block.nrows()));
    }
    let weighted = mass.times(block)?;
    // Columns of unit size are judged: what is left of one that was found before is small beside the others, and counts as much. Of as few
    // masses as there are columns, some are combinations of the others.
    let gram = transposed_product(block, &weighted);
    let unit = DVector::from_fn(gram.nrows(), |at, _| {
        match gram[(at, at)] > NOTHING * taken.column(at).norm_squared() {
            true => gram[(at, at)].sqrt().recip(),
            false => 0.0,
        }
    });
    let unit = DMatrix::from_diagonal(&unit);
    let (_, vectors) = independent("block", &(&unit * gram * &unit), |largest| 1e-14 * largest)?;
    let vectors = unit * vectors;
    Ok(Directions {
        shapes: block * &vectors,
        weighted: weighted * vectors,
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
    let rounded = slack(mass, &scale).component_div(&squares).max().max(GIVEN);
    if sizes[0] < -rounded {
        let (what, row) = ("mass", vectors.column(0).iamax());
        return Err(Error::NotPositiveDefinite { what, row });
    }
    let own = places_above(&sizes, rounded);
    let sizes = DMatrix::from_diagonal(&sizes.select_rows(&own).map(f64::sqrt));
    Ok(DMatrix::from_diagonal(&scale) * vectors.select_columns(&own) * sizes)
}

/// Shapes made orthonormal in the mass, each to those before it, and what else the same combinations are of.
fn orthogonal(
    what: &'static str,
    mass: &SparseMatrix,
    both: [DMatrix<f64>; 2],
) -> Result<[DMatrix<f64>; 2], Error> {
    let gram = transposed_product(&both[0], &mass.times(&both[0])?);
    let unit = SparseMatrix::unit_scale(&gram.diagonal()).map(f64::recip);
    let unit = DMatrix::from_diagonal(&unit);
    let lower = cholesky(what, &symmetric_part(&(&unit * gram * &unit)), GIVEN)?;
    Ok(both.map(|all| solve_lower(&lower, unit.clone() * all.transpose()).transpose()))
}

/// Squared frequencies of shapes, which are made of unit generalized mass: Rayleigh's quotients $v^t K v$ from the forces $K v$. Each shape is
/// made orthogonal to those before it, which removes the round-off of lower modes from it.
fn frequencies(
    mass: &SparseMatrix,
    shapes: DMatrix<f64>,
    forces: DMatrix<f64>,
) -> Result<Modes, Error> {
    let sizes = shapes.column_iter().map(|shape| 1.0 / shape.amax());
    let unit = DMatrix::from_diagonal(&DVector::from_iterator(shapes.ncols(), sizes));
    let both = [shapes * &unit, forces * unit];
    let [shapes, forces] = orthogonal("generalized mass", mass, both)?;
    let quotients = shapes.column_iter().zip(forces.column_iter());
    let quotients = quotients.map(|(shape, forces)| shape.dot(&forces).max(0.0));
    let omega_squared = DVector::from_iterator(shapes.ncols(), quotients);
    check_finite(
        "squared frequencies",
        &DMatrix::from_diagonal(&omega_squared),
    )?;
    Ok(Modes {
        omega_squared,
        shapes,
    })
}
