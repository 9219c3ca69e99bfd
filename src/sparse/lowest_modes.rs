//! The lowest modes of a sparse pencil, none of them missed.

use super::{Factor, SparseMatrix};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::{ModeSet, check_count};
use crate::sparse::free_modes::{CountedModes, counted_modes};
use crate::sparse::random::split_mix_64;
use nalgebra::{DMatrix, DVector};

/// Most rows of a pencil that is solved as dense matrices.
pub const MOST_DENSE_ROWS: usize = 150;
/// What there are too few of when more modes are asked for than have a frequency.
pub const FINITE: &str = "modes of finite frequency";
/// Directions that are added to the subspace at once: as many repeated roots are found together.
const BLOCK: usize = 8;
/// Modes found beyond those asked for, so that the count can be made where two neighbors are apart.
const BEYOND: usize = 4;
/// Most restarts of the subspace.
const RESTARTS: usize = 200;
/// Residual of a mode relative to its root at which it counts as found, and that of the estimate which only places a shift.
const FOUND: f64 = 1e-10;
const ESTIMATED: f64 = 0.1;
/// Pivot of the unit-diagonal stiffness below which it is shifted; a shift does no harm where none is needed.
const SMALLEST_PIVOT: f64 = 1e-10;
/// Squared frequency relative to the shift below which a motion is a rigid-body mode.
const RIGID: f64 = 1e-6;
/// Distance of two neighbors relative to the higher between which modes can be counted.
const APART: f64 = 1e-5;

/// The `count` lowest vibrations of $K v = \omega^2 M v$ for semidefinite `stiffness` (lbf/in) and `mass` (lbf·s²/in), with all
/// rigid-body modes.
///
/// A block of directions $X$ is multiplied by $A = (K + \sigma M)^{-1} M$ again and again, each new one made orthogonal to those
/// before it in $M$; in the subspace that they span the modes are those of a small matrix, and the best of them begin the next
/// subspace. The shift $\sigma$ is zero unless the structure hangs free. A factorization of $K - b M$ with $b$ just above the modes
/// found must have as many negative pivots as there are modes below. Pencils of [`MOST_DENSE_ROWS`] go through [`counted_modes`].
///
/// # Errors
/// [`Error::Empty`] or [`Error::TooMany`] for a bad `count`; [`Error::NotPositiveDefinite`] for a motion that has neither stiffness
/// nor mass; [`Error::Miscounted`]; [`Error::NoConvergence`]; those of [`SparseMatrix::check_symmetric`].
///
/// Source: Bathe, *Finite Element Procedures* (1996), sections 11.2 and 11.6; Parlett, *The Symmetric Eigenvalue Problem* (1980),
/// chapters 3 and 13.
pub fn lowest_modes(
    stiffness: &SparseMatrix,
    mass: &SparseMatrix,
    count: usize,
) -> Result<CountedModes, Error> {
    stiffness.check_symmetric("stiffness")?;
    mass.check_symmetric("mass")?;
    check_count("modes", count, stiffness.rows())?;
    if stiffness.rows() <= MOST_DENSE_ROWS {
        let all = counted_modes(&stiffness.dense(), &mass.dense())?;
        check_count(FINITE, count, all.vibrations.len())?;
        return Ok(CountedModes {
            vibrations: CountedModes::of(&all.vibrations, 0, count).vibrations,
            ..all
        });
    }
    let factor_at = factors(stiffness, mass)?;
    let (factor, shift) = shifted(&factor_at, stiffness, mass)?;
    let mut wanted = count + BEYOND;
    loop {
        let (_, shapes, is_all) = subspace(&factor, mass, wanted, FOUND)?;
        let omega_squared = squared_frequencies(stiffness, &shapes)?;
        let rigid = omega_squared
            .iter()
            .take_while(|value| **value < RIGID * shift)
            .count();
        if shapes.ncols() == wanted && wanted < count + rigid + BEYOND {
            wanted = count + rigid + BEYOND;
            continue;
        }
        check_count(FINITE, count, omega_squared.len() - rigid)?;
        check_number(&factor_at, &omega_squared, rigid + count, is_all)?;
        return Ok(CountedModes::of(
            &ModeSet {
                omega_squared,
                shapes,
            },
            rigid,
            count,
        ));
    }
}

