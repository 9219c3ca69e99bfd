//! The finite element analysis: a model at given parameter factors, condensed and seen through its modes.

use super::{DynamicModel, FiniteElementModel, ModalModel, ParameterMatrix, ScaledSizes};
use crate::method::appendix_a::{Condensed, condense, generalized_mass, generalized_stiffness};
use crate::method::assembly::{ElementMatrix, dense_stiffness};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, free_motion};
use crate::method::modes::{ModeSet, Modes, solve};
use crate::method::structure::{DIRECTIONS, StructuralDof};
use nalgebra::DMatrix;

/// A structure condensed to its dynamic DOF at some parameter factors.
#[derive(Debug, Clone)]
pub struct CondensedModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    /// $B^t$, structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: DMatrix<f64>,
}

impl FiniteElementModel {
    /// The structure condensed to the dynamic DOF at the given parameter factors: $K_S$ anew, with it $B$, $K_D$ and $M$.
    ///
    /// With the sizes $s_e$, the mass sizes $m_e$ and the point masses $M_{points}$ of [`at`](super::ScaledStructure::at):
    ///
    /// $$ K_D = \sum_e s_e B K_e B^t, \qquad M = M_{points} + \sum_e m_e B M_e B^t $$
    ///
    /// # Errors
    /// [`Error::WrongShape`] and [`Error::NotPositive`] for bad factors; [`Error::SingularStiffness`] naming the grid and
    /// direction that nothing holds; [`Error::Dependent`] when a dynamic DOF is a combination of others.
    pub fn condense(&self, factors: &[f64]) -> Result<CondensedModel, Error> {
        self.condense_at(&self.at(factors)?)
    }

    fn condense_at(&self, at: &ScaledSizes) -> Result<CondensedModel, Error> {
        let (elements, free) = (self.element_matrices(), self.structure().free_dof());
        let structural = dense_stiffness(elements, &at.sizes, free.len())?;
        let Condensed {
            stiffness,
            transformation,
        } = condense(&structural, self.load_distribution()).map_err(|error| match error {
            Error::NotPositiveDefinite {
                what: "structural stiffness",
                ..
            } => is_free(&structural, free).unwrap_or(error),
            other => other,
        })?;
        let mut mass = at.point_masses.clone();
        for (element, &size) in elements.iter().zip(&at.mass_sizes) {
            mass += generalized_mass(element, size, &transformation);
        }
        check_finite("dynamic mass", &mass)?;
        Ok(CondensedModel {
            stiffness,
            mass,
            transformation,
        })
    }

    /// Every parameter's share seen through shapes $V$ at the dynamic DOF (d × m):
    ///
    /// $$ V^t B K_e B^t V = V_e^t K_e V_e, \qquad V_S = B^t V $$
    ///
    /// With the identity for $V$ they are the shares of $K_D$ and $M$ themselves (A.9).
    fn condensed_shares(
        &self,
        condensed: &CondensedModel,
        at: &ScaledSizes,
        shapes: &DMatrix<f64>,
    ) -> Vec<ParameterMatrix> {
        let structural = &condensed.transformation * shapes;
        let elements = self.element_matrices();
        let sum = |members: &[(usize, f64)], share: GeneralizedShare| {
            members
                .iter()
                .map(|&(row, size)| share(&elements[row], size, &structural))
                .sum()
        };
        self.shares(
            at,
            shapes,
            |members| sum(members, generalized_stiffness),
            |members| sum(members, generalized_mass),
        )
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: what the loops are handed.
    ///
    /// It takes the lowest `analysis_modes` modes, or as many as there are dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`DynamicModel::analyze`].
    ///
    /// # Example
    ///
    /// ```rust
    /// # use corfem::chain::rods;
    /// # use corfem::method::model::{FiniteElementModel, Parameter};
    /// use corfem::method::modes::ModeSet;
    /// use nalgebra::{dmatrix, dvector};
    ///
    /// // A unit mass on a spring of 4 beside a test mode of ω² = 9: a frequency of 2 for 3.
    /// let (spring, parameters) = (rods(&[4.0], [true, false])?, vec![Parameter::element(1, None)]);
    /// let model = FiniteElementModel::new(spring, dmatrix![1.0], dmatrix![1.0], parameters)?;
    /// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
    /// let modal = model.analyze(&[1.0], &test, None)?;
    /// assert!((modal.exact().errors.frequency - 1.0 / 3.0).abs() < 1e-14);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &ModeSet,
        analysis_modes: Option<usize>,
    ) -> Result<ModalModel, Error> {
        let at = self.at(factors)?;
        let condensed = self.condense_at(&at)?;
        let CondensedModel {
            stiffness, mass, ..
        } = &condensed;
        let model = ModalModel::new(stiffness, mass, test, analysis_modes, |shapes| {
            Ok(self.condensed_shares(&condensed, &at, shapes))
        })?;
        Ok(model.with_sizes(at.mean_sizes))
    }

    /// $K_D$, $M$ and every parameter's share of them as matrices (d × d), for those who look at whole matrices.
    ///
    /// # Errors
    /// Those of [`Self::condense`].
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let at = self.at(factors)?;
        let condensed = self.condense_at(&at)?;
        let identity = DMatrix::identity(self.mass().nrows(), self.mass().nrows());
        let shares = self.condensed_shares(&condensed, &at, &identity);
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
        let CondensedModel {
            stiffness, mass, ..
        } = self.condense(factors)?;
        solve(&stiffness, &mass, mass.nrows())
    }
}

/// An element's share seen through shapes at the structural DOF.
type GeneralizedShare = fn(&ElementMatrix, f64, &DMatrix<f64>) -> DMatrix<f64>;

/// The error that names what moves most in the motion that a stiffness does not resist, if there is one.
fn is_free(stiffness: &DMatrix<f64>, free: &[StructuralDof]) -> Option<Error> {
    let (dof, ratio) = free_motion(stiffness)?;
    let StructuralDof { grid, direction } = free[dof];
    Some(Error::SingularStiffness {
        grid,
        direction: DIRECTIONS[direction],
        ratio,
    })
}
