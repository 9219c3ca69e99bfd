//! Mode shapes of the test, the first and the corrected model (Figure 6): as color on panels, or as lines over each other.

use super::canvas::{HEAD as TITLE, *};
use super::frame::Frame;
use super::view::{Room, View, extents};
use crate::method::linear_algebra::check_shape;
use crate::present::report::Report;
use crate::present::table::Digits;
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
const CELL: (f64, f64) = (WIDTH / ACROSS as f64, 178.0);
const HEAD: f64 = 62.0;
/// Shades between white and a full color: neighbors of one shade are one path, which the plotting library does not know.
const SHADES: f64 = 20.0;
/// The end of such a path.
const CLOSED: &str = "\"/>\n";

/// A test mode and its partners as drawn: of test, first and corrected model.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnMode {
    /// Number of the mode, from one.
    pub number: usize,
    /// Frequencies, Hz.
    pub hertz: [f64; 3],
    /// Displacements of the frame's nodes.
    pub moved: [Vec<Vector3<f64>>; 3],
}

/// Modes as drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnModes {
    /// The structure.
    pub frame: Frame,
    /// Modes of the structure.
    pub modes: Vec<DrawnMode>,
}

impl DrawnModes {
    /// All modes of a report, in the order and with the signs of the test modes; none when no sensor has a place and a direction.
    ///
    /// # Errors
    /// [`WrongShape`](crate::method::error::Error::WrongShape) unless every row of the shapes has a sensor.
    pub fn from_report(report: &Report) -> Result<Option<Self>, PresentError> {
        let mut frame = Frame::from_report(report);
        if frame.known.values().all(Vec::is_empty) {
            return Ok(None);
        }
        // Nothing is measured near a support: a color there would come from the interpolation.
        if report.moved.is_none() {
            let is_held = |node: &usize| frame.known.get(node).is_some_and(Vec::is_empty);
            frame.panels.retain(|panel| !panel.iter().any(is_held));
        }
        let test = &report.test;
        check_shape(
            "mode shapes",
            &test.shapes,
            report.sensors.len(),
            test.len(),
        )?;
        let checks = [&report.initial, report.corrected()];
        let [first, corrected] = checks.map(|check| check.pairing.paired(&check.modes));
        let states = [test.clone(), first?, corrected?];
        let mode = |mode: usize| DrawnMode {
            number: report.mode_number(mode),
            hertz: states.each_ref().map(|modes| modes.frequencies_hz()[mode]),
            moved: [0, 1, 2].map(|state| {
                let grids = report
                    .moved
                    .as_ref()
                    .and_then(|moved| moved[state].get(mode));
                frame.moved(
                    states[state].shapes.column(mode).as_slice(),
                    grids.map(Vec::as_slice),
                )
            }),
        };
        Ok(Some(Self {
            modes: (0..test.len()).map(mode).collect(),
            frame,
        }))
    }

    fn motions(&self) -> impl Iterator<Item = &Vector3<f64>> {
        self.modes
            .iter()
            .flat_map(|mode| mode.moved.iter().flatten())
    }

