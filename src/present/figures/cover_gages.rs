//! Gages of the covers in the test configuration and at each case's start (Figure 4).

use super::canvas::{
    Area, Drawn, INK, LETTERS, Letters, ORANGE, Pen, Place, SKY, SMALL, Side, WIDTH, between, outline, polygon, svg,
    write,
};
use super::planform::PlanPoint;
use super::view::Plan;
use crate::cases::Case;
use crate::cases::torque_box::TEST_GAGE;
use crate::method::structure::ElementKind;
use crate::present::error::PresentError;
use plotters::style::{RGBColor, WHITE};

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
    /// Its corners in plan, in.
    pub corners: Vec<PlanPoint>,
}

/// The covers of one configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// `Case 1`, or `GVT` for the test configuration.
    pub name: String,
    /// Its six covers.
    pub covers: Vec<Cover>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct CoverGages {
    /// The test configuration, then every case's start.
    pub configurations: Vec<Configuration>,
}

/// Cover gages of the test configuration and of the given cases.
pub fn cover_gages(cases: &[Case]) -> CoverGages {
    let covers = |case: &Case, test: bool| {
        let corner = |grid: &usize| case.reconstruction.grids.get(grid).copied();
        let panels = case.panels.iter().filter_map(|panel| {
            let corners: Vec<[f64; 3]> = panel.grids.iter().filter_map(corner).collect();
            let upper = corners.iter().all(|[_, _, z]| *z > 0.0);
            let lower = corners.iter().all(|[_, _, z]| *z < 0.0);
            (upper || lower).then(|| Cover {
                label: panel.label,
                kind: (!test).then_some(panel.kind),
                gage: if test { TEST_GAGE } else { panel.gage },
                upper,
                corners: corners.iter().map(|&[x, y, _]| [x, y]).collect(),
            })
        });
        panels.collect()
    };
    let mut configurations = Vec::new();
    if let Some(first) = cases.first() {
        configurations.push(Configuration { name: "GVT".to_owned(), covers: covers(first, true) });
    }
    configurations.extend(
        cases.iter().map(|case| Configuration { name: format!("Case {}", case.number), covers: covers(case, false) }),
    );
    CoverGages { configurations }
}

/// Height of one configuration's row, px.
const ROW: f64 = 188.0;
/// Height above the rows, px.
const HEAD: f64 = 40.0;

impl CoverGages {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let height = HEAD + ROW * self.configurations.len() as f64 + 62.0;
        let title = "Cover gages of the test configuration and of each case's first model";
        svg("cover_gages", title, (WIDTH, height), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let heading = Letters::new(LETTERS, Side::Center).bold();
        write(area, "Upper covers", (255.0, 22.0), heading)?;
        write(area, "Lower covers", (585.0, 22.0), heading)?;
        let mut top = HEAD;
        for configuration in &self.configurations {
            let name = Letters::new(LETTERS, Side::Right).bold();
            write(area, &configuration.name, (14.0, top + 0.5 * ROW), name)?;
            for cover in &configuration.covers {
                let left = if cover.upper { 88.0 } else { 424.0 };
                let corners: Vec<PlanPoint> =
                    configuration.covers.iter().flat_map(|cover| cover.corners.iter().copied()).collect();
                let plan = Plan::fitted(&corners, [left, top + 4.0, 322.0, ROW - 14.0]);
                draw_cover(area, cover, &plan)?;
            }
            top += ROW;
        }
        let note = Letters::new(LETTERS, Side::Right);
        let text = "In each panel: element number, S shear panel or M membrane, and gage in inches.";
        write(area, text, (14.0, top + 16.0), note)?;
        let mut left = 14.0;
        for (text, gage, width) in [
            ("thinner than in the test", 0.5 * TEST_GAGE, 200.0),
            ("as in the test (0.010 in)", TEST_GAGE, 200.0),
            ("thicker than in the test", 1.5 * TEST_GAGE, 200.0),
        ] {
            let (from, to) = ((left, top + 32.0), (left + 22.0, top + 46.0));
            let corners = [from, (to.0, from.1), to, (from.0, to.1)];
            polygon(area, &corners, shade(gage))?;
            outline(area, &corners, Pen::solid(INK, 0.8))?;
            write(area, text, (left + 30.0, top + 39.0), note)?;
            left += width;
        }
        Ok(())
    }
}

fn draw_cover(area: &Area, cover: &Cover, plan: &Plan) -> Drawn {
    let corners: Vec<Place> = cover.corners.iter().map(|&corner| plan.place(corner)).collect();
    polygon(area, &corners, shade(cover.gage))?;
    outline(area, &corners, Pen::solid(INK, 1.0))?;
    let count = corners.len() as f64;
    let x = corners.iter().map(|corner| corner.0).sum::<f64>() / count;
    let y = corners.iter().map(|corner| corner.1).sum::<f64>() / count;
    let kind = match cover.kind {
        None => "",
        Some(ElementKind::Membrane) => " M",
        Some(_) => " S",
    };
    let name = format!("{}{kind}", cover.label);
    write(area, &name, (x, y - 7.0), Letters::new(SMALL, Side::Center).bold())?;
    write(area, &gage_text(cover.gage), (x, y + 7.0), Letters::new(SMALL, Side::Center))
}

/// A gage in inches, with the decimals it needs.
fn gage_text(gage: f64) -> String {
    if gage < 0.001 { format!("{gage:.4}") } else { format!("{gage:.3}") }
}

/// Thin is blue and thick is orange; half or one and a half times the test gage have the full color.
fn shade(gage: f64) -> RGBColor {
    let excess = (2.0 * (gage / TEST_GAGE - 1.0)).clamp(-1.0, 1.0);
    let full = if excess < 0.0 { SKY } else { ORANGE };
    between(WHITE, full, 0.85 * excess.abs())
}
