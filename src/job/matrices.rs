//! A model given by matrices: its files, and the degree of freedom of every row.

use super::{
    Job, ParameterRule, Scales,
    bodies::{explained, with_as_many},
    model::{GridLayout, Members, ModelSource, Part},
};
use crate::{
    files::{
        deck::number::{LARGEST, real},
        error::{FileError, ensure, is_not},
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
    let stiffness = matrix(job, stiffness, "model.stiffness", None)?;
    let (count, own) = (stiffness.matrix.rows(), stiffness.rows.as_ref());
    let own: Option<Vec<_>> = own.map(|own| own.iter().map(degree_of_freedom).collect());
    let (labels, places, rounding) = match &job.model.rows {
        Some(file) => read_rows(job, &job.beside(file))?,
        // Frequencies alone need no names of rows.
        None => (own.clone().unwrap_or_default(), BTreeMap::new(), 0.0),
    };
    let (rows, is_named) = (labels.len(), !labels.is_empty() || job.model.rows.is_some());
    ensure(!is_named || rows == count, || {
        job.refused(format!(
            "model.rows has {rows} rows, but the stiffness {count}"
        ))
    })?;
    ensure(own.is_none_or(|own| own == labels), || {
        job.refused("model.rows is not in the order of the stiffness, which names its rows")
    })?;
    let mut row_of = BTreeMap::new();
    for (row, label) in labels.iter().enumerate() {
        let first = row_of.insert(*label, row).unwrap_or(row);
        ensure(first == row, || {
            let (first, row) = (first + 1, row + 1);
            job.refused(format!(
                "rows {first} and {row} of the matrices have the same grid and direction"
            ))
        })?;
    }
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
    let label = |own: &StructuralDof| Label {
        grid: own.grid,
        component: own.direction + 1,
    };
    let by_rows = labels.iter().map(label).collect();
    let rows = (0..).map(|row| vec![(row, 1.0)]);
    let geometry = GridLayout {
        places,
        elements: Vec::new(),
    };
    let layout = (geometry, labels.into_iter().zip(rows).collect());
    let whole = (stiffness.matrix, mass.matrix, support);
    let mut source = ModelSource::new(job, whole, parts, layout, None)?;
    source.labels = stiffness.rows.unwrap_or(by_rows);
    source.dmig = [stiffness.dmig, mass.dmig];
    Ok(source)
}

/// Parameters by the job's rules of a model of this stiffness and mass, whose labels have these rows.
fn matrix_parts<'a>(
    job: &'a Job,
    row_of: &BTreeMap<StructuralDof, usize>,
    [stiffness, mass]: [&SparseMatrix; 2],
) -> Result<Vec<(&'a ParameterRule, Part)>, FileError> {
    let part = |rule: &'a ParameterRule| {
        let entry = format!("parameter \"{}\"", rule.name);
        let of_deck =
            rule.elements.len() + rule.properties.len() + rule.materials.len() + rule.masses.len();
        let (file, scales, at) = match (&rule.matrix, &rule.stiffness, &rule.mass, rule.at) {
            _ if of_deck > 0 || rule.each => (None, Scales::default(), None),
            (Some(file), None, None, None) => (Some(file), rule.scales, None),
            (None, file, None, at @ Some(_)) => (file.as_ref(), Scales::Stiffness, at),
            (None, None, file, at @ Some(_)) => (file.as_ref(), Scales::Mass, at),
            _ => (None, Scales::default(), None),
        };
        let file = file.ok_or_else(|| {
            job.refused(format!(
                "{entry} needs a matrix, or a whole stiffness or mass with the factor at that it has there, and no entry of a deck"
            ))
        })?;
        let mut matrix = on_rows(job, (file, &entry), row_of, stiffness.rows())?.matrix;
        if let Some(at) = at {
            let first = match scales {
                Scales::Stiffness => stiffness,
                Scales::Mass => mass,
            };
            matrix = part_of(job, &rule.name, (first, &matrix), at)?;
        }
        Ok((
            rule,
            Part {
                name: rule.name.clone(),
                share: match scales {
                    Scales::Stiffness => WholeShare::Stiffness(matrix),
                    Scales::Mass => WholeShare::Mass(matrix),
                },
                members: Members::default(),
                sizes: Vec::new(),
            },
        ))
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
    ensure(at != 1.0 && at > 0.0 && at.is_finite(), || {
        job.refused(format!(
            "parameter \"{name}\": at = {at} must be positive and another factor than one"
        ))
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
    ensure(!entries.is_empty(), || {
        job.refused(format!(
            "parameter \"{name}\": the digits of the files do not tell the matrix at {at} from the model's; write more digits, or take \
             another factor"
        ))
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
    let LabeledMatrix {
        rows,
        matrix: stiffness,
        ..
    } = matrix(&job, file, "--stiffness", None)?;
    let dof: Vec<_> = rows.iter().flatten().map(degree_of_freedom).collect();
    let row_of = (0..).zip(&dof).map(|(row, dof)| (*dof, row)).collect();
    let mass = on_rows(&job, (mass, "--mass"), &row_of, stiffness.rows())?.matrix;
    let most = most.min(stiffness.rows());
    let name = |row: usize| row_name(row, &dof);
    let whole = WholeModel::new(stiffness, mass, Vec::new())?;
    let found = with_as_many(most, |most| whole.modes(&[], most));
    let (_, found) =
        found.map_err(|error| explained(error, file.display(), whole.half_unit(), name))?;
    let Modes {
        omega_squared,
        shapes,
    } = found.vibrations;
    let modes = Modes::signed(omega_squared, shapes);
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
    let mut rows: Vec<usize> = mass
        .entries()
        .filter(|own| own.2 != 0.0)
        .map(|own| own.0)
        .collect();
    rows.dedup();
    let own = mass
        .at_rows(&rows)
        .and_then(|own| own.at_columns(&rows))
        .ok()?;
    let is_definite = Factor::new("mass", &own).is_ok_and(|own| own.negative_count() == 0);
    is_definite.then_some(rows.len())
}

/// The degree of freedom of a label: component 0 of a scalar point is its first.
fn degree_of_freedom(label: &Label) -> StructuralDof {
    StructuralDof {
        grid: label.grid,
        direction: label.component.saturating_sub(1),
    }
}

/// A square matrix of a file, with the same labels for rows and columns, or of so many rows without any; `#` in the name chooses one of
/// several.
fn matrix(
    job: &Job,
    file: &Path,
    entry: &str,
    count: Option<usize>,
) -> Result<LabeledMatrix, FileError> {
    let text = file.to_string_lossy();
    let is_file = |file: &str| job.beside(Path::new(file)).is_file();
    // A number sign may be part of the file's own name.
    let (file, wanted) = match text.rsplit_once('#') {
        Some((file, name)) if !is_file(&text) => (file, Some(name)),
        Some((file, _)) if is_file(file) => {
            return Err(job.refused(format!(
                "{text} may be a file or a matrix of {file}; rename one of them"
            )));
        }
        _ => (&*text, None),
    };
    let file = job.beside(Path::new(file));
    let bytes = job.bytes(&file, entry)?;
    let found = matrices::read(&file.display().to_string(), &bytes, wanted)?;
    let is_huge = |value: f64| value.abs() > LARGEST;
    if found.matrix.entries().any(|entry| is_huge(entry.2)) {
        let has_huge = |line: &str| {
            line.split([' ', '\t', ','])
                .any(|word| real(word).is_some_and(is_huge))
        };
        let line = decoded(&bytes).lines().position(has_huge).unwrap_or(0) + 1;
        return Err(FileError::line(
            &file.display().to_string(),
            line,
            format!("a number is beyond {LARGEST:e}, and its square is none; look at its exponent"),
        ));
    }
    ensure(found.columns == found.rows, || {
        job.refused(format!("{text}: rows and columns have different names"))
    })?;
    let [rows, columns] = [found.matrix.rows(), found.matrix.columns()];
    let wanted = count.filter(|_| found.rows.is_none()).unwrap_or(rows);
    ensure([rows, columns] == [wanted; 2], || {
        job.refused(format!(
            "{text} ({entry}) is {rows} x {columns}; it must be {wanted} x {wanted}"
        ))
    })?;
    // Labels ascend, so that two of one degree of freedom are neighbors.
    for pair in found.rows.as_deref().unwrap_or_default().windows(2) {
        let [one, other] = [0, 1].map(|own| degree_of_freedom(&pair[own]));
        ensure(one != other, || {
            let grid = one.grid;
            job.refused(format!(
                "{text}: components 0 and 1 of grid {grid} are one degree of freedom, and the matrix has both"
            ))
        })?;
    }
    Ok(found)
}

/// A matrix of a file; if it names its rows and columns, they are put in the order of the stiffness.
fn on_rows(
    job: &Job,
    (file, entry): (&Path, &str),
    row_of: &BTreeMap<StructuralDof, usize>,
    count: usize,
) -> Result<LabeledMatrix, FileError> {
    let found = matrix(job, file, entry, Some(count))?;
    let (Some(labels), matrix) = (&found.rows, &found.matrix) else {
        return Ok(found);
    };
    for label in labels {
        ensure(row_of.contains_key(&degree_of_freedom(label)), || {
            let (file, Label { grid, component }) = (file.display(), label);
            job.refused(format!(
                "{file}: the stiffness has no row of grid {grid}, component {component}"
            ))
        })?;
    }
    let place = |row: usize| row_of[&degree_of_freedom(&labels[row])];
    let entries = matrix
        .entries()
        .map(|(row, column, value)| (place(row), place(column), value));
    let all = SparseMatrix::new(
        "matrix by labels",
        row_of.len(),
        row_of.len(),
        entries.collect(),
    )?;
    Ok(LabeledMatrix {
        matrix: all.with_half_unit(matrix.half_unit()),
        ..found
    })
}

/// Labels and places of a model's rows, and the largest part of a coordinate by which it is rounded.
type Rows = (Vec<StructuralDof>, BTreeMap<usize, Vector3<f64>>, f64);

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
