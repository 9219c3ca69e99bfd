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
const ABOVE: f64 = 64.0;

/// A figure of matrices two by two, as large as there is room, with sentences below.
pub fn draw_by_twos(
    name: &str,
    title: &str,
    maps: &[HeatMap],
    notes: &[&str],
) -> Result<String, PresentError> {
    const LEFTS: [f64; 2] = [66.0, 446.0];
    let most = maps.iter().map(|map| map.values.nrows()).max().unwrap_or(0);
    let pitch = ABOVE + 26.0 + ROOM.1 * most.min(9) as f64 / 9.0;
    let down = pitch * maps.len().div_ceil(LEFTS.len()) as f64;
    let notes: Vec<String> = notes.iter().flat_map(|note| paragraph(note)).collect();
    let height = down + 20.0 + LINE * notes.len() as f64;
    svg(name, title, height, |area| {
        for (at, map) in maps.iter().enumerate() {
            let (rows, columns) = map.values.shape();
            let cell = (ROOM.0 / columns.max(9) as f64, ROOM.1 / rows.max(9) as f64);
            let (row, column) = (at / LEFTS.len(), at % LEFTS.len());
            map.draw(area, (LEFTS[column], ABOVE + pitch * row as f64), cell)?;
        }
        write_lines(area, &notes, (LEFTS[0], down + 8.0), START)
    })
}

/// A figure of derivatives: the effect of each parameter on each frequency, and on the error sum beside it.
pub fn draw_derivatives(
    name: &str,
    title: &str,
    [frequency, error_sum]: &[HeatMap; 2],
) -> Result<String, PresentError> {
    const HIGH: f64 = 26.0;
    let note =
        "An empty cell rounds to zero. Red is negative: more of that parameter lowers the error.";
    let left = name_room(frequency.rows.1.iter(), 66.0);
    let wide = (516.0 - left) / frequency.values.ncols().max(9) as f64;
    let down = ABOVE + HIGH * frequency.values.nrows() as f64;
    svg(name, title, down + 24.0 + LINE, |area| {
        frequency.draw(area, (left, ABOVE), (wide, HIGH))?;
        error_sum.draw(area, (612.0, ABOVE), (90.0, HIGH))?;
        write(area, note, (66.0, down + 24.0), START)
    })
}

impl HeatMap {
    /// A value as it stands in its cell.
    fn write(&self, value: f64) -> String {
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
        let longest = self.rows.1.iter().map(|name| name.chars().count()).max();
        let beside = longest.map_or(34.0, |longest| (12.0 + 6.6 * longest as f64).max(34.0));
        for (j, name) in self.columns.1.iter().enumerate() {
            write(area, name, (at(0.0, j as f64 + 0.5).0, top - 9.0), small)?;
        }
        for (i, name) in self.rows.1.iter().enumerate() {
            let place = (left - 6.0, at(i as f64 + 0.5, 0.0).1);
            write(area, name, place, END.small())?;
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
        let half = 3.8 * self.title.chars().count() as f64;
        let title = middle.0.max(left - 50.0 + half);
        write(area, &self.title, (title, top - 46.0), MIDDLE.bold())?;
        for i in 0..rows {
            for j in 0..columns {
                let Some(value) = self.values[(i, j)] else {
                    continue;
                };
                let (row, column) = (i as f64, j as f64);
                let fill = toned(value / self.full.max(f64::MIN_POSITIVE));
                rectangle(area, at(row, column), at(row + 1.0, column + 1.0), fill)?;
                let letters = Letters {
                    color: legible_on(fill),
                    ..small
                };
                write(
                    area,
                    &self.write(value),
                    at(row + 0.5, column + 0.5),
                    letters,
                )?;
            }
        }
        let frame = corners((left, top), at(rows as f64, columns as f64));
        polygon(area, &frame, None, Pen::solid(GRAY, 1.0))
    }
}
