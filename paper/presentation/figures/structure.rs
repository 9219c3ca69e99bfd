//! A structure with its grids, supports and sensors (Figure 2).

use super::canvas::*;
use super::view::{RISE, STEEP, View};
use corfem::present::frame::{Frame, is_finite, key};
use corfem::present::render::lines;
use corfem::present::report::Report;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::iter::once;

const SENSOR: Mark = Mark(
    Form::Square,
    3.6,
    Some(VERMILION),
    Pen(VERMILION, 1.2, Dash::Solid),
);
/// Numbers of more grids than these would hide the structure.
pub const MOST_NUMBERS: usize = 60;
/// Longest name written next to its place; longer ones go into a list.
const LONGEST_NAME: usize = 9;
/// Height of the structure with its legend, px.
const DRAWING: f64 = 420.0;

fn support(fixed: bool) -> Mark {
    Mark(
        Form::Circle,
        if fixed { 3.6 } else { 1.8 },
        Some(if fixed { INK } else { BLUE }),
        Pen::solid(BLUE, 1.2),
    )
}

/// Names written so far, by their boxes: left, top, right, bottom; and the box that all of them stand in.
struct Names(Vec<[f64; 4]>, [f64; 4]);

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
            let [left, top, right, bottom] = self.1;
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

/// The structure with its numbered grids, its supports and its sensors: in plan when all places lie in one plane.
pub fn draw_structure(
    name: &str,
    title: &str,
    report: &Report,
    wide: f64,
) -> Result<String, PresentError> {
    let frame = Frame::from_report(report);
    let all: Vec<_> = frame
        .nodes
        .iter()
        .chain(report.grids.iter().map(|(_, at)| at))
        .copied()
        .collect();
    let numbered = report.grids.len() <= MOST_NUMBERS;
    // Numbers need room between an upper and a lower surface; the narrow form is higher than wide.
    let rise = if wide < WIDE { STEEP } else { RISE };
    let solid = || {
        let heights = if numbered { View::heights(&all) } else { 1.0 };
        (View::rising(rise, heights), heights)
    };
    let (view, heights) = View::flat(&all).map_or_else(solid, |(_, view)| (view, 1.0));
    let depth = if heights > 1.0 {
        format!("; depth drawn {heights:.0} times")
    } else {
        String::new()
    };
    // Behind the legend, or below it in the narrow form.
    let axes = paragraph(&(view.axes() + &depth), wide);
    let below = if wide < WIDE {
        LINE * axes.len() as f64
    } else {
        0.0
    };
    let (edge, upper) = (if wide < WIDE { 30.0 } else { 60.0 }, 50.0 + below);
    let view = view.fitted(
        &all,
        [edge, upper, wide - 2.0 * edge, DRAWING - upper - 30.0],
    );
    let mut places: BTreeMap<[i64; 3], (Vector3<f64>, Vec<&str>)> = BTreeMap::new();
    let mut elsewhere = Vec::new();
    for sensor in &report.sensors {
        match sensor.place.filter(is_finite) {
            Some(at) => places
                .entry(key(&at))
                .or_insert((at, Vec::new()))
                .1
                .push(&sensor.name),
            None => elsewhere.push(sensor.name.as_str()),
        }
    }
    let mut list = Vec::new();
    let named = places.values().enumerate().map(|(row, (at, names))| {
        let name = names.join(", ");
        if name.chars().count() <= LONGEST_NAME {
            return (*at, name);
        }
        let number = format!("({})", row + 1);
        list.extend(listed(&number, names, wide));
        (*at, number)
    });
    let named: Vec<_> = named.collect();
    if !elsewhere.is_empty() {
        list.extend(listed("place unknown:", &elsewhere, wide));
    }
    let height = DRAWING + 30.0 + LINE * list.len() as f64;
    svg(name, title, (wide, height), |area| {
        view.lines(area, &frame.lines, &frame.nodes, Pen::solid(SILVER, 1.1))?;
        let mut x = EDGE;
        let drawn = [
            !named.is_empty(),
            !report.supports.is_empty(),
            numbered && !report.grids.is_empty(),
        ];
        let kinds = [
            (SENSOR, "sensor"),
            (support(true), "held"),
            (support(false), "grid"),
        ]
        .into_iter()
        .zip(drawn);
        for ((form, words), _) in kinds.filter(|(_, is_drawn)| *is_drawn) {
            marked(area, (x, 18.0), form, words)?;
            x += 40.0 + 7.2 * words.len() as f64;
        }
        let at = if wide < WIDE {
            (EDGE, 18.0 + LINE)
        } else {
            (x, 18.0)
        };
        write_lines(area, &axes, at, START)?;
        for at in &report.supports {
            mark(area, view.place(*at), support(true))?;
        }
        let mut names = Names(Vec::new(), [4.0, upper - 20.0, wide - 4.0, DRAWING]);
        for (at, name) in &named {
            mark(area, view.place(*at), SENSOR)?;
            names.write(area, name, view.place(*at), VERMILION)?;
        }
        for (label, at) in report.grids.iter().filter(|_| numbered) {
            if !report.supports.contains(at) {
                mark(area, view.place(*at), support(false))?;
            }
            names.write(area, &label.to_string(), view.place(*at), BLUE)?;
        }
        write_lines(area, &list, (EDGE, DRAWING + 18.0), START)
    })
}

/// Names in lines that a figure has room for, after what they have in common.
fn listed(first: &str, names: &[&str], wide: f64) -> Vec<String> {
    let names: Vec<String> = names.iter().map(|name| format!("{name},")).collect();
    let words = once(first).chain(names.iter().map(String::as_str));
    let lines = lines(words, letters_across(wide, START.height));
    lines
        .iter()
        .map(|line| line.trim_end_matches(',').to_owned())
        .collect()
}
