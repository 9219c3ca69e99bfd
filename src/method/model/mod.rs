//! The finite element model as the correlation sees it: a structure, its dynamic points, and what may change.
//! Tour: [chapter 10](crate::tour::chapter_10_own_structure).

mod analysis;
mod modal;
mod parameters;

pub use analysis::CondensedModel;
pub(crate) use modal::check_weights;
pub use modal::{Check, DynamicModel, ModalModel, Pair, Share};
pub use parameters::{Parameter, Range, Scaled};

use crate::method::assembly::{ElementMatrix, element_matrices};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_finite, check_length, check_shape, check_symmetric, cholesky, finite_list,
};
use crate::method::structure::{Structure, positive};
use nalgebra::DMatrix;
use parameters::member_rows;
use std::ops::Deref;

/// Gage in which a change of gage is measured by the step, in.
pub const REFERENCE_GAGE: f64 = 0.01;

/// A structure, the mass of its dynamic points, and what may change of both.
///
/// A stiffness parameter scales stiffness alone. An element keeps the mass of its first size, times the factor of a mass
/// parameter if there is one: in the paper, too, the mass is known and never changes. A gage that a correlation finds is
/// therefore a statement about stiffness and does not make the element heavier. [`Self::sizes`], [`Self::mass_sizes`] and
/// [`Self::point_masses`] follow this law, and so does whatever is made of them: analyses, decks, reports.
#[derive(Debug, Clone)]
pub struct ScaledStructure {
    structure: Structure,
    element_matrices: Vec<ElementMatrix>,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    /// Rows of every parameter's members among the elements or the dynamic DOF.
    rows: Vec<Vec<usize>>,
}

/// A [`ScaledStructure`] with its load distribution $T$ (A.3): what an analysis needs.
///
/// # Example
///
/// Two rods whose areas a test knows better:
///
/// ```rust
/// use corfem::method::model::{FiniteElementModel, Parameter};
/// use corfem::method::modes::ModeSet;
/// use corfem::method::outer_loop::{Settings, correlate};
/// use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
/// use nalgebra::{DMatrix, Vector3, dmatrix};
///
/// // Two rods end to end from a wall, 10 in each, free to move along x.
/// let material = Material::isotropic(1.0e7, 0.3)?;
/// let grids = [1, 2, 3].map(|label| {
///     Grid { label, position: Vector3::new(10.0 * label as f64, 0.0, 0.0), constrained: [label == 1, true, true] }
/// });
/// let rods = [1, 2].map(|label| {
///     Element { label, kind: ElementKind::Rod, grids: vec![label, label + 1], size: 0.1, material }
/// });
/// let structure = Structure::new(grids.to_vec(), rods.to_vec())?;
/// let t = DMatrix::identity(2, 2); // measured are the structure's own two DOF
/// let mass = DMatrix::from_diagonal_element(2, 2, 0.01);
/// let parameters = [1, 2].map(|rod| Parameter::element(rod, None));
/// let model = FiniteElementModel::new(structure, t, mass, parameters.to_vec())?;
///
/// // Frequencies in hertz; shapes of any scale, one a column.
/// let test = ModeSet::from_measured(&[291.340, 851.875], &dmatrix![0.7208, 1.0; 1.0, -0.7208])?;
/// let limits = model.factor_ranges()?;
/// let settings = Settings { error_sum_tolerance: 0.005, later_inner_tolerance: 0.002, ..Settings::default() };
/// let result = correlate(|factors| model.analyze(factors, &test, None), &limits, &settings, |_, _| {})?;
/// let areas = model.sizes(&result.best_factors)?;
/// assert!((areas[0] - 0.08).abs() < 0.001 && (areas[1] - 0.12).abs() < 0.001);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FiniteElementModel {
    scaled: ScaledStructure,
    load_distribution: DMatrix<f64>,
}

impl Deref for FiniteElementModel {
    type Target = ScaledStructure;

    fn deref(&self) -> &ScaledStructure {
        &self.scaled
    }
}

