//! Runs a job: finds the factors, how well the test determines them, and the deck that has them.

use super::verdict::{Judged, Outcome, Verdict, sum_of_nine_modes};
use super::{LoadedJob, Method, Trust};
use crate::files::deck::rewrite;
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::error_sum::mode_errors;
use crate::method::outer_loop::{Correlation, Pass, correlate};
use crate::method::step::Bounds;
use crate::method::structure::{Element, Material};
use crate::sparse::{ModeWeight, WholeParameter, WholeShare, Work};
use crate::weighted::comparison::Comparison;
use crate::weighted::gauss_newton::{
    WeightedCorrelation, WeightedSettings, WeightedStop, gauss_newton,
};
use crate::weighted::identifiability::{Identifiability, identifiability};
use crate::weighted::intervals::intervals;
use crate::weighted::misfit::Misfit;
use crate::weighted::noise::Noise;
use crate::weighted::residuals::{DEVIATIONS, jacobian, residuals};
use crate::weighted::starts::{Minimum, from_several_starts};

/// Distance from the optimum, in deviations, at which weighted steps stop: no interval shows it.
const TOLERANCE: f64 = 1e-3;

/// How the factors were found.
#[derive(Debug, Clone)]
pub enum History {
    /// By the paper's loops.
    Paper(Box<Correlation>),
    /// By Gauss–Newton steps, with the minima that noise allows of several starts and how many failed; none when it was stopped by request.
    GaussNewton(Option<(Box<WeightedCorrelation>, Vec<Minimum>, usize)>),
}

/// The result of a job.
#[derive(Debug, Clone)]
pub struct JobResult {
    /// The job with the test modes that were compared at the end.
    pub loaded: LoadedJob,
    /// Everything that may lower the trust in it.
    pub trust: Trust,
    /// How the factors were found.
    pub history: History,
    /// The best factors.
    pub factors: Vec<f64>,
    /// The first model.
    pub first: Comparison,
    /// The model at the best factors.
    pub last: Comparison,
    /// The verdict on them.
    pub verdict: Verdict,
    /// What the test sees of the parameters, at the first model and at the best factors.
    pub seen: [Identifiability; 2],
    /// How the residuals at the best factors are to the noise.
    pub misfit: Misfit,
    /// 95 % intervals about the factors, where they are true: around the optimum of weighted steps alone, not around the stop of the
    /// paper's rule, of steps too short or of too many trials. Residuals that are too large for the noise widen them by as much.
    pub intervals: Vec<Option<Bounds>>,
    /// Exact analyses made, the first and the last among them.
    pub analyses: usize,
    /// Work that they took, with that of the look before.
    pub work: Work,
}

impl LoadedJob {
    /// Test modes that are compared, from zero: those with shapes, then those without.
    pub fn compared(&self) -> impl Iterator<Item = usize> {
        let alone = self.alone.iter().map(|(mode, _)| *mode);
        self.modes.iter().copied().chain(alone)
    }

    /// Settings of weighted steps with the job's priors.
    fn weighted_settings(&self) -> WeightedSettings {
        WeightedSettings {
            prior_deviations: self.source.priors.clone(),
            tolerance: TOLERANCE,
            ..WeightedSettings::default()
        }
    }

    /// The weight of every test mode, of those without shapes last: one over its standard deviation, times the job's weight.
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
        let weight = |(own, mode): (ModeWeight, usize)| {
            let noise = self.deviations(mode);
            ModeWeight {
                frequency: own.frequency / noise.frequency,
                shape: own.shape / noise.shape,
            }
        };
        Ok(self
            .own_weights()
            .into_iter()
            .zip(self.compared())
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
        let weight = |mode: usize| ModeWeight {
            frequency: of(&compare.frequency_weights, mode),
            shape: of(&compare.shape_weights, mode),
        };
        self.compared().map(weight).collect()
    }

