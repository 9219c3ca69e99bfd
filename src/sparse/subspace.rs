//! The largest roots of $K^{-1} M$ in subspaces that are far smaller than the structure.

use super::checks::independent;
use super::random::random_block;
use super::{SparseMatrix, take_product, transposed_product};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use nalgebra::{DMatrix, DVector};

/// Convergence checks per restart.
const LOOKS: usize = 4;
/// Most convergence checks in all: some two hundred subspaces.
const MOST_LOOKS: usize = 800;
/// Residual of a mode relative to its root at which it counts as found.
const FOUND: f64 = 1e-10;
/// Residual, relative to its root, at which a mode beyond those asked for counts as found: no root errs by more, a hundredth of the
/// distance at which modes count as apart.
const NEARLY: f64 = 1e-7;
/// Square of the part of a direction that counts as nothing new: what it leaves out of a residual is as small as a mode's may be.
const NOTHING: f64 = FOUND * FOUND;
/// Residual, relative to its root, that the round-off of a softer mode excuses at most: a root errs by the square of it.
const ROUNDED: f64 = 1e-5;

/// The largest roots of $K^{-1} M$, descending, their shapes (rows × m), the forces $K v$ that these were found from, and whether there
/// are no others.
pub(super) struct Found {
    pub(super) roots: DVector<f64>,
    pub(super) shapes: DMatrix<f64>,
    pub(super) forces: DMatrix<f64>,
    pub(super) is_all: bool,
}

/// Shapes that are orthonormal in the mass, and their products with it (rows × m).
#[derive(Debug, Clone)]
pub(super) struct Directions {
    pub(super) shapes: DMatrix<f64>,
    pub(super) weighted: DMatrix<f64>,
}

impl Directions {
    pub(super) fn none(rows: usize) -> Self {
        let none = DMatrix::zeros(rows, 0);
        Self {
            shapes: none.clone(),
            weighted: none,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.shapes.ncols()
    }

    /// Subtracts from every column its part in these shapes, and returns the parts (m × columns).
    pub(super) fn take_from(&self, block: &mut DMatrix<f64>) -> DMatrix<f64> {
        let shares = transposed_product(&self.weighted, block);
        take_product(block, &self.shapes, &shares);
        shares
    }

    fn extend(&mut self, next: &Self) {
        for (all, next) in [
            (&mut self.shapes, &next.shapes),
            (&mut self.weighted, &next.weighted),
        ] {
            let before = all.ncols();
            all.resize_horizontally_mut(before + next.ncols(), 0.0);
            all.columns_mut(before, next.ncols()).copy_from(next);
        }
    }

    fn combined(&self, vectors: &DMatrix<f64>) -> Self {
        Self {
            shapes: &self.shapes * vectors,
            weighted: &self.weighted * vectors,
        }
    }

    /// New directions $Q$ in the columns of `block` beside these, $V$: with $S$ and $R$ in
    ///
    /// $$ W = V S + Q R . $$
    ///
    /// Columns that are combinations of others are left out.
    fn split(&self, mass: &SparseMatrix, mut block: DMatrix<f64>) -> Result<Split, Error> {
        let weights = mass.times(&block)?;
        let squares = block.column_iter().zip(weights.column_iter());
        let squares = squares.map(|(column, weighted)| column.dot(&weighted));
        let size = SparseMatrix::unit_scale(&DVector::from_iterator(block.ncols(), squares));
        let scaled = |block: &mut DMatrix<f64>, scale: fn(f64) -> f64| {
            let columns = block.column_iter_mut().zip(&size);
            columns.for_each(|(mut column, &size)| column *= scale(size));
        };
        scaled(&mut block, f64::recip);
        let mut shares = self.take_from(&mut block);
        scaled(&mut shares, |size| size);
        let mut rest = block.clone();
        scaled(&mut rest, |size| size);
        let next = orthonormal(mass, block)?;
        // One pass leaves the round-off of what it takes away; a second one is enough.
        let mut block = next.shapes;
        self.take_from(&mut block);
        let next = orthonormal(mass, block)?;
        let rest = transposed_product(&next.weighted, &rest);
        Ok(Split { next, shares, rest })
    }
}

/// The deflections under loads.
pub(super) type Solve<'a> = &'a mut dyn FnMut(&DMatrix<f64>) -> Result<DMatrix<f64>, Error>;

/// $Q$, $S$ and $R$ of a block.
struct Split {
    next: Directions,
    shares: DMatrix<f64>,
    rest: DMatrix<f64>,
}

/// The columns of a block made orthonormal in the mass to each other; those that are combinations are left out.
fn orthonormal(mass: &SparseMatrix, block: DMatrix<f64>) -> Result<Directions, Error> {
    let weighted = mass.times(&block)?;
    if block.is_empty() {
        return Ok(Directions {
            shapes: block,
            weighted,
        });
    }
    // Columns of unit size are judged: what is left of one that was found before is small beside the others, and counts as much. Of as few
    // masses as there are columns, some are combinations of the others.
    let gram = transposed_product(&block, &weighted);
    let size = gram.diagonal();
    let size = size.map(|square| {
        if square > NOTHING {
            square.sqrt().recip()
        } else {
            0.0
        }
    });
    let unit = gram.component_mul(&(&size * size.transpose()));
    let (_, vectors) = independent("block", &unit, |largest| 1e-14 * largest)?;
    let vectors = DMatrix::from_diagonal(&size) * vectors;
    Ok(Directions {
        shapes: block,
        weighted,
    }
    .combined(&vectors))
}

/// Numbers of the largest roots that are wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// Number of them that are wanted to round-off.
    pub(super) exact: usize,
    /// Number of all, the others nearly right.
    pub(super) wanted: usize,
}

