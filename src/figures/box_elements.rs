//! The box taken apart, its elements numbered (Figure 3).

use super::box_points::axes;
use super::canvas::{
    Area, BLUE, Drawn, INK, LETTERS, Letters, PALE, Pen, SMALL, SKY, Side, WIDTH, between, line,
    outline, polygon, rectangle, svg, write,
};
use super::view::{DEPTH_DRAWN, View};
use crate::cases::Case;
use crate::error::Error;
use crate::structure::ElementKind;
use nalgebra::Vector3;

/// One of the three layers the box is taken apart into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    /// Upper covers with their caps.
    Upper,
    /// Spars and ribs with their posts.
    Webs,
    /// Lower covers with their caps.
    Lower,
}

/// An element as drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnElement {
    /// Its number.
    pub label: usize,
    /// What it is.
    pub kind: ElementKind,
    /// Its corners or ends, in.
    pub corners: Vec<Vector3<f64>>,
    /// Where it is drawn.
    pub layer: Layer,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxElements {
    /// All 39 elements.
    pub elements: Vec<DrawnElement>,
}

/// Elements of a case's model.
///
/// # Errors
/// Those of [`Case::model`].
pub fn box_elements(case: &Case) -> Result<BoxElements, Error> {
    let model = case.model()?;
    let structure = model.structure();
    let elements = structure
        .elements()
        .iter()
        .map(|element| {
            let corners: Vec<Vector3<f64>> = structure.corners(element).to_vec();
            let layer = if corners.iter().all(|corner| corner.z > 0.0) {
                Layer::Upper
            } else if corners.iter().all(|corner| corner.z < 0.0) {
                Layer::Lower
            } else {
                Layer::Webs
            };
            DrawnElement {
                label: element.label,
                kind: element.kind,
                corners,
                layer,
            }
        })
        .collect();
    Ok(BoxElements { elements })
}

impl BoxElements {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`Error::Drawing`].
    pub fn draw(&self) -> Result<String, Error> {
        let title = "The wing torque box taken apart: panels 1 to 15 and rods 16 to 39";
        svg("box_elements", title, (WIDTH, 760.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let corners: Vec<Vector3<f64>> = self
            .elements
            .iter()
            .flat_map(|element| element.corners.iter().copied())
            .collect();
        // All three layers at the scale at which the webs, the highest, fill the width.
        let fitted = View::fitted(&corners, DEPTH_DRAWN, [20.0, 20.0, 720.0, 460.0]);
        for (layer, name, down) in [
            (Layer::Upper, "Upper covers and caps", 0.0),
            (Layer::Webs, "Spars, ribs and posts", 0.33),
            (Layer::Lower, "Lower covers and caps", 0.66),
        ] {
            let view = View {
                origin: (fitted.origin.0, fitted.origin.1 + 750.0 * down - 30.0),
                heights: if layer == Layer::Webs { DEPTH_DRAWN } else { 0.0 },
                ..fitted
            };
            let heading = Letters::new(LETTERS, Side::Right).bold();
            write(area, name, (14.0, view.origin.1 - 150.0), heading)?;
            let here = |element: &&DrawnElement| element.layer == layer;
            let mut panels: Vec<&DrawnElement> = self
                .elements
                .iter()
                .filter(here)
                .filter(|element| element.kind != ElementKind::Rod)
                .collect();
            // What lies farther from the eye is drawn first: inboard before outboard, front before rear.
            panels.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
            for panel in &panels {
                draw_panel(area, &view, panel)?;
            }
            for panel in &panels {
                write_panel(area, &view, panel)?;
            }
            for rod in self.elements.iter().filter(here) {
                if rod.kind == ElementKind::Rod {
                    draw_rod(area, &view, rod)?;
                }
            }
        }
        let words = Letters::new(LETTERS, Side::Right);
        write(area, "Large numbers: panels. Small numbers: rods.", (445.0, 690.0), words)?;
        let note = format!("Depth of the webs drawn {DEPTH_DRAWN:.0} times as large as the plan.");
        write(area, &note, (445.0, 710.0), words)?;
        axes(area, (60.0, 90.0))
    }
}

fn center(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len() as f64
}

/// How near the eye an element is: the eye looks outboard and forward from above.
fn nearness(element: &DrawnElement) -> f64 {
    let center = center(&element.corners);
    center.x - center.y
}

fn draw_panel(area: &Area, view: &View, panel: &DrawnElement) -> Drawn {
    let corners: Vec<_> = panel.corners.iter().map(|&corner| view.place(corner)).collect();
    polygon(area, &corners, between(PALE, SKY, 0.25))?;
    outline(area, &corners, Pen::solid(INK, 0.8))
}

fn write_panel(area: &Area, view: &View, panel: &DrawnElement) -> Drawn {
    let at = view.place(center(&panel.corners));
    write(area, &panel.label.to_string(), at, Letters::new(15.0, Side::Center).bold())
}

fn draw_rod(area: &Area, view: &View, rod: &DrawnElement) -> Drawn {
    let ends: Vec<_> = rod.corners.iter().map(|&end| view.place(end)).collect();
    line(area, &ends, Pen::solid(BLUE, 2.2))?;
    let (x, y) = view.place(center(&rod.corners));
    rectangle(area, (x - 8.0, y - 6.5), (x + 8.0, y + 6.5), plotters::style::WHITE)?;
    let letters = Letters::new(SMALL, Side::Center).color(BLUE);
    write(area, &rod.label.to_string(), (x, y), letters)
}
