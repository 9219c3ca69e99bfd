//! A structure as its sensors see it: places, lines between them, and their motion in a mode.

use super::view::extents;
use crate::present::report::Report;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet, HashMap};

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
    /// Places with sensors, and supports, which have none.
    pub known: BTreeMap<usize, Sensors>,
    /// The grid at every place, by its row, where all motions are drawn as they are.
    pub grids: Vec<Option<usize>>,
}

/// A place to look others up by.
pub(super) fn key(at: &Vector3<f64>) -> [i64; 3] {
    // Minus zero and zero are the same place.
    [at.x, at.y, at.z].map(|component| (component + 0.0).to_bits() as i64)
}

pub(super) fn is_finite(at: &Vector3<f64>) -> bool {
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
        let pieces = report
            .frame
            .iter()
            .filter(|corners| corners.iter().all(is_finite));
        let pieces: Vec<Vec<usize>> = pieces
            .map(|corners| corners.iter().map(&mut node).collect())
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
        for piece in &pieces {
            for (&a, &b) in piece
                .iter()
                .zip(piece.iter().cycle().skip(1))
                .filter(|(a, b)| a != b)
            {
                joined[a].insert(b);
                joined[b].insert(a);
            }
        }
        let panels = pieces.into_iter().filter(|piece| piece.len() > 2).collect();
        Self {
            lines: chained(joined),
            nodes,
            panels,
            known,
            grids,
        }
    }

    /// Displacements of all places in a shape whose largest component is one.
    ///
    /// A place with sensors moves along them as they say, and everywhere else as its grid does, whose motions are given in the
    /// scale of the shape. Without these a support does not move, and any other place as the mean of the known ones, weighted with
    /// $1/r^4$ for a distance of $r$ (Shepard, *Proc. 23rd ACM National Conference* (1968), 517).
    pub fn moved(&self, shape: &[f64], grids: Option<&[Vector3<f64>]>) -> Vec<Vector3<f64>> {
        let largest = shape
            .iter()
            .fold(0.0, |most: f64, component| most.max(component.abs()));
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

    /// The panels in parts, each with its mean displacement along an axis; those above and before others last.
    pub fn parts(
        &self,
        along: &Vector3<f64>,
        moved: &[Vector3<f64>],
    ) -> Vec<(Vec<Vector3<f64>>, f64)> {
        // As many as a figure has room for.
        let parts = (300.0 / self.panels.len() as f64)
            .sqrt()
            .round()
            .clamp(1.0, 6.0) as usize;
        let corner = |&node: &usize| (self.nodes[node], moved[node].dot(along));
        let panels = self
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
