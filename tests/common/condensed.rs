//! The paper's condensation of a whole model to its sensors, which no job compares any more.

use crate::prelude::*;
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
) -> Result<ModalModel, Error> {
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
