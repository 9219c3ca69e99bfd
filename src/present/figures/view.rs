//! How the box falls on the paper: the quasi-isometric view and the plan, each scaled to the room it is given.

use super::canvas::Place;
use super::planform::PlanPoint;
use nalgebra::Vector3;

/// How many times the box's depth is drawn, which is a twentieth of its span.
pub(super) const DEPTH_DRAWN: f64 = 7.0;
/// Rise of the two plan axes on the paper, degrees.
const RISE: f64 = 27.0;

/// Room on the paper: left, top, width, height, px.
pub(super) type Room = [f64; 4];

/// The quasi-isometric view, its scale in px to an inch of plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub origin: Place,
    pub scale: f64,
    /// How many times heights are drawn.
    pub heights: f64,
}

impl View {
    /// The view that shows the given points as large as there is room, in its middle.
    pub fn fitted(points: &[Vector3<f64>], heights: f64, room: Room) -> Self {
        let unit = Self { origin: (0.0, 0.0), scale: 1.0, heights };
        let places: Vec<Place> = points.iter().map(|&point| unit.place(point)).collect();
        let (scale, origin) = fit(&places, room);
        Self { origin, scale, heights }
    }

    /// Outboard goes right and up, aft right and down, up goes up.
    pub fn place(&self, at: Vector3<f64>) -> Place {
        let (sin, cos) = RISE.to_radians().sin_cos();
        let y = sin * (at.x - at.y) - self.heights * at.z;
        (self.origin.0 + self.scale * cos * (at.y + at.x), self.origin.1 + self.scale * y)
    }
}

/// The plan: the root at the left, the tip at the right, forward up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    origin: Place,
    scale: f64,
}

impl Plan {
    /// The plan that shows the given points as large as there is room, in its middle.
    pub fn fitted(points: &[PlanPoint], room: Room) -> Self {
        let places: Vec<Place> = points.iter().map(|&[x, y]| (y, x)).collect();
        let (scale, origin) = fit(&places, room);
        Self { origin, scale }
    }

    pub fn place(&self, [x, y]: PlanPoint) -> Place {
        (self.origin.0 + self.scale * y, self.origin.1 + self.scale * x)
    }
}

/// Scale and origin that bring places at unit scale into a room.
fn fit(places: &[Place], [left, top, width, height]: Room) -> (f64, Place) {
    let bounds = |coordinate: fn(&Place) -> f64| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        places.iter().map(coordinate).fold(ends, |(low, high), value| (value.min(low), value.max(high)))
    };
    let (x_low, x_high) = bounds(|place| place.0);
    let (y_low, y_high) = bounds(|place| place.1);
    let scale = (width / (x_high - x_low)).min(height / (y_high - y_low));
    let origin = (left + 0.5 * (width - scale * (x_low + x_high)), top + 0.5 * (height - scale * (y_low + y_high)));
    (scale, origin)
}
