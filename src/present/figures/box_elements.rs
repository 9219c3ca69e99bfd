//! The box taken apart, its elements numbered (Figure 3).

use super::canvas::*;
use super::view::{DEPTH_DRAWN, View};
use crate::method::structure::{Element, ElementKind};
use crate::present::tables::kind_letter;
use crate::torque_box::Case;
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

impl Layer {
    /// The layer of an element with these corners or ends.
    pub fn from_corners(corners: &[Vector3<f64>]) -> Self {
        match (
            corners.iter().all(|corner| corner.z > 0.0),
            corners.iter().all(|corner| corner.z < 0.0),
        ) {
            (true, _) => Self::Upper,
            (_, true) => Self::Lower,
            _ => Self::Webs,
        }
    }
}

/// An element with its corners or ends, in.
type CornersOf<'a> = (&'a Element, Vec<Vector3<f64>>);

/// The elements of a case's model as SVG.
///
/// # Errors
/// Those of [`Case::model`]; [`PresentError::Drawing`].
pub fn draw(case: &Case) -> Result<String, PresentError> {
    let model = case.model()?;
    let structure = model.structure();
    let elements: Vec<CornersOf> = structure
        .elements()
        .iter()
        .map(|e| (e, structure.corners(e)))
        .collect();
    let title = format!(
        "Case {}: the wing torque box taken apart, panels 1 to 15 and rods 16 to 39",
        case.number
    );
    svg("box_elements", &title, 690.0, |area| {
        let corners: Vec<Vector3<f64>> = elements
            .iter()
            .flat_map(|(_, corners)| corners)
            .copied()
            .collect();
        // All three layers at the scale at which the webs, the highest, fill the width.
        let fitted = View::isometric(DEPTH_DRAWN).fitted(&corners, [20.0, 0.0, 720.0, 460.0]);
        for (layer, name, top) in [
            (Layer::Upper, "Upper covers and caps", 30.0),
            (Layer::Webs, "Spars, ribs and posts", 228.0),
            (Layer::Lower, "Lower covers and caps", 464.0),
        ] {
            let of_layer = elements
                .iter()
                .filter(|(_, corners)| Layer::from_corners(corners) == layer);
            draw_layer(area, fitted, of_layer.collect(), (layer, name, top))?;
        }
        write(
            area,
            "Blue, S: shear panels. Orange, M: membranes.",
            (400.0, 626.0),
            START,
        )?;
        write(
            area,
            "Large numbers: panels. Small ones: rods.",
            (400.0, 646.0),
            START,
        )?;
        write(
            area,
            &format!("Webs drawn {DEPTH_DRAWN:.0} times as deep."),
            (400.0, 666.0),
            START,
        )?;
        write(area, &fitted.axes(), (14.0, 20.0), START)
    })
}

/// One layer with its name, its highest point at `top`.
fn draw_layer(
    area: &Area,
    fitted: View,
    mut elements: Vec<&CornersOf>,
    (layer, name, top): (Layer, &str, f64),
) -> Drawn {
    // Covers lie flat.
    let mut view = fitted;
    view.down.z *= f64::from(layer == Layer::Webs);
    let places = elements
        .iter()
        .flat_map(|(_, corners)| corners)
        .map(|&corner| view.place(corner));
    let highest = places.clone().map(|at| at.1).fold(f64::INFINITY, f64::min);
    let leftmost = places.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    view.origin.1 += top - highest;
    let side = leftmost.map_or(top, |at| at.1 + top - highest);
    write(area, name, (14.0, side - 30.0), START.bold())?;
    // What lies farther from the eye is drawn first.
    elements.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    for (element, corners) in &elements {
        let corners: Vec<Place> = corners.iter().map(|&corner| view.place(corner)).collect();
        match element.kind {
            ElementKind::Rod => line(area, &corners, Pen::solid(BLUE, 2.2))?,
            kind => polygon(area, &corners, Some(fill(kind)), Pen::solid(INK, 0.8))?,
        }
    }
    for (element, corners) in elements {
        let (mut middle, number) = (center(corners), element.label.to_string());
        if element.kind == ElementKind::Rod {
            let (x, y) = view.place(middle);
            rectangle(area, (x - 8.0, y - 6.5), (x + 8.0, y + 6.5), WHITE)?;
            write(
                area,
                &number,
                (x, y),
                Letters {
                    color: BLUE,
                    ..MIDDLE.small()
                },
            )?;
            continue;
        }
        // A web is numbered near its upper edge, which nothing hides.
        if layer == Layer::Webs {
            middle.z += 0.42 * corners.iter().map(|corner| corner.z.abs()).sum::<f64>() / 4.0;
        }
        let letter = kind_letter(element.kind);
        write(
            area,
            &format!("{number} {letter}"),
            view.place(middle),
            Letters {
                height: 14.0,
                ..MIDDLE.bold()
            },
        )?;
    }
    Ok(())
}

/// Membranes are pale orange, shear panels blue.
fn fill(kind: ElementKind) -> RGBColor {
    if kind == ElementKind::Membrane {
        between(WHITE, ORANGE, 0.4)
    } else {
        between(PALE, SKY, 0.25)
    }
}

/// The mean of corners.
pub(super) fn center(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len() as f64
}

/// How near the eye an element is, which looks outboard and forward from above; a rod before the panels it borders.
fn nearness((element, corners): &CornersOf) -> f64 {
    const ROD_BEFORE_PANEL: f64 = 6.0;
    let center = center(corners);
    center.x - center.y
        + if element.kind == ElementKind::Rod {
            ROD_BEFORE_PANEL
        } else {
            0.0
        }
}
