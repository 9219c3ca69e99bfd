//! Appendix A: from structural to dynamic degrees of freedom.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::assembly::ElementMatrix;
use crate::method::error::Error;
use crate::method::factorization::FactorizedStiffness;
use crate::method::linear_algebra::{add_squares, cholesky, finite, solve_lower};
use crate::method::load_distribution::LoadDistribution;
use nalgebra::{DMatrix, DVector};

/// Pivot of the flexibility relative to its diagonal below which a dynamic DOF is a combination of others.
const SMALLEST_FLEXIBILITY_PIVOT: f64 = 1e-13;
/// Stiffness of a way to deform, relative to the element's largest, below which it is the round-off of a rigid motion.
const SMALLEST_DEFORMATION: f64 = 1e-14;
/// Ways to deform that are multiplied at once: as many as a processor's cache holds.
const AMPLITUDES_AT_ONCE: usize = 256;

/// The stiffness at the dynamic DOF and the transformation that brought it there.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// $B^t = K_S^{-1} T K_D$: structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: DMatrix<f64>,
}

/// Dynamic stiffness and transformation for a load distribution $T$ (A.3, free SDOF × d).
///
/// $$ K_D^{-1} = T^t K_S^{-1} T, \qquad B^t = K_S^{-1} T K_D, \qquad q_S = B^t q_D $$
///
/// $T$ distributes dynamic loads to structural ones, $Q_S = T Q_D$; by equal work $q_D = T^t q_S$. When $T$ only
/// selects DOF this is static (Guyan) condensation. Source: the paper's (1), (2), (A.5), (A.7), (A.8), of which the
/// last two print $T^t$ for $T$ (`paper/errata.md`).
///
/// # Errors
/// [`Error::Empty`] without dynamic DOF; [`Error::WrongShape`] and [`Error::NotFinite`] for a bad $T$;
/// [`Error::Dependent`] when a dynamic DOF is a combination of those before it.
///
/// # Example
///
/// ```rust
/// # use corfem::closed_forms::spring_chain::rods;
/// # use corfem::method::assembly::element_matrices;
/// use corfem::method::appendix_a::condense;
/// use corfem::method::factorization::FactorizedStiffness;
/// use nalgebra::dmatrix;
///
/// let chain = rods(&[100.0, 50.0], [true, false])?;
/// let stiffness =
///     FactorizedStiffness::new(&element_matrices(&chain)?, &[100.0, 50.0], chain.free_dof())?;
/// // To the tip: two springs in a row are one of 1 / (1/100 + 1/50), and the middle goes a third as far.
/// let condensed = condense(&stiffness, &dmatrix![0.0; 1.0])?;
/// assert!((condensed.stiffness[0] - 100.0 / 3.0).abs() < 1e-12);
/// assert!((condensed.transformation[0] - 1.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn condense(
    structural: &FactorizedStiffness,
    load_distribution: &DMatrix<f64>,
) -> Result<Condensed, Error> {
    let loads = LoadDistribution::of(load_distribution)?;
    let stiffness = dynamic_stiffness(&structural.flexibility(&loads)?)?;
    Ok(Condensed {
        transformation: structural
            .solve_transposed(&loads.times(&stiffness))?
            .transpose(),
        stiffness,
    })
}

/// The dynamic stiffness $K_D$ (lbf/in) of its inverse, the flexibility (in/lbf), both d × d.
///
/// # Errors
/// [`Error::Dependent`] when a dynamic DOF is a combination of those before it.
pub(crate) fn dynamic_stiffness(flexibility: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    let lower = cholesky(
        "dynamic flexibility",
        flexibility,
        SMALLEST_FLEXIBILITY_PIVOT,
    )
    .map_err(|error| error.or_dependent("dynamic degree of freedom"))?;
    let inverse_factor = solve_lower(
        &lower,
        DMatrix::identity(flexibility.nrows(), flexibility.nrows()),
    );
    finite("dynamic stiffness", inverse_factor.tr_mul(&inverse_factor))
}

