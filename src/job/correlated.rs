//! The factors of a job and how they were found: its third value.

use super::{Method, PreparedJob};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::outer_loop::{Correlation, Pass, correlate};
use crate::method::step::Bounds;
use crate::weighted::comparison::Comparison;
use crate::weighted::gauss_newton::{WeightedCorrelation, gauss_newton};
use crate::weighted::residuals::residuals;
use crate::weighted::starts::{Minimum, from_several_starts};
use std::cell::{Cell, RefCell};

/// The way in which the factors were found.
#[derive(Debug, Clone)]
pub enum History {
    /// By the paper's loops.
    Paper(Box<Correlation>),
    /// By Gauss–Newton steps; none when they were stopped by request.
    GaussNewton(Option<Box<WeightedHistory>>),
}

/// Gauss–Newton steps, of one start or of several.
#[derive(Debug, Clone)]
pub struct WeightedHistory {
    /// The steps that lead lowest.
    pub best: WeightedCorrelation,
    /// The minima that noise allows of several starts.
    pub minima: Vec<Minimum>,
    /// Number of starts that failed.
    pub failed: usize,
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
    /// True if the run was stopped by request.
    pub is_interrupted: bool,
    /// True if a test mode was about to be compared too.
    pub(super) has_joined: bool,
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
    caller: &'a Caller<'a>,
    /// The model at the start.
    first: Comparison,
    analyses: Cell<usize>,
    is_interrupted: Cell<bool>,
    has_joined: Cell<bool>,
}

impl PreparedJob {
    /// Looks for the factors, from the first model or from other factors.
    ///
    /// A test mode that is left out is looked at again after every pass of the paper's loops and every weighted step, of several starts at
    /// their best. One that resembles a mode of the model by then is compared from there on, and the passes before, which did not count it,
    /// are not shown.
    ///
    /// # Errors
    /// [`FileError::Refused`] for a test in which no mode has a partner; the errors of the analyses and of the loops.
    pub(super) fn correlate(
        &self,
        start: &[f64],
        caller: &Caller,
    ) -> Result<CorrelatedJob, FileError> {
        let mut found = Part::new(self, start, caller)?.run()?;
        while !found.is_interrupted
            && let Some(joined) = found.prepared.joined_by(&found.last.model.exact.modes)?
        {
            (caller.progress)(&format!("test modes compared: {}", joined.modes.len()));
            let before = found.analyses;
            found = Part::new(&joined, &found.factors, caller)?.run()?;
            found.first = joined.analyze(start)?.with_slopes()?;
            found.analyses += before + 1;
        }
        Ok(found)
    }
}

impl<'a> Part<'a> {
    fn new(
        prepared: &'a PreparedJob,
        start: &'a [f64],
        caller: &'a Caller,
    ) -> Result<Self, FileError> {
        prepared.check_paired()?;
        Ok(Self {
            prepared,
            start,
            caller,
            first: prepared.analyze(start)?.with_slopes()?,
            analyses: Cell::new(1),
            is_interrupted: Cell::new(false),
            has_joined: Cell::new(false),
        })
    }

    /// The exact model at the factors.
    fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        if factors == self.start {
            return Ok(self.first.clone());
        }
        self.analyses.set(self.analyses.get() + 1);
        self.prepared.analyze(factors)?.with_slopes()
    }

    /// True if the caller lets it continue, who is asked no more once he does not.
    fn may_go_on(&self) -> bool {
        let is_over = self.is_interrupted.get() || !(self.caller.go_on)();
        self.is_interrupted.set(is_over);
        !is_over
    }

    fn run(self) -> Result<CorrelatedJob, FileError> {
        let (history, factors) = match self.prepared.loaded.job.compare.method {
            Method::Paper => self.by_loops()?,
            Method::GaussNewton => self.by_weighted_steps()?,
        };
        let last = match &history {
            History::GaussNewton(Some(found)) => found.best.last.clone(),
            _ => self.analyze(&factors)?,
        };
        Ok(CorrelatedJob {
            prepared: self.prepared.clone(),
            history,
            factors,
            first: self.first,
            last,
            analyses: self.analyses.get(),
            is_interrupted: self.is_interrupted.get(),
            has_joined: self.has_joined.get(),
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
            let joins = prepared.joined_by(&pass.check.modes);
            self.has_joined.set(matches!(joins, Ok(Some(_))));
            self.may_go_on() && !self.has_joined.get()
        };
        let analyze = |factors: &[f64]| self.analyze(&total(factors)).map(Comparison::into_model);
        let settings = job.correlation.for_modes(prepared.modes.len());
        let run = correlate(analyze, &ranges, &settings, report_pass);
        let mut run = run.map_err(|error: Error| match error.is_of_close_modes() {
            true => job.refused(format!(
                "the paper's loops need modes that stay apart: {error}; compare.method = \"gauss_newton\" needs none"
            )),
            false => error.into(),
        })?;
        for pass in &mut run.passes {
            pass.factors = total(&pass.factors);
        }
        run.best_factors = total(&run.best_factors);
        // A mode that has come in did so after the last pass, which need not be the best of those without it.
        let last = run.passes.last().filter(|_| self.has_joined.get());
        let factors = last.map_or(&run.best_factors, |pass| &pass.factors).clone();
        Ok((History::Paper(Box::new(run)), factors))
    }

    /// Weighted Gauss–Newton steps, of the job's number of starts from the first model, else of this one.
    fn by_weighted_steps(&self) -> Result<(History, Vec<f64>), FileError> {
        let (prepared, job) = (self.prepared, &self.prepared.loaded.job);
        let (weights, ranges) = (prepared.weights(), prepared.loaded.source.whole.ranges());
        let settings = prepared.weighted_settings();
        let ones = prepared.loaded.ones();
        let starts = job.compare.starts.filter(|_| self.start == ones);
        let starts = starts.unwrap_or(1);
        let best: RefCell<Option<(f64, Vec<f64>)>> = RefCell::new(None);
        let analyze = |factors: &[f64]| {
            if self.has_joined.get() || self.is_interrupted.get() {
                return Err(FileError::Interrupted);
            }
            let model = self.analyze(factors)?;
            let objective = residuals(&model, &weights)?.norm_squared();
            let mut best = best.borrow_mut();
            if best.as_ref().is_none_or(|(least, _)| objective < *least) {
                *best = Some((objective, factors.to_vec()));
                (self.caller.progress)(&format!("sum of squares {objective:.4e}"));
                // Other starts may lead elsewhere: their best is looked at.
                let joins = || prepared.joined_by(&model.model.exact.modes);
                self.has_joined.set(starts == 1 && joins()?.is_some());
            }
            match !self.has_joined.get() && self.may_go_on() {
                true => Ok(model),
                false => Err(FileError::Interrupted),
            }
        };
        let found = match starts {
            1 => gauss_newton(analyze, self.start, &ranges, &weights, &settings)
                .map(|run| (run, Vec::new(), 0)),
            _ => from_several_starts(
                analyze,
                &ranges,
                &weights,
                &settings,
                starts,
                job.compare.seed,
            ),
        };
        let is_whole = !self.has_joined.get() && !self.is_interrupted.get();
        match found {
            Ok((best, minima, failed)) if is_whole => {
                let factors = best.factors.clone();
                let found = WeightedHistory {
                    best,
                    minima,
                    failed,
                };
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
