//! Structures before their correlation.

use crate::common::known::Known;
use crate::common::known::delta_wing::correlation;
use corfem::job::preflight::{Finding, preflight};
use corfem::method::error::Error;
use corfem::method::model::{Bounds, DynamicModel};
use corfem::method::modes::ModeSet;
use corfem::method::outer_loop::Settings;
use corfem::sparse::LargeModel;
use corfem::torque_box::Case;
use corfem::torque_box::error::CaseError;

/// A structure before its correlation, without mistakes.
#[derive(Debug, Clone)]
pub struct Specimen {
    /// What it is.
    pub name: String,
    /// The first model.
    pub model: DynamicModel,
    /// Its test, without noise.
    pub test: ModeSet,
    /// How it is correlated.
    pub settings: Settings,
    /// Bounds on its parameters' factors.
    pub ranges: Vec<Option<Bounds>>,
}

impl Specimen {
    /// A case of the paper, whose condensation is exact: all its mass is at the dynamic points.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        let (model, test) = (case.model()?, case.test_modes()?.into());
        Self::of(
            &format!("Case {}", case.number),
            &LargeModel::of(&model)?,
            test,
            case.settings.clone(),
        )
    }

    /// The delta wing with its wrong gages, and ten modes at 19 points.
    ///
    /// # Errors
    /// Those of the wing and of its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let Known {
            name, model, test, ..
        } = Known::delta_wing()?;
        Self::of(&name, &model, test, correlation::settings())
    }

    fn of(
        name: &str,
        model: &LargeModel,
        test: ModeSet,
        settings: Settings,
    ) -> Result<Self, CaseError> {
        let (name, ranges) = (name.to_owned(), model.factor_ranges()?);
        let model = model.matrices(&vec![1.0; ranges.len()])?;
        Ok(Self {
            name,
            model,
            test,
            settings,
            ranges,
        })
    }

    /// What the pre-flight finds beside a test.
    ///
    /// # Errors
    /// Those of [`preflight`].
    pub fn findings(&self, test: &ModeSet) -> Result<Vec<Finding>, Error> {
        preflight(&self.model, test, &self.settings, &self.ranges)
    }
}
