//! Many runs of one job: each sample depends on the study's seed and its own number alone, not on what ran before.

use super::correlated::{Caller, CorrelatedJob};
use super::verdict::Outcome;
use super::{Job, JobResult, LoadedJob, PreparedJob, Trust};
use crate::files::error::FileError;
use crate::files::test_data::quoted;
use crate::method::modes::Modes;
use crate::sparse::random::{split_mix_64, uniform};
use crate::weighted::noise::{Noise, with_noise_by_mode};
use serde::Deserialize;
use std::path::Path;

/// Part of a job that differs from sample to sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Vary {
    /// The test: every frequency and component by its standard deviation, see [`LoadedJob::deviations`].
    Noise,
    /// The first point, instead of the job's: factors from 0.5 to 2, log-uniformly, brought within their bounds.
    Start,
    /// Sensors or modes, either as likely: up to half of them are left out.
    Subset,
}

/// A job that is run many times.
#[derive(Debug, Clone)]
pub struct Study {
    /// The job as it is.
    pub prepared: PreparedJob,
    /// Doubts and remarks on the job before its first step.
    pub trust: Trust,
    /// The seed.
    pub seed: u64,
    /// Parts that vary, each once, ascending.
    pub vary: Vec<Vary>,
    /// A digest of the job's file, of the files it names, of the seed and of the parts that vary: samples with another do not
    /// belong to the study.
    pub identity: String,
}

impl Study {
    /// Reads a job to be run many times, and collects the doubts about it; `accepted` are the doubts that the user answers for.
    ///
    /// # Errors
    /// [`FileError::Refused`] without parameters; the errors of [`LoadedJob::new`] and [`Trust::before`].
    pub fn new(
        path: &Path,
        seed: u64,
        vary: &[Vary],
        accepted: &[String],
    ) -> Result<Self, FileError> {
        let prepared = LoadedJob::new(path)?.prepare()?;
        let loaded = &prepared.loaded;
        loaded.require_parameters()?;
        let mut vary = vary.to_vec();
        vary.sort_unstable();
        vary.dedup();
        let identity = loaded.identity(&format!("{seed} {vary:?}"))?;
        let trust = Trust::before(&prepared)?.accepting(accepted)?;
        Ok(Self {
            prepared,
            trust,
            seed,
            vary,
            identity,
        })
    }

