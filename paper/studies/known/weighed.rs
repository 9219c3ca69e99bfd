//! Models whose elements have masses of their own, which the crate's have not: they are condensed with the stiffness, anew at all factors.

use corfem::method::appendix_a::{Condensed, ElementMatrix, generalized_stiffness};
use corfem::method::error::Error;
use corfem::method::linear_algebra::symmetric_part;
use corfem::method::model::{DynamicModel, FiniteElementModel, Model};
use corfem::method::modes::{Modes, solve};
use corfem::method::structure::Structure;
use corfem::sparse::elements::lumped_masses;
use corfem::sparse::{Factor, SparseMatrix};
use nalgebra::{DMatrix, DVector};
use std::collections::HashMap;
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
    /// $K_D$ and $B^t$ by a sparse factor, for the structures here are larger than the paper's.
    fn condensed(&self, sizes: &[f64]) -> Result<Condensed, Error> {
        let (t, what) = (self.load_distribution(), "structural stiffness");
        let elements = self.element_matrices().iter().zip(sizes);
        let entries = elements.flat_map(|(ElementMatrix { dof, unit, .. }, &size)| {
            let places = (0..dof.len()).flat_map(|a| (0..dof.len()).map(move |b| (a, b)));
            places.map(move |(a, b)| (dof[a], dof[b], size * unit[(a, b)]))
        });
        let stiffness = SparseMatrix::new(what, t.nrows(), t.nrows(), entries.collect())?;
        let deflections = Factor::new(what, &stiffness)?.solve(t)?;
        let flexibility = symmetric_part(&t.tr_mul(&deflections)).cholesky();
        let stiffness = flexibility.ok_or(Error::no_convergence(what))?.inverse();
        Ok(Condensed {
            transformation: deflections * &stiffness,
            stiffness: symmetric_part(&stiffness),
        })
    }

    /// The mass at the points: theirs, or that of the elements.
    fn mass_through(&self, b: &DMatrix<f64>) -> DMatrix<f64> {
        let lumped = lumped_mass(self.structure());
        if lumped.amax() == 0.0 {
            return self.mass().clone();
        }
        let mut forces = b.clone();
        for (mut row, mass) in forces.row_iter_mut().zip(&lumped) {
            row *= *mass;
        }
        symmetric_part(&b.tr_mul(&forces))
    }

    /// $K_D$, $M_D$ and the shares at factors.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let sizes = self.sizes(factors)?;
        let Condensed {
            stiffness,
            transformation: b,
        } = self.condensed(&sizes)?;
        let elements = self.element_matrices().iter().zip(&sizes);
        let by_label: HashMap<usize, (&ElementMatrix, &f64)> = elements
            .map(|(element, size)| (element.label, (element, size)))
            .collect();
        let share = |label: &usize| {
            let (element, size) = by_label[label];
            generalized_stiffness(element, *size, &b)
        };
        let parameters = self.parameters().iter();
        let shares = parameters.map(|parameter| parameter.elements.iter().map(share).sum());
        Ok(DynamicModel {
            shares: shares.collect(),
            mass: self.mass_through(&b),
            stiffness,
        })
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
        let condensed = self.condensed(&self.sizes(factors)?)?;
        let mass = self.mass_through(&condensed.transformation);
        solve(&condensed.stiffness, &mass, mass.nrows())
    }
}