/// Sizes of a subspace, in directions.
#[derive(Clone, Copy)]
pub(super) struct Growth {
    /// Number added at a time.
    pub(super) block: usize,
    /// Number of the best, with which the next begins.
    pub(super) keep: usize,
    /// Most it may have.
    pub(super) most: usize,
}

/// The largest roots and their shapes. `solve` is $K^{-1}$ beside the `rigid` bodies. The first directions are combinations of the
/// shapes `near`, if there are any.
///
/// With the directions $V$ found so far and the next $Q$, every block gives the next columns of $H$ in
///
/// $$ K^{-1} M V = V H + Q R . $$
///
/// For a root $\mu$ and vector $y$ of $H$, the shape $V y$ leaves the residual $Q R y$, whose size needs no product with the structure's
/// matrices. A subspace that is full begins anew with its best shapes, for which this equation holds with their roots as $H$.
///
/// Source: Wu and Simon, *Thick-Restart Lanczos Method for Large Symmetric Eigenvalue Problems*, SIAM J. Matrix Anal. Appl. 22 (2000).
pub(super) fn subspace(
    solve: Solve,
    (rigid, mass): (&Directions, &SparseMatrix),
    near: Option<&DMatrix<f64>>,
    Wanted { exact, wanted }: Wanted,
    Growth { block, keep, most }: Growth,
) -> Result<Found, Error> {
    let rows = mass.rows();
    let mut state = 0;
    let mut fresh = |basis: &Directions, solve: Solve| {
        let random = random_block(rows, block, &mut state);
        let random = rigid.split(mass, random)?.next.shapes;
        let random = basis.split(mass, random)?.next;
        if random.len() == 0 {
            return Ok(random);
        }
        Ok(basis.split(mass, solve(&random.weighted)?)?.next)
    };
    let mut basis = Directions::none(rows);
    let mut small = DMatrix::zeros(0, 0);
    let mut next = match near {
        Some(near) => {
            let mixed = near * random_block(near.ncols(), block, &mut 0);
            rigid.split(mass, mixed)?.next
        }
        None => fresh(&basis, solve)?,
    };
    let mut goal = most;
    for _ in 0..MOST_LOOKS {
        let mut rest = DMatrix::zeros(0, 0);
        while next.len() > 0 && basis.len() < goal {
            let (begin, image) = (basis.len(), solve(&next.weighted)?);
            basis.extend(&next);
            let split = basis.split(mass, image)?;
            small.resize_mut(basis.len(), basis.len(), 0.0);
            small
                .columns_mut(begin, next.len())
                .copy_from(&split.shares);
            small
                .rows_mut(begin, next.len())
                .copy_from(&split.shares.transpose());
            (next, rest) = (split.next, split.rest);
            if next.len() == 0 {
                // The subspace of this block is complete; its roots may have other copies outside.
                next = fresh(&basis, solve)?;
                rest = DMatrix::zeros(next.len(), rest.ncols());
            }
        }
        let (values, vectors) = symmetric_eigen("subspace", &symmetric_part(&small))?;
        let largest: Vec<usize> = (0..values.len()).rev().take(keep).collect();
        let roots = values.select_rows(&largest);
        let vectors = vectors.select_columns(&largest);
        let residuals = &rest * vectors.rows(basis.len() - rest.ncols(), rest.ncols());
        let is_found = |mode: usize| {
            let round_off = 100.0 * f64::EPSILON * roots[0];
            let found = if mode < exact { FOUND } else { NEARLY };
            residuals.column(mode).norm()
                <= found * roots[mode] + round_off.min(ROUNDED * roots[mode])
        };
        let is_whole = next.len() == 0;
        let is_all = is_whole && values.len() <= keep;
        let count = if is_all { values.len() } else { wanted };
        if is_whole || (0..count).all(is_found) {
            let best = basis.combined(&vectors.columns(0, count).into_owned());
            // Once more through the flexibility, so that massless motions are right too.
            return Ok(Found {
                roots: roots.rows(0, count).into_owned(),
                shapes: solve(&best.weighted)?,
                forces: best.weighted,
                is_all,
            });
        }
        if basis.len() >= most {
            basis = basis.combined(&vectors);
            small = DMatrix::from_diagonal(&roots);
        }
        goal = most.min(basis.len() + (most - keep).div_ceil(LOOKS));
    }
    Err(Error::no_convergence("modes of a sparse pencil"))
}
