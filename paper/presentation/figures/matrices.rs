//! Matrices as colored cells with their numbers in them.

use super::canvas::*;
use nalgebra::DMatrix;

/// A matrix with the names of its rows and columns.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    /// Name of the matrix.
    pub title: String,
    /// Name of the rows, and their labels.
    pub rows: (String, Vec<String>),
    /// Name of the columns, and their labels.
    pub columns: (String, Vec<String>),
    /// The entries; nothing where there is no cell.
    pub values: DMatrix<Option<f64>>,
    /// The magnitude that has the full color: blue for positive values and red for negative ones.
    pub full: f64,
    /// Factor on a value that is written, and its decimals; a value that rounds to zero is not written.
    pub written: (f64, usize),
}

/// Room of a matrix's cells, px.
const ROOM: (f64, f64) = (297.0, 270.0);

/// Room above matrices for their titles and the names of their columns, px.
fn above(maps: &[HeatMap], wide: f64) -> f64 {
    let lines = maps.iter().map(|map| paragraph(&map.title, wide).len());
    let lines = if wide < WIDE { lines.max() } else { None };
    64.0 + LINE * (lines.unwrap_or(1) - 1) as f64
}

/// A figure of matrices two by two, or below each other in its narrow form, as large as there is room, with sentences below.
pub fn draw_by_twos(
    name: &str,
    title: &str,
    maps: &[HeatMap],
    notes: &[&str],
    wide: f64,
) -> Result<String, PresentError> {
    let lefts: &[f64] = if wide < WIDE { &[52.0] } else { &[66.0, 446.0] };
    let most = maps.iter().map(|map| map.values.nrows()).max().unwrap_or(0);
    let above = above(maps, wide);
    let pitch = above + 26.0 + ROOM.1 * most.min(9) as f64 / 9.0;
    let down = pitch * maps.len().div_ceil(lefts.len()) as f64;
    let notes: Vec<String> = notes
        .iter()
        .flat_map(|note| paragraph(note, wide))
        .collect();
    let height = down + 20.0 + LINE * notes.len() as f64;
    svg(name, title, (wide, height), |area| {
        for (at, map) in maps.iter().enumerate() {
            let (rows, columns) = map.values.shape();
            let cell = (ROOM.0 / columns.max(9) as f64, ROOM.1 / rows.max(9) as f64);
            let (row, column) = (at / lefts.len(), at % lefts.len());
            map.draw(area, (lefts[column], above + pitch * row as f64), cell)?;
        }
        let left = if wide < WIDE { EDGE } else { lefts[0] };
        write_lines(area, &notes, (left, down + 8.0), START)
    })
}

/// A figure of derivatives: the effect of each parameter on each frequency, and on the error sum; below that in the narrow form.
pub fn draw_derivatives(
    name: &str,
    title: &str,
    maps: &[HeatMap; 2],
    wide: f64,
) -> Result<String, PresentError> {
    const HIGH: f64 = 26.0;
    let ([frequency, error_sum], above) = (maps, above(maps, wide));
    let note =
        "An empty cell rounds to zero. Red is negative: more of that parameter lowers the error.";
    let notes = paragraph(note, wide);
    let high = HIGH * frequency.values.nrows() as f64;
    let columns = frequency.values.ncols().max(9) as f64;
    let names = frequency.rows.1.iter();
    let (left, right, below) = match wide < WIDE {
        true => (
            name_room(names, 52.0).min(130.0),
            wide - 9.0,
            above + high + 20.0,
        ),
        false => (name_room(names, 66.0), 516.0, 0.0),
    };
    // Beside the names of the first, or with its own.
    let (sums, place) = match wide < WIDE {
        true => (error_sum.clone(), (left, above + below)),
        false => {
            let rows = (String::new(), Vec::new());
            (
                HeatMap {
                    rows,
                    ..error_sum.clone()
                },
                (612.0, above),
            )
        }
    };
    let down = below + above + high;
    let height = down + 24.0 + LINE * notes.len() as f64;
    svg(name, title, (wide, height), |area| {
        frequency.draw(area, (left, above), ((right - left) / columns, HIGH))?;
        sums.draw(area, place, (90.0, HIGH))?;
        let at = if wide < WIDE { EDGE } else { 66.0 };
        write_lines(area, &notes, (at, down + 24.0), START)
    })
}

