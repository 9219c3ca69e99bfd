//! Strategies of elements: materials, convex panels flat and warped, anywhere in space.

use crate::prelude::*;

/// An isotropic material: a modulus between plastic and tungsten, every Poisson's ratio from a foam's to nearly that
/// of rubber; shrinks to ν = 0. (At ν = 1/2 plane stress is still regular; at −1 it is not.)
pub fn material() -> impl Strategy<Value = Material> {
    (5.5..7.7_f64, -0.5..0.49)
        .prop_map(|(decades, nu)| Material::isotropic(10f64.powf(decades), nu).unwrap())
}

/// A convex quadrilateral in the xy-plane, through its diagonals: they cross 50 to 130 degrees apart, and each half of
/// one is 0.4 to 1 of the size, which is 0.5 to 20 in. Every convex quadrilateral arises so; the bounds keep the
/// corners off 0 and 180 degrees. Shrinks to a square.
pub fn flat_panel() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    (
        prop::array::uniform4(0.0..0.6_f64),
        -40.0..40.0_f64,
        -1.0..4.3_f64,
    )
        .prop_map(|(cuts, skew, doublings)| {
            let size = doublings.exp2();
            std::array::from_fn(|corner| {
                let angle =
                    (90.0 * corner as f64 + if corner % 2 == 1 { skew } else { 0.0 }).to_radians();
                (1.0 - cuts[corner]) * size * Vector3::new(angle.cos(), angle.sin(), 0.0)
            })
        })
}

/// A flat panel with its corners moved out of plane, up and down by turns, by 4 to 30 percent of its first diagonal.
pub fn warped_panel() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    (flat_panel(), 0.04..0.3_f64).prop_map(|(mut corners, warp)| {
        let height = warp * (corners[2] - corners[0]).norm();
        for (corner, sign) in corners.iter_mut().zip([1.0, -1.0, 1.0, -1.0]) {
            corner.z += sign * height;
        }
        corners
    })
}

/// A trapezoid in the xy-plane with sides 1-2 and 3-4 along x, the second 0.3 to 0.8 of the first, either leaning.
pub fn trapezoid() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    (1.0..20.0_f64, 0.2..0.7_f64, -0.5..0.5_f64, 0.3..1.5_f64).prop_map(
        |(base, taper, lean, height)| {
            let at = |x: f64, y: f64| Vector3::new(base * x, base * y, 0.0);
            let left = 0.5 * taper + lean;
            [
                at(0.0, 0.0),
                at(1.0, 0.0),
                at(left + 1.0 - taper, height),
                at(left, height),
            ]
        },
    )
}

/// A panel in the xy-plane of which no two sides are parallel: each pair of opposite sides meets 1 to 5 sides away.
pub fn general_panel() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    panel_in_perspective(0.2, 1.0)
}

/// The same with sides that meet less than half a side away: the longest side is some ten times the shortest.
pub fn distorted_panel() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    panel_in_perspective(2.0, 5.0)
}

/// A square seen in perspective, then stretched and sheared, numbered from any corner. Of a unit square both pairs of
/// sides meet 1/`least` to 1/`most` away, so bounds above zero keep every pair from being parallel.
fn panel_in_perspective(least: f64, most: f64) -> impl Strategy<Value = [Vector3<f64>; 4]> {
    (
        prop::array::uniform2(least..most),
        -0.5..0.5_f64,
        0.5..2.0_f64,
        0..4_usize,
    )
        .prop_map(|([across, up], lean, aspect, start)| {
            let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
            std::array::from_fn(|corner| {
                let (u, v) = square[(corner + start) % 4];
                let nearness = 1.0 / (1.0 + across * u + up * v);
                10.0 * nearness * Vector3::new(u + lean * v, aspect * v, 0.0)
            })
        })
}

/// A parallelogram in the xy-plane of 1 to 20 in, leaning up to 45 degrees.
pub fn parallelogram() -> impl Strategy<Value = [Vector3<f64>; 4]> {
    (1.0..20.0_f64, 0.3..2.0_f64, -1.0..1.0_f64).prop_map(|(base, aspect, lean)| {
        let side = base * Vector3::new(1.0, 0.0, 0.0);
        let up = base * aspect * Vector3::new(lean, 1.0, 0.0);
        [Vector3::zeros(), side, side + up, up]
    })
}

/// Turns corners and moves them away from the origin, within 100 in: coordinates then carry absolute errors of about
/// 1e-14 in, up to 1e-13 of the panel's size.
pub fn placed<const N: usize>(
    corners: impl Strategy<Value = [Vector3<f64>; N]>,
) -> impl Strategy<Value = [Vector3<f64>; N]> {
    (corners, rotation(), point())
        .prop_map(|(corners, turn, origin)| corners.map(|corner| origin + turn * corner))
}

/// An element of any kind somewhere in space.
#[derive(Debug, Clone)]
pub struct Sample {
    pub kind: ElementKind,
    pub corners: Vec<Vector3<f64>>,
    pub warped: bool,
    pub material: Material,
}

impl Sample {
    /// Its unit stiffness.
    pub fn stiffness(&self) -> DMatrix<f64> {
        unit_stiffness(self.kind, &self.corners, &self.material)
    }

    /// The same element turned about the origin.
    pub fn turned(&self, turn: &Rotation3<f64>) -> Self {
        let corners = self.corners.iter().map(|corner| turn * corner).collect();
        Self {
            corners,
            ..self.clone()
        }
    }

    /// The same element with its corners named in another order.
    pub fn renumbered(&self, order: &[usize]) -> Self {
        let corners = order.iter().map(|&corner| self.corners[corner]).collect();
        Self {
            corners,
            ..self.clone()
        }
    }

    /// Rank the theory gives its stiffness.
    pub fn rank(&self) -> usize {
        match (self.kind, self.warped) {
            (ElementKind::Rod | ElementKind::ShearPanel, _) => 1,
            (ElementKind::Triangle, _) => 3,
            (ElementKind::Membrane, false) => 5,
            (ElementKind::Membrane, true) => 6,
        }
    }
}

/// Any element: its corners are those of a panel (the first two for a rod, the first three for a triangle).
pub fn sample() -> impl Strategy<Value = Sample> {
    let kinds = [
        ElementKind::Rod,
        ElementKind::Triangle,
        ElementKind::ShearPanel,
        ElementKind::Membrane,
    ];
    let corners = prop_oneof![
        placed(flat_panel()).prop_map(|corners| (corners, false)),
        placed(warped_panel()).prop_map(|corners| (corners, true)),
    ];
    (prop::sample::select(kinds.to_vec()), corners, material()).prop_map(
        |(kind, (corners, warped), material)| Sample {
            kind,
            corners: corners[..kind.corner_count()].to_vec(),
            warped,
            material,
        },
    )
}

/// A shear panel or membrane, flat or warped.
pub fn panel_sample() -> impl Strategy<Value = Sample> {
    sample().prop_filter_map("a rod or triangle", |sample| {
        (sample.corners.len() == 4).then_some(sample)
    })
}
