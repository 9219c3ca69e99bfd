//! Runs a job: finds the factors, how well the test determines them, and the deck that has them.

use super::{LoadedJob, Method, ParameterRule};
use crate::files::deck::rewrite;
use crate::files::error::FileError;
use crate::method::derivatives::error_changes;
use crate::method::error_sum::{ModeWeight, mode_errors};
use crate::method::model::{Bounds, ModalModel};
use crate::method::outer_loop::{Correlation, Pass, correlate_while, meets};
use crate::method::structure::{Element, Material};
use crate::method::verdict::{Outcome, Verdict};
use crate::sparse::{WholeParameter, WholeShare};
use crate::weighted::gauss_newton::{
    WeightedCorrelation, WeightedSettings, WeightedStop, from_several_starts, gauss_newton,
};
use crate::weighted::identifiability::{Identifiability, identifiability};
use crate::weighted::noise::Noise;
use crate::weighted::residuals::{DEVIATIONS, jacobian, residuals};

/// How the factors were found.
#[derive(Debug, Clone)]
pub enum History {
    /// By the paper's loops.
    Paper(Correlation),
    /// By Gauss–Newton steps, and how many of the starts reach the best; none when it was stopped by request.
    GaussNewton(Option<(WeightedCorrelation, usize)>),
}

/// The result of a job.
#[derive(Debug, Clone)]
pub struct JobResult {
    /// How the factors were found.
    pub history: History,
    /// The best factors.
    pub factors: Vec<f64>,
    /// The first model.
    pub first: ModalModel,
    /// The model at the best factors.
    pub last: ModalModel,
    /// The verdict on them.
    pub verdict: Verdict,
    /// What the test sees of the parameters, at the first model and at the best factors.
    pub seen: [Identifiability; 2],
    /// Exact analyses made, the first and the last among them.
    pub analyses: usize,
    /// Whether it was stopped by request.
    pub is_interrupted: bool,
}

impl LoadedJob {
    /// The weight of every test mode: one over its standard deviation, times the job's weight.
    ///
    /// # Errors
    /// [`FileError::Refused`] for weights that are not one a test mode.
    pub fn weights(&self) -> Result<Vec<ModeWeight>, FileError> {
        let compare = &self.job.compare;
        let named = self
            .job
            .test
            .modes
            .as_ref()
            .map_or(self.data.frequencies_hz.len(), Vec::len);
        let lists = [
            ("frequency_weights", &compare.frequency_weights),
            ("shape_weights", &compare.shape_weights),
        ];
        for (what, list) in lists {
            let other = list.as_ref().map(Vec::len).filter(|count| *count != named);
            self.job.refuse_if(other, |count| {
                format!("compare.{what}: {count} given for {named} test modes")
            })?;
        }
        let weight = |(own, &mode): (ModeWeight, &usize)| {
            let noise = self.deviations(mode);
            ModeWeight {
                frequency: own.frequency / noise.frequency,
                shape: own.shape / noise.shape,
            }
        };
        Ok(self
            .own_weights()
            .into_iter()
            .zip(&self.modes)
            .map(weight)
            .collect())
    }

    /// The job's own weights of the test modes, ones where it has none.
    pub(super) fn own_weights(&self) -> Vec<ModeWeight> {
        let (numbers, compare) = (&self.job.test.modes, &self.job.compare);
        let of = |list: &Option<Vec<f64>>, mode: usize| {
            let place = numbers.as_ref().map_or(Some(mode), |all| {
                all.iter().position(|number| *number == mode + 1)
            });
            list.as_ref()
                .zip(place)
                .and_then(|(list, place)| list.get(place).copied())
                .unwrap_or(1.0)
        };
        let weight = |&mode: &usize| ModeWeight {
            frequency: of(&compare.frequency_weights, mode),
            shape: of(&compare.shape_weights, mode),
        };
        self.modes.iter().map(weight).collect()
    }

