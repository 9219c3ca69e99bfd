//! Close and repeated roots: small blocks of close modes solved exactly, the rest by Recursive 1.
//!
//! A denominator of Recursive 1 vanishes when the change brings two roots together. Here modes whose roots are close
//! form a block $C$ that is carried through the recursion as one: its shapes $\begin{bmatrix} I \newline P \end{bmatrix}$
//! span the block's modes, and a matrix $\Gamma$ stands where one root $\gamma_j$ stood. With the changed
//! generalized stiffness $A = k + \beta$ and $G = k\Lambda + \alpha$ (both n × n, symmetric), row $i$ outside the block reads
//!
//! $$ P_i\,(A_{ii}\Gamma - G_{ii} I) = -\sum_{s \ne i}(A_{is}\Gamma - G_{is} I)\,P_s, \qquad
//!    A_{CC}\Gamma = G_{CC} - \sum_{s \notin C}(A_{Cs}P_s\Gamma - G_{Cs}P_s), $$
//!
//! where $P_s$ is a row of the identity for $s$ in $C$. With blocks of one mode these are the equations of Recursive 1
//! (C.22). The modes of a block come at last from the symmetric eigenproblem of $A$ and $G$ within its span.

use super::blocks::{BlockPencil, block_modes};
use super::general::ModalChange;
use super::general::QUIET_ORDERS;
use super::recursive::{check_order, check_root};
use super::{Perturbed, SMALLEST_SEPARATION, Settled};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, symmetric_part};
use crate::method::modes::apply_sign_rule;
use nalgebra::{DMatrix, DVector};

/// How [`close_roots`] tells close modes and when it stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloseRootsSettings {
    /// Two first-order roots are close when they differ by less than this fraction of the larger one, between 0
    /// and 1. A fraction of the place in the spectrum and not of its width: spectra span decades, and the width
    /// would make one block of all high modes (small roots).
    pub separation: f64,
    /// Largest relative change of a root in two orders in a row at which the recursion stops.
    pub tolerance: f64,
    /// Most orders.
    pub orders: usize,
}

impl Default for CloseRootsSettings {
    /// Roots within 10 % (5 % in frequency) form a block; roots converged to 1e-13, 60 orders at most.
    fn default() -> Self {
        Self {
            separation: 0.1,
            tolerance: 1e-13,
            orders: 60,
        }
    }
}

/// Roots and shapes after a change, and the modes that were too close for the recursion alone.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedInBlocks {
    /// Roots and generalized shapes, and how far the recursion went. Every shape has unit generalized mass, $p_j^t (k\Lambda + \alpha) p_j = 1$, and the
    /// first of its largest components is positive. Within a block the modes stand in ascending order of
    /// frequency; any other mode $j$ continues mode $j$.
    pub settled: Settled,
    /// The blocks of two or more close modes, each ascending; empty when all roots were apart.
    pub blocks: Vec<Vec<usize>>,
}

/// Recursive 1 with blocks of close modes.
///
/// The change must be symmetric: vibrations with changes of stiffness ($\beta$) and mass ($\alpha$), both n × n. Blocks
/// are formed from the first-order roots $(k_{ii}\lambda_i + \alpha_{ii})/(k_{ii} + \beta_{ii})$; each is solved alone, which moves
/// its roots, and blocks that thereby come close are joined until all are apart. Without close modes the roots
/// and shapes are those of [`super::recursive_1_converged`] but for the scale of the shapes.
///
/// # Errors
/// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`], [`Error::NotSymmetric`], [`Error::LostStiffness`] for bad
/// input; [`Error::Setting`] for a separation outside 0 to 1 or no orders; [`Error::NotPositiveDefinite`] when the
/// changed mass is not; [`Error::UnsettledRoots`]; [`Error::LostRoot`] when a root loses its sign; [`Error::CoalescingModes`] when the
/// recursion itself brings roots together that were apart.
pub fn close_roots(
    change: &ModalChange<f64>,
    settings: CloseRootsSettings,
) -> Result<SolvedInBlocks, Error> {
    check_order(settings.orders)?;
    if !(0.0..=1.0).contains(&settings.separation) {
        return Err(Error::Setting {
            name: "separation",
            expected: "between 0 and 1",
            found: settings.separation,
        });
    }
    let pencil = BlockPencil::new(change, settings.separation)?;
    let Recursion {
        mut shapes,
        block_roots,
        order,
        last_change,
    } = recursion(&pencil, settings)?;
    let mut roots = DVector::zeros(change.len());
    for (block, root) in pencil.blocks.iter().zip(block_roots) {
        let span = shapes.select_columns(block);
        let stiffness = span.tr_mul(&(&pencil.stiffness * &span));
        let mass = span.tr_mul(&(&pencil.mass * &span));
        let modes = block_modes(&symmetric_part(&stiffness), &symmetric_part(&mass), block)?;
        for (column, &mode) in block.iter().enumerate() {
            roots[mode] = match block.len() {
                1 => root[(0, 0)],
                _ => 1.0 / modes.omega_squared[column],
            };
            check_root(mode, roots[mode])?;
            shapes.set_column(mode, &(&span * modes.shapes.column(column)));
        }
    }
    shapes = &pencil.rotation * shapes;
    check_finite("perturbed generalized shapes", &shapes)?;
    apply_sign_rule(&mut shapes);
    Ok(SolvedInBlocks {
        settled: Settled {
            perturbed: Perturbed { roots, shapes },
            order,
            last_change,
        }
        .check(settings.orders)?,
        blocks: pencil
            .blocks
            .into_iter()
            .filter(|block| block.len() > 1)
            .collect(),
    })
}

