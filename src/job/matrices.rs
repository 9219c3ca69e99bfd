//! A model given by matrices: its files, and the degree of freedom of every row.

use super::{
    Job, ParameterRule, Scales,
    bodies::{explained, with_as_many},
    model::{self, Members, ModelSource, Part},
};
use crate::{
    files::{
        deck::number::LARGEST,
        error::{FileError, is_not},
        matrices::{self, Digits, Label, LabeledMatrix},
        test_data::{self, cells, row_name, separator},
        text::decoded,
    },
    method::{modes::Modes, structure::StructuralDof},
    sparse::{
        Factor, HalfUnit, Places, SparseMatrix, Support, WholeModel, WholeShare,
        visibility::open_parts, whole_modes::WholeModes,
    },
};
use nalgebra::{DMatrix, Vector3};
use std::{collections::BTreeMap, path::Path};

/// The model of the matrices in these files.
pub fn from_matrices(job: &Job, stiffness: &Path, mass: &Path) -> Result<ModelSource, FileError> {
    let (stiffness, own) = matrix(job, (stiffness, "model.stiffness"), None)?;
    let count = stiffness.matrix.rows();
    let (labels, places, rounding) = match &job.model.rows {
        Some(file) => read_rows(job, &job.beside(file))?,
        // Frequencies alone need no names of rows.
        None => (own.clone(), BTreeMap::new(), 0.0),
    };
    let (rows, is_named) = (labels.len(), !labels.is_empty() || job.model.rows.is_some());
    job.ensure(!is_named || rows == count, || {
        format!("model.rows has {rows} rows, but the stiffness {count}")
    })?;
    job.ensure(
        own.is_empty() || own == labels,
        || "model.rows is not in the order of the stiffness, which names its rows",
    )?;
    let row_of = rows_of(job, "model.rows", &labels)?;
    let mass = on_rows(job, (mass, "model.mass"), &row_of, count)?;
    let parts = matrix_parts(job, &row_of, [&stiffness.matrix, &mass.matrix])?;
    let placed = |dof: &StructuralDof| Some((*places.get(&dof.grid)?, dof.direction));
    let placed: Option<Vec<_>> = labels.iter().map(placed).collect();
    let support = Support {
        places: placed
            .filter(|_| is_named)
            .map(|rows| Places::new(&rows, rounding)),
        ..Support::default()
    };
    let rows = (0..).map(|row| vec![(row, 1.0)]);
    let layout = (places, labels.into_iter().zip(rows).collect());
    let whole = (stiffness.matrix, mass.matrix, support);
    Ok(ModelSource {
        labels: stiffness.rows.unwrap_or_default(),
        dmig: [stiffness.dmig, mass.dmig],
        ..ModelSource::new(job, whole, parts, layout, None)?
    })
}

/// Parameters by the job's rules of a model of this stiffness and mass, whose labels have these rows.
fn matrix_parts(
    job: &Job,
    row_of: &BTreeMap<StructuralDof, usize>,
    [stiffness, mass]: [&SparseMatrix; 2],
) -> Result<Vec<Part>, FileError> {
    let part = |rule: &ParameterRule| {
        let entry = format!("parameter \"{}\"", rule.name);
        let of_deck =
            rule.elements.len() + rule.masses.len() + rule.properties.len() + rule.materials.len();
        let is_of_deck = of_deck > 0 || rule.each;
        let (file, scales) = match (&rule.matrix, &rule.stiffness, &rule.mass, rule.at) {
            (Some(file), None, None, None) if !is_of_deck => (file, rule.scales),
            (None, Some(file), None, Some(_)) if !is_of_deck => (file, Scales::Stiffness),
            (None, None, Some(file), Some(_)) if !is_of_deck => (file, Scales::Mass),
            _ => {
                return Err(job.refused(format!(
                    "{entry} needs a matrix, or a whole stiffness or mass with the factor at that it has there, and no entry of a deck"
                )));
            }
        };
        let mut matrix = on_rows(job, (file, &entry), row_of, stiffness.rows())?.matrix;
        let (first, share): (_, fn(SparseMatrix) -> WholeShare) = match scales {
            Scales::Stiffness => (stiffness, WholeShare::Stiffness),
            Scales::Mass => (mass, WholeShare::Mass),
        };
        if let Some(at) = rule.at {
            matrix = part_of(job, &rule.name, (first, &matrix), at)?;
        }
        rule.part(job, (rule.name.clone(), share(matrix)), Members::default())
    };
    job.parameters.iter().map(part).collect()
}

