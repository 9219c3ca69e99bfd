//! Doubts about a job before its first step, and remarks.

use super::{
    Method, PreparedJob,
    bodies::of_bodies,
    concern::{Check, Concern, Grade, NONE, Trust, listed, numbers, some},
    preflight::{Names, SeenModes, preflight_at_sensors},
};
use crate::{
    files::error::FileError,
    method::modes::Modes,
    sparse::visibility::visibilities,
    weighted::{comparison::Comparison, noise::Noise, residuals::DEVIATIONS},
};
use nalgebra::DMatrix;

/// Part of a frequency beyond which what digits leave open is said: a fifth of the least deviation that is assumed.
pub(crate) const OPEN: f64 = 1e-3;

impl Trust {
    /// Everything that there is reason to say of a job before its first step.
    ///
    /// # Errors
    /// The errors of [`preflight_at_sensors`] and of the analysis that it needs; [`FileError::Refused`] for a mass that is not finite.
    pub fn before(prepared: &PreparedJob) -> Result<Self, FileError> {
        let loaded = &prepared.loaded;
        let mut all = loaded.places_concerns();
        all.extend(loaded.setting_concerns());
        all.extend(prepared.free_motions()?);
        all.extend(prepared.reading_concerns()?);
        let is_right = !all.iter().any(Concern::stands);
        if prepared.is_without_pairs() && is_right {
            let words = "No test mode resembles a mode of the model: another structure, other sensors, or several mistakes at once?";
            all.push(Concern::doubt(Check::Pairs, "no-pair", &NONE, words));
        }
        // A mistake in the readings or in all frequencies says more than each pair that it makes.
        all.extend(match all.iter().any(Concern::stands) {
            true => {
                vec![Concern::not_checked(
                    Check::Reach,
                    "another doubt is answered first",
                )]
            }
            false => prepared.frequency_concerns(),
        });
        all.extend(prepared.pairing_concerns());
        all.extend(prepared.unseen_concerns());
        all.extend(prepared.noise_concerns());
        all.extend(loaded.part_concerns()?);
        all.extend(loaded.data_concerns());
        Ok(Self::new(all))
    }
}

impl PreparedJob {
    /// What the digits of the model leave open about free motions.
    fn free_motions(&self) -> Result<Vec<Concern>, FileError> {
        let (source, lowest) = (&self.loaded.source, self.first.shapes(1).frequencies_hz());
        let lowest = lowest.first().copied();
        let said = source
            .whole
            .body_findings(|row| source.row_name(row), lowest)?;
        let mut all: Vec<Concern> = said.iter().map(of_bodies).collect();
        let is_said = self.loaded.job.model.rigid_bodies.is_some();
        if is_said && source.whole.rigid_bodies()?.rigid() > 0 {
            all.push(Concern::not_checked(
                Check::FreeMotions,
                "model.rigid_bodies says how many there are",
            ));
        }
        Ok(all)
    }

