//! The box in plan, and the z displacement between its nine dynamic points.
//!
//! **Along a rib.** The mid point of a rib rides on Hermite's cubics between the spars
//! ([`crate::cases::torque_box::load_distribution`]). Test modes hold three displacements of a rib, rear $w_r$, mid
//! $w_m$ and front $w_f$, and no rotations: of all such cubics the one is taken whose ends turn by equal and opposite
//! angles from the chord line, as in pure bending. Its cubic terms cancel:
//!
//! $$ w(\xi) = (1-\xi) w_r + \xi w_f + \kappa \xi(1-\xi), \qquad
//!    \kappa = \frac{w_m - (1-\xi_m) w_r - \xi_m w_f}{\xi_m(1-\xi_m)} $$
//!
//! with $\xi$ from the rear spar and $\xi_m$ the mid point's. What the rotations would add is known in the model: below
//! 4 percent of the largest displacement in modes 1 to 5 of the cases, up to 31 percent in the chordwise bending of 6
//! and 8.
//!
//! **Between ribs** the displacement is linear along lines of equal $\xi$, and zero at the root. In the inboard bay a
//! node line is therefore straight.

use crate::cases::torque_box::Reconstruction;

/// A place in plan: x aft, y outboard, in.
pub type PlanPoint = [f64; 2];

/// Ribs with the root, from the tip in.
const RIBS: usize = 4;
/// Parts a stretch of node line is drawn in.
const PARTS: usize = 24;

/// The box in plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Planform {
    /// Rear and front end of every rib, from the tip in, the root last.
    pub ribs: [[PlanPoint; 2]; RIBS],
    /// Where the mid point of a rib lies, from the rear.
    pub mid_chord_fraction: f64,
}

/// Displacement along a rib, $w_r + s\xi - \kappa\xi^2$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RibShape {
    rear: f64,
    slope: f64,
    curvature: f64,
}

impl RibShape {
    /// The displacement along a rib through its rear, mid and front values.
    pub fn through([rear, mid, front]: [f64; 3], mid_chord_fraction: f64) -> Self {
        let xi = mid_chord_fraction;
        let curvature = (mid - (1.0 - xi) * rear - xi * front) / (xi * (1.0 - xi));
        Self { rear, slope: front - rear + curvature, curvature }
    }

    /// The displacement at a fraction of the chord from the rear.
    pub fn at(&self, xi: f64) -> f64 {
        self.rear + xi * (self.slope - xi * self.curvature)
    }

    /// Where it vanishes between the spars, in ascending order.
    pub fn zeros(&self) -> Vec<f64> {
        // -κξ² + sξ + w = 0, by the form of the quadratic's roots that does not cancel.
        let Self { rear, slope, curvature } = *self;
        // Without real roots they are NaN, which lies nowhere between the spars.
        let root = (slope * slope + 4.0 * curvature * rear).sqrt();
        let larger = -0.5 * (slope + slope.signum() * root);
        let mut zeros = vec![-larger / curvature, rear / larger];
        zeros.retain(|xi| (0.0..=1.0).contains(xi));
        zeros.sort_by(f64::total_cmp);
        zeros.dedup();
        zeros
    }
}

impl Planform {
    /// The plan of a box: the ends of a rib are its upper grids.
    pub fn of(reconstruction: &Reconstruction) -> Self {
        let position = |grid: usize| reconstruction.grids.get(&grid).copied().unwrap_or_default();
        let end = |grid| [position(grid)[0], position(grid)[1]];
        let ribs = std::array::from_fn(|rib| [end(4 * rib + 1), end(4 * rib + 3)]);
        Self { ribs, mid_chord_fraction: reconstruction.mid_chord_fraction }
    }

    /// The place at a fraction of the chord of a rib.
    pub fn on_rib(&self, rib: usize, xi: f64) -> PlanPoint {
        let [rear, front] = self.ribs[rib];
        toward(rear, front, xi)
    }

    /// The nine dynamic points, in the order of the DOF.
    pub fn dynamic_points(&self) -> Vec<PlanPoint> {
        (0..RIBS - 1).flat_map(|rib| [0.0, self.mid_chord_fraction, 1.0].map(|xi| self.on_rib(rib, xi))).collect()
    }

    /// Displacement along the ribs from the nine dynamic points, the root's zero.
    pub fn rib_shapes(&self, shape: &[f64; 9]) -> [RibShape; RIBS] {
        let values = |rib: usize| shape.as_chunks::<3>().0.get(rib).copied().unwrap_or_default();
        std::array::from_fn(|rib| RibShape::through(values(rib), self.mid_chord_fraction))
    }

    /// Node lines: where the displacement vanishes away from the root, as polylines.
    ///
    /// In a bay between ribs with displacements $a(\xi)$ and $b(\xi)$ the line is $\eta = a/(a-b)$ of the way from the
    /// one to the other wherever they differ in sign, and so it begins and ends at their zeros or at a spar.
    pub fn node_lines(&self, shape: &[f64; 9]) -> Vec<Vec<PlanPoint>> {
        let ribs = self.rib_shapes(shape);
        let mut lines = Vec::new();
        for bay in 0..RIBS - 2 {
            let (a, b) = (ribs[bay], ribs[bay + 1]);
            let mut ends = [vec![0.0, 1.0], a.zeros(), b.zeros()].concat();
            ends.sort_by(f64::total_cmp);
            for (from, to) in ends.iter().zip(&ends[1..]) {
                let middle = 0.5 * (from + to);
                if a.at(middle) * b.at(middle) >= 0.0 {
                    continue;
                }
                let point = |part: usize| {
                    let xi = from + (to - from) * part as f64 / PARTS as f64;
                    let eta = (a.at(xi) / (a.at(xi) - b.at(xi))).clamp(0.0, 1.0);
                    toward(self.on_rib(bay, xi), self.on_rib(bay + 1, xi), eta)
                };
                lines.push((0..=PARTS).map(point).collect());
            }
        }
        let last = RIBS - 2;
        let inboard = |xi| vec![self.on_rib(last, xi), self.on_rib(RIBS - 1, xi)];
        lines.extend(ribs[last].zeros().into_iter().map(inboard));
        lines
    }
}

fn toward([x, y]: PlanPoint, [u, v]: PlanPoint, share: f64) -> PlanPoint {
    [x + share * (u - x), y + share * (v - y)]
}
