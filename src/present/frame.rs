//! A structure as its sensors see it: places, lines between them, and their motion in a mode.

use crate::method::linear_algebra::check_shape;
use crate::present::PresentError;
use crate::present::report::Report;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::iter::repeat;

/// Sensors of one place: rows of the shapes with their directions.
type Sensors = Vec<(usize, Vector3<f64>)>;

/// Places of a report, the lines and panels that join them, and the places that are known to move or not to.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Every place, once.
    pub nodes: Vec<Vector3<f64>>,
    /// Polylines that pass every line and every edge of a panel once.
    pub lines: Vec<Vec<usize>>,
    /// Panels of three and more corners.
    pub panels: Vec<Vec<usize>>,
    /// Panels and lines with the parameters that scale them.
    pub pieces: Vec<(Vec<usize>, Vec<usize>)>,
    /// Places with sensors, and supports, which have none.
    pub known: BTreeMap<usize, Sensors>,
    /// The grid at every place, by its row, where all motions are drawn as they are.
    pub grids: Vec<Option<usize>>,
}

/// A place to look others up by.
pub fn key(at: &Vector3<f64>) -> [i64; 3] {
    // Minus zero and zero are the same place.
    [at.x, at.y, at.z].map(|component| (component + 0.0).to_bits() as i64)
}

/// True of a place whose coordinates are numbers.
pub fn is_finite(at: &Vector3<f64>) -> bool {
    at.iter().all(|component| component.is_finite())
}

impl Frame {
    /// The frame of a report; places that are not finite are left out.
    ///
    /// Sensors of a structure in one line that all measure along it are drawn across it, upward.
    pub fn from_report(report: &Report) -> Self {
        let (mut nodes, mut row_of) = (Vec::new(), HashMap::new());
        let mut node = |at: &Vector3<f64>| {
            *row_of.entry(key(at)).or_insert_with(|| {
                nodes.push(*at);
                nodes.len() - 1
            })
        };
        let owners = report.owners.iter().cloned().chain(repeat(Vec::new()));
        let pieces = report.frame.iter().zip(owners);
        let pieces: Vec<(Vec<usize>, Vec<usize>)> = pieces
            .filter(|(corners, _)| corners.iter().all(is_finite))
            .map(|(corners, owners)| (corners.iter().map(&mut node).collect(), owners))
            .collect();
        let mut known: BTreeMap<usize, Sensors> = BTreeMap::new();
        for at in report.supports.iter().filter(|at| is_finite(at)) {
            known.entry(node(at)).or_default();
        }
        for (row, sensor) in report.sensors.iter().enumerate() {
            if let Some(at) = sensor.place.as_ref().filter(|at| is_finite(at)) {
                let place = node(at);
                if sensor.direction != Vector3::zeros() {
                    known
                        .entry(place)
                        .or_default()
                        .push((row, sensor.direction));
                }
            }
        }
        let extent = extents(&nodes);
        let axis = Vector3::from_fn(|axis, _| f64::from(axis == extent.imax()));
        let across = if axis.z == 1.0 {
            Vector3::x()
        } else {
            Vector3::z()
        };
        let mut grids = vec![None; nodes.len()];
        for (row, (_, at)) in report.grids.iter().enumerate() {
            row_of
                .get(&key(at))
                .into_iter()
                .for_each(|&node: &usize| grids[node] = Some(row));
        }
        let mut sensors = known.values_mut().flatten().collect::<Vec<_>>();
        if extent.sum() == extent.max()
            && sensors
                .iter()
                .all(|(_, along)| along.cross(&axis) == Vector3::zeros())
        {
            sensors
                .iter_mut()
                .for_each(|(_, along)| *along = along.dot(&axis) * across);
            grids.fill(None);
        }
        let mut joined = vec![BTreeSet::new(); nodes.len()];
        for (piece, _) in &pieces {
            for (&a, &b) in piece
                .iter()
                .zip(piece.iter().cycle().skip(1))
                .filter(|(a, b)| a != b)
            {
                joined[a].insert(b);
                joined[b].insert(a);
            }
        }
        let panels = pieces.iter().map(|(piece, _)| piece.clone());
        Self {
            lines: chained(joined),
            nodes,
            panels: panels.filter(|piece| piece.len() > 2).collect(),
            pieces,
            known,
            grids,
        }
    }

