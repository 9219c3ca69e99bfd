//! Structures with wrong gages whose true factors are known. The benches include this file too.

pub mod delta_wing;
pub mod eigensolved;
pub mod weighed;
pub mod whole;
pub mod wing;

use corfem::method::error::Error;
use corfem::method::modes::Modes;
use corfem::torque_box::Case;
use corfem::torque_box::error::CaseError;
use corfem::torque_box::wing_box::TEST_GAGE;
use delta_wing::DeltaWing;
use delta_wing::correlation::{GROUPS, Group, first_model, test_modes};
use weighed::Weighed;
use wing::Wing;

/// Modes of the wing's test and analysis.
pub const WING_MODES: usize = 10;

/// A structure whose true factors are known.
pub struct Known {
    /// What it is.
    pub name: String,
    /// The first model.
    pub model: Weighed,
    /// Its test modes, without noise.
    pub test: Modes,
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
        let truth = case
            .first_gages()
            .into_iter()
            .map(|gage| TEST_GAGE / gage)
            .collect();
        Ok(Self {
            name: format!("Case {number}"),
            model: Weighed(case.model()?),
            test: case.test_modes()?,
            truth,
        })
    }

    /// The delta wing with its wrong gages.
    ///
    /// # Errors
    /// Those of the wing and its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let wing = DeltaWing::embedded();
        let truth = GROUPS.iter().map(Group::true_factor).collect();
        Ok(Self {
            name: "Delta wing".to_owned(),
            model: first_model(&wing)?,
            test: test_modes(&wing)?,
            truth,
        })
    }
}

/// Factors from 0.75 to 1.3 that the groups of a wing want.
pub fn planted_factors(count: usize) -> Vec<f64> {
    let pattern = [1.0, 1.2, 0.8, 1.1, 0.75, 1.0, 1.3, 0.9];
    pattern.into_iter().cycle().take(count).collect()
}

/// A wing whose groups want factors from 0.75 to 1.3, with the lowest modes of the right wing as its test.
///
/// # Errors
/// Those of [`Wing::model`] and its modes.
pub fn planted(wing: &Wing) -> Result<Known, Error> {
    let model = Weighed(wing.model()?);
    let truth = planted_factors(model.parameters().len());
    let test = model.modes(&truth)?.lowest(WING_MODES)?;
    Ok(Known {
        name: "Wing".to_owned(),
        model,
        test,
        truth,
    })
}
