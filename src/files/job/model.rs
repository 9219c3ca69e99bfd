//! The model that a job names, as matrices at all degrees of freedom, and where these are.

use super::matrices::from_matrices;
use super::{Job, ParameterRule, Scales, labels};
use crate::files::deck::{self, Deck};
use crate::files::error::FileError;
use crate::method::assembly::element_matrices;
use crate::method::error::Error;
use crate::method::model::Range;
use crate::method::structure::StructuralDof;
use crate::studies::whole_model::elements::{mass_entries, moving_mass_entries, stiffness_entries};
use crate::studies::whole_model::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Where a model's grids are, and which of them elements join.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Geometry {
    /// The place of every grid that has one, in units of length.
    pub places: BTreeMap<usize, Vector3<f64>>,
    /// The corners of every element, by grid.
    pub elements: Vec<Vec<usize>>,
}

/// A model and what its degrees of freedom are.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelSource {
    /// Its matrices.
    pub whole: WholeModel,
    /// Its grids.
    pub geometry: Geometry,
    /// By grid and direction (0 to 5) of every degree of freedom that moves: the model's rows and their coefficients.
    pub motions: BTreeMap<(usize, usize), Vec<(usize, f64)>>,
    /// The deck's bytes and what was read of them, if it is one.
    pub deck: Option<(Vec<u8>, Deck)>,
    /// Of a deck, the elements that every parameter scales.
    pub members: Vec<Vec<usize>>,
}

/// Reads the model of a job; paths are relative to the job's own folder.
///
/// # Errors
/// Those of the files read; [`FileError::Job`] for a job that names no model, two, or parameters that do not fit it;
/// those of [`WholeModel::new`].
pub fn load(path: &Path, job: &Job) -> Result<ModelSource, FileError> {
    let files = &job.model;
    if job.parameters.is_empty() {
        return Err(FileError::job(path, "at least one [[parameter]]", "none"));
    }
    let what = "either model.deck, or model.stiffness and model.mass";
    match (&files.deck, &files.stiffness, &files.mass) {
        (Some(deck), None, None) => from_deck(path, job, &beside(path, deck)),
        (None, Some(stiffness), Some(mass)) => from_matrices(path, job, stiffness, mass),
        (None, None, None) => Err(FileError::job(path, what, "neither")),
        (Some(_), ..) => Err(FileError::job(path, what, "a deck and matrices")),
        _ => Err(FileError::job(path, what, "one matrix alone")),
    }
}

/// A path that a job names, from the job's own folder.
pub fn beside(job: &Path, named: &Path) -> PathBuf {
    job.parent().map_or_else(|| named.to_owned(), |folder| folder.join(named))
}

fn from_deck(path: &Path, job: &Job, file: &Path) -> Result<ModelSource, FileError> {
    let bytes = std::fs::read(file).map_err(FileError::of_file(file, "read"))?;
    let ignored: Vec<String> = job.model.ignore.iter().map(|card| card.trim().to_ascii_uppercase()).collect();
    let deck = deck::read_without(&file.display().to_string(), &bytes, &ignored)?;
    let bulk = &deck.model;
    let structure = bulk.structure()?;
    let elements = element_matrices(&structure)?;
    let count = structure.free_dof().len();
    let row_of: BTreeMap<usize, usize> = elements.iter().enumerate().map(|(row, e)| (e.label, row)).collect();
    let stiffness_of = |rows: &[usize]| {
        sum_of(count, rows.iter().flat_map(|&row| stiffness_entries(&elements[row], bulk.elements[row].size)))
    };
    let all: Vec<usize> = (0..elements.len()).collect();
    let moving = bulk.moving_masses(&structure, &elements)?;
    let mass =
        sum_of(count, moving.iter().flat_map(|point| moving_mass_entries(&point.motion, &point.motion, point.mass)))?;
    let motion_of = bulk.motions(&structure);
    let (mut parameters, mut members, mut owner) = (Vec::new(), Vec::new(), BTreeMap::new());
    for rule in &job.parameters {
        if rule.matrix.is_some() {
            return Err(FileError::job(path, "parameters of a deck by elements or masses", "a matrix"));
        }
        for (name, labels, points) in groups(path, rule, &deck)? {
            let unknown = |label: &&usize| !row_of.contains_key(*label);
            if let Some(label) = labels.iter().find(unknown) {
                return Err(FileError::job(
                    path,
                    format!("elements of the deck in parameter {name}"),
                    label.to_string(),
                ));
            }
            for &element in &labels {
                if let Some(first) = owner.insert((rule.scales == Scales::Mass, element), name.clone()) {
                    return Err(Error::SharedElement { element, first, second: name }.into());
                }
            }
            let rows: Vec<usize> = labels.iter().map(|label| row_of[label]).collect();
            let share = match rule.scales {
                Scales::Stiffness if !points.is_empty() => {
                    return Err(FileError::job(
                        path,
                        "scales = \"mass\" for point masses",
                        format!("stiffness in parameter {name}"),
                    ));
                }
                Scales::Stiffness => WholeShare::Stiffness(stiffness_of(&rows)?),
                Scales::Mass => {
                    let lumped = rows.iter().flat_map(|&row| mass_entries(&elements[row], bulk.elements[row].size));
                    let mut entries: Vec<_> = lumped.collect();
                    for point in &points {
                        let expected = || format!("point masses of the deck in parameter {name}");
                        let unknown = || FileError::job(path, expected(), point.to_string());
                        let point = bulk.masses.iter().find(|mass| mass.label == *point).ok_or_else(unknown)?;
                        for direction in (0..3).filter(|d| point.direction.is_none_or(|own| own == *d)) {
                            let motion = motion_of(StructuralDof { grid: point.grid, direction });
                            entries.extend(moving_mass_entries(&motion, &motion, point.mass));
                        }
                    }
                    WholeShare::Mass(sum_of(count, entries.into_iter())?)
                }
            };
            let sizes: Vec<f64> = rows.iter().map(|&row| bulk.elements[row].size).collect();
            parameters.push(WholeParameter { name, share, range: range(path, rule, &sizes)? });
            members.push(labels);
        }
    }
    let whole = WholeModel::new(stiffness_of(&all)?, mass, parameters)?;
    let grids = bulk.grids.iter();
    let motions = grids.clone().flat_map(|grid| (0..3).map(move |direction| (grid.label, direction)));
    let motions = motions.map(|at| (at, motion_of(StructuralDof { grid: at.0, direction: at.1 })));
    let motions = motions.filter(|(_, motion)| !motion.is_empty()).collect();
    let geometry = Geometry {
        places: grids.map(|grid| (grid.label, grid.position)).collect(),
        elements: bulk.elements.iter().map(|element| element.grids.clone()).collect(),
    };
    drop(motion_of);
    Ok(ModelSource { whole, geometry, motions, members, deck: Some((bytes, deck)) })
}

