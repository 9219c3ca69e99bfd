//! Condensation and shares (A.1) to (A.9) at any size: what [`crate::method::appendix_a`] does with dense matrices, with a sparse
//! factor, the coefficients of $T$ alone and each element's few ways to deform.

use super::deformations::{Deformations, sum_of_stiffness};
use crate::method::appendix_a::{dynamic_stiffness, element_matrices};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape, cholesky};
use crate::method::model::{DynamicModel, FiniteElementModel, Model, Parameter, ScaledStructure};
use crate::method::modes::{Modes, solve};
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
    mass: DMatrix<f64>,
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
        cholesky("dynamic mass", &mass, 0.0)?;
        let scaled = ScaledStructure::new(structure, parameters)?;
        let elements = element_matrices(scaled.structure())
            .map(|element| Deformations::of(&element))
            .collect::<Result<_, Error>>()?;
        Self::planned(scaled, mass, elements, load_distribution)
    }

    /// A model of the method at any size.
    ///
    /// # Errors
    /// Those of [`Deformations::of`] and [`StructuralStiffness::new`].
    pub fn of(model: &FiniteElementModel) -> Result<Self, Error> {
        let (scaled, elements): (&ScaledStructure, _) = (model, model.element_matrices().iter());
        Self::planned(
            scaled.clone(),
            model.mass().clone(),
            elements
                .map(Deformations::of)
                .collect::<Result<_, Error>>()?,
            SparseMatrix::of_dense("load distribution", model.load_distribution())?,
        )
    }

    fn planned(
        scaled: ScaledStructure,
        mass: DMatrix<f64>,
        elements: Vec<Deformations>,
        load_distribution: SparseMatrix,
    ) -> Result<Self, Error> {
        let stiffness = StructuralStiffness::new(scaled.structure(), elements)?;
        Ok(Self {
            scaled,
            mass,
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

    /// The dynamic mass $M$, lbf·s²/in (d × d).
    pub fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// $K_S$ anew at the given parameter factors, with it $K_D$.
    ///
    /// # Errors
    /// As [`FiniteElementModel::condense`].
    pub fn condense(&self, factors: &[f64]) -> Result<LargeCondensation, Error> {
        let structural = self.stiffness.factorized(&self.sizes(factors)?)?;
        let loads = self.load_distribution.clone();
        Ok(LargeCondensation {
            stiffness: dynamic_stiffness(&structural.flexibility(&loads)?)?,
            structural,
            loads,
        })
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: the same as
    /// [`FiniteElementModel::analyze`].
    ///
    /// # Errors
    /// As [`FiniteElementModel::analyze`].
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &Modes,
        analysis_modes: Option<usize>,
    ) -> Result<Model, Error> {
        let (sizes, condensed) = (self.sizes(factors)?, self.condense(factors)?);
        let through = |shapes: &DMatrix<f64>| self.shares(&condensed, &sizes, shapes);
        let matrices = (&condensed.stiffness, &self.mass);
        let mut model = Model::seen(matrices, test, analysis_modes, through)?;
        model.gages = self.mean_sizes(&sizes);
        Ok(model)
    }

    /// Every parameter's share $V^t B K_e B^t V$ in shapes $V$ at the dynamic DOF (d × m).
    fn shares(
        &self,
        condensed: &LargeCondensation,
        sizes: &[f64],
        shapes: &DMatrix<f64>,
    ) -> Result<Vec<DMatrix<f64>>, Error> {
        let structural = condensed.transposed_shapes(shapes)?;
        let of_parameter = |rows: &Vec<usize>| {
            let sized = |&row: &usize| (&self.elements()[row], sizes[row]);
            sum_of_stiffness(&structural, rows.iter().map(sized))
        };
        Ok(self.rows().iter().map(of_parameter).collect())
    }

    /// $K_D$, $M$ and every parameter's share of $K_D$ as matrices (d × d).
    ///
    /// # Errors
    /// As [`Self::condense`].
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let (sizes, condensed) = (self.sizes(factors)?, self.condense(factors)?);
        let identity = DMatrix::identity(self.mass.nrows(), self.mass.nrows());
        Ok(DynamicModel {
            shares: self.shares(&condensed, &sizes, &identity)?,
            stiffness: condensed.stiffness,
            mass: self.mass.clone(),
        })
    }

    /// The exact modes at the given parameter factors, at the dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`solve`].
    pub fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        solve(
            &self.condense(factors)?.stiffness,
            &self.mass,
            self.mass.nrows(),
        )
    }
}

/// A structure of any size condensed to its dynamic DOF at some parameter factors.
#[derive(Debug, Clone)]
pub struct LargeCondensation {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
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
