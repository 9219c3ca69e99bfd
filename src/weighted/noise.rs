//! Test modes with reproducible errors of measurement, and the numbers that they are drawn from.

use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::sparse::ModeWeight;
use crate::sparse::random::uniform;
use serde::Serialize;
use std::f64::consts::PI;

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
    pub const USUAL: Self = Self {
        shape: 0.01,
        frequency: 0.003,
    };
    /// One over the deviations: the weights that residuals have by them.
    pub fn weight(&self) -> ModeWeight {
        ModeWeight {
            frequency: 1.0 / self.frequency,
            shape: 1.0 / self.shape,
        }
    }
}

/// Test modes with reproducible errors of measurement:
///
/// $$ f_i (1 + \sigma_f z), \qquad V_{ij} + \sigma_v z \max_k \lvert V_{ik} \rvert $$
///
/// with the standard deviations $\sigma$ of `noise` and another standard normal variate $z$ in every place. The variates
/// are those of Box and Muller, *Annals of Mathematical Statistics* 29 (1958), 610–611, from [`split_mix_64`](crate::sparse::random::split_mix_64).
///
/// # Errors
/// Those of [`Modes::from_measured`], such as [`Error::Value`] when noise turns a frequency negative.
pub fn with_noise(exact: &Modes, noise: Noise, seed: u64) -> Result<Modes, Error> {
    with_noise_by_mode(exact, &vec![noise; exact.len()], seed)
}

/// The same with standard deviations of every mode's own, and the same variates.
///
/// # Errors
/// [`Error::WrongShape`] unless there is one `noise` a mode; those of [`with_noise`].
pub fn with_noise_by_mode(exact: &Modes, noise: &[Noise], seed: u64) -> Result<Modes, Error> {
    check_length("standard deviations", noise.len(), exact.len())?;
    let mut state = seed;
    // Above zero, so that it has a logarithm, and at most one.
    let mut above_zero = || uniform(&mut state) + 0.5_f64.powi(53);
    let mut normal = || (-2.0 * above_zero().ln()).sqrt() * (2.0 * PI * above_zero()).cos();
    let noisy = |(frequency, noise): (f64, &Noise)| frequency * (1.0 + noise.frequency * normal());
    let frequencies: Vec<f64> = exact
        .frequencies_hz()
        .into_iter()
        .zip(noise)
        .map(noisy)
        .collect();
    let mut shapes = exact.shapes.clone();
    for (mut shape, noise) in shapes.column_iter_mut().zip(noise) {
        let deviation = noise.shape * shape.amax();
        shape.apply(|component| *component += deviation * normal());
    }
    Modes::from_measured(&frequencies, &shapes)
}
