//! Projection of the box on the paper: a quasi-isometric view or a plan, scaled to the room it is given.

use super::canvas::{Area, Drawn, Pen, Place, line};
use nalgebra::Vector3;

/// Rise of the two plan axes on the paper, degrees.
const RISE: f64 = 27.0;
/// Directions of the axes in the quasi-isometric view.
pub const AXES: &str = "x right and down, y right and up, z up";

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

    /// The quasi-isometric view, z drawn so many times as large.
    pub fn rising(heights: f64) -> Self {
        let (sin, cos) = RISE.to_radians().sin_cos();
        Self::unit(
            Vector3::new(cos, cos, 0.0),
            Vector3::new(sin, -sin, -heights),
        )
    }

    /// The plan, y to the right and x down.
    pub fn plan() -> Self {
        Self::unit(Vector3::y(), Vector3::x())
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
