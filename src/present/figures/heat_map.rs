//! A matrix as colored cells with its numbers in them.

use super::canvas::{
    Area, Drawn, GRAY, INK, LETTERS, Letters, Pen, Place, SMALL, Side, between, outline, rectangle, write,
};
use nalgebra::DMatrix;
use plotters::style::{RGBColor, WHITE};

/// How a matrix is laid out.
pub(super) struct HeatMap<'a> {
    /// Nothing where there is no cell.
    pub values: &'a DMatrix<Option<f64>>,
    pub title: &'a str,
    pub row_heading: &'a str,
    pub column_heading: &'a str,
    pub rows: Vec<String>,
    pub columns: Vec<String>,
    /// Value that has the full color.
    pub full: f64,
    /// Colors of negative and positive values.
    pub colors: (RGBColor, RGBColor),
    /// Width and height of a cell, px.
    pub cell: (f64, f64),
    /// How a value is written; nothing for one that rounds to zero.
    pub write: fn(f64) -> String,
}

impl HeatMap<'_> {
    /// Draws the cells with their upper left corner at a place; headings stand above and to the left.
    pub fn draw(&self, area: &Area, (left, top): Place) -> Drawn {
        let (wide, high) = self.cell;
        let (rows, columns) = self.values.shape();
        let center = left + 0.5 * wide * columns as f64;
        let small = Letters::new(SMALL, Side::Center);
        for (j, name) in self.columns.iter().enumerate() {
            write(area, name, (left + wide * (j as f64 + 0.5), top - 9.0), small)?;
        }
        for (i, name) in self.rows.iter().enumerate() {
            let at = (left - 6.0, top + high * (i as f64 + 0.5));
            write(area, name, at, Letters::new(SMALL, Side::Left))?;
        }
        write(area, self.column_heading, (center, top - 26.0), small)?;
        let middle = top + 0.5 * high * rows as f64;
        let upward = Letters { upward: true, ..small };
        write(area, self.row_heading, (left - 34.0, middle), upward)?;
        write(area, self.title, (center, top - 46.0), Letters::new(LETTERS, Side::Center).bold())?;
        for i in 0..rows {
            for j in 0..columns {
                let Some(value) = self.values[(i, j)] else {
                    continue;
                };
                let (x, y) = (left + wide * j as f64, top + high * i as f64);
                let strength = (value.abs() / self.full).min(1.0);
                let color = if value < 0.0 { self.colors.0 } else { self.colors.1 };
                rectangle(area, (x, y), (x + wide, y + high), between(WHITE, color, strength))?;
                let ink = if strength > 0.6 { WHITE } else { INK };
                let at = (x + 0.5 * wide, y + 0.5 * high);
                write(area, &(self.write)(value), at, small.color(ink))?;
            }
        }
        let (right, bottom) = (left + wide * columns as f64, top + high * rows as f64);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        outline(area, &corners, Pen::solid(GRAY, 1.0))
    }
}

/// A fraction in whole percent; nothing when that is zero.
pub(super) fn percent(value: f64) -> String {
    let rounded = (100.0 * value).round();
    if rounded == 0.0 { String::new() } else { format!("{rounded:.0}").replace('-', "−") }
}
