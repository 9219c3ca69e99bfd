//! The factors of a job and how they were found: its third value.

use super::{Method, PreparedJob};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::outer_loop::{Correlation, Pass, correlate};
use crate::method::step::Bounds;
use crate::sparse::Work;
use crate::weighted::comparison::Comparison;
use crate::weighted::gauss_newton::{
    LOWER, WeightedCorrelation, WeightedStop, gauss_newton, gauss_newton_below,
};
use crate::weighted::intervals::MOST_FOLLOWED;
use crate::weighted::lower_place::lower_place;
use crate::weighted::misfit::Misfit;
use crate::weighted::residuals::residuals;
use crate::weighted::starts::{WeightedHistory, from_several_starts};
use nalgebra::DMatrix;
use serde::Serialize;
use std::cell::{Cell, RefCell};

/// Most by which chi-squared of the numbers that two results compare may rise from one to the next: the square of three deviations, which
/// a right mode more exceeds in three of a thousand tests and a wrong one by far.
const MOST_RISE: f64 = 9.0;

/// Most ends of one run that a lower place is gone to from.
const MOST_LEFT: usize = 5;
/// Most deflections of parameters, beside two of every mode, in the basis in which a lower place is looked for: exact steps decide.
const MOST_DEFLECTIONS: usize = 30;

/// The way in which the factors were found.
#[derive(Debug, Clone)]
pub enum History {
    /// By the paper's loops.
    Paper(Box<Correlation>),
    /// By Gauss–Newton steps; none when they were stopped by request.
    GaussNewton(Option<Box<WeightedHistory>>),
}

/// A trial of another result than the one at hand, and how it ended.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Trial {
    /// Other result that was tried: a `join` of test modes left out, the `parting` of close modes, or a `lower place` than an end.
    pub of: &'static str,
    /// The objective where weighted steps ended; none where they failed, and of the paper's loops.
    pub objective: Option<f64>,
    /// True if the result was taken.
    pub is_taken: bool,
}

/// A job with the best factors found.
#[derive(Debug, Clone)]
pub struct CorrelatedJob {
    /// The job with the test modes that were compared at the end.
    pub prepared: PreparedJob,
    /// The way in which the factors were found.
    pub history: History,
    /// The best factors.
    pub factors: Vec<f64>,
    /// The first model.
    pub first: Comparison,
    /// The model at the best factors.
    pub last: Comparison,
    /// Number of exact analyses made, the first and the last among them.
    pub analyses: usize,
    /// Work that they took, with that of the look before.
    pub work: Work,
    /// True if the run was stopped by request.
    pub is_interrupted: bool,
    /// Trials of other results, in their order.
    pub trials: Vec<Trial>,
    /// True if nothing lower was found from places drawn about the end.
    pub is_lowest: bool,
    /// The job with a test mode that was left out, and the first factors on the way where it resembled a mode of the model.
    joining: Option<(PreparedJob, Vec<f64>)>,
}

/// What a caller hears and says while factors are looked for.
pub(super) struct Caller<'a> {
    /// Gets a line for every pass or improvement.
    pub progress: &'a dyn Fn(&str),
    /// Says after each whether to continue.
    pub go_on: &'a dyn Fn() -> bool,
}

/// A run from one start with the same test modes compared all the way.
struct Part<'a> {
    prepared: &'a PreparedJob,
    start: &'a [f64],
    /// Number of starts, the others drawn.
    starts: usize,
    caller: &'a Caller<'a>,
    /// The model at the start.
    first: Comparison,
    /// Shapes of the last analysis, from which the next search begins.
    near: RefCell<Option<DMatrix<f64>>>,
    analyses: Cell<usize>,
    is_interrupted: Cell<bool>,
    trials: RefCell<Vec<Trial>>,
    is_lowest: Cell<bool>,
    joining: RefCell<Option<(PreparedJob, Vec<f64>)>>,
}

