//! Frequencies that a mode of the model can have within the bounds and the priors of the parameters.

use super::{
    PreparedJob,
    concern::{Check, Concern, Grade},
    likelihood::FLOOR,
    preflight::FEWER,
};
use crate::{
    files::error::FileError,
    method::step::Bounds,
    sparse::ParameterMatrix,
    weighted::{close_modes::assurance_of_roots, comparison::Comparison},
};
use nalgebra::DMatrix;

/// Deviations of a prior, or of a measured frequency, within which all but one in sixteen thousand lie.
const FAR: f64 = 4.0;

/// Ratio of two frequencies beyond which a stiffness is wrong more than twofold, or something else is.
const FAR_APART: f64 = 1.5;

/// A test mode that is not compared, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOut {
    /// Its place in the test's file, from zero.
    pub mode: usize,
    /// Its largest modal assurance with a mode of the model.
    pub assurance: f64,
    /// The reason.
    pub why: &'static str,
}

/// Reasons for which a test mode is not compared.
pub const UNLIKE: &str = "it resembles no mode of the model";
pub const TAKEN: &str = "the mode of the model that it resembles belongs to another test mode";
const HARM: &str = "compared it makes the others worse";
const OUT_OF_REACH: &str = "no mode of the model that it resembles can have its frequency within the bounds and priors of the parameters";

impl LeftOut {
    /// The concern that says so: a remark before the steps.
    pub(super) fn concern(&self, grade: Grade) -> Concern {
        let (mode, assurance, why) = (self.mode + 1, self.assurance, self.why);
        let words = format!(
            "Test mode {mode} is not compared: {why} (modal assurance {assurance:.2} at most)."
        );
        Concern::new(grade, Check::Pairs, "not-compared-", &[mode], words)
    }
}

impl PreparedJob {
    /// Least and largest frequency (Hz) of every mode of a model for which factors within their bounds, or where there are none within
    /// four deviations of their priors, can make up by its own shape (Rayleigh's quotient):
    ///
    /// $$ \frac{\hat\omega^2}{\omega^2} = \frac{1 + \sum_e s_e (x_e/c_e - 1)}{1 + \sum_e m_e (x_e/c_e - 1)}, \qquad
    /// s_e = \frac{v^t K_e v}{\omega^2}, \quad m_e = v^t M_e v , $$
    ///
    /// at the factors $c$ with $K_e$, $M_e$ scaled by them.
    pub(super) fn reach(&self, model: &Comparison) -> Vec<Bounds> {
        let source = &self.loaded.source;
        let ranges = source.whole.ranges();
        let (exact, shares) = (&model.model.exact, &model.model.shares);
        let room = |e: usize| {
            let prior = (FAR * source.priors[e]).exp();
            let (lower, upper) = (1.0 / prior, prior);
            let range = ranges[e].unwrap_or(Bounds { lower, upper });
            // The state of an analysis has factors on what it began with; its place knows them all.
            let now = model.model.whole().map_or(1.0, |place| place.factors[e]);
            [range.lower / now - 1.0, range.upper / now - 1.0]
        };
        let hertz = exact.modes.frequencies_hz();
        let of_mode = |(mode, hertz): (usize, f64)| {
            let square = exact.modes.omega_squared[mode];
            let (mut soft, mut stiff) = ([1.0; 2], [1.0; 2]);
            for (e, share) in shares.iter().enumerate() {
                // Round-off may leave a negative part.
                let mut ends = room(e).map(|far| share.part(mode, square) * far);
                ends.sort_by(f64::total_cmp);
                let at = usize::from(matches!(share, ParameterMatrix::Mass(_)));
                soft[at] += ends[at];
                stiff[at] += ends[1 - at];
            }
            let root = |of: [f64; 2]| (of[0].max(0.0) / of[1].max(f64::MIN_POSITIVE)).sqrt();
            Bounds {
                lower: hertz * root(soft),
                upper: hertz * root(stiff),
            }
        };
        hertz.into_iter().enumerate().map(of_mode).collect()
    }

    /// Doubts about pairs of the first model that no factors can bring together, and remarks on those far apart, which a test in other
    /// units has too.
    pub(super) fn frequency_concerns(&self) -> Vec<Concern> {
        let Some(first) = &self.comparison else {
            return vec![Concern::not_checked(Check::Reach, FEWER)];
        };
        let hertz = first.model.exact.modes.frequencies_hz();
        let reach = self.reach(first);
        let concern = |(test, partner): (usize, usize)| {
            let (own, near) = (self.loaded.data.frequencies_hz[test], reach[partner]);
            let (mode, other, ratio) = (test + 1, partner + 1, own / hertz[partner]);
            if !self.is_within(near, test) {
                let words = format!(
                    "Test mode {mode} has {own} Hz, and its partner, mode {other} of the first model, can have {:.4} to {:.4} Hz within \
                     the bounds and priors of the parameters: another mode, or another unit?",
                    near.lower, near.upper
                );
                return Some(Concern::doubt(
                    Check::Reach,
                    "beyond-reach-",
                    &[mode],
                    words,
                ));
            }
            let is_far = ratio.max(1.0 / ratio) > FAR_APART;
            let words = || {
                format!(
                    "Test mode {mode} has {own} Hz, {ratio:.2} times its partner's, mode {other} of the first model, {:.4} Hz.",
                    hertz[partner]
                )
            };
            is_far.then(|| Concern::remark(Check::Reach, "far-apart-", &[mode], words()))
        };
        self.compared()
            .zip(first.partners())
            .filter_map(concern)
            .collect()
    }

    /// Selected test modes that are not compared, with their largest modal assurance with the modes of this model.
    pub(super) fn unlike(&self, model: &Comparison) -> Result<Vec<LeftOut>, FileError> {
        let (modes, reach) = (&model.model.exact.modes, self.reach(model));
        let of_mode = |mode: usize| {
            let close = assurance_of_roots(modes, &self.loaded.measured(&[mode])?.shapes)?;
            let assurance = close.max();
            let why = match self.within(&close, &[mode], &reach).max() < FLOOR {
                _ if self.refused.contains(&mode) => HARM,
                _ if assurance < FLOOR => UNLIKE,
                true => OUT_OF_REACH,
                false => TAKEN,
            };
            Ok(LeftOut {
                mode,
                assurance,
                why,
            })
        };
        self.not_compared().map(of_mode).collect()
    }

    /// Modal assurance (n × g) of test modes with modes that can have their frequencies, and zero with others; those that are compared keep
    /// all of it, whatever the steps have come to.
    pub(super) fn within(
        &self,
        assurance: &DMatrix<f64>,
        tests: &[usize],
        reach: &[Bounds],
    ) -> DMatrix<f64> {
        assurance.map_with_location(|mode, test, close| {
            let is_compared = self.modes.contains(&tests[test]);
            match is_compared || self.is_within(reach[mode], tests[test]) {
                true => close,
                false => 0.0,
            }
        })
    }

    /// True if a measured frequency (Hz) of a test mode lies within reach, but for its deviation with what digits leave open.
    pub(super) fn is_within(&self, reach: Bounds, mode: usize) -> bool {
        let noise = self.loaded.deviations(mode).frequency;
        let noise = FAR * noise.hypot(self.open_part(mode));
        let hertz = self.loaded.data.frequencies_hz[mode];
        (reach.lower * (1.0 - noise)..=reach.upper * (1.0 + noise)).contains(&hertz)
    }
}
