//! What a correlation may change: the stiffness of elements, their mass, or point masses, alone or in groups.

use crate::method::error::{Error, at_least_one};
use crate::method::structure::Structure;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// A closed interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

/// How near to an end of its range, relative, a factor counts as at its bound.
const AT_END: f64 = 1e-9;

impl Bounds {
    /// An interval of positive numbers.
    ///
    /// # Errors
    /// [`Error::Limits`] unless $0 < \text{lower} < \text{upper}$, both finite.
    pub fn positive(what: &str, lower: f64, upper: f64) -> Result<Self, Error> {
        let in_order = lower > 0.0 && upper > lower && upper.is_finite();
        if in_order {
            Ok(Self { lower, upper })
        } else {
            Err(Error::Limits {
                what: what.to_owned(),
                lower,
                upper,
            })
        }
    }

    /// Whether a number lies in the interval.
    pub fn contains(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }

    /// Whether a number is at an end of the interval, to round-off.
    pub(crate) fn has_end_at(&self, value: f64) -> bool {
        [self.lower, self.upper]
            .iter()
            .any(|end| (value / end - 1.0).abs() < AT_END)
    }

    /// The nearest number in the interval; unlike [`f64::clamp`] no interval makes it panic.
    pub(crate) fn clamp(&self, value: f64) -> f64 {
        // NaN stays NaN, which `max` would turn into a number.
        if value.is_nan() {
            value
        } else {
            value.max(self.lower).min(self.upper)
        }
    }
}

/// What a parameter scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scaled {
    /// The stiffness (gage, area) of elements, by their labels.
    Stiffness,
    /// The mass of elements, by their labels; their stiffness stays.
    ElementMass,
    /// The mass at dynamic DOF, by their index from zero; it may not be coupled to other DOF in the given $M$.
    PointMass,
}

/// A set of elements or masses that are scaled together: one element, or a substructure.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// What it is called in reports.
    pub name: String,
    /// What it scales.
    pub scaled: Scaled,
    /// Labels of the elements, or indices of the dynamic DOF, that it scales.
    pub members: Vec<usize>,
    /// Bounds on the gages (in) or areas (in²) of its elements, if any; for stiffness alone.
    pub size_range: Option<Bounds>,
    /// Bounds on the factor on its first value, if any.
    pub factor_range: Option<Bounds>,
}

impl Parameter {
    /// The stiffness of one element, named by its number.
    pub fn element(label: usize, size_range: Option<Bounds>) -> Self {
        Self {
            size_range,
            ..Self::group(&label.to_string(), &[label])
        }
    }

    /// The stiffness of a group of elements.
    pub fn group(name: &str, elements: &[usize]) -> Self {
        Self::of(name, Scaled::Stiffness, elements)
    }

    /// Anything, without bounds.
    pub fn of(name: &str, scaled: Scaled, members: &[usize]) -> Self {
        Self {
            name: name.to_owned(),
            scaled,
            members: members.to_vec(),
            size_range: None,
            factor_range: None,
        }
    }

    /// What the parameter is called in errors.
    pub(crate) fn owner(&self) -> String {
        format!("parameter {}", self.name)
    }
}

/// Every parameter's members as rows, of the structure's elements or of the dynamic DOF; refuses a member of two parameters that
/// scale the same of it.
pub(crate) fn member_rows<'a>(
    structure: &Structure,
    dynamic_dof: usize,
    parameters: &'a [Parameter],
) -> Result<Vec<Vec<usize>>, Error> {
    at_least_one("parameters", parameters.len())?;
    let elements = structure.elements().iter().enumerate();
    let row_of: HashMap<usize, usize> = elements
        .map(|(row, element)| (element.label, row))
        .collect();
    let mut first_with: HashMap<(Scaled, usize), &'a str> = HashMap::new();
    let rows_of = |parameter: &'a Parameter| {
        at_least_one("members of a parameter", parameter.members.len())?;
        let row = |&label: &usize| {
            let (what, row) = match parameter.scaled {
                Scaled::PointMass => (
                    "dynamic degree of freedom",
                    Some(label).filter(|&dof| dof < dynamic_dof),
                ),
                Scaled::Stiffness | Scaled::ElementMass => ("element", row_of.get(&label).copied()),
            };
            let row = row.ok_or_else(|| Error::Unknown {
                owner: parameter.owner(),
                what,
                label,
            })?;
            let Some(first) = first_with.insert((parameter.scaled, row), &parameter.name) else {
                return Ok(row);
            };
            Err(Error::SharedElement {
                element: label,
                first: first.to_owned(),
                second: parameter.name.clone(),
            })
        };
        parameter.members.iter().map(row).collect()
    };
    parameters.iter().map(rows_of).collect()
}
