//! A model given by matrices: its files, and which row is which degree of freedom.

use super::model::{Geometry, ModelSource, beside, range};
use super::{Job, Scales};
use crate::files::error::FileError;
use crate::files::matrices::{self, LabeledMatrix};
use crate::files::test_data::{DIRECTIONS, cells, separator};
use crate::studies::whole_model::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::path::Path;

/// The model of a job whose matrices these files hold.
pub(super) fn from_matrices(path: &Path, job: &Job, stiffness: &Path, mass: &Path) -> Result<ModelSource, FileError> {
    let stiffness = matrix(path, stiffness)?;
    let count = stiffness.matrix.rows();
    let component = |&(grid, component): &(usize, usize)| (grid, component.saturating_sub(1));
    let own: Option<Vec<_>> = stiffness.rows.as_ref().map(|labels| labels.iter().map(component).collect());
    let (labels, places) = match (&job.model.rows, &own) {
        (Some(file), _) => rows(&beside(path, file))?,
        (None, Some(labels)) => (labels.clone(), BTreeMap::new()),
        (None, None) => {
            return Err(FileError::job(path, "model.rows for matrices that do not name their rows", "none"));
        }
    };
    if labels.len() != count {
        let expected = format!("{count} rows in model.rows, one a row of the stiffness");
        return Err(FileError::job(path, expected, labels.len().to_string()));
    }
    if own.is_some_and(|own| own != labels) {
        return Err(FileError::job(path, "model.rows in the order of the stiffness, which names its own", "another"));
    }
    let row_of: BTreeMap<_, usize> = labels.iter().enumerate().map(|(row, label)| (*label, row)).collect();
    if row_of.len() != count {
        return Err(FileError::job(path, "every grid and direction in one row of the matrices", "one in two"));
    }
    let on_rows = |file: &Path| on_rows(path, file, &row_of, matrix(path, file)?);
    let mass = on_rows(mass)?;
    let mut parameters = Vec::new();
    for rule in &job.parameters {
        let is_of_deck = !(rule.elements.is_empty()
            && rule.properties.is_empty()
            && rule.materials.is_empty()
            && rule.masses.is_empty());
        let file = rule.matrix.as_ref().filter(|_| !is_of_deck && !rule.each).ok_or_else(|| {
            let found = if rule.matrix.is_none() { "no matrix" } else { "entries of a deck" };
            FileError::job(path, format!("a matrix, and nothing of a deck, in parameter {}", rule.name), found)
        })?;
        let matrix = on_rows(file)?;
        let share = match rule.scales {
            Scales::Stiffness => WholeShare::Stiffness(matrix),
            Scales::Mass => WholeShare::Mass(matrix),
        };
        parameters.push(WholeParameter { name: rule.name.clone(), share, range: range(path, rule, &[])? });
    }
    let whole = WholeModel::new(stiffness.matrix, mass, parameters)?;
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

/// A matrix with its rows and columns in the order of the stiffness, where it names its own.
fn on_rows(
    path: &Path,
    file: &Path,
    row_of: &BTreeMap<(usize, usize), usize>,
    matrix: LabeledMatrix,
) -> Result<SparseMatrix, FileError> {
    let Some(found) = &matrix.rows else { return Ok(matrix.matrix) };
    if matrix.columns != matrix.rows {
        let expected = format!("rows and columns of the same names in {}", file.display());
        return Err(FileError::job(path, expected, "others"));
    }
    let place = |&(grid, component): &(usize, usize)| {
        let at = (grid, component.saturating_sub(1));
        let unknown = || {
            let expected = format!("rows of the stiffness in {}", file.display());
            FileError::job(path, expected, format!("grid {grid} component {component}"))
        };
        row_of.get(&at).copied().ok_or_else(unknown)
    };
    let places = found.iter().map(place).collect::<Result<Vec<usize>, _>>()?;
    let entries = matrix.matrix.entries().iter().map(|&(row, column, value)| (places[row], places[column], value));
    Ok(SparseMatrix::new("matrix by labels", row_of.len(), row_of.len(), entries.collect())?)
}

/// Labels and places of a model's rows.
type Rows = (Vec<(usize, usize)>, BTreeMap<usize, Vector3<f64>>);

/// Reads a table `grid,direction,x,y,z`.
fn rows(file: &Path) -> Result<Rows, FileError> {
    let text = std::fs::read_to_string(file).map_err(FileError::of_file(file, "read"))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (mut labels, mut places) = (Vec::new(), BTreeMap::new());
    for (number, line) in lines {
        let cells = cells(line, separator(line));
        if labels.is_empty() && cells.first().is_some_and(|cell| cell.eq_ignore_ascii_case("grid")) {
            continue;
        }
        let wrong = || {
            FileError::job(file, "lines of grid, direction and perhaps x, y, z", format!("line {}: {line}", number + 1))
        };
        let grid: usize = cells.first().and_then(|cell| cell.parse().ok()).ok_or_else(wrong)?;
        let letters = cells.get(1).map_or("", String::as_str);
        let direction = DIRECTIONS.iter().position(|name| *name == letters).ok_or_else(wrong)?;
        labels.push((grid, direction));
        let place: Vec<Option<f64>> =
            cells[2..].iter().map(|cell| cell.parse().ok().filter(|number: &f64| number.is_finite())).collect();
        match place[..] {
            [Some(x), Some(y), Some(z)] => drop(places.insert(grid, Vector3::new(x, y, z))),
            _ if cells[2..].iter().all(|cell| cell.is_empty()) => {}
            _ => return Err(wrong()),
        }
    }
    Ok((labels, places))
}
