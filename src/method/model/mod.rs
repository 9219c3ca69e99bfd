//! The finite element model as the correlation sees it: a structure, its dynamic points, and what may change.
//! Tour: [chapter 10](crate::tour::chapter_10_own_structure).

mod analysis;
mod modal;
mod parameters;

pub use analysis::CondensedModel;
pub use modal::{DynamicModel, ExactResult, LoneFrequency, ModalModel, Pair, ParameterMatrix};
pub(crate) use modal::{HALF_THE_DIGITS, check_weights};
pub use parameters::{Bounds, Parameter, Scaled};

use crate::method::assembly::{ElementMatrix, element_matrices};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_finite, check_length, check_matrix, check_shape, check_symmetric, cholesky,
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
/// therefore a statement about stiffness and does not make the element heavier. [`Self::at`] follows this law, and so
/// does whatever is made of it: analyses, decks, reports.
#[derive(Debug, Clone)]
pub struct ScaledStructure {
    structure: Structure,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    /// Rows of every parameter's members among the elements or the dynamic DOF.
    rows: Vec<Vec<usize>>,
}

/// What the parameters scale, at some factors: see [`ScaledStructure::at`].
#[derive(Debug, Clone)]
pub struct ScaledSizes {
    /// Gage (in) or area (in²) of every element for its stiffness, in the structure's order.
    pub sizes: Vec<f64>,
    /// The same for its mass: its first size times the factor of a mass parameter.
    pub mass_sizes: Vec<f64>,
    /// The dynamic mass $M$ without that of elements, lbf·s²/in (d × d).
    pub point_masses: DMatrix<f64>,
    /// Mean size of every stiffness parameter's elements; [`REFERENCE_GAGE`] for other parameters.
    pub mean_sizes: Vec<f64>,
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
/// let areas = model.at(&result.best_factors)?.sizes;
/// assert!((areas[0] - 0.08).abs() < 0.001 && (areas[1] - 0.12).abs() < 0.001);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FiniteElementModel {
    scaled: ScaledStructure,
    element_matrices: Vec<ElementMatrix>,
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
    /// [`Error::WrongShape`] and [`Error::NotFinite`] for $T$; [`Error::NotFinite`] for an element's stiffness; those of
    /// [`ScaledStructure::new`].
    pub fn new(
        structure: Structure,
        load_distribution: DMatrix<f64>,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        let (free, dynamic) = (structure.free_dof().len(), load_distribution.ncols());
        at_least_one("dynamic degrees of freedom", dynamic)?;
        check_matrix("load distribution", &load_distribution, free, dynamic)?;
        check_shape("dynamic mass", &mass, dynamic, dynamic)?;
        let scaled = ScaledStructure::new(structure, mass, parameters)?;
        let element_matrices = element_matrices(&scaled.structure);
        for element in &element_matrices {
            check_finite("element stiffness", &element.unit)
                .map_err(|error| error.in_element(element.label))?;
        }
        Ok(Self {
            scaled,
            element_matrices,
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
        for (element, unit) in model.element_matrices.iter_mut().zip(units) {
            let dof_count = element.dof.len();
            check_shape("element stiffness", &unit, dof_count, dof_count)?;
            check_symmetric("element stiffness", &unit)?;
            element.unit = unit;
        }
        Ok(model)
    }

    /// Unit matrices of the elements at the free DOF.
    pub fn element_matrices(&self) -> &[ElementMatrix] {
        &self.element_matrices
    }

    /// The load distribution $T$ (free SDOF × d).
    pub fn load_distribution(&self) -> &DMatrix<f64> {
        &self.load_distribution
    }
}

impl ScaledStructure {
    /// A structure with the mass of its dynamic points (d × d, lbf·s²/in) and parameters.
    ///
    /// # Errors
    /// Those of [`check_symmetric`] and, without elements that have mass, [`cholesky`] for the mass; [`Error::Empty`],
    /// [`Error::Unknown`], [`Error::SharedElement`], [`Error::CoupledMass`] for bad parameters.
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
        Ok(Self {
            structure,
            mass,
            parameters,
            rows,
        })
    }

    /// The structure with its first sizes.
    pub fn structure(&self) -> &Structure {
        &self.structure
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
    pub fn factor_ranges(&self) -> Result<Vec<Option<Bounds>>, Error> {
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
            let factors = Bounds::positive(&what, lower, upper)?;
            if factors.contains(1.0) {
                Ok(Some(factors))
            } else {
                Err(Error::StartOutside { what, lower, upper })
            }
        };
        self.parameters.iter().zip(&self.rows).map(bounds).collect()
    }

    /// Sizes and masses at the given parameter factors, one each.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for another number of factors; [`Error::NotPositive`] for a factor that is not;
    /// [`Error::NotFinite`] for what it takes beyond the largest number.
    pub fn at(&self, factors: &[f64]) -> Result<ScaledSizes, Error> {
        check_length("parameter factors", factors.len(), self.parameters.len())?;
        let elements = self.structure.elements().iter();
        let mut sizes: Vec<f64> = elements.map(|element| element.size).collect();
        let (mut mass_sizes, mut point_masses) = (sizes.clone(), self.mass.clone());
        for ((parameter, rows), &factor) in self.parameters.iter().zip(&self.rows).zip(factors) {
            positive("factor", || parameter.owner(), factor)?;
            for &row in rows {
                let scaled = match parameter.scaled {
                    Scaled::Stiffness => &mut sizes[row],
                    Scaled::ElementMass => &mut mass_sizes[row],
                    Scaled::PointMass => &mut point_masses[(row, row)],
                };
                *scaled *= factor;
                check_finite(
                    "scaled sizes or masses",
                    &DMatrix::from_element(1, 1, *scaled),
                )?;
            }
        }
        let mean = |(parameter, rows): (&Parameter, &Vec<usize>)| match parameter.scaled {
            Scaled::Stiffness => {
                rows.iter().map(|&row| sizes[row]).sum::<f64>() / rows.len() as f64
            }
            Scaled::ElementMass | Scaled::PointMass => REFERENCE_GAGE,
        };
        let mean_sizes = self.parameters.iter().zip(&self.rows).map(mean).collect();
        Ok(ScaledSizes {
            sizes,
            mass_sizes,
            point_masses,
            mean_sizes,
        })
    }

    /// Every parameter's share seen through shapes at the dynamic DOF (d × m), from what `stiffness` and `mass` make of elements,
    /// by row, with their sizes; of point masses from their rows of the shapes.
    pub(crate) fn shares(
        &self,
        at: &ScaledSizes,
        shapes: &DMatrix<f64>,
        stiffness: impl Fn(&[(usize, f64)]) -> DMatrix<f64>,
        mass: impl Fn(&[(usize, f64)]) -> DMatrix<f64>,
    ) -> Vec<ParameterMatrix> {
        let of_parameter = |(parameter, rows): (&Parameter, &Vec<usize>)| {
            let members = |sizes: &[f64]| -> Vec<(usize, f64)> {
                rows.iter().map(|&row| (row, sizes[row])).collect()
            };
            let point = |&row: &usize| {
                at.point_masses[(row, row)] * shapes.row(row).tr_mul(&shapes.row(row))
            };
            match parameter.scaled {
                Scaled::Stiffness => ParameterMatrix::Stiffness(stiffness(&members(&at.sizes))),
                Scaled::ElementMass => ParameterMatrix::Mass(mass(&members(&at.mass_sizes))),
                Scaled::PointMass => ParameterMatrix::Mass(rows.iter().map(point).sum()),
            }
        };
        let parameters = self.parameters.iter();
        parameters.zip(&self.rows).map(of_parameter).collect()
    }
}
