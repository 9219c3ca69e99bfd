//! A correlated job with everything that says how far to trust it: its last value.

use super::concern::{Concern, Kind, Trust};
use super::correlated::{Caller, CorrelatedJob, History};
use super::verdict::{Judged, Outcome, Verdict, sum_of_nine_modes};
use super::{LeftOut, PreparedJob};
use crate::files::error::FileError;
use crate::method::error_sum::mode_errors;
use crate::method::step::Bounds;
use crate::sparse::Deflections;
use crate::weighted::comparison::Comparison;
use crate::weighted::gauss_newton::WeightedStop;
use crate::weighted::identifiability::{Identifiability, identifiability};
use crate::weighted::intervals::intervals;
use crate::weighted::misfit::Misfit;
use crate::weighted::residuals::jacobian;
use std::cell::RefCell;

/// The result of a job.
#[derive(Debug, Clone)]
pub struct JobResult {
    /// The correlated job.
    pub found: CorrelatedJob,
    /// Everything that may lower the trust in it.
    pub trust: Trust,
    /// The verdict on the factors.
    pub verdict: Verdict,
    /// What the test sees of the parameters, at the first model and at the best factors.
    pub seen: [Identifiability; 2],
    /// The residuals at the best factors, compared with the noise.
    pub misfit: Misfit,
    /// 95 % intervals about the factors, where they are true: around the optimum of weighted steps alone, not around the stop of the
    /// paper's rule, of steps too short or of too many trials. Residuals that are too large for the noise widen them by as much.
    pub intervals: Vec<Option<Bounds>>,
}

/// Runs a job, after a look at what is doubtful of it: correlates it from the first model and judges what was found, with `trust` from
/// [`Trust::before`]. `progress` gets a line for every pass or improvement; `go_on` says after each whether to continue.
///
/// # Errors
/// [`FileError::Refused`] without parameters or without a pair; the errors of the analyses and of the loops.
pub fn run(
    prepared: &PreparedJob,
    trust: &Trust,
    progress: impl FnMut(&str),
    go_on: impl Fn() -> bool,
) -> Result<JobResult, FileError> {
    prepared.loaded.require_parameters()?;
    let progress = RefCell::new(progress);
    let caller = Caller {
        progress: &|line| (progress.borrow_mut())(line),
        go_on: &go_on,
    };
    let found = prepared.correlate(&prepared.loaded.ones(), &caller)?;
    found.judge(trust)?.with_intervals()
}

impl CorrelatedJob {
    /// Judges what was found, without intervals: how the residuals are to the noise, what the test sees, and what to know before trusting it.
    ///
    /// # Errors
    /// The errors of [`Misfit::of`] and [`identifiability`].
    pub(super) fn judge(self, trust: &Trust) -> Result<JobResult, FileError> {
        let last = match &self.history {
            History::GaussNewton(Some(found)) => found.best.identifiability.clone(),
            _ => self.sees(&self.last)?,
        };
        let seen = [self.sees(&self.first)?, last];
        let mut verdict = self.verdict()?;
        let misfit = self.misfit(&verdict.at_bound)?;
        // Weighted steps are judged by the noise that weighs them.
        if matches!(self.history, History::GaussNewton(_)) && misfit.is_by_noise() {
            (verdict.outcome, verdict.is_within) = (Outcome::Tolerance, true);
        }
        let after = self.concerns(&verdict, &seen[1], &misfit)?;
        Ok(JobResult {
            intervals: vec![None; self.factors.len()],
            found: self,
            trust: trust.after(after),
            verdict,
            seen,
            misfit,
        })
    }

    /// What the test sees of the parameters at a model.
    fn sees(&self, model: &Comparison) -> Result<Identifiability, FileError> {
        let jacobian = jacobian(model, &self.prepared.weights())?;
        let priors = &self.prepared.loaded.source.priors;
        Ok(identifiability(&jacobian, priors)?)
    }

    /// The residuals at the best factors, compared with the noise; parameters at a bound are not fitted.
    fn misfit(&self, at_bound: &[usize]) -> Result<Misfit, FileError> {
        let (prepared, priors) = (&self.prepared, &self.prepared.loaded.source.priors);
        let mut misfit = Misfit::of(&self.last, &prepared.weights(), priors, at_bound)?;
        misfit.chi_squared *= prepared.estimate_scale(misfit.degrees_of_freedom);
        Ok(misfit)
    }

