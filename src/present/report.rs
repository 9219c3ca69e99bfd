//! The report of a job: rows that every view shows, made once from the finished result.

#[doc(hidden)]
pub mod words;

use super::PresentError;
use super::compared::{Agreement, Compared, Derivatives, Mode, Reading, Rms};
use super::drawing::Drawing;
use super::table::Digits;
use crate::files::test_data::DIRECTIONS;
use crate::job::concern::{Answered, some};
use crate::job::verdict::End;
use crate::job::{HeldOut, History, JobResult, LoadedJob, PlacedSensor, PreparedJob, Trust};
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::sparse::{WholeParameter, Work};
use crate::weighted::comparison::ExactResult;
use crate::weighted::identifiability::NORMAL_95;
use crate::weighted::intervals::Withheld;
use crate::weighted::misfit::{Misfit, mark};
use crate::weighted::residuals::residuals;
use crate::weighted::starts::{Minimum, StartEnd};
use nalgebra::Vector3;
use serde::Serialize;
use words::{answer, verdict_of_job};

/// A parameter and its factor.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Parameter {
    /// Its name.
    pub parameter: String,
    /// The factor of the first model, one.
    pub first: f64,
    /// The best factor.
    pub factor: f64,
    /// Change of the factor.
    pub change_percent: f64,
    /// Standard deviation of the factor's logarithm: from the ends of its interval, or where it has none by slopes and prior.
    pub deviation_percent: Option<f64>,
    /// Lower end of the 95 % interval, where one holds.
    pub low: Option<f64>,
    /// Upper end of it.
    pub high: Option<f64>,
    /// `at bound`, `hardly seen`, `not apart` from others, or why it has no interval.
    pub remark: &'static str,
    /// Change of the logarithm in its deviations; none of a parameter that the test hardly sees, of which nothing is sure.
    pub sureness: Option<f64>,
    /// The deviation by slopes and prior at the first model.
    pub deviation_before_percent: Option<f64>,
    /// Part of the prior's variance that is left.
    pub prior_share_percent: Option<f64>,
    /// Lower bound of the factor.
    pub lower_bound: Option<f64>,
    /// Upper bound of it.
    pub upper_bound: Option<f64>,
}

/// A sensor on the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Its name.
    pub sensor: String,
    /// The model's grid.
    pub grid: usize,
    /// The direction it measures, with the components of an axis of the test's own.
    pub direction: String,
    /// Distance of the grid from the sensor's own place, if that is known.
    pub distance: Option<f64>,
}

/// A step of the correlation.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Step {
    /// Its number.
    pub step: usize,
    /// Iterations of the paper's inner loop.
    pub iterations: Option<usize>,
    /// Chi-squared of a weighted step.
    pub chi_squared: Option<f64>,
    /// The exact error sum of a pass of the paper's loops.
    pub error_sum_percent: Option<f64>,
    /// Why the pass or the last step ended.
    pub stop: Option<End>,
}

/// A fact of the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fact {
    /// Its name.
    pub fact: &'static str,
    /// Its value in words.
    pub value: String,
}

/// A finished job, told. Text, Markdown, CSV, JSON and the page are views of it in which no number is made.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// The job's title.
    pub title: String,
    /// One line: what is against it, the errors before and after, and the factors that differ from one.
    pub answer: String,
    /// True if the model is as good as the noise allows, or within the tolerance of the paper's loops.
    pub is_within: bool,
    /// The end of the correlation.
    pub end: End,
    /// The verdict in words.
    pub verdict: String,
    /// Doubts and remarks, what matters most first.
    pub concerns: Trust,
    /// The questions asked and their answers.
    pub checks: Vec<Answered>,
    /// Residuals at the best factors, compared with the noise.
    pub misfit: Misfit,
    /// Errors before and after.
    pub errors: Vec<Rms>,
    /// Parameters in the order of the job.
    pub parameters: Vec<Parameter>,
    /// Parameters with the surest change first, and those that the test hardly sees last.
    #[serde(skip)]
    pub surest: Vec<Parameter>,
    /// Test modes, those without shapes last.
    pub modes: Vec<Mode>,
    /// Components of the shapes, mode by mode.
    pub readings: Vec<Reading>,
    /// Sensors on the model.
    pub places: Vec<Place>,
    /// Steps from the first model to the best.
    pub history: Vec<Step>,
    /// The minima that noise allows, of several starts.
    pub minima: Vec<Minimum>,
    /// The end of every start of weighted steps; none where it failed.
    pub starts: Vec<Option<StartEnd>>,
    /// Shapes of the first model and the test.
    pub first: Agreement,
    /// Shapes of the corrected model and the test.
    pub corrected: Agreement,
    /// Derivatives at the first model.
    pub derivatives: Derivatives,
    /// Facts of the model.
    pub model: Vec<Fact>,
    /// Work that they took.
    #[serde(flatten)]
    pub work: Work,
    /// The command that makes the report again.
    pub command: String,
    /// The text of the job.
    pub job: String,
    /// The structure moving, where its places are known.
    #[serde(skip)]
    pub drawing: Option<Drawing>,
}

