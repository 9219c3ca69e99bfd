//! Models whose elements have masses of their own, which the crate's have not: they are condensed with the stiffness, anew at all factors.

use corfem::method::error::Error;
use corfem::method::linear_algebra::symmetric_part;
use corfem::method::model::{DynamicModel, FiniteElementModel, Model, ScaledStructure};
use corfem::method::modes::{Modes, solve};
use corfem::method::structure::Structure;
use corfem::sparse::LargeModel;
use corfem::sparse::elements::lumped_masses;
use nalgebra::{DMatrix, DVector};
use std::ops::Deref;

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

/// A model that condenses its structure to dynamic DOF.
pub trait Condensing: Deref<Target = ScaledStructure> {
    /// Its matrices with the mass at its points alone.
    ///
    /// # Errors
    /// What the model refuses.
    fn at_points(&self, factors: &[f64]) -> Result<DynamicModel, Error>;

    /// The transformation $B^t$ (free SDOF × d).
    ///
    /// # Errors
    /// What the model refuses.
    fn transformation(&self, factors: &[f64]) -> Result<DMatrix<f64>, Error>;
}

impl Condensing for FiniteElementModel {
    fn at_points(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        self.matrices(factors)
    }

    fn transformation(&self, factors: &[f64]) -> Result<DMatrix<f64>, Error> {
        Ok(self.condense(factors)?.transformation)
    }
}

impl Condensing for LargeModel {
    fn at_points(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        self.matrices(factors)
    }

    fn transformation(&self, factors: &[f64]) -> Result<DMatrix<f64>, Error> {
        let identity = DMatrix::identity(self.mass().nrows(), self.mass().nrows());
        self.condense(factors)?.structural_shapes(&identity)
    }
}

/// A model weighed part by part: where its elements have masses, those of their first sizes, $B M_S B^t$, are all its mass.
#[derive(Debug, Clone)]
pub struct Weighed<M>(pub M);

impl<M> Deref for Weighed<M> {
    type Target = M;

    fn deref(&self) -> &M {
        &self.0
    }
}

impl<M: Condensing> Weighed<M> {
    /// $K_D$, $M_D$ and the shares at factors.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let mut matrices = self.0.at_points(factors)?;
        let lumped = lumped_mass(self.0.structure());
        if lumped.amax() > 0.0 {
            let b = self.0.transformation(factors)?;
            let mut forces = b.clone();
            for (mut row, mass) in forces.row_iter_mut().zip(&lumped) {
                row *= *mass;
            }
            matrices.mass = symmetric_part(&b.tr_mul(&forces));
        }
        Ok(matrices)
    }

    /// The analysis at factors beside test modes.
    ///
    /// # Errors
    /// What the model and [`DynamicModel::analyze`] refuse.
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &Modes,
        analysis_modes: Option<usize>,
    ) -> Result<Model, Error> {
        self.matrices(factors)?.analyze(test, analysis_modes)
    }

    /// All modes at factors.
    ///
    /// # Errors
    /// What the model and [`solve`] refuse.
    pub fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        let DynamicModel {
            stiffness, mass, ..
        } = self.matrices(factors)?;
        solve(&stiffness, &mass, mass.nrows())
    }
}
