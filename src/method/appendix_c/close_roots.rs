//! Close and repeated roots: small blocks of close modes solved exactly, the rest by Recursive 1.
//! Tour: [chapter 2](crate::tour::chapter_02_recursion).
//!
//! A denominator of Recursive 1 vanishes when the change brings two roots together. Here modes whose roots are close
//! form a block. With $A = k + \beta$ and $G = k\Lambda + \alpha$ (n × n, symmetric) every order takes row $i$ of mode $j$
//! outside of its block from Recursive 1 (C.22), and the block's modes, columns of $P$, from the symmetric pencil within
//! their span:
//!
//! $$ p_{ij} = -\frac{\sum_{s \ne i}(A_{is}\gamma_j - G_{is}) p_{sj}}{A_{ii}\gamma_j - G_{ii}}, \qquad
//!    P^t (A\gamma - G) P q = 0 . $$
//!
//! With blocks of one mode that is Recursive 1 itself.

use super::general::{ModalChange, Pencil, explicit_roots, settle};
use super::recursive::check_order;
use super::{Perturbed, Settled};
use crate::method::error::{Error, setting};
use crate::method::linear_algebra::{check_finite, check_symmetric, cholesky, symmetric_part};
use crate::method::modes::{apply_sign_rule, solve};
use nalgebra::{DMatrix, DVector};

/// How [`close_roots`] tells close modes and when it stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloseRootsSettings {
    /// Two first-order roots are close when they differ by less than this fraction of the larger one, between 0 and 1.
    /// It is no fraction of the spectrum's width, which spans decades and would make one block of all high modes.
    pub separation: f64,
    /// Largest relative change of a root in two orders in a row at which the recursion stops.
    pub tolerance: f64,
    /// Most orders.
    pub orders: usize,
}

impl Default for CloseRootsSettings {
    /// Roots within 10 % (5 % in frequency) form a block; roots converged to 1e-13, 60 orders at most.
    fn default() -> Self {
        Self { separation: 0.1, tolerance: 1e-13, orders: 60 }
    }
}

/// Roots and shapes after a change, and the modes that were too close for the recursion alone.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedInBlocks {
    /// Roots and generalized shapes, each of unit generalized mass, $p_j^t G p_j = 1$, with the first of its largest
    /// components positive. Modes ascend in frequency within a block; any other mode $j$ continues mode $j$.
    pub settled: Settled,
    /// The blocks of two or more close modes, each ascending; empty when all roots were apart.
    pub blocks: Vec<Vec<usize>>,
}

