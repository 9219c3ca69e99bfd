//! The box taken apart, its elements numbered (Figure 3).

use super::super::tables::kind_letter;
use super::canvas::*;
use super::view::{AXES, View};
use corfem::method::structure::{Element, ElementKind, Structure};
use corfem::present::table::Digits;
use corfem::torque_box::wing_box::TEST_GAGE;
use corfem::torque_box::{Case, CaseResult};
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

/// The layers with their long and short names.
const LAYERS: [(Layer, [&str; 2]); 3] = [
    (Layer::Upper, ["Upper covers and caps", "Upper covers"]),
    (Layer::Webs, ["Spars, ribs and posts", "Spars and ribs"]),
    (Layer::Lower, ["Lower covers and caps", "Lower covers"]),
];
/// Distances of the layers from the top of a box, in parts of its width.
const DOWN: [f64; 3] = [30.0 / 720.0, 228.0 / 720.0, 464.0 / 720.0];
/// Factor by which the box's depth is drawn larger; the depth is a twentieth of its span.
const DEPTH_DRAWN: f64 = 7.0;

/// Style of a box: left and top, width, fill and name of its panels, and whether its rods are numbered.
struct Look<'a> {
    corner: Place,
    width: f64,
    panel: &'a dyn Fn(&Element) -> (RGBColor, String),
    has_numbers: bool,
}

/// The elements of a case's model as SVG.
///
/// # Errors
/// The errors of [`Case::model`]; [`PresentError::Drawing`].
pub fn draw(case: &Case) -> Result<String, PresentError> {
    let model = case.model()?;
    let title = format!(
        "Case {}: the wing torque box taken apart, panels 1 to 15 and rods 16 to 39",
        case.number
    );
    let look = Look {
        corner: (20.0, 0.0),
        width: 720.0,
        panel: &|element| {
            let letter = kind_letter(element.kind);
            (fill(element.kind), format!("{} {letter}", element.label))
        },
        has_numbers: true,
    };
    let notes = [
        "Blue, S: shear panels. Orange, M: membranes.".to_owned(),
        "Large numbers: panels. Small ones: rods.".to_owned(),
        format!("Webs drawn {DEPTH_DRAWN:.0} times as deep."),
    ];
    svg("box_elements", &title, 690.0, |area| {
        draw_box(area, model.structure(), &look)?;
        write_lines(area, &notes, (400.0, 626.0), START)?;
        write(area, AXES, (EDGE, 20.0), START)
    })
}

/// The gage errors of a case's panels before and after its correlation, on the box taken apart, as SVG.
///
/// # Errors
/// The errors of [`Case::model`]; [`PresentError::Drawing`].
pub fn draw_gages(result: &CaseResult) -> Result<String, PresentError> {
    let model = result.case.model()?;
    let before = result.case.first_gages();
    let factors = result.correlation.best_factors.iter();
    let after: Vec<f64> = before.iter().zip(factors).map(|(a, b)| a * b).collect();
    let title = format!(
        "Case {}: how many percent every panel is too thick",
        result.case.number
    );
    let words =
        "Orange is too thick, blue too thin; the full color is half too much or too little.";
    svg("box_gages", &title, 366.0 + LINE, |area| {
        for (left, name, gages) in [
            (EDGE, "First model", &before),
            (392.0, "Corrected model", &after),
        ] {
            let panel = |element: &Element| {
                let gage = gages.get(element.label - 1).copied().unwrap_or(TEST_GAGE);
                let error = Digits::Fixed(0).write(100.0 * (gage / TEST_GAGE - 1.0));
                (shade(gage), signed(error))
            };
            let look = Look {
                corner: (left, 18.0),
                width: 354.0,
                panel: &panel,
                has_numbers: false,
            };
            write(area, name, (left, 14.0), START.bold())?;
            draw_box(area, model.structure(), &look)?;
        }
        write(area, words, (EDGE, 368.0), START)
    })
}

