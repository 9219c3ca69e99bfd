//! Close and repeated roots: small blocks of close modes solved exactly, the rest by Recursive 1.
//! Tour: [chapter 2](corfem::tour::chapter_02_recursion).
//!
//! A denominator of Recursive 1 vanishes when the change brings two roots together. Here modes whose roots are close
//! form a block $C$ with a matrix $\Gamma$ for its roots and shapes $\begin{bmatrix} I \newline P \end{bmatrix}$. With
//! $A = k + \beta$ and $G = k\Lambda + \alpha$ (n × n, symmetric), row $i$ outside the block and its own rows read
//!
//! $$ P_i (A_{ii}\Gamma - G_{ii} I) = -\sum_{s \ne i}(A_{is}\Gamma - G_{is} I) P_s, \qquad
//!    A_{CC}\Gamma = G_{CC} - \sum_{s \notin C}(A_{Cs}P_s\Gamma - G_{Cs}P_s), $$
//!
//! where $P_s$ is a row of the identity for $s$ in $C$. With blocks of one mode these are the equations of Recursive 1
//! (C.22). The modes of a block come at last from the symmetric eigenproblem of $A$ and $G$ within its span.

use crate::prelude::*;
use corfem::method::perturbation::Settled;

/// Stiffness $k + \beta$ and mass $k\Lambda + \alpha$.
type Pencil = (DMatrix<f64>, DMatrix<f64>);
/// Orders in a row with changes below the tolerance after which the recursion stops.
const QUIET_ORDERS: usize = 2;

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
/// changes; [`Error::LostStiffness`], [`Error::NotAVibration`], [`Error::UnsettledRoots`]; [`Error::CoalescingModes`] when the
/// recursion itself brings roots together that were apart.
pub fn close_roots(
    change: &ModalChange,
    settings: CloseRootsSettings,
) -> Result<SolvedInBlocks, Error> {
    let CloseRootsSettings {
        separation,
        tolerance,
        orders,
    } = settings;
    let pencil = change.pencil()?;
    let pencil = (pencil.a().clone(), pencil.g().clone());
    let size = change.generalized_stiffness.len();
    let mut blocks: Vec<Vec<usize>> = (0..size).map(|mode| vec![mode]).collect();
    let identity = DMatrix::identity(size, size);
    let mut alone = solve_in(&blocks, &pencil, &identity)?;
    // Each round joins two blocks at least, so there are fewer rounds than modes.
    while join_close(&mut blocks, &alone.roots, separation) {
        alone = solve_in(&blocks, &pencil, &identity)?;
    }
    // The modes of the blocks alone are the basis of the recursion: in it A and G are diagonal within every block.
    let in_basis = |matrix: &DMatrix<f64>| alone.shapes.tr_mul(&(matrix * &alone.shapes));
    let pencil = (in_basis(&pencil.0), in_basis(&pencil.1));
    let mut settled = recursion(&blocks, &pencil, settings)?;
    let mut solved = solve_in(&blocks, &pencil, &settled.perturbed.shapes)?;
    for block in blocks.iter().filter(|block| block.len() == 1) {
        solved.roots[block[0]] = settled.perturbed.roots[block[0]];
    }
    if let Some(mode) = solved
        .roots
        .iter()
        .position(|&root| !(root > 0.0 && root.is_finite()))
    {
        return Err(Error::NotAVibration {
            mode,
            value: solved.roots[mode],
        });
    }
    solved.shapes = alone.shapes * solved.shapes;
    check_finite("perturbed generalized shapes", &solved.shapes)?;
    apply_sign_rule(&mut solved.shapes);
    settled.perturbed = solved;
    blocks.retain(|block| block.len() > 1);
    Ok(SolvedInBlocks {
        settled: is_settled(settled, tolerance, orders)?,
        blocks,
    })
}

/// Refuses a recursion whose roots have not settled to its tolerance, or nearly so.
fn is_settled(settled: Settled, tolerance: f64, orders: usize) -> Result<Settled, Error> {
    let (largest, last_change) = (tolerance.max(LARGEST_UNSETTLED_CHANGE), settled.last_change);
    if last_change <= largest {
        Ok(settled)
    } else {
        Err(Error::UnsettledRoots {
            orders,
            last_change,
        })
    }
}

