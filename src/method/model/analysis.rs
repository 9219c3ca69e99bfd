//! The finite element analysis: a model at given parameter factors, condensed and seen through its modes.

use super::{DynamicModel, FiniteElementModel, ModalModel, Parameter, Scaled, Share};
use crate::method::appendix_a::{dynamic_stiffness, generalized_mass, generalized_stiffness};
use crate::method::error::Error;
use crate::method::factorization::FactorizedStiffness;
use crate::method::linear_algebra::{check_shape, finite};
use crate::method::load_distribution::LoadDistribution;
use crate::method::modes::{ModeSet, Modes, solve};
use nalgebra::DMatrix;

/// A structure condensed to its dynamic DOF at some parameter factors.
#[derive(Debug, Clone)]
pub struct CondensedModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    structural: FactorizedStiffness,
    loads: LoadDistribution,
    /// Gage or area of every element as its stiffness has it.
    sizes: Vec<f64>,
    /// Gage or area of every element as its mass has it.
    mass_sizes: Vec<f64>,
    /// Point masses, lbf·s²/in (d × d).
    point_mass: DMatrix<f64>,
}

impl CondensedModel {
    /// Structural deflections $V_S = B^t V = K_S^{-1} T K_D V$ (free SDOF × m) of shapes $V$ at the dynamic DOF (d × m), by m solutions
    /// and not by all of $B^t$, which it is for the identity.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless the shapes have a row per dynamic DOF; those of [`FactorizedStiffness::solve`].
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
            .solve_transposed(&self.loads.times(&(&self.stiffness * shapes)))
    }
}

impl FiniteElementModel {
    /// The structure condensed to the dynamic DOF at the given parameter factors: $K_S$ anew, with it $B$, $K_D$ and $M$.
    ///
    /// With $s_e$ of [`Self::sizes`], $m_e$ of [`Self::mass_sizes`] and $M_{points}$ of [`Self::point_masses`]:
    ///
    /// $$ K_D = \sum_e s_e B K_e B^t, \qquad M = M_{points} + \sum_e m_e B M_e B^t $$
    ///
    /// # Errors
    /// Those of [`Self::sizes`] and [`FactorizedStiffness::new`]; [`Error::Dependent`] when a dynamic DOF is a combination of others.
    pub fn condense(&self, factors: &[f64]) -> Result<CondensedModel, Error> {
        let (sizes, mass_sizes) = (self.sizes(factors)?, self.mass_sizes(factors)?);
        let point_mass = self.point_masses(factors)?;
        let (elements, loads) = (&self.element_matrices, self.load_distribution.clone());
        let structural =
            FactorizedStiffness::planned(&self.plan, elements, &sizes, self.structure.free_dof())?;
        let stiffness = dynamic_stiffness(&structural.flexibility(&loads)?)?;
        let mut mass = point_mass.clone();
        if elements
            .iter()
            .any(|element| element.unit_mass.amax() > 0.0)
        {
            let b = structural.solve_transposed(&loads.times(&stiffness))?;
            mass += generalized_mass(&b, elements.iter().zip(mass_sizes.iter().copied()));
        }
        let mass = finite("dynamic mass", mass)?;
        Ok(CondensedModel {
            stiffness,
            mass,
            structural,
            loads,
            sizes,
            mass_sizes,
            point_mass,
        })
    }

    /// Every parameter's share seen through shapes $V$ at the dynamic DOF (d × m), by the rows of each element's own DOF alone:
    ///
    /// $$ V^t B K_e B^t V = V_e^t K_e V_e, \qquad V_S = B^t V $$
    ///
    /// With the identity for $V$ they are the shares of $K_D$ and $M$ themselves (A.9).
    fn shares<'a>(
        &'a self,
        condensed: &'a CondensedModel,
        shapes: &DMatrix<f64>,
    ) -> Result<Vec<Share>, Error> {
        let transposed = condensed.transposed_shapes(shapes)?;
        let of_parameter = |(parameter, rows): (&Parameter, &'a Vec<usize>)| {
            let members = |sizes: &'a [f64]| {
                rows.iter()
                    .map(|&row| (&self.element_matrices[row], sizes[row]))
            };
            match parameter.scaled {
                Scaled::Stiffness => Share::Stiffness(generalized_stiffness(
                    &transposed,
                    members(&condensed.sizes),
                )),
                Scaled::ElementMass => Share::Mass(generalized_mass(
                    &transposed,
                    members(&condensed.mass_sizes),
                )),
                // A parameter has at least one member.
                Scaled::PointMass => {
                    let of = |&row: &usize| {
                        condensed.point_mass[(row, row)] * shapes.row(row).tr_mul(&shapes.row(row))
                    };
                    Share::Mass(rows.iter().map(of).sum())
                }
            }
        };
        Ok(self
            .parameters
            .iter()
            .zip(&self.rows)
            .map(of_parameter)
            .collect())
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
    /// # use corfem::closed_forms::spring_chain::rods;
    /// # use corfem::method::model::{FiniteElementModel, Parameter};
    /// use corfem::method::modes::ModeSet;
    /// use nalgebra::{dmatrix, dvector};
    ///
    /// // A unit mass on a spring of 4 beside a test mode of ω² = 9: a frequency of 2 for 3.
    /// let (spring, parameters) = (rods(&[4.0], [true, false])?, vec![Parameter::element(1, None)]);
    /// let model = FiniteElementModel::new(spring, dmatrix![1.0], dmatrix![1.0], parameters)?;
    /// let test = ModeSet { omega_squared: dvector![9.0], shapes: dmatrix![1.0] };
    /// let modal = model.analyze(&[1.0], &test, None)?;
    /// assert!((modal.exact.errors.frequency - 1.0 / 3.0).abs() < 1e-14);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &ModeSet,
        analysis_modes: Option<usize>,
    ) -> Result<ModalModel, Error> {
        let condensed = self.condense(factors)?;
        let through = |shapes: &DMatrix<f64>| self.shares(&condensed, shapes);
        let mut model = ModalModel::new(
            &condensed.stiffness,
            &condensed.mass,
            test,
            analysis_modes,
            through,
        )?;
        for ((size, parameter), rows) in
            model.sizes.iter_mut().zip(&self.parameters).zip(&self.rows)
        {
            if parameter.scaled == Scaled::Stiffness {
                *size =
                    rows.iter().map(|&row| condensed.sizes[row]).sum::<f64>() / rows.len() as f64;
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
        let shares = self.shares(&condensed, &identity)?;
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
        let condensed = self.condense(factors)?;
        solve(
            &condensed.stiffness,
            &condensed.mass,
            condensed.mass.nrows(),
        )
    }
}
