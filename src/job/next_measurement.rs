//! The next measurement: the deviations of the factors with one sensor more or less.

use super::{Method, PreparedJob};
use crate::{
    files::{error::FileError, test_data::DIRECTIONS},
    method::{error::Error, structure::StructuralDof},
    sparse::SparseMatrix,
    weighted::{comparison::Comparison, measurements::deviations},
};
use nalgebra::DMatrix;
use std::sync::Arc;

/// Multiplications that the changes of one kind may take together: about a quarter of a second.
const MOST_WORK: usize = 250_000_000;
/// Best places by the modes at hand whose slopes are made exact.
const MOST_PLACES: usize = 8;
/// Part of the largest reading below which a place does not move.
const NOTHING: f64 = 1e-8;

/// Single changes of a test and the deviations of the factors' logarithms after each.
#[derive(Debug, Clone, Default)]
pub struct NextMeasurement {
    /// Kinds of change, each with its best changes first: none, one sensor more, one sensor less.
    pub changes: [Changes<String>; 3],
    /// Changes that are not ranked, and why.
    pub unranked: Vec<String>,
}

/// Root of the mean square of deviations.
pub fn mean_deviation(deviations: &[f64]) -> f64 {
    (deviations.iter().map(|own| own * own).sum::<f64>() / deviations.len() as f64).sqrt()
}

/// Changes of one kind with the deviations after each, the best first.
pub type Changes<T> = Vec<(T, Vec<f64>)>;

fn ranked<T>(
    changes: impl Iterator<Item = Result<(T, Vec<f64>), Error>>,
) -> Result<Changes<T>, Error> {
    let mut changes = changes.collect::<Result<Vec<_>, _>>()?;
    // Places that symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
    changes.sort_by(|a, b| {
        let [a, b] = [a, b].map(|own| mean_deviation(&own.1) as f32);
        a.total_cmp(&b)
    });
    Ok(changes)
}

impl PreparedJob {
    /// Deviations of the factors at the first model with one sensor more at a grid of it, and with one sensor less. A new sensor reads what
    /// the model says of it.
    ///
    /// Every place is ranked by the modes at hand; the best have exact slopes, and with these the deviations of a job with that sensor.
    ///
    /// # Errors
    /// The errors of the analysis and of the covariance.
    pub fn next_measurement(&self) -> Result<NextMeasurement, FileError> {
        let mut next = NextMeasurement::default();
        let priors = &self.loaded.source.priors;
        if priors.is_empty() || self.modes.is_empty() || self.is_without_pairs() {
            let why = "Nothing is ranked without parameters and compared shapes.";
            next.unranked.push(why.to_owned());
            return Ok(next);
        }
        let method = Method::GaussNewton;
        let at_hand = self.beside(Arc::clone(&self.first), method, self.pair(method))?;
        let exact = at_hand.clone().with_slopes()?;
        let (names, weights) = (&self.loaded.placed, self.weights());
        let by = |own: &Comparison| deviations(own, &weights, priors);
        next.changes[0].push(("as it is".to_owned(), by(&exact)?));
        // By the modes at hand, then of the best places exactly.
        let places = next.some(self, self.new_places(), "places");
        let best = self.more_sensors(&places, &at_hand, &[], by)?;
        let apart = places.len() - best.len();
        next.unranked
            .extend((apart > 0).then(|| {
                format!("Not ranked: {apart} places with modes that no sensor sees now.")
            }));
        let places: Vec<_> = best
            .into_iter()
            .map(|own| own.0)
            .take(MOST_PLACES)
            .collect();
        let more = self.more_sensors(&places, &exact, &at_hand.model.compared(), by)?;
        let named = |(dof, own): (StructuralDof, _)| {
            let direction = DIRECTIONS[dof.direction];
            (format!("with grid {} {direction}", dof.grid), own)
        };
        next.changes[1].extend(more.into_iter().map(named));
        // Without the only sensor that sees it a test mode has no shape.
        let shapes = &at_hand.model.test.shapes;
        let least = NOTHING * shapes.amax();
        let is_spared = |row: &usize| {
            let rest = shapes.clone().remove_row(*row);
            rest.column_iter().all(|shape| shape.amax() > least)
        };
        let rows: Vec<usize> = (0..names.len()).filter(is_spared).collect();
        let alone = names.len() - rows.len();
        next.unranked.extend(
            (alone > 0).then(|| format!("Not ranked: {alone} sensors that see a test mode alone.")),
        );
        let less = next.some(self, rows, "sensors").into_iter().map(|row| {
            let rest: Vec<usize> = (0..names.len()).filter(|other| *other != row).collect();
            let name = format!("without {}", names[row].name);
            Ok((name, by(&exact.at_sensors(&rest))?))
        });
        next.changes[2] = ranked(less)?;
        Ok(next)
    }

    /// Places where the model moves and no sensor is, along or about axes as the test's sensors measure.
    fn new_places(&self) -> Vec<StructuralDof> {
        let placed = &self.loaded.placed;
        let is_new = |dof: &StructuralDof| {
            let is_kind = placed
                .iter()
                .any(|own| own.direction / 3 == dof.direction / 3);
            let mut taken = placed.iter().map(|own| (own.grid, own.direction));
            is_kind && taken.all(|own| own != (dof.grid, dof.direction))
        };
        let motions = self.loaded.source.motions.iter();
        let moving = motions.filter(|(_, motion)| !motion.is_empty());
        moving.map(|(dof, _)| *dof).filter(is_new).collect()
    }

    /// Places for a sensor more, ranked by a comparison with exact slopes of these modes; not those where it would see other modes.
    fn more_sensors(
        &self,
        places: &[StructuralDof],
        comparison: &Comparison,
        modes: &[usize],
        by: impl Fn(&Comparison) -> Result<Vec<f64>, Error>,
    ) -> Result<Changes<StructuralDof>, Error> {
        if places.is_empty() {
            return Ok(Vec::new());
        }
        let (source, count) = (&self.loaded.source, comparison.model.exact.modes.len());
        let of = |(row, dof)| {
            let motion = source.motions[dof].iter();
            motion.map(move |own| (row, own.0, own.1))
        };
        let entries = (0..).zip(places).flat_map(of).collect();
        let size = source.whole.dof_count();
        let sensors = SparseMatrix::new("sensors", places.len(), size, entries)?;
        let [basis, unseen] = self.first.read_by(&sensors, count)?;
        let slopes = self.first.slopes(&sensors, modes)?;
        let is_seen = |row: &usize| unseen.row(*row).amax() <= NOTHING * basis.amax();
        ranked((0..places.len()).filter(is_seen).map(|row| {
            let of_row = |all: &DMatrix<f64>| all.rows(row, 1).into_owned();
            let slopes = slopes.iter().map(of_row).collect();
            Ok((
                places[row],
                by(&comparison.with_sensor(of_row(&basis), slopes))?,
            ))
        }))
    }
}

impl NextMeasurement {
    /// As many as may be looked at, with slopes at all sensors by the modes at hand for each: neighbors tell alike, so of too many every so
    /// many-th.
    fn some<T>(&mut self, job: &PreparedJob, all: Vec<T>, what: &str) -> Vec<T> {
        let (count, rows) = (job.loaded.source.priors.len(), job.test.shapes.len());
        let work = count * (rows * (job.analysis_modes + count) + count * count);
        let step = all.len().div_ceil((MOST_WORK / work).max(1)).max(1);
        self.unranked.extend(
            (step > 1).then(|| format!("Of {} {what} one in {step} was looked at.", all.len())),
        );
        all.into_iter().step_by(step).collect()
    }
}
