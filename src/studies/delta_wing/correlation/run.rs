//! The wing's correlation from its wrong gages to its last exact check.

use super::{GROUPS, Group, first_model, settings, test_modes};
use crate::cases::BUILT_IN;
use crate::method::error::Error;
use crate::method::model::{FiniteElementModel, ModalModel};
use crate::method::modes::ModeSet;
use crate::method::outer_loop::{Correlation, Pass, Settings, correlate};
use crate::studies::delta_wing::DeltaWing;

/// What became of one group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recovered {
    /// The group.
    pub group: Group,
    /// The factor found on its first gage.
    pub factor: f64,
    /// What the test modes can see of it: its largest share of a test mode's generalized stiffness in the first model,
    /// $\max_i V_{Gi}^t K_e V_{Gi}/\omega_{Gi}^2$.
    pub share: f64,
}

impl Recovered {
    /// The factor that makes the model right.
    pub fn true_factor(&self) -> f64 {
        1.0 / self.group.first_over_true
    }

    /// Relative error of the gage found, a fraction.
    pub fn error(&self) -> f64 {
        self.factor / self.true_factor() - 1.0
    }

    /// Relative error of the first gage, a fraction.
    pub fn first_error(&self) -> f64 {
        self.group.first_over_true - 1.0
    }
}

/// The scenario run to its end.
#[derive(Debug, Clone)]
pub struct WingCorrelation {
    /// What did the finite element analyses of the model: [`BUILT_IN`] or another program.
    pub solver: &'static str,
    /// The test modes.
    pub test: ModeSet,
    /// The whole history.
    pub correlation: Correlation,
    /// Every group, in the order of [`GROUPS`], with the factors of the best pass.
    pub groups: Vec<Recovered>,
}

/// Corrects the model of wrong gages; `progress` is told of every pass.
///
/// # Errors
/// Those of [`first_model`], [`test_modes`], the analysis and the loops.
pub fn correlate_wing(wing: &DeltaWing, progress: impl FnMut(usize, &Pass)) -> Result<WingCorrelation, Error> {
    correlate_wing_with(wing, &settings(), BUILT_IN, |model, _| Ok(model.clone()), progress)
}

/// Corrects the model of wrong gages by given settings, with another finite element analysis than the crate's own: `solver` is its name
/// for the report, `elements` is given the model and the factors on its 21 parameters, and returns the model with that
/// program's element stiffness.
///
/// The test modes stay those of [`test_modes`], by the crate's own elements at all 86 DOF: they play the test, and a
/// test knows nothing of the program that analyzes the model.
///
/// # Errors
/// Those of `elements` and of [`correlate_wing`].
pub fn correlate_wing_with<E: From<Error>>(
    wing: &DeltaWing,
    settings: &Settings,
    solver: &'static str,
    mut elements: impl FnMut(&FiniteElementModel, &[f64]) -> Result<FiniteElementModel, E>,
    progress: impl FnMut(usize, &Pass),
) -> Result<WingCorrelation, E> {
    let model = first_model(wing)?;
    let test = test_modes(wing)?;
    let mut analyze =
        |factors: &[f64]| -> Result<ModalModel, E> { Ok(elements(&model, factors)?.analyze(factors, &test, None)?) };
    let shares = analyze(&[1.0; GROUPS.len()])?.test_shares;
    let correlation = correlate(analyze, &model.factor_ranges()?, settings, progress)?;
    let factors = correlation.best_factors();
    let found = GROUPS.iter().zip(factors).zip(shares);
    let groups =
        found.map(|((group, factor), share)| Recovered { group: *group, factor, share: share.diagonal().max() });
    Ok(WingCorrelation { solver, groups: groups.collect(), test, correlation })
}
