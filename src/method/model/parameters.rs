//! What a correlation may change: the stiffness of elements, their mass, or point masses, alone or in groups.

use crate::method::error::Error;
use crate::method::structure::Structure;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// A closed interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

impl Range {
    /// An interval of positive numbers.
    ///
    /// # Errors
    /// [`Error::Limits`] unless $0 < \text{lower} < \text{upper}$, both finite.
    pub fn positive(what: &str, lower: f64, upper: f64) -> Result<Self, Error> {
        if lower > 0.0 && upper > lower && upper.is_finite() {
            Ok(Self { lower, upper })
        } else {
            Err(Error::Limits { what: what.to_owned(), lower, upper })
        }
    }

    /// Whether a number lies in the interval.
    pub fn contains(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }

    /// The nearest number in the interval; unlike [`f64::clamp`] no interval makes it panic.
    pub(crate) fn clamp(&self, value: f64) -> f64 {
        if value < self.lower {
            self.lower
        } else if value > self.upper {
            self.upper
        } else {
            value
        }
    }
}

/// What a parameter scales.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Scaled {
    /// The stiffness (gage, area) of elements, by their labels.
    Stiffness(Vec<usize>),
    /// The mass of elements, by their labels; their stiffness stays.
    ElementMass(Vec<usize>),
    /// The mass at dynamic DOF, by their index from zero; it may not be coupled to other DOF in the given $M$.
    PointMass(Vec<usize>),
}

/// A set of elements or masses that are scaled together: one element, or a substructure.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// What it is called in reports.
    pub name: String,
    /// What it scales.
    pub scaled: Scaled,
    /// Bounds on the gages (in) or areas (in²) of its elements, if any; for stiffness alone.
    pub size_range: Option<Range>,
    /// Bounds on the factor on its first value, if any.
    pub factor_range: Option<Range>,
}

impl Parameter {
    /// The stiffness of one element, named by its number.
    pub fn element(label: usize, size_range: Option<Range>) -> Self {
        Self { size_range, ..Self::of(&label.to_string(), Scaled::Stiffness(vec![label])) }
    }

    /// The stiffness of a group of elements.
    pub fn group(name: &str, elements: &[usize]) -> Self {
        Self::of(name, Scaled::Stiffness(elements.to_vec()))
    }

    /// Anything, without bounds.
    pub fn of(name: &str, scaled: Scaled) -> Self {
        Self { name: name.to_owned(), scaled, size_range: None, factor_range: None }
    }
}

/// A parameter's members as rows: of the structure's elements, or of the dynamic DOF.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Members {
    /// The rows.
    pub rows: Vec<usize>,
    /// What kind of thing they are rows of.
    pub kind: MemberKind,
}

/// What a parameter's rows are rows of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum MemberKind {
    /// Elements, for their stiffness.
    Stiffness,
    /// Elements, for their mass.
    ElementMass,
    /// Dynamic DOF.
    PointMass,
}

/// Rows of every parameter's members; nothing is in two parameters of one kind.
///
/// # Errors
/// [`Error::Empty`] without parameters or members; [`Error::Unknown`] and
/// [`Error::SharedElement`] naming the offender.
pub(crate) fn resolve(
    structure: &Structure,
    dynamic_dof: usize,
    parameters: &[Parameter],
) -> Result<Vec<Members>, Error> {
    if parameters.is_empty() {
        return Err(Error::Empty { what: "parameters" });
    }
    let elements = structure.elements().iter().enumerate();
    let row_of: HashMap<usize, usize> = elements.map(|(row, element)| (element.label, row)).collect();
    let mut owner: HashMap<(MemberKind, usize), &str> = HashMap::new();
    let mut resolved = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let (kind, members) = match &parameter.scaled {
            Scaled::Stiffness(members) => (MemberKind::Stiffness, members),
            Scaled::ElementMass(members) => (MemberKind::ElementMass, members),
            Scaled::PointMass(members) => (MemberKind::PointMass, members),
        };
        if members.is_empty() {
            return Err(Error::Empty { what: "members of a parameter" });
        }
        let mut rows = Vec::with_capacity(members.len());
        for &member in members {
            let name = || parameter.name.clone();
            let unknown = |what| Error::Unknown { owner: format!("parameter {}", name()), what, label: member };
            let row = match kind {
                MemberKind::PointMass if member < dynamic_dof => member,
                MemberKind::PointMass => return Err(unknown("dynamic degree of freedom")),
                _ => *row_of.get(&member).ok_or_else(|| unknown("element"))?,
            };
            if let Some(first) = owner.insert((kind, row), &parameter.name) {
                return Err(Error::SharedElement { element: member, first: first.to_owned(), second: name() });
            }
            rows.push(row);
        }
        resolved.push(Members { rows, kind });
    }
    Ok(resolved)
}