impl PreparedJob {
    /// Looks for the factors, from the first model or from other factors.
    ///
    /// A test mode that is left out is looked at again at every place that the steps reach, of several starts at their best, and at their
    /// end. The run is repeated from the first place where it resembles a mode of the model, with it compared. What comes of that takes the
    /// place of the run without it only if it explains the numbers that both compare no worse ([`MOST_RISE`]); the passes before are
    /// then not shown. A mode that would make others worse stays left out.
    ///
    /// # Errors
    /// [`FileError::Refused`] for a test in which no mode has a partner; the errors of the analyses and of the loops.
    pub(super) fn correlate(
        &self,
        start: &[f64],
        caller: &Caller,
    ) -> Result<CorrelatedJob, FileError> {
        let starts = self.loaded.job.compare.starts;
        let starts = starts.filter(|_| start == self.loaded.ones()).unwrap_or(1);
        let mut found = Part::new(self, (start, starts), caller)?.run()?;
        while !found.is_interrupted
            && let Some((joined, place)) = found.joins()?
        {
            (caller.progress)(&format!("test modes compared: {}", joined.modes.len()));
            // Where the next part may begin is at hand.
            let made = [(start, &found.first), (&found.factors[..], &found.last)];
            let joined = joined.with_analyses(made);
            let mut next = Part::new(&joined, (&place, 1), caller)?.run()?;
            if starts > 1 {
                next = next.or_lower(Part::new(&joined, (start, starts), caller)?.run()?);
            }
            let analyses = found.analyses + next.analyses + 1;
            let is_taken = next.is_interrupted || found.is_no_better_than(&next)?;
            let trials = found.trials_with(&next, "join", is_taken);
            if is_taken {
                next.first = joined.analyze(start)?.with_slopes()?;
                found = next;
            } else {
                let refused = joined.joined.iter();
                let refused = refused.filter(|mode| !found.prepared.joined.contains(mode));
                found.prepared.refused.extend(refused);
                found.joining = None;
            }
            found.analyses = analyses;
            found.trials = trials;
        }
        while !found.is_interrupted
            && let Some(split) = found.prepared.split_by(&found.last)?
        {
            (caller.progress)("close modes of the model have parted: compared one by one");
            let made = [(start, &found.first), (&found.factors[..], &found.last)];
            let split = split.with_analyses(made);
            let mut next = Part::new(&split, (&found.factors, 1), caller)?.run()?;
            next.trials = found.trials_with(&next, "parting", true);
            found = found.and_then(next, split.analyze(start)?.with_slopes()?);
        }
        Ok(found)
    }
}

impl CorrelatedJob {
    /// The job with the test modes that join, and the factors where they do: the first place on the way that a mode left out resembled,
    /// or else the end.
    fn joins(&self) -> Result<Option<(PreparedJob, Vec<f64>)>, FileError> {
        let on_the_way = self.joining.clone();
        let at_end = || {
            let joined = self.prepared.joined_by(&self.last)?;
            Ok(joined.map(|joined| (joined, self.factors.clone())))
        };
        on_the_way.map_or_else(at_end, |found| Ok(Some(found)))
    }

    /// The objective where weighted steps have ended.
    fn objective(&self) -> Option<f64> {
        match &self.history {
            History::GaussNewton(Some(steps)) => Some(steps.best.objective),
            _ => None,
        }
    }

    /// The trials so far, those within another result, and that of it.
    fn trials_with(&self, next: &Self, of: &'static str, is_taken: bool) -> Vec<Trial> {
        let objective = next.objective();
        let own = [Trial {
            of,
            objective,
            is_taken,
        }];
        [&self.trials[..], &next.trials, &own].concat()
    }

    /// The result of steps from where these have ended, with groups of test modes split, and the first model so compared.
    fn and_then(self, next: Self, first: Comparison) -> Self {
        let history = match (self.history, next.history) {
            (History::GaussNewton(Some(before)), History::GaussNewton(Some(after))) => {
                let best = before.best.and_then(after.best);
                History::GaussNewton(Some(Box::new(WeightedHistory { best, ..*before })))
            }
            (_, after) => after,
        };
        Self {
            history,
            first,
            analyses: self.analyses + next.analyses,
            ..next
        }
    }

    /// The lower of two results of weighted steps with the same test modes, with the minima that the other's starts have found.
    fn or_lower(self, other: Self) -> Self {
        let analyses = self.analyses + other.analyses;
        let objective = |found: &Self| found.objective().unwrap_or(f64::INFINITY);
        let is_lower = objective(&other) <= objective(&self);
        let mut lower = if is_lower { other.clone() } else { self };
        if let (History::GaussNewton(Some(own)), History::GaussNewton(Some(steps))) =
            (&mut lower.history, other.history)
        {
            (own.minima, own.starts) = (steps.minima, steps.starts);
        }
        Self { analyses, ..lower }
    }

    /// True if another result explains the numbers that this one compares no worse.
    fn is_no_better_than(&self, other: &Self) -> Result<bool, FileError> {
        let weights = self.prepared.weights();
        let there = self.prepared.analyze(&other.factors)?;
        let own = residuals(&self.last, &weights)?.norm_squared();
        Ok(residuals(&there, &weights)?.norm_squared() <= own + MOST_RISE)
    }
}