/// Recursive 1 with a matrix $\Gamma$ for each block: its diagonal, and $P$ outside blocks with the identity within.
fn recursion(
    blocks: &[Vec<usize>],
    (stiffness, mass): &Pencil,
    settings: CloseRootsSettings,
) -> Result<Settled, Error> {
    let size = mass.nrows();
    let together = |i: usize, j: usize| {
        blocks
            .iter()
            .any(|block| block.contains(&i) && block.contains(&j))
    };
    let coupling = |matrix: &DMatrix<f64>| {
        matrix.map_with_location(|i, j, entry| if together(i, j) { 0.0 } else { entry })
    };
    let (stiffness_coupling, mass_coupling) = (coupling(stiffness), coupling(mass));
    // Γ of all blocks in one matrix, zero outside of blocks.
    let mut gamma = DMatrix::from_diagonal(&mass.diagonal().component_div(&stiffness.diagonal()));
    let mut shapes = DMatrix::identity(size, size);
    let (mut order, mut last_change, mut quiet_orders) = (0, 1.0, 0);
    while order < settings.orders && quiet_orders < QUIET_ORDERS {
        let sums = &stiffness_coupling * &shapes * &gamma - &mass_coupling * &shapes;
        let next = DMatrix::from_fn(size, size, |i, j| match together(i, j) {
            true if i == j => (mass[(i, i)] - sums[(i, i)]) / stiffness[(i, i)],
            true => -sums[(i, j)] / stiffness[(i, i)],
            false => 0.0,
        });
        check_finite("perturbed roots", &next)?;
        let mut change = 0.0_f64;
        for block in blocks {
            let within = |matrix: &DMatrix<f64>| matrix.select_rows(block).select_columns(block);
            let roots = within(&gamma);
            for i in (0..size).filter(|i| !block.contains(i)) {
                let own = stiffness[(i, i)] * &roots;
                let own_mass =
                    DMatrix::from_diagonal_element(block.len(), block.len(), mass[(i, i)]);
                let inverse = (&own - own_mass).try_inverse();
                let separation = inverse
                    .as_ref()
                    .map_or(0.0, |inverse| 1.0 / (own.amax() * inverse.amax()));
                let Some(inverse) = inverse.filter(|_| separation > SMALLEST_SEPARATION) else {
                    return Err(Error::CoalescingModes {
                        first: i,
                        second: block[0],
                        separation,
                    });
                };
                let row = -sums.select_rows([&i]).select_columns(block) * inverse;
                block
                    .iter()
                    .zip(row.iter())
                    .for_each(|(&mode, &entry)| shapes[(i, mode)] = entry);
            }
            change = change.max((within(&next) - &roots).amax() / roots.amax());
        }
        gamma = next;
        order += 1;
        // The first order makes the shapes and leaves the roots alone: its sums hold nothing of them yet.
        if order > 1 {
            last_change = change;
            quiet_orders = if change < settings.tolerance {
                quiet_orders + 1
            } else {
                0
            };
        }
    }
    Ok(Settled {
        perturbed: Perturbed {
            roots: gamma.diagonal(),
            shapes,
        },
        order,
        last_change,
    })
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
            let is_joined =
                |block: &Vec<usize>| block.contains(&smaller) || block.contains(&larger);
            let (joined, apart): (Vec<_>, Vec<_>) = blocks.drain(..).partition(is_joined);
            *blocks = apart;
            blocks.push(joined.concat());
        }
    }
    blocks.iter_mut().for_each(|block| block.sort_unstable());
    blocks.sort_unstable();
    blocks.len() < before
}

/// Roots and modes of every block's own symmetric pencil within the span of its columns of `shapes`: combinations of
/// those columns, ascending in frequency and of unit generalized mass.
fn solve_in(
    blocks: &[Vec<usize>],
    (stiffness, mass): &Pencil,
    shapes: &DMatrix<f64>,
) -> Result<Perturbed, Error> {
    let mut solved = Perturbed {
        roots: DVector::zeros(shapes.ncols()),
        shapes: shapes.clone(),
    };
    for block in blocks {
        let span = shapes.select_columns(block);
        let within = |matrix: &DMatrix<f64>| symmetric_part(&span.tr_mul(&(matrix * &span)));
        let modes =
            solve(&within(stiffness), &within(mass), block.len()).map_err(|error| match error {
                Error::NotAVibration { mode, value } => Error::NotAVibration {
                    mode: block[mode],
                    value: value.recip(),
                },
                Error::NotPositiveDefinite { row, .. } => Error::NotPositiveDefinite {
                    what: "changed generalized mass",
                    row: block[row],
                },
                other => other,
            })?;
        for (column, &mode) in block.iter().enumerate() {
            solved.roots[mode] = modes.omega_squared()[column].recip();
            solved
                .shapes
                .set_column(mode, &(&span * modes.shapes().column(column)));
        }
    }
    Ok(solved)
}
