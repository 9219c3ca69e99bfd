//! The finite element model as the correlation sees it: a structure, its dynamic points, and what may change.

mod modal;
mod parameters;

pub use modal::{Check, DynamicModel, ModalModel, Share};
pub use parameters::{Parameter, Range, Scaled};

use crate::method::appendix_a::{Condensed, condense, generalized_mass, generalized_stiffness};
use crate::method::assembly::{ElementMatrix, FactorizedStiffness, element_matrices};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, check_length, check_shape, check_symmetric, cholesky};
use crate::method::modes::{ModeSet, Modes, solve};
use crate::method::structure::Structure;
use nalgebra::DMatrix;
use parameters::{MemberKind, Members, resolve};

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

/// A structure with its dynamic degrees of freedom, mass, and parameters.
///
/// A stiffness parameter scales stiffness alone. An element keeps the mass of its first size, times the factor of a mass
/// parameter if there is one: in the paper, too, the mass is known and never changes. So a gage that a correlation finds is
/// a factor on what the element resists, and does not make it heavier. [`Self::sizes`], [`Self::mass_sizes`] and
/// [`Self::point_masses`] follow this law, and so does whatever is made of them: analyses, decks, reports.
#[derive(Debug, Clone)]
pub struct FiniteElementModel {
    structure: Structure,
    element_matrices: Vec<ElementMatrix>,
    load_distribution: DMatrix<f64>,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    members: Vec<Members>,
}

impl FiniteElementModel {
    /// Puts a model together and forms every unit element matrix, once.
    ///
    /// `load_distribution` is $T$ (free SDOF × d), `mass` the dynamic mass $M$ (d × d, lbf·s²/in) beside what elements
    /// with a density add to it.
    ///
    /// # Errors
    /// [`Error::WrongShape`], [`Error::NotFinite`] for bad matrices; [`Error::NotPositiveDefinite`] naming the DOF of a
    /// zero or negative mass; [`Error::Empty`] without parameters or for a parameter without elements;
    /// [`Error::Unknown`], [`Error::SharedElement`], [`Error::CoupledMass`] for a bad
    /// parameter; the geometry errors of the elements.
    pub fn new(
        structure: Structure,
        load_distribution: DMatrix<f64>,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        let dof_count = load_distribution.ncols();
        check_shape("load distribution", &load_distribution, structure.free_dof().len(), dof_count)?;
        check_finite("load distribution", &load_distribution)?;
        check_shape("dynamic mass", &mass, dof_count, dof_count)?;
        check_symmetric("dynamic mass", &mass)?;
        if structure.elements().iter().all(|element| element.material.density == 0.0) {
            cholesky("dynamic mass", &mass, 0.0)?;
        }
        let members = resolve(&structure, dof_count, &parameters)?;
        for point in members.iter().filter(|members| members.kind == MemberKind::PointMass) {
            for &dof in &point.rows {
                // The diagonal entry alone is scaled, so it must be the whole of the mass.
                if (0..dof_count).any(|other| other != dof && mass[(dof, other)] != 0.0) {
                    return Err(Error::CoupledMass(dof));
                }
            }
        }
        Ok(Self {
            element_matrices: element_matrices(&structure)?,
            structure,
            load_distribution,
            mass,
            parameters,
            members,
        })
    }

    /// The same model with element matrices of another origin, such as another program's: stiffness for unit size at each
    /// element's free DOF, lbf/in, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for another number of matrices or one that does not fit its element; [`Error::NotFinite`] and
    /// [`Error::NotSymmetric`].
    pub fn with_unit_stiffness(&self, units: Vec<DMatrix<f64>>) -> Result<Self, Error> {
        check_length("element matrices", units.len(), self.element_matrices.len())?;
        let mut model = self.clone();
        for (element, unit) in model.element_matrices.iter_mut().zip(units) {
            let dof_count = element.dof.len();
            check_shape("element stiffness", &unit, dof_count, dof_count)?;
            check_symmetric("element stiffness", &unit)?;
            element.unit = unit;
        }
        Ok(model)
    }

    /// The structure with its first sizes.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Unit matrices of the elements at the free DOF.
    pub fn element_matrices(&self) -> &[ElementMatrix] {
        &self.element_matrices
    }

    /// The load distribution $T$ (free SDOF × d).
    pub fn load_distribution(&self) -> &DMatrix<f64> {
        &self.load_distribution
    }

