//! A correlated job with everything that says how far to trust it: its last value.

use super::{
    PreparedJob,
    concern::{Check, Concern, Grade, NONE, Trust, listed, numbers, some},
    correlated::{Caller, CorrelatedJob, History},
    verdict::{End, Judged, Verdict, sum_of_nine_modes},
};
use crate::{
    files::error::FileError,
    method::{error_sum::mode_errors, step::Bounds},
    sparse::Deflections,
    weighted::{
        comparison::ModeErrors,
        gauss_newton::WeightedStop,
        identifiability::{Identifiability, identifiability},
        intervals::{Withheld, intervals},
        misfit::{Misfit, Prediction},
        residuals::jacobian,
    },
};

/// The result of a job.
#[derive(Debug, Clone)]
pub struct JobResult {
    /// The correlated job.
    pub found: CorrelatedJob,
    /// Everything that may lower the trust in it.
    pub trust: Trust,
    /// The verdict on the factors.
    pub verdict: Verdict,
    /// Identifiability of the parameters at the first model.
    pub seen_first: Identifiability,
    /// Identifiability of the parameters at the best factors, with deviations of the measurement as much larger as the residuals are too large for the
    /// noise.
    pub seen: Identifiability,
    /// The residuals at the best factors, compared with the noise.
    pub misfit: Misfit,
    /// The numbers that are held out, beside what the factors foretell of them.
    pub predicted: Option<Prediction>,
    /// 95 % intervals about the factors, where they are true, or why there is none: around the optimum of weighted steps alone, not around
    /// the stop of the paper's rule, of steps too short or of too many trials.
    pub intervals: Vec<Result<Bounds, Withheld>>,
}

/// Runs a job, after a look at what is doubtful of it: correlates it from the first model and judges what was found, with `trust` from
/// [`Trust::before`]. `progress` gets a line for every pass or improvement; `go_on` says after each whether to continue.
///
/// # Errors
/// [`FileError::Refused`] without parameters or without a pair; the errors of the analyses and of the loops.
pub fn run(
    prepared: &PreparedJob,
    trust: &Trust,
    mut progress: impl FnMut(&str),
    go_on: impl Fn() -> bool,
) -> Result<JobResult, FileError> {
    prepared.loaded.require_parameters()?;
    let mut caller = Caller {
        progress: &mut progress,
        go_on: &go_on,
    };
    prepared
        .correlate(&mut caller)?
        .judge(trust)?
        .with_intervals()
}

impl CorrelatedJob {
    /// Judges what was found, without intervals: how the residuals are to the noise, what the test sees, and what to know before trusting it.
    ///
    /// # Errors
    /// The errors of [`Misfit::of`] and [`identifiability`].
    pub(super) fn judge(self, trust: &Trust) -> Result<JobResult, FileError> {
        let mut verdict = self.verdict()?;
        let (weights, priors) = (self.prepared.weights(), &self.prepared.loaded.source.priors);
        // Parameters at a bound are not fitted.
        let misfit = Misfit::of(&self.last, &weights, priors, &verdict.at_bound)?;
        // With deviations of the measurement so many times as large.
        let sees =
            |model, widening| identifiability(&(jacobian(model, &weights)? / widening), priors);
        let seen = sees(&self.last, misfit.widening())?;
        // Weighted steps are judged by the noise that weighs them, where a wrong model would have failed; not those that ended short or
        // were stopped.
        if matches!(self.history, History::GaussNewton(_)) {
            verdict.is_within =
                misfit.is_by_noise() && misfit.can_fail() && !verdict.end.is_early();
        }
        verdict.unseen = (0..self.factors.len())
            .filter(|&e| seen.is_mostly_prior(e))
            .collect();
        let predicted = Prediction::of(
            &self.last,
            &self.prepared.weights_of(true),
            &seen.covariance,
            misfit.widening(),
        )?;
        let seen_first = sees(&self.first, 1.0)?;
        let after = self.concerns(&verdict, &seen, &misfit)?;
        verdict.is_within &= predicted.iter().all(|own| own.missed.is_none());
        Ok(JobResult {
            intervals: vec![Err(Withheld::NoOptimum); self.factors.len()],
            found: self,
            trust: trust.after(after),
            verdict,
            seen_first,
            seen,
            misfit,
            predicted,
        })
    }

