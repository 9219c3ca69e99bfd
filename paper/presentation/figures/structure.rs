//! The box with its grids, supports and dynamic points (Figure 2).

use super::canvas::*;
use super::view::{AXES, View};
use corfem::present::frame::Frame;
use corfem::present::report::Report;

const SENSOR: Mark = Mark(
    Form::Square,
    3.6,
    Some(VERMILION),
    Pen(VERMILION, 1.2, Dash::Solid),
);
/// Height of the structure with its legend, px.
const DRAWING: f64 = 420.0;
/// Distance of the structure from the top, px.
const UPPER: f64 = 50.0;
/// Factor by which the box's depth is drawn larger.
const DEPTH_DRAWN: f64 = 6.0;

fn support(fixed: bool) -> Mark {
    Mark(
        Form::Circle,
        if fixed { 3.6 } else { 1.8 },
        Some(if fixed { INK } else { BLUE }),
        Pen::solid(BLUE, 1.2),
    )
}

/// Names written so far, by their boxes: left, top, right, bottom.
struct Names(Vec<[f64; 4]>);

impl Names {
    /// Writes a name beside a place, as near as others leave room.
    fn write(&mut self, area: &Area, name: &str, (x, y): Place, color: RGBColor) -> Drawn {
        let (wide, high) = (6.6 * name.chars().count() as f64, 11.0);
        let turns = (1..12)
            .flat_map(|ring| (0..8).map(move |turn| (8.0 * f64::from(ring), f64::from(turn))));
        let mut boxes = turns.map(|(far, turn)| {
            let (sin, cos) = (0.25 * std::f64::consts::PI * (turn - 1.0)).sin_cos();
            let (x, y) = (x + cos * (far + 0.5 * wide), y - sin * (far + 0.5 * high));
            [
                x - 0.5 * wide,
                y - 0.5 * high,
                x + 0.5 * wide,
                y + 0.5 * high,
            ]
        });
        let is_free = |one: &[f64; 4]| {
            // Letters are placed to whole pixels, which moves two of them by up to one against each other.
            let before = |end: f64, start: f64| end + 1.0 <= start;
            let meets = |other: &[f64; 4]| {
                !(before(one[2], other[0])
                    || before(other[2], one[0])
                    || before(one[3], other[1])
                    || before(other[3], one[1]))
            };
            let [left, top, right, bottom] = [4.0, UPPER - 20.0, WIDE - 4.0, DRAWING];
            one[0] > left
                && one[2] < right
                && one[1] > top
                && one[3] < bottom
                && !self.0.iter().any(meets)
        };
        let first = [x - 0.5 * wide, y - 16.0, x + 0.5 * wide, y - 5.0];
        let found = boxes.find(is_free).unwrap_or(first);
        self.0.push(found);
        let at = (0.5 * (found[0] + found[2]), 0.5 * (found[1] + found[3]));
        if (at.0 - x).hypot(at.1 - y) > 22.0 + 0.5 * wide {
            line(area, &[(x, y), at], Pen::solid(SILVER, 0.6))?;
        }
        write(
            area,
            name,
            at,
            Letters {
                color,
                ..MIDDLE.small()
            },
        )
    }
}

/// The structure with its numbered grids, its supports and its sensors.
pub fn draw_structure(name: &str, title: &str, report: &Report) -> Result<String, PresentError> {
    let frame = Frame::from_report(report);
    let grids = report.grids.iter().map(|(_, at)| at);
    let all: Vec<_> = frame.nodes.iter().chain(grids).copied().collect();
    let room = [60.0, UPPER, WIDE - 120.0, DRAWING - UPPER - 30.0];
    let view = View::rising(DEPTH_DRAWN).fitted(&all, room);
    svg(name, title, DRAWING + 30.0, |area| {
        view.lines(area, &frame.lines, &frame.nodes, Pen::solid(SILVER, 1.1))?;
        let mut x = EDGE;
        for (form, words) in [
            (SENSOR, "sensor"),
            (support(true), "held"),
            (support(false), "grid"),
        ] {
            marked(area, (x, 18.0), form, words)?;
            x += 40.0 + 7.2 * words.len() as f64;
        }
        let axes = format!("{AXES}; depth drawn {DEPTH_DRAWN:.0} times");
        write(area, &axes, (x, 18.0), START)?;
        for at in &report.supports {
            mark(area, view.place(*at), support(true))?;
        }
        let mut names = Names(Vec::new());
        for sensor in &report.sensors {
            if let Some(at) = sensor.place {
                mark(area, view.place(at), SENSOR)?;
                names.write(area, &sensor.name, view.place(at), VERMILION)?;
            }
        }
        for (label, at) in &report.grids {
            if !report.supports.contains(at) {
                mark(area, view.place(*at), support(false))?;
            }
            names.write(area, &label.to_string(), view.place(*at), BLUE)?;
        }
        Ok(())
    })
}