    /// The dynamic mass $M$, lbf·s²/in (d × d).
    pub fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// What may change.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Bounds on each parameter's factor: its own, and those that keep all its elements within its size bounds.
    ///
    /// # Errors
    /// [`Error::Limits`] when no factor meets both, or when the first sizes lie outside.
    pub fn factor_ranges(&self) -> Result<Vec<Option<Range>>, Error> {
        let bounds = |(parameter, members): (&Parameter, &Members)| {
            if parameter.size_range.is_none() && parameter.factor_range.is_none() {
                return Ok(None);
            }
            let own = parameter.factor_range;
            let (mut lower, mut upper) = own.map_or((0.0, f64::INFINITY), |range| (range.lower, range.upper));
            if let Some(range) = parameter.size_range {
                for &row in &members.rows {
                    let size = self.structure.elements()[row].size;
                    lower = lower.max(range.lower / size);
                    upper = upper.min(range.upper / size);
                }
            }
            let what = format!("factor of parameter {}", parameter.name);
            let factors = Range::positive(&what, lower, upper)?;
            if factors.contains(1.0) { Ok(Some(factors)) } else { Err(Error::Limits { what, lower, upper }) }
        };
        self.parameters.iter().zip(&self.members).map(bounds).collect()
    }

    /// Gage or area of every element for its stiffness at the given parameter factors, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; [`Error::NotPositive`] for a factor that is not.
    pub fn sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        self.scaled(self.first_sizes(), MemberKind::Stiffness, factors)
    }

    /// The same for its mass: the first size times the factors of mass parameters alone.
    ///
    /// # Errors
    /// Those of [`Self::sizes`].
    pub fn mass_sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        self.scaled(self.first_sizes(), MemberKind::ElementMass, factors)
    }

    /// The dynamic mass $M$ without that of elements at the given parameter factors, lbf·s²/in (d × d).
    ///
    /// # Errors
    /// Those of [`Self::sizes`].
    pub fn point_masses(&self, factors: &[f64]) -> Result<DMatrix<f64>, Error> {
        let ones = vec![1.0; self.mass.nrows()];
        let mut mass = self.mass.clone();
        for (dof, factor) in self.scaled(ones, MemberKind::PointMass, factors)?.iter().enumerate() {
            mass[(dof, dof)] *= factor;
        }
        Ok(mass)
    }

    fn first_sizes(&self) -> Vec<f64> {
        self.structure.elements().iter().map(|element| element.size).collect()
    }

    /// `values` of one kind times the factors of the parameters that scale them.
    fn scaled(&self, mut values: Vec<f64>, kind: MemberKind, factors: &[f64]) -> Result<Vec<f64>, Error> {
        check_length("parameter factors", factors.len(), self.parameters.len())?;
        for ((members, &factor), parameter) in self.members.iter().zip(factors).zip(&self.parameters) {
            let owner = || format!("parameter {}", parameter.name);
            crate::method::structure::positive("factor", owner, factor)?;
            if members.kind == kind {
                for &row in &members.rows {
                    values[row] *= factor;
                }
            }
        }
        Ok(values)
    }

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
        Ok(CondensedModel { stiffness, mass, transformation, sizes, mass_sizes, point_mass })
    }

    /// Every parameter's share seen through shapes $V$ at the dynamic DOF (d × m), by the rows of each element's own DOF alone:
    ///
    /// $$ V^t B K_e B^t V = V_e^t K_e V_e, \qquad V_S = B^t V $$
    ///
    /// With the identity for $V$ they are the shares of $K_D$ and $M$ themselves (A.9).
    fn shares(&self, condensed: &CondensedModel, shapes: &DMatrix<f64>) -> Vec<Share> {
        let structural = &condensed.transformation * shapes;
        let count = shapes.ncols();
        let of_parameter = |members: &Members| {
            let mut sum = DMatrix::zeros(count, count);
            for &row in &members.rows {
                match members.kind {
                    MemberKind::Stiffness => {
                        let element = &self.element_matrices[row];
                        sum += condensed.sizes[row] * generalized_stiffness(&structural, element);
                    }
                    MemberKind::ElementMass => {
                        let element = &self.element_matrices[row];
                        sum += condensed.mass_sizes[row] * generalized_mass(&structural, element);
                    }
                    MemberKind::PointMass => {
                        let at_point = shapes.row(row);
                        sum += condensed.point_mass[(row, row)] * at_point.tr_mul(&at_point);
                    }
                }
            }
            match members.kind {
                MemberKind::Stiffness => Share::Stiffness(sum),
                MemberKind::ElementMass | MemberKind::PointMass => Share::Mass(sum),
            }
        };
        self.members.iter().map(of_parameter).collect()
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: what the loops are handed.
    ///
    /// It takes the lowest `analysis_modes` modes, or as many as there are dynamic DOF.
    ///
    /// # Errors
    /// Those of [`Self::condense`] and [`ModalModel::new`].
    pub fn analyze(&self, factors: &[f64], test: &ModeSet, analysis_modes: Option<usize>) -> Result<ModalModel, Error> {
        let condensed = self.condense(factors)?;
        let through = |shapes: &DMatrix<f64>| self.shares(&condensed, shapes);
        ModalModel::new(&condensed.stiffness, &condensed.mass, test, analysis_modes, through)
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
