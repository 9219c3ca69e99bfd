//! The finite element model as the correlation sees it: a structure, its dynamic points, and what may change.

use crate::assembly::{ElementMatrix, FactorizedStiffness, element_matrices};
use crate::condensation::{condense, unit_share};
use crate::error::Error;
use crate::linalg::{check_finite, check_shape, cholesky};
use crate::modal::DynamicModel;
use crate::step::Range;
use crate::structure::Structure;
use nalgebra::DMatrix;
use std::collections::HashMap;

/// A set of elements whose stiffness is scaled together: one element, or a substructure.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// What it is called in reports.
    pub name: String,
    /// Labels of its elements.
    pub elements: Vec<usize>,
    /// Bounds on their gages (in) or areas (in²), if any.
    pub size_range: Option<Range>,
    /// Bounds on the factor on their first sizes, if any.
    pub factor_range: Option<Range>,
}

impl Parameter {
    /// One element on its own.
    pub fn element(label: usize, size_range: Option<Range>) -> Self {
        Self {
            name: label.to_string(),
            elements: vec![label],
            size_range,
            factor_range: None,
        }
    }
}

/// A structure with its dynamic degrees of freedom, mass, and parameters.
#[derive(Debug, Clone)]
pub struct FiniteElementModel {
    structure: Structure,
    element_matrices: Vec<ElementMatrix>,
    load_distribution: DMatrix<f64>,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    /// Row in the structure's elements of each parameter's elements.
    members: Vec<Vec<usize>>,
}

impl FiniteElementModel {
    /// Puts a model together and forms every unit element matrix, once.
    ///
    /// `load_distribution` is $T$ (free SDOF × d), `mass` the dynamic mass $M$ (d × d, lbf·s²/in).
    ///
    /// # Errors
    /// [`Error::WrongShape`], [`Error::NotFinite`] for bad matrices; [`Error::NotPositiveDefinite`] naming the DOF of a
    /// zero or negative mass; [`Error::Empty`] without parameters or for a parameter without elements;
    /// [`Error::UnknownElement`], [`Error::Limits`] for a bad parameter; the geometry errors of the elements.
    pub fn new(
        structure: Structure,
        load_distribution: DMatrix<f64>,
        mass: DMatrix<f64>,
        parameters: Vec<Parameter>,
    ) -> Result<Self, Error> {
        let dof_count = load_distribution.ncols();
        check_shape(
            "load distribution",
            &load_distribution,
            structure.free_dof().len(),
            dof_count,
        )?;
        check_finite("load distribution", &load_distribution)?;
        check_shape("dynamic mass", &mass, dof_count, dof_count)?;
        cholesky("dynamic mass", &mass, 0.0)?;
        let members = resolve(&structure, &parameters)?;
        Ok(Self {
            element_matrices: element_matrices(&structure)?,
            structure,
            load_distribution,
            mass,
            parameters,
            members,
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
        let bounds = |(parameter, members): (&Parameter, &Vec<usize>)| {
            if parameter.size_range.is_none() && parameter.factor_range.is_none() {
                return Ok(None);
            }
            let own = parameter.factor_range;
            let (mut lower, mut upper) =
                own.map_or((0.0, f64::INFINITY), |range| (range.lower, range.upper));
            if let Some(range) = parameter.size_range {
                for &row in members {
                    let size = self.structure.elements()[row].size;
                    lower = lower.max(range.lower / size);
                    upper = upper.min(range.upper / size);
                }
            }
            let what = format!("factor of parameter {}", parameter.name);
            let factors = Range::positive(&what, lower, upper)?;
            if factors.contains(1.0) {
                Ok(Some(factors))
            } else {
                Err(Error::Limits { what, lower, upper })
            }
        };
        self.parameters
            .iter()
            .zip(&self.members)
            .map(bounds)
            .collect()
    }

    /// Gage or area of every element at the given parameter factors, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; [`Error::NotPositive`] for a factor that is not.
    pub fn sizes(&self, factors: &[f64]) -> Result<Vec<f64>, Error> {
        let given = DMatrix::from_column_slice(factors.len(), 1, factors);
        check_shape("parameter factors", &given, self.parameters.len(), 1)?;
        let elements = self.structure.elements();
        let mut sizes: Vec<f64> = elements.iter().map(|element| element.size).collect();
        for ((members, &factor), parameter) in
            self.members.iter().zip(factors).zip(&self.parameters)
        {
            let owner = || format!("parameter {}", parameter.name);
            crate::structure::positive("factor", owner, factor)?;
            for &row in members {
                sizes[row] *= factor;
            }
        }
        Ok(sizes)
    }

    /// The finite element analysis at the given parameter factors: $K_S$ anew, a new $B$, and with it $K_D$ and each
    /// parameter's present share, the sum of $s_e B K_e B^t$ over its elements.
    ///
    /// # Errors
    /// Those of [`Self::sizes`], [`FactorizedStiffness::new`] and [`condense`].
    pub fn analyze(&self, factors: &[f64]) -> Result<DynamicModel, Error> {
        let sizes = self.sizes(factors)?;
        let structural =
            FactorizedStiffness::new(&self.element_matrices, &sizes, self.structure.free_dof())?;
        let condensed = condense(&structural, &self.load_distribution)?;
        let dof_count = self.mass.nrows();
        let shares = self
            .members
            .iter()
            .map(|members| {
                let mut share = DMatrix::zeros(dof_count, dof_count);
                for &row in members {
                    share += sizes[row]
                        * unit_share(&condensed.transformation, &self.element_matrices[row]);
                }
                share
            })
            .collect();
        Ok(DynamicModel {
            stiffness: condensed.stiffness,
            mass: self.mass.clone(),
            shares,
        })
    }
}

/// Rows of every parameter's elements, each element in one parameter at most.
fn resolve(structure: &Structure, parameters: &[Parameter]) -> Result<Vec<Vec<usize>>, Error> {
    if parameters.is_empty() {
        return Err(Error::Empty { what: "parameters" });
    }
    let row_of: HashMap<usize, usize> = structure
        .elements()
        .iter()
        .enumerate()
        .map(|(row, element)| (element.label, row))
        .collect();
    let mut owner: HashMap<usize, &str> = HashMap::new();
    let mut members = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        if parameter.elements.is_empty() {
            return Err(Error::Empty {
                what: "elements of a parameter",
            });
        }
        let mut rows = Vec::with_capacity(parameter.elements.len());
        for &element in &parameter.elements {
            let Some(&row) = row_of.get(&element) else {
                return Err(Error::UnknownElement {
                    parameter: parameter.name.clone(),
                    element,
                });
            };
            if let Some(first) = owner.insert(element, &parameter.name) {
                return Err(Error::SharedElement {
                    element,
                    first: first.to_owned(),
                    second: parameter.name.clone(),
                });
            }
            rows.push(row);
        }
        members.push(rows);
    }
    Ok(members)
}
