//! Blocks of close modes: which modes form them, and the basis in which each block is diagonal.

use super::general::ModalChange;
use super::recursive::check_root;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_symmetric, cholesky};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector};

/// The changed structure in modal coordinates, its blocks of close modes solved and the basis rotated to them.
pub(super) struct BlockPencil {
    /// $A = R^t(k + \beta)R$ (n × n), diagonal within blocks.
    pub stiffness: DMatrix<f64>,
    /// $G = R^t(k\Lambda + \alpha)R$ (n × n), diagonal within blocks.
    pub mass: DMatrix<f64>,
    /// $R$ (n × n), the identity outside blocks.
    pub rotation: DMatrix<f64>,
    /// Every mode in one block, blocks and their modes ascending.
    pub blocks: Vec<Vec<usize>>,
}

impl BlockPencil {
    /// Joins close modes to blocks and solves each block alone until roots of different blocks are apart.
    ///
    /// # Errors
    /// As [`super::close_roots()`].
    pub fn new(change: &ModalChange<f64>, separation: f64) -> Result<Self, Error> {
        change.check()?;
        check_symmetric("generalized stiffness change", &change.beta)?;
        check_symmetric("generalized mass change", &change.alpha)?;
        let k = &change.generalized_stiffness;
        let stiffness = DMatrix::from_diagonal(k) + &change.beta;
        let mass = DMatrix::from_diagonal(&k.component_mul(&change.roots)) + &change.alpha;
        cholesky("changed generalized mass", &mass, 0.0)?;
        let size = change.len();
        let mut pencil = Self {
            stiffness: stiffness.clone(),
            mass: mass.clone(),
            rotation: DMatrix::identity(size, size),
            blocks: (0..size).map(|mode| vec![mode]).collect(),
        };
        // Each round joins two blocks at least, so there are fewer rounds than modes.
        loop {
            let roots = pencil.own_roots()?;
            if !join_close(&mut pencil.blocks, &roots, separation) {
                return Ok(pencil);
            }
            for block in pencil.blocks.iter().filter(|block| block.len() > 1) {
                let within =
                    |matrix: &DMatrix<f64>| matrix.select_rows(block).select_columns(block);
                let modes = block_modes(&within(&stiffness), &within(&mass), block)?;
                for (row, &i) in block.iter().enumerate() {
                    for (column, &j) in block.iter().enumerate() {
                        pencil.rotation[(i, j)] = modes.shapes[(row, column)];
                    }
                }
            }
            pencil.stiffness = pencil.rotation.tr_mul(&(&stiffness * &pencil.rotation));
            pencil.mass = pencil.rotation.tr_mul(&(&mass * &pencil.rotation));
        }
    }

    /// $G_{ii}/A_{ii}$, the roots to first order in the rotated basis.
    fn own_roots(&self) -> Result<DVector<f64>, Error> {
        let roots = self
            .mass
            .diagonal()
            .component_div(&self.stiffness.diagonal());
        for (mode, &root) in roots.iter().enumerate() {
            check_root(mode, root)?;
        }
        Ok(roots)
    }

    /// A matrix without its entries inside blocks: what couples one block with another.
    pub fn coupling(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let mut coupling = matrix.clone();
        for block in &self.blocks {
            for &i in block {
                for &j in block {
                    coupling[(i, j)] = 0.0;
                }
            }
        }
        coupling
    }
}

/// Joins blocks that hold neighboring roots closer than `separation` of the larger; whether there were any.
///
/// Neighbors are enough: when two roots are close, every root between them is close to the larger.
fn join_close(blocks: &mut Vec<Vec<usize>>, roots: &DVector<f64>, separation: f64) -> bool {
    let before = blocks.len();
    let mut ascending: Vec<usize> = (0..roots.len()).collect();
    ascending.sort_by(|&a, &b| roots[a].total_cmp(&roots[b]));
    for neighbors in ascending.windows(2) {
        let (smaller, larger) = (neighbors[0], neighbors[1]);
        if roots[larger] - roots[smaller] < separation * roots[larger] {
            let (joined, apart) =
                std::mem::take(blocks)
                    .into_iter()
                    .partition::<Vec<_>, _>(|block| {
                        block.contains(&smaller) || block.contains(&larger)
                    });
            *blocks = apart;
            blocks.push(joined.concat());
        }
    }
    for block in blocks.iter_mut() {
        block.sort_unstable();
    }
    blocks.sort_unstable();
    blocks.len() < before
}

/// Modes of a block's own symmetric pencil, ascending in frequency and of unit generalized mass.
///
/// # Errors
/// [`Error::LostRoot`] naming the mode of the whole problem when a root is not positive.
pub(super) fn block_modes(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    block: &[usize],
) -> Result<Modes, Error> {
    crate::method::modes::solve(stiffness, mass, block.len()).map_err(|error| match error {
        Error::NotAVibration { mode, value } => Error::LostRoot {
            mode: block[mode],
            value: value.recip(),
        },
        other => other,
    })
}
