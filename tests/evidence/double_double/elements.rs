//! The box's elements and load distribution from its coordinates, in double-double.

use crate::common::double_double::Dd;
use crate::common::double_double_matrices::{Rows, rows};
use corfem::method::structure::ElementKind;
use corfem::torque_box::wing_box::Reconstruction;

pub type Point = [Dd; 3];

/// Young's modulus, Poisson's ratio and shear modulus.
#[derive(Debug, Clone, Copy)]
pub struct Material {
    e: Dd,
    nu: Dd,
    g: Dd,
}

pub fn number(value: f64) -> Dd {
    Dd::from(value)
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn times(scale: Dd, a: Point) -> Point {
    a.map(|component| scale * component)
}

fn dot(a: &[Dd], b: &[Dd]) -> Dd {
    a.iter().zip(b).map(|(&a, &b)| a * b).sum()
}

fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: Point) -> Point {
    times(dot(&a, &a).sqrt().recip(), a)
}

fn outer(scale: Dd, a: &[Dd]) -> Rows {
    rows(a.len(), a.len(), |i, j| scale * a[i] * a[j])
}

impl Material {
    pub fn of(reconstruction: &Reconstruction) -> Self {
        let (e, nu) = (
            number(reconstruction.youngs_modulus),
            number(reconstruction.poissons_ratio),
        );
        Self {
            e,
            nu,
            g: e / (number(2.0) * (Dd::ONE + nu)),
        }
    }

    /// The stiffness of an element of unit size.
    pub fn element(&self, kind: ElementKind, corners: &[Point]) -> Rows {
        match (kind, corners) {
            (ElementKind::Rod, &[a, b]) => {
                let along = minus(b, a);
                let n = unit(along);
                outer(
                    self.e / dot(&along, &along).sqrt(),
                    &[-n[0], -n[1], -n[2], n[0], n[1], n[2]],
                )
            }
            (ElementKind::ShearPanel, &[a, b, c, d]) => self.shear_panel([a, b, c, d]),
            (ElementKind::Membrane, &[a, b, c, d]) => self.membrane([a, b, c, d]),
            _ => panic!("the box has no {kind:?} of {} corners", corners.len()),
        }
    }