impl<'a> Part<'a> {
    fn new(
        prepared: &'a PreparedJob,
        (start, starts): (&'a [f64], usize),
        caller: &'a Caller,
    ) -> Result<Self, FileError> {
        prepared.check_paired()?;
        Ok(Self {
            prepared,
            start,
            starts,
            caller,
            first: prepared.analyze(start)?.with_slopes()?,
            near: RefCell::new(None),
            analyses: Cell::new(1),
            is_interrupted: Cell::new(false),
            trials: RefCell::default(),
            is_lowest: Cell::new(false),
            joining: RefCell::new(None),
        })
    }

    /// The exact model at the factors.
    fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        if factors == self.start {
            return Ok(self.first.clone());
        }
        self.analyses.set(self.analyses.get() + 1);
        let near = self.near.take();
        // The last analysis, of the best factors so far, goes to its end.
        let (loaded, may_stop) = (&self.prepared.loaded, !self.is_interrupted.get());
        loaded
            .source
            .whole
            .stop_at(loaded.stop.clone().filter(|_| may_stop));
        let found = self.prepared.analyze_near(factors, near.as_ref());
        loaded.source.whole.stop_at(None);
        let found = found?;
        let whole = found.model.whole();
        self.near
            .replace(whole.map(|whole| whole.shapes(usize::MAX).shapes));
        Ok(found)
    }

    /// True if the caller lets it continue, who is asked no more once he does not.
    fn may_go_on(&self) -> bool {
        let is_over = self.is_interrupted.get() || !(self.caller.go_on)();
        self.is_interrupted.set(is_over);
        !is_over
    }

    /// Keeps the first place where a test mode left out resembles a mode of the model.
    fn look_at(&self, model: &Comparison, factors: &[f64]) -> Result<(), FileError> {
        let mut joining = self.joining.borrow_mut();
        if joining.is_none() {
            let joined = self.prepared.joined_by(model)?;
            *joining = joined.map(|joined| (joined, factors.to_vec()));
        }
        Ok(())
    }

    fn run(self) -> Result<CorrelatedJob, FileError> {
        let (history, factors) = match self.prepared.loaded.job.compare.method {
            Method::Paper => self.by_loops()?,
            Method::GaussNewton => self.by_weighted_steps()?,
        };
        let last = match &history {
            History::GaussNewton(Some(found)) => found.best.last.clone(),
            _ => self.analyze(&factors)?.with_slopes()?,
        };
        Ok(CorrelatedJob {
            prepared: self.prepared.clone(),
            history,
            factors,
            first: self.first,
            last,
            analyses: self.analyses.get(),
            work: self.prepared.loaded.source.whole.work(),
            is_interrupted: self.is_interrupted.get(),
            trials: self.trials.into_inner(),
            is_lowest: self.is_lowest.get(),
            joining: self.joining.into_inner(),
        })
    }

    /// The paper's loops, which count factors from one: the start is their first model.
    fn by_loops(&self) -> Result<(History, Vec<f64>), FileError> {
        let (prepared, job) = (self.prepared, &self.prepared.loaded.job);
        let total = |factors: &[f64]| -> Vec<f64> {
            let both = factors.iter().zip(self.start);
            both.map(|(factor, start)| factor * start).collect()
        };
        let from_start = |(range, start): (Option<Bounds>, &f64)| {
            range.map(|range| Bounds {
                lower: range.lower / start,
                upper: range.upper / start,
            })
        };
        let ranges = prepared.loaded.source.whole.ranges().into_iter();
        let ranges: Vec<_> = ranges.zip(self.start).map(from_start).collect();
        let report_pass = |number: usize, pass: &Pass| {
            let errors = &pass.check.errors;
            let percent = |error: f64| 100.0 * error;
            (self.caller.progress)(&format!(
                "pass {number}: frequencies {:.2} %, shapes {:.2} % RMS",
                percent(errors.frequency_rms()),
                percent(errors.shape_rms())
            ));
            self.may_go_on()
        };
        let analyze = |factors: &[f64]| {
            let factors = total(factors);
            let model = self.analyze(&factors)?;
            self.look_at(&model, &factors)?;
            Ok::<_, FileError>(model.into_model())
        };
        let settings = job.correlation.for_modes(prepared.modes.len());
        let run = correlate(analyze, &ranges, &settings, report_pass);
        let mut run = run.map_err(|error| match error {
            FileError::Method(error) if error.is_of_close_modes() => job.refused(format!(
                "the paper's loops need modes that stay apart: {error}; compare.method = \"gauss_newton\" needs none"
            )),
            other => other,
        })?;
        for pass in &mut run.passes {
            pass.factors = total(&pass.factors);
        }
        run.best_factors = total(&run.best_factors);
        let factors = run.best_factors.clone();
        Ok((History::Paper(Box::new(run)), factors))
    }