    /// What the pre-flight finds in all modes of the test.
    fn reading_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (loaded, mut modes) = (&self.loaded, self.loaded.shaped());
        modes.sort_unstable();
        if modes.is_empty() {
            return Ok(vec![Concern::not_checked(
                Check::Readings,
                "the test has no shapes",
            )]);
        }
        let whole = self.first.shapes(2 * loaded.usual_modes());
        let seen = SeenModes {
            shares: self.first.shares(whole.len()),
            modes: Modes::new(whole.omega_squared, loaded.sensors.times(&whole.shapes)?)?,
        };
        // Assumed deviations are no less than a test's own, and declare none.
        let declared = |&mode: &usize| {
            let [frequency, shape] = loaded.given_deviations(mode).map(Option::unwrap_or_default);
            Noise { frequency, shape }
        };
        let noise: Vec<Noise> = modes.iter().map(declared).collect();
        let tests: Vec<_> = loaded
            .job
            .test
            .file
            .iter()
            .chain(&loaded.job.test.repeats)
            .map(|file| file.display())
            .collect();
        let test = loaded.measured(&modes)?;
        let names = Names {
            sensors: loaded.placed.iter().map(|own| own.name.clone()).collect(),
            modes,
            file: some(&tests),
        };
        Ok(preflight_at_sensors(&seen, (&test, &noise), &names)?)
    }

    /// Remarks on which test modes are compared with which modes of the model.
    fn pairing_concerns(&self) -> Vec<Concern> {
        // What is unlike the first model may be like the corrected one.
        let unpaired = self.unpaired.iter();
        let mut all: Vec<Concern> = unpaired.map(|own| own.concern(Grade::Remark)).collect();
        let mut open = |name: &str, modes: Vec<usize>, words: &str| {
            all.extend((!modes.is_empty()).then_some(Concern::new(
                Grade::NotChecked,
                Check::Pairs,
                name,
                &modes,
                format!("Test modes {} {words}", some(&modes)),
            )));
        };
        let words =
            "are like several modes of the model each; they are paired by their frequencies.";
        open("undecided", numbers(self.undecided.iter().copied()), words);
        let words = "have no shapes and are paired by number, which nothing checks; the model's modes are followed by shape from there.";
        open(
            "frequencies-alone",
            numbers(self.alone().iter().map(|own| own.0)),
            words,
        );
        let close = self
            .together
            .iter()
            .filter(|group| group.len() > 1)
            .filter(|_| self.loaded.job.compare.method == Method::GaussNewton);
        all.extend(close.map(|group| {
            let modes = numbers(group.iter().map(|place| self.modes[*place]));
            let words = format!(
                "The frequencies of test modes {}, or of their partners in the first model, are no further apart than the deviations \
                 tell: their shapes are compared as one subspace.",
                some(&modes)
            );
            Concern::remark(Check::Pairs, "close-modes-", &modes, words)
        }));
        let first = self.comparison.iter().filter(|_| !self.is_without_pairs());
        all.extend(first.filter_map(|first| self.unanswered(first, None)));
        all
    }

    /// Remarks on what the test is weighted by.
    fn noise_concerns(&self) -> Vec<Concern> {
        let check = Check::Deviations;
        let open = self.compared().map(|mode| (mode, self.open_part(mode)));
        let (open, parts): (Vec<usize>, Vec<f64>) = open.filter(|own| own.1 > OPEN).unzip();
        let open = numbers(open);
        let by_digits = || {
            let words = format!(
                "The digits of the matrices leave the frequencies of test modes {} open by {:.2} % at most, which is added to their deviations.",
                some(&open),
                100.0 * parts.iter().copied().fold(0.0, f64::max)
            );
            Concern::remark(check, "open-by-digits", &open, words)
        };
        let own = self.own_weights(false);
        let mut own = own.iter().flat_map(|own| [own.frequency, own.shape]);
        let is_said = own.any(|weight| ![0.0, 1.0].contains(&weight))
            && self.loaded.job.compare.method == Method::GaussNewton;
        let by_weights = || {
            let words = "The job's weights count as dividing the standard deviations: chi-squared and intervals hold for deviations so divided.";
            Concern::remark(check, "own-weights", &NONE, words)
        };
        let tests = self.loaded.job.test.repeats.len();
        let all = [
            listed(
            check,
            "assumed-deviations",
            "Standard deviations assumed",
            &self.assumed_deviations(),
        ),
            (!open.is_empty()).then(by_digits),
            is_said.then(by_weights),
            (tests > 0).then(|| {
            Concern::remark(check, "repeats", &NONE, format!(
                "The test is the mean of {tests}; what all of them have wrong does not scatter."
            ))
        }),
        ];
        all.into_iter().flatten().collect()
    }

    /// Standard deviations that neither test nor job gives, in words.
    pub fn assumed_deviations(&self) -> Vec<String> {
        let lacks =
            |component: usize, mode: usize| self.loaded.given_deviations(mode)[component].is_none();
        let percent = |deviation: f64, what: &str| format!("{} % of {what}", 100.0 * deviation);
        let mut all = Vec::new();
        if self.compared().any(|mode| lacks(0, mode)) {
            all.push(percent(DEVIATIONS.frequency, "frequencies"));
        }
        if self.modes.iter().any(|&mode| lacks(1, mode)) {
            all.push(percent(DEVIATIONS.shape, "shapes"));
        }
        all
    }

    /// Remarks on parts of the model without a sensor, and on modes of the first model that move none.
    fn unseen_concerns(&self) -> Vec<Concern> {
        let (source, hertz) = (&self.loaded.source, self.first.unseen());
        let hertz: Vec<String> = hertz.iter().map(|hertz| format!("{hertz:.4}")).collect();
        let parts = format!(
            "In parts of the model without a sensor, which are left out, {} degrees of freedom",
            source.left_out.len()
        );
        let all = [
            listed(
                Check::Sight,
                "parts-without-sensor",
                &parts,
                &source.left_out,
            ),
            listed(
                Check::FreeMotions,
                "loose-without-sensor",
                "Mechanisms in parts of the model without a sensor, which nothing resists",
                &source.loose,
            ),
            listed(
                Check::Sight,
                "unseen-modes",
                &format!(
                    "Modes of the model that no sensor sees, and that take no part, {}, at Hz",
                    hertz.len()
                ),
                &hertz,
            ),
        ];
        all.into_iter().flatten().collect()
    }

    /// A remark on the modes of a model between the first and the last frequency of the test that no test mode answers: the test may have
    /// missed them. Their frequencies have deviations by the covariance of the factors' logarithms, where that is known.
    pub(super) fn unanswered(
        &self,
        model: &Comparison,
        covariance: Option<&DMatrix<f64>>,
    ) -> Option<Concern> {
        let modes = &model.model.exact.modes;
        let (hertz, seen) = (modes.frequencies_hz(), visibilities(&modes.shapes));
        let (first, last) = self
            .compared()
            .map(|mode| self.loaded.data.frequencies_hz[mode])
            .fold((f64::INFINITY, 0.0_f64), |(first, last), hertz| {
                (first.min(hertz), last.max(hertz))
            });
        let partners = model.partners();
        let is_lacking =
            |mode: &usize| (first..=last).contains(&hertz[*mode]) && !partners.contains(mode);
        let deviation = |mode: usize, covariance: &DMatrix<f64>| {
            let slopes =
                model.model.couplings(&[mode])[0].row(mode) / (2.0 * modes.omega_squared[mode]);
            format!(
                " ± {:.4}",
                hertz[mode] * (&slopes * covariance).dot(&slopes).sqrt()
            )
        };
        let name = |mode: usize| {
            let deviation = covariance.map_or(String::new(), |own| deviation(mode, own));
            let (number, hertz, seen) = (mode + 1, hertz[mode], seen[mode]);
            format!("mode {number} ({hertz:.4}{deviation} Hz, {seen:.2})")
        };
        let names: Vec<String> = (0..hertz.len()).filter(is_lacking).map(name).collect();
        let words = "Modes of the model between the first and the last frequency of the test that no test mode answers, and the part of \
                     other modes' motion that sensors see of them";
        listed(Check::Pairs, "unanswered-modes", words, &names)
    }
}
