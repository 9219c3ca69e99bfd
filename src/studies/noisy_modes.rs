//! Appendix B in use: the box's test modes with reproducible errors of measurement, correlated as they are and after Appendix B.
//! What is wrong with the gages each time says what its steps are worth.

use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::cases::fit::rms;
use crate::cases::torque_box::{PANEL_COUNT, TEST_GAGE, dynamic_points, gage_rms};
use crate::method::appendix_b::{
    Examination, MeasuringPoint, Motion, MovementLimits, Supports, balance, examine, rigid_body_vectors,
};
use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::model::FiniteElementModel;
use crate::method::modes::ModeSet;
use crate::method::outer_loop::correlate;
use crate::method::step::StepRule;
use crate::method::structure::ElementKind;
use nalgebra::Vector3;
use serde::Serialize;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// The case whose test modes get noise.
pub const NOISY_CASE: usize = 2;
/// Seeds of the noise, one run each.
pub const SEEDS: RangeInclusive<u64> = 1..=20;
/// Limits that no mode exceeds, to balance and orthogonalize without deleting.
const NO_LIMITS: MovementLimits = MovementLimits { balance: 0.999, frequency: f64::MAX, shape: f64::MAX };
/// Rigid-body motions that points which move along z can show.
const MOTIONS: [Motion; 3] = [Motion::Plunge, Motion::Roll, Motion::Pitch];

/// Standard deviations of the errors of a measurement, as fractions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Noise {
    /// Of every component of a shape, relative to the shape's largest.
    pub shape: f64,
    /// Of a frequency, relative to it.
    pub frequency: f64,
}

impl Noise {
    /// A good test: 1 % of shape and 0.3 % of frequency.
    pub const USUAL: Self = Self { shape: 0.01, frequency: 0.003 };
    /// A perfect one.
    pub const NONE: Self = Self { shape: 0.0, frequency: 0.0 };
}

/// What a correlation with some test modes leads to; errors are fractions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// Whether the last pass met the case's tolerances beside the modes given.
    pub converged: bool,
    /// Iterations of all passes.
    pub iterations: usize,
    /// Gages of the best pass, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// RMS gage error of the shear panels.
    pub shear_gage_rms: f64,
    /// RMS gage error of the membranes.
    pub membrane_gage_rms: f64,
    /// RMS gage error of all panels.
    pub gage_rms: f64,
    /// Error sum at these gages beside the modes given.
    pub error_sum: f64,
    /// RMS frequency error at these gages beside the modes without noise.
    pub true_frequency_rms: f64,
    /// RMS shape error at these gages beside the modes without noise.
    pub true_shape_rms: f64,
}

/// The correlations with the test modes of one seed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoisyRun {
    /// The seed; none for modes without noise.
    pub seed: Option<u64>,
    /// Which modes the limits kept, from zero.
    pub kept: Vec<usize>,
    /// With the modes as they are.
    pub raw: Found,
    /// With all modes balanced where that applies, and orthogonal.
    pub orthogonal: Found,
    /// With the modes kept, balanced where that applies, and orthogonal.
    pub screened: Found,
}

/// The study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoisyModes {
    /// Case number.
    pub case: usize,
    /// The noise.
    pub noise: Noise,
    /// Why the modes are not balanced: the stiffness against rigid-body motion relative to $\omega^2$ times its mass, above
    /// [`crate::method::appendix_b::LARGEST_SUSPENSION_RATIO`]. None when they are.
    pub support_ratio: Option<f64>,
    /// Without noise, then one run for every seed.
    pub runs: Vec<NoisyRun>,
}

/// Correlates a case with noisy test modes, raw, orthogonal, and screened by the usual limits of Appendix B, for every
/// seed and once without noise.
///
/// Whether the modes are to be balanced is asked of [`balance`], with the first model: a structure that it refuses as
/// supported is held. Settings are the case's own, the step by the library's own rule, which finds the gages where the
/// reading of the case leaves some behind.
///
/// # Errors
/// Those of the model, of Appendix B and of the loops.
pub fn noisy_modes(case: &Case, noise: Noise, seeds: RangeInclusive<u64>) -> Result<NoisyModes, CaseError> {
    let model = case.model()?;
    let exact = ModeSet::from(case.test_modes()?);
    let first = model.matrices(&vec![1.0; model.parameters().len()])?;
    let point = |position| MeasuringPoint { position, direction: Vector3::z_axis() };
    let points: Vec<_> = dynamic_points(&case.reconstruction)?.into_iter().map(point).collect();
    let rigid_body = &rigid_body_vectors(&MOTIONS, &points)?;
    let (supports, support_ratio) = match balance(&exact, &first.stiffness, &first.mass, rigid_body) {
        Ok(_) => (Supports::Free { stiffness: &first.stiffness, rigid_body }, None),
        Err(Error::Supported { ratio, .. }) => (Supports::Held, Some(ratio)),
        Err(error) => return Err(error.into()),
    };
    let found = |test: &ModeSet| correlated(case, &model, &exact, test);
    let run = |(seed, noise): (Option<u64>, Noise)| {
        let raw = with_noise(&exact, noise, seed.unwrap_or_default())?;
        let orthogonal = examine(&raw, &first.mass, supports, &NO_LIMITS)?.modes;
        let Examination { modes, kept, .. } = examine(&raw, &first.mass, supports, &MovementLimits::default())?;
        Ok(NoisyRun { seed, kept, raw: found(&raw)?, orthogonal: found(&orthogonal)?, screened: found(&modes)? })
    };
    let all = std::iter::once((None, Noise::NONE)).chain(seeds.map(|seed| (Some(seed), noise)));
    Ok(NoisyModes { case: case.number, noise, support_ratio, runs: all.map(run).collect::<Result<_, CaseError>>()? })
}