    /// The steps that end in the last of the lower places that an end is left for ([`lower_place`]).
    fn lowered(
        &self,
        mut run: WeightedCorrelation,
        ranges: &[Option<Bounds>],
        mut steps_below: impl FnMut(f64, &[f64]) -> Result<WeightedCorrelation, FileError>,
    ) -> Result<WeightedCorrelation, FileError> {
        let (prepared, seed) = (self.prepared, self.prepared.loaded.job.compare.seed);
        let (weights, settings) = (prepared.weights(), prepared.weighted_settings());
        let is_followed = ranges.len() <= MOST_FOLLOWED;
        for _ in 0..if is_followed { MOST_LEFT } else { 0 } {
            let size = 2 * prepared.modes.len() + ranges.len().min(MOST_DEFLECTIONS);
            // A minimum that noise does not explain is not the truth's.
            let misfit = || Misfit::of(&run.last, &weights, &prepared.loaded.source.priors, &[]);
            let is_doubted = run.stop == WeightedStop::Gradient && !misfit()?.is_by_noise();
            let place = lower_place(&run, size, ranges, &weights, &settings, seed, is_doubted)?;
            self.is_lowest.set(place.is_none());
            let Some(place) = place else { break };
            let next = match steps_below(run.objective - LOWER, &place) {
                Err(FileError::Interrupted) => return Err(FileError::Interrupted),
                next => next.ok(),
            };
            let objective = next.as_ref().map(|next| next.objective);
            let is_taken = objective.is_some_and(|there| there < run.objective - LOWER);
            self.trials.borrow_mut().push(Trial {
                of: "lower place",
                objective,
                is_taken,
            });
            // What was lower in the basis alone is not.
            self.is_lowest.set(!is_taken);
            let Some(next) = next.filter(|_| is_taken) else {
                break;
            };
            run = run.and_then(next);
        }
        Ok(run)
    }

    /// Weighted Gauss–Newton steps from the start, and from others where there are several.
    fn by_weighted_steps(&self) -> Result<(History, Vec<f64>), FileError> {
        let (prepared, job) = (self.prepared, &self.prepared.loaded.job);
        let (weights, ranges) = (prepared.weights(), prepared.loaded.source.whole.ranges());
        let settings = prepared.weighted_settings();
        let ones = prepared.loaded.ones();
        let best: RefCell<Option<(f64, Vec<f64>)>> = RefCell::new(None);
        let mut analyze = |factors: &[f64]| {
            if self.is_interrupted.get() {
                return Err(FileError::Interrupted);
            }
            let stopped = |error: Error| match self.may_go_on() {
                true => error.into(),
                false => FileError::Interrupted,
            };
            let model = self.analyze(factors).map_err(stopped)?;
            let objective = residuals(&model, &weights)?.norm_squared();
            let mut best = best.borrow_mut();
            if best.as_ref().is_none_or(|(least, _)| objective < *least) {
                *best = Some((objective, factors.to_vec()));
                (self.caller.progress)(&format!("sum of squares {objective:.4e}"));
                // Other starts may lead elsewhere: their best is looked at.
                if self.starts == 1 {
                    self.look_at(&model, factors)?;
                }
            }
            match self.may_go_on() {
                true => Ok(model),
                false => Err(FileError::Interrupted),
            }
        };
        let found = match self.starts {
            1 => gauss_newton(&mut analyze, self.start, &ranges, &weights, &settings).map(|run| {
                WeightedHistory {
                    starts: vec![Some(run.end())],
                    minima: Vec::new(),
                    best: run,
                }
            }),
            _ => from_several_starts(
                &mut analyze,
                &ranges,
                &weights,
                &settings,
                self.starts,
                job.compare.seed,
            ),
        };
        let steps_below = |objective: f64, first: &[f64]| {
            gauss_newton_below(objective, &mut analyze, first, &ranges, &weights, &settings)
        };
        let found = found.and_then(|found| {
            let best = self.lowered(found.best, &ranges, steps_below)?;
            Ok(WeightedHistory { best, ..found })
        });
        let is_whole = !self.is_interrupted.get();
        match found {
            Ok(found) if is_whole => {
                let factors = found.best.factors.clone();
                Ok((History::GaussNewton(Some(Box::new(found))), factors))
            }
            Ok(_) | Err(FileError::Interrupted) => {
                let factors = best.into_inner().map_or(ones, |(_, factors)| factors);
                Ok((History::GaussNewton(None), factors))
            }
            Err(error) => Err(error),
        }
    }
}
