//! The factors of a job and how they were found: its third value.

use super::{Method, PreparedJob, pairs::FLOOR};
use crate::{
    files::error::FileError,
    method::{
        error::Error,
        outer_loop::{Correlation, Pass, correlate},
    },
    sparse::{ModeWeight, Place, Work},
    weighted::{
        comparison::Comparison,
        gauss_newton::{LOWER, WeightedCorrelation, gauss_newton, gauss_newton_below},
        intervals::MOST_FOLLOWED,
        lower_place::lower_place,
        misfit::{Misfit, most_by_noise},
        residuals::residuals,
        starts::{WeightedHistory, from_several_starts},
    },
};
use nalgebra::DMatrix;

/// Most ends of one run that a lower place is gone to from.
const MOST_LEFT: usize = 5;
/// Most rows of a structure that is followed about an end by analyses themselves: one takes a millisecond, as a step in a basis, which lacks
/// what no deflection at the end shows.
const MOST_ROWS: usize = 160;
/// Most deflections of parameters, beside two of every mode, in the basis in which a lower place is looked for: exact steps decide.
const MOST_DEFLECTIONS: usize = 30;

/// Comparisons at factors about a place.
pub(super) type Followed<'a> = Box<dyn Fn(&[f64]) -> Result<Comparison, Error> + 'a>;

/// The way in which the factors were found.
#[derive(Debug, Clone)]
pub enum History {
    /// By the paper's loops.
    Paper(Box<Correlation>),
    /// By Gauss–Newton steps; none when they were stopped by request.
    GaussNewton(Option<Box<WeightedHistory>>),
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
    /// Work that they took, with that of the look before.
    pub work: Work,
    /// True if the run was stopped by request.
    pub is_interrupted: bool,
    /// True if nothing lower was found from places drawn about the end.
    pub is_lowest: bool,
}

/// What a caller hears and says while factors are looked for.
pub struct Caller<'a> {
    /// Gets a line for every pass or improvement.
    pub progress: &'a mut dyn FnMut(&str),
    /// Says after each whether to continue.
    pub go_on: &'a dyn Fn() -> bool,
}

/// Factors, how they were found, and whether a look about them found nothing lower.
type Found = (Vec<f64>, History, bool);

impl PreparedJob {
    /// The factors of the job.
    ///
    /// Test modes that were left out are compared, from the end on (of weighted steps: the paper's loops begin anew), if modes of the model there are like them, and each alone where all
    /// together lead to a place that explains the others worse ([`CorrelatedJob::explains`]). A mode that does so alone stays left out
    /// until another one joins, which leads to another end.
    ///
    /// # Errors
    /// [`FileError::Refused`] for a test in which no mode has a partner; the errors of the analyses and of the loops.
    pub(super) fn correlate(&self, caller: &mut Caller) -> Result<CorrelatedJob, FileError> {
        self.loaded.job.ensure(!self.is_without_pairs(), || {
            let best = self.unpaired.iter().map(|left| left.assurance);
            let best = best.fold(0.0, f64::max);
            format!(
                "no mode of the model is like a test mode: their modal assurance is {best:.3} at most, less than {FLOOR}; corfem check \
                 looks for the mistake"
            )
        })?;
        let mut found = self.run(&self.loaded.ones(), caller)?;
        let mut most = usize::MAX;
        while !found.is_interrupted
            && let Some(joined) = found.prepared.joined_by(&found.last, most)?
        {
            (caller.progress)(&format!("test modes compared: {}", joined.modes.len()));
            let next = joined.run(&found.factors, caller)?;
            if next.is_interrupted || next.explains(&found)? {
                (found, most) = (next, usize::MAX);
            } else if joined.modes.len() > found.prepared.modes.len() + 1 {
                most = 1;
            } else {
                let earlier = &mut found.prepared;
                let worse = joined
                    .modes
                    .iter()
                    .filter(|mode| !earlier.modes.contains(mode));
                earlier.refused.extend(worse);
            }
        }
        Ok(found)
    }

