//! The model that a job names, as matrices at all degrees of freedom, and where these are.

use super::{Job, ParameterRule, Scales, labels};
use crate::files::deck::{self, Deck};
use crate::files::error::FileError;
use crate::files::matrices::{self, LabeledMatrix};
use crate::files::test_data::DIRECTIONS;
use crate::method::assembly::element_matrices;
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
    let mass = sum_of(count, moving.iter().flat_map(|point| moving_mass_entries(&point.motion, point.mass)))?;
    let motion_of = bulk.motions(&structure);
    let (mut parameters, mut members) = (Vec::new(), Vec::new());
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
                        let point = bulk.masses.iter().find(|mass| mass.label == *point);
                        let point = point.ok_or_else(|| {
                            FileError::job(
                                path,
                                format!("point masses of the deck in parameter {name}"),
                                "another number",
                            )
                        })?;
                        for direction in (0..3).filter(|d| point.direction.is_none_or(|own| own == *d)) {
                            entries.extend(moving_mass_entries(
                                &motion_of(StructuralDof { grid: point.grid, direction }),
                                point.mass,
                            ));
                        }
                    }
                    WholeShare::Mass(sum_of(count, entries.into_iter())?)
                }
            };
            parameters.push(WholeParameter { name, share, range: range(path, rule)? });
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
    let masses = labels(path, &rule.masses)?;
    let (elements, name): (Vec<usize>, _) = (elements.into_iter().collect(), &rule.name);
    if elements.is_empty() && masses.is_empty() {
        return Err(FileError::job(path, format!("elements or masses in parameter {name}"), "none that the deck has"));
    }
    if !rule.each {
        return Ok(vec![(name.clone(), elements, masses)]);
    }
    let of_elements = elements.into_iter().map(|label| (format!("{name} {label}"), vec![label], Vec::new()));
    let of_masses = masses.into_iter().map(|label| (format!("{name} mass {label}"), Vec::new(), vec![label]));
    Ok(of_elements.chain(of_masses).collect())
}

fn range(path: &Path, rule: &ParameterRule) -> Result<Option<Range>, FileError> {
    match (rule.lower, rule.upper) {
        (None, None) => Ok(None),
        (Some(lower), Some(upper)) => {
            Ok(Some(Range::positive(&format!("factor of parameter {}", rule.name), lower, upper)?))
        }
        _ => Err(FileError::job(path, format!("both lower and upper in parameter {}", rule.name), "one of them")),
    }
}