    /// The verdict by the reason why it ended and by the tolerances.
    fn verdict(&self) -> Result<Verdict, FileError> {
        let judged = Judged {
            // What a test with deviations does not see its deviations say.
            seen: &[],
            ranges: &self.prepared.loaded.source.whole.ranges(),
        };
        let found = match &self.history {
            History::Paper(run) => {
                let best = run.best_check();
                let is_stopped = self.is_interrupted;
                return Ok(judged.of_loops(
                    run,
                    &mode_errors(&best.modes, &best.pairing, &self.prepared.test)?,
                    sum_of_nine_modes,
                    is_stopped,
                ));
            }
            History::GaussNewton(found) => found.as_ref().map(|found| &found.best),
        };
        let end = match found.map(|run| run.stop) {
            None => End::Request,
            Some(WeightedStop::Gradient) if self.is_lowest => End::Lowest,
            Some(WeightedStop::Gradient) => End::Stationary,
            Some(_) if found.is_some_and(|run| run.iterations.is_empty()) => End::Nothing,
            Some(WeightedStop::Trials) => End::Cap,
            Some(WeightedStop::Short) => End::Short,
        };
        let errors = self.last.mode_errors()?;
        let sum = sum_of_nine_modes(&self.last.result()?.errors);
        Ok(judged.verdict(end, (sum, &errors), &self.factors, false))
    }

    /// Everything there is to know after the steps.
    fn concerns(
        &self,
        verdict: &Verdict,
        seen: &Identifiability,
        misfit: &Misfit,
    ) -> Result<Vec<Concern>, FileError> {
        let prepared = &self.prepared;
        let mut all: Vec<Concern> = Vec::new();
        all.extend(
            misfit
                .untested()
                .map(|reason| Concern::not_checked(Check::Fit, &reason)),
        );
        all.extend(
            (!misfit.is_by_noise())
                .then(|| Concern::remark(Check::Fit, "misfit", &NONE, misfit.in_numbers())),
        );
        all.extend(misfit.is_below_noise().then(|| {
            let words = format!(
                "Noise alone would leave a chi-squared of {:.1} or more in 999 of 1000 tests, for {:.1} here: the test was computed, or \
                 its deviations are too large, and so are the intervals.",
                misfit.least_by_noise, misfit.chi_squared
            );
            Concern::remark(Check::Deviations, "below-noise", &NONE, words)
        }));
        all.extend(self.sight_concerns(verdict, seen));
        all.extend(listed(
            Check::Pairs,
            "joined",
            "Test modes left out at first and compared since",
            &numbers(prepared.joined.iter().copied()),
        ));
        all.extend(self.held_out()?.iter().map(|held| {
            let [first, last] = held.frequency;
            let shape = held.shape.map_or(String::new(), |[first, last]| {
                format!(", its shape by {first:.2} % and {last:.2} % RMS")
            });
            let words = format!("Test mode {} was not fitted: its frequency was off by {first:.2} % and is by {last:.2} %{shape}.", held.mode);
            Concern::remark(Check::HeldOut, "held-out-", &[held.mode], words)
        }));
        all.extend(prepared.unanswered(&self.last, Some(&seen.covariance)));
        all.extend(
            prepared
                .unlike(&self.last)?
                .iter()
                .map(|own| own.concern(Grade::LeftOut)),
        );
        Ok(all)
    }

