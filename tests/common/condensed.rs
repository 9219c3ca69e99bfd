//! The paper's condensation of a whole model to its sensors, which no job compares any more, and what it costs: the condensed modes beside
//! those of the whole model.

use corfem::method::error::Error;
use corfem::method::model::{DynamicModel, ModalModel, ParameterMatrix};
use corfem::method::modes::{ModeSet, solve};
use corfem::method::pairing::{modal_assurance, pair_modes};
use corfem::sparse::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use nalgebra::DMatrix;

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
/// Those of [`WholeModel::modes`]; [`Error::TooMany`] when fewer move a sensor.
pub fn seen_modes(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    count: usize,
) -> Result<ModeSet, Error> {
    let mut wanted = count;
    loop {
        let (modes, is_all) = match model.modes(factors, wanted) {
            Err(Error::TooMany { available, .. }) if available > 0 => {
                (model.modes(factors, available)?, true)
            }
            found => (found?, false),
        };
        let (squares, shapes) = modes.vibrations.into_parts();
        let shapes = sensors.times(&shapes)?;
        let most = shapes.amax();
        let seen = (0..squares.len()).filter(|&mode| shapes.column(mode).amax() > UNSEEN * most);
        let seen: Vec<usize> = seen.take(count).collect();
        if seen.len() == count {
            return ModeSet::new(squares.select_rows(&seen), shapes.select_columns(&seen));
        }
        if is_all {
            return Err(Error::TooMany {
                what: "modes that move a sensor",
                available: seen.len(),
                requested: count,
            });
        }
        wanted *= 2;
    }
}

/// What condensation to the sensors does to each of the lowest `count` modes, each compared with the whole model's mode of its shape.
///
/// # Errors
/// Those of [`WholeModel::condensed`], [`seen_modes`] and [`solve`].
pub fn condensation_errors(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    count: usize,
) -> Result<Vec<CondensationError>, Error> {
    let (condensed, mass) = model.condensed(factors, sensors)?;
    let condensed = solve(&condensed.stiffness, &mass, count)?;
    let whole = seen_modes(model, factors, sensors, count)?;
    let assurance = modal_assurance(whole.shapes(), condensed.shapes())?;
    let (whole_hz, pairing) = (whole.frequencies_hz(), pair_modes(&assurance)?);
    let error = |(mode, condensed_hz): (usize, f64)| {
        let partner = pairing.analysis_mode()[mode];
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
/// Those of [`WholeModel::condensed`] and [`DynamicModel::analyze`].
pub fn analyze_condensed(
    model: &WholeModel,
    factors: &[f64],
    sensors: &SparseMatrix,
    test: &ModeSet,
    count: Option<usize>,
) -> Result<ModalModel, Error> {
    let (condensed, mass) = model.condensed(factors, sensors)?;
    let b = condensed.transformation.transpose();
    let share = |(parameter, &factor): (&WholeParameter, &f64)| {
        Ok(match &parameter.share {
            WholeShare::Stiffness(matrix) => {
                ParameterMatrix::Stiffness(factor * matrix.through(&b)?)
            }
            WholeShare::Mass(matrix) => ParameterMatrix::Mass(factor * matrix.through(&b)?),
            WholeShare::Elements(members) => {
                let of_element = members.iter().map(|(element, size)| {
                    let own = b.select_columns(element.dof());
                    factor * *size * &own * element.matrix().unit * own.transpose()
                });
                let none = DMatrix::zeros(b.nrows(), b.nrows());
                ParameterMatrix::Stiffness(of_element.fold(none, |sum, share| sum + share))
            }
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
