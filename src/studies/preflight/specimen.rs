//! Structures before their correlation.

use super::{Finding, preflight};
use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::closed_forms::spring_chain::spring_stiffness;
use crate::method::error::Error;
use crate::method::model::{DynamicModel, FiniteElementModel, Range};
use crate::method::modes::{ModeSet, solve};
use crate::method::outer_loop::Settings;
use crate::studies::delta_wing::correlation;
use crate::studies::weighted::comparison::Known;
use nalgebra::{DMatrix, DVector};

/// Stiffness of the first model's springs over the true one.
const SPRING_ERRORS: [f64; 8] = [0.8, 1.25, 1.0, 0.75, 1.0, 1.3, 0.9, 1.0];

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
    pub ranges: Vec<Option<Range>>,
    /// Whether the masses are made with the columns of $T$, and so take their order.
    pub mass_follows: bool,
}

impl Specimen {
    /// A case of the paper, whose condensation is exact: all its mass is at the dynamic points.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_case(case: &Case) -> Result<Self, CaseError> {
        let (model, test) = (case.model()?, case.test_modes()?.into());
        Self::of(&format!("Case {}", case.number), &model, test, case.settings.clone())
    }

    /// The delta wing with its wrong gages, and ten modes at 19 points.
    ///
    /// # Errors
    /// Those of the wing and of its model.
    pub fn delta_wing() -> Result<Self, CaseError> {
        let Known { name, model, test, .. } = Known::delta_wing()?;
        let specimen = Self::of(&name, &model, test, correlation::settings())?;
        Ok(Self { mass_follows: true, ..specimen })
    }

    fn of(name: &str, model: &FiniteElementModel, test: ModeSet, settings: Settings) -> Result<Self, CaseError> {
        let (name, ranges) = (name.to_owned(), model.factor_ranges()?);
        let model = model.matrices(&vec![1.0; ranges.len()])?;
        Ok(Self { name, model, test, settings, ranges, mass_follows: false })
    }

    /// Eight masses and eight springs in a row, held at one end, both less toward the other, with springs up to 30 % wrong.
    ///
    /// # Errors
    /// Those of [`solve`].
    pub fn spring_chain() -> Result<Self, Error> {
        let count = SPRING_ERRORS.len();
        let spring = |s: usize, error: f64| spring_stiffness(count, s, 1e6 * error * (1.0 - 0.08 * s as f64));
        let right: DMatrix<f64> = (0..count).map(|s| spring(s, 1.0)).sum();
        let wrong = SPRING_ERRORS.iter().enumerate().map(|(s, &error)| spring(s, error)).sum();
        let mass = DMatrix::from_diagonal(&DVector::from_fn(count, |point, _| 1.0 - 0.06 * point as f64));
        Ok(Self {
            name: "Spring chain".to_owned(),
            test: solve(&right, &mass, count)?.into(),
            model: DynamicModel { stiffness: wrong, mass, shares: Vec::new() },
            settings: Settings::default(),
            ranges: vec![None; count],
            mass_follows: false,
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
