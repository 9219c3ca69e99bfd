//! Condensation and shares (A.1) to (A.9) at any size: what [`crate::method::appendix_a`] does with dense matrices, with a sparse
//! factor, the coefficients of $T$ alone and each element's few ways to deform.

use super::deformations::{Deformations, sum_of_mass, sum_of_stiffness};
use crate::method::appendix_a::dynamic_stiffness;
use crate::method::assembly::element_by_element;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape};
use crate::method::model::{
    DynamicModel, FiniteElementModel, ModalModel, Parameter, ParameterMatrix, ScaledSizes,
    ScaledStructure,
};
use crate::method::modes::{ModeSet, Modes, solve};
use crate::method::structure::Structure;
use crate::sparse::SparseMatrix;
use crate::sparse::factorization::{Factor, StructuralStiffness};
use nalgebra::DMatrix;
use std::ops::Deref;
use std::sync::Arc;

/// A [`FiniteElementModel`] of any size: the same structure, mass and parameters, with $T$ by its coefficients, elements by their
/// ways to deform and the factorization of $K_S$ planned once.
#[derive(Debug, Clone)]
pub struct LargeModel {
    scaled: ScaledStructure,
    load_distribution: SparseMatrix,
    stiffness: Arc<StructuralStiffness>,
}

impl Deref for LargeModel {
    type Target = ScaledStructure;

    fn deref(&self) -> &ScaledStructure {
        &self.scaled
    }
}

impl LargeModel {
    /// Puts a model together, finds in which ways every element deforms and plans the factorization.
    ///
    /// # Errors
    /// Those of [`ScaledStructure::new`], [`Deformations::of`] and [`StructuralStiffness::new`]; [`Error::WrongShape`] for a $T$ of
    /// another size.
    pub fn new(
        structure: Structure,
        load_distribution: SparseMatrix,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        check_length(
            "load distribution",
            load_distribution.rows(),
            structure.free_dof().len(),
        )?;
        let dynamic = load_distribution.columns();
        check_shape("dynamic mass", &mass, dynamic, dynamic)?;
        let scaled = ScaledStructure::new(structure, mass, parameters)?;
        let elements = element_by_element(scaled.structure())
            .map(|element| Deformations::of(&element))
            .collect::<Result<_, Error>>()?;
        Self::planned(scaled, elements, load_distribution)
    }

    /// A model of the method at any size.
    ///
    /// # Errors
    /// Those of [`Deformations::of`] and [`StructuralStiffness::new`].
    pub fn of(model: &FiniteElementModel) -> Result<Self, Error> {
        let (scaled, elements): (&ScaledStructure, _) = (model, model.element_matrices().iter());
        Self::planned(
            scaled.clone(),
            elements
                .map(Deformations::of)
                .collect::<Result<_, Error>>()?,
            SparseMatrix::of_dense("load distribution", model.load_distribution())?,
        )
    }

    fn planned(
        scaled: ScaledStructure,
        elements: Vec<Deformations>,
        load_distribution: SparseMatrix,
    ) -> Result<Self, Error> {
        let stiffness = StructuralStiffness::new(scaled.structure(), elements)?;
        Ok(Self {
            scaled,
            load_distribution,
            stiffness: Arc::new(stiffness),
        })
    }

    /// The elements by their ways to deform, in the structure's order.
    pub fn elements(&self) -> &[Deformations] {
        self.stiffness.elements()
    }

    /// The load distribution $T$ (free SDOF × d).
    pub fn load_distribution(&self) -> &SparseMatrix {
        &self.load_distribution
    }

    /// $K_S$ anew at the given parameter factors, with it $K_D$ and $M$.
    ///
    /// # Errors
    /// Those of [`FiniteElementModel::condense`].
    pub fn condense(&self, factors: &[f64]) -> Result<LargeCondensation, Error> {
        self.condense_at(&self.at(factors)?)
    }

    fn condense_at(&self, at: &ScaledSizes) -> Result<LargeCondensation, Error> {
        let (elements, loads) = (self.elements(), self.load_distribution.clone());
        let structural = self.stiffness.factorized(&at.sizes)?;
        let stiffness = dynamic_stiffness(&structural.flexibility(&loads)?)?;
        let mut mass = at.point_masses.clone();
        if elements.iter().any(Deformations::has_mass) {
            let b = structural.solve_transposed(&loads.times(&stiffness)?)?;
            mass += sum_of_mass(&b, elements.iter().zip(at.mass_sizes.iter().copied()));
        }
        Ok(LargeCondensation {
            stiffness,
            mass,
            structural,
            loads,
        })
    }

    fn condensed_shares(
        &self,
        condensed: &LargeCondensation,
        at: &ScaledSizes,
        shapes: &DMatrix<f64>,
    ) -> Result<Vec<ParameterMatrix>, Error> {
        let (elements, transposed) = (self.elements(), condensed.transposed_shapes(shapes)?);
        let sized = |&(row, size): &(usize, f64)| (&elements[row], size);
        Ok(self.scaled.shares(
            at,
            shapes,
            |members| sum_of_stiffness(&transposed, members.iter().map(sized)),
            |members| sum_of_mass(&transposed, members.iter().map(sized)),
        ))
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: the same as
    /// [`FiniteElementModel::analyze`].
    ///
    /// # Errors
    /// Those of [`FiniteElementModel::analyze`].
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &ModeSet,
        analysis_modes: Option<usize>,
    ) -> Result<ModalModel, Error> {
        let at = self.at(factors)?;
        let condensed = self.condense_at(&at)?;
        let LargeCondensation {
            stiffness, mass, ..
        } = &condensed;
        let model = ModalModel::new(stiffness, mass, test, analysis_modes, |shapes| {
            self.condensed_shares(&condensed, &at, shapes)
        })?;
        Ok(model.with_sizes(at.mean_sizes))
    }

    /// $K_D$, $M$ and every parameter's share of them as matrices (d × d).
    ///
    /// # Errors
    /// Those of [`Self::condense`].
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let at = self.at(factors)?;
        let condensed = self.condense_at(&at)?;
        let identity = DMatrix::identity(self.mass().nrows(), self.mass().nrows());
        let shares = self.condensed_shares(&condensed, &at, &identity)?;
        Ok(DynamicModel {
            stiffness: condensed.stiffness,
            mass: condensed.mass,
            shares,
        })
    }

    /// The exact modes at the given parameter factors, at the dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`solve`].
    pub fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        let LargeCondensation {
            stiffness, mass, ..
        } = self.condense(factors)?;
        solve(&stiffness, &mass, mass.nrows())
    }
}

/// A structure of any size condensed to its dynamic DOF at some parameter factors.
#[derive(Debug, Clone)]
pub struct LargeCondensation {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    structural: Factor,
    loads: SparseMatrix,
}

impl LargeCondensation {
    /// Structural deflections $V_S = B^t V = K_S^{-1} T K_D V$ (free SDOF × m) of shapes $V$ at the dynamic DOF (d × m), by m solutions
    /// and not by all of $B^t$, which it is for the identity.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless the shapes have a row per dynamic DOF; those of
    /// [`Factor::solve`](crate::sparse::Factor::solve).
    pub fn structural_shapes(&self, shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape(
            "mode shapes",
            shapes,
            self.stiffness.nrows(),
            shapes.ncols(),
        )?;
        self.transposed_shapes(shapes)
            .map(|transposed| transposed.transpose())
    }

    fn transposed_shapes(&self, shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        self.structural
            .solve_transposed(&self.loads.times(&(&self.stiffness * shapes))?)
    }
}
