//! The next measurement: the deviations of the factors with one sensor more or less.

use super::{Method, PlacedSensor, PreparedJob};
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
#[derive(Debug, Clone)]
pub struct NextMeasurement {
    /// Kinds of change, each with its best changes first: none, one sensor more, one sensor less.
    pub changes: [Changes; 3],
    /// Changes that are not ranked, and why.
    pub unranked: Vec<String>,
}

/// Root of the mean square of deviations.
pub fn mean_deviation(deviations: &[f64]) -> f64 {
    ((deviations.iter().map(|own| own * own).sum::<f64>()) / deviations.len() as f64).sqrt()
}

/// Changes of one kind with the deviations after each, the best first.
pub type Changes = Vec<(String, Vec<f64>)>;

fn ranked<T>(
    changes: impl Iterator<Item = Result<(T, Vec<f64>), Error>>,
) -> Result<Vec<(T, Vec<f64>)>, Error> {
    let mut changes = changes.collect::<Result<Vec<_>, _>>()?;
    // Places that symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
    let mean = |change: &(T, Vec<f64>)| mean_deviation(&change.1) as f32;
    changes.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
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
        let (loaded, placed) = (&self.loaded, &self.loaded.placed);
        let (priors, mut unranked) = (&loaded.source.priors, Vec::new());
        let is_unpaired = self.modes.is_empty() || self.is_without_pairs();
        if priors.is_empty() || is_unpaired {
            return Ok(NextMeasurement {
                unranked: vec![
                    "Nothing is ranked without parameters and compared shapes.".to_owned(),
                ],
                changes: Default::default(),
            });
        }
        let at_hand = match loaded.job.compare.method {
            Method::GaussNewton => self.first_comparison(),
            Method::Paper => self.beside(Arc::clone(&self.first), Method::GaussNewton),
        }?;
        let weights = self.weights();
        let by = |own: &Comparison| deviations(own, &weights, priors);
        let compared = at_hand.model.compared();
        let beyond = self.first.slopes_beyond(
            &loaded.sensors,
            at_hand.model.exact.modes.len(),
            &compared,
        )?;
        let mut comparison = at_hand.clone();
        for (&mode, own) in compared.iter().zip(beyond) {
            comparison.model.beyond[mode] = Some(own);
        }
        let more = self.more_sensors([&at_hand, &comparison], &compared, by, &mut unranked)?;
        // Without the only sensor that sees it a test mode has no shape.
        let shapes = &at_hand.model.test.shapes;
        let least = NOTHING * shapes.amax();
        let is_needed = |row: usize| {
            let mut columns = shapes.column_iter();
            columns.any(|shape| (0..shape.len()).all(|own| own == row || shape[own].abs() <= least))
        };
        let all: Vec<usize> = (0..placed.len()).filter(|&row| !is_needed(row)).collect();
        let alone = placed.len() - all.len();
        unranked.extend(
            (alone > 0 && placed.len() > 1)
                .then(|| format!("Not ranked: {alone} sensors that see a test mode alone.")),
        );
        let less = ranked(
            self.some(all, "sensors", &mut unranked)
                .into_iter()
                .map(|row| {
                    let rest: Vec<usize> =
                        (0..placed.len()).filter(|other| *other != row).collect();
                    Ok((
                        format!("without {}", placed[row].name),
                        by(&comparison.at_sensors(&rest))?,
                    ))
                }),
        )?;
        let now = vec![("as it is".to_owned(), by(&comparison)?)];
        let changes = [now, more, less];
        Ok(NextMeasurement { changes, unranked })
    }

    /// As many as may be looked at, with slopes at all sensors by the modes at hand for each: neighbors tell alike, so of too many every so
    /// many-th.
    fn some<T>(&self, all: Vec<T>, what: &str, unranked: &mut Vec<String>) -> Vec<T> {
        let (count, rows) = (self.loaded.source.priors.len(), self.test.shapes.len());
        let step = all
            .len()
            .div_ceil(
                (MOST_WORK / (count * (rows * (self.analysis_modes + count) + count * count)))
                    .max(1),
            )
            .max(1);
        unranked.extend(
            (step > 1).then(|| format!("Of {} {what} one in {step} was looked at.", all.len())),
        );
        all.into_iter().step_by(step).collect()
    }

    /// Places where the model moves and no sensor is, along or about axes as the test's sensors measure.
    fn places(&self) -> Vec<StructuralDof> {
        let placed = &self.loaded.placed;
        let is_new = |dof: &StructuralDof| {
            let mut kinds = placed.iter().map(|own| own.direction / 3);
            let at = |own: &PlacedSensor| (own.grid, own.direction) == (dof.grid, dof.direction);
            kinds.any(|kind| kind == dof.direction / 3) && !placed.iter().any(at)
        };
        self.loaded
            .source
            .motions
            .iter()
            .filter(|(_, motion)| !motion.is_empty())
            .map(|(dof, _)| *dof)
            .filter(is_new)
            .collect()
    }

    fn more_sensors(
        &self,
        [at_hand, exact]: [&Comparison; 2],
        compared: &[usize],
        by: impl Fn(&Comparison) -> Result<Vec<f64>, Error>,
        unranked: &mut Vec<String>,
    ) -> Result<Changes, Error> {
        let (source, count) = (&self.loaded.source, at_hand.model.exact.modes.len());
        let look = |places: &[StructuralDof], comparison: &Comparison, modes: &[usize]| {
            if places.is_empty() {
                return Ok(Vec::new());
            }
            let of = |(row, dof)| {
                source.motions[dof]
                    .iter()
                    .map(move |own| (row, own.0, own.1))
            };
            let sensors = SparseMatrix::new(
                "sensors",
                places.len(),
                source.whole.dof_count(),
                places.iter().enumerate().flat_map(of).collect(),
            )?;
            let [basis, unseen] = self.first.read_by(&sensors, count)?;
            let beyond = self.first.slopes_beyond(&sensors, count, modes)?;
            let is_seen = |row: &usize| unseen.row(*row).amax() <= NOTHING * basis.amax();
            ranked((0..places.len()).filter(is_seen).map(|row| {
                let of_row = |all: &DMatrix<f64>| all.rows(row, 1).into_owned();
                Ok((
                    places[row],
                    by(&comparison
                        .with_sensor(of_row(&basis), beyond.iter().map(of_row).collect()))?,
                ))
            }))
        };
        let mut places = self.some(self.places(), "places", unranked);
        let best = look(&places, at_hand, &[])?;
        let apart = places.len() - best.len();
        unranked
            .extend((apart > 0).then(|| {
                format!("Not ranked: {apart} places with modes that no sensor sees now.")
            }));
        places = best
            .into_iter()
            .map(|own| own.0)
            .take(MOST_PLACES)
            .collect();
        let best = look(&places, exact, compared)?;
        let named = best
            .into_iter()
            .map(|(StructuralDof { grid, direction }, own)| {
                (format!("with grid {grid} {}", DIRECTIONS[direction]), own)
            });
        Ok(named.collect())
    }
}