    /// Remarks on what the test does not see, or cannot tell apart, and on bounds that hold factors.
    fn sight_concerns(&self, verdict: &Verdict, seen: &Identifiability) -> Vec<Concern> {
        let names: Vec<&str> = self.prepared.loaded.parameter_names().collect();
        let of = |places: &[usize]| places.iter().map(|&e| names[e]).collect::<Vec<&str>>();
        let groups = seen.untold_groups();
        let (mut alone, grouped) = (verdict.unseen.clone(), groups.concat());
        alone.retain(|e| !grouped.contains(e));
        let mut all: Vec<Concern> = Vec::new();
        all.extend(groups.iter().map(|group| {
            Concern::remark(
                Check::Sight,
                "not-apart-",
                &of(group),
                format!(
                    "The test cannot tell {} apart; only combinations of them are known.",
                    some(&of(group))
                ),
            )
        }));
        all.extend(listed(
            Check::Sight,
            "mostly-prior",
            "Known more from the prior than from the test",
            &of(&alone),
        ));
        all.extend(listed(
            Check::Sight,
            "at-bound",
            "At a bound",
            &of(&verdict.at_bound),
        ));
        all
    }

    /// Errors of the test modes that are held out, at first and at the end.
    pub fn held_out(&self) -> Result<Vec<HeldOut>, FileError> {
        let (first, last) = (self.first.mode_errors()?, self.last.mode_errors()?);
        let held = &self.prepared.loaded.job.test.hold_out;
        let both = self
            .prepared
            .compared()
            .zip(first.iter().zip(&last))
            .filter(|(mode, _)| held.contains(&(mode + 1)));
        let of_mode = |(mode, (first, last)): (usize, (&ModeErrors, &ModeErrors))| HeldOut {
            mode: mode + 1,
            frequency: [first, last].map(|own| 100.0 * own.frequency),
            shape: first
                .shape
                .zip(last.shape)
                .map(|(first, last)| [100.0 * first, 100.0 * last]),
        };
        Ok(both.map(of_mode).collect())
    }
}

/// Errors of a test mode that is held out, at the first and at the best factors, in percent.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Its number.
    pub mode: usize,
    /// Errors of its frequency.
    pub frequency: [f64; 2],
    /// Errors of its shape, if it has one.
    pub shape: Option<[f64; 2]>,
}

impl JobResult {
    /// The same with 95 % intervals where weighted steps ended at their optimum, in a basis about it with corrected slopes, and a word on the
    /// parameters that have none.
    ///
    /// # Errors
    /// The errors of the basis and of [`intervals`].
    fn with_intervals(mut self) -> Result<Self, FileError> {
        let (found, loaded) = (&self.found, &self.found.prepared.loaded);
        if self.verdict.end.is_stationary() {
            let (prepared, model) = (&found.prepared, &found.last);
            let (weights, settings) = (prepared.weights(), prepared.weighted_settings());
            let exact = jacobian(model, &weights)?;
            let size = Deflections::All(6 * prepared.modes.len() + 30);
            let basis = model.in_basis(model.model.in_basis(size)?, &exact, &weights)?;
            self.intervals = intervals(
                &basis.about(&found.factors),
                &found.factors,
                &loaded.source.whole.ranges(),
                &weights,
                &settings,
                self.misfit.widening(),
            )?;
        }
        let reason = |withheld: &Withheld| {
            let names = loaded.parameter_names().zip(&self.intervals);
            let names = names.filter(|own| *own.1 == Err(*withheld));
            let names: Vec<&str> = names.map(|own| own.0).collect();
            match (names.is_empty(), withheld) {
                (true, _) => None,
                // Remarks name the others.
                (_, Withheld::NoOptimum | Withheld::AtBound | Withheld::MostlyPrior) => {
                    Some(withheld.words().to_owned())
                }
                _ => Some(format!("{}: {}", withheld.words(), names.join(", "))),
            }
        };
        let reasons: Vec<String> = Withheld::ALL.iter().filter_map(reason).collect();
        if !reasons.is_empty() {
            let skipped = Concern::not_checked(Check::Intervals, &reasons.join("; "));
            self.trust = Trust::new([self.trust.all(), &[skipped]].concat());
        }
        let work = loaded.source.whole.work();
        self.found.work = work;
        Ok(self)
    }
}
