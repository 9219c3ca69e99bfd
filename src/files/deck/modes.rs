//! The modes of a deck, refused where double precision does not suffice for them.

use super::model::BulkData;
use crate::files::error::{FileError, ensure};
use crate::files::test_data::row_name;
use crate::method::appendix_a::{ElementMatrix, element_matrices};
use crate::method::error::Error;
use crate::method::structure::{DIRECTIONS, StructuralDof, Structure};
use crate::sparse::elements::{largest_entry, stiffness_of, support};
use crate::sparse::whole_modes::{MassDof, WholeModes, whole_modes};
use nalgebra::RowDVector;

/// Largest ratio of the stiffness of two elements. An assembled entry holds 16 digits of the stiffer one; at a ratio of
/// 1e10 six digits of the lowest frequency are left.
const LARGEST_RATIO: f64 = 1e10;
/// Singular value of the masses' motions, each of length one, above which they are independent: motions that differ by one part in 1e5,
/// far more than fields of 8 characters round.
const INDEPENDENT: f64 = 1e-5;

/// The lowest vibrations of the model that a deck describes, held or free, at its DOF with mass ([`BulkData::mass_dof`]): `most` of them,
/// or all of finite frequency. Of a held structure these are as many as masses move independently, which are counted where fewer are found:
/// frequencies some three million times the lowest are lost.
///
/// # Errors
/// [`FileError::Refused`] for elements so unlike in stiffness that modes would be lost;
/// [`Error::Value`] for a squared frequency or a mass beyond the range of numbers.
pub fn modes(model: &BulkData, most: usize) -> Result<WholeModes, FileError> {
    let structure = model.structure()?;
    let elements: Vec<_> = element_matrices(&structure).collect();
    check_stiffness(&structure, &elements)?;
    let at = model.mass_dof(&structure)?;
    let sizes = model.elements.iter().map(|element| element.size);
    let free = structure.free_dof();
    let stiffness = stiffness_of(free.len(), elements.iter().zip(sizes))?;
    let support = support(&structure, &elements)?;
    let mut found = whole_modes(&stiffness, at, most, &support, |row| row_name(row, free))
        .map_err(|error| match error {
            // A motion with neither stiffness nor mass.
            Error::NotPositiveDefinite {
                what: "mass of rigid-body motions",
                row,
            } => Error::SingularStiffness {
                grid: free[row].grid,
                direction: DIRECTIONS[free[row].direction],
            },
            other => other,
        })?;
    if found.rigid_body == 0 && found.modes.len() < most.min(found.dof.len()) {
        found.counted = Some(independent(model.mass_dof(&structure)?));
    }
    Ok(found)
}

/// Shapes of a deck's modes at every degree of freedom that moves, those that MPC equations make dependent among them: a row each.
///
/// # Errors
/// [`FileError::Refused`] for an element at a dependent degree of freedom, and what [`Structure::new`] refuses.
pub fn moving(
    model: &BulkData,
    modes: &WholeModes,
) -> Result<Vec<(StructuralDof, RowDVector<f64>)>, FileError> {
    let structure = model.structure()?;
    let still = RowDVector::zeros(modes.at_rows.ncols());
    let shape = |motion: Vec<(usize, f64)>| {
        motion.into_iter().fold(still.clone(), |sum, (row, part)| {
            sum + part * modes.at_rows.row(row)
        })
    };
    Ok(model
        .all_motions(&structure)
        .map(|(dof, motion)| (dof, shape(motion)))
        .collect())
}

/// Refuses elements so unlike in stiffness that a sum of both loses the softer one.
///
/// The stiffness of an element is the largest entry of its matrix, held DOF included: its direction may leave only round-off at the
/// free ones.
fn check_stiffness(structure: &Structure, elements: &[ElementMatrix]) -> Result<(), FileError> {
    let stiffness = (structure.elements().iter().zip(elements))
        .zip(structure.corners())
        .filter(|((_, matrix), _)| !matrix.dof.is_empty())
        .map(|((element, matrix), corners)| {
            let largest = element.size * largest_entry(matrix, element, corners);
            (largest, element.label)
        });
    let by = |one: &(f64, usize), other: &(f64, usize)| one.0.total_cmp(&other.0);
    let (least, most) = (stiffness.clone().min_by(by), stiffness.max_by(by));
    let (Some(least), Some(most)) = (least, most) else {
        return Ok(());
    };
    ensure(most.0 <= LARGEST_RATIO * least.0, || {
        FileError::refused(
            format!("element {} ({:.3e} lbf/in)", most.1, most.0),
            format!(
                "it is more than {LARGEST_RATIO:.0e} times as stiff as element {} ({:.3e} lbf/in), and double precision loses the softer one",
                least.1, least.0
            ),
        )
    })
}

/// The number of masses that move independently, which is that of the modes of a held structure.
fn independent(at: MassDof) -> usize {
    let mut motions = at.load_distribution.dense();
    for mut motion in motions.column_iter_mut() {
        motion.normalize_mut();
    }
    motions.rank(INDEPENDENT)
}