impl FiniteElementModel {
    /// Puts a model together and forms every unit element matrix, once.
    ///
    /// `load_distribution` is $T$ (free SDOF × d), `mass` the dynamic mass $M$ (d × d, lbf·s²/in) beside what elements
    /// with a density add to it.
    ///
    /// # Errors
    /// [`Error::WrongShape`] and [`Error::NotFinite`] for $T$; those of [`ScaledStructure::new`].
    pub fn new(
        structure: Structure,
        load_distribution: DMatrix<f64>,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        let (free, dynamic) = (structure.free_dof().len(), load_distribution.ncols());
        at_least_one("dynamic degrees of freedom", dynamic)?;
        check_shape("load distribution", &load_distribution, free, dynamic)?;
        check_finite("load distribution", &load_distribution)?;
        check_shape("dynamic mass", &mass, dynamic, dynamic)?;
        let scaled = ScaledStructure::new(structure, mass, parameters)?;
        Ok(Self {
            scaled,
            load_distribution,
        })
    }

    /// The same model with element matrices of another origin, such as another program's: stiffness for unit size at each
    /// element's free DOF, lbf/in, in the structure's order.
    ///
    /// # Errors
    /// Those of [`check_length`] for their number, of [`check_shape`] and [`check_symmetric`] for each.
    pub fn with_unit_stiffness(&self, units: Vec<DMatrix<f64>>) -> Result<Self, Error> {
        check_length("element matrices", units.len(), self.element_matrices.len())?;
        let mut model = self.clone();
        for (element, unit) in model.scaled.element_matrices.iter_mut().zip(units) {
            let dof_count = element.dof.len();
            check_shape("element stiffness", &unit, dof_count, dof_count)?;
            check_symmetric("element stiffness", &unit)?;
            element.unit = unit;
        }
        Ok(model)
    }

    /// The load distribution $T$ (free SDOF × d).
    pub fn load_distribution(&self) -> &DMatrix<f64> {
        &self.load_distribution
    }
}

impl ScaledStructure {
    /// A structure with the mass of its dynamic points (d × d, lbf·s²/in) and parameters; forms every unit element matrix, once.
    ///
    /// # Errors
    /// Those of [`check_symmetric`] and, without elements that have mass, [`cholesky`] for the mass; those of the elements'
    /// geometry; [`Error::Empty`], [`Error::Unknown`], [`Error::SharedElement`], [`Error::CoupledMass`] for bad parameters.
    pub fn new(
        structure: Structure,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        let dof_count = mass.nrows();
        check_symmetric("dynamic mass", &mass)?;
        if structure
            .elements()
            .iter()
            .all(|element| element.material.density == 0.0)
        {
            cholesky("dynamic mass", &mass, 0.0)?;
        }
        let rows = member_rows(&structure, dof_count, &parameters)?;
        for (parameter, rows) in parameters.iter().zip(&rows) {
            // The diagonal entry of a point mass alone is scaled, so it must be the whole of the mass.
            let coupled =
                |dof: usize| (0..dof_count).any(|other| other != dof && mass[(dof, other)] != 0.0);
            if let Some(&dof) = rows
                .iter()
                .find(|&&row| parameter.scaled == Scaled::PointMass && coupled(row))
            {
                return Err(Error::CoupledMass(dof));
            }
        }
        let element_matrices = element_matrices(&structure)?;
        Ok(Self {
            structure,
            element_matrices,
            mass,
            parameters,
            rows,
        })
    }

    /// The structure with its first sizes.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Unit matrices of the elements at the free DOF.
    pub fn element_matrices(&self) -> &[ElementMatrix] {
        &self.element_matrices
    }

    /// The dynamic mass $M$, lbf·s²/in (d × d).
    pub fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// What may change.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Rows of every parameter's members among the elements or the dynamic DOF.
    pub(crate) fn rows(&self) -> &[Vec<usize>] {
        &self.rows
    }

    /// Bounds on each parameter's factor: its own, and those that keep all its elements within its size bounds.
    ///
    /// # Errors
    /// [`Error::Limits`] when no factor meets both, or when the first sizes lie outside.
    pub fn factor_ranges(&self) -> Result<Vec<Option<Range>>, Error> {
        let bounds = |(parameter, rows): (&Parameter, &Vec<usize>)| {
            // A mass has no size: its rows may be those of points.
            let sizes = parameter
                .size_range
                .filter(|_| parameter.scaled == Scaled::Stiffness);
            let own = parameter.factor_range;
            if sizes.is_none() && own.is_none() {
                return Ok(None);
            }
            let (mut lower, mut upper) =
                own.map_or((0.0, f64::INFINITY), |range| (range.lower, range.upper));
            if let Some(range) = sizes {
                for &row in rows {
                    let size = self.structure.elements()[row].size;
                    lower = lower.max(range.lower / size);
                    upper = upper.min(range.upper / size);
                }
            }
            let what = format!("factor of {}", parameter.owner());
            let factors = Range::positive(&what, lower, upper)?;
            if factors.contains(1.0) {
                Ok(Some(factors))
            } else {
                Err(Error::StartOutside { what, lower, upper })
            }
        };
        self.parameters.iter().zip(&self.rows).map(bounds).collect()
    }