    /// Standard deviations of a mode of the test's file, from zero: the test's own, else the job's, else 0.5 % and 2 %.
    pub fn deviations(&self, mode: usize) -> Noise {
        let of = |own: &Option<Vec<f64>>, given: Option<f64>, usual: f64| {
            own.as_ref()
                .and_then(|own| own.get(mode).copied())
                .or(given)
                .unwrap_or(usual)
        };
        let (data, compare) = (&self.data, &self.job.compare);
        Noise {
            frequency: of(
                &data.frequency_deviation,
                compare.frequency_deviation,
                DEVIATIONS.frequency,
            ),
            shape: of(
                &data.shape_deviation,
                compare.shape_deviation,
                DEVIATIONS.shape,
            ),
        }
    }

    /// The deck with the elements scaled by `factors` and every other byte as it was; none for a model of matrices.
    ///
    /// A factor on stiffness changes an element's size and takes its density down by as much; one on mass changes its density.
    ///
    /// # Errors
    /// Those of [`rewrite`]; [`FileError::Refused`] for factors of point masses, which are not rewritten.
    pub fn corrected_deck(&self, factors: &[f64]) -> Result<Option<Vec<u8>>, FileError> {
        let Some((bytes, deck)) = &self.source.deck else {
            return Ok(None);
        };
        let mut elements = deck.model.elements.clone();
        let parameters = self
            .source
            .whole
            .parameters()
            .iter()
            .zip(&self.source.members);
        for ((WholeParameter { name, share, .. }, members), &factor) in parameters.zip(factors) {
            let has_masses = |rule: &ParameterRule| rule.name == *name && !rule.masses.is_empty();
            let is_of_masses = members.is_empty() || self.job.parameters.iter().any(has_masses);
            self.job.refuse_if((is_of_masses && factor != 1.0).then_some(factor), |factor| {
                format!("parameter \"{name}\" scales point masses by {factor}; a corrected deck can only change elements")
            })?;
            for element in elements
                .iter_mut()
                .filter(|element| members.binary_search(&element.label).is_ok())
            {
                let Element {
                    size,
                    material: Material { density, .. },
                    ..
                } = element;
                match share {
                    WholeShare::Stiffness(_) | WholeShare::Elements(_) => {
                        (*size, *density) = (*size * factor, *density / factor)
                    }
                    WholeShare::Mass(_) => *density *= factor,
                }
            }
        }
        let name = self
            .job
            .model
            .deck
            .as_ref()
            .map_or_else(String::new, |path| path.display().to_string());
        rewrite(&name, bytes, &elements).map(Some)
    }
}

/// Runs a job. `progress` gets a line for every pass or improvement; `go_on` says after each whether to continue.
///
/// # Errors
/// Those of the analyses, of the loops and of [`LoadedJob::weights`].
pub fn run(
    loaded: &LoadedJob,
    mut progress: impl FnMut(&str),
    go_on: impl Fn() -> bool,
) -> Result<JobResult, FileError> {
    run_from(loaded, &loaded.ones(), &mut progress, &go_on)
}

