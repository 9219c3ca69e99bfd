//! Gages of the covers in the test configuration and at each case's start (Figure 4).

use super::canvas::*;
use super::view::View;
use crate::cases::Case;
use crate::cases::torque_box::{Panel, TEST_GAGE};
use crate::method::structure::ElementKind;
use nalgebra::Vector3;

/// A cover panel of one configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    /// Element number.
    pub label: usize,
    /// Shear panel or membrane; the test configuration has those of the case it is the target of.
    pub kind: Option<ElementKind>,
    /// Gage, in.
    pub gage: f64,
    /// Whether it is on the upper side.
    pub upper: bool,
    /// Its corners, in.
    pub corners: Vec<Vector3<f64>>,
}

/// A configuration, `Case 1` or `GVT` for the test's, with its six covers.
pub type Configuration = (String, Vec<Cover>);

/// Cover gages of the test configuration and of the given cases.
pub fn cover_gages(cases: &[Case]) -> Vec<Configuration> {
    let covers = |case: &Case, test: bool| -> Vec<Cover> {
        let cover = |panel: &Panel| {
            let grids = &case.reconstruction.grids;
            let corners = panel.grids.iter().filter_map(|grid| grids.get(grid)).map(|&at| at.into());
            let corners: Vec<Vector3<f64>> = corners.collect();
            let [upper, lower] = [1.0, -1.0].map(|side| corners.iter().all(|corner| side * corner.z > 0.0));
            (upper || lower).then_some(Cover {
                label: panel.label,
                kind: (!test).then_some(panel.kind),
                gage: if test { TEST_GAGE } else { panel.gage },
                upper,
                corners,
            })
        };
        case.panels.iter().filter_map(cover).collect()
    };
    let test = cases.first().map(|first| ("GVT".to_owned(), covers(first, true)));
    let starts = cases.iter().map(|case| (format!("Case {}", case.number), covers(case, false)));
    test.into_iter().chain(starts).collect()
}

/// Height of one configuration's row and above the rows, px.
const ROW: f64 = 188.0;
const HEAD: f64 = 40.0;

/// The covers of the configurations as SVG.
pub fn draw(configurations: &[Configuration]) -> Result<String, PresentError> {
    let height = HEAD + ROW * configurations.len() as f64 + 62.0;
    let title = "Cases 1 to 4: cover gages of the test configuration and of each first model";
    svg("cover_gages", title, height, |area| on(area, configurations))
}

fn on(area: &Area, configurations: &[Configuration]) -> Drawn {
    write(area, "Upper covers", (255.0, 22.0), MIDDLE.bold())?;
    write(area, "Lower covers", (585.0, 22.0), MIDDLE.bold())?;
    let mut top = HEAD;
    for (name, covers) in configurations {
        write(area, name, (14.0, top + 0.5 * ROW), START.bold())?;
        let corners: Vec<Vector3<f64>> = covers.iter().flat_map(|c| c.corners.clone()).collect();
        for cover in covers {
            let left = if cover.upper { 88.0 } else { 424.0 };
            let plan = View::plan(&corners).fitted(&corners, [left, top + 4.0, 322.0, ROW - 14.0]);
            draw_cover(area, cover, &plan)?;
        }
        top += ROW;
    }
    let text = "In each panel: element number, S shear panel or M membrane, and gage in inches.";
    write(area, text, (14.0, top + 16.0), START)?;
    for (left, text, part) in [
        (14.0, "thinner than in the test", 0.5),
        (214.0, "as in the test (0.010 in)", 1.0),
        (414.0, "thicker than in the test", 1.5),
    ] {
        let swatch = corners((left, top + 32.0), (left + 22.0, top + 46.0));
        polygon(area, &swatch, Some(shade(part * TEST_GAGE)), Pen::solid(INK, 0.8))?;
        write(area, text, (left + 30.0, top + 39.0), START)?;
    }
    Ok(())
}

fn draw_cover(area: &Area, cover: &Cover, plan: &View) -> Drawn {
    let corners: Vec<Place> = cover.corners.iter().map(|&corner| plan.place(corner)).collect();
    polygon(area, &corners, Some(shade(cover.gage)), Pen::solid(INK, 1.0))?;
    let middle = |of: fn(&Place) -> f64| corners.iter().map(of).sum::<f64>() / corners.len() as f64;
    let (x, y) = (middle(|at| at.0), middle(|at| at.1));
    let kind = match cover.kind {
        None => "",
        Some(ElementKind::Membrane) => " M",
        Some(_) => " S",
    };
    write(area, &format!("{}{kind}", cover.label), (x, y - 7.0), MIDDLE.small().bold())?;
    // A gage in inches, with the decimals it needs.
    let decimals = if cover.gage < 0.001 { 4 } else { 3 };
    write(area, &format!("{:.decimals$}", cover.gage), (x, y + 7.0), MIDDLE.small())
}

/// Thin is blue and thick is orange; half or one and a half times the test gage have the full color.
fn shade(gage: f64) -> RGBColor {
    let excess = (2.0 * (gage / TEST_GAGE - 1.0)).clamp(-1.0, 1.0);
    between(WHITE, if excess < 0.0 { SKY } else { ORANGE }, 0.85 * excess.abs())
}