    /// Names of the parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        self.prepared.loaded.parameter_names()
    }

    /// The line above the samples.
    pub fn header(&self) -> String {
        let names: Vec<String> = self.parameters().map(quoted).collect();
        format!(
            "sample,outcome,within,error_sum,analyses,{},study\n",
            names.join(",")
        )
    }

    /// The job of a sample, and its first factors.
    ///
    /// # Errors
    /// The errors of [`with_noise_by_mode`] and [`LoadedJob::prepare`].
    pub fn draw(&self, sample: u64) -> Result<(PreparedJob, Vec<f64>), FileError> {
        let LoadedJob {
            job, data, source, ..
        } = &*self.prepared.loaded;
        let (mut job, mut data, ranges) = (job.clone(), data.clone(), source.whole.ranges());
        // One generator per purpose, so that each draws the same whatever else varies.
        let generator = |what: Vary| {
            let parts = [self.seed, sample, what as u64].into_iter();
            let state = parts.fold(0, |state, part| split_mix_64(&mut (state ^ part)));
            self.vary.contains(&what).then_some(state)
        };
        if let Some(seed) = generator(Vary::Noise) {
            let modes = 0..data.frequencies_hz.len();
            let noise: Vec<Noise> = modes
                .map(|mode| self.prepared.loaded.deviations(mode))
                .collect();
            // Frequencies without shapes draw as if they had one.
            let rows = data.shapes.nrows();
            let mut shapes = data.shapes.clone().resize_vertically(rows.max(1), 1.0);
            let rigid = data.rigid.clone();
            for &mode in data.alone.iter().chain(&rigid) {
                shapes.fill_column(mode, 1.0);
            }
            rigid
                .iter()
                .for_each(|&mode| data.frequencies_hz[mode] = 1.0);
            let exact = Modes::from_measured(&data.frequencies_hz, &shapes)?;
            let noisy = with_noise_by_mode(&exact, &noise, seed)?;
            data.frequencies_hz = noisy.frequencies_hz();
            rigid
                .iter()
                .for_each(|&mode| data.frequencies_hz[mode] = 0.0);
            for mode in data.shaped() {
                let mut shape = noisy.shapes.column(mode).into_owned();
                // Components' own deviations instead of their mean.
                if let Some(own) = data.component_deviation.get(&mode) {
                    let drawn = &shape - exact.shapes.column(mode);
                    shape += drawn.component_mul(&own.map(|own| own / noise[mode].shape - 1.0));
                }
                data.shapes.set_column(mode, &shape);
            }
        }
        if let Some(state) = generator(Vary::Subset) {
            self.leave_out(&mut job, state);
        }
        let mut start = self.prepared.loaded.ones();
        if let Some(mut state) = generator(Vary::Start) {
            for (factor, range) in start.iter_mut().zip(&ranges) {
                let drawn = 0.5 * 4.0_f64.powf(uniform(&mut state));
                *factor = range.map_or(drawn, |range| drawn.clamp(range.lower, range.upper));
            }
        }
        let loaded = LoadedJob::with(job, data, source.clone())?;
        Ok((loaded.prepare()?, start))
    }

    /// Leaves out of a job up to half of its sensors or of its modes.
    fn leave_out(&self, job: &mut Job, mut state: u64) {
        let mut uniform = || uniform(&mut state);
        let is_sensors = uniform() < 0.5;
        let numbers = job
            .test
            .modes
            .clone()
            .unwrap_or_else(|| self.prepared.loaded.data.vibrations());
        let count = if is_sensors {
            self.prepared.loaded.placed.len()
        } else {
            numbers.len()
        };
        let mut places: Vec<usize> = (0..count).collect();
        let out = (0.5 * uniform() * count as f64)
            .ceil()
            .min(count.saturating_sub(1) as f64) as usize;
        for place in 0..out {
            places.swap(place, place + (uniform() * (count - place) as f64) as usize);
        }
        let (out, kept) = places.split_at_mut(out);
        kept.sort_unstable();
        if is_sensors {
            job.sensors.leave_out.extend(
                out.iter()
                    .map(|&row| self.prepared.loaded.placed[row].name.clone()),
            );
            return;
        }
        job.test.modes = Some(kept.iter().map(|&place| numbers[place]).collect());
        if let Some(partners) = &mut job.test.partners {
            *partners = kept.iter().map(|&place| partners[place]).collect();
        }
        for weights in [
            &mut job.compare.frequency_weights,
            &mut job.compare.shape_weights,
        ]
        .into_iter()
        .flatten()
        {
            *weights = kept
                .iter()
                .filter_map(|&place| weights.get(place).copied())
                .collect();
        }
    }

    /// Runs a sample as [`super::run`] runs a job. Returns its line, with the columns of [`Self::header`], and the error if it failed;
    /// a failed sample has nothing between outcome and study. `go_on` says on the way whether to continue.
    ///
    /// # Errors
    /// [`FileError::Interrupted`] when it was not to go on.
    pub fn run(
        &self,
        sample: u64,
        go_on: impl Fn() -> bool,
    ) -> Result<(String, Option<FileError>), FileError> {
        let caller = Caller {
            progress: &|_| {},
            go_on: &go_on,
        };
        let run = |(prepared, start): (PreparedJob, Vec<f64>)| {
            prepared.correlate(&start, &caller)?.judge(&self.trust)
        };
        let (numbers, failure) = match self.draw(sample).and_then(run) {
            Ok(result) if result.found.is_interrupted => return Err(FileError::Interrupted),
            Ok(JobResult {
                trust,
                verdict,
                found: CorrelatedJob {
                    analyses, factors, ..
                },
                ..
            }) => {
                let outcome = match verdict.outcome {
                    Outcome::Tolerance => "tolerance",
                    Outcome::LocalMinimum => "local minimum",
                    Outcome::Wall => "wall",
                    Outcome::Short => "short",
                    Outcome::Untested => "untested",
                    Outcome::Cap => "cap",
                    Outcome::Request => "request",
                    Outcome::Nothing => "nothing",
                };
                let factors: String = factors.iter().map(|factor| format!(",{factor}")).collect();
                (
                    format!(
                        "{outcome},{},{},{analyses}{factors}",
                        verdict.is_within && trust.are_all_compared(),
                        verdict.error_sum
                    ),
                    None,
                )
            }
            Err(error) => (
                format!("failed,,,{}", ",".repeat(self.parameters().count())),
                Some(error),
            ),
        };
        Ok((format!("{sample},{numbers},{}\n", self.identity), failure))
    }
}
