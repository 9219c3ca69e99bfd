//! The user's own structure as a report.

use super::{Derivatives, ModeResiduals, Report, SensorPoint, Stage};
use crate::job::expansion::expand;
use crate::job::{CorrelatedJob, History, JobResult, LoadedJob, Method, PlacedSensor, PreparedJob};
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::method::step::Bounds;
use crate::method::structure::StructuralDof;
use crate::present::PresentError;
use crate::weighted::comparison::{Comparison, ExactResult};
use crate::weighted::gauss_newton::{WeightedCorrelation, WeightedStop};
use crate::weighted::identifiability::NORMAL_95;
use crate::weighted::intervals::Withheld;
use crate::weighted::misfit::Prediction;
use crate::weighted::residuals::residuals;
use nalgebra::{DMatrix, DVectorView, Vector3};
use std::collections::BTreeMap;

impl Report {
    /// A job with its result, or before its first step and without derivatives.
    ///
    /// # Errors
    /// Errors of the first analysis.
    pub fn from_job(
        prepared: &PreparedJob,
        result: Option<&JobResult>,
    ) -> Result<Self, PresentError> {
        // With the test modes that were compared at the end.
        let found = result.map(|result| &result.found);
        let prepared = found.map_or(prepared, |found| &found.prepared);
        let loaded = &prepared.loaded;
        let whole = &loaded.source.whole;
        let names: Vec<String> = loaded.parameter_names().map(str::to_owned).collect();
        let ones = vec![1.0; names.len()];
        let first =
            found.map_or_else(|| prepared.analyze(&ones), |found| Ok(found.first.clone()))?;
        let stem = loaded.job.stem();
        let geometry = &loaded.source.geometry;
        let (frame, owners) = pieces(loaded).into_iter().unzip();
        let still = |grid: &&usize| {
            let dof = |direction| StructuralDof {
                grid: **grid,
                direction,
            };
            (0..3).all(|direction| !loaded.source.motions.contains_key(&dof(direction)))
        };
        let (test, initial) = (&first.model.test, first.result()?);
        let stages = found.map(stopped).transpose()?;
        let base = match found.map(|found| &found.history) {
            Some(History::Paper(run)) => {
                Self::from_correlation(&stem, &names, test, &initial, Some(run))
            }
            Some(History::GaussNewton(Some(found))) => {
                Self::from_weighted(&stem, &names, (test, &initial), &found.best)
            }
            history => Self {
                best: history.map(|_| 0),
                stages: stages.into_iter().collect(),
                ..Self::from_correlation(&stem, &names, test, &initial, None)
            },
        };
        let report = Self {
            title: loaded.title.clone(),
            mode_numbers: prepared.compared().map(|mode| mode + 1).collect(),
            ranges: whole.ranges(),
            sensors: loaded.placed.iter().map(sensor_point).collect(),
            frame,
            owners,
            left_out: left_out(prepared),
            grids: geometry
                .places
                .iter()
                .map(|(grid, place)| (*grid, *place))
                .collect(),
            supports: geometry
                .places
                .keys()
                .filter(still)
                .map(|grid| geometry.places[grid])
                .collect(),
            residuals: mode_residuals(
                prepared,
                found.map_or(&first, |found| &found.last),
                result.and_then(|result| result.predicted.as_ref()),
            )?,
            mass: prepared.mass_at_sensors(found.map_or(&first, |found| &found.last)),
            derivatives: found
                .map(|found| Derivatives::at(&found.first))
                .transpose()?,
            ..base
        };
        let Some(JobResult {
            found,
            trust,
            verdict,
            seen_first,
            seen,
            misfit,
            predicted,
            intervals,
        }) = result
        else {
            return Ok(report);
        };
        // The deviation of the factor itself, from that of its logarithm, where there is an interval.
        let deviation = |(interval, factor): (&Result<Bounds, Withheld>, &f64)| {
            let interval = interval.as_ref().ok()?;
            Some(factor * (interval.upper / interval.lower).ln() / (2.0 * NORMAL_95))
        };
        let (minima, starts) = match &found.history {
            History::GaussNewton(Some(all)) => (all.minima.clone(), all.starts.clone()),
            _ => Default::default(),
        };
        Ok(Self {
            deviations: Some(
                intervals
                    .iter()
                    .zip(&found.factors)
                    .map(deviation)
                    .collect(),
            ),
            seen: Some([seen_first.clone(), seen.clone()]),
            misfit: Some(*misfit),
            is_judged_by_noise: loaded.job.compare.method == Method::GaussNewton,
            analyses: Some(found.analyses),
            work: Some(found.work),
            minima,
            starts,
            intervals: intervals.clone(),
            moved: moved(found),
            held_out: found.held_out()?,
            missed: predicted.as_ref().and_then(|own| own.missed.clone()),
            verdict: Some(verdict.clone()),
            trust: Some(trust.clone()),
            ..report
        })
    }

