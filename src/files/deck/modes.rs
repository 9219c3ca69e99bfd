//! The modes of a deck, refused where double precision does not suffice for them.

use super::model::BulkData;
use crate::files::error::{FileError, ensure};
use crate::files::test_data::row_name;
use crate::method::appendix_a::{ElementMatrix, element_matrices};
use crate::method::error::Error;
use crate::method::linear_algebra::symmetric_eigen;
use crate::method::structure::{DIRECTIONS, StructuralDof, Structure};
use crate::sparse::elements::{largest_entry, stiffness_of, support};
use crate::sparse::whole_modes::{MassDof, WholeModes, whole_modes};
use nalgebra::RowDVector;

/// Largest ratio of the stiffness of two elements. An assembled entry holds 16 digits of the stiffer one; at a ratio of
/// 1e10 six digits of the lowest frequency are left.
const LARGEST_RATIO: f64 = 1e10;
/// Eigenvalue of the Gram matrix of the masses' motions, each of length one, above which they are independent: motions
/// that differ by one part in 1e5, far more than fields of 8 characters round.
const INDEPENDENT: f64 = 1e-10;

/// The lowest vibrations of the model that a deck describes, held or free, at its DOF with mass ([`BulkData::mass_dof`]): `most` of them,
/// or all of finite frequency, which are as many as there are masses that move independently.
///
/// # Errors
/// [`FileError::StiffnessRange`] and [`FileError::LostModes`] for a structure so badly scaled that modes would be lost;
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
        check_count(found.modes.len(), model.mass_dof(&structure)?)?;
        found.counted = Some(found.modes.len());
    }
    Ok(found)
}

/// Shapes of a deck's modes at every degree of freedom that moves, those that MPC equations make dependent among them: a row each.
///
/// # Errors
/// [`FileError::TiedElement`] and what [`Structure::new`] refuses.
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
    let (mut softest, mut stiffest) = ((f64::INFINITY, 0), (0.0, 0));
    let elements = structure.elements().iter().zip(elements);
    for ((element, matrix), corners) in elements.zip(structure.corners()) {
        if !matrix.dof.is_empty() {
            let largest = element.size * largest_entry(matrix, element, corners);
            if largest < softest.0 {
                softest = (largest, element.label);
            }
            if largest > stiffest.0 {
                stiffest = (largest, element.label);
            }
        }
    }
    let most = LARGEST_RATIO;
    ensure(stiffest.0 <= most * softest.0, || {
        FileError::StiffnessRange {
            most,
            softest,
            stiffest,
        }
    })
}

/// Errors if fewer modes were found than masses move independently.
fn check_count(found: usize, at: MassDof) -> Result<(), FileError> {
    let place = |row: usize| format!("grid {}", row_name(row, &at.dof));
    let [lightest, heaviest] =
        [at.mass.imin(), at.mass.imax()].map(|row| (at.mass[row], place(row)));
    let mut motions = at.load_distribution.dense();
    for mut motion in motions.column_iter_mut() {
        motion.normalize_mut();
    }
    // The smaller of the two Gram matrices; their nonzero eigenvalues are the same.
    let gram = if motions.nrows() < motions.ncols() {
        &motions * motions.transpose()
    } else {
        motions.tr_mul(&motions)
    };
    let (values, _) = symmetric_eigen("motions of masses", &gram)?;
    let expected = values.iter().filter(|&&value| value > INDEPENDENT).count();
    ensure(found >= expected, || FileError::LostModes {
        expected,
        found,
        lightest,
        heaviest,
    })
}
