//! Mode shapes of the test, the first and the corrected model as color on panels (Figure 6).

use super::super::report::CaseReport;
use super::canvas::*;
use super::view::View;
use corfem::method::error::Error;
use corfem::present::table::Digits;
use corfem::weighted::comparison::ExactResult;
use nalgebra::Vector3;

/// Height above all modes, and of one mode's row, px.
const HEAD: f64 = 62.0;
const HIGH: f64 = 136.0;
/// Columns of a mode.
const ACROSS: f64 = 5.0;
/// The end of a path of neighbors of one color, which the plotting library does not know.
const CLOSED: &str = "\"/>\n";

/// A test mode and its partners at the dynamic points: of test, first and corrected model.
#[derive(Debug, Clone)]
pub struct DrawnMode {
    /// Number of the mode, from one.
    pub number: usize,
    /// Frequencies, Hz.
    pub hertz: [f64; 3],
    /// Displacements upward, in units of the largest of the shape.
    pub moved: [Vec<f64>; 3],
}

/// The modes of a case whose shape in the first model is at least as far from the test's as the mean over all.
///
/// # Errors
/// Errors of the pairs.
pub fn differing(report: &CaseReport) -> Result<Vec<DrawnMode>, Error> {
    let compared = report.compared();
    let paired = |check: &ExactResult| check.pairing.paired(&check.modes);
    let states = [
        report.result.test.clone(),
        paired(&report.first)?,
        paired(&report.last)?,
    ];
    let mode = |mode: usize| DrawnMode {
        number: compared.numbers[mode],
        hertz: states.each_ref().map(|modes| modes.frequencies_hz()[mode]),
        moved: states.each_ref().map(|modes| {
            let shape = modes.shapes().column(mode);
            (shape / shape.amax()).iter().copied().collect()
        }),
    };
    let modes: Vec<DrawnMode> = (0..compared.numbers.len()).map(mode).collect();
    let far = |mode: &DrawnMode| apart(mode, 1).map(|off| off * off).sum::<f64>();
    let mean = modes.iter().map(far).sum::<f64>() / modes.len() as f64;
    Ok(modes.into_iter().filter(|mode| far(mode) >= mean).collect())
}

/// Motions of a state of a mode without those of the test.
fn apart(mode: &DrawnMode, state: usize) -> impl Iterator<Item = f64> {
    let pairs = mode.moved[state].iter().zip(&mode.moved[0]);
    pairs.map(|(own, test)| own - test)
}

/// The farthest that a point is from the test's in a state of any mode, in units of the largest motion of a shape.
pub fn farthest(modes: &[DrawnMode], state: usize) -> f64 {
    let all = modes.iter().flat_map(|mode| apart(mode, state));
    all.map(f64::abs).fold(0.0, f64::max)
}

/// A column of a mode: its name, words on its size, and its motions.
type Column = (String, String, Vec<f64>);

/// Test, first and corrected model, and what the two differ from the test by, the larger of these with its most in the full color.
fn columns(mode: &DrawnMode) -> [Column; 5] {
    let most = [1, 2].map(|state| apart(mode, state).map(f64::abs).fold(0.0, f64::max));
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
pub fn draw(
    modes: &[DrawnMode],
    points: &[Vector3<f64>],
    name: &str,
    title: &str,
) -> Result<String, PresentError> {
    let outlines = BAYS.map(|[a, b, c, d]| vec![a, b, c, d, a]);
    let words = paragraph(
        "Blue moves along +z, red along −z, the fainter, the less; 1 is the largest motion of a shape. The larger difference of a mode has \
         the full color.",
    );
    let head = HEAD + LINE * (words.len() - 1) as f64;
    let pitch = 26.0 + HIGH;
    let cell = (WIDE - EDGE) / ACROSS;
    let mut cells = String::new();
    let height = head + pitch * modes.len() as f64;
    let svg = svg(name, title, height, |area| {
        write_lines(area, &words, (EDGE, 20.0), START)?;
        for (row, mode) in modes.iter().enumerate() {
            let above = head + pitch * row as f64;
            let number = format!("Mode {}", mode.number);
            write(area, &number, (EDGE, above - 8.0), START.bold())?;
            for (column, (name, value, moved)) in columns(mode).into_iter().enumerate() {
                let left = EDGE + cell * column as f64;
                write(area, &name, (left, above + 12.0), START)?;
                write(area, &value, (left, above + 28.0), START.small())?;
                let room = [left, above + 40.0, cell - EDGE, HIGH - 54.0];
                let view = View::plan().fitted(points, room);
                let mut last = None;
                for (corners, motion) in panel_parts(points, &moved) {
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
                view.lines(area, &outlines, points, Pen::solid(SILVER, 0.8))?;
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

/// Corners of the bays between the dynamic points, of which three stand on every chord; nothing is measured nearer the root.
const BAYS: [[usize; 4]; 4] = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
/// Parts of a bay along either side.
const PARTS: usize = 6;

/// A place and its displacement upward.
type Corner = (Vector3<f64>, f64);

/// The bays in parts, each with its mean displacement upward; of one bay those of one color stand together.
fn panel_parts(points: &[Vector3<f64>], moved: &[f64]) -> Vec<(Vec<Vector3<f64>>, f64)> {
    let of_panel = |bay: [usize; 4]| {
        let corners = bay.map(|point| (points[point], moved[point]));
        let colored = |cell: Vec<Corner>| {
            let motion = cell.iter().map(|corner| corner.1).sum::<f64>() / cell.len() as f64;
            (cell.into_iter().map(|corner| corner.0).collect(), motion)
        };
        let mut cells: Vec<_> = cells(corners).into_iter().map(colored).collect();
        cells.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        cells
    };
    BAYS.into_iter().flat_map(of_panel).collect()
}

/// A bay in its parts, by its bilinear map.
fn cells([a, b, c, d]: [Corner; 4]) -> Vec<Vec<Corner>> {
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
