//! A test as a table that a spreadsheet writes. Rows and columns are found by their names:
//!
//! ```text
//! # Wing test of 3 May, soft suspension
//! frequency_hz,,,,,,,12.1,17.9
//! frequency_deviation,,,,,,,0.003,0.005
//! name,grid,direction,sign,x,y,z,mode 1,mode 2
//! tip,12,z,-,0.,52.5,3.1,-1.0,0.31
//! "aileron, outer",14,z,+,8.,48.,3.1,0.87,-0.55
//! ```
//!
//! - Commas, semicolons or tabs separate cells, as in the first row that is no comment; with the latter two a decimal comma is
//!   understood. Separators may stand within quotation marks, which are doubled there.
//! - Above the header a row that begins with `#` or `"#` is a comment, below it one that begins with `#` is refused; empty rows do not count.
//! - One row, the header, has the titles of the columns, in any order and in capitals or not. `direction` must be there (x, y, z; rx,
//!   ry, rz for rotations), `name` or `grid` or both, and a column for every mode, whose title begins with `mode` or with its number, as
//!   `1st bending` does. `sign` says which way the sensor points along its axis: `+`, `-`, or empty for `+`. `x`, `y`, `z` are its place,
//!   all three or none of them.
//!   Where titles number the modes, the numbers ascend by one from left to right, from any first number; elsewhere they are 1, 2, 3.
//!   A mode of 0 Hz is a rigid-body mode and is not compared.
//! - A column `deviation 1` has the standard deviation of every component of mode 1, a fraction of the shape's largest component; it
//!   takes the place of that mode's `shape_deviation`.
//! - A sensor without a reading in some mode is left out of all modes and named in [`TestData::incomplete`].
//! - A mode whose column has no number but its frequency has no shape. A table of frequencies alone needs no sensors, and of titles only
//!   those of the modes.
//! - A sensor has a cell below each title, the rows above a number below each mode's, and neither has anything elsewhere but blanks.
//! - Rows whose first cell is `frequency_hz` (Hz, must be there), `frequency_deviation`, `shape_deviation` (standard deviations as
//!   fractions) or `phase_collinearity` have a number in each column of a mode. Only letters count there: `Frequency (Hz)` is the first.
//!   Every other row below the header is a sensor.

use super::{DIRECTION, Sensor, TestData, default_name, direction, real};
use crate::files::deck::number::LARGEST;
use crate::files::error::{FileError, ensure, is_not};
use crate::files::inert;
use nalgebra::{DMatrix, DVector, Vector3};
use std::collections::BTreeMap;

/// Letters of the first cells of the rows with a number for every mode.
const ROWS: [&str; 4] = [
    "frequencyhz",
    "frequencydeviation",
    "shapedeviation",
    "phasecollinearity",
];
/// Titles of columns that are no modes.
const TITLES: [&str; 7] = ["name", "grid", "direction", "sign", "x", "y", "z"];

/// The columns of a table.
struct Header {
    /// Columns of the [`TITLES`].
    titles: [Option<usize>; 7],
    /// Columns of the modes.
    modes: Vec<usize>,
    /// Number of the first mode.
    first: usize,
    /// Columns of the deviations of components, by mode, from zero.
    deviations: BTreeMap<usize, usize>,
}

/// One row, cut into cells.
struct TestRow<'a> {
    file: &'a str,
    number: usize,
    cells: Vec<String>,
    separator: char,
}