impl Report {
    /// The report of a finished job, which the command makes again.
    ///
    /// # Errors
    /// The errors of the analyses, and of [`Compared::agreement`].
    pub fn new(result: &JobResult, command: &str) -> Result<Self, PresentError> {
        let found = &result.found;
        let (prepared, loaded) = (&found.prepared, &found.prepared.loaded);
        let (first, last) = (found.first.result()?, found.last.result()?);
        let compared = prepared.compared_with(&first, &last);
        let held = found.held_out()?;
        let errors = compared.errors(&held);
        let parameters = parameters(result);
        let mut surest = parameters.clone();
        // Parameters that symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
        let key = |own: &Parameter| own.sureness.map_or(1.0, |sureness| -sureness as f32);
        surest.sort_by(|a, b| key(a).total_cmp(&key(b)));
        let sensors = loaded.placed.iter().map(|sensor| sensor.name.clone());
        let mut readings = compared.readings(&sensors.collect::<Vec<_>>())?;
        let mut modes = compared.modes()?;
        add_residuals(result, &held, &mut modes, &mut readings)?;
        let (minima, starts) = match &found.history {
            History::GaussNewton(Some(all)) => (all.minima.clone(), all.starts.clone()),
            _ => Default::default(),
        };
        Ok(Self {
            title: loaded.title.clone(),
            answer: answer(result, &errors, &surest),
            is_within: result.verdict.is_within,
            end: result.verdict.end,
            verdict: verdict_of_job(result),
            concerns: result.trust.clone(),
            checks: result.trust.answers(true),
            misfit: result.misfit,
            drawing: Drawing::of_job(found),
            errors,
            parameters,
            surest,
            modes,
            readings,
            places: places(loaded),
            history: history(result),
            minima,
            starts,
            first: compared.agreement(&first)?,
            corrected: compared.agreement(&last)?,
            derivatives: Derivatives::at(&found.first)?,
            model: facts(prepared)?,
            work: found.work,
            command: command.to_owned(),
            job: loaded.job.text.clone(),
        })
    }
}

impl PreparedJob {
    /// The job's test beside exact solutions.
    pub fn compared_with<'a>(
        &'a self,
        first: &'a ExactResult,
        last: &'a ExactResult,
    ) -> Compared<'a> {
        Compared {
            test: &self.test,
            numbers: self.compared().map(|mode| mode + 1).collect(),
            first,
            last,
            mass: None,
        }
    }
}

fn parameters(result: &JobResult) -> Vec<Parameter> {
    let (found, source) = (&result.found, &result.found.prepared.loaded.source);
    let groups = result.seen.untold_groups().concat();
    let row = |(e, own): (usize, &WholeParameter)| {
        let (factor, interval) = (found.factors[e], result.intervals[e].as_ref());
        let by_interval = |own: &Bounds| (own.upper / own.lower).ln() / (2.0 * NORMAL_95);
        let deviation = interval.map_or(result.seen.deviations[e], by_interval);
        let (change, is_unseen) = (factor.ln().abs(), result.verdict.unseen.contains(&e));
        let remark = match interval {
            _ if result.verdict.at_bound.contains(&e) => "at bound",
            _ if groups.contains(&e) => "not apart",
            _ if is_unseen => "hardly seen",
            Err(Withheld::Lower) => "no minimum",
            Err(Withheld::NoEnd) => "no end",
            _ => "",
        };
        Parameter {
            parameter: own.name.clone(),
            first: 1.0,
            factor,
            change_percent: 100.0 * (factor - 1.0),
            deviation_percent: Some(100.0 * deviation),
            low: interval.ok().map(|own| own.lower),
            high: interval.ok().map(|own| own.upper),
            remark,
            sureness: (!is_unseen).then_some(if change > 0.0 {
                change / deviation
            } else {
                0.0
            }),
            deviation_before_percent: Some(100.0 * result.seen_first.deviations[e]),
            prior_share_percent: Some(100.0 * (1.0 - result.seen.learned[e])),
            lower_bound: own.range.map(|own| own.lower),
            upper_bound: own.range.map(|own| own.upper),
        }
    };
    source
        .whole
        .parameters()
        .iter()
        .enumerate()
        .map(row)
        .collect()
}

