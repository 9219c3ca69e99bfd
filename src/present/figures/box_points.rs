//! The box with its structural and dynamic points (Figure 2).

use super::canvas::*;
use super::planform::Planform;
use super::view::{DEPTH_DRAWN, View};
use crate::cases::Case;
use crate::method::structure::Grid;
use crate::present::PresentError;
use nalgebra::Vector3;
use plotters::style::WHITE;

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxPoints {
    /// The sixteen structural points, constrained in all directions or in none.
    pub structural: Vec<Grid>,
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
    let structural = case.model()?.structure().grids().to_vec();
    let dynamic = Planform::of(&case.reconstruction).dynamic_points();
    let mut edges = Vec::new();
    for panel in &case.panels {
        for (&from, &to) in panel.grids.iter().zip(panel.grids.iter().cycle().skip(1)) {
            let edge = [from.min(to), from.max(to)];
            if !edges.contains(&edge) {
                edges.push(edge);
            }
        }
    }
    Ok(BoxPoints { structural, dynamic: dynamic.into_iter().map(|[x, y]| Vector3::new(x, y, 0.0)).collect(), edges })
}

const DYNAMIC: Mark = Mark(Form::Square, 4.5, Some(VERMILION), Pen(VERMILION, 1.2, Dash::Solid));

fn structural(fixed: bool) -> Mark {
    Mark(Form::Circle, 4.0, Some(if fixed { INK } else { WHITE }), Pen::solid(BLUE, 1.6))
}

impl BoxPoints {
    /// The figure as SVG.
    pub fn draw(&self) -> Result<String, PresentError> {
        svg("box_points", "The wing torque box: structural and dynamic points", 480.0, |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let positions: Vec<_> = self.structural.iter().map(|grid| grid.position).collect();
        let view = View::fitted(&positions, DEPTH_DRAWN, [40.0, 24.0, 680.0, 420.0]);
        let grid = |label: usize| self.structural.iter().find(|grid| grid.label == label);
        let is_fixed = |grid: &Grid| grid.constrained == [true; 3];
        // The view looks down at the upper covers, the rear spar and the root: lower front points lie behind.
        let is_hidden = |grid: &Grid| grid.label.is_multiple_of(4) && !is_fixed(grid);
        for &[from, to] in &self.edges {
            if let (Some(a), Some(b)) = (grid(from), grid(to)) {
                let (color, width) = if is_hidden(a) || is_hidden(b) { (SILVER, 0.9) } else { (INK, 1.1) };
                line(area, &[view.place(a.position), view.place(b.position)], Pen::solid(color, width))?;
            }
        }
        for (row, point) in self.dynamic.iter().enumerate() {
            let (x, y) = view.place(*point);
            // Rear points are numbered to the right and front ones to the left, but where a line passes there; of the
            // mid ones the tip's has no room beside it and a thin line leads to its number outside.
            let (place, side) = match row {
                1 => ((x + 4.0, y - 34.0), MIDDLE),
                4 => ((x, y - 12.0), MIDDLE),
                7 => ((x, y + 14.0), MIDDLE),
                0 | 6 => ((x + 8.0, y), START),
                _ => ((x - 9.0, y), END),
            };
            if row == 1 {
                line(area, &[(x, y), (x + 3.0, y - 27.0)], Pen::solid(VERMILION, 0.8))?;
            }
            mark(area, (x, y), DYNAMIC)?;
            write(area, &format!("D{}", row + 1), place, side.small().color(VERMILION))?;
        }
        for grid in &self.structural {
            let (x, y) = view.place(grid.position);
            mark(area, (x, y), structural(is_fixed(grid)))?;
            // Away from the lines: rear points are numbered to the lower right, front ones above or below.
            let (place, side) = match grid.label % 4 {
                1 | 2 => ((x + 8.0, y + 11.0), START),
                3 => ((x - 2.0, y - 15.0), MIDDLE),
                _ => ((x, y + 16.0), MIDDLE),
            };
            write(area, &grid.label.to_string(), place, side.bold().color(BLUE))?;
        }
        for (y, form, words) in [
            (400.0, structural(false), "structural point: x, y and z motion"),
            (420.0, structural(true), "structural point, fixed"),
            (440.0, DYNAMIC, "dynamic point at mid-depth: z motion"),
        ] {
            marked(area, (430.0, y), form, words)?;
        }
        let note = format!("Depth drawn {DEPTH_DRAWN:.0} times as large as the plan.");
        write(area, &note, (425.0, 462.0), START)?;
        axes(area, (70.0, 90.0))
    }
}

/// The three directions, with the length that stands for five inches of plan.
pub(super) fn axes(area: &Area, origin: Place) -> Drawn {
    let view = View { origin, scale: 11.0, heights: 1.0 };
    for (direction, name, letters, shift) in [
        (Vector3::x(), "x, aft", START, (6.0, 4.0)),
        (Vector3::y(), "y, outboard", START, (6.0, -4.0)),
        (Vector3::z(), "z, up", MIDDLE, (0.0, -10.0)),
    ] {
        let (x, y) = view.place(5.0 * direction);
        line(area, &[origin, (x, y)], Pen::solid(INK, 1.2))?;
        mark(area, (x, y), Mark(Form::Circle, 1.8, Some(INK), Pen::solid(INK, 1.0)))?;
        write(area, name, (x + shift.0, y + shift.1), letters.small())?;
    }
    Ok(())
}