    /// The modes in as many figures as their number needs, each with the words that its name and title end with.
    pub fn parts(&self) -> Vec<(String, Self)> {
        let part = |modes: &[_]| Self {
            frame: self.frame.clone(),
            modes: modes.to_vec(),
        };
        let parts = self.modes.chunks(MOST_MODES).map(part).enumerate();
        let is_one = self.modes.len() <= MOST_MODES;
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
    pub(crate) fn differing(&self) -> Self {
        let far = |mode: &DrawnMode| -> f64 {
            let known = self.frame.known.keys();
            known
                .map(|&node| (mode.moved[1][node] - mode.moved[0][node]).norm_squared())
                .sum()
        };
        let all: Vec<f64> = self.modes.iter().map(far).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        // Rounding may lift the mean of equal numbers above them.
        let least = all.iter().copied().fold(0.0, f64::max).min(mean);
        let differs = |mode: &&DrawnMode| far(mode) >= least;
        Self {
            frame: self.frame.clone(),
            modes: self.modes.iter().filter(differs).cloned().collect(),
        }
    }

    /// The axis along which all modes move most.
    fn main_axis(&self) -> Vector3<f64> {
        let squares = self.motions().map(|motion| motion.component_mul(motion));
        let most = squares.sum::<Vector3<f64>>().imax();
        Vector3::from_fn(|axis, _| f64::from(axis == most))
    }

    /// The shapes as SVG: as color on the panels by the motion along the main axis, as displaced lines where there are no panels or
    /// all moves within a plane.
    pub fn draw(&self, name: &str, title: &str) -> Result<String, PresentError> {
        let nodes = &self.frame.nodes;
        let in_plane = View::flat(nodes)
            .filter(|(normal, _)| self.motions().all(|motion| motion.dot(normal) == 0.0));
        if in_plane.is_none() && !self.frame.panels.is_empty() {
            return self.draw_colors(name, title);
        }
        // The largest displacement is drawn as long as a sixth of the structure.
        let far = extents(nodes).max() / 6.0;
        let (view, heights) = in_plane.map_or_else(|| View::solid(nodes), |(_, view)| (view, 1.0));
        // Depths are exaggerated, displacements are not.
        let displaced = |at: &Vector3<f64>, motion: &Vector3<f64>| {
            at + far * Vector3::new(motion.x, motion.y, motion.z / heights)
        };
        self.each(name, title, |area, mode, room| {
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
                view.lines(area, &self.frame.lines, nodes, pen)?;
                for &node in self
                    .frame
                    .known
                    .keys()
                    .filter(|_| self.frame.lines.is_empty())
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

    /// One row a mode: test, first and corrected model.
    fn draw_colors(&self, name: &str, title: &str) -> Result<String, PresentError> {
        let (frame, axis) = (&self.frame, self.main_axis());
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
        let mut cells = String::new();
        let words = format!("Blue moves along +{letter}, red along −{letter}, white not at all.");
        let svg = svg(
            name,
            title,
            HEAD + CELL.1 * self.modes.len() as f64,
            |area| {
                write(area, &words, (14.0, 20.0), START)?;
                for (row, mode) in self.modes.iter().enumerate() {
                    let top = HEAD + CELL.1 * row as f64;
                    write(
                        area,
                        &format!("Mode {}", mode.number),
                        (14.0, top - 8.0),
                        START.bold(),
                    )?;
                    for (column, (name, _)) in pens().iter().enumerate() {
                        let left = CELL.0 * column as f64 + 14.0;
                        let room = [left, top + 26.0, CELL.0 - 34.0, CELL.1 - 48.0];
                        let view = view.fitted(&shown, room);
                        let hertz = Digits::Significant(4).write(mode.hertz[column]);
                        write(
                            area,
                            &format!("{name}: {hertz} Hz"),
                            (left, top + 12.0),
                            START,
                        )?;
                        let mut last = None;
                        for (corners, motion) in frame.parts(&axis, &mode.moved[column]) {
                            let strong = if motion < 0.0 { VERMILION } else { BLUE };
                            let strength = (SHADES * motion.abs().min(1.0)).round() / SHADES;
                            let fill = between(WHITE, strong, strength);
                            if last.replace(fill).is_none_or(|last| last != fill) {
                                let color = format!("#{:02X}{:02X}{:02X}", fill.0, fill.1, fill.2);
                                cells += &format!(
                                    "{CLOSED}<path fill=\"{color}\" stroke=\"{color}\" stroke-width=\"4\" d=\""
                                );
                            }
                            let corner = |&at: &Vector3<f64>| {
                                let (x, y) = view.place(at);
                                format!("{} {}", units(x), units(y + TITLE))
                            };
                            let corners: Vec<String> = corners.iter().map(corner).collect();
                            cells += &format!("M{}z", corners.join(" "));
                        }
                        view.lines(area, &outlines, nodes, Pen::solid(SILVER, 0.8))?;
                    }
                }
                Ok(())
            },
        )?;
        // Behind the page and before all else; the first has none before it to close.
        let cells = cells
            .strip_prefix(CLOSED)
            .map(|cells| format!("{cells}{CLOSED}"));
        Ok(svg.replacen("<text ", &(cells.unwrap_or_default() + "<text "), 1))
    }

    fn each(
        &self,
        name: &str,
        title: &str,
        draw: impl Fn(&Area, &DrawnMode, Room) -> Drawn,
    ) -> Result<String, PresentError> {
        let height = HEAD + CELL.1 * self.modes.len().div_ceil(ACROSS) as f64;
        svg(name, title, height, |area| {
            let mut x = 14.0;
            for (name, pen) in pens() {
                line(area, &[(x, 20.0), (x + 36.0, 20.0)], pen)?;
                write(area, name, (x + 43.0, 20.0), START)?;
                x += 72.0 + 6.8 * name.len() as f64;
            }
            write(
                area,
                "frequencies in Hz: test | first | corrected",
                (14.0, 44.0),
                START,
            )?;
            for (row, mode) in self.modes.iter().enumerate() {
                let (x, y) = (
                    CELL.0 * (row % ACROSS) as f64 + 14.0,
                    HEAD + CELL.1 * (row / ACROSS) as f64,
                );
                let name = format!("Mode {}", mode.number);
                write(area, &name, (x, y + 14.0), START.bold())?;
                let hertz = mode.hertz.map(|hertz| Digits::Significant(4).write(hertz));
                let beside = (x + 8.0 + 7.8 * name.len() as f64, y + 14.0);
                write(area, &hertz.join(" | "), beside, START.small())?;
                draw(area, mode, [x, y + 30.0, CELL.0 - 34.0, CELL.1 - 48.0])?;
            }
            Ok(())
        })
    }
}