/// Fills in the residuals of frequencies and shapes at the best factors, and the mark of every mode.
fn add_residuals(
    result: &JobResult,
    held: &[HeldOut],
    modes: &mut [Mode],
    readings: &mut [Reading],
) -> Result<(), PresentError> {
    let (found, prepared) = (&result.found, &result.found.prepared);
    let weights = prepared.weights();
    let mut all = residuals(&found.last, &weights)?;
    if let Some(predicted) = &result.predicted {
        all += &predicted.residuals;
    }
    let sensors = prepared.loaded.placed.len();
    let (mut left, mut readings) = (all.as_slice(), readings.chunks_mut(sensors.max(1)));
    for (mode, weight) in modes.iter_mut().zip(weights) {
        let count = if mode.first_mac.is_some() { sensors } else { 0 };
        let (own, rest) = left.split_at(1 + count);
        left = rest;
        let squares: f64 = own.iter().map(|own| own * own).sum();
        mode.residual = Some(own[0]);
        mode.frequency_weight = Some(weight.frequency);
        mode.shape_weight = (count > 0).then_some(weight.shape);
        // A shape's scale is free.
        mode.fit = Some(mark(squares, count.max(1)));
        let held = held.iter().find(|held| held.mode == mode.mode);
        // An error is as many predicted deviations as its residual says.
        let predicted = held.map(|held| held.frequency[1] / own[0]);
        mode.predicted_deviation_percent = predicted.filter(|own| own.is_finite());
        let shape = if count > 0 { readings.next() } else { None };
        for (reading, residual) in shape.into_iter().flatten().zip(&own[1..]) {
            reading.residual = Some(*residual);
        }
    }
    Ok(())
}

/// The sensors on the model.
pub fn places(loaded: &LoadedJob) -> Vec<Place> {
    let place = |own: &PlacedSensor| {
        let sign = if own.sign < 0.0 { "-" } else { "" };
        let (axis, direction) = (own.axis, DIRECTIONS[own.direction]);
        let askew = format!(" ({:.2} {:.2} {:.2})", axis.x, axis.y, axis.z);
        let askew = if axis.amax() < 1.0 { &askew } else { "" };
        Place {
            sensor: own.name.clone(),
            grid: own.grid,
            direction: format!("{sign}{direction}{askew}"),
            distance: own.distance,
        }
    };
    loaded.placed.iter().map(place).collect()
}

fn history(result: &JobResult) -> Vec<Step> {
    let found = &result.found;
    let mut steps: Vec<Step> = match &found.history {
        History::Paper(run) => {
            let passes = (1..).zip(&run.passes).map(|(step, pass)| Step {
                step,
                iterations: Some(pass.inner.iterations.len()),
                error_sum_percent: Some(100.0 * pass.check.errors.sum()),
                stop: Some(pass.inner.stop.into()),
                ..Step::default()
            });
            passes.collect()
        }
        History::GaussNewton(run) => {
            let settings = found.prepared.weighted_settings();
            let steps = run.iter().flat_map(|run| &run.best.iterations);
            // Twice the objective is chi-squared and the prior's pull.
            let steps = (1..).zip(steps).map(|(step, own)| Step {
                step,
                chi_squared: Some(2.0 * own.objective - settings.pull(&own.factors)),
                ..Step::default()
            });
            steps.collect()
        }
    };
    if let Some(last) = steps.last_mut() {
        last.stop = last.stop.or(Some(result.verdict.end));
    }
    steps
}

/// The facts of a job: modes taken, mass and its center, parameters without bounds, and sensors without use.
///
/// # Errors
/// The errors of the count of rigid-body modes.
pub fn facts(prepared: &PreparedJob) -> Result<Vec<Fact>, Error> {
    let source = &prepared.loaded.source;
    let (taken, rigid) = (
        prepared.analysis_modes,
        source.whole.rigid_bodies()?.rigid(),
    );
    let write = |at: &Vector3<f64>| {
        let [x, y, z] = <[f64; 3]>::from(*at).map(|own| Digits::Significant(6).write(own));
        format!("{x}, {y}, {z}")
    };
    let unbounded = source
        .whole
        .parameters()
        .iter()
        .filter(|own| own.range.is_none());
    let unbounded: Vec<&str> = unbounded.map(|own| &own.name[..]).collect();
    let unused = prepared.loaded.data.sensors.len() - prepared.loaded.placed.len();
    let all = [
        (
            "modes taken",
            format!("the lowest {taken}, beside {rigid} rigid-body modes"),
        ),
        ("mass along x, y, z", write(&source.mass)),
        ("parameters without bounds", some(&unbounded)),
        (
            "sensors that are not used",
            if unused > 0 {
                unused.to_string()
            } else {
                String::new()
            },
        ),
    ];
    let all = all.into_iter().filter(|(_, value)| !value.is_empty());
    Ok(all.map(|(fact, value)| Fact { fact, value }).collect())
}
