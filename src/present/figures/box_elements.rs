//! The box taken apart, its elements numbered (Figure 3).

use super::box_points::axes;
use super::canvas::{
    Area, BLUE, Drawn, INK, LETTERS, Letters, PALE, Pen, SKY, SMALL, Side, WIDTH, between, line, outline, polygon,
    rectangle, svg, write,
};
use super::view::{DEPTH_DRAWN, View};
use crate::cases::Case;
use crate::method::structure::ElementKind;
use crate::present::error::PresentError;
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
pub fn box_elements(case: &Case) -> Result<BoxElements, PresentError> {
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
            DrawnElement { label: element.label, kind: element.kind, corners, layer }
        })
        .collect();
    Ok(BoxElements { elements })
}

impl BoxElements {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let title = "The wing torque box taken apart: panels 1 to 15 and rods 16 to 39";
        svg("box_elements", title, (WIDTH, 690.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let corners: Vec<Vector3<f64>> =
            self.elements.iter().flat_map(|element| element.corners.iter().copied()).collect();
        // All three layers at the scale at which the webs, the highest, fill the width.
        let fitted = View::fitted(&corners, DEPTH_DRAWN, [20.0, 0.0, 720.0, 460.0]);
        for (layer, name, top) in [
            (Layer::Upper, "Upper covers and caps", 30.0),
            (Layer::Webs, "Spars, ribs and posts", 228.0),
            (Layer::Lower, "Lower covers and caps", 464.0),
        ] {
            self.layer_on(area, fitted, (layer, name, top))?;
        }
        let words = Letters::new(LETTERS, Side::Right);
        let at = (452.0, 646.0);
        write(area, "Large numbers: panels. Small ones: rods.", at, words)?;
        let note = format!("Webs drawn {DEPTH_DRAWN:.0} times as deep.");
        write(area, &note, (at.0, at.1 + 20.0), words)?;
        axes(area, (60.0, 82.0))
    }

    /// One layer, its highest point at `top`.
    fn layer_on(&self, area: &Area, fitted: View, (layer, name, top): (Layer, &str, f64)) -> Drawn {
        let heights = if layer == Layer::Webs { DEPTH_DRAWN } else { 0.0 };
        let mut view = View { heights, ..fitted };
        let mut elements: Vec<&DrawnElement> = self.elements.iter().filter(|element| element.layer == layer).collect();
        let places = elements.iter().flat_map(|element| &element.corners).map(|&corner| view.place(corner));
        let highest = places.clone().map(|at| at.1).fold(f64::INFINITY, f64::min);
        let leftmost = places.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        view.origin.1 += top - highest;
        let side = leftmost.map_or(top, |at| at.1 + top - highest);
        let heading = Letters::new(LETTERS, Side::Right).bold();
        write(area, name, (14.0, side - 30.0), heading)?;
        // What lies farther from the eye is drawn first.
        elements.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        for element in &elements {
            draw_element(area, &view, element)?;
        }
        for element in elements {
            write_element(area, &view, element)?;
        }
        Ok(())
    }
}

fn center(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len() as f64
}

/// How near the eye an element is, which looks outboard and forward from above; a rod before the panels it borders.
fn nearness(element: &DrawnElement) -> f64 {
    const ROD_BEFORE_PANEL: f64 = 6.0;
    let center = center(&element.corners);
    let rod = element.kind == ElementKind::Rod;
    center.x - center.y + if rod { ROD_BEFORE_PANEL } else { 0.0 }
}

fn draw_element(area: &Area, view: &View, element: &DrawnElement) -> Drawn {
    let corners: Vec<_> = element.corners.iter().map(|&corner| view.place(corner)).collect();
    if element.kind == ElementKind::Rod {
        return line(area, &corners, Pen::solid(BLUE, 2.2));
    }
    polygon(area, &corners, between(PALE, SKY, 0.25))?;
    outline(area, &corners, Pen::solid(INK, 0.8))
}

fn write_element(area: &Area, view: &View, element: &DrawnElement) -> Drawn {
    let mut middle = center(&element.corners);
    let number = element.label.to_string();
    if element.kind == ElementKind::Rod {
        let (x, y) = view.place(middle);
        rectangle(area, (x - 8.0, y - 6.5), (x + 8.0, y + 6.5), plotters::style::WHITE)?;
        let letters = Letters::new(SMALL, Side::Center).color(BLUE);
        return write(area, &number, (x, y), letters);
    }
    // A web is numbered near its upper edge, which nothing hides.
    if element.layer == Layer::Webs {
        let half_depth = element.corners.iter().map(|corner| corner.z.abs()).sum::<f64>() / 4.0;
        middle.z += 0.42 * half_depth;
    }
    write(area, &number, view.place(middle), Letters::new(14.0, Side::Center).bold())
}
