//! First order where roots are close or repeated, for derivatives.

use super::recursive::check_root;
use super::{ModalChange, Perturbed};
use crate::method::error::Error;
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
    let mut roots = DVector::zeros(size);
    for i in 0..size {
        roots[i] = change.first_order_root(i);
        check_root(i, roots[i])?;
    }
    let mut shapes = DMatrix::identity(size, size);
    for j in 0..size {
        for i in (0..size).filter(|&i| i != j) {
            if (roots[i] - roots[j]).abs() >= separation * roots[i].max(roots[j]) {
                shapes[(i, j)] = (change.alpha[(i, j)] - change.beta[(i, j)] * roots[j])
                    / change.denominator(roots[j], i, j)?;
            }
        }
    }
    Ok(Perturbed {
        roots,
        shapes,
        order: 1,
        last_change: f64::INFINITY,
    })
}
