//! Structures with wrong gages whose true factors are known.

use crate::prelude::*;
use std::ops::Deref;

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
    pub fn of_case(number: usize) -> Self {
        let case = case_of(number);
        let gages = case.first_gages().into_iter();
        Self {
            name: format!("Case {number}"),
            model: Weighed(case.model().unwrap()),
            test: case.test_modes().unwrap(),
            truth: gages.map(|gage| TEST_GAGE / gage).collect(),
        }
    }

    /// The delta wing with its wrong gages.
    pub fn delta_wing() -> Self {
        let groups = delta_wing::GROUPS.iter();
        Self {
            name: "Delta wing".to_owned(),
            model: delta_wing::first_model(),
            test: delta_wing::test_modes(),
            truth: groups.map(delta_wing::Group::true_factor).collect(),
        }
    }
}

/// Lumped masses of the elements of a structure at its free DOF, lbf·s²/in.
pub fn lumped_mass(structure: &Structure) -> DVector<f64> {
    let mut mass = DVector::zeros(structure.free_dof().len());
    for (element, corners) in structure.elements().iter().zip(structure.corners()) {
        for (row, own) in lumped_masses(structure, element, corners) {
            mass[row] += own;
        }
    }
    mass
}

/// A model weighed part by part: where its elements have masses, those of their first sizes, $B M_S B^t$, are all its mass.
#[derive(Debug, Clone)]
pub struct Weighed(pub FiniteElementModel);

impl Deref for Weighed {
    type Target = FiniteElementModel;

    fn deref(&self) -> &FiniteElementModel {
        &self.0
    }
}

impl Weighed {
    /// $K_D$, $M_D$ and the shares at factors.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let mut found = self.0.matrices(factors)?;
        let lumped = lumped_mass(self.structure());
        if lumped.amax() > 0.0 {
            let b = self.condense(factors)?.transformation;
            found.mass = dynamic_mass(&DMatrix::from_diagonal(&lumped), &b)?;
        }
        Ok(found)
    }

    /// The analysis at factors beside test modes.
    ///
    /// # Errors
    /// What the model and [`DynamicModel::analyze`] refuse.
    pub fn analyze(&self, factors: &[f64], test: &Modes) -> Result<ModalModel, Error> {
        self.matrices(factors)?.analyze(test, None)
    }

    /// All modes at factors.
    ///
    /// # Errors
    /// What the model and [`solve`] refuse.
    pub fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        let found = self.matrices(factors)?;
        solve(&found.stiffness, &found.mass, found.mass.nrows())
    }
}
