//! First order where roots are close or repeated, for derivatives.

use super::recursive::check_root;
use super::{ModalChange, Perturbed};
use crate::error::Error;
use nalgebra::{DMatrix, DVector};

/// First order with close modes held to their own shapes, for derivatives: no error at a repeated root.
///
/// As [`super::general::first_order`], but $p_{ij} = 0$ between modes whose first-order roots are closer than
/// `separation` of the larger one. The rotation of two close modes under a small change is not small and has no
/// derivative where they meet; without it the change of each root is that of Rayleigh's quotient on its present
/// shape, which has one.
///
/// # Errors
/// As [`super::general::first_order`], [`Error::LostRoot`] when a root loses its sign, and [`Error::CoalescingModes`]
/// for a `separation` below [`super::SMALLEST_SEPARATION`].
pub fn first_order_held(change: &ModalChange<f64>, separation: f64) -> Result<Perturbed, Error> {
    change.check()?;
    let size = change.len();
    let mut perturbed = Perturbed {
        roots: DVector::zeros(size),
        shapes: DMatrix::zeros(size, size),
        order: 1,
        last_change: f64::INFINITY,
    };
    first_order_held_into(
        change,
        separation,
        &mut perturbed.roots,
        &mut perturbed.shapes,
    )?;
    Ok(perturbed)
}

/// [`first_order_held`] into storage that is already there, for a change already checked.
pub(crate) fn first_order_held_into(
    change: &ModalChange<f64>,
    separation: f64,
    roots: &mut DVector<f64>,
    shapes: &mut DMatrix<f64>,
) -> Result<(), Error> {
    for i in 0..change.len() {
        roots[i] = change.first_order_root(i);
        check_root(i, roots[i])?;
    }
    shapes.fill_with_identity();
    for j in 0..change.len() {
        for i in (0..change.len()).filter(|&i| i != j) {
            if (roots[i] - roots[j]).abs() >= separation * roots[i].max(roots[j]) {
                shapes[(i, j)] = (change.alpha[(i, j)] - change.beta[(i, j)] * roots[j])
                    / change.denominator(roots[j], i, j)?;
            }
        }
    }
    Ok(())
}