    /// A report with one stage per Gauss–Newton step.
    fn from_weighted(
        name: &str,
        names: &[String],
        (test, initial): (&Modes, &ExactResult),
        run: &WeightedCorrelation,
    ) -> Self {
        let stop = match run.stop {
            WeightedStop::Gradient => "gradient",
            WeightedStop::Short => "short",
            WeightedStop::Trials => "trials",
        };
        let last = run.iterations.len().saturating_sub(1);
        let stages = run
            .iterations
            .iter()
            .enumerate()
            .map(|(number, iteration)| Stage {
                factors: iteration.factors.clone(),
                check: iteration.check.clone(),
                inner: None,
                stop: if number == last {
                    stop.to_owned()
                } else {
                    String::new()
                },
            });
        let stages: Vec<Stage> = stages.collect();
        Self {
            best: stages.len().checked_sub(1),
            stages,
            ..Self::from_correlation(name, names, test, initial, None)
        }
    }
}

/// The residuals of a model, mode by mode, over predicted deviations where a mode is held out.
fn mode_residuals(
    prepared: &PreparedJob,
    model: &Comparison,
    predicted: Option<&Prediction>,
) -> Result<Vec<ModeResiduals>, Error> {
    let mut all = residuals(model, &prepared.weights())?;
    if let Some(predicted) = predicted {
        all += &predicted.residuals;
    }
    let rows = 1 + model.model.test.shapes.nrows();
    let (shaped, alone) = all.as_slice().split_at(rows * prepared.modes.len());
    let each = shaped.chunks(rows).chain(alone.chunks(1));
    let of_mode = |(mode, own): (usize, &[f64])| ModeResiduals {
        mode: mode + 1,
        frequency: own[0],
        shape: own[1..].to_vec(),
    };
    Ok(prepared.compared().zip(each).map(of_mode).collect())
}

/// Test modes of a frequency above zero that are not compared: their numbers and frequencies, Hz.
fn left_out(prepared: &PreparedJob) -> Vec<(usize, f64)> {
    let data = &prepared.loaded.data;
    let compared: Vec<usize> = prepared.compared().collect();
    let modes = data.frequencies_hz.iter().copied().enumerate();
    modes
        .filter(|(mode, _)| !compared.contains(mode) && !data.rigid.contains(mode))
        .map(|(mode, hertz)| (mode + 1, hertz))
        .collect()
}

/// Corners of a piece of the structure, and the parameters that scale it.
type Piece = (Vec<Vector3<f64>>, Vec<usize>);

/// The structure: the elements of a deck, else the lines of the test, else lines that join the sensors.
fn pieces(loaded: &LoadedJob) -> Vec<Piece> {
    let (source, geometry) = (&loaded.source, &loaded.source.geometry);
    let corners = |grids: &[usize]| -> Vec<Vector3<f64>> {
        let places = grids.iter().map(|grid| geometry.places.get(grid));
        places.flatten().copied().collect()
    };
    let labels = source
        .deck
        .iter()
        .flat_map(|(_, deck)| &deck.model.elements);
    let mut owners: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (e, members) in source.members.iter().enumerate() {
        for &label in &members.elements {
            owners.entry(label).or_default().push(e);
        }
    }
    let owners = |label| owners.get(&label).cloned().unwrap_or_default();
    let elements = geometry.elements.iter().zip(labels);
    let mut pieces: Vec<Piece> = elements
        .map(|(grids, element)| (corners(grids), owners(element.label)))
        .collect();
    pieces.extend(
        loaded
            .data
            .lines
            .iter()
            .filter(|_| geometry.elements.is_empty())
            .map(|line| (corners(line), Vec::new())),
    );
    pieces.retain(|(corners, _)| corners.len() > 1);
    if pieces.is_empty() {
        let places = loaded.placed.iter().filter_map(|sensor| sensor.place);
        let lines = joined(places.collect()).into_iter();
        pieces = lines.map(|line| (line, Vec::new())).collect();
    }
    pieces
}

