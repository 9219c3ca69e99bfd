//! The paper's condensation of a whole model to its sensors, which no job compares any more, and what it costs: the condensed modes beside
//! those of the whole model.

use crate::prelude::*;

/// Largest part by which condensation may raise a frequency that is compared, twice the loop's own tolerance on frequencies: beyond it
/// the correlation would correct elements for what the choice of measuring points did.
pub const LARGEST_CONDENSATION_ERROR: f64 = 0.01;
/// Motion at the sensors relative to that of the mode that moves them most below which a mode is not seen.
const UNSEEN: f64 = 1e-9;

/// How a condensed mode differs from the whole model's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CondensationError {
    /// The whole model's frequency, Hz.
    pub whole_hz: f64,
    /// How much higher the condensed frequency is, a fraction.
    pub frequency: f64,
    /// One minus the modal assurance criterion of the two shapes at the sensors.
    pub shape: f64,
}

/// The `count` lowest modes that move a sensor, with their shapes there (sensors × count).
///
/// # Errors
/// Those of [`WholeModel::modes`]; [`Error::Count`] when fewer move a sensor.
pub fn seen_modes(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    count: usize,
) -> Result<Modes, Error> {
    let mut wanted = count;
    loop {
        let (modes, is_all) = match model.modes(factors, wanted) {
            Err(Error::Count {
                most: available, ..
            }) if available > 0 => (model.modes(factors, available)?, true),
            found => (found?, false),
        };
        let squares = modes.vibrations.omega_squared();
        let shapes = sensors.times(modes.vibrations.shapes())?;
        let most = shapes.amax();
        let seen = (0..squares.len()).filter(|&mode| shapes.column(mode).amax() > UNSEEN * most);
        let seen = seen.take(count).collect_vec();
        if seen.len() == count {
            return Modes::new(squares.select_rows(&seen), shapes.select_columns(&seen));
        }
        if is_all {
            return Err(Error::Count {
                what: "modes that move a sensor",
                found: count,
                least: 1,
                most: seen.len(),
            });
        }
        wanted *= 2;
    }
}

/// A whole model condensed to the sensors with one $B^t$ (Appendix A), and its mass there, $B M B^t$.
///
/// # Errors
/// Those of [`WholeModel::at`] and [`condense`].
pub fn condensed(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
) -> Result<(Condensed, DMatrix<f64>), Error> {
    let (stiffness, mass) = model.at(factors)?;
    let condensed = condense(&stiffness.dense(), &sensors.dense().transpose())?;
    let mass = mass.through(&condensed.transformation.transpose())?;
    Ok((condensed, mass))
}

/// What condensation to the sensors does to each of the lowest `count` modes, each compared with the whole model's mode of its shape.
///
/// # Errors
/// Those of [`condensed`], [`seen_modes`] and [`solve`].
pub fn condensation_errors(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    count: usize,
) -> Result<Vec<CondensationError>, Error> {
    let (condensed, mass) = condensed(model, factors, sensors)?;
    let condensed = solve(&condensed.stiffness, &mass, count)?;
    let whole = seen_modes(model, factors, sensors, count)?;
    let assurance = modal_assurance(whole.shapes(), condensed.shapes())?;
    let (whole_hz, pairing) = (whole.frequencies_hz(), pair_modes(&assurance)?);
    let error = |(mode, condensed_hz): (usize, f64)| {
        let partner = pairing.analysis_mode[mode];
        CondensationError {
            whole_hz: whole_hz[partner],
            frequency: condensed_hz / whole_hz[partner] - 1.0,
            shape: 1.0 - assurance[(partner, mode)],
        }
    };
    let all = condensed.frequencies_hz().into_iter().enumerate();
    Ok(all.map(error).collect())
}

/// The paper's way to the same as [`WholeModel::analyze`]: modes of the condensed matrices, all of them or the lowest `count`.
///
/// # Errors
/// Those of [`condensed`] and [`DynamicModel::analyze`].
pub fn analyze_condensed(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    test: &Modes,
    count: Option<usize>,
) -> Result<Model, Error> {
    let (condensed, mass) = condensed(model, factors, sensors)?;
    let b = condensed.transformation.transpose();
    let share = |(parameter, &factor): (&WholeParameter, &f64)| {
        Ok(match &parameter.share {
            WholeShare::Stiffness(matrix) => factor * matrix.through(&b)?,
            WholeShare::Mass(_) => unreachable!("the paper's model has no parameter of mass"),
        })
    };
    let shares = model.parameters().iter().zip(factors).map(share);
    let condensed = DynamicModel {
        stiffness: condensed.stiffness,
        mass,
        shares: shares.collect::<Result<_, Error>>()?,
    };
    condensed.analyze(test, count)
}
