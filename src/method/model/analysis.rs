//! The finite element analysis: a model at given parameter factors, condensed and seen through its modes.

use super::{DynamicModel, FiniteElementModel, ModalModel, Parameter, Scaled, Share};
use crate::method::appendix_a::{Condensed, condense, generalized_mass, generalized_stiffness};
use crate::method::assembly::FactorizedStiffness;
use crate::method::error::Error;
use crate::method::linear_algebra::finite;
use crate::method::modes::{ModeSet, Modes, solve};
use nalgebra::DMatrix;

/// A structure condensed to its dynamic DOF at some parameter factors.
#[derive(Debug, Clone)]
pub struct CondensedModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    /// $B^t$: structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: DMatrix<f64>,
    /// Gage or area of every element as its stiffness has it.
    sizes: Vec<f64>,
    /// Gage or area of every element as its mass has it.
    mass_sizes: Vec<f64>,
    /// Point masses, lbf·s²/in (d × d).
    point_mass: DMatrix<f64>,
}

impl FiniteElementModel {
    /// The structure condensed to the dynamic DOF at the given parameter factors: $K_S$ anew, with it $B$, $K_D$ and $M$.
    ///
    /// With $s_e$ of [`Self::sizes`], $m_e$ of [`Self::mass_sizes`] and $M_{points}$ of [`Self::point_masses`]:
    ///
    /// $$ K_D = \sum_e s_e B K_e B^t, \qquad M = M_{points} + \sum_e m_e B M_e B^t $$
    ///
    /// # Errors
    /// Those of [`Self::sizes`], [`FactorizedStiffness::new`] and [`condense`].
    pub fn condense(&self, factors: &[f64]) -> Result<CondensedModel, Error> {
        let sizes = self.sizes(factors)?;
        let mass_sizes = self.mass_sizes(factors)?;
        let point_mass = self.point_masses(factors)?;
        let free = self.structure.free_dof();
        let structural = FactorizedStiffness::new(&self.element_matrices, &sizes, free)?;
        let Condensed { stiffness, transformation } = condense(&structural, &self.load_distribution)?;
        let mut mass = point_mass.clone();
        for (element, &size) in self.element_matrices.iter().zip(&mass_sizes) {
            if element.unit_mass.amax() > 0.0 {
                mass += size * generalized_mass(&transformation, element);
            }
        }
        let (stiffness, mass) = (finite("dynamic stiffness", stiffness)?, finite("dynamic mass", mass)?);
        Ok(CondensedModel { stiffness, mass, transformation, sizes, mass_sizes, point_mass })
    }

    /// Every parameter's share seen through shapes $V$ at the dynamic DOF (d × m), by the rows of each element's own DOF alone:
    ///
    /// $$ V^t B K_e B^t V = V_e^t K_e V_e, \qquad V_S = B^t V $$
    ///
    /// With the identity for $V$ they are the shares of $K_D$ and $M$ themselves (A.9).
    fn shares(&self, condensed: &CondensedModel, shapes: &DMatrix<f64>) -> Vec<Share> {
        let structural = &condensed.transformation * shapes;
        // A parameter has at least one member.
        let sum = |rows: &[usize], of: &dyn Fn(usize) -> DMatrix<f64>| rows.iter().map(|&row| of(row)).sum();
        let stiffness = |row| condensed.sizes[row] * generalized_stiffness(&structural, &self.element_matrices[row]);
        let mass = |row| condensed.mass_sizes[row] * generalized_mass(&structural, &self.element_matrices[row]);
        let point_mass = |row| condensed.point_mass[(row, row)] * shapes.row(row).tr_mul(&shapes.row(row));
        let of_parameter = |(parameter, rows): (&Parameter, &Vec<usize>)| match parameter.scaled {
            Scaled::Stiffness => Share::Stiffness(sum(rows, &stiffness)),
            Scaled::ElementMass => Share::Mass(sum(rows, &mass)),
            Scaled::PointMass => Share::Mass(sum(rows, &point_mass)),
        };
        self.parameters.iter().zip(&self.rows).map(of_parameter).collect()
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: what the loops are handed.
    ///
    /// It takes the lowest `analysis_modes` modes, or as many as there are dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`DynamicModel::analyze`].
    pub fn analyze(&self, factors: &[f64], test: &ModeSet, analysis_modes: Option<usize>) -> Result<ModalModel, Error> {
        let condensed = self.condense(factors)?;
        let through = |shapes: &DMatrix<f64>| self.shares(&condensed, shapes);
        let mut model = ModalModel::new(&condensed.stiffness, &condensed.mass, test, analysis_modes, through)?;
        for ((size, parameter), rows) in model.sizes.iter_mut().zip(&self.parameters).zip(&self.rows) {
            if parameter.scaled == Scaled::Stiffness {
                *size = rows.iter().map(|&row| condensed.sizes[row]).sum::<f64>() / rows.len() as f64;
            }
        }
        Ok(model)
    }

    /// $K_D$, $M$ and every parameter's share of them as matrices (d × d), for those who look at whole matrices.
    ///
    /// # Errors
    /// Those of [`Self::condense`].
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let condensed = self.condense(factors)?;
        let identity = DMatrix::identity(self.mass.nrows(), self.mass.nrows());
        let shares = self.shares(&condensed, &identity);
        Ok(DynamicModel { stiffness: condensed.stiffness, mass: condensed.mass, shares })
    }

    /// The exact modes at the given parameter factors, at the dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`solve`].
    pub fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        let condensed = self.condense(factors)?;
        solve(&condensed.stiffness, &condensed.mass, condensed.mass.nrows())
    }
}
