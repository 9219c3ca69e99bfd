//! A structure as the page draws it: its places, the pieces between them, its sensors, and how the models move.

use crate::job::{CorrelatedJob, Members, PlacedSensor};
use crate::method::structure::StructuralDof;
use crate::weighted::comparison::Comparison;
use nalgebra::{DMatrix, DVectorView, Vector3};
use serde::Serialize;
use std::collections::BTreeMap;

/// Corners of a panel or ends of a line, by place, and the parameters that scale it; all from zero.
pub type Piece = (Vec<usize>, Vec<usize>);

/// A structure with its motions.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Drawing {
    /// Places of the grids.
    pub places: Vec<[f64; 3]>,
    /// Elements of a deck, else the lines of the test.
    pub pieces: Vec<Piece>,
    /// Sensors in the order of the readings: the place, and a unit vector along which it measures, zero for a rotation; none where the
    /// grid has no place.
    pub sensors: Vec<Option<(usize, [f64; 3])>>,
    /// Displacements of all places in the partners of every test mode, of the first and of the corrected model, in thousandths of the
    /// largest reading; empty where the whole model is not known.
    pub moved: [Vec<Vec<[i64; 3]>>; 2],
}

/// A motion in thousandths.
pub fn thousandths(motion: Vector3<f64>) -> [i64; 3] {
    motion.map(|part| (1e3 * part).round() as i64).into()
}

impl Drawing {
    /// The structure of a job; none where no place is known.
    pub(super) fn of_job(found: &CorrelatedJob) -> Option<Self> {
        let loaded = &found.prepared.loaded;
        let grids = &loaded.source.places;
        let place: BTreeMap<usize, usize> = grids.keys().copied().zip(0..).collect();
        let sensor = |own: &PlacedSensor| {
            let along = if own.direction < 3 {
                own.axis
            } else {
                Vector3::zeros()
            };
            Some((*place.get(&own.grid)?, along.into()))
        };
        let (pieces, sensors): (_, Vec<_>) = (
            pieces(found, &place),
            loaded.placed.iter().map(sensor).collect(),
        );
        (!pieces.is_empty() || sensors.iter().any(Option::is_some)).then(|| Self {
            places: grids.values().map(|at| (*at).into()).collect(),
            pieces,
            sensors,
            moved: moved(found).unwrap_or_default(),
        })
    }
}

/// The elements of a deck, else the lines of the test.
fn pieces(found: &CorrelatedJob, place: &BTreeMap<usize, usize>) -> Vec<Piece> {
    let loaded = &found.prepared.loaded;
    let source = &loaded.source;
    let corners = |grids: &[usize]| -> Vec<usize> {
        grids
            .iter()
            .filter_map(|grid| place.get(grid))
            .copied()
            .collect()
    };
    let labels = source
        .deck
        .iter()
        .flat_map(|(_, deck)| &deck.model.elements);
    let elements = source.elements.iter().zip(labels);
    let elements = elements.map(|(grids, element)| {
        let owns = |own: &(usize, &Members)| own.1.elements.binary_search(&element.label).is_ok();
        let owners = source.members.iter().enumerate().filter(owns);
        (corners(grids), owners.map(|(e, _)| e).collect())
    });
    let mut pieces: Vec<Piece> = elements.collect();
    if pieces.is_empty() {
        pieces = loaded
            .data
            .lines
            .iter()
            .map(|line| (corners(line), Vec::new()))
            .collect();
    }
    pieces.retain(|(corners, _)| corners.len() > 1);
    pieces
}

/// Motions of the first and the corrected model, see [`Drawing::moved`].
fn moved(found: &CorrelatedJob) -> Option<[Vec<Vec<[i64; 3]>>; 2]> {
    let loaded = &found.prepared.loaded;
    let (source, sensors) = (&loaded.source, &loaded.sensors);
    let paired = |factors: &[f64], comparison: &Comparison| {
        let (model, pairs) = (&comparison.model, comparison.partners());
        let count = pairs.iter().max().map_or(0, |mode| mode + 1);
        let all = match model.whole() {
            Some(whole) => whole.shapes(count).shapes,
            None => {
                let exactly = source.whole.exactly(factors, sensors, count..=count, None);
                exactly.ok()?.shapes(count).shapes
            }
        };
        let (seen, mut paired) = (sensors.times(&all).ok()?, all.select_columns(&pairs));
        // What has no measured shape has neither its scale nor its sign.
        let mut signs = model.exact.pairing.sign.iter();
        for (mut shape, &pair) in paired.column_iter_mut().zip(&pairs) {
            let (own, compared) = (seen.column(pair), model.exact.modes.shapes.column(pair));
            let scale = signs
                .next()
                .map(|sign| sign * own.dot(&compared).signum() / own.amax());
            let scale = scale.unwrap_or(1.0 / shape.amax());
            shape *= scale;
        }
        Some(paired)
    };
    let first = paired(&loaded.ones(), &found.first)?;
    let mut last = paired(&found.factors, &found.last)?;
    let alone = first.column_iter().zip(last.column_iter_mut());
    for (one, mut other) in alone.skip(found.first.model.test.len()) {
        other *= one.dot(&other).signum();
    }
    let at = |shape: DVectorView<f64>, grid: usize| {
        thousandths(Vector3::from_fn(|direction, _| {
            let rows = source.motions.get(&StructuralDof { grid, direction });
            let rows = rows.into_iter().flatten();
            rows.map(|&(row, coefficient)| coefficient * shape[row])
                .sum()
        }))
    };
    let of = |shapes: DMatrix<f64>| {
        let grids = || source.places.keys();
        let shapes = shapes.column_iter();
        shapes
            .map(|shape| grids().map(|&grid| at(shape, grid)).collect())
            .collect()
    };
    Some([of(first), of(last)])
}