/// Factors of $K + \sigma M$ by one plan.
fn factors<'a>(
    stiffness: &'a SparseMatrix,
    mass: &'a SparseMatrix,
) -> Result<impl Fn(&'static str, f64) -> Result<Factor, Error>, Error> {
    let plan = Factor::plan(&[stiffness, mass])?;
    Ok(move |what, shift| Factor::planned(&plan, what, &[(1.0, stiffness), (shift, mass)]))
}

/// The factor of $K + \sigma M$, named, for $\sigma$.
type At<'a> = &'a dyn Fn(&'static str, f64) -> Result<Factor, Error>;

/// The factor of $K + \sigma M$ and $\sigma$: zero for a structure on supports, else the size of the lower squared frequencies.
fn shifted(
    factor: At,
    stiffness: &SparseMatrix,
    mass: &SparseMatrix,
) -> Result<(Factor, f64), Error> {
    if let Ok(factor) = factor("stiffness", 0.0)
        && factor.smallest_pivot().0 > SMALLEST_PIVOT
    {
        return Ok((factor, 0.0));
    }
    let what = "stiffness shifted by the mass";
    let factor_at = |shift: f64| factor(what, shift)?.check_positive(what);
    let first = 1e-4 * stiffness.trace().max(f64::MIN_POSITIVE) / mass.trace();
    let (roots, ..) = subspace(&factor_at(first)?, mass, BLOCK, ESTIMATED)?;
    let highest = roots
        .iter()
        .map(|root| 1.0 / root - first)
        .fold(1e-4 * first, f64::max);
    Ok((factor_at(highest)?, highest))
}

/// Roots, shapes, and whether there are no others.
type Found = (Vec<f64>, DMatrix<f64>, bool);

/// The `wanted` largest roots of $A = (K + \sigma M)^{-1} M$, or all if there are fewer, descending, with their shapes (rows × m) of
/// unit generalized mass.
fn subspace(
    factor: &Factor,
    mass: &SparseMatrix,
    wanted: usize,
    tolerance: f64,
) -> Result<Found, Error> {
    let times = |block: &DMatrix<f64>| factor.solve(&mass.times(block)?);
    let keep = wanted + BLOCK;
    let most = keep + keep.max(4 * BLOCK);
    let (mut basis, mut images) = (
        DMatrix::zeros(mass.rows(), 0),
        DMatrix::zeros(mass.rows(), 0),
    );
    let mut state = 0;
    let random = DMatrix::from_fn(mass.rows(), BLOCK, |_, _| {
        split_mix_64(&mut state) as f64 / u64::MAX as f64 - 0.5
    });
    let mut next = orthonormal(mass, &basis, times(&random)?)?;
    for _ in 0..RESTARTS {
        while next.ncols() > 0 && basis.ncols() < most {
            let image = times(&next)?;
            basis.extend(next.column_iter());
            images.extend(image.column_iter());
            next = orthonormal(mass, &basis, image)?;
        }
        let is_all = next.ncols() == 0;
        let small = symmetric_part(&basis.tr_mul(&mass.times(&images)?));
        let (values, vectors) = symmetric_eigen("subspace", &small)?;
        let largest: Vec<usize> = (0..values.len()).rev().take(keep).collect();
        let (roots, vectors) = (
            values.select_rows(&largest),
            vectors.select_columns(&largest),
        );
        (basis, images) = (&basis * &vectors, images * vectors);
        let residuals = &images - &basis * DMatrix::from_diagonal(&roots);
        let weighted = mass.times(&residuals)?;
        let is_found = |mode: usize| {
            let residual = residuals
                .column(mode)
                .dot(&weighted.column(mode))
                .max(0.0)
                .sqrt();
            residual <= tolerance * roots[mode] + 100.0 * f64::EPSILON * roots[0]
        };
        let count = wanted.min(roots.len());
        if is_all || (0..count).all(is_found) {
            // The image has the massless motions right too.
            let mut shapes = images.columns(0, count).into_owned();
            shapes
                .column_iter_mut()
                .zip(&roots)
                .for_each(|(mut shape, root)| shape /= *root);
            return Ok((roots.iter().take(count).copied().collect(), shapes, is_all));
        }
        let open: Vec<usize> = (0..roots.len())
            .filter(|&mode| !is_found(mode))
            .take(BLOCK)
            .collect();
        next = orthonormal(mass, &basis, residuals.select_columns(&open))?;
    }
    Err(Error::NoConvergence("modes of a sparse pencil"))
}

/// The columns of `block` made orthonormal in the mass, to `basis` and to each other; those that are combinations are left out.
fn orthonormal(
    mass: &SparseMatrix,
    basis: &DMatrix<f64>,
    mut block: DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    // Once leaves the round-off of what was taken away, twice is enough.
    for round in 0..3 {
        if round > 0 {
            let shares = basis.tr_mul(&mass.times(&block)?);
            block -= basis * shares;
        }
        let gram = symmetric_part(&block.tr_mul(&mass.times(&block)?));
        // The first time each column is brought to unit size alone.
        let gram = if round == 0 {
            DMatrix::from_diagonal(&gram.diagonal())
        } else {
            gram
        };
        let (values, vectors) = symmetric_eigen("block", &gram)?;
        // Round-off is relative to the largest: of as few masses as there are columns, some are combinations of the others.
        let least = if round == 0 {
            0.0
        } else {
            (1e-14 * values[values.len() - 1]).max(1e-20)
        };
        let independent: Vec<usize> = (0..values.len())
            .filter(|&column| values[column] > least)
            .collect();
        if independent.is_empty() {
            return Ok(DMatrix::zeros(mass.rows(), 0));
        }
        let scale = values
            .select_rows(&independent)
            .map(|value| 1.0 / value.sqrt());
        block *= vectors.select_columns(&independent) * DMatrix::from_diagonal(&scale);
    }
    Ok(block)
}

/// Rayleigh's quotient of every shape of unit generalized mass, which a shift has taken no digits from.
fn squared_frequencies(
    stiffness: &SparseMatrix,
    shapes: &DMatrix<f64>,
) -> Result<DVector<f64>, Error> {
    let forces = stiffness.times(shapes)?;
    Ok(DVector::from_fn(shapes.ncols(), |mode, _| {
        shapes.column(mode).dot(&forces.column(mode)).max(0.0)
    }))
}

/// Refuses modes whose number differs from the count by inertia at the first place above the `needed` ones where two are apart.
fn check_number(
    factor: At,
    omega_squared: &DVector<f64>,
    needed: usize,
    is_all: bool,
) -> Result<(), Error> {
    let last = omega_squared.len();
    let gap = |place: &usize| {
        omega_squared[*place] - omega_squared[place - 1] > APART * omega_squared[*place]
    };
    let found = (needed..last).find(gap).unwrap_or(last);
    let next = match found {
        _ if found < last => omega_squared[found],
        _ if is_all => 3.0 * omega_squared[last - 1],
        // Neighbors so close that none of them can be left out: the bound stands just above the last.
        _ => (1.0 + 2.0 * APART) * omega_squared[last - 1],
    };
    let bound = |part: f64| omega_squared[found - 1] + part * (next - omega_squared[found - 1]);
    let factor_at = |bound: f64| {
        factor("pencil at a bound on its frequencies", -bound).map(|factor| (bound, factor))
    };
    // Nothing is exchanged in this factorization: at one place a part of the structure may vibrate by itself, and no other at another.
    let (bound, factor) = factor_at(bound(0.5)).or_else(|_| factor_at(bound(0.4)))?;
    let counted = factor.negative_count();
    if counted == found {
        Ok(())
    } else {
        Err(Error::Miscounted {
            bound,
            counted,
            found,
        })
    }
}