    /// Displacements of all places in a shape whose largest component is one; without a shape that of the grids' motions.
    ///
    /// A place with sensors moves along them as they say, and everywhere else as its grid does, whose motions are given in the
    /// scale of the shape. Without these a support does not move, and any other place as the mean of the known ones, weighted with
    /// $1/r^4$ for a distance of $r$ (Shepard, *Proc. 23rd ACM National Conference* (1968), 517).
    pub fn moved(&self, shape: &[f64], grids: Option<&[Vector3<f64>]>) -> Vec<Vector3<f64>> {
        let of_grids = grids.filter(|_| shape.is_empty()).into_iter().flatten();
        let components = shape.iter().chain(of_grids.flatten());
        let largest = components.fold(0.0, |most: f64, component| most.max(component.abs()));
        let motion = |sensors: &Sensors| -> Vector3<f64> {
            sensors
                .iter()
                .filter_map(|(row, along)| Some(*shape.get(*row)? / largest * along))
                .sum()
        };
        let known: Vec<_> = self
            .known
            .iter()
            .map(|(&node, sensors)| (self.nodes[node], motion(sensors)))
            .collect();
        let size = extents(&self.nodes).norm();
        let at = |place: &Vector3<f64>| {
            let (mut sum, mut total) = (Vector3::zeros(), 0.0);
            for (other, motion) in &known {
                let distance = (place - other).norm() / size;
                if place == other {
                    return *motion;
                }
                let weight = distance.powi(-4).min(1e100);
                (sum, total) = (sum + weight * motion, total + weight);
            }
            if total > 0.0 { sum / total } else { sum }
        };
        let of_grid = |node: usize| {
            let motion = grids?.get(self.grids[node]?)? / largest;
            let sensors = self.known.get(&node).into_iter().flatten();
            let measured = |(row, along): &(usize, Vector3<f64>)| {
                Some((shape.get(*row)? / largest - motion.dot(along)) * along)
            };
            Some(motion + sensors.filter_map(measured).sum::<Vector3<f64>>())
        };
        let nodes = self.nodes.iter().enumerate();
        nodes
            .map(|(node, place)| of_grid(node).unwrap_or_else(|| at(place)))
            .collect()
    }
}

/// Polylines along all lines, each once.
fn chained(mut joined: Vec<BTreeSet<usize>>) -> Vec<Vec<usize>> {
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
    chains
}

/// Extent of points along each axis.
pub fn extents(points: &[Vector3<f64>]) -> Vector3<f64> {
    let both = points.iter().map(|point| (*point, *point));
    let ends = both.reduce(|(low, high), (point, _)| (low.inf(&point), high.sup(&point)));
    ends.map_or_else(Vector3::zeros, |(low, high)| high - low)
}

/// A test mode and its partners as drawn: of test, first and corrected model.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnMode {
    /// Number of the mode, from one.
    pub number: usize,
    /// Frequencies, Hz.
    pub hertz: [f64; 3],
    /// Displacements of the frame's nodes; none of a test mode without a shape.
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
    /// All modes of a report, in the order and with the signs of the test modes, those without shapes last; none when no place is
    /// known, or no sensor has a direction and the models' motions are not known either.
    ///
    /// # Errors
    /// [`WrongShape`](crate::method::error::Error::WrongShape) unless every row of the shapes has a sensor.
    pub fn from_report(report: &Report) -> Result<Option<Self>, PresentError> {
        let mut frame = Frame::from_report(report);
        let is_known = frame.known.values().any(|own| !own.is_empty()) || report.moved.is_some();
        if frame.nodes.is_empty() || !is_known {
            return Ok(None);
        }
        // Nothing is measured near a support: a color there would come from the interpolation.
        if report.moved.is_none() {
            let is_held = |node: &usize| frame.known.get(node).is_some_and(Vec::is_empty);
            frame.panels.retain(|panel| !panel.iter().any(is_held));
        }
        let test = &report.test;
        if test.len() > 0 {
            let sensors = report.sensors.len();
            check_shape("mode shapes", &test.shapes, sensors, test.len())?;
        }
        let checks = [&report.initial, report.corrected()];
        let [first, corrected] = checks.map(|check| check.pairing.paired(&check.modes));
        let states = [test.clone(), first?, corrected?];
        let grids = |state: usize, mode: usize| {
            let moved = report.moved.as_ref()?;
            moved[state].get(mode).map(Vec::as_slice)
        };
        let mut modes = Vec::new();
        for mode in 0..test.len() {
            modes.push(DrawnMode {
                number: report.mode_number(mode),
                hertz: states.each_ref().map(|modes| modes.frequencies_hz()[mode]),
                moved: [0, 1, 2].map(|state| {
                    let shape = states[state].shapes.column(mode);
                    frame.moved(shape.as_slice(), grids(state, mode))
                }),
            });
        }
        for (place, lone) in report.initial.lone.iter().enumerate() {
            let mode = test.len() + place;
            let hertz = checks.map(|check| {
                let partner = check.lone[place].partner;
                check.modes.frequencies_hz()[partner]
            });
            modes.push(DrawnMode {
                number: report.mode_number(mode),
                hertz: [lone.frequency_hz, hertz[0], hertz[1]],
                moved: [0, 1, 2].map(|state| match grids(state, mode) {
                    Some(grids) if state > 0 => frame.moved(&[], Some(grids)),
                    _ => Vec::new(),
                }),
            });
        }
        Ok(Some(Self { modes, frame }))
    }
}
