//! The box with its structural and dynamic points (Figure 2).

use super::canvas::{
    Area, BLUE, Drawn, Form, INK, LETTERS, Letters, Pen, SILVER, SMALL, Side, VERMILION, WIDTH, line, mark, svg, write,
};
use super::planform::Planform;
use super::view::{DEPTH_DRAWN, View};
use crate::cases::Case;
use crate::present::error::PresentError;
use nalgebra::Vector3;

/// A structural grid point.
#[derive(Debug, Clone, PartialEq)]
pub struct StructuralPoint {
    /// Its number.
    pub grid: usize,
    /// Position, in: x aft, y outboard, z up.
    pub position: Vector3<f64>,
    /// Whether it is constrained in all directions.
    pub fixed: bool,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxPoints {
    /// The sixteen structural points.
    pub structural: Vec<StructuralPoint>,
    /// The nine dynamic points at mid-depth, in; z motion alone.
    pub dynamic: Vec<Vector3<f64>>,
    /// Edges of the panels, as grids.
    pub edges: Vec<[usize; 2]>,
}

/// Points of a case's box.
///
/// # Errors
/// Those of [`Case::model`].
pub fn box_points(case: &Case) -> Result<BoxPoints, PresentError> {
    let model = case.model()?;
    let structural: Vec<StructuralPoint> = model
        .structure()
        .grids()
        .iter()
        .map(|grid| StructuralPoint { grid: grid.label, position: grid.position, fixed: grid.constrained == [true; 3] })
        .collect();
    let dynamic =
        Planform::of(&case.reconstruction).dynamic_points().into_iter().map(|[x, y]| Vector3::new(x, y, 0.0)).collect();
    let mut edges: Vec<[usize; 2]> = Vec::new();
    for panel in &case.panels {
        for (k, &from) in panel.grids.iter().enumerate() {
            let to = panel.grids[(k + 1) % panel.grids.len()];
            let edge = [from.min(to), from.max(to)];
            if !edges.contains(&edge) {
                edges.push(edge);
            }
        }
    }
    Ok(BoxPoints { structural, dynamic, edges })
}

const STRUCTURAL: (Form, f64) = (Form::Circle, 4.0);
const DYNAMIC: (Form, f64) = (Form::Square, 4.5);

impl BoxPoints {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let title = "The wing torque box: structural and dynamic points";
        svg("box_points", title, (WIDTH, 480.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let positions: Vec<_> = self.structural.iter().map(|point| point.position).collect();
        let view = View::fitted(&positions, DEPTH_DRAWN, [40.0, 24.0, 680.0, 420.0]);
        let at = |grid: usize| {
            self.structural.iter().find(|point| point.grid == grid).map(|point| view.place(point.position))
        };
        for &[from, to] in &self.edges {
            if let (Some(a), Some(b)) = (at(from), at(to)) {
                let hidden = self.is_hidden(from) || self.is_hidden(to);
                let (color, width) = if hidden { (SILVER, 0.9) } else { (INK, 1.1) };
                line(area, &[a, b], Pen::solid(color, width))?;
            }
        }
        for (row, point) in self.dynamic.iter().enumerate() {
            let (x, y) = view.place(*point);
            // Rear points are numbered to the right and front ones to the left, but where a line passes there; of the mid
            // ones the tip's has no room beside it and a thin line leads to its number outside.
            let (place, side) = match row {
                1 => ((x + 4.0, y - 34.0), Side::Center),
                4 => ((x, y - 12.0), Side::Center),
                7 => ((x, y + 14.0), Side::Center),
                0 | 6 => ((x + 8.0, y), Side::Right),
                _ => ((x - 9.0, y), Side::Left),
            };
            if row == 1 {
                let lead = [(x, y), (x + 3.0, y - 27.0)];
                line(area, &lead, Pen::solid(VERMILION, 0.8))?;
            }
            mark_dynamic(area, (x, y))?;
            let letters = Letters::new(SMALL, side).color(VERMILION);
            write(area, &format!("D{}", row + 1), place, letters)?;
        }
        for point in &self.structural {
            let (x, y) = view.place(point.position);
            let fill = if point.fixed { INK } else { plotters::style::WHITE };
            mark(area, (x, y), STRUCTURAL, Some(fill), Pen::solid(BLUE, 1.6))?;
            // Away from the lines: rear points are numbered to the lower right, front ones above or below.
            let (place, side) = match point.grid % 4 {
                1 | 2 => ((x + 8.0, y + 11.0), Side::Right),
                3 => ((x - 2.0, y - 15.0), Side::Center),
                _ => ((x, y + 16.0), Side::Center),
            };
            let letters = Letters::new(LETTERS, side).bold().color(BLUE);
            write(area, &point.grid.to_string(), place, letters)?;
        }
        self.legend(area)?;
        axes(area, (70.0, 90.0))
    }

    /// The view looks down at the upper covers, the rear spar and the root: lower front points lie behind.
    fn is_hidden(&self, grid: usize) -> bool {
        let fixed = |point: &StructuralPoint| point.grid == grid && point.fixed;
        grid.is_multiple_of(4) && !self.structural.iter().any(fixed)
    }

    fn legend(&self, area: &Area) -> Drawn {
        let (x, mut y) = (430.0, 400.0);
        let words = Letters::new(LETTERS, Side::Right);
        let fixed = [(plotters::style::WHITE, "structural point: x, y and z motion"), (INK, "structural point, fixed")];
        for (fill, text) in fixed {
            mark(area, (x, y), STRUCTURAL, Some(fill), Pen::solid(BLUE, 1.6))?;
            write(area, text, (x + 12.0, y), words)?;
            y += 20.0;
        }
        mark_dynamic(area, (x, y))?;
        write(area, "dynamic point at mid-depth: z motion", (x + 12.0, y), words)?;
        let note = format!("Depth drawn {DEPTH_DRAWN:.0} times as large as the plan.");
        write(area, &note, (x - 5.0, y + 22.0), words)
    }
}

/// The three directions, with the length that stands for five inches of plan.
pub(super) fn axes(area: &Area, origin: (f64, f64)) -> Drawn {
    let view = View { origin, scale: 11.0, heights: 1.0 };
    for (direction, name, side, shift) in [
        (Vector3::x(), "x, aft", Side::Right, (6.0, 4.0)),
        (Vector3::y(), "y, outboard", Side::Right, (6.0, -4.0)),
        (Vector3::z(), "z, up", Side::Center, (0.0, -10.0)),
    ] {
        let (x, y) = view.place(5.0 * direction);
        line(area, &[origin, (x, y)], Pen::solid(INK, 1.2))?;
        mark(area, (x, y), (Form::Circle, 1.8), Some(INK), Pen::solid(INK, 1.0))?;
        let letters = Letters::new(SMALL, side);
        write(area, name, (x + shift.0, y + shift.1), letters)?;
    }
    Ok(())
}

fn mark_dynamic(area: &Area, at: (f64, f64)) -> Drawn {
    mark(area, at, DYNAMIC, Some(VERMILION), Pen::solid(VERMILION, 1.2))
}