/// A parameter of a deck: its name, elements and point masses.
type Group = (String, Vec<usize>, Vec<usize>);

/// The parameters that a rule makes of a deck.
fn groups(path: &Path, rule: &ParameterRule, deck: &Deck) -> Result<Vec<Group>, FileError> {
    let mut elements: BTreeSet<usize> = labels(path, &rule.elements)?.into_iter().collect();
    let is_of = |m: &deck::Membership| {
        m.property.is_some_and(|p| rule.properties.contains(&p)) || rule.materials.contains(&m.material)
    };
    elements.extend(deck.members.iter().filter(|(_, membership)| is_of(membership)).map(|(label, _)| *label));
    let (has, name) = (|is: &dyn Fn(&deck::Membership) -> bool| deck.members.iter().any(|(_, m)| is(m)), &rule.name);
    let property = rule.properties.iter().find(|p| !has(&|m| m.property == Some(**p)));
    let material = rule.materials.iter().find(|own| !has(&|m| m.material == **own));
    if let Some(label) = property.or(material) {
        let expected = format!("properties and materials of the deck's elements in parameter {name}");
        return Err(FileError::job(path, expected, label.to_string()));
    }
    let masses: BTreeSet<usize> = labels(path, &rule.masses)?.into_iter().collect();
    let elements: Vec<usize> = elements.into_iter().collect();
    if elements.is_empty() && masses.is_empty() {
        return Err(FileError::job(path, format!("elements or masses in parameter {name}"), "none that the deck has"));
    }
    if !rule.each {
        return Ok(vec![(name.clone(), elements, masses.into_iter().collect())]);
    }
    let of_elements = elements.into_iter().map(|label| (format!("{name} {label}"), vec![label], Vec::new()));
    let of_masses = masses.into_iter().map(|label| (format!("{name} mass {label}"), Vec::new(), vec![label]));
    Ok(of_elements.chain(of_masses).collect())
}

/// The bounds on a parameter's factor: its own, and those that keep elements of the given first sizes within its bounds on these.
pub(super) fn range(path: &Path, rule: &ParameterRule, sizes: &[f64]) -> Result<Option<Range>, FileError> {
    let name = &rule.name;
    let both = |names: [&str; 2], bounds: [Option<f64>; 2], what: &str| match bounds {
        [None, None] => Ok(None),
        [Some(lower), Some(upper)] => Ok(Some(Range::positive(&format!("{what} of parameter {name}"), lower, upper)?)),
        _ => Err(FileError::job(path, format!("both {} in parameter {name}", names.join(" and ")), "one of them")),
    };
    let own = both(["lower", "upper"], [rule.lower, rule.upper], "factor")?;
    let Some(of_sizes) = both(["lower_size", "upper_size"], [rule.lower_size, rule.upper_size], "sizes")? else {
        return Ok(own);
    };
    if sizes.is_empty() || rule.scales == Scales::Mass {
        let expected = format!("the stiffness of a deck's elements where parameter {name} has bounds on sizes");
        return Err(FileError::job(path, expected, "another"));
    }
    let (lower, upper) = own.map_or((0.0, f64::INFINITY), |own| (own.lower, own.upper));
    let lower = sizes.iter().fold(lower, |lower, size| lower.max(of_sizes.lower / size));
    let upper = sizes.iter().fold(upper, |upper, size| upper.min(of_sizes.upper / size));
    Ok(Some(Range::positive(&format!("factor of parameter {name}"), lower, upper)?))
}

fn sum_of(count: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Result<SparseMatrix, FileError> {
    Ok(SparseMatrix::new("matrix of elements", count, count, entries.collect())?)
}