/// Recursive 1 with blocks of close modes.
///
/// Both changes must be symmetric. Blocks are formed from the first-order roots $G_{ii}/A_{ii}$; each is solved alone,
/// which moves its roots, and blocks that thereby come close are joined until all are apart. Without close modes this
/// is [`super::general::recursive_1_converged`] but for the scale of the shapes.
///
/// # Errors
/// [`Error::Setting`] for a separation outside 0 to 1 or no orders; those of [`check_symmetric`] and [`cholesky`] for the
/// changes; [`Error::LostStiffness`], [`Error::LostRoot`], [`Error::UnsettledRoots`]; [`Error::CoalescingModes`] when the
/// recursion itself brings roots together that were apart.
#[doc = include_str!("../../../paper/examples/appendix_c/close_roots.md")]
pub fn close_roots(change: &ModalChange<f64>, settings: CloseRootsSettings) -> Result<SolvedInBlocks, Error> {
    let CloseRootsSettings { separation, tolerance, orders } = settings;
    check_order(orders)?;
    setting("separation", "between 0 and 1", separation, (0.0..=1.0).contains(&separation))?;
    let pencil = change.pencil()?;
    check_symmetric("generalized stiffness change", &change.beta)?;
    check_symmetric("generalized mass change", &change.alpha)?;
    cholesky("changed generalized mass", &pencil.1, 0.0)?;
    let size = change.roots.len();
    let unchanged = DMatrix::identity(size, size);
    let apart = Perturbed { roots: explicit_roots(&pencil, &unchanged)?, shapes: unchanged };
    apart.check_roots()?;
    // A block is named by its lowest mode. Each round joins two blocks at least, so there are fewer rounds than modes.
    let (mut block_of, mut alone): (Vec<usize>, _) = ((0..size).collect(), apart.clone());
    while join_close(&mut block_of, &alone.roots, separation) {
        alone = solved_in(&blocks(&block_of), &pencil, apart.clone())?;
    }
    // The modes of the blocks alone are the basis of the recursion: in it A and G are diagonal within every block.
    let in_basis = |matrix: &DMatrix<f64>| alone.shapes.tr_mul(&(matrix * &alone.shapes));
    let (blocks, in_blocks) = (blocks(&block_of), (in_basis(&pencil.0), in_basis(&pencil.1)));
    let are_together = |i: usize, j: usize| block_of[i] == block_of[j];
    let mut settled = settle(&in_blocks, are_together, |now| solved_in(&blocks, &in_blocks, now), tolerance, orders)?;
    settled.perturbed.check_roots()?;
    let mut shapes = alone.shapes * settled.perturbed.shapes;
    for mut shape in shapes.column_iter_mut() {
        shape /= shape.dot(&(&pencil.1 * &shape)).sqrt();
    }
    check_finite("perturbed generalized shapes", &shapes)?;
    apply_sign_rule(&mut shapes);
    settled.perturbed.shapes = shapes;
    Ok(SolvedInBlocks { settled: settled.check(tolerance, orders)?, blocks })
}

/// Joins blocks that hold neighboring roots closer than `separation` of the larger; whether there were any.
///
/// Neighbors are enough: when two roots are close, every root between them is close to the larger.
fn join_close(block_of: &mut [usize], roots: &DVector<f64>, separation: f64) -> bool {
    let before = block_of.to_vec();
    let mut ascending: Vec<usize> = (0..roots.len()).collect();
    ascending.sort_by(|&a, &b| roots[a].total_cmp(&roots[b]));
    for neighbors in ascending.windows(2) {
        let (smaller, larger) = (neighbors[0], neighbors[1]);
        if roots[larger] - roots[smaller] < separation * roots[larger] {
            let (one, other) = (block_of[smaller], block_of[larger]);
            let of_either = block_of.iter_mut().filter(|block| [one, other].contains(block));
            of_either.for_each(|block| *block = one.min(other));
        }
    }
    block_of != before
}

/// The blocks of two or more modes, each ascending.
fn blocks(block_of: &[usize]) -> Vec<Vec<usize>> {
    let modes = |block| (0..block_of.len()).filter(move |&mode| block_of[mode] == block).collect();
    (0..block_of.len()).map(modes).filter(|block: &Vec<usize>| block.len() > 1).collect()
}

/// Roots and modes of every block's own symmetric pencil within the span of its shapes: combinations of those, ascending in
/// frequency and of unit generalized mass.
fn solved_in(blocks: &[Vec<usize>], (stiffness, mass): &Pencil<f64>, mut now: Perturbed) -> Result<Perturbed, Error> {
    for block in blocks {
        let span = now.shapes.select_columns(block);
        let within = |matrix: &DMatrix<f64>| symmetric_part(&span.tr_mul(&(matrix * &span)));
        let modes = solve(&within(stiffness), &within(mass), block.len()).map_err(|error| match error {
            Error::NotAVibration { mode, value } => Error::LostRoot { mode: block[mode], value: value.recip() },
            Error::NotPositiveDefinite { dof, .. } => {
                Error::NotPositiveDefinite { what: "changed generalized mass", dof: block[dof] }
            }
            other => other,
        })?;
        for (column, &mode) in block.iter().enumerate() {
            now.roots[mode] = modes.omega_squared[column].recip();
            now.shapes.set_column(mode, &(&span * modes.shapes.column(column)));
        }
    }
    Ok(now)
}
