//! The membrane panel: four overlapping constant-strain triangles.

use crate::method::elements::panel::mean_plane;
use crate::method::elements::triangle::triangle;
use crate::method::error::Error;
use crate::method::linear_algebra::finite;
use crate::method::structure::Material;
use nalgebra::{DMatrix, Vector3};

/// The four triangles of a quadrilateral 1-2-3-4; each of its two diagonals splits it once.
const TRIANGLES: [[usize; 3]; 4] = [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]];

/// Stiffness of a membrane panel of unit thickness, lbf/in per inch of gage (12 × 12).
///
/// $$ K = \tfrac12 \big( K_{124} + K_{231} + K_{342} + K_{413} \big) $$
///
/// Two triangulations lie over each other, each with half the thickness, so that neither diagonal is favored. Every
/// triangle keeps its true corners in space, so that a rigid-body motion costs no energy even when the panel is warped.
/// Rank 5 when flat, 6 when warped.
///
/// # Errors
/// [`Error::ZeroArea`] and [`Error::NotConvex`] for a degenerate quadrilateral.
///
/// Source: the QDMEM element of NASTRAN, NASA SP-222; formulas rederived.
pub fn membrane(corners: &[Vector3<f64>; 4], material: &Material) -> Result<DMatrix<f64>, Error> {
    mean_plane(corners)?;
    let mut stiffness = DMatrix::zeros(12, 12);
    for nodes in TRIANGLES {
        let part = triangle(nodes.map(|n| corners[n]), material)?;
        for (a, &row_node) in nodes.iter().enumerate() {
            for (b, &column_node) in nodes.iter().enumerate() {
                let mut block = stiffness.fixed_view_mut::<3, 3>(3 * row_node, 3 * column_node);
                block += 0.5 * part.fixed_view::<3, 3>(3 * a, 3 * b);
            }
        }
    }
    finite("element stiffness", stiffness)
}