    /// One run, with the same test modes compared all the way.
    fn run(&self, start: &[f64], caller: &mut Caller) -> Result<CorrelatedJob, FileError> {
        let (factors, history, is_lowest) = match self.loaded.job.compare.method {
            Method::Paper => self.by_loops(caller)?,
            Method::GaussNewton => self.by_weighted_steps(start, caller)?,
        };
        let last = match &history {
            History::GaussNewton(Some(steps)) => steps.best.last.clone(),
            _ => self.analyze(&factors)?.with_slopes()?,
        };
        Ok(CorrelatedJob {
            prepared: self.clone(),
            history,
            factors,
            first: self.analyze(&self.loaded.ones())?.with_slopes()?,
            last,
            work: self.loaded.source.whole.work(),
            is_interrupted: !(caller.go_on)(),
            is_lowest,
        })
    }

    /// The paper's loops, from the first model.
    fn by_loops(&self, caller: &mut Caller) -> Result<Found, FileError> {
        let job = &self.loaded.job;
        let report_pass = |number: usize, pass: &Pass| {
            let errors = &pass.check.errors;
            (caller.progress)(&format!(
                "pass {number}: frequencies {:.2} %, shapes {:.2} % RMS",
                100.0 * errors.frequency_rms(),
                100.0 * errors.shape_rms()
            ));
            (caller.go_on)()
        };
        let analyze = |factors: &[f64]| Ok::<_, Error>(self.analyze(factors)?.into_model());
        let ranges = self.loaded.source.whole.ranges();
        let settings = job.correlation.for_modes(self.modes.len());
        let run = correlate(analyze, &ranges, &settings, report_pass);
        let run = run.map_err(|error| match error {
            error if error.is_of_close_modes() => job.refused(format!(
                "the paper's loops need modes that stay apart: {error}; compare.method = \"gauss_newton\" needs none"
            )),
            other => other.into(),
        })?;
        let factors = run.best_factors.clone();
        Ok((factors, History::Paper(Box::new(run)), false))
    }

    /// Weighted Gauss–Newton steps from the start, and from others where there are several.
    fn by_weighted_steps(&self, start: &[f64], caller: &mut Caller) -> Result<Found, FileError> {
        let (compare, ranges) = (&self.loaded.job.compare, self.loaded.source.whole.ranges());
        let (weights, settings) = (self.weights(), self.weighted_settings());
        let go_on = caller.go_on;
        let (mut near, mut is_over) = (None, false);
        let mut best = (f64::INFINITY, start.to_vec());
        let mut analyze = |factors: &[f64]| {
            if is_over {
                return Err(FileError::Interrupted);
            }
            let model =
                self.analyze_near(factors, near.as_ref(), self.pair(Method::GaussNewton))?;
            // The next search begins from these shapes.
            near = model
                .model
                .whole()
                .map(|whole| whole.shapes(usize::MAX).shapes);
            let objective = residuals(&model, &weights)?.norm_squared();
            if objective < best.0 {
                best = (objective, factors.to_vec());
                (caller.progress)(&format!("sum of squares {objective:.4e}"));
            }
            is_over = !go_on();
            match is_over {
                true => Err(FileError::Interrupted),
                false => Ok(model),
            }
        };
        let mut is_lowest = false;
        let steps = match compare.starts.filter(|_| start == self.loaded.ones()) {
            Some(starts) if starts != 1 => from_several_starts(
                &mut analyze,
                &ranges,
                &weights,
                &settings,
                (starts, compare.seed),
                go_on,
            ),
            _ => gauss_newton(&mut analyze, start, &ranges, &weights, &settings).map(|run| {
                WeightedHistory {
                    starts: vec![Some(run.end())],
                    minima: Vec::new(),
                    best: run,
                }
            }),
        };
        let steps = steps.and_then(|steps| {
            let below = |objective: f64, place: &[f64]| {
                gauss_newton_below(objective, &mut analyze, place, &ranges, &weights, &settings)
            };
            let (best, nothing_lower) = self.lowered(steps.best, below)?;
            is_lowest = nothing_lower;
            Ok(WeightedHistory { best, ..steps })
        });
        match steps {
            Ok(steps) if !is_over => {
                let factors = steps.best.factors.clone();
                let history = History::GaussNewton(Some(Box::new(steps)));
                Ok((factors, history, is_lowest))
            }
            Ok(_) | Err(FileError::Interrupted) => Ok((best.1, History::GaussNewton(None), false)),
            Err(error) => Err(error),
        }
    }