/// Motions of the grids, see [`Report::moved`]: the models as their own shapes at all degrees of freedom, the test as the nearest
/// combination of the corrected model's modes, where the sensors tell these apart.
fn moved(found: &CorrelatedJob) -> Option<[Vec<Vec<Vector3<f64>>>; 3]> {
    let (source, sensors) = (
        &found.prepared.loaded.source,
        &found.prepared.loaded.sensors,
    );
    let ones = vec![1.0; found.factors.len()];
    let whole = |factors: &[f64], comparison: &Comparison| {
        let model = &comparison.model;
        let pairs = comparison.partners();
        let count = pairs.iter().max().map_or(0, |mode| mode + 1);
        let all = match model.whole() {
            Some(whole) => whole.shapes(count).shapes,
            None => {
                let exactly = source.whole.exactly(factors, sensors, count..=count, None);
                exactly.ok()?.shapes(count).shapes
            }
        };
        let seen = sensors.times(&all).ok()?;
        // Give them the scale and sign of the shapes that are compared.
        let mut paired = all.select_columns(&pairs);
        let signs = model.exact.pairing.sign.iter();
        for (mut shape, (&pair, sign)) in paired.column_iter_mut().zip(pairs.iter().zip(signs)) {
            let own = seen.column(pair);
            let compared = model.exact.modes.shapes.column(pair);
            shape *= sign * own.dot(&compared) / own.norm_squared();
        }
        Some((paired, all, seen))
    };
    let (first, ..) = whole(&ones, &found.first)?;
    let (mut last, all, seen) = whole(&found.factors, &found.last)?;
    // What has no measured shape to tell its sign keeps that of the first model.
    for mut pair in first
        .column_iter()
        .zip(last.column_iter_mut())
        .skip(found.first.model.test.len())
    {
        let sign = pair.0.dot(&pair.1).signum();
        pair.1 *= sign;
    }
    let test = expand(&all, &seen, &found.first.model.test.shapes);
    let at = |shape: DVectorView<f64>, grid: usize| {
        Vector3::from_fn(|direction, _| {
            let motion = source.motions.get(&StructuralDof { grid, direction });
            motion
                .into_iter()
                .flatten()
                .map(|&(dof, coefficient)| coefficient * shape[dof])
                .sum()
        })
    };
    let grids = || source.geometry.places.keys();
    let of = |shapes: DMatrix<f64>| -> Vec<Vec<Vector3<f64>>> {
        shapes
            .column_iter()
            .map(|shape| grids().map(|&grid| at(shape, grid)).collect())
            .collect()
    };
    Some([test.map(of).unwrap_or_default(), of(first), of(last)])
}

/// Lines that join all places, each to the nearest one that is joined already.
pub(in crate::present) fn joined(mut places: Vec<Vector3<f64>>) -> Vec<Vec<Vector3<f64>>> {
    let mut done: Vec<Vector3<f64>> = places.pop().into_iter().collect();
    let mut lines = Vec::new();
    while !places.is_empty() {
        let pairs =
            (0..places.len()).flat_map(|next| (0..done.len()).map(move |from| (next, from)));
        let far = |&(next, from): &(usize, usize)| (places[next] - done[from]).norm_squared();
        let Some((next, from)) = pairs.min_by(|one, other| far(one).total_cmp(&far(other))) else {
            break;
        };
        let place = places.swap_remove(next);
        if place != done[from] {
            lines.push(vec![done[from], place]);
        }
        done.push(place);
    }
    lines
}

/// The best stage of a stopped run.
fn stopped(found: &CorrelatedJob) -> Result<Stage, Error> {
    let (factors, check) = (found.factors.clone(), found.last.result()?);
    Ok(Stage {
        factors,
        check,
        inner: None,
        stop: "request".to_owned(),
    })
}

fn sensor_point(sensor: &PlacedSensor) -> SensorPoint {
    let direction = if sensor.direction < 3 {
        sensor.axis
    } else {
        Vector3::zeros()
    };
    SensorPoint {
        name: sensor.name.clone(),
        place: sensor.place,
        direction,
    }
}
