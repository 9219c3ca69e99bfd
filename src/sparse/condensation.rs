//! Condensation and shares (A.1) to (A.9) at any size: what [`crate::method::appendix_a`] does with dense matrices, with a sparse
//! factor, the coefficients of $T$ alone and each element's few ways to deform.

use crate::method::appendix_a::dynamic_stiffness;
use crate::method::assembly::ElementMatrix;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape};
use crate::method::model::{
    DynamicModel, FiniteElementModel, ModalModel, Parameter, ParameterMatrix, ScaledSizes,
    ScaledStructure,
};
use crate::method::modes::{ModeSet, Modes, solve};
use crate::method::structure::Structure;
use crate::sparse::SparseMatrix;
use crate::sparse::add_squares;
use crate::sparse::factorization::{Factor, FactorizationPlan};
use nalgebra::{DMatrix, DVector};
use std::ops::Deref;
use std::sync::Arc;

/// Stiffness of a way to deform, relative to the element's largest, below which it is the round-off of a rigid motion.
const SMALLEST_DEFORMATION: f64 = 1e-14;
/// Amplitudes of ways to deform that are multiplied at once: as many numbers as a processor's cache holds.
const AMPLITUDES_AT_ONCE: usize = 32_768;

/// A [`FiniteElementModel`] of any size: the same structure, mass and parameters, with $T$ by its coefficients and the
/// factorization of $K_S$ planned once.
#[derive(Debug, Clone)]
pub struct LargeModel {
    scaled: ScaledStructure,
    load_distribution: SparseMatrix,
    plan: Arc<FactorizationPlan>,
}

impl Deref for LargeModel {
    type Target = ScaledStructure;

    fn deref(&self) -> &ScaledStructure {
        &self.scaled
    }
}