    /// Comparisons about one at some factors, of a small structure by its analyses, of a larger one in a basis with these deflections, with
    /// slopes corrected to an exact Jacobian where there is one.
    ///
    /// # Errors
    /// Errors of the basis.
    pub(super) fn about<'a>(
        &'a self,
        (model, factors): (&Comparison, &[f64]),
        exact: Option<(&DMatrix<f64>, &[ModeWeight])>,
        deflections: impl FnOnce(&Place) -> Result<DMatrix<f64>, Error>,
    ) -> Result<Followed<'a>, Error> {
        if self.loaded.source.whole.dof_count() <= MOST_ROWS {
            let pair = model.model.pair.clone();
            return Ok(Box::new(move |at: &[f64]| {
                self.analyze_near(at, None, pair.clone())
            }));
        }
        let basis = model.model.in_basis(None, deflections)?;
        Ok(Box::new(model.within(basis, factors, exact)?))
    }

    /// The steps that end in the last of the lower places that an end is left for ([`lower_place`]), and whether nothing lower is known of: of
    /// a minimum that noise does not explain nobody knows.
    fn lowered(
        &self,
        mut run: WeightedCorrelation,
        mut steps_below: impl FnMut(f64, &[f64]) -> Result<WeightedCorrelation, FileError>,
    ) -> Result<(WeightedCorrelation, bool), FileError> {
        let (source, seed) = (&self.loaded.source, self.loaded.job.compare.seed);
        let (ranges, weights, settings) = (
            source.whole.ranges(),
            self.weights(),
            self.weighted_settings(),
        );
        if ranges.len() > MOST_FOLLOWED {
            return Ok((run, false));
        }
        for _ in 0..MOST_LEFT {
            // A minimum that noise does not explain is not the truth's.
            let is_doubted = !Misfit::of(&run.last, &weights, &source.priors, &[])?.is_by_noise();
            let size = self.modes.len() + ranges.len().min(MOST_DEFLECTIONS) / 2;
            let partners = run.last.partners();
            let analyze = self.about((&run.last, &run.factors), None, |whole| {
                whole.drawn(None, &partners, (size, None))
            })?;
            let follow = &mut |at: &[f64]| analyze(at);
            let Some(place) =
                lower_place(&run, follow, &ranges, &weights, &settings, seed, is_doubted)?
            else {
                return Ok((run, !is_doubted));
            };
            match steps_below(run.objective - LOWER, &place) {
                Err(FileError::Interrupted) => return Err(FileError::Interrupted),
                Ok(next) if next.objective < run.objective - LOWER => run = run.and_then(next),
                // What was lower in the basis alone is not.
                _ => return Ok((run, !is_doubted)),
            }
        }
        Ok((run, false))
    }
}

impl CorrelatedJob {
    /// True if this result explains the numbers that an earlier one compares as noise lets it: a right mode more moves the factors, and
    /// chi-squared of the others rises from its minimum by at most a chi-squared of as many degrees of freedom as factors. Close modes
    /// count as they are compared here: in one subspace, where the earlier result had the shape of one alone.
    fn explains(&self, earlier: &Self) -> Result<bool, FileError> {
        let mut weights = self.prepared.weights();
        for (weight, mode) in weights.iter_mut().zip(&self.prepared.modes) {
            if !earlier.prepared.modes.contains(mode) {
                *weight = ModeWeight::NONE;
            }
        }
        let rise = residuals(&self.last, &weights)?.norm_squared()
            - residuals(&earlier.last, &earlier.prepared.weights())?.norm_squared();
        Ok(rise <= most_by_noise(self.factors.len() as f64)?)
    }
}