    /// Half of each of the four triangles that two diagonals make.
    fn membrane(&self, corners: [Point; 4]) -> Rows {
        let mut sum = rows(12, 12, |_, _| Dd::ZERO);
        for triangle in [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]] {
            let part = self.triangle(triangle.map(|n| corners[n]));
            for i in 0..9 {
                for j in 0..9 {
                    let (row, column) = (3 * triangle[i / 3] + i % 3, 3 * triangle[j / 3] + j % 3);
                    sum[row][column] += number(0.5) * part[i][j];
                }
            }
        }
        sum
    }

    fn triangle(&self, [a, b, c]: [Point; 3]) -> Rows {
        let normal = cross(minus(b, a), minus(c, a));
        let area = number(0.5) * dot(&normal, &normal).sqrt();
        let (i, k) = (unit(minus(b, a)), unit(normal));
        let j = cross(k, i);
        let mut strain = rows(3, 9, |_, _| Dd::ZERO);
        for (n, opposite) in [minus(c, b), minus(a, c), minus(b, a)]
            .into_iter()
            .enumerate()
        {
            let gradient = times((area + area).recip(), cross(k, opposite));
            let (dx, dy) = (dot(&gradient, &i), dot(&gradient, &j));
            for axis in 0..3 {
                strain[0][3 * n + axis] = dx * i[axis];
                strain[1][3 * n + axis] = dy * j[axis];
                strain[2][3 * n + axis] = dy * i[axis] + dx * j[axis];
            }
        }
        let e = area * self.e / (Dd::ONE - self.nu * self.nu);
        rows(9, 9, |p, q| {
            let [[xp, xq], [yp, yq], [sp, sq]] =
                [0, 1, 2].map(|row: usize| [strain[row][p], strain[row][q]]);
            e * (xp * xq + yp * yq + self.nu * (xp * yq + yp * xq)) + area * self.g * sp * sq
        })
    }

    /// Garvey's panel: the energy of its field by the crate's own rule of twelve points a side, which is part of the method.
    fn shear_panel(&self, x: [Point; 4]) -> Rows {
        let (d13, d24) = (minus(x[2], x[0]), minus(x[3], x[1]));
        let k = unit(cross(d13, d24));
        let side = minus(x[1], x[0]);
        let i = unit(minus(side, times(dot(&side, &k), k)));
        let j = cross(k, i);
        let flat = x.map(|corner| {
            let at = minus(corner, x[0]);
            [dot(&at, &i), dot(&at, &j), Dd::ONE]
        });
        let sides: Vec<Point> = (0..4).map(|n| cross(flat[n], flat[(n + 1) % 4])).collect();
        let (p, q) = (cross(sides[0], sides[2]), cross(sides[1], sides[3]));
        let line = cross(p, q);
        let (one, two, quarter) = (Dd::ONE, number(2.0), number(0.25));
        let mut energy = Dd::ZERO;
        let rule = gauss_legendre(12);
        for &(s, ws) in &rule {
            for &(t, wt) in &rule {
                let (mut at, mut by_s, mut by_t) = ([Dd::ZERO; 3], [Dd::ZERO; 3], [Dd::ZERO; 3]);
                for (corner, (a, b)) in
                    flat.iter()
                        .zip([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
                {
                    let (a, b) = (number(a), number(b));
                    for axis in 0..3 {
                        at[axis] += quarter * (one + a * s) * (one + b * t) * corner[axis];
                        by_s[axis] += quarter * a * (one + b * t) * corner[axis];
                        by_t[axis] += quarter * b * (one + a * s) * corner[axis];
                    }
                }
                let determinant = by_s[0] * by_t[1] - by_s[1] * by_t[0];
                let at_point = dot(&line, &at);
                let flow = dot(&line, &flat[0]) * dot(&line, &flat[1]) / (at_point * at_point);
                let [to_p, to_q] =
                    [p, q].map(|end| [end[0] - end[2] * at[0], end[1] - end[2] * at[1]]);
                let cotangent = dot(&to_p, &to_q) / (to_p[0] * to_q[1] - to_p[1] * to_q[0]);
                let strain = one + two * cotangent * cotangent / (one + self.nu);
                energy += ws * wt * determinant * flow * flow / (two * self.g) * strain;
            }
        }
        let (x2, y3, x4, y4) = (flat[1][0], flat[2][1], flat[3][0], flat[3][1]);
        let tau = x4 * y3 - flat[2][0] * y4;
        let f1 = times(-number(0.5) * x2 * y4 / tau, d13);
        let f2 = times(number(0.5) * x2 * y3 / (tau - x2 * (y3 - y4)), d24);
        let forces: Vec<Dd> = [f1, f2, f1.map(|f| -f), f2.map(|f| -f)].concat();
        outer((two * energy).recip(), &forces)
    }
}

/// Points and weights on (−1, 1), by Newton's method on Legendre's polynomial.
fn gauss_legendre(count: usize) -> Vec<(Dd, Dd)> {
    let legendre = |s: Dd| {
        let (mut before, mut value) = (Dd::ONE, s);
        for m in 2..=count {
            let (m, of) = (number(m as f64), number((2 * m - 1) as f64));
            (before, value) = (value, (of * s * value - (m - Dd::ONE) * before) / m);
        }
        (
            value,
            number(count as f64) * (s * value - before) / (s * s - Dd::ONE),
        )
    };
    let point = |k: usize| {
        let start = number((std::f64::consts::PI * (k as f64 - 0.25) / (count as f64 + 0.5)).cos());
        let s = (0..8).fold(start, |s, _| {
            let (value, slope) = legendre(s);
            s - value / slope
        });
        let slope = legendre(s).1;
        (s, number(2.0) / ((Dd::ONE - s * s) * slope * slope))
    };
    (1..=count).rev().map(point).collect()
}

/// The load distribution: 36 structural by nine dynamic DOF.
pub fn load_distribution(reconstruction: &Reconstruction) -> Rows {
    let at = |grid: usize| reconstruction.grids[&grid].map(number);
    let xi = number(reconstruction.mid_chord_fraction);
    let (two, three) = (number(2.0), number(3.0));
    let (square, cube) = (xi * xi, xi * xi * xi);
    let hermite = [
        Dd::ONE - three * square + two * cube,
        xi - two * square + cube,
        three * square - two * cube,
        cube - square,
    ];
    let mut t = rows(36, 9, |_, _| Dd::ZERO);
    for rib in 0..3 {
        let [rear_upper, rear_lower, front_upper, front_lower] =
            [1, 2, 3, 4].map(|corner| 4 * rib + corner);
        let chord = minus(at(front_upper), at(rear_upper));
        let mid = 3 * rib + 1;
        for (upper, lower, own, displacement, rotation) in [
            (rear_upper, rear_lower, mid - 1, hermite[0], hermite[1]),
            (front_upper, front_lower, mid + 1, hermite[2], hermite[3]),
        ] {
            let couple = rotation / (at(upper)[2] - at(lower)[2]);
            for (grid, sign) in [(upper, -1.0), (lower, 1.0)] {
                let row = 3 * (grid - 1);
                t[row + 2][own] = number(0.5);
                t[row + 2][mid] = number(0.5) * displacement;
                t[row][mid] = number(sign) * couple * chord[0];
                t[row + 1][mid] = number(sign) * couple * chord[1];
            }
        }
    }
    t
}