    /// Standard deviations of a mode of the test's file, from zero: the test's own, else the job's, else 0.5 % and 2 %.
    pub fn deviations(&self, mode: usize) -> Noise {
        let [frequency, shape] = self.given_deviations(mode);
        Noise {
            frequency: frequency.unwrap_or(DEVIATIONS.frequency),
            shape: shape.unwrap_or(DEVIATIONS.shape),
        }
    }

    /// Those of its frequency and of its shape that the test or the job gives; of components' own the root of their mean square.
    pub(super) fn given_deviations(&self, mode: usize) -> [Option<f64>; 2] {
        let (data, compare) = (&self.data, &self.job.compare);
        let own = |own: &Option<Vec<f64>>| own.as_ref().and_then(|own| own.get(mode).copied());
        let components = data.component_deviation.get(&mode);
        let mean = components.map(|all| (all.norm_squared() / all.len() as f64).sqrt());
        [
            own(&data.frequency_deviation).or(compare.frequency_deviation),
            mean.or(own(&data.shape_deviation))
                .or(compare.shape_deviation),
        ]
    }

    /// The deck with elements and point masses scaled by `factors` and every other byte as it was; none for a model of matrices.
    ///
    /// A factor on stiffness changes an element's size and takes its density down by as much; one on mass changes its density.
    ///
    /// # Errors
    /// Those of [`rewrite`].
    pub fn corrected_deck(&self, factors: &[f64]) -> Result<Option<Vec<u8>>, FileError> {
        let Some((bytes, deck)) = &self.source.deck else {
            return Ok(None);
        };
        let (mut elements, mut masses) = (deck.model.elements.clone(), deck.model.masses.clone());
        let parameters = self.source.whole.parameters().iter();
        let parameters = parameters.zip(&self.source.members).zip(factors);
        for ((WholeParameter { share, .. }, [members, points]), factor) in parameters {
            for point in masses
                .iter_mut()
                .filter(|point| points.binary_search(&point.label).is_ok())
            {
                point.mass *= factor;
            }
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
        rewrite(&name, bytes, &elements, &masses).map(Some)
    }
}

/// Runs a job, after a look at what is doubtful of it. `progress` gets a line for every pass or improvement; `go_on` says after each
/// whether to continue.
///
/// # Errors
/// [`FileError::Refused`] without parameters; those of [`Trust::before`], of the analyses, of the loops and of
/// [`LoadedJob::weights`].
pub fn run(
    loaded: &LoadedJob,
    mut progress: impl FnMut(&str),
    go_on: impl Fn() -> bool,
) -> Result<JobResult, FileError> {
    loaded.require_parameters()?;
    let trust = Trust::before(loaded)?;
    let mut result = run_from(loaded, trust, &loaded.ones(), &mut progress, &go_on)?;
    if let History::GaussNewton(Some((run, ..))) = &result.history
        && run.stop == WeightedStop::Gradient
    {
        let loaded = &result.loaded;
        let (ranges, weights) = (loaded.source.whole.ranges(), loaded.weights()?);
        let (model, factors) = (&result.last, &result.factors);
        let settings = loaded.weighted_settings();
        let widening = result.misfit.widening();
        let exact = jacobian(model, &weights)?;
        let basis = model.model.spread(6 * loaded.modes.len() + 30)?;
        let basis = model.in_basis(basis, &exact, &weights)?;
        let follow = |at: &[f64]| {
            let change: Vec<f64> = at.iter().zip(factors).map(|(at, from)| at / from).collect();
            basis.followed(&change)
        };
        result.intervals = intervals(&follow, factors, &ranges, &weights, &settings, widening)?;
        result.work = result.loaded.source.whole.work();
    }
    Ok(result)
}

/// The same after the look, starting from other factors than one, and then from these alone.
///
/// A test mode that is left out is looked at again after every pass of the paper's loops and every weighted step, of several starts at
/// their best. One that resembles a mode of the model by then is compared from there on, and the passes before, which did not count it,
/// are not shown.
pub(super) fn run_from(
    loaded: &LoadedJob,
    trust: Trust,
    start: &[f64],
    progress: &mut dyn FnMut(&str),
    go_on: &dyn Fn() -> bool,
) -> Result<JobResult, FileError> {
    let mut part = run_part(loaded, trust, start, progress, go_on)?;
    while !part.trust.is_interrupted
        && let Some(joined) = part.loaded.joined_by(&part.last.model.exact.modes)?
    {
        // Where the next part begins is at hand.
        let analyses = part.analyses - 1;
        let made = [(start, &part.first), (&part.factors[..], &part.last)];
        let joined = joined.with_analyses(made);
        progress(&format!("test modes compared: {}", joined.modes.len()));
        part = run_part(&joined, part.trust, &part.factors, progress, go_on)?;
        part.analyses += analyses;
        part.first = joined.analyze(start)?.with_slopes()?;
        part.seen[0] = sees(&joined, &part.first)?;
    }
    let loaded = &part.loaded;
    let unpaired = loaded.unlike(&part.last.model.exact.modes)?;
    part.trust = part.trust.after(
        loaded,
        &unpaired,
        &part.verdict,
        &part.seen[1],
        &part.misfit,
    );
    Ok(part)
}

/// What the test sees of the parameters at a model.
fn sees(loaded: &LoadedJob, model: &Comparison) -> Result<Identifiability, FileError> {
    Ok(identifiability(
        &jacobian(model, &loaded.weights()?)?,
        &loaded.source.priors,
    )?)
}

/// A run with the test modes that the job compares now.
fn run_part(
    loaded: &LoadedJob,
    trust: Trust,
    start: &[f64],
    progress: &mut dyn FnMut(&str),
    go_on: &dyn Fn() -> bool,
) -> Result<JobResult, FileError> {
    loaded.check_paired()?;
    let (compare, settings) = (&loaded.job.compare, &loaded.job.correlation);
    let (weights, ranges) = (loaded.weights()?, loaded.source.whole.ranges());
    let ones = vec![1.0; ranges.len()];
    let weighted = loaded.weighted_settings();
    let analyses = std::cell::Cell::new(0);
    // The modes of one analysis begin the search for the next.
    let near = std::cell::RefCell::new(None);
    let analyze = |factors: &[f64]| {
        analyses.set(analyses.get() + 1);
        let found = loaded.analyze_near(factors, near.borrow().as_ref())?;
        let shapes = found
            .model
            .whole()
            .map(|whole| whole.shapes(usize::MAX).shapes);
        near.replace(shapes);
        Ok::<_, Error>(found)
    };
    let first = analyze(start)?.with_slopes()?;
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
    let mut has_joined = false;
    let (history, factors) = match compare.method {
        Method::Paper => {
            let mut report_pass = |number: usize, pass: &Pass| {
                let errors = &pass.check.errors;
                let (frequency, shape) =
                    (100.0 * errors.frequency_rms(), 100.0 * errors.shape_rms());
                progress(&format!(
                    "pass {number}: frequencies {frequency:.2} %, shapes {shape:.2} % RMS"
                ));
                has_joined = matches!(loaded.joined_by(&pass.check.modes), Ok(Some(_)));
                may_go_on() && !has_joined
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
            let mut run = correlate(
                |factors: &[f64]| analyze(&total(factors)).map(Comparison::into_model),
                &ranges,
                &settings.for_modes(loaded.modes.len()),
                &mut report_pass,
            )
            .map_err(|error: Error| {
                if error.is_of_close_modes() {
                    let other = "compare.method = \"gauss_newton\" needs none";
                    loaded.job.refused(format!(
                        "the paper's loops need modes that stay apart: {error}; {other}"
                    ))
                } else {
                    error.into()
                }
            })?;
            for pass in &mut run.passes {
                pass.factors = total(&pass.factors);
            }
            run.best_factors = total(&run.best_factors);
            // A mode that has come in did so after the last pass, which need not be the best of those without it.
            let last = run.passes.last().filter(|_| has_joined);
            let factors = last.map_or(&run.best_factors, |pass| &pass.factors).clone();
            (History::Paper(Box::new(run)), factors)
        }
        Method::GaussNewton => {
            let is_first = start == ones;
            let starts = compare.starts.filter(|_| is_first).unwrap_or(1);
            let mut best: Option<(f64, Vec<f64>)> = None;
            let analyze = |factors: &[f64]| {
                if has_joined || is_interrupted.get() {
                    return Err(FileError::Interrupted);
                }
                let model = analyze(factors)?;
                let objective = residuals(&model, &weights)?.norm_squared();
                if best.as_ref().is_none_or(|(least, _)| objective < *least) {
                    best = Some((objective, factors.to_vec()));
                    progress(&format!("sum of squares {objective:.4e}"));
                    // Other starts may lead elsewhere: their best is looked at.
                    has_joined =
                        starts == 1 && loaded.joined_by(&model.model.exact.modes)?.is_some();
                }
                if !has_joined && may_go_on() {
                    Ok(model)
                } else {
                    Err(FileError::Interrupted)
                }
            };
            let found = match starts {
                1 => gauss_newton(analyze, start, &ranges, &weights, &weighted)
                    .map(|run| (run, Vec::new(), 0)),
                _ => {
                    from_several_starts(analyze, &ranges, &weights, &weighted, starts, compare.seed)
                }
            };
            match found {
                Ok((run, minima, failed)) if !has_joined && !is_interrupted.get() => {
                    let factors = run.factors.clone();
                    (
                        History::GaussNewton(Some((Box::new(run), minima, failed))),
                        factors,
                    )
                }
                Ok(_) | Err(FileError::Interrupted) => (
                    History::GaussNewton(None),
                    best.map_or(ones, |(_, factors)| factors),
                ),
                Err(error) => return Err(error),
            }
        }
    };
    let last = match &history {
        History::GaussNewton(Some((run, ..))) => run.last.clone(),
        _ => analyze(&factors)?.with_slopes()?,
    };
    let seen = first.largest_parts();
    let judged = Judged {
        seen: &seen,
        ranges: &ranges,
    };
    let mut verdict = match &history {
        History::Paper(run) => {
            let best = run.best_check();
            let errors = mode_errors(&best.modes, &best.pairing, &loaded.test)?;
            let is_stopped = is_interrupted.get() || has_joined;
            judged.of_loops(run, &errors, sum_of_nine_modes, is_stopped)
        }
        History::GaussNewton(run) => {
            let outcome = match run
                .as_ref()
                .map(|(run, ..)| (run.stop, run.iterations.is_empty()))
            {
                Some((_, true)) => Outcome::Nothing,
                None => Outcome::Request,
                Some((WeightedStop::Trials, _)) => Outcome::Cap,
                Some((WeightedStop::Step, _)) => Outcome::ShortSteps,
                _ => Outcome::LocalMinimum,
            };
            let (errors, sum) = (
                last.mode_errors()?,
                sum_of_nine_modes(&last.result()?.errors),
            );
            judged.verdict(outcome, (sum, &errors), &factors, false)
        }
    };
    let mut misfit = Misfit::of(&last, &weights, &loaded.source.priors, &verdict.at_bound)?;
    misfit.chi_squared *= loaded.estimate_scale(misfit.degrees_of_freedom);
    // Weighted steps are judged by the noise that weighs them.
    if compare.method == Method::GaussNewton && misfit.is_by_noise() {
        (verdict.outcome, verdict.is_within) = (Outcome::Tolerance, true);
    }
    let seen = [sees(loaded, &first)?, sees(loaded, &last)?];
    let (analyses, is_interrupted) = (analyses.get(), is_interrupted.get());
    Ok(JobResult {
        loaded: loaded.clone(),
        trust: Trust {
            is_interrupted,
            ..trust
        },
        history,
        factors,
        verdict,
        seen,
        misfit,
        intervals: vec![None; ranges.len()],
        first,
        last,
        analyses,
        work: loaded.source.whole.work(),
    })
}