impl TestRow<'_> {
    fn cell(&self, column: Option<usize>) -> &str {
        column
            .and_then(|column| self.cells.get(column))
            .map_or("", String::as_str)
    }

    fn wrong(&self, reason: impl Into<String>) -> FileError {
        FileError::line(self.file, self.number, reason)
    }

    fn is_not(&self, found: &str, what: &str) -> FileError {
        self.wrong(is_not(found, what))
    }

    fn number(&self, column: usize) -> Result<f64, FileError> {
        let cell = self.cell(Some(column));
        let value = match self.separator {
            ',' => real(cell),
            _ => real(&cell.replace(',', ".")),
        };
        value
            .filter(|value| value.abs() <= LARGEST)
            .ok_or_else(|| self.is_not(cell, "a number"))
    }

    fn numbers(&self, columns: &[usize]) -> Result<Vec<f64>, FileError> {
        columns.iter().map(|column| self.number(*column)).collect()
    }

    fn header(&self) -> Result<Header, FileError> {
        let (mut titles, mut modes, mut deviations) = ([None; 7], Vec::new(), BTreeMap::new());
        for (column, cell) in self
            .cells
            .iter()
            .enumerate()
            .filter(|own| !own.1.is_empty())
        {
            let title = cell.to_lowercase();
            let place = TITLES.iter().position(|name| *name == title);
            let deviation = title
                .strip_prefix("deviation")
                .map(|own| own.trim().parse());
            let is_taken = match (place, deviation, of_mode(&title)) {
                (Some(place), ..) => titles[place].replace(column).is_none(),
                (_, Some(number), _) => {
                    number.is_ok_and(|number: usize| deviations.insert(number, column).is_none())
                }
                (.., number) => {
                    modes.extend(number.map(|number| (column, number)));
                    number.is_some()
                }
            };
            ensure(is_taken, || {
                self.is_not(cell, "a title: name, grid, direction, sign, x, y and z once each, mode 1 or 1 and so on, or a title deviation with the \
                            number of a mode, once each; leave a row sep=; out")
            })?;
        }
        let mut numbered = modes.iter().enumerate();
        let first = numbered
            .find_map(|(place, own)| Some(own.1?.saturating_sub(place)))
            .unwrap_or(1)
            .max(1);
        for (number, &(column, own)) in (first..).zip(&modes) {
            let cell = &self.cells[column];
            let is_it = |other: &String| other.to_lowercase() == cell.to_lowercase();
            ensure(
                own.is_none_or(|own| own == number) && !self.cells[..column].iter().any(is_it),
                || {
                    self.wrong(format!(
                    "column {}: this is mode {number}, but its title is \"{cell}\"; titles must differ and number modes from left to right",
                    column + 1
                ))
                },
            )?;
        }
        let known = first..first + modes.len();
        for mode in deviations.keys() {
            ensure(known.contains(mode), || {
                self.wrong(format!(
                    "there is a column deviation {mode}, but no mode {mode}"
                ))
            })?;
        }
        let axes = titles[4..].iter().flatten().count();
        let names_sensors =
            titles[2].is_some() && titles[..2] != [None; 2] && [0, 3].contains(&axes);
        ensure(
            (names_sensors || titles == [None; 7]) && !modes.is_empty(),
            || {
                self.is_not(&self.cells.join(" "), "a header with direction, name or grid, a column for every mode, and all of x, y, z or none")
            },
        )?;
        let deviations = deviations
            .into_iter()
            .map(|(number, column)| (number - first, column));
        Ok(Header {
            titles,
            modes: modes.into_iter().map(|own| own.0).collect(),
            first,
            deviations: deviations.collect(),
        })
    }

    /// Refuses a row that ends before its last number, or has something beside the columns of its numbers and, of a sensor, its names.
    fn check_columns(&self, header: &Header, is_sensor: bool) -> Result<(), FileError> {
        let own: Vec<&usize> = header
            .titles
            .iter()
            .flatten()
            .chain(header.deviations.values())
            .filter(|_| is_sensor)
            .chain(&header.modes)
            .collect();
        let wanted = own.iter().max().map_or(0, |last| *last + 1);
        let found = self.cells.len();
        ensure(found >= wanted, || {
            self.wrong(format!("the row has {found} cells and needs {wanted}"))
        })?;
        for (column, cell) in self.cells.iter().enumerate().skip(usize::from(!is_sensor)) {
            ensure(cell.is_empty() || own.contains(&&column), || {
                self.wrong(format!(
                    "column {}: \"{cell}\" stands where nothing belongs; decimal commas need semicolons or tabs between cells",
                    column + 1
                ))
            })?;
        }
        Ok(())
    }

    /// The sensor of the row, and -1 if it points against its axis.
    fn sensor(&self, titles: &[Option<usize>; 7]) -> Result<(Sensor, f64), FileError> {
        let [name, grid, word, sign, x, y, z] = titles.map(|column| self.cell(column));
        let (direction, turned) = direction(word).ok_or_else(|| self.is_not(word, DIRECTION))?;
        let sign = match sign {
            "" => turned,
            _ if word.starts_with(['+', '-']) => {
                return Err(self.is_not(sign, "empty, where the direction has a sign"));
            }
            "+" | "1" | "+1" => 1.0,
            "-" | "-1" => -1.0,
            other => return Err(self.is_not(other, "a sign + or -")),
        };
        // Programs that know one kind of number write 12.0 for 12.
        let number = |text: &str| text.strip_suffix(".0").unwrap_or(text).parse();
        let number = |text| number(text).map_err(|_| self.is_not(text, "a grid number"));
        let grid = (!grid.is_empty()).then(|| number(grid)).transpose()?;
        let axes: Vec<usize> = titles[4..].iter().flatten().copied().collect();
        let place = ([x, y, z] != [""; 3])
            .then(|| self.numbers(&axes))
            .transpose()?;
        let name = match (name, grid) {
            ("", None) => return Err(self.is_not("", "a name or a grid number")),
            ("", Some(grid)) => default_name(grid, direction),
            _ => name.to_owned(),
        };
        let sensor = Sensor {
            name,
            grid,
            direction,
            axis: None,
            place: place.map(|numbers| Vector3::from_column_slice(&numbers)),
        };
        Ok((sensor, sign))
    }
}

