//! Projection of a structure on the paper: a quasi-isometric view or a plan, scaled to the room it is given.

use super::canvas::{Area, Drawn, Pen, Place, line};
use corfem::present::frame::extents;
use nalgebra::Vector3;

/// Factor by which the box's depth is drawn larger; the depth is a twentieth of its span.
pub const DEPTH_DRAWN: f64 = 7.0;
/// Rise of the two plan axes on the paper, degrees, and where numbers need room in a narrow form.
pub const RISE: f64 = 27.0;
pub const STEEP: f64 = 60.0;
/// Part of the largest extent that a depth is drawn as, if that is at most [`DEPTH_DRAWN`] times itself.
const LEAST_DEPTH: f64 = 0.3;
/// Extent along an axis, of the largest, below which all points lie in one plane.
const FLAT: f64 = 1e-6;

/// Room on the paper: left, top, width, height, px.
pub type Room = [f64; 4];

/// A linear view: what a unit along each axis goes right and down on the paper, and the scale in px to that unit.
#[derive(Debug, Clone, Copy)]
pub struct View {
    pub right: Vector3<f64>,
    pub down: Vector3<f64>,
    pub origin: Place,
    pub scale: f64,
}

/// The least and the greatest coordinates of points; zeros without points.
fn ends(points: impl Iterator<Item = Vector3<f64>>) -> (Vector3<f64>, Vector3<f64>) {
    let both = points.map(|point| (point, point));
    both.reduce(|(low, high), (point, _)| (low.inf(&point), high.sup(&point)))
        .unwrap_or_default()
}

impl View {
    fn unit(right: Vector3<f64>, down: Vector3<f64>) -> Self {
        Self {
            right,
            down,
            origin: (0.0, 0.0),
            scale: 1.0,
        }
    }

    /// y goes right and up, x right and down, both at an angle of so many degrees on the paper; z, drawn so many times as large, goes up.
    pub fn rising(degrees: f64, heights: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Self::unit(
            Vector3::new(cos, cos, 0.0),
            Vector3::new(sin, -sin, -heights),
        )
    }

    /// x and y in plan, the longer of them to the right.
    pub fn plan(points: &[Vector3<f64>]) -> Self {
        let extents = extents(points);
        match extents.y > extents.x {
            true => Self::unit(Vector3::y(), Vector3::x()),
            false => Self::unit(Vector3::x(), -Vector3::y()),
        }
    }

    /// The factor by which the depth of points is drawn.
    pub fn heights(points: &[Vector3<f64>]) -> f64 {
        let extents = extents(points);
        let heights = (LEAST_DEPTH * extents.max() / extents.z)
            .round()
            .clamp(1.0, DEPTH_DRAWN);
        if extents.z > FLAT * extents.max() {
            heights
        } else {
            1.0
        }
    }

    /// The isometric view of points, with the factor by which their depth is drawn.
    pub fn solid(points: &[Vector3<f64>]) -> (Self, f64) {
        let heights = Self::heights(points);
        (Self::rising(RISE, heights), heights)
    }

    /// The plane that all points lie in, by its normal axis, and the view of it; none when there is no such plane.
    pub fn flat(points: &[Vector3<f64>]) -> Option<(Vector3<f64>, Self)> {
        let extents = extents(points);
        let is_flat = |axis: usize| extents[axis] <= FLAT * extents.max();
        match [2, 1, 0].into_iter().find(|&axis| is_flat(axis))? {
            2 => Some((Vector3::z(), Self::plan(points))),
            1 => Some((Vector3::y(), Self::unit(Vector3::x(), -Vector3::z()))),
            _ => Some((Vector3::x(), Self::unit(Vector3::y(), -Vector3::z()))),
        }
    }

    /// A view of no scale yet, scaled to show the given points as large as there is room, in its middle.
    pub fn fitted(self, points: &[Vector3<f64>], [left, top, width, height]: Room) -> Self {
        let (low, high) = ends(
            points
                .iter()
                .map(|&point| self.place(point))
                .map(|(x, y)| Vector3::new(x, y, 0.0)),
        );
        let scale = (width / (high.x - low.x)).min(height / (high.y - low.y));
        // A single point has no extent.
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let twice = scale * (low + high);
        Self {
            origin: (
                left + 0.5 * (width - twice.x),
                top + 0.5 * (height - twice.y),
            ),
            scale,
            ..self
        }
    }

    /// Directions of the axes on the paper, in words.
    pub fn axes(&self) -> String {
        let ways = |axis: usize| {
            let words = [
                (self.right[axis], "right", "left"),
                (self.down[axis], "down", "up"),
            ];
            let ways = words.into_iter().filter(|way| way.0 != 0.0);
            ways.map(|(length, one, other)| if length > 0.0 { one } else { other })
                .collect::<Vec<_>>()
                .join(" and ")
        };
        let named = ["x", "y", "z"]
            .into_iter()
            .zip((0..3).map(ways))
            .filter(|(_, ways)| !ways.is_empty());
        named
            .map(|(axis, ways)| format!("{axis} {ways}"))
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// Draws lines through nodes, each by its places among them.
    pub fn lines(
        &self,
        area: &Area,
        lines: &[Vec<usize>],
        nodes: &[Vector3<f64>],
        pen: Pen,
    ) -> Drawn {
        let points = |nodes_of: &Vec<usize>| {
            nodes_of
                .iter()
                .map(|&node| self.place(nodes[node]))
                .collect::<Vec<_>>()
        };
        lines
            .iter()
            .try_for_each(|nodes_of| line(area, &points(nodes_of), pen))
    }

    pub fn place(&self, at: Vector3<f64>) -> Place {
        (
            self.origin.0 + self.scale * self.right.dot(&at),
            self.origin.1 + self.scale * self.down.dot(&at),
        )
    }
}