impl HeatMap {
    /// A value as it stands in its cell.
    pub fn write(&self, value: f64) -> String {
        let (factor, decimals) = self.written;
        let text = format!("{:.decimals$}", factor * value);
        if text.chars().all(|c| matches!(c, '-' | '0' | '.')) {
            String::new()
        } else {
            signed(text)
        }
    }

    /// Draws cells of a width and height with their upper left corner at a place; headings stand above and to the left.
    fn draw(&self, area: &Area, (left, top): Place, (wide, high): (f64, f64)) -> Drawn {
        let (rows, columns) = self.values.shape();
        let at = |i: f64, j: f64| (left + wide * j, top + high * i);
        let small = MIDDLE.small();
        // Digits and labels stand where there is room for them.
        let longest = self
            .values
            .iter()
            .flatten()
            .map(|value| self.write(*value).chars().count())
            .max()
            .unwrap_or(0);
        let fits = wide > 6.2 * longest as f64 && high > 10.0;
        let every = |size: f64, room: f64| (room / size).ceil().max(1.0) as usize;
        // Names are cut where they would leave the figure.
        let room = (((left - 12.0) / 6.6) as usize).clamp(2, 40);
        let names = self
            .rows
            .1
            .iter()
            .map(|name| cut(name, room).chars().count());
        let beside = names
            .max()
            .map_or(34.0, |longest| (12.0 + 6.6 * longest as f64).max(34.0));
        let (down, across) = (every(high, 11.0), every(wide, 20.0));
        for (j, name) in self.columns.1.iter().enumerate().step_by(across) {
            write(area, name, (at(0.0, j as f64 + 0.5).0, top - 9.0), small)?;
        }
        for (i, name) in self.rows.1.iter().enumerate().step_by(down) {
            write(
                area,
                &cut(name, room),
                (left - 6.0, at(i as f64 + 0.5, 0.0).1),
                END.small(),
            )?;
        }
        let middle = at(0.5 * rows as f64, 0.5 * columns as f64);
        write(area, &self.columns.0, (middle.0, top - 26.0), small)?;
        write(
            area,
            &self.rows.0,
            (
                left - beside,
                middle.1.max(top + 3.3 * self.rows.0.len() as f64),
            ),
            Letters {
                upward: true,
                ..small
            },
        )?;
        // A title longer than its matrix does not begin left of the figure.
        if width(area) < WIDE {
            let lines = paragraph(&self.title, width(area));
            let first = top - 28.0 - LINE * lines.len() as f64;
            write_lines(area, &lines, (EDGE, first), START.bold())?;
        } else {
            let half = 3.8 * self.title.chars().count() as f64;
            let title = middle.0.max(left - 50.0 + half);
            write(area, &self.title, (title, top - 46.0), MIDDLE.bold())?;
        }
        for i in 0..rows {
            for j in 0..columns {
                let Some(value) = self.values[(i, j)] else {
                    continue;
                };
                let (row, column) = (i as f64, j as f64);
                let fill = toned(value / self.full.max(f64::MIN_POSITIVE));
                rectangle(area, at(row, column), at(row + 1.0, column + 1.0), fill)?;
                if fits {
                    write(
                        area,
                        &self.write(value),
                        at(row + 0.5, column + 0.5),
                        Letters {
                            color: legible_on(fill),
                            ..small
                        },
                    )?;
                }
            }
        }
        let frame = corners((left, top), at(rows as f64, columns as f64));
        polygon(area, &frame, None, Pen::solid(GRAY, 1.0))
    }
}
