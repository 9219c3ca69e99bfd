//! Gages of the covers in the test configuration and at each case's start (Figure 4).

use super::super::tables::kind_letter;
use super::box_elements::{Layer, center, shade};
use super::canvas::*;
use super::view::{Room, View};
use corfem::torque_box::Case;
use corfem::torque_box::wing_box::{Panel, TEST_GAGE};
use nalgebra::Vector3;

/// Height of one configuration's row, and above the rows, px.
const ROW: f64 = 188.0;
const HEAD: f64 = 40.0;

/// The covers of the test configuration and of every case's first model as SVG.
pub fn draw(cases: &[Case]) -> Result<String, PresentError> {
    let test = cases.first().map(|first| ("GVT".to_owned(), first, true));
    let starts = cases
        .iter()
        .map(|case| (format!("Case {}", case.number), case, false));
    let configurations: Vec<_> = test.into_iter().chain(starts).collect();
    let below = HEAD + ROW * configurations.len() as f64;
    let title = "Cases 1 to 4: cover gages of the test configuration and of each first model";
    let words = "In each panel: element number, S shear panel or M membrane, and gage in inches.";
    let shades = [
        ("thinner than in the test", 0.5),
        ("as in the test (0.010 in)", 1.0),
        ("thicker than in the test", 1.5),
    ];
    let key = below + LINE + 14.0;
    svg("cover_gages", title, key + 30.0, |area| {
        write(area, "Upper covers", (255.0, 22.0), MIDDLE.bold())?;
        write(area, "Lower covers", (585.0, 22.0), MIDDLE.bold())?;
        for (row, (name, case, is_test)) in configurations.into_iter().enumerate() {
            let above = HEAD + ROW * row as f64;
            let rooms = [88.0, 424.0].map(|left| [left, above + 4.0, 322.0, ROW - 14.0]);
            write(area, &name, (EDGE, above + 0.5 * ROW), START.bold())?;
            draw_covers(area, case, is_test, rooms)?;
        }
        write(area, words, (EDGE, below + 16.0), START)?;
        for (row, (text, part)) in shades.into_iter().enumerate() {
            let left = EDGE + 200.0 * row as f64;
            let swatch = corners((left, key), (left + 22.0, key + 14.0));
            let fill = Some(shade(part * TEST_GAGE));
            polygon(area, &swatch, fill, Pen::solid(INK, 0.8))?;
            write(area, text, (left + 30.0, key + 7.0), START)?;
        }
        Ok(())
    })
}

/// The covers of a case's first model, or of the test configuration, whose panels are of the kinds of every case.
fn draw_covers(area: &Area, case: &Case, is_test: bool, [upper, lower]: [Room; 2]) -> Drawn {
    let place = |grid| {
        case.reconstruction
            .grids
            .get(grid)
            .map(|&at| Vector3::from(at))
    };
    let covers = case.panels.iter().map(|panel| {
        (
            panel,
            panel.grids.iter().filter_map(place).collect::<Vec<_>>(),
        )
    });
    let covers: Vec<(&Panel, Vec<_>)> = covers
        .filter(|(_, corners)| Layer::from_corners(corners) != Layer::Webs)
        .collect();
    let all: Vec<Vector3<f64>> = covers
        .iter()
        .flat_map(|(_, corners)| corners)
        .copied()
        .collect();
    for (panel, corners) in covers {
        let is_upper = Layer::from_corners(&corners) == Layer::Upper;
        let room = if is_upper { upper } else { lower };
        let plan = View::plan().fitted(&all, room);
        let (gage, kind) = if is_test {
            (TEST_GAGE, "")
        } else {
            (panel.gage, kind_letter(panel.kind))
        };
        let outline: Vec<Place> = corners.iter().map(|&corner| plan.place(corner)).collect();
        polygon(area, &outline, Some(shade(gage)), Pen::solid(INK, 1.0))?;
        let (x, y) = plan.place(center(&corners));
        write(
            area,
            format!("{} {kind}", panel.label).trim_end(),
            (x, y - 7.0),
            MIDDLE.small().bold(),
        )?;
        // A gage in inches, with the decimals it needs.
        let decimals = if gage < 0.001 { 4 } else { 3 };
        write(
            area,
            &format!("{gage:.decimals$}"),
            (x, y + 7.0),
            MIDDLE.small(),
        )?;
    }
    Ok(())
}