/// The part of a parameter in the first matrix, $K_e = (K_2 - K)/(c - 1)$, of a second one with its factor at $c$. What the digits of both
/// do not tell from zero is none.
fn part_of(
    job: &Job,
    name: &str,
    (first, second): (&SparseMatrix, &SparseMatrix),
    at: f64,
) -> Result<SparseMatrix, FileError> {
    job.ensure(at != 1.0 && at > 0.0 && at.is_finite(), || {
        format!("parameter \"{name}\": at = {at} must be positive and another factor than one")
    })?;
    let mut both: BTreeMap<(usize, usize), [f64; 2]> = BTreeMap::new();
    for (of, matrix) in [first, second].into_iter().enumerate() {
        for (row, column, value) in matrix.entries() {
            both.entry((row, column)).or_default()[of] = value;
        }
    }
    let halves = [first.half_unit(), second.half_unit()];
    let mut largest = 0.0_f64;
    let of_place = |(&(row, column), &[one, two]): (&(usize, usize), &[f64; 2])| {
        let (change, rounded) = ((two - one).abs(), halves[0].of(one) + halves[1].of(two));
        let is_told = change > rounded;
        largest = largest.max(if is_told { rounded / change } else { 0.0 });
        is_told.then_some((row, column, (two - one) / (at - 1.0)))
    };
    let entries: Vec<_> = both.iter().filter_map(of_place).collect();
    job.ensure(!entries.is_empty(), || {
        format!(
            "parameter \"{name}\": the digits of the files do not tell the matrix at {at} from the model's; write more digits, or take \
             another factor"
        )
    })?;
    Ok(
        SparseMatrix::new("part of a parameter", first.rows(), first.rows(), entries)?
            .with_half_unit(HalfUnit::of_each(largest)),
    )
}

/// The `most` lowest vibrations of a structure given by its stiffness and mass, or all of finite frequency; `#` in a file's name
/// chooses one of several matrices.
///
/// # Errors
/// The errors of the files and of [`WholeModel::modes`].
pub fn matrix_modes(file: &Path, mass: &Path, most: usize) -> Result<WholeModes, FileError> {
    let job = Job {
        path: "modes".into(),
        ..Job::default()
    };
    let (
        LabeledMatrix {
            matrix: stiffness, ..
        },
        dof,
    ) = matrix(&job, (file, "--stiffness"), None)?;
    let row_of = rows_of(&job, "--stiffness", &dof)?;
    let mass = on_rows(&job, (mass, "--mass"), &row_of, stiffness.rows())?.matrix;
    let most = most.min(stiffness.rows());
    let name = |row: usize| row_name(row, &dof);
    let whole = WholeModel::new(stiffness, mass, Vec::new())?;
    let found = with_as_many(most, |most| whole.modes(&[], most));
    let (_, found) =
        found.map_err(|error| explained(error, file.display(), whole.half_unit(), name))?;
    let modes = Modes::signed(found.vibrations.omega_squared, found.vibrations.shapes);
    let (stiffness, mass) = whole.at(&[])?;
    let open = open_parts([&stiffness, &mass], &modes)?;
    let lowest = modes.frequencies_hz().first().copied();
    let rigid_body = found.rigid_body.ncols();
    Ok(WholeModes {
        doubtful: whole.body_findings(name, lowest)?,
        counted: motions_with_mass(&mass).map(|rows| rows - rigid_body),
        dof,
        modes,
        at_rows: DMatrix::zeros(0, 0),
        rigid_body,
        open,
    })
}

/// Number of motions that have mass, if every row with an entry of it is one by itself: a definite mass.
fn motions_with_mass(mass: &SparseMatrix) -> Option<usize> {
    let rows = mass.entries().filter(|own| own.2 != 0.0);
    let mut rows: Vec<usize> = rows.map(|own| own.0).collect();
    rows.dedup();
    let own = mass
        .at_rows(&rows)
        .and_then(|own| own.at_columns(&rows))
        .ok()?;
    let is_definite = Factor::new("mass", &own).is_ok_and(|own| own.negative_count() == 0);
    is_definite.then_some(rows.len())
}

/// The row of every degree of freedom.
fn rows_of(
    job: &Job,
    entry: &str,
    dof: &[StructuralDof],
) -> Result<BTreeMap<StructuralDof, usize>, FileError> {
    let mut row_of = BTreeMap::new();
    for (row, own) in dof.iter().enumerate() {
        let first = row_of.insert(*own, row).unwrap_or(row);
        job.ensure(first == row, || {
            let (first, row) = (first + 1, row + 1);
            format!("{entry}: rows {first} and {row} have the same grid and direction")
        })?;
    }
    Ok(row_of)
}