/// The number in the title of a mode, if it has one, and none for other titles: it begins with `mode` or with a whole number.
fn of_mode(title: &str) -> Option<Option<usize>> {
    let behind = title.strip_prefix("mode");
    let blank = |c: char| !c.is_alphanumeric();
    let rest = behind.map_or(title, |own| own.trim_start_matches(blank));
    let end = rest.find(|c: char| !c.is_ascii_digit());
    let number = rest[..end.unwrap_or(rest.len())].parse().ok();
    let is_whole = number.is_some() && real(title).is_none_or(|own| own.fract() == 0.0);
    (behind.is_some() || is_whole).then_some(number)
}

/// Rows of a table: those with a number for every mode, the header, and those of sensors.
type Rows<'a> = ([Option<TestRow<'a>>; 4], Header, Vec<TestRow<'a>>);

pub fn read(file: &str, text: &str) -> Result<TestData, FileError> {
    let missing = |what: &str| {
        let reason = format!("the file ends without {what}");
        FileError::line(file, text.lines().count(), reason)
    };
    let (by_mode, header, sensors) = rows(file, text, &missing)?;
    let (modes, first) = (&header.modes, header.first);
    let list = |row: &Option<TestRow>| row.as_ref().map(|row| row.numbers(modes)).transpose();
    let [hertz, frequency_deviation, shape_deviation, phases] = by_mode.each_ref().map(list);
    let mut data = TestData {
        frequencies_hz: hertz?.ok_or_else(|| missing("a row frequency_hz"))?,
        frequency_deviation: frequency_deviation?,
        shape_deviation: shape_deviation?,
        phase_collinearity: phases?.unwrap_or_default(),
        ..TestData::default()
    };
    if first != 1 {
        data.numbers = (first..first + modes.len()).collect();
    }
    let is_empty = |row: &TestRow, mode: usize| row.cell(Some(modes[mode])).is_empty();
    let (alone, shaped): (Vec<usize>, Vec<usize>) =
        (0..modes.len()).partition(|&mode| sensors.iter().all(|row| is_empty(row, mode)));
    data.shapes = DMatrix::zeros(sensors.len(), modes.len());
    let mut whole = Vec::new();
    for row in &sensors {
        let (sensor, sign) = row.sensor(&header.titles)?;
        if let Some(mode) = shaped.iter().find(|&&mode| is_empty(row, mode)) {
            let left_out = format!("{} (mode {})", sensor.name, first + mode);
            data.incomplete.push(left_out);
            continue;
        }
        for &mode in &shaped {
            data.shapes[(whole.len(), mode)] = sign * row.number(modes[mode])?;
        }
        data.sensors.push(sensor);
        whole.push(row);
    }
    ensure(sensors.is_empty() || !whole.is_empty(), || {
        missing("a sensor with a reading in every mode")
    })?;
    data.shapes.resize_vertically_mut(whole.len(), 0.0);
    for (mode, column) in header.deviations {
        if !alone.contains(&mode) {
            let values = whole
                .iter()
                .map(|row| row.number(column))
                .collect::<Result<_, FileError>>()?;
            data.component_deviation
                .insert(mode, DVector::from_vec(values));
        }
    }
    data.alone = alone;
    Ok(data)
}