/// The same, but starting from other factors than one, and then from these alone.
pub(super) fn run_from(
    loaded: &LoadedJob,
    start: &[f64],
    progress: &mut dyn FnMut(&str),
    go_on: &dyn Fn() -> bool,
) -> Result<JobResult, FileError> {
    loaded.check_paired()?;
    let (compare, settings) = (&loaded.job.compare, &loaded.job.correlation);
    let (weights, ranges) = (loaded.weights()?, loaded.source.whole.ranges());
    let (ones, weighted) = (vec![1.0; ranges.len()], WeightedSettings::default());
    let analyses = std::cell::Cell::new(0);
    let analyze = |factors: &[f64]| {
        analyses.set(analyses.get() + 1);
        loaded.analyze(factors)
    };
    let first = analyze(start)?;
    let analyze = |factors: &[f64]| {
        if factors == start {
            Ok(first.clone())
        } else {
            analyze(factors)
        }
    };
    let is_interrupted = std::cell::Cell::new(false);
    let may_go_on = || {
        is_interrupted.set(is_interrupted.get() || !go_on());
        !is_interrupted.get()
    };
    let (history, factors) = match compare.method {
        Method::Paper => {
            let mut report_pass = |number: usize, pass: &Pass| {
                let errors = &pass.check.errors;
                let (frequency, shape) =
                    (100.0 * errors.frequency_rms(), 100.0 * errors.shape_rms());
                progress(&format!(
                    "pass {number}: frequencies {frequency:.2} %, shapes {shape:.2} % RMS"
                ));
                may_go_on()
            };
            // The loops count factors from one: the start is their first model.
            let total = |factors: &[f64]| {
                factors
                    .iter()
                    .zip(start)
                    .map(|(a, b)| a * b)
                    .collect::<Vec<f64>>()
            };
            let seen = |(range, start): (&Option<Bounds>, &f64)| {
                range.map(|range| Bounds {
                    lower: range.lower / start,
                    upper: range.upper / start,
                })
            };
            let ranges: Vec<_> = ranges.iter().zip(start).map(seen).collect();
            let run = correlate_while(
                &mut |factors| analyze(&total(factors)),
                &|model, state| error_changes(model, state, settings.inner.derivatives),
                &ranges,
                settings,
                &mut report_pass,
            )?;
            let factors = total(&run.best_factors);
            (History::Paper(run), factors)
        }
        Method::GaussNewton => {
            let starts = compare.starts.unwrap_or(1);
            let mut best: Option<(f64, Vec<f64>)> = None;
            let analyze = |factors: &[f64]| {
                let model = analyze(factors)?;
                let objective = residuals(&model, &weights)?.norm_squared();
                if best.as_ref().is_none_or(|(least, _)| objective < *least) {
                    best = Some((objective, factors.to_vec()));
                    progress(&format!("sum of squares {objective:.4e}"));
                }
                if may_go_on() {
                    Ok(model)
                } else {
                    Err(FileError::Interrupted)
                }
            };
            let found = match start == ones {
                true => {
                    from_several_starts(analyze, &ranges, &weights, &weighted, starts, compare.seed)
                }
                false => {
                    gauss_newton(analyze, start, &ranges, &weights, &weighted).map(|run| (run, 1))
                }
            };
            match found {
                Ok((run, reached)) => {
                    let factors = run.factors.clone();
                    (History::GaussNewton(Some((run, reached))), factors)
                }
                Err(FileError::Interrupted) => (
                    History::GaussNewton(None),
                    best.map_or(ones, |(_, factors)| factors),
                ),
                Err(error) => return Err(error),
            }
        }
    };
    let last = analyze(&factors)?;
    let verdict = match &history {
        History::Paper(run) => run.verdict.clone(),
        History::GaussNewton(run) => {
            let is_within = meets(&last.exact.errors, settings);
            let outcome = match run
                .as_ref()
                .map(|(run, _)| (run.stop, run.iterations.is_empty()))
            {
                _ if is_within => Outcome::Tolerance,
                Some((_, true)) => Outcome::Nothing,
                None | Some((WeightedStop::Trials, _)) => Outcome::Cap,
                _ => Outcome::LocalMinimum,
            };
            let errors = mode_errors(&last.exact.modes, &last.exact.pairing, &last.test)?;
            let seen: Vec<f64> = first
                .test_shares
                .iter()
                .map(|share| share.diagonal().amax())
                .collect();
            let sum = last.exact.errors.sum();
            Verdict::new(outcome, (sum, &errors), &factors, &seen, &ranges, is_within)
        }
    };
    let sees =
        |model: &ModalModel| identifiability(&jacobian(model, &weights)?, weighted.prior_deviation);
    let seen = [sees(&first)?, sees(&last)?];
    let (analyses, is_interrupted) = (analyses.get(), is_interrupted.get());
    Ok(JobResult {
        history,
        factors,
        verdict,
        seen,
        first,
        last,
        analyses,
        is_interrupted,
    })
}