fn correlated(case: &Case, model: &FiniteElementModel, exact: &ModeSet, test: &ModeSet) -> Result<Found, CaseError> {
    let ranges = model.factor_ranges()?;
    let settings = case.settings_by(StepRule::default());
    let correlation = correlate(|factors| model.analyze(factors, test, None), &ranges, &settings, |_, _| {})?;
    let factors = correlation.best_factors.clone();
    let gages = model.sizes(&factors)?[..PANEL_COUNT].to_vec();
    let truth = model.analyze(&factors, exact, None)?.exact.errors;
    let errors: Vec<f64> = gages.iter().map(|gage| gage / TEST_GAGE - 1.0).collect();
    Ok(Found {
        converged: correlation.converged,
        iterations: correlation.passes.iter().map(|pass| pass.inner.iterations.len()).sum(),
        shear_gage_rms: gage_rms(&case.panels, &gages, ElementKind::ShearPanel),
        membrane_gage_rms: gage_rms(&case.panels, &gages, ElementKind::Membrane),
        gage_rms: rms(&errors),
        error_sum: model.analyze(&factors, test, None)?.exact.errors.sum(),
        true_frequency_rms: truth.frequency_rms(),
        true_shape_rms: truth.shape_rms(),
        gages_in: gages,
    })
}

/// Test modes with reproducible errors of measurement:
///
/// $$ f_i (1 + \sigma_f z), \qquad V_{ij} + \sigma_v z \max_k \lvert V_{ik} \rvert $$
///
/// with the standard deviations $\sigma$ of `noise` and another standard normal variate $z$ in every place. The variates
/// are those of Box and Muller, *Annals of Mathematical Statistics* 29 (1958), 610–611, from [`split_mix_64`].
///
/// # Errors
/// Those of [`ModeSet::from_measured`], such as [`Error::NotPositive`] when noise turns a frequency negative.
pub fn with_noise(exact: &ModeSet, noise: Noise, seed: u64) -> Result<ModeSet, Error> {
    with_noise_by_mode(exact, &vec![noise; exact.len()], seed)
}

/// The same with standard deviations of every mode's own, and the same variates.
///
/// # Errors
/// [`Error::WrongShape`] unless there is one `noise` a mode; those of [`with_noise`].
pub fn with_noise_by_mode(exact: &ModeSet, noise: &[Noise], seed: u64) -> Result<ModeSet, Error> {
    check_length("standard deviations", noise.len(), exact.len())?;
    let mut state = seed;
    // Above zero, so that it has a logarithm, and at most one.
    let mut above_zero = || uniform(&mut state) + 0.5_f64.powi(53);
    let mut normal = || (-2.0 * above_zero().ln()).sqrt() * (2.0 * PI * above_zero()).cos();
    let noisy = |(frequency, noise): (f64, &Noise)| frequency * (1.0 + noise.frequency * normal());
    let frequencies: Vec<f64> = exact.frequencies_hz().into_iter().zip(noise).map(noisy).collect();
    let mut shapes = exact.shapes.clone();
    for (mut shape, noise) in shapes.column_iter_mut().zip(noise) {
        let deviation = noise.shape * shape.amax();
        shape.apply(|component| *component += deviation * normal());
    }
    ModeSet::from_measured(&frequencies, &shapes)
}

/// The next number from zero up to one: of [`split_mix_64`] the 53 bits that a number holds.
pub fn uniform(state: &mut u64) -> f64 {
    (split_mix_64(state) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The next number of the generator SplitMix64, from its state, which moves on: Steele, Lea and Flood, "Fast Splittable
/// Pseudorandom Number Generators", *OOPSLA* 2014, 453–472, with the constants of Vigna's public-domain `splitmix64.c`.
pub fn split_mix_64(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