    /// Gage or area of every element for its stiffness at the given parameter factors, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; [`Error::NotPositive`] for a factor that is not.
    pub fn sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        self.scaled(self.first_sizes(), Scaled::Stiffness, factors)
    }

    /// The same for its mass: the first size times the factors of mass parameters alone.
    ///
    /// # Errors
    /// Those of [`Self::sizes`].
    pub fn mass_sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        self.scaled(self.first_sizes(), Scaled::ElementMass, factors)
    }

    /// The dynamic mass $M$ without that of elements at the given parameter factors, lbf·s²/in (d × d).
    ///
    /// # Errors
    /// Those of [`Self::sizes`].
    pub fn point_masses(&self, factors: &[f64]) -> Result<DMatrix<f64>, Error> {
        let ones = vec![1.0; self.mass.nrows()];
        let mut mass = self.mass.clone();
        for (dof, factor) in self
            .scaled(ones, Scaled::PointMass, factors)?
            .iter()
            .enumerate()
        {
            mass[(dof, dof)] *= factor;
        }
        Ok(mass)
    }

    fn first_sizes(&self) -> Vec<f64> {
        self.structure
            .elements()
            .iter()
            .map(|element| element.size)
            .collect()
    }

    /// `values` times the factors of the parameters that scale them.
    fn scaled(
        &self,
        mut values: Vec<f64>,
        scaled: Scaled,
        factors: &[f64],
    ) -> Result<Vec<f64>, Error> {
        check_length("parameter factors", factors.len(), self.parameters.len())?;
        for ((parameter, rows), &factor) in self.parameters.iter().zip(&self.rows).zip(factors) {
            positive("factor", || parameter.owner(), factor)?;
            if parameter.scaled == scaled {
                rows.iter().for_each(|&row| values[row] *= factor);
            }
        }
        finite_list("scaled sizes or masses", values)
    }

    /// Mean gage or area of every stiffness parameter's elements at the given factors; [`REFERENCE_GAGE`] for other parameters.
    pub(crate) fn mean_sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        let sizes = self.sizes(factors)?;
        let mean = |(parameter, rows): (&Parameter, &Vec<usize>)| match parameter.scaled {
            Scaled::Stiffness => {
                rows.iter().map(|&row| sizes[row]).sum::<f64>() / rows.len() as f64
            }
            Scaled::ElementMass | Scaled::PointMass => REFERENCE_GAGE,
        };
        Ok(self.parameters.iter().zip(&self.rows).map(mean).collect())
    }

    /// Every parameter's share seen through shapes at the dynamic DOF (d × m), from what `stiffness` and `mass` make of elements
    /// with their sizes; of point masses from their rows of the shapes.
    pub(crate) fn shares_of(
        &self,
        factors: &[f64],
        shapes: &DMatrix<f64>,
        stiffness: impl Fn(&[(&ElementMatrix, f64)]) -> DMatrix<f64>,
        mass: impl Fn(&[(&ElementMatrix, f64)]) -> DMatrix<f64>,
    ) -> Result<Vec<Share>, Error> {
        let (sizes, mass_sizes) = (self.sizes(factors)?, self.mass_sizes(factors)?);
        let points = self.point_masses(factors)?;
        let of_parameter = |(parameter, rows): (&Parameter, &Vec<usize>)| {
            let members = |sizes: &[f64]| -> Vec<(&ElementMatrix, f64)> {
                rows.iter()
                    .map(|&row| (&self.element_matrices[row], sizes[row]))
                    .collect()
            };
            let point =
                |&row: &usize| points[(row, row)] * shapes.row(row).tr_mul(&shapes.row(row));
            match parameter.scaled {
                Scaled::Stiffness => Share::Stiffness(stiffness(&members(&sizes))),
                Scaled::ElementMass => Share::Mass(mass(&members(&mass_sizes))),
                Scaled::PointMass => Share::Mass(rows.iter().map(point).sum()),
            }
        };
        Ok(self
            .parameters
            .iter()
            .zip(&self.rows)
            .map(of_parameter)
            .collect())
    }
}
