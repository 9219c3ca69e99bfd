//! Structures with wrong gages whose true factors are known.

use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::cases::torque_box::TEST_GAGE;
use crate::method::model::FiniteElementModel;
use crate::method::modes::ModeSet;
use crate::studies::delta_wing::DeltaWing;
use crate::studies::delta_wing::correlation::{GROUPS, Group, first_model, test_modes};

/// A structure whose true factors are known.
pub struct Known {
    /// What it is.
    pub name: String,
    /// The first model.
    pub model: FiniteElementModel,
    /// Its test modes, without noise.
    pub test: ModeSet,
    /// The factors that make the model right.
    pub truth: Vec<f64>,
}

impl Known {
    /// A case of the paper.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_case(number: usize) -> Result<Self, CaseError> {
        let case = Case::new(number)?;
        let truth = case.first_gages().into_iter().map(|gage| TEST_GAGE / gage).collect();
        Ok(Self { name: format!("Case {number}"), model: case.model()?, test: case.test_modes()?.into(), truth })
    }

    /// The delta wing with its wrong gages.
    ///
    /// # Errors
    /// Those of the wing and its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let wing = DeltaWing::embedded()?;
        let truth = GROUPS.iter().map(Group::true_factor).collect();
        Ok(Self { name: "Delta wing".to_owned(), model: first_model(&wing)?, test: test_modes(&wing)?, truth })
    }
}