fn rows<'a>(
    file: &'a str,
    text: &str,
    missing: &impl Fn(&str) -> FileError,
) -> Result<Rows<'a>, FileError> {
    let is_comment = |line: &str| line.starts_with('#') || line.starts_with("\"#");
    let lines = (1..)
        .zip(text.lines())
        .filter(|own| !own.1.trim().is_empty());
    let first = lines.clone().find(|(_, line)| !is_comment(line));
    let separator = separator(first.map_or("", |(_, line)| line));
    let (mut by_mode, mut header, mut sensors) = ([const { None }; 4], None::<Header>, Vec::new());
    for (number, line) in lines {
        let row = TestRow {
            file,
            number,
            cells: cells(line, separator),
            separator,
        };
        if header.is_none() && is_comment(line) || row.cells.iter().all(String::is_empty) {
            continue;
        }
        ensure(!line.starts_with('#'), || {
            row.wrong(format!("\"{}\" may be a comment or a sensor; put the name of a sensor in quotation marks, and comments above the header", row.cells[0]))
        })?;
        ensure(line.matches('"').count() % 2 == 0, || {
            row.wrong(format!("a quotation mark is not closed: {line}"))
        })?;
        let name = row
            .cell(Some(0))
            .chars()
            .filter(|c| c.is_alphanumeric())
            .collect::<String>()
            .to_lowercase();
        if let Some(place) = ROWS.iter().position(|row| *row == name) {
            ensure(by_mode[place].is_none(), || {
                row.wrong(format!("this is the second row {}", row.cells[0]))
            })?;
            by_mode[place] = Some(row);
        } else if header.is_none() {
            header = Some(row.header()?);
        } else {
            sensors.push(row);
        }
    }
    let header = header.ok_or_else(|| missing("a header"))?;
    by_mode
        .iter()
        .flatten()
        .try_for_each(|row| row.check_columns(&header, false))?;
    sensors
        .iter()
        .try_for_each(|row| row.check_columns(&header, true))?;
    Ok((by_mode, header, sensors))
}

/// The separator of a line's cells.
pub fn separator(line: &str) -> char {
    ['\t', ';']
        .into_iter()
        .find(|separator| line.contains(*separator))
        .unwrap_or(',')
}

/// Cuts a line at its separators, those within quotation marks excepted.
pub fn cells(line: &str, separator: char) -> Vec<String> {
    let last = line.matches('"').count();
    let mut cells = vec![String::new()];
    for (number, part) in line.split('"').enumerate() {
        let inside = number % 2 == 1;
        let doubled = part.is_empty() && 0 < number && number < last;
        let mut pieces = part.split(|c| c == separator && !inside);
        if let (Some(cell), Some(piece)) = (cells.last_mut(), pieces.next()) {
            *cell += if doubled && !inside { "\"" } else { piece };
        }
        cells.extend(pieces.map(str::to_owned));
    }
    cells.iter().map(|cell| cell.trim().to_owned()).collect()
}

/// A name as one cell that no spreadsheet takes for a formula.
pub fn quoted(name: &str) -> String {
    format!("\"{}\"", inert(name).replace('"', "\"\""))
}
