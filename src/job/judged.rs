//! A correlated job with everything that says how far to trust it: its last value.

use super::{
    PreparedJob,
    concern::{Check, Concern, Grade, NONE, Trust, some},
    correlated::{Caller, CorrelatedJob, Followed, History},
    verdict::{End, Verdict, sum_of_nine_modes},
};
use crate::{
    files::error::FileError,
    method::{error::Error, step::Bounds},
    sparse::{ModeWeight, Place},
    weighted::{
        comparison::ModeErrors,
        gauss_newton::WeightedStop,
        identifiability::{Identifiability, identifiability},
        intervals::{MOST_FOLLOWED, Withheld, intervals},
        misfit::{Misfit, Prediction},
        residuals::{jacobian, pair_by_residuals},
    },
};

/// Most deflections, beside one of every mode, that are drawn for intervals in a basis: a basis of twice as many moves no end of ten modes
/// and fifty parameters by a tenth of a deviation.
const MOST_DRAWN: usize = 50;

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
    prepared.loaded.job.ensure(
        !prepared.loaded.source.priors.is_empty(),
        || "a job needs at least one [[parameter]]",
    )?;
    let mut caller = Caller {
        progress: &mut progress,
        go_on: &go_on,
    };
    prepared.correlate(&mut caller)?.judge(trust)
}

impl CorrelatedJob {
    /// Judges what was found: how the residuals are to the noise, what the test sees, and what to know before trusting it.
    ///
    /// # Errors
    /// The errors of [`Misfit::of`], [`identifiability`] and [`intervals`].
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
        verdict.is_within &= predicted.iter().all(|own| own.missed.is_none());
        let intervals = if verdict.end.is_stationary() {
            self.intervals(&weights, &seen, misfit.widening())?
        } else {
            vec![Err(Withheld::NoOptimum); self.factors.len()]
        };
        let mut after = self.concerns(&seen, &misfit)?;
        let is_met = |own: &&Withheld| intervals.contains(&Err(**own));
        let reasons: Vec<&str> = Withheld::ALL
            .iter()
            .filter(is_met)
            .map(|own| own.words())
            .collect();
        if !reasons.is_empty() {
            after.push(Concern::not_checked(Check::Intervals, &reasons.join("; ")));
        }
        let work = self.prepared.loaded.source.whole.work();
        Ok(JobResult {
            found: Self { work, ..self },
            trust: trust.after(after),
            verdict,
            seen_first,
            seen,
            misfit,
            predicted,
            intervals,
        })
    }

    /// 95 % intervals about the optimum of weighted steps, in a basis about it with corrected slopes.
    fn intervals(
        &self,
        weights: &[ModeWeight],
        seen: &Identifiability,
        widening: f64,
    ) -> Result<Vec<Result<Bounds, Withheld>>, FileError> {
        let prepared = &self.prepared;
        let exact = jacobian(&self.last, weights)?;
        let modes = self.last.partners();
        let count = modes.len() + self.factors.len().min(MOST_DRAWN);
        // Whatever the pairs: where the rule of pairing changes its mind the residuals would jump.
        let mut model = self.last.clone();
        model.model.pair = pair_by_residuals(&prepared.test, weights);
        let drawn = |whole: &Place| {
            let root = seen.covariance.clone().cholesky();
            let root = root.ok_or(Error::no_convergence("covariance of the factors"))?;
            whole.drawn(Some(&root.l()), &modes, (count, None))
        };
        let analyze: Followed = match self.factors.len() > MOST_FOLLOWED {
            // By slopes alone nothing is followed.
            true => Box::new(|_| Ok(model.clone())),
            false => prepared.about((&model, &self.factors), Some((&exact, weights)), drawn)?,
        };
        Ok(intervals(
            &analyze,
            &self.factors,
            &prepared.loaded.source.whole.ranges(),
            weights,
            &prepared.weighted_settings(),
            widening,
        )?)
    }

    /// The verdict by the reason why it ended and by the tolerances.
    fn verdict(&self) -> Result<Verdict, FileError> {
        let end = match &self.history {
            History::Paper(run) => (End::of_loops(run, self.is_interrupted), run.converged),
            History::GaussNewton(None) => (End::Request, false),
            History::GaussNewton(Some(found)) => {
                let end = match found.best.stop {
                    WeightedStop::Gradient if self.is_lowest => End::Lowest,
                    WeightedStop::Gradient => End::Stationary,
                    _ if found.best.iterations.is_empty() => End::Nothing,
                    WeightedStop::Trials => End::Cap,
                    WeightedStop::Short => End::Short,
                };
                (end, false)
            }
        };
        let (errors, sum) = (
            self.last.mode_errors()?,
            sum_of_nine_modes(&self.last.result()?.errors),
        );
        let ranges = self.prepared.loaded.source.whole.ranges();
        Ok(Verdict::new(end, (sum, &errors), &self.factors, &ranges))
    }

    /// Everything there is to know after the steps.
    fn concerns(&self, seen: &Identifiability, misfit: &Misfit) -> Result<Vec<Concern>, FileError> {
        let (prepared, mut all) = (&self.prepared, Vec::new());
        let untested = misfit.untested();
        all.extend(untested.map(|reason| Concern::not_checked(Check::Fit, &reason)));
        if !misfit.is_by_noise() {
            all.push(Concern::remark(
                Check::Fit,
                "misfit",
                &NONE,
                misfit.in_numbers(),
            ));
        }
        if misfit.is_below_noise() {
            let words = format!(
                "Noise alone would leave a chi-squared of {:.1} or more in 999 of 1000 tests, for {:.1} here: the test was computed, or \
                 its deviations are too large, and so are the intervals.",
                misfit.least_by_noise, misfit.chi_squared
            );
            all.push(Concern::remark(
                Check::Deviations,
                "below-noise",
                &NONE,
                words,
            ));
        }
        let names: Vec<&str> = prepared.loaded.parameter_names().collect();
        for group in seen.untold_groups() {
            let group: Vec<&str> = group.iter().map(|&e| names[e]).collect();
            let words = format!(
                "The test cannot tell {} apart; only combinations of them are known.",
                some(&group)
            );
            all.push(Concern::remark(Check::Sight, "not-apart-", &group, words));
        }
        all.extend(prepared.unanswered(&self.last));
        let left = prepared.unlike(&self.last)?;
        all.extend(left.iter().map(|own| own.concern(Grade::LeftOut)));
        Ok(all)
    }

    /// Errors of the test modes that are held out, at first and at the end.
    pub fn held_out(&self) -> Result<Vec<HeldOut>, FileError> {
        let (first, last) = (self.first.mode_errors()?, self.last.mode_errors()?);
        let held = &self.prepared.loaded.job.test.hold_out;
        let both = self.prepared.compared().zip(first.iter().zip(&last));
        let of_held = both.filter(|(mode, _)| held.contains(&(mode + 1)));
        let of_mode = |(mode, (first, last)): (usize, (&ModeErrors, &ModeErrors))| HeldOut {
            mode: mode + 1,
            frequency: [first, last].map(|own| 100.0 * own.frequency),
            shape: first
                .shape
                .zip(last.shape)
                .map(|(first, last)| [100.0 * first, 100.0 * last]),
        };
        Ok(of_held.map(of_mode).collect())
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
