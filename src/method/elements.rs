//! Element stiffness matrices in global axes, for unit gage or area.
//! Tour: [chapter 12](crate::tour::chapter_12_elements).
//!
//! Each function takes corner positions in inches and a material, and returns the stiffness at the x, y, z translations
//! of the corners in the order given. Stiffness is proportional to gage or area.

use super::{
    linear_algebra::{Matrix, Vector},
    structure::{ElementKind, Material, Point},
};
use nalgebra::{Matrix3, Vector2};

/// Stiffness of an element of any kind and unit size, lbf/in per in (gage) or per in² (area), for the corners of a
/// [`Structure`](crate::method::structure::Structure): 6 × 6 for a rod, 9 × 9 for a triangle, 12 × 12 for a panel.
pub fn unit_stiffness(kind: ElementKind, corners: &[Point], material: &Material) -> Matrix {
    match kind {
        ElementKind::Rod => rod(corners, material.youngs_modulus),
        ElementKind::Triangle => triangle(corners, material),
        ElementKind::ShearPanel => shear_panel(corners, material),
        ElementKind::Membrane => membrane(corners, material),
    }
}

/// Stiffness of a rod, an axial member, of unit cross section, lbf/in per in² of area (6 × 6; x, y, z of each end).
///
/// $$ K = \frac{E}{L} b b^t, \qquad b = (-n, n), \qquad n = (x_2 - x_1)/L $$
///
/// `youngs_modulus` in lbf/in², `ends` in inches. Rank one: it resists only stretching. Source: Przemieniecki, *Theory
/// of Matrix Structural Analysis*, section 5.2. Ends that coincide have no such stiffness: its entries are not finite numbers.
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::rod;
/// use nalgebra::Vector3;
///
/// // E/L = 1e7 / 10 along the rod, nothing across it.
/// let stiffness = rod(&[Vector3::zeros(), 10.0 * Vector3::x()], 1.0e7);
/// assert_eq!([(0, 0), (3, 0), (1, 1)].map(|entry| stiffness[entry]), [1.0e6, -1.0e6, 0.0]);
/// ```
pub fn rod(ends: &[Point], youngs_modulus: f64) -> Matrix {
    let along = ends[1] - ends[0];
    let length = along.norm();
    let n = along / length;
    let b = Vector::from_iterator(6, (-n).iter().chain(n.iter()).copied());
    (youngs_modulus / length) * &b * b.transpose()
}

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
/// use corfem::method::elements::triangle;
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
    let (nu, g) = (material.poissons_ratio, material.shear_modulus);
    let e = material.youngs_modulus / (1.0 - nu * nu);
    let elasticity = Matrix3::new(e, nu * e, 0.0, nu * e, e, 0.0, 0.0, 0.0, g);
    area * strain.transpose() * (elasticity * &strain)
}

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
/// use corfem::method::elements::membrane;
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
    // Each of the two diagonals splits the quadrilateral once.
    for nodes in [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]] {
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

/// Gauss-Legendre rule of twenty points, by its positive half: points $s_k$, of which the negatives are points too, and weights $w_k$ of
/// $\int_{-1}^{1} f(s) \thinspace ds \approx \sum_k w_k f(s_k)$, exact for polynomials up to degree 39. On the paper's box it agrees with
/// the closed forms to round-off, on strongly distorted panels to 2e-10. Source: Abramowitz and Stegun, *Handbook of Mathematical
/// Functions*, table 25.4.
pub const GAUSS_LEGENDRE: [(f64, f64); 10] = [
    (0.076_526_521_133_497_33, 0.152_753_387_130_725_85),
    (0.227_785_851_141_645_08, 0.149_172_986_472_603_75),
    (0.373_706_088_715_419_56, 0.142_096_109_318_382_05),
    (0.510_867_001_950_827_1, 0.131_688_638_449_176_63),
    (0.636_053_680_726_515, 0.118_194_531_961_518_42),
    (0.746_331_906_460_150_8, 0.101_930_119_817_240_44),
    (0.839_116_971_822_218_8, 0.083_276_741_576_704_75),
    (0.912_234_428_251_326, 0.062_672_048_334_109_06),
    (0.963_971_927_277_913_8, 0.040_601_429_800_386_94),
    (0.993_128_599_185_094_9, 0.017_614_007_139_152_118),
];

/// Stiffness of a shear panel of unit thickness, lbf/in per inch of gage (12 × 12).
///
/// $$ K = \frac{a a^t}{2 Z}, \qquad U = q_1^2 Z $$
///
/// with $a$ the [`corner_forces`] and $Z$ the [`energy_coefficient`] for a unit mean shear flow $q_1$ on side 1-2. The
/// panel resists a single pattern of motion: rank one. Source: Garvey, "The Quadrilateral Shear Panel", *Aircraft
/// Engineering* 23 (1951), 134; NASA SP-222.
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::shear_panel;
/// use corfem::method::structure::Material;
/// use nalgebra::{DVector, Vector3};
///
/// let (o, x, y) = (Vector3::zeros(), Vector3::x(), Vector3::y());
/// let stiffness = shear_panel(&[o, x, x + y, y], &Material::isotropic(2.5, 0.25)?);
/// // A unit square sheared by one holds twice the energy G A = 1; stretched it holds none.
/// let shear = DVector::from_iterator(12, [o, o, x, x].iter().flatten().copied());
/// let stretch = DVector::from_iterator(12, [o, x, x, o].iter().flatten().copied());
/// assert!((shear.dot(&(&stiffness * &shear)) - 1.0).abs() < 1e-14);
/// assert!((&stiffness * stretch).norm() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn shear_panel(corners: &[Point], material: &Material) -> Matrix {
    let a = corner_forces(corners);
    (0.5 / energy_coefficient(corners, material)) * &a * a.transpose()
}