/// Generalized stiffness of elements of given sizes, $\sum_e s_e V_e^t K_e V_e$ (m × m, lbf/in for deflections in inches), where
/// $V_e$ are the columns of `transposed_shapes` (m × free SDOF) at an element's own DOF.
///
/// For `transposed_shapes` $= B$ it is their share of $K_D$, $\sum_e s_e B K_e B^t$ (A.9); the shares sum to $K_D$ exactly. For
/// $V_S = B^t V$ it is that share seen through dynamic shapes $V$. An element deforms in few ways, a rod and a shear panel in one: by
/// Cholesky steps with pivots, $K_e = \sum_r a_r a_r^t/p_r$ and $V_e^t K_e V_e = \sum_r (V_e^t a_r)(V_e^t a_r)^t/p_r$.
pub(crate) fn generalized_stiffness<'a>(
    transposed_shapes: &DMatrix<f64>,
    members: impl Iterator<Item = (&'a ElementMatrix, f64)>,
) -> DMatrix<f64> {
    let (count, shapes) = (transposed_shapes.nrows(), transposed_shapes.as_slice());
    let mut sum = DMatrix::zeros(count, count);
    let (mut amplitudes, mut rest, mut deformation) = (Vec::new(), Vec::new(), Vec::new());
    for (ElementMatrix { dof, unit, .. }, size) in members {
        let through = |weights: &[f64], scale: f64, force: &mut [f64]| {
            for (&dof, &weight) in dof
                .iter()
                .zip(weights)
                .filter(|(_, weight)| **weight != 0.0)
            {
                let (weight, motion) = (scale * weight, &shapes[dof * count..][..count]);
                force
                    .iter_mut()
                    .zip(motion)
                    .for_each(|(sum, motion)| *sum += weight * motion);
            }
        };
        rest.clear();
        rest.extend_from_slice(unit.as_slice());
        // The largest entry of a semidefinite matrix stands on its diagonal.
        let smallest = SMALLEST_DEFORMATION * unit.diagonal().amax();
        while let Some(pivot) = take_deformation(&mut rest, dof.len(), smallest, &mut deformation) {
            let start = amplitudes.len();
            amplitudes.resize(start + count, 0.0);
            through(
                &deformation,
                (size / pivot).sqrt(),
                &mut amplitudes[start..],
            );
        }
        // A matrix that is not semidefinite leaves something that no pivot explains.
        for (&dof, column) in dof.iter().zip(rest.chunks(dof.len().max(1))) {
            if column.iter().any(|entry| entry.abs() > smallest) {
                let mut force = vec![0.0; count];
                through(column, size, &mut force);
                sum.syger(
                    1.0,
                    &DVector::from_vec(force),
                    &transposed_shapes.column(dof),
                    1.0,
                );
            }
        }
        if amplitudes.len() >= AMPLITUDES_AT_ONCE * count {
            add_squares(&mut sum, &amplitudes);
            amplitudes.clear();
        }
    }
    add_squares(&mut sum, &amplitudes);
    sum.fill_upper_triangle_with_lower_triangle();
    sum
}

/// Takes $a a^t/p$ with the largest pivot $p$, and $a$ its column, out of a symmetric matrix: the pivot, if one is left.
fn take_deformation(
    matrix: &mut [f64],
    order: usize,
    smallest: f64,
    column: &mut Vec<f64>,
) -> Option<f64> {
    let diagonal = |at: usize| matrix[at * (order + 1)];
    let pivot = (0..order).max_by(|&a, &b| diagonal(a).total_cmp(&diagonal(b)))?;
    let value = Some(diagonal(pivot)).filter(|value| *value > smallest && value.is_finite())?;
    column.clear();
    column.extend_from_slice(&matrix[pivot * order..][..order]);
    for (entries, factor) in matrix
        .chunks_exact_mut(order)
        .zip(column.iter())
        .filter(|(_, factor)| **factor != 0.0)
    {
        entries
            .iter_mut()
            .zip(column.iter())
            .for_each(|(entry, of)| *entry -= of * factor / value);
    }
    Some(value)
}

/// Their generalized mass in the same way, $\sum_e s_e V_e^t M_e V_e$ with the lumped $M_e$.
pub(crate) fn generalized_mass<'a>(
    transposed_shapes: &DMatrix<f64>,
    members: impl Iterator<Item = (&'a ElementMatrix, f64)>,
) -> DMatrix<f64> {
    let count = transposed_shapes.nrows();
    let mut sum = DMatrix::zeros(count, count);
    for (ElementMatrix { dof, unit_mass, .. }, size) in members {
        for (&dof, unit) in dof.iter().zip(unit_mass).filter(|(_, unit)| **unit != 0.0) {
            let motion = transposed_shapes.column(dof);
            sum.syger(size * unit, &motion, &motion, 1.0);
        }
    }
    sum.fill_upper_triangle_with_lower_triangle();
    sum
}