/// A square matrix of a file, with the same labels for rows and columns, or of so many rows without any, and the degrees of freedom of its
/// labels, of which component 0 of a scalar point is its first; `#` in the name chooses one of several.
fn matrix(
    job: &Job,
    (file, entry): (&Path, &str),
    count: Option<usize>,
) -> Result<(LabeledMatrix, Vec<StructuralDof>), FileError> {
    let text = file.to_string_lossy();
    // A number sign may be part of the file's own name.
    let (file, wanted) = match text.rsplit_once('#') {
        Some((whole, name)) if !job.beside(file).is_file() => (Path::new(whole), Some(name)),
        _ => (file, None),
    };
    let file = job.beside(file);
    let bytes = job.bytes(&file, entry)?;
    let found = matrices::read(&file.display().to_string(), &bytes, wanted)?;
    let huge = found.matrix.entries().find(|own| own.2.abs() > LARGEST);
    if let Some((row, column, value)) = huge {
        return Err(job.refused(format!(
            "{text}: {value:e} in row {}, column {} is beyond {LARGEST:e}, and its square is no number; look at its exponent",
            row + 1,
            column + 1
        )));
    }
    job.ensure(found.columns == found.rows, || {
        format!("{text}: rows and columns have different names")
    })?;
    let [rows, columns] = [found.matrix.rows(), found.matrix.columns()];
    let wanted = count.filter(|_| found.rows.is_none()).unwrap_or(rows);
    job.ensure([rows, columns] == [wanted; 2], || {
        format!("{text} ({entry}) is {rows} x {columns}; it must be {wanted} x {wanted}")
    })?;
    let dof = |label: &Label| StructuralDof {
        grid: label.grid,
        direction: label.component.saturating_sub(1),
    };
    let dof: Vec<_> = found.rows.iter().flatten().map(dof).collect();
    rows_of(job, &text, &dof)?;
    Ok((found, dof))
}

/// A matrix of a file; if it names its rows and columns, they are put in the order of the stiffness.
fn on_rows(
    job: &Job,
    (file, entry): (&Path, &str),
    row_of: &BTreeMap<StructuralDof, usize>,
    count: usize,
) -> Result<LabeledMatrix, FileError> {
    let (found, dof) = matrix(job, (file, entry), Some(count))?;
    if dof.is_empty() {
        return Ok(found);
    }
    for own in &dof {
        job.ensure(row_of.contains_key(own), || {
            let (file, component) = (file.display(), own.direction + 1);
            format!(
                "{file}: the stiffness has no row of grid {}, component {component}",
                own.grid
            )
        })?;
    }
    let place = |row: usize| row_of[&dof[row]];
    let entries = found.matrix.entries();
    let entries = entries.map(|(row, column, value)| (place(row), place(column), value));
    let all = SparseMatrix::new(
        "matrix by labels",
        row_of.len(),
        row_of.len(),
        entries.collect(),
    )?;
    Ok(LabeledMatrix {
        matrix: all.with_half_unit(found.matrix.half_unit()),
        ..found
    })
}

/// Labels and places of a model's rows, and the largest part of a coordinate by which it is rounded.
type Rows = (Vec<StructuralDof>, model::Places, f64);

/// Reads a table `grid,direction,x,y,z`.
fn read_rows(job: &Job, file: &Path) -> Result<Rows, FileError> {
    let (name, bytes) = (file.display().to_string(), job.bytes(file, "model.rows")?);
    let (mut labels, mut places, mut digits) = (Vec::new(), BTreeMap::new(), Digits::default());
    for (number, line) in (1..).zip(decoded(&bytes).lines()) {
        let cells = cells(line, separator(line));
        let is_title = labels.is_empty()
            && ["grid,direction", "grid,direction,x,y,z"]
                .contains(&&*cells.join(",").to_lowercase());
        if is_title || line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let what = "a line of grid, direction and perhaps x, y, z";
        let wrong = |reason| FileError::line(&name, number, reason);
        let (label, place) = row(&cells).ok_or_else(|| wrong(is_not(line, what)))?;
        labels.push(label);
        cells.iter().skip(2).for_each(|number| digits.add(number));
        if place.is_some_and(|place| *places.entry(label.grid).or_insert(place) != place) {
            return Err(wrong(format!(
                "grid {} was given at another place before",
                label.grid
            )));
        }
    }
    let farthest = places.values().map(Vector3::amax).fold(0.0, f64::max);
    Ok((
        labels,
        places,
        digits.half_unit().of(farthest) / farthest.max(f64::MIN_POSITIVE),
    ))
}

/// Grid and direction of a row, and its place if it has one.
fn row(cells: &[String]) -> Option<(StructuralDof, Option<Vector3<f64>>)> {
    let [grid, direction, place @ ..] = cells else {
        return None;
    };
    let label = StructuralDof {
        grid: grid.parse().ok()?,
        direction: test_data::direction(direction).filter(|own| own.1 > 0.0)?.0,
    };
    if place.iter().all(String::is_empty) {
        return Some((label, None));
    }
    let number = |cell: &String| cell.parse().ok().filter(|number: &f64| number.is_finite());
    match place.iter().map(number).collect::<Option<Vec<_>>>()?[..] {
        [x, y, z] => Some((label, Some(Vector3::new(x, y, z)))),
        _ => None,
    }
}