impl LargeModel {
    /// Puts a model together, forms every unit element matrix and plans the factorization.
    ///
    /// # Errors
    /// Those of [`ScaledStructure::new`] and [`FactorizationPlan::new`]; [`Error::WrongShape`] for a $T$ of another size.
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
        Self::planned(
            ScaledStructure::new(structure, mass, parameters)?,
            load_distribution,
        )
    }

    /// A model of the method at any size.
    ///
    /// # Errors
    /// Those of [`FactorizationPlan::new`].
    pub fn of(model: &FiniteElementModel) -> Result<Self, Error> {
        let scaled: &ScaledStructure = model;
        Self::planned(
            scaled.clone(),
            SparseMatrix::of_dense("load distribution", model.load_distribution())?,
        )
    }

    fn planned(scaled: ScaledStructure, load_distribution: SparseMatrix) -> Result<Self, Error> {
        let plan = FactorizationPlan::new(scaled.structure(), scaled.element_matrices())?;
        Ok(Self {
            scaled,
            load_distribution,
            plan: Arc::new(plan),
        })
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
        let (elements, loads) = (self.element_matrices(), self.load_distribution.clone());
        let free = self.structure().free_dof();
        let structural = Factor::of_planned_stiffness(&self.plan, elements, &at.sizes, free)?;
        let stiffness = dynamic_stiffness(&structural.flexibility(&loads)?)?;
        let mut mass = at.point_masses.clone();
        if elements
            .iter()
            .any(|element| element.unit_mass.amax() > 0.0)
        {
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
        let transposed = condensed.transposed_shapes(shapes)?;
        Ok(self.scaled.shares(
            at,
            shapes,
            |members| sum_of_stiffness(&transposed, members.iter().copied()),
            |members| sum_of_mass(&transposed, members.iter().copied()),
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

/// Generalized stiffness of elements of given sizes, $\sum_e s_e V_e^t K_e V_e$ (m × m, lbf/in for deflections in inches), where
/// $V_e$ are the columns of `transposed_shapes` (m × free SDOF) at an element's own DOF.
///
/// For `transposed_shapes` $= B$ it is their share of $K_D$, $\sum_e s_e B K_e B^t$ (A.9); the shares sum to $K_D$ exactly. For
/// $V_S = B^t V$ it is that share seen through dynamic shapes $V$. An element deforms in few ways, a rod and a shear panel in one: by
/// Cholesky steps with pivots, $K_e = \sum_r a_r a_r^t/p_r$ and $V_e^t K_e V_e = \sum_r (V_e^t a_r)(V_e^t a_r)^t/p_r$.
pub(crate) fn sum_of_stiffness<'a>(
    transposed_shapes: &DMatrix<f64>,
    members: impl Iterator<Item = (&'a ElementMatrix, f64)>,
) -> DMatrix<f64> {
    let (count, shapes) = (transposed_shapes.nrows(), transposed_shapes.as_slice());
    let mut sum = DMatrix::zeros(count, count);
    let (mut amplitudes, mut rest, mut deformation) = (Vec::new(), Vec::new(), Vec::new());
    for (ElementMatrix { dof, unit, .. }, size) in members {
        let through = |weights: &[f64], scale: f64, force: &mut [f64]| {
            for (&dof, &weight) in dof
                .iter()
                .zip(weights)
                .filter(|(_, weight)| **weight != 0.0)
            {
                let (weight, motion) = (scale * weight, &shapes[dof * count..][..count]);
                force
                    .iter_mut()
                    .zip(motion)
                    .for_each(|(sum, motion)| *sum += weight * motion);
            }
        };
        rest.clear();
        rest.extend_from_slice(unit.as_slice());
        // The largest entry of a semidefinite matrix stands on its diagonal.
        let smallest = SMALLEST_DEFORMATION * unit.diagonal().amax();
        while let Some(pivot) = take_deformation(&mut rest, dof.len(), smallest, &mut deformation) {
            let start = amplitudes.len();
            amplitudes.resize(start + count, 0.0);
            through(
                &deformation,
                (size / pivot).sqrt(),
                &mut amplitudes[start..],
            );
        }
        // A matrix that is not semidefinite leaves something that no pivot explains.
        for (&dof, column) in dof.iter().zip(rest.chunks(dof.len().max(1))) {
            if column.iter().any(|entry| entry.abs() > smallest) {
                let mut force = vec![0.0; count];
                through(column, size, &mut force);
                sum.syger(
                    1.0,
                    &DVector::from_vec(force),
                    &transposed_shapes.column(dof),
                    1.0,
                );
            }
        }
        if amplitudes.len() >= AMPLITUDES_AT_ONCE {
            add_squares(&mut sum, &amplitudes);
            amplitudes.clear();
        }
    }
    add_squares(&mut sum, &amplitudes);
    sum.fill_upper_triangle_with_lower_triangle();
    sum
}

/// Takes $a a^t/p$ with the largest pivot $p$, and $a$ its column, out of a symmetric matrix: the pivot, if one is left.
pub(super) fn take_deformation(
    matrix: &mut [f64],
    order: usize,
    smallest: f64,
    column: &mut Vec<f64>,
) -> Option<f64> {
    let diagonal = |at: usize| matrix[at * (order + 1)];
    // Ties go to the first.
    let pivot = (0..order)
        .rev()
        .max_by(|&a, &b| diagonal(a).total_cmp(&diagonal(b)))?;
    let value = Some(diagonal(pivot)).filter(|value| *value > smallest && value.is_finite())?;
    column.clear();
    column.extend_from_slice(&matrix[pivot * order..][..order]);
    for (entries, factor) in matrix
        .chunks_exact_mut(order)
        .zip(column.iter())
        .filter(|(_, factor)| **factor != 0.0)
    {
        entries
            .iter_mut()
            .zip(column.iter())
            .for_each(|(entry, of)| *entry -= of * factor / value);
    }
    Some(value)
}

/// Their generalized mass in the same way, $\sum_e s_e V_e^t M_e V_e$ with the lumped $M_e$.
pub(crate) fn sum_of_mass<'a>(
    transposed_shapes: &DMatrix<f64>,
    members: impl Iterator<Item = (&'a ElementMatrix, f64)>,
) -> DMatrix<f64> {
    let count = transposed_shapes.nrows();
    let mut sum = DMatrix::zeros(count, count);
    for (ElementMatrix { dof, unit_mass, .. }, size) in members {
        for (&dof, unit) in dof.iter().zip(unit_mass).filter(|(_, unit)| **unit != 0.0) {
            let motion = transposed_shapes.column(dof);
            sum.syger(size * unit, &motion, &motion, 1.0);
        }
    }
    sum.fill_upper_triangle_with_lower_triangle();
    sum
}