/// Where the recursion ended, in the rotated basis.
struct Recursion {
    /// The identity within each block, $P$ outside (n × n).
    shapes: DMatrix<f64>,
    /// $\Gamma$ of every block.
    block_roots: Vec<DMatrix<f64>>,
    order: usize,
    last_change: f64,
}

/// Recursive 1 with a matrix of roots for each block.
fn recursion(pencil: &BlockPencil, settings: CloseRootsSettings) -> Result<Recursion, Error> {
    let (stiffness, mass) = (&pencil.stiffness, &pencil.mass);
    let (stiffness_coupling, mass_coupling) = (pencil.coupling(stiffness), pencil.coupling(mass));
    let size = stiffness.nrows();
    let mut now = Recursion {
        shapes: DMatrix::identity(size, size),
        block_roots: pencil
            .blocks
            .iter()
            .map(|block| {
                let roots = block.iter().map(|&i| mass[(i, i)] / stiffness[(i, i)]);
                DMatrix::from_diagonal(&DVector::from_iterator(block.len(), roots))
            })
            .collect(),
        order: 0,
        last_change: 1.0,
    };
    let mut quiet_orders = 0;
    // The first round makes the first-order shapes and leaves the roots alone: its sums hold nothing yet.
    for order in 1..=settings.orders {
        let stiffness_sums = &stiffness_coupling * &now.shapes;
        let mass_sums = &mass_coupling * &now.shapes;
        let mut change = 0.0_f64;
        for (block, gamma) in pencil.blocks.iter().zip(&mut now.block_roots) {
            let sums =
                stiffness_sums.select_columns(block) * &*gamma - mass_sums.select_columns(block);
            for i in (0..size).filter(|i| !block.contains(i)) {
                let inverse =
                    inverse_denominator(stiffness[(i, i)] * &*gamma, mass[(i, i)], (i, block[0]))?;
                let row = -sums.row(i) * inverse;
                for (column, &mode) in block.iter().enumerate() {
                    now.shapes[(i, mode)] = row[column];
                }
            }
            let mut root = -sums.select_rows(block);
            for (row, &i) in block.iter().enumerate() {
                root[(row, row)] += mass[(i, i)];
                root.row_mut(row).unscale_mut(stiffness[(i, i)]);
            }
            check_finite("perturbed roots", &root)?;
            change = change.max((&root - &*gamma).amax() / gamma.amax());
            *gamma = root;
        }
        now.order = order;
        if order > 1 {
            now.last_change = change;
            quiet_orders = if change < settings.tolerance {
                quiet_orders + 1
            } else {
                0
            };
            if quiet_orders == QUIET_ORDERS {
                break;
            }
        }
    }
    Ok(now)
}

/// $(A_{ii}\Gamma - G_{ii} I)^{-1}$, refused when the row's own root has met one of the block's.
fn inverse_denominator(
    own_stiffness_times_roots: DMatrix<f64>,
    own_mass: f64,
    (row, mode): (usize, usize),
) -> Result<DMatrix<f64>, Error> {
    let own = own_stiffness_times_roots.amax();
    let mut difference = own_stiffness_times_roots;
    for i in 0..difference.nrows() {
        difference[(i, i)] -= own_mass;
    }
    let inverse = difference.try_inverse();
    let separation = inverse
        .as_ref()
        .map_or(0.0, |inverse| 1.0 / (own * inverse.amax()));
    match inverse {
        Some(inverse) if separation > SMALLEST_SEPARATION => Ok(inverse),
        _ => Err(Error::CoalescingModes {
            first: row,
            second: mode,
            separation,
        }),
    }
}