fn sum_of(count: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Result<SparseMatrix, FileError> {
    Ok(SparseMatrix::new("matrix of elements", count, count, entries.collect())?)
}

fn from_matrices(path: &Path, job: &Job, stiffness: &Path, mass: &Path) -> Result<ModelSource, FileError> {
    let stiffness = matrix(path, stiffness)?;
    let mass = on_rows_of(&stiffness, matrix(path, mass)?)?;
    let count = stiffness.matrix.rows();
    let mut parameters = Vec::new();
    for rule in &job.parameters {
        let is_of_deck = !(rule.elements.is_empty()
            && rule.properties.is_empty()
            && rule.materials.is_empty()
            && rule.masses.is_empty());
        let file = rule.matrix.as_ref().filter(|_| !is_of_deck && !rule.each).ok_or_else(|| {
            FileError::job(
                path,
                format!("a matrix, and nothing of a deck, in parameter {}", rule.name),
                "no such entry",
            )
        })?;
        let matrix = on_rows_of(&stiffness, matrix(path, file)?)?;
        let share = match rule.scales {
            Scales::Stiffness => WholeShare::Stiffness(matrix),
            Scales::Mass => WholeShare::Mass(matrix),
        };
        parameters.push(WholeParameter { name: rule.name.clone(), share, range: range(path, rule)? });
    }
    let labels = stiffness.rows.clone();
    let whole = WholeModel::new(stiffness.matrix, mass, parameters)?;
    let (labels, places) = match (&job.model.rows, labels) {
        (Some(file), _) => rows(&beside(path, file))?,
        (None, Some(labels)) => {
            let component = |&(grid, component): &(usize, usize)| (grid, component.saturating_sub(1));
            (labels.iter().map(component).collect(), BTreeMap::new())
        }
        (None, None) => {
            return Err(FileError::job(path, "model.rows for matrices that do not name their rows", "none"));
        }
    };
    if labels.len() != count {
        return Err(FileError::job(
            path,
            format!("{count} rows in model.rows, one a row of the stiffness"),
            labels.len().to_string(),
        ));
    }
    let motions = labels.into_iter().enumerate().map(|(row, at)| (at, vec![(row, 1.0)])).collect();
    let geometry = Geometry { places, elements: Vec::new() };
    let members = vec![Vec::new(); whole.parameters().len()];
    Ok(ModelSource { whole, geometry, motions, members, deck: None })
}

/// A matrix of a file; behind a `#` in its name stands which of several.
fn matrix(path: &Path, file: &Path) -> Result<LabeledMatrix, FileError> {
    let text = file.to_string_lossy();
    let (file, wanted) = text.rsplit_once('#').map_or((&*text, None), |(file, name)| (file, Some(name)));
    let file = beside(path, Path::new(file));
    let bytes = std::fs::read(&file).map_err(FileError::of_file(&file, "read"))?;
    matrices::read(&file.display().to_string(), &bytes, wanted)
}

/// A matrix with its rows and columns in the order of the stiffness, where both name theirs.
fn on_rows_of(stiffness: &LabeledMatrix, other: LabeledMatrix) -> Result<SparseMatrix, FileError> {
    let (Some(expected), Some(found)) = (&stiffness.rows, &other.rows) else { return Ok(other.matrix) };
    let count = expected.len();
    let place_of: BTreeMap<_, usize> = expected.iter().enumerate().map(|(row, label)| (label, row)).collect();
    // A row that the stiffness does not have lies outside and is refused.
    let places: Vec<usize> = found.iter().map(|label| place_of.get(label).copied().unwrap_or(count)).collect();
    let entries = other.matrix.entries().iter().map(|&(row, column, value)| (places[row], places[column], value));
    Ok(SparseMatrix::new("matrix by labels", count, count, entries.collect())?)
}

/// Labels and places of a model's rows.
type Rows = (Vec<(usize, usize)>, BTreeMap<usize, Vector3<f64>>);

/// Reads a table `grid,direction,x,y,z`.
fn rows(file: &Path) -> Result<Rows, FileError> {
    let text = std::fs::read_to_string(file).map_err(FileError::of_file(file, "read"))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (mut labels, mut places) = (Vec::new(), BTreeMap::new());
    for (number, line) in lines {
        let cells: Vec<&str> = line.split([',', ';', '\t']).map(str::trim).collect();
        if labels.is_empty() && cells.first().is_some_and(|cell| cell.eq_ignore_ascii_case("grid")) {
            continue;
        }
        let wrong = || {
            FileError::job(file, "lines of grid, direction and perhaps x, y, z", format!("line {}: {line}", number + 1))
        };
        let grid: usize = cells.first().and_then(|cell| cell.parse().ok()).ok_or_else(wrong)?;
        let letters = cells.get(1).copied().unwrap_or_default();
        let direction = DIRECTIONS.iter().position(|name| *name == letters).ok_or_else(wrong)?;
        labels.push((grid, direction));
        let place: Vec<f64> =
            cells[2..].iter().filter(|cell| !cell.is_empty()).filter_map(|cell| cell.parse().ok()).collect();
        match place[..] {
            [x, y, z] if x.is_finite() && y.is_finite() && z.is_finite() => {
                places.insert(grid, Vector3::new(x, y, z));
            }
            [] if cells[2..].iter().all(|cell| cell.is_empty()) => {}
            _ => return Err(wrong()),
        }
    }
    Ok((labels, places))
}
