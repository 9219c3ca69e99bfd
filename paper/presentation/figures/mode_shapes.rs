//! Mode shapes of the test, the first and the corrected model as color on panels (Figure 6).

use super::canvas::*;
use super::view::View;
use corfem::present::frame::{DrawnMode, DrawnModes, Frame};
use corfem::present::table::Digits;
use nalgebra::Vector3;

/// Height above all modes, and of one mode's row, px.
const HEAD: f64 = 62.0;
const HIGH: f64 = 136.0;
/// Columns of a mode.
const ACROSS: f64 = 5.0;
/// The end of a path of neighbors of one color, which the plotting library does not know.
const CLOSED: &str = "\"/>\n";

/// The modes whose shape in the first model is at least as far from the test's as the mean over all.
pub fn differing(drawn: &DrawnModes) -> DrawnModes {
    let far = |mode: &DrawnMode| -> f64 {
        let known = drawn.frame.known.keys();
        known
            .map(|&node| (mode.moved[1][node] - mode.moved[0][node]).norm_squared())
            .sum()
    };
    let mean = drawn.modes.iter().map(far).sum::<f64>() / drawn.modes.len() as f64;
    let differs = |mode: &&DrawnMode| far(mode) >= mean;
    DrawnModes {
        frame: drawn.frame.clone(),
        modes: drawn.modes.iter().filter(differs).cloned().collect(),
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

/// A column of a mode: its name, words on its size, and its motions.
type Column = (String, String, Vec<Vector3<f64>>);

/// Test, first and corrected model, and what the two differ from the test by, the larger of these with its most in the full color.
fn columns(mode: &DrawnMode) -> [Column; 5] {
    let most = [1, 2].map(|state| apart(mode, state).map(|it| it.amax()).fold(0.0, f64::max));
    let full = most[0].max(most[1]).max(f64::MIN_POSITIVE);
    [0, 1, 2, 3, 4].map(|column: usize| {
        let is_difference = column > 2;
        let state = if is_difference { column - 2 } else { column };
        let name = ["test", "first", "corrected"][state];
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

/// The shapes as SVG, one row a mode: test, first and corrected model, and the differences of the two from the test.
pub fn draw(drawn: &DrawnModes, name: &str, title: &str) -> Result<String, PresentError> {
    let frame = &drawn.frame;
    let nodes = &frame.nodes;
    let closed = |panel: &Vec<usize>| panel.iter().chain(panel.first()).copied().collect();
    let outlines: Vec<Vec<usize>> = frame.panels.iter().map(closed).collect();
    let shown: Vec<Vector3<f64>> = frame
        .panels
        .iter()
        .flatten()
        .map(|&node| nodes[node])
        .collect();
    let words = paragraph(
        "Blue moves along +z, red along −z, the fainter, the less; 1 is the largest motion of a shape. The larger difference of a mode has \
         the full color.",
    );
    let head = HEAD + LINE * (words.len() - 1) as f64;
    let pitch = 26.0 + HIGH;
    let cell = (WIDE - EDGE) / ACROSS;
    let mut cells = String::new();
    let height = head + pitch * drawn.modes.len() as f64;
    let svg = svg(name, title, height, |area| {
        write_lines(area, &words, (EDGE, 20.0), START)?;
        for (row, mode) in drawn.modes.iter().enumerate() {
            let above = head + pitch * row as f64;
            let number = format!("Mode {}", mode.number);
            write(area, &number, (EDGE, above - 8.0), START.bold())?;
            for (column, (name, value, moved)) in columns(mode).into_iter().enumerate() {
                let left = EDGE + cell * column as f64;
                write(area, &name, (left, above + 12.0), START)?;
                write(area, &value, (left, above + 28.0), START.small())?;
                let room = [left, above + 40.0, cell - EDGE, HIGH - 54.0];
                let view = View::plan().fitted(&shown, room);
                let mut last = None;
                for (corners, motion) in panel_parts(frame, &moved) {
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
    Ok(svg.replacen("<text ", &(cells.unwrap_or_default() + "<text "), 1))
}

/// Parts of a panel along either side.
const PARTS: usize = 6;

/// A place and its displacement upward.
type Corner = (Vector3<f64>, f64);

/// The panels in parts, each with its mean displacement upward; of one panel those of one color stand together.
fn panel_parts(frame: &Frame, moved: &[Vector3<f64>]) -> Vec<(Vec<Vector3<f64>>, f64)> {
    let of_panel = |panel: &Vec<usize>| {
        let corner = |&node: &usize| (frame.nodes[node], moved[node].z);
        let corners: Vec<Corner> = panel.iter().map(corner).collect();
        let colored = |cell: Vec<Corner>| {
            let motion = cell.iter().map(|corner| corner.1).sum::<f64>() / cell.len() as f64;
            (cell.into_iter().map(|corner| corner.0).collect(), motion)
        };
        let mut cells: Vec<_> = cells(corners).into_iter().map(colored).collect();
        cells.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        cells
    };
    frame.panels.iter().flat_map(of_panel).collect()
}

/// A panel of four corners in its parts, by its bilinear map; any other panel whole.
fn cells(corners: Vec<Corner>) -> Vec<Vec<Corner>> {
    let [a, b, c, d] = corners[..] else {
        return vec![corners];
    };
    let at = |i: usize, j: usize| {
        let (s, t) = (i as f64 / PARTS as f64, j as f64 / PARTS as f64);
        let parts = [
            ((1.0 - s) * (1.0 - t), a),
            (s * (1.0 - t), b),
            (s * t, c),
            ((1.0 - s) * t, d),
        ];
        parts
            .into_iter()
            .fold((Vector3::zeros(), 0.0), |sum, (part, corner)| {
                (sum.0 + part * corner.0, sum.1 + part * corner.1)
            })
    };
    let places = (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (i, j)));
    places
        .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect()
}
