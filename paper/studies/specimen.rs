//! Structures before their correlation, whose tests measure at every dynamic DOF.

use crate::prelude::*;

/// A structure before its correlation, without mistakes.
#[derive(Debug, Clone)]
pub struct Specimen {
    /// What it is.
    pub name: String,
    /// The first model.
    pub model: DynamicModel,
    /// Its test, without noise.
    pub test: Modes,
}

impl Specimen {
    /// A case of the paper, whose condensation is exact: all its mass is at the dynamic points.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        let (model, test) = (Weighed(case.model()?), case.test_modes()?);
        let name = format!("Case {}", case.number);
        Ok(Self::of(&name, &model, test)?)
    }

    /// The delta wing with its wrong gages, and ten modes at 19 points.
    ///
    /// # Errors
    /// Those of the wing and of its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let wing = DeltaWing::embedded();
        let (model, test) = (
            correlation::first_model(&wing)?,
            correlation::test_modes(&wing)?,
        );
        Ok(Self::of("Delta wing", &model, test)?)
    }

    fn of(name: &str, model: &Weighed, test: Modes) -> Result<Self, Error> {
        Ok(Self {
            name: name.to_owned(),
            model: model.matrices(&vec![1.0; model.factor_ranges()?.len()])?,
            test,
        })
    }

    /// What a job's pre-flight finds with a sensor at every dynamic DOF.
    ///
    /// # Errors
    /// Those of [`solve`] and [`preflight_at_sensors`].
    pub fn findings(&self) -> Result<Vec<Concern>, Error> {
        let DynamicModel {
            stiffness,
            mass,
            shares,
        } = &self.model;
        let modes = solve(stiffness, mass, mass.nrows())?;
        let shapes = modes.shapes();
        let seen_share = |share| ParameterMatrix::Stiffness(shapes.tr_mul(&(share * shapes)));
        let seen = SeenModes {
            shares: shares.iter().map(seen_share).collect(),
            modes,
        };
        preflight_at_sensors(&seen, (&self.test, &[]), &Names::default())
    }
}
