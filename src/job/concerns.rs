//! Doubts about a job before its first step, and remarks.

use super::{
    Method, PreparedJob,
    bodies::of_bodies,
    concern::{Check, Concern, Grade, NONE, Trust, listed, numbers, some},
    preflight::{SeenModes, measured_once, preflight_at_sensors},
};
use crate::{
    files::error::FileError,
    method::modes::Modes,
    sparse::visibility::visibilities,
    weighted::{comparison::Comparison, noise::Noise, residuals::DEVIATIONS},
};

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
        let is_doubted = all.iter().any(Concern::stands);
        if prepared.is_without_pairs() && !is_doubted {
            let words = "No test mode resembles a mode of the model: another structure, other sensors, or several mistakes at once?";
            all.push(Concern::doubt(Check::Pairs, "no-pair", &NONE, words));
        }
        // A mistake in the readings or in all frequencies says more than each pair that it makes.
        if is_doubted || prepared.is_without_pairs() {
            let reason = "another doubt is answered first";
            all.push(Concern::not_checked(Check::Reach, reason));
        } else {
            all.extend(prepared.frequency_concerns()?);
        }
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
        let found = source
            .whole
            .body_findings(|row| source.row_name(row), lowest.first().copied())?;
        let is_said = self.loaded.job.model.rigid_bodies.unwrap_or(0) > 0;
        let said = is_said.then(|| {
            Concern::not_checked(
                Check::FreeMotions,
                "model.rigid_bodies says how many there are",
            )
        });
        Ok(found.iter().map(of_bodies).chain(said).collect())
    }

    /// What the pre-flight finds in all modes of the test.
    fn reading_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (loaded, rules) = (&self.loaded, &self.loaded.job.test);
        let mut modes = loaded.shaped();
        modes.sort_unstable();
        if modes.is_empty() {
            let reason = "the test has no shapes";
            return Ok(vec![Concern::not_checked(Check::Readings, reason)]);
        }
        // Assumed deviations are no less than a test's own, and declare none.
        let declared = |&mode: &usize| {
            let [frequency, shape] = loaded.given_deviations(mode).map(Option::unwrap_or_default);
            Noise { frequency, shape }
        };
        let noise = |modes: &[usize]| modes.iter().map(declared).collect::<Vec<_>>();
        let test = loaded.measured(&modes)?;
        let (once, mut all) =
            measured_once((&test, &noise(&modes)), &numbers(modes.iter().copied()))?;
        let once: Vec<usize> = once.into_iter().map(|place| modes[place]).collect();
        let whole = self.first.shapes(2 * loaded.usual_modes());
        let seen = SeenModes {
            shares: self.first.shares_of(whole.len()),
            modes: Modes::new(whole.omega_squared, loaded.sensors.times(&whole.shapes)?)?,
        };
        let tests = rules.file.iter().chain(&rules.repeats);
        let sensors: Vec<String> = loaded.placed.iter().map(|own| own.name.clone()).collect();
        let file = some(&tests.map(|file| file.display()).collect::<Vec<_>>());
        let test = loaded.measured(&once)?;
        all.extend(preflight_at_sensors(
            &seen,
            (&test, &noise(&once)),
            (&sensors, &file),
        )?);
        Ok(all)
    }

    /// Remarks on which test modes are compared with which modes of the model.
    fn pairing_concerns(&self) -> Vec<Concern> {
        let check = Check::Pairs;
        // What is unlike the first model may be like the corrected one.
        let unpaired = self.unpaired.iter();
        let mut all: Vec<Concern> = unpaired.map(|own| own.concern(Grade::Remark)).collect();
        let alone = numbers(self.loaded.alone.iter().map(|own| own.0));
        let words = "Test modes without shapes, paired by number, which nothing checks; their partners are followed by shape from there";
        let open = listed(check, "frequencies-alone", words, &alone);
        let grade = Grade::NotChecked;
        all.extend(open.map(|own| Concern { grade, ..own }));
        for group in self.together.iter().filter(|group| group.len() > 1) {
            let modes = numbers(group.iter().map(|place| self.modes[*place]));
            let words = format!(
                "The frequencies of test modes {}, or of their partners in the first model, are no further apart than the deviations \
                 tell: their shapes are compared as one subspace.",
                some(&modes)
            );
            all.push(Concern::remark(check, "close-modes-", &modes, words));
        }
        if !self.is_without_pairs() {
            all.extend(
                self.comparison
                    .iter()
                    .filter_map(|first| self.unanswered(first)),
            );
        }
        all
    }

    /// Remarks on what the test is weighted by.
    fn noise_concerns(&self) -> Vec<Concern> {
        let (check, compare) = (Check::Deviations, &self.loaded.job.compare);
        let lacks =
            |component: usize, mode: usize| self.loaded.given_deviations(mode)[component].is_none();
        let mut assumed = Vec::new();
        if self.compared().any(|mode| lacks(0, mode)) {
            assumed.push(format!("{} % of frequencies", 100.0 * DEVIATIONS.frequency));
        }
        if self.modes.iter().any(|&mode| lacks(1, mode)) {
            assumed.push(format!("{} % of shapes", 100.0 * DEVIATIONS.shape));
        }
        let words = "Standard deviations assumed";
        let mut all = Vec::from_iter(listed(check, "assumed-deviations", words, &assumed));
        let open = self.compared().map(|mode| (mode, self.open_part(mode)));
        let (open, parts): (Vec<usize>, Vec<f64>) = open.filter(|own| own.1 > OPEN).unzip();
        let words = format!(
            "The digits of the matrices leave frequencies open by {:.2} % at most, which is added to their deviations, of test modes",
            100.0 * parts.into_iter().fold(0.0, f64::max)
        );
        all.extend(listed(check, "open-by-digits", &words, &numbers(open)));
        let is_weighted = compare.frequency_weights.is_some() || compare.shape_weights.is_some();
        if is_weighted && compare.method == Method::GaussNewton {
            let words = "The job's weights count as dividing the standard deviations: chi-squared and intervals hold for deviations so divided.";
            all.push(Concern::remark(check, "own-weights", &NONE, words));
        }
        all
    }

    /// Remarks on parts of the model without a sensor, and on modes of the first model that move none.
    fn unseen_concerns(&self) -> impl Iterator<Item = Concern> {
        let hertz = self.first.unseen();
        let hertz: Vec<String> = hertz.iter().map(|hertz| format!("{hertz:.4}")).collect();
        let parts = listed(
            Check::Sight,
            "parts-without-sensor",
            "Degrees of freedom in parts of the model without a sensor, which are left out",
            &self.loaded.source.left_out,
        );
        let modes = listed(
            Check::Sight,
            "unseen-modes",
            "Modes of the model that no sensor sees, and that take no part, at Hz",
            &hertz,
        );
        parts.into_iter().chain(modes)
    }

    /// A remark on the modes of a model between the first and the last frequency of the test that no test mode answers: the test may have
    /// missed them.
    pub(super) fn unanswered(&self, model: &Comparison) -> Option<Concern> {
        let (modes, partners) = (&model.model.exact.modes, model.partners());
        let (hertz, seen) = (modes.frequencies_hz(), visibilities(&modes.shapes));
        let tests = self
            .compared()
            .map(|mode| self.loaded.data.frequencies_hz[mode]);
        let tests: Vec<f64> = tests.collect();
        let first = tests.iter().copied().fold(f64::INFINITY, f64::min);
        let last = tests.into_iter().fold(0.0, f64::max);
        let is_lacking =
            |mode: &usize| (first..=last).contains(&hertz[*mode]) && !partners.contains(mode);
        let name = |mode: usize| {
            format!(
                "mode {} ({:.4} Hz, {:.2})",
                mode + 1,
                hertz[mode],
                seen[mode]
            )
        };
        let names: Vec<String> = (0..hertz.len()).filter(is_lacking).map(name).collect();
        let words = "Modes of the model between the first and the last frequency of the test that no test mode answers, and the part of \
                     other modes' motion that sensors see of them";
        listed(Check::Pairs, "unanswered-modes", words, &names)
    }
}