/// Corners of a (possibly warped) panel in its mean plane, to which both diagonals are parallel, in: the first at the origin, the
/// second on the first axis.
///
/// With diagonals $d_{13}$ and $d_{24}$ the unit normal is $k = d_{13} \times d_{24}/|d_{13} \times d_{24}|$; axis $i$ is side 1-2
/// projected on the plane, $j = k \times i$. Source: geometry of the NASTRAN shear panel, NASA SP-222 and SP-223.
pub fn mean_plane(corners: &[Point]) -> [Vector2<f64>; 4] {
    let k = (corners[2] - corners[0])
        .cross(&(corners[3] - corners[1]))
        .normalize();
    let side = corners[1] - corners[0];
    let i = (side - side.dot(&k) * k).normalize();
    let j = k.cross(&i);
    // Corners 1 and 3 lie on one side of the plane by the warp, 2 and 4 on the other: only i and j count.
    [0, 1, 2, 3].map(|n| {
        let from_first = corners[n] - corners[0];
        Vector2::new(from_first.dot(&i), from_first.dot(&j))
    })
}

/// The 12 corner forces in equilibrium with a unit mean shear flow on side 1-2, lbf per lbf/in.
///
/// In mean-plane coordinates with corner 1 at the origin, $X_2$ the length of side 1-2 and $\tau = X_4 Y_3 - X_3 Y_4$,
///
/// $$ f_1 = -\frac{X_2 Y_4}{2\tau} d_{13} = -f_3, \qquad
///    f_2 = \frac{X_2 Y_3}{2\big(\tau - X_2 (Y_3 - Y_4)\big)} d_{24} = -f_4 . $$
///
/// They act along the true diagonals, so that force and moment vanish exactly, even on a warped panel.
pub fn corner_forces(corners: &[Point]) -> Vector {
    let [_, c2, c3, c4] = mean_plane(corners);
    let [d13, d24] = [corners[2] - corners[0], corners[3] - corners[1]];
    let x2 = c2.x;
    let tau = c4.x * c3.y - c3.x * c4.y;
    let f1 = -0.5 * x2 * c4.y / tau * d13;
    let f2 = 0.5 * x2 * c3.y / (tau - x2 * (c3.y - c4.y)) * d24;
    Vector::from_iterator(12, [f1, f2, -f1, -f2].iter().flatten().copied())
}

/// Strain energy of a unit-thickness panel for a unit mean shear flow on side 1-2, in²·(in²/lbf).
///
/// Opposite sides meet in the points $P$ and $Q$. Lines through either carry pure shear, with the flow
/// $q(x) = q_1 p_1 p_2 / p(x)^2$ where $p$ is the distance from the line $PQ$; with $\varphi$ the angle between
/// the rays to $P$ and $Q$,
///
/// $$ Z = \int \Big(\frac{p_1 p_2}{p^2}\Big)^{2} \frac{1}{2G}\Big(1 + \frac{2\cot^2\varphi}{1+\nu}\Big) \thinspace dA . $$
///
/// In homogeneous coordinates $P$, $Q$ and the line between them also exist when sides are parallel, so that one
/// quadrature serves every panel.
pub fn energy_coefficient(corners: &[Point], material: &Material) -> f64 {
    let flat = mean_plane(corners);
    let [h1, h2, h3, h4] = flat.map(|corner| corner.push(1.0));
    let p = h1.cross(&h2).cross(&h3.cross(&h4));
    let q = h2.cross(&h3).cross(&h4.cross(&h1));
    let line = p.cross(&q);
    let first_two = line.dot(&h1) * line.dot(&h2);
    // The bilinear map of the square, s and t from −1 to 1, onto the panel is c + s a + t b + s t d.
    let [c1, c2, c3, c4] = flat.map(|corner| 0.25 * corner);
    let (c, a, b, d) = (
        c1 + c2 + c3 + c4,
        c2 + c3 - c1 - c4,
        c3 + c4 - c1 - c2,
        c1 + c3 - c2 - c4,
    );
    let rule = GAUSS_LEGENDRE
        .into_iter()
        .flat_map(|(s, weight)| [(-s, weight), (s, weight)]);
    let mut energy = 0.0;
    for (s, ws) in rule.clone() {
        for (t, wt) in rule.clone() {
            let point = c + s * a + t * b + s * t * d;
            let jacobian = (a + t * d).perp(&(b + s * d));
            let flow = first_two / line.dot(&point.push(1.0)).powi(2);
            // Directions to P and Q, which may lie at infinity, unscaled.
            let [to_p, to_q] = [p, q].map(|end| end.xy() - end.z * point);
            let cotangent = to_p.dot(&to_q) / to_p.perp(&to_q);
            energy += ws * wt * jacobian * flow * flow / (2.0 * material.shear_modulus)
                * (1.0 + 2.0 * cotangent * cotangent / (1.0 + material.poissons_ratio));
        }
    }
    energy
}
