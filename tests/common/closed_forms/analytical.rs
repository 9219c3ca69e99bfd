//! Closed forms that the numerical routes are compared with: the energy of the shear panel, chains of equal
//! masses and springs, the uniform rod.

use crate::prelude::*;

/// Corners of a panel in its mean plane, the first at the origin, the second on the first axis, in.
pub type Flat = [Vector2<f64>; 4];

/// Area of a panel in its mean plane, in²: half the product of its diagonals.
pub fn area([a, b, c, d]: &Flat) -> f64 {
    0.5 * (c - a).perp(&(d - b))
}

/// Energy coefficient $Z$ of a shear panel whose opposite sides are all parallel, as
/// [`corfem::method::elements::energy_coefficient`] for unit thickness, in⁴/lbf.
///
/// $$ Z = \frac{A}{2G}\Big(1 + \frac{2 D^2}{1+\nu}\Big), \qquad
///    D = -\frac12\Big(\frac{X_4}{Y_4} + \frac{X_3 - X_2}{Y_3} + \frac{Y_3 - Y_4}{X_3 - X_4}\Big) $$
///
/// $X_i$, $Y_i$ are the corners in the mean plane (corner 1 at the origin, $Y_2 = 0$), $A$ the area. The caller says
/// that the sides are parallel; nothing is tested. Source: NASA SP-222, shear panel; rederived.
pub fn parallelogram_energy(plane: &Flat, material: &Material) -> f64 {
    let [_, c2, c3, c4] = *plane;
    let d = -0.5 * (c4.x / c4.y + (c3.x - c2.x) / c3.y + (c3.y - c4.y) / (c3.x - c4.x));
    area(plane) / (2.0 * material.shear_modulus) * (1.0 + skewness_weight(material) * 3.0 * d * d)
}

/// $Z$ of a shear panel whose sides 1-2 and 3-4 alone are parallel, in⁴/lbf; as [`parallelogram_energy`] otherwise.
///
/// $$ Z = \frac{p_1 p_2}{p_3 p_4} \frac{A}{2G} \Big(1 + \frac{2}{3} \frac{s^2 + sc + c^2}{1+\nu}\Big), \qquad
///    p_i = y_b - Y_i, \quad s = \frac{X_2 - x_b}{y_b}, \quad c = -\frac{x_b}{y_b} $$
///
/// $(x_b, y_b)$ is where sides 1-4 and 2-3 meet.
pub fn sides_12_34_parallel_energy(plane: &Flat, material: &Material) -> f64 {
    let [_, c2, c3, c4] = *plane;
    let (xb, yb) = meeting_of_sides_14_23(plane);
    let (s, c) = ((c2.x - xb) / yb, -xb / yb);
    let flow_ratio = yb * yb / ((yb - c3.y) * (yb - c4.y));
    flow_ratio * area(plane) / (2.0 * material.shear_modulus)
        * (1.0 + skewness_weight(material) * (s * s + s * c + c * c))
}

/// $Z$ of a shear panel whose sides 1-4 and 2-3 alone are parallel, in⁴/lbf; as [`parallelogram_energy`] otherwise.
///
/// $$ Z = \frac{p_1 p_2}{p_3 p_4} \frac{A}{2G} \Big(1 + \frac{2}{3} \frac{b^2 + bD + D^2}{1+\nu}\Big), \qquad
///    D = -\frac12\Big(\frac{X_4}{Y_4} + \frac{X_3-X_2}{Y_3}\Big), $$
/// $$ p_i = \frac{x_a - X_i - D Y_i}{\sqrt{1+D^2}}, \qquad b = \frac{(x_a - X_4) D + Y_4}{(x_a - X_4) - Y_4 D} $$
///
/// $(x_a, 0)$ is where sides 1-2 and 3-4 meet.
pub fn sides_14_23_parallel_energy(plane: &Flat, material: &Material) -> f64 {
    let [_, c2, c3, c4] = *plane;
    let xa = meeting_of_sides_12_34(plane);
    let d = -0.5 * (c4.x / c4.y + (c3.x - c2.x) / c3.y);
    let p = plane.map(|c| xa - c.x - d * c.y);
    let b = ((xa - c4.x) * d + c4.y) / ((xa - c4.x) - c4.y * d);
    p[0] * p[1] / (p[2] * p[3]) * area(plane) / (2.0 * material.shear_modulus)
        * (1.0 + skewness_weight(material) * (b * b + b * d + d * d))
}

