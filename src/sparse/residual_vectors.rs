//! Residual vectors: static deflections that the lowest modes lack, as further shapes in which changes are followed.

use super::checks::independent;
use super::matrix::GIVEN;
use super::share::WholeShare;
use super::{SparseMatrix, places_above, take_product, transposed_product};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector};

/// The loads (DOF × at most `most`) of a parameter's part $P$ of stiffness or mass in the modes, by which it couples them most with
/// what is not among them.
///
/// A change of the part loads mode $i$ by $P v_i$; over $\omega_i$, or times $\omega_i$ for a mass, so that modes count alike. Of the
/// columns $L$ these are the combinations $L y$ of largest $y^t V^t L y$, one a deformation for a part that has fewer.
pub(super) fn leading_loads(
    (share, rows): (&WholeShare, &[usize]),
    modes: &Modes,
    most: usize,
) -> Result<DMatrix<f64>, Error> {
    // Of a part of the structure few rows are read.
    let (dof, count) = modes.shapes.shape();
    let mut transposed_shapes = DMatrix::from_vec(count, dof, vec![0.0; count * dof]);
    for &row in rows {
        let mut shapes = transposed_shapes.column_mut(row);
        shapes.tr_copy_from(&modes.shapes.row(row));
    }
    let power = if share.is_mass() { 0.5 } else { -0.5 };
    let scale = DMatrix::from_diagonal(&modes.omega_squared.map(|square| square.powf(power)));
    let loads = &scale * share.matrix().loads(&transposed_shapes);
    let own = scale * transposed_shapes.select_columns(rows);
    let (energies, vectors) = symmetric_eigen(
        "energy of a parameter in the modes",
        &symmetric_part(&(&loads * own.transpose())),
    )?;
    let digits = GIVEN * energies.amax();
    let leading = places_above(&energies, digits);
    let vectors = vectors.select_columns(leading.iter().rev().take(most));
    let mut all = DMatrix::zeros(modes.shapes.nrows(), vectors.ncols());
    let combined = vectors.transpose() * loads;
    for (&row, combined) in rows.iter().zip(combined.column_iter()) {
        all.row_mut(row).tr_copy_from(&combined);
    }
    Ok(all)
}

/// Shapes of unit generalized mass, orthogonal to vibrations $V$, given with $M V$, and each other in mass and in stiffness, that span static
/// `deflections` $D$ (DOF × m) under `loads` $K D$ with them, and their squared frequencies, ascending.
///
/// $$ W = (I - V V^t M) D, \qquad K W = K D - M V \Omega^2 V^t M D, \qquad W^t K W z = \omega^2 W^t M W z $$
///
/// Of a structure that hangs free the deflections are those under balanced loads, orthogonal to its rigid-body modes. No $\omega^2$ is
/// below those of all modes left out. A deflection that has less of anything new than given digits tell is left out, as is a motion
/// without mass.
///
/// Source: Coppolino, *SAE Technical Paper* 891082 (1989); Rose, *A Residual Vector Approach*, MSC World Users' Conference (1991).
///
/// # Errors
/// Those of [`symmetric_eigen`].
pub(super) fn residual_vectors(
    mass: &SparseMatrix,
    (vibrations, weighted): (&Modes, &DMatrix<f64>),
    (mut deflections, mut loads): (DMatrix<f64>, DMatrix<f64>),
) -> Result<Modes, Error> {
    let none = super::no_modes(mass.rows());
    if deflections.ncols() == 0 {
        return Ok(none);
    }
    let energy = |deflections: &DMatrix<f64>, loads: &DMatrix<f64>| {
        let both = deflections.column_iter().zip(loads.column_iter());
        DVector::from_vec(
            both.map(|(deflection, load)| deflection.dot(&load))
                .collect(),
        )
    };
    let first = energy(&deflections, &loads);
    // Once leaves the round-off of what was taken away, twice is enough.
    for _ in 0..2 {
        let shares = transposed_product(weighted, &deflections);
        take_product(&mut deflections, &vibrations.shapes, &shares);
        let forces = DMatrix::from_diagonal(&vibrations.omega_squared) * shares;
        take_product(&mut loads, weighted, &forces);
    }
    let rest = energy(&deflections, &loads);
    let new = places_above(&rest.component_div(&first), GIVEN);
    if new.is_empty() {
        return Ok(none);
    }
    // Of unit energy each, then free of what others have already.
    let unit = new.iter().map(|&column| 1.0 / rest[column].sqrt());
    let unit = DMatrix::from_diagonal(&DVector::from_iterator(new.len(), unit));
    let [deflections, loads] = [deflections, loads].map(|all| all.select_columns(&new) * &unit);
    let energies = symmetric_part(&transposed_product(&deflections, &loads));
    let (_, own) = independent("energy of deflections", &energies, |_| GIVEN)?;
    let deflections = deflections * own;
    let inertia = transposed_product(&deflections, &mass.times(&deflections)?);
    let least = GIVEN / vibrations.omega_squared[0];
    let (roots, moving) = independent("mass of deflections", &inertia, |_| least)?;
    let descending: Vec<usize> = (0..roots.len()).rev().collect();
    let moving = Modes {
        omega_squared: roots.map(f64::recip),
        shapes: deflections * moving,
    };
    Ok(moving.select(&descending))
}