    /// The verdict by the reason why it ended and by the tolerances.
    fn verdict(&self) -> Result<Verdict, FileError> {
        let ranges = self.prepared.loaded.source.whole.ranges();
        let judged = Judged {
            seen: &self.first.largest_parts(),
            ranges: &ranges,
        };
        let found = match &self.history {
            History::Paper(run) => {
                let best = run.best_check();
                let errors = mode_errors(&best.modes, &best.pairing, &self.prepared.test)?;
                let is_stopped = self.is_interrupted;
                return Ok(judged.of_loops(run, &errors, sum_of_nine_modes, is_stopped));
            }
            History::GaussNewton(found) => found.as_ref().map(|found| &found.best),
        };
        let outcome = match found.map(|run| (run.stop, run.iterations.is_empty())) {
            Some((_, true)) => Outcome::Nothing,
            None => Outcome::Request,
            Some((WeightedStop::Trials, _)) => Outcome::Cap,
            Some((WeightedStop::Wall, _)) => Outcome::Wall,
            _ => Outcome::LocalMinimum,
        };
        let errors = self.last.mode_errors()?;
        let sum = sum_of_nine_modes(&self.last.result()?.errors);
        Ok(judged.verdict(outcome, (sum, &errors), &self.factors, false))
    }

    /// What there is to know after the steps.
    fn concerns(
        &self,
        verdict: &Verdict,
        seen: &Identifiability,
        misfit: &Misfit,
    ) -> Result<Vec<Concern>, FileError> {
        let prepared = &self.prepared;
        let names: Vec<&str> = prepared.loaded.parameter_names().collect();
        let of = |places: &[usize]| places.iter().map(|&e| names[e]).collect::<Vec<&str>>();
        let mut blind = [&seen.blind[..], &verdict.unseen].concat();
        blind.sort_unstable();
        blind.dedup();
        let all = 0..names.len();
        let mostly_prior: Vec<usize> = all.filter(|&e| seen.is_mostly_prior(e)).collect();
        let joined: Vec<usize> = prepared.joined.iter().map(|mode| mode + 1).collect();
        let mut concerns = vec![Concern::plain(
            Kind::ChiSquared,
            &[
                misfit.chi_squared,
                misfit.degrees_of_freedom,
                misfit.largest_by_noise,
            ],
        )];
        concerns.extend((self.is_interrupted).then(|| Concern::plain(Kind::Interrupted, &[])));
        let groups = seen.parallel_groups();
        let parallel = groups
            .iter()
            .map(|group| Concern::new(Kind::Parallel, &of(group), &[]));
        concerns.extend(parallel);
        let lists = [
            (Kind::Blind, of(&blind)),
            (Kind::MostlyPrior, of(&mostly_prior)),
            (Kind::AtBound, of(&verdict.at_bound)),
        ];
        let some = lists.into_iter().filter(|(_, names)| !names.is_empty());
        concerns.extend(some.map(|(kind, names)| Concern::new(kind, &names, &[])));
        concerns.extend((!joined.is_empty()).then(|| Concern::new(Kind::Joined, &joined, &[])));
        let left = prepared.unlike(&self.last)?;
        concerns.extend(left.iter().map(LeftOut::concern));
        Ok(concerns)
    }
}

impl JobResult {
    /// The same with 95 % intervals where weighted steps ended at their optimum, in a basis about it with corrected slopes.
    ///
    /// # Errors
    /// The errors of the basis and of [`intervals`].
    fn with_intervals(mut self) -> Result<Self, FileError> {
        let is_optimum = match &self.found.history {
            History::GaussNewton(Some(found)) => found.best.stop == WeightedStop::Gradient,
            _ => false,
        };
        if !is_optimum {
            return Ok(self);
        }
        let (prepared, factors, model) =
            (&self.found.prepared, &self.found.factors, &self.found.last);
        let ranges = prepared.loaded.source.whole.ranges();
        let (weights, settings) = (prepared.weights(), prepared.weighted_settings());
        let exact = jacobian(model, &weights)?;
        let basis = model
            .model
            .in_basis(Deflections::All(6 * prepared.modes.len() + 30))?;
        let basis = model.in_basis(basis, &exact, &weights)?;
        let follow = |at: &[f64]| {
            let change: Vec<f64> = at.iter().zip(factors).map(|(at, from)| at / from).collect();
            basis.followed(&change)
        };
        let widening = self.misfit.widening();
        self.intervals = intervals(&follow, factors, &ranges, &weights, &settings, widening)?;
        self.found.work = prepared.loaded.source.whole.work();
        Ok(self)
    }
}