/// $Z$ of a shear panel without parallel sides, in⁴/lbf; as [`parallelogram_energy`] otherwise.
///
/// With $(x_a, 0)$ where sides 1-2 and 3-4 meet, $(x_b, y_b)$ where 1-4 and 2-3 do, $l$ the distance between the two,
/// $D = (x_a - x_b)/y_b$, $p_i = (y_b/l)(x_a - X_i - D Y_i)$ the distance of corner $i$ from the line through both,
/// $c = l/p_1 - D$, $b = l/p_4 - c$ and $a = l/p_2 - D$,
///
/// $$ Z = \frac{p_1 p_2}{p_3 p_4} \frac{1}{2G} \Big(A + \frac{4}{1+\nu}\big(F - \tfrac23 A\big)\Big), $$
/// $$ F = \frac{p_1 p_2 p_3 p_4}{2 l^2} \Big( w(a,b) + w(c,D) - w(b,c) - w(D,a)
///    {} + \tfrac{1}{10}\big((a^2-c^2)(b^3-D^3) + (b^2-D^2)(a^3-c^3)\big) $$
/// $$ \qquad - \tfrac15 \big((a-c)(b^4-D^4) + (b-D)(a^4-c^4)\big) \Big), $$
/// $$ w(u,v) = \big(u + v + \tfrac23 (u^3+v^3) + \tfrac15 (u^5+v^5)\big) \ln|u+v| . $$
///
/// The terms of $F$ grow as the fifth power of the distance of the meeting points and cancel: near parallel sides
/// the form loses its digits.
pub fn no_sides_parallel_energy(plane: &Flat, material: &Material) -> f64 {
    let xa = meeting_of_sides_12_34(plane);
    let (xb, yb) = meeting_of_sides_14_23(plane);
    let l = (xa - xb).hypot(yb);
    let d = (xa - xb) / yb;
    let p = plane.map(|corner| yb / l * (xa - corner.x - d * corner.y));
    let c = l / p[0] - d;
    let b = l / p[3] - c;
    let a = l / p[1] - d;
    let w = |u: f64, v: f64| {
        let odd = u + v + (u.powi(3) + v.powi(3)) / 1.5 + (u.powi(5) + v.powi(5)) / 5.0;
        odd * (u + v).abs().ln()
    };
    let powers = |n: i32, m: i32| {
        (a.powi(n) - c.powi(n)) * (b.powi(m) - d.powi(m))
            + (b.powi(n) - d.powi(n)) * (a.powi(m) - c.powi(m))
    };
    let f = p.iter().product::<f64>() / (2.0 * l * l)
        * (w(a, b) + w(c, d) - w(b, c) - w(d, a) + 0.1 * powers(2, 3) - 0.2 * powers(1, 4));
    p[0] * p[1] / (p[2] * p[3]) / (2.0 * material.shear_modulus)
        * (area(plane) + 6.0 * skewness_weight(material) * (f - area(plane) / 1.5))
}

/// $\frac23/(1+\nu)$: how much the direct stresses of a panel that is not a rectangle weigh.
fn skewness_weight(material: &Material) -> f64 {
    1.0 / (1.5 * (1.0 + material.poissons_ratio))
}

/// Where side 3-4 meets the line of side 1-2, the first axis.
fn meeting_of_sides_12_34(plane: &Flat) -> f64 {
    let [_, _, c3, c4] = *plane;
    c4.x - c4.y * (c3.x - c4.x) / (c3.y - c4.y)
}

fn meeting_of_sides_14_23(plane: &Flat) -> (f64, f64) {
    let [_, c2, c3, c4] = *plane;
    let along = c2.x * c3.y / (c3.y * c4.x - c4.y * (c3.x - c2.x));
    (along * c4.x, along * c4.y)
}

/// How the ends of a chain are supported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChainEnds {
    /// A spring from the first mass to ground and one from the last.
    FixedFixed,
    /// A spring from the first mass to ground alone.
    FixedFree,
    /// Springs between the masses alone: the first eigenvalue is zero, a rigid-body motion.
    FreeFree,
}

/// Eigenvalues $\omega_j^2$, ascending, of $n$ equal masses in a row joined by equal springs, rad²/s².
///
/// $$ \omega_j^2 = \frac{4k}{m} \sin^2 \frac{\theta_j}{2}, \qquad
///    \theta_j = \frac{j\pi}{n+1}, \quad \frac{(2j-1)\pi}{2n+1}, \quad \frac{(j-1)\pi}{n} $$
///
/// for fixed-fixed, fixed-free and free-free ends. `spring` in lbf/in, `mass` in lbf·s²/in.
///
/// Source: Timoshenko, Young and Weaver, *Vibration Problems in Engineering*.
pub fn chain_eigenvalues(ends: ChainEnds, count: usize, spring: f64, mass: f64) -> Vec<f64> {
    let n = count as f64;
    let share = |j: f64| match ends {
        ChainEnds::FixedFixed => j / (n + 1.0),
        ChainEnds::FixedFree => (2.0 * j - 1.0) / (2.0 * n + 1.0),
        ChainEnds::FreeFree => (j - 1.0) / n,
    };
    (1..=count)
        .map(|j| 4.0 * spring / mass * (0.5 * PI * share(j as f64)).sin().powi(2))
        .collect()
}

/// Frequencies of a uniform rod fixed at one end, vibrating along itself, ascending, Hz.
///
/// $$ f_j = \frac{2j-1}{4L} \sqrt{E/\rho} $$
///
/// `length` in inches, `youngs_modulus` in lbf/in², `density` (mass per volume) in lbf·s²/in⁴.
///
/// Source: Timoshenko, Young and Weaver, *Vibration Problems in Engineering*.
pub fn fixed_free_rod_frequencies_hz(
    length: f64,
    youngs_modulus: f64,
    density: f64,
    count: usize,
) -> Vec<f64> {
    let fundamental = (youngs_modulus / density).sqrt() / (4.0 * length);
    (1..=count)
        .map(|j| (2 * j - 1) as f64 * fundamental)
        .collect()
}
