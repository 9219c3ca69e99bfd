//! Mode shapes of the test, the first and the corrected model (Figure 6): as color on panels, or as lines over each other.

use super::canvas::*;
use super::view::{Room, View};
use corfem::present::frame::{DrawnMode, DrawnModes, Frame, extents};
use corfem::present::table::Digits;
use nalgebra::Vector3;

/// Lines so wide that each is seen where all three lie on each other.
fn pens() -> [(&'static str, Pen); 3] {
    [
        ("test", Pen::solid(between(WHITE, ORANGE, 0.6), 7.0)),
        ("first", Pen::solid(SKY, 4.0)),
        ("corrected", Pen::solid(INK, 1.0)),
    ]
}

/// Modes of one figure, and side by side in it.
const MOST_MODES: usize = 12;
const ACROSS: usize = 3;
/// Height of a mode's cell, and above all of them, px.
const HIGH: f64 = 178.0;
const HEAD: f64 = 62.0;
/// The end of a path of neighbors of one color, which the plotting library does not know.
const CLOSED: &str = "\"/>\n";

fn motions(drawn: &DrawnModes) -> impl Iterator<Item = &Vector3<f64>> {
    drawn
        .modes
        .iter()
        .flat_map(|mode| mode.moved.iter().flatten())
}

/// The modes in as many figures as their number needs, each with the words that its name and title end with.
pub fn parts(drawn: &DrawnModes) -> Vec<(String, DrawnModes)> {
    let part = |modes: &[_]| DrawnModes {
        frame: drawn.frame.clone(),
        modes: modes.to_vec(),
    };
    let parts = drawn.modes.chunks(MOST_MODES).map(part).enumerate();
    let is_one = drawn.modes.len() <= MOST_MODES;
    parts
        .map(|(row, modes)| {
            (
                if is_one {
                    String::new()
                } else {
                    format!("_{}", row + 1)
                },
                modes,
            )
        })
        .collect()
}

/// The modes whose shape in the first model is at least as far from the test's as the mean over all; every mode where all are
/// alike.
pub fn differing(drawn: &DrawnModes) -> DrawnModes {
    let far = |mode: &DrawnMode| -> f64 {
        let known = drawn.frame.known.keys();
        known
            .map(|&node| (mode.moved[1][node] - mode.moved[0][node]).norm_squared())
            .sum()
    };
    let shaped = || drawn.modes.iter().filter(|mode| !mode.moved[0].is_empty());
    let all: Vec<f64> = shaped().map(far).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    // Rounding may lift the mean of equal numbers above them.
    let least = all.iter().copied().fold(0.0, f64::max).min(mean);
    let differs = |mode: &&DrawnMode| far(mode) >= least;
    DrawnModes {
        frame: drawn.frame.clone(),
        modes: shaped().filter(differs).cloned().collect(),
    }
}

/// Motions of a state of a mode without those of the test.
fn apart(mode: &DrawnMode, state: usize) -> impl Iterator<Item = Vector3<f64>> {
    let pairs = mode.moved[state].iter().zip(&mode.moved[0]);
    pairs.map(|(own, test)| own - test)
}

/// The farthest that a place is from the test's in a state of any mode, in units of the largest motion of a shape.
pub fn farthest(drawn: &DrawnModes, state: usize) -> f64 {
    let all = drawn.modes.iter().flat_map(|mode| apart(mode, state));
    all.map(|motion| motion.amax()).fold(0.0, f64::max)
}

/// The axis along which all modes move most.
fn main_axis(drawn: &DrawnModes) -> Vector3<f64> {
    let squares = motions(drawn).map(|motion| motion.component_mul(motion));
    let most = squares.sum::<Vector3<f64>>().imax();
    Vector3::from_fn(|axis, _| f64::from(axis == most))
}

/// The shapes as SVG: as color on the panels by the motion along the main axis, as displaced lines where there are no panels or
/// all moves within a plane.
pub fn draw(
    drawn: &DrawnModes,
    name: &str,
    title: &str,
    wide: f64,
) -> Result<String, PresentError> {
    let nodes = &drawn.frame.nodes;
    let in_plane = View::flat(nodes)
        .filter(|(normal, _)| motions(drawn).all(|motion| motion.dot(normal) == 0.0));
    if in_plane.is_none() && !drawn.frame.panels.is_empty() {
        return draw_colors(drawn, name, title, wide);
    }
    // The largest displacement is drawn as long as a sixth of the structure.
    let far = extents(nodes).max() / 6.0;
    let (view, heights) = in_plane.map_or_else(|| View::solid(nodes), |(_, view)| (view, 1.0));
    // Depths are exaggerated, displacements are not.
    let displaced = |at: &Vector3<f64>, motion: &Vector3<f64>| {
        at + far * Vector3::new(motion.x, motion.y, motion.z / heights)
    };
    each(drawn, name, title, wide, |area, mode, room| {
        let moved = mode.moved.each_ref().map(|motions| {
            nodes
                .iter()
                .zip(motions)
                .map(|(at, motion)| displaced(at, motion))
                .collect::<Vec<_>>()
        });
        let view = view.fitted(
            &[&nodes[..], &moved[0], &moved[1], &moved[2]].concat(),
            room,
        );
        let still = (nodes, Pen::solid(PALE, 1.0));
        let states = moved
            .iter()
            .zip(pens())
            .map(|(nodes, (_, pen))| (nodes, pen));
        for (nodes, pen) in std::iter::once(still).chain(states) {
            view.lines(area, &drawn.frame.lines, nodes, pen)?;
            for &node in drawn
                .frame
                .known
                .keys()
                .filter(|_| drawn.frame.lines.is_empty())
            {
                mark(
                    area,
                    view.place(nodes[node]),
                    Mark(Form::Circle, 0.5 + pen.1, None, Pen(pen.0, 1.2, pen.2)),
                )?;
            }
        }
        Ok(())
    })
}

/// A column of a mode: its name, words on its size, and its motions.
type Column = (String, String, Vec<Vector3<f64>>);

/// Test, first and corrected model, and what the two differ from the test by, the larger of these with its most in the full color.
fn columns(mode: &DrawnMode) -> [Column; 5] {
    let most = [1, 2].map(|state| apart(mode, state).map(|it| it.amax()).fold(0.0, f64::max));
    let full = most[0].max(most[1]).max(f64::MIN_POSITIVE);
    [0, 1, 2, 3, 4].map(|column: usize| {
        let is_difference = column > 2;
        let state = if is_difference { column - 2 } else { column };
        let name = pens()[state].0;
        if is_difference {
            let most = Digits::Fixed(2).write(most[state - 1]);
            let motions = apart(mode, state).map(|it| it / full).collect();
            (format!("{name} − test"), format!("{most} at most"), motions)
        } else {
            let hertz = Digits::Significant(4).write(mode.hertz[state]) + " Hz";
            (name.to_owned(), hertz, mode.moved[state].clone())
        }
    })
}

/// One row a mode: test, first and corrected model, and the differences of the two from the test, below the two in the narrow form.
fn draw_colors(
    drawn: &DrawnModes,
    name: &str,
    title: &str,
    wide: f64,
) -> Result<String, PresentError> {
    let (frame, axis) = (&drawn.frame, main_axis(drawn));
    let nodes = &frame.nodes;
    let view = View::flat(nodes).map_or_else(|| View::solid(nodes).0, |(_, view)| view);
    let closed = |panel: &Vec<usize>| panel.iter().chain(panel.first()).copied().collect();
    let outlines: Vec<Vec<usize>> = frame.panels.iter().map(closed).collect();
    let shown: Vec<Vector3<f64>> = frame
        .panels
        .iter()
        .flatten()
        .map(|&node| nodes[node])
        .collect();
    let letter = ["x", "y", "z"][axis.imax()];
    let words = format!(
        "Blue moves along +{letter}, red along −{letter}, the fainter, the less; 1 is the largest motion of a shape. The larger difference of \
         a mode has the full color."
    );
    let words = paragraph(&words, wide);
    // Columns, and height of one row of them.
    let (across, high) = if wide < WIDE { (3, 116.0) } else { (5, 136.0) };
    let head = HEAD + LINE * (words.len() - 1) as f64;
    let pitch = 26.0 + high * if wide < WIDE { 2.0 } else { 1.0 };
    let cell = (wide - EDGE) / across as f64;
    let mut cells = String::new();
    let size = (wide, head + pitch * drawn.modes.len() as f64);
    let svg = draft(name, title, size, |area| {
        write_lines(area, &words, (EDGE, 20.0), START)?;
        for (row, mode) in drawn.modes.iter().enumerate() {
            let above = head + pitch * row as f64;
            let number = format!("Mode {}", mode.number);
            write(area, &number, (EDGE, above - 8.0), START.bold())?;
            for (place, (name, value, moved)) in columns(mode).into_iter().enumerate() {
                // The second row of the narrow form begins below the first model.
                let (down, column) = (place / across, place % across + place / across);
                let left = EDGE + cell * column as f64;
                let top_of = above + high * down as f64;
                let letters = if wide < WIDE { START.small() } else { START };
                write(area, &name, (left, top_of + 12.0), letters)?;
                write(area, &value, (left, top_of + 28.0), START.small())?;
                let room = [left, top_of + 40.0, cell - EDGE, high - 54.0];
                let view = view.fitted(&shown, room);
                let mut last = None;
                for (corners, motion) in panel_parts(frame, &axis, &moved) {
                    let color = hex(toned(motion));
                    if last.as_ref() != Some(&color) {
                        cells += &format!(
                            "{CLOSED}<path fill=\"{color}\" stroke=\"{color}\" stroke-width=\"4\" d=\""
                        );
                    }
                    last = Some(color);
                    let corner = |&at: &Vector3<f64>| {
                        let (x, y) = view.place(at);
                        format!("{} {}", units(x), units(y + top(area)))
                    };
                    let corners: Vec<String> = corners.iter().map(corner).collect();
                    cells += &format!("M{}z", corners.join(" "));
                }
                view.lines(area, &outlines, nodes, Pen::solid(SILVER, 0.8))?;
            }
        }
        Ok(())
    })?;
    // Behind the page and before all else; the first has none before it to close.
    let cells = cells
        .strip_prefix(CLOSED)
        .map(|cells| format!("{cells}{CLOSED}"));
    Ok(finished(&svg.replacen(
        "<text ",
        &(cells.unwrap_or_default() + "<text "),
        1,
    )))
}

/// Every mode in a cell of its own, beside each other where there is room.
fn each(
    drawn: &DrawnModes,
    name: &str,
    title: &str,
    wide: f64,
    draw: impl Fn(&Area, &DrawnMode, Room) -> Drawn,
) -> Result<String, PresentError> {
    let across = if wide < WIDE { 1 } else { ACROSS };
    let cell = (wide - EDGE) / across as f64;
    let height = HEAD + HIGH * drawn.modes.len().div_ceil(across) as f64;
    svg(name, title, (wide, height), |area| {
        let mut x = EDGE;
        for (name, pen) in pens() {
            line(area, &[(x, 20.0), (x + 36.0, 20.0)], pen)?;
            write(area, name, (x + 43.0, 20.0), START)?;
            x += 72.0 + 6.8 * name.len() as f64;
        }
        let words = "frequencies in Hz: test | first | corrected";
        write(area, words, (EDGE, 44.0), START)?;
        for (row, mode) in drawn.modes.iter().enumerate() {
            let (x, y) = (
                EDGE + cell * (row % across) as f64,
                HEAD + HIGH * (row / across) as f64,
            );
            let name = format!("Mode {}", mode.number);
            write(area, &name, (x, y + 14.0), START.bold())?;
            let hertz = mode.hertz.map(|hertz| Digits::Significant(4).write(hertz));
            let beside = (x + 8.0 + 7.8 * name.len() as f64, y + 14.0);
            write(area, &hertz.join(" | "), beside, START.small())?;
            draw(area, mode, [x, y + 30.0, cell - 20.0, HIGH - 48.0])?;
        }
        Ok(())
    })
}

/// The panels in parts, each with its mean displacement along an axis; those above and before others last.
pub fn panel_parts(
    frame: &Frame,
    along: &Vector3<f64>,
    moved: &[Vector3<f64>],
) -> Vec<(Vec<Vector3<f64>>, f64)> {
    // As many as a figure has room for.
    let parts = (300.0 / frame.panels.len() as f64)
        .sqrt()
        .round()
        .clamp(1.0, 6.0) as usize;
    let corner = |&node: &usize| (frame.nodes[node], moved[node].dot(along));
    let panels = frame
        .panels
        .iter()
        .map(|panel| panel.iter().map(corner).collect());
    let mut panels: Vec<(f64, Vec<Corner>)> = panels
        .map(|corners: Vec<Corner>| {
            let middle = middle(&corners).0;
            (10.0 * middle.z + middle.x - middle.y, corners)
        })
        .collect();
    panels.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let colored = |cell: Vec<Corner>| {
        let corners = cell.iter().map(|corner| corner.0).collect();
        (corners, middle(&cell).1)
    };
    // Cells of a panel do not cover each other: those of one color stand together.
    let of_panel = |(_, corners): (f64, Vec<Corner>)| {
        let mut cells: Vec<(Vec<Vector3<f64>>, f64)> =
            cells(corners, parts).into_iter().map(colored).collect();
        cells.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        cells
    };
    panels.into_iter().flat_map(of_panel).collect()
}

/// A place and its displacement.
type Corner = (Vector3<f64>, f64);

fn mean(corners: &[(f64, Corner)]) -> Corner {
    corners
        .iter()
        .fold((Vector3::zeros(), 0.0), |sum, (part, corner)| {
            (sum.0 + *part * corner.0, sum.1 + part * corner.1)
        })
}

fn middle(corners: &[Corner]) -> Corner {
    let share = 1.0 / corners.len() as f64;
    let all: Vec<(f64, Corner)> = corners.iter().map(|&corner| (share, corner)).collect();
    mean(&all)
}

/// A panel of four corners in so many parts a side, by its bilinear map; any other panel whole.
fn cells(corners: Vec<Corner>, parts: usize) -> Vec<Vec<Corner>> {
    let [a, b, c, d] = corners[..] else {
        return vec![corners];
    };
    let at = |i: usize, j: usize| {
        let (s, t) = (i as f64 / parts as f64, j as f64 / parts as f64);
        mean(&[
            ((1.0 - s) * (1.0 - t), a),
            (s * (1.0 - t), b),
            (s * t, c),
            ((1.0 - s) * t, d),
        ])
    };
    let places = (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j)));
    places
        .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect()
}
