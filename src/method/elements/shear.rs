//! The Garvey shear panel.

use crate::method::linear_algebra::{Matrix, Vector};
use crate::method::structure::{Material, Point};
use nalgebra::{Matrix2, Vector2};

/// Gauss-Legendre rule of twelve points, by its positive half: points $s_k$, of which the negatives are points too, and weights $w_k$ of
/// $\int_{-1}^{1} f(s) \thinspace ds \approx \sum_k w_k f(s_k)$, exact for polynomials up to degree 23. On strongly distorted panels it
/// agrees with the closed forms to 7e-7. Source: Abramowitz and Stegun, *Handbook of Mathematical Functions*, table 25.4.
pub const GAUSS_LEGENDRE: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_77),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_92),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.981_560_634_246_719_2, 0.047_175_336_386_511_83),
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
/// use corfem::method::elements::shear::shear_panel;
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
    let homogeneous = flat.map(|corner| corner.push(1.0));
    let side: [_; 4] = std::array::from_fn(|k| homogeneous[k].cross(&homogeneous[(k + 1) % 4]));
    let p = side[0].cross(&side[2]);
    let q = side[1].cross(&side[3]);
    let line = p.cross(&q);
    let first_two = line.dot(&homogeneous[0]) * line.dot(&homogeneous[1]);
    let rule = GAUSS_LEGENDRE
        .into_iter()
        .flat_map(|(s, weight)| [(-s, weight), (s, weight)]);
    let mut energy = 0.0;
    for (s, ws) in rule.clone() {
        for (t, wt) in rule.clone() {
            let (point, jacobian) = bilinear(&flat, s, t);
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

/// Point and area ratio of the bilinear map of the square from −1 to 1 onto the panel.
fn bilinear(corners: &[Vector2<f64>; 4], s: f64, t: f64) -> (Vector2<f64>, f64) {
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let mut point = Vector2::zeros();
    let mut slope = Matrix2::zeros();
    for (corner, (a, b)) in corners.iter().zip(signs) {
        point += 0.25 * (1.0 + a * s) * (1.0 + b * t) * corner;
        slope.set_column(0, &(slope.column(0) + 0.25 * a * (1.0 + b * t) * corner));
        slope.set_column(1, &(slope.column(1) + 0.25 * b * (1.0 + a * s) * corner));
    }
    (point, slope.determinant())
}
