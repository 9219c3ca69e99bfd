//! The constant-strain triangle in plane stress, and the membrane panel of four that overlap.

use crate::method::linear_algebra::Matrix;
use crate::method::structure::{Material, Point};
use nalgebra::Matrix3;

/// Stiffness of a constant-strain triangle of unit thickness, lbf/in per inch of gage (9 × 9).
///
/// $$ K = A B^t D B, \qquad D = \frac{E}{1-\nu^2}
///    \begin{pmatrix} 1 & \nu & 0 \newline \nu & 1 & 0 \newline 0 & 0 & G(1-\nu^2)/E \end{pmatrix} $$
///
/// $B$ maps the nine translations (x, y, z of each corner, inches) to the three strains in the triangle's plane; motion
/// out of the plane meets no resistance. Rank three. Source: Turner, Clough, Martin and Topp, *Journal of the
/// Aeronautical Sciences* 23 (1956), 805.
///
/// Corners on a line have no such stiffness: their entries are not finite numbers.
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::membrane::triangle;
/// use corfem::method::structure::Material;
/// use nalgebra::Vector3;
///
/// // Corner 2 moves along x by one: strain 1 in an area of 1/2, with E = 1 and no Poisson's ratio.
/// let corners = [Vector3::zeros(), Vector3::x(), Vector3::y()];
/// let stiffness = triangle(&corners, &Material::isotropic(1.0, 0.0)?);
/// assert!((stiffness[(3, 3)] - 0.5).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn triangle(corners: &[Point], material: &Material) -> Matrix {
    let [a, b, c] = [0, 1, 2].map(|n| corners[n]);
    let normal = (b - a).cross(&(c - a));
    let area = 0.5 * normal.norm();
    let k = normal / (2.0 * area);
    // B in a frame with its first axis along the first side. The gradient of corner n's shape function is k × s/(2A), with s the
    // side opposite to it.
    let i = (b - a).normalize();
    let j = k.cross(&i);
    let mut strain = Matrix::zeros(3, 9);
    for n in 0..3 {
        let opposite = corners[(n + 2) % 3] - corners[(n + 1) % 3];
        let gradient = k.cross(&opposite) / (2.0 * area);
        let (dx, dy) = (gradient.dot(&i), gradient.dot(&j));
        for axis in 0..3 {
            strain[(0, 3 * n + axis)] = dx * i[axis];
            strain[(1, 3 * n + axis)] = dy * j[axis];
            strain[(2, 3 * n + axis)] = dy * i[axis] + dx * j[axis];
        }
    }
    let Material {
        youngs_modulus,
        poissons_ratio: nu,
        shear_modulus,
        ..
    } = *material;
    let e = youngs_modulus / (1.0 - nu * nu);
    let elasticity = Matrix3::new(e, nu * e, 0.0, nu * e, e, 0.0, 0.0, 0.0, shear_modulus);
    area * strain.transpose() * (elasticity * &strain)
}

/// The four triangles of a quadrilateral 1-2-3-4; each of its two diagonals splits it once.
const TRIANGLES: [[usize; 3]; 4] = [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]];

/// Stiffness of a membrane panel of unit thickness, lbf/in per inch of gage (12 × 12).
///
/// $$ K = \tfrac12 \big( K_{124} + K_{231} + K_{342} + K_{413} \big) $$
///
/// Two triangulations lie over each other, each with half the thickness, so that neither diagonal is favored. Every
/// triangle keeps its true corners in space, so that a rigid-body motion costs no energy even when the panel is warped.
/// Rank 5 when flat, 6 when warped. Source: the QDMEM element of NASTRAN, NASA SP-222; formulas rederived.
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::membrane::membrane;
/// use corfem::method::structure::Material;
/// use nalgebra::{DVector, Vector3};
///
/// let (o, x, y) = (Vector3::zeros(), Vector3::x(), Vector3::y());
/// let stiffness = membrane(&[o, x, x + y, y], &Material::isotropic(1.0, 0.0)?);
/// // A unit square stretched by one along x holds twice the energy E A = 1.
/// let stretch = DVector::from_iterator(12, [o, x, x, o].iter().flatten().copied());
/// assert!((stretch.dot(&(stiffness * &stretch)) - 1.0).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn membrane(corners: &[Point], material: &Material) -> Matrix {
    let mut stiffness = Matrix::zeros(12, 12);
    for nodes in TRIANGLES {
        let part = triangle(&nodes.map(|n| corners[n]), material);
        for (a, &row_node) in nodes.iter().enumerate() {
            for (b, &column_node) in nodes.iter().enumerate() {
                let mut block = stiffness.fixed_view_mut::<3, 3>(3 * row_node, 3 * column_node);
                block += 0.5 * part.fixed_view::<3, 3>(3 * a, 3 * b);
            }
        }
    }
    stiffness
}
