//! The box taken apart, its elements numbered (Figure 3).

use super::box_points::axes;
use super::canvas::*;
use super::view::{DEPTH_DRAWN, View};
use crate::cases::Case;
use crate::method::structure::ElementKind;
use crate::present::PresentError;
use nalgebra::Vector3;
use plotters::style::WHITE;

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

/// Elements of a case's model.
///
/// # Errors
/// Those of [`Case::model`].
pub fn box_elements(case: &Case) -> Result<Vec<DrawnElement>, PresentError> {
    let model = case.model()?;
    let structure = model.structure();
    let drawn = structure.elements().iter().map(|element| {
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
    });
    Ok(drawn.collect())
}

/// The elements as SVG.
///
/// # Errors
/// [`PresentError::Drawing`].
pub fn draw(elements: &[DrawnElement]) -> Result<String, PresentError> {
    let title = "The wing torque box taken apart: panels 1 to 15 and rods 16 to 39";
    svg("box_elements", title, 690.0, |area| {
        let corners = elements.iter().flat_map(|element| &element.corners);
        let corners: Vec<Vector3<f64>> = corners.copied().collect();
        // All three layers at the scale at which the webs, the highest, fill the width.
        let fitted = View::fitted(&corners, DEPTH_DRAWN, [20.0, 0.0, 720.0, 460.0]);
        for (layer, name, top) in [
            (Layer::Upper, "Upper covers and caps", 30.0),
            (Layer::Webs, "Spars, ribs and posts", 228.0),
            (Layer::Lower, "Lower covers and caps", 464.0),
        ] {
            let of_layer = elements.iter().filter(|element| element.layer == layer);
            draw_layer(area, fitted, of_layer.collect(), name, top)?;
        }
        let words = "Large numbers: panels. Small ones: rods.";
        write(area, words, (452.0, 646.0), START)?;
        let note = format!("Webs drawn {DEPTH_DRAWN:.0} times as deep.");
        write(area, &note, (452.0, 666.0), START)?;
        axes(area, (60.0, 82.0))
    })
}

/// One layer, its highest point at `top`.
fn draw_layer(
    area: &Area,
    fitted: View,
    mut elements: Vec<&DrawnElement>,
    name: &str,
    top: f64,
) -> Drawn {
    // Covers lie flat.
    let is_web = |element: &&DrawnElement| element.layer == Layer::Webs;
    let heights = if elements.iter().any(is_web) {
        DEPTH_DRAWN
    } else {
        0.0
    };
    let mut view = View { heights, ..fitted };
    let corners = elements.iter().flat_map(|element| &element.corners);
    let places = corners.map(|&corner| view.place(corner));
    let highest = places.clone().map(|at| at.1).fold(f64::INFINITY, f64::min);
    let leftmost = places.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    view.origin.1 += top - highest;
    let side = leftmost.map_or(top, |at| at.1 + top - highest);
    write(area, name, (14.0, side - 30.0), START.bold())?;
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
    let corners = element.corners.iter();
    let corners: Vec<Place> = corners.map(|&corner| view.place(corner)).collect();
    if element.kind == ElementKind::Rod {
        return line(area, &corners, Pen::solid(BLUE, 2.2));
    }
    polygon(
        area,
        &corners,
        Some(between(PALE, SKY, 0.25)),
        Pen::solid(INK, 0.8),
    )
}

fn write_element(area: &Area, view: &View, element: &DrawnElement) -> Drawn {
    let mut middle = center(&element.corners);
    let number = element.label.to_string();
    if element.kind == ElementKind::Rod {
        let (x, y) = view.place(middle);
        rectangle(area, (x - 8.0, y - 6.5), (x + 8.0, y + 6.5), WHITE)?;
        return write(area, &number, (x, y), MIDDLE.small().color(BLUE));
    }
    // A web is numbered near its upper edge, which nothing hides.
    if element.layer == Layer::Webs {
        let heights = element.corners.iter().map(|corner| corner.z.abs());
        middle.z += 0.42 * heights.sum::<f64>() / 4.0;
    }
    write(area, &number, view.place(middle), MIDDLE.high(14.0).bold())
}
