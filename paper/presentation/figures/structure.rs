//! The box with its grids, supports and dynamic points (Figure 2).

use super::canvas::*;
use super::view::{AXES, View};
use corfem::method::structure::{Grid, Point, Structure};
use std::collections::{BTreeMap, BTreeSet};

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

/// Places of a structure, each once, and polylines that pass every edge of its elements once.
fn edges(structure: &Structure) -> (Vec<Point>, Vec<Vec<usize>>) {
    let (mut nodes, mut joined) = (Vec::new(), Vec::<BTreeSet<usize>>::new());
    let mut place: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    for corners in structure.corners() {
        let mut row = |at: &Point| {
            // Minus zero and zero are the same place.
            *place
                .entry((*at).map(|part| (part + 0.0).to_bits()).into())
                .or_insert_with(|| {
                    nodes.push(*at);
                    joined.push(BTreeSet::new());
                    nodes.len() - 1
                })
        };
        let rows: Vec<usize> = corners.iter().map(&mut row).collect();
        for (&a, &b) in rows.iter().zip(rows.iter().cycle().skip(1)) {
            joined[a].insert(b);
            joined[b].insert(a);
        }
    }
    let mut chains = Vec::new();
    for start in 0..joined.len() {
        while !joined[start].is_empty() {
            let (mut chain, mut last) = (vec![start], start);
            while let Some(next) = joined[last].pop_first() {
                joined[next].remove(&last);
                chain.push(next);
                last = next;
            }
            chains.push(chain);
        }
    }
    (nodes, chains)
}

/// The structure with its numbered grids, its supports and its sensors.
pub fn draw_structure(
    name: &str,
    title: &str,
    structure: &Structure,
    sensors: &[Point],
) -> Result<String, PresentError> {
    let (nodes, lines) = edges(structure);
    let grids = structure.grids();
    let is_held = |grid: &Grid| grid.constrained == [true; 3];
    let all: Vec<_> = nodes.iter().chain(sensors).copied().collect();
    let room = [60.0, UPPER, WIDE - 120.0, DRAWING - UPPER - 30.0];
    let view = View::rising(DEPTH_DRAWN).fitted(&all, room);
    svg(name, title, DRAWING + 30.0, |area| {
        view.lines(area, &lines, &nodes, Pen::solid(SILVER, 1.1))?;
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
        for grid in grids.iter().filter(|grid| is_held(grid)) {
            mark(area, view.place(grid.position), support(true))?;
        }
        let mut names = Names(Vec::new());
        for (number, at) in (1..).zip(sensors) {
            mark(area, view.place(*at), SENSOR)?;
            names.write(area, &format!("D{number}"), view.place(*at), VERMILION)?;
        }
        for grid in grids {
            let at = view.place(grid.position);
            if !is_held(grid) {
                mark(area, at, support(false))?;
            }
            names.write(area, &grid.label.to_string(), at, BLUE)?;
        }
        Ok(())
    })
}