/// The three layers at the scale at which the webs, the highest, fill the width.
fn draw_box(area: &Area, structure: &Structure, look: &Look) -> Drawn {
    let corners = structure.corners().iter().cloned();
    let elements: Vec<CornersOf> = structure.elements().iter().zip(corners).collect();
    let corners: Vec<Vector3<f64>> = elements
        .iter()
        .flat_map(|(_, corners)| corners)
        .copied()
        .collect();
    let (left, top) = look.corner;
    // As wide as there is room; heights follow.
    let room = [left, 0.0, look.width, f64::INFINITY];
    let mut fitted = View::rising(DEPTH_DRAWN).fitted(&corners, room);
    fitted.origin.1 = 0.0;
    for ((layer, names), down) in LAYERS.into_iter().zip(DOWN) {
        let of_layer = elements
            .iter()
            .filter(|(_, corners)| Layer::from_corners(corners) == layer);
        let name = names[usize::from(!look.has_numbers)];
        let place = (layer, name, top + look.width * down);
        draw_layer(area, fitted, of_layer.collect(), place, look)?;
    }
    Ok(())
}

/// One layer with its name, its highest point at `top`.
fn draw_layer(
    area: &Area,
    fitted: View,
    mut elements: Vec<&CornersOf>,
    (layer, name, top): (Layer, &str, f64),
    look: &Look,
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
    let above = 16.0 + 14.0 * look.width / 720.0;
    let at = (
        look.corner.0 - 6.0 * f64::from(look.has_numbers),
        side - above,
    );
    write(area, name, at, START.bold())?;
    // Elements farther from the eye are drawn first.
    elements.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    for (element, corners) in &elements {
        let corners: Vec<Place> = corners.iter().map(|&corner| view.place(corner)).collect();
        match element.kind {
            ElementKind::Rod if look.has_numbers => line(area, &corners, Pen::solid(BLUE, 2.2))?,
            ElementKind::Rod => line(area, &corners, Pen::solid(INK, 0.8))?,
            _ => {
                let fill = (look.panel)(element).0;
                polygon(area, &corners, Some(fill), Pen::solid(INK, 0.8))?;
            }
        }
    }
    for (element, corners) in elements {
        let mut middle = center(corners);
        if element.kind == ElementKind::Rod {
            if look.has_numbers {
                let (x, y) = view.place(middle);
                rectangle(area, (x - 8.0, y - 6.5), (x + 8.0, y + 6.5), WHITE)?;
                let letters = Letters {
                    color: BLUE,
                    ..MIDDLE.small()
                };
                write(area, &element.label.to_string(), (x, y), letters)?;
            }
            continue;
        }
        // A web is numbered near its upper edge, which nothing hides.
        if layer == Layer::Webs {
            middle.z += 0.42 * corners.iter().map(|corner| corner.z.abs()).sum::<f64>() / 4.0;
        }
        let letters = Letters {
            height: if look.has_numbers { 14.0 } else { 13.0 },
            ..MIDDLE.bold()
        };
        write(area, &(look.panel)(element).1, view.place(middle), letters)?;
    }
    Ok(())
}

/// Membranes are pale orange, shear panels blue.
fn fill(kind: ElementKind) -> RGBColor {
    if kind == ElementKind::Membrane {
        tint(ORANGE, 0.4)
    } else {
        tint(SKY, 0.35)
    }
}

/// The mean of corners.
pub fn center(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len() as f64
}

/// Nearness of an element to the eye, which looks outboard and forward from above; a rod before the panels it borders.
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

/// Thin is blue and thick is orange; half or one and a half times the test gage have the full color.
pub fn shade(gage: f64) -> RGBColor {
    let excess = (2.0 * (gage / TEST_GAGE - 1.0)).clamp(-1.0, 1.0);
    tint(if excess < 0.0 { SKY } else { ORANGE }, 0.85 * excess.abs())
}
