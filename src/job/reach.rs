//! Frequencies that a mode of the model can have within the bounds and the priors of the parameters.

use super::{
    PreparedJob,
    concern::{Check, Concern, Grade},
    pairs::FLOOR,
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
pub const UNLIKE: &str = "it resembles no mode of the model that can have its frequency";
pub const TAKEN: &str = "the mode of the model that it resembles belongs to another test mode";
const HARM: &str = "compared it makes the others worse";

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
        let (ranges, exact) = (source.whole.ranges(), &model.model.exact.modes);
        let of_mode = |(mode, hertz): (usize, f64)| {
            // Least and most of a stiffness and of a mass.
            let mut ends = [[1.0; 2]; 2];
            for (e, share) in model.model.shares.iter().enumerate() {
                let prior = (FAR * source.priors[e]).exp();
                let range = ranges[e].unwrap_or(Bounds {
                    lower: 1.0 / prior,
                    upper: prior,
                });
                // The state of an analysis has factors on what it began with; its place knows them all.
                let now = model.model.whole().map_or(1.0, |place| place.factors[e]);
                // Round-off may leave a negative part.
                let is_mass = matches!(share, ParameterMatrix::Mass(_));
                let part = model.model.moves[(mode, e)] * if is_mass { -1.0 } else { 1.0 };
                let part = part.max(0.0);
                let [least, most] = &mut ends[usize::from(is_mass)];
                *least += part * (range.lower / now - 1.0);
                *most += part * (range.upper / now - 1.0);
            }
            let [stiffness, mass] = ends;
            let root = |stiffness: f64, mass: f64| {
                (stiffness.max(0.0) / mass.max(f64::MIN_POSITIVE)).sqrt()
            };
            Bounds {
                lower: hertz * root(stiffness[0], mass[1]),
                upper: hertz * root(stiffness[1], mass[0]),
            }
        };
        exact
            .frequencies_hz()
            .into_iter()
            .enumerate()
            .map(of_mode)
            .collect()
    }

    /// Doubts about pairs of the first model that no factors can bring together.
    pub(super) fn frequency_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let first = self.analyze(&self.loaded.ones())?;
        let (reach, hertz) = (self.reach(&first), &self.loaded.data.frequencies_hz);
        let both = self.compared().zip(first.partners());
        let beyond = both.filter(|(test, partner)| !self.is_within(reach[*partner], *test));
        let concern = |(test, partner): (usize, usize)| {
            let (mode, own, near) = (test + 1, hertz[test], reach[partner]);
            let words = format!(
                "Test mode {mode} has {own} Hz, and its partner, mode {} of the first model, can have {:.4} to {:.4} Hz within the bounds \
                 and priors of the parameters: another mode, or another unit?",
                partner + 1,
                near.lower,
                near.upper
            );
            Concern::doubt(Check::Reach, "beyond-reach-", &[mode], words)
        };
        Ok(beyond.map(concern).collect())
    }

    /// Selected test modes that are not compared, with their largest modal assurance with the modes of this model.
    pub(super) fn unlike(&self, model: &Comparison) -> Result<Vec<LeftOut>, FileError> {
        let (modes, reach) = (&model.model.exact.modes, self.reach(model));
        let of_mode = |mode: usize| {
            let close = assurance_of_roots(modes, &self.loaded.measured(&[mode])?.shapes)?;
            let assurance = close.max();
            let why = match self.within(&close, &[mode], &reach).max() {
                _ if self.refused.contains(&mode) => HARM,
                likely if likely < FLOOR => UNLIKE,
                _ => TAKEN,
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
            if is_compared || self.is_within(reach[mode], tests[test]) {
                close
            } else {
                0.0
            }
        })
    }

    /// True if a measured frequency (Hz) of a test mode lies within reach, but for its deviation with what digits leave open.
    pub(super) fn is_within(&self, reach: Bounds, mode: usize) -> bool {
        let noise = FAR * self.noise(mode).frequency;
        let hertz = self.loaded.data.frequencies_hz[mode];
        (reach.lower * (1.0 - noise)..=reach.upper * (1.0 + noise)).contains(&hertz)
    }
}
