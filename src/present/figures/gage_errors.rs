//! Gage errors of every panel, at the start and after each pass.

use super::canvas::{
    Area, BLUE, Drawn, Form, INK, LETTERS, Letters, ORANGE, PALE, Pen, SKY, Side, WIDTH, bar, between, line, mark,
    name_upright, svg, units, write,
};
use crate::cases::CaseResult;
use crate::present::error::PresentError;
use crate::present::report::correlation_tables::gage_table;
use crate::present::report::table::{Cell, Table};
use plotters::prelude::*;

/// Errors of one stage.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// `Initial`, `Pass 1`, …
    pub name: String,
    /// Percent of the test gage, panel by panel.
    pub computed: Vec<f64>,
    /// What the paper prints, if it does.
    pub published: Vec<Option<f64>>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct GageErrors {
    /// Case number.
    pub case: usize,
    /// Panels, by number and letter of their kind.
    pub panels: Vec<(String, String)>,
    /// The start and every pass.
    pub stages: Vec<Stage>,
}

/// Gage errors of a case, from its gage table.
///
/// # Errors
/// Those of [`gage_table`].
pub fn gage_errors(result: &CaseResult) -> Result<GageErrors, PresentError> {
    let table = gage_table(result)?;
    let panels: Vec<(String, String)> =
        table.rows[..result.case.panels.len()].iter().map(|row| (row.label.clone(), text(&row.cells[0]))).collect();
    let stages = table
        .columns
        .iter()
        .enumerate()
        .filter_map(|(column, heading)| {
            let name = heading.name.strip_suffix(" error")?;
            Some(stage(&table, name, column, panels.len()))
        })
        .collect();
    Ok(GageErrors { case: result.case.number, panels, stages })
}

fn text(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => text.clone(),
        _ => String::new(),
    }
}

fn stage(table: &Table, name: &str, column: usize, count: usize) -> Stage {
    let (computed, published) = table.rows[..count]
        .iter()
        .filter_map(|row| match row.cells[column] {
            Cell::Number { computed, published, .. } => Some((computed, published)),
            _ => None,
        })
        .unzip();
    Stage { name: name.to_owned(), computed, published }
}

const HEIGHT: f64 = 400.0;
/// Margins of the plot: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [66.0, 14.0, 50.0, 56.0];

impl GageErrors {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_gages", self.case);
        let title = format!("Case {}: gage errors by panel", self.case);
        svg(&name, &title, (WIDTH, HEIGHT), |area| self.on(area))
    }

    /// Tens that just hold every error, percent.
    fn bounds(&self) -> (f64, f64) {
        let values = || {
            let each = |stage: &Stage| {
                let published = stage.published.iter().copied().flatten();
                stage.computed.iter().copied().chain(published).collect::<Vec<_>>()
            };
            self.stages.iter().flat_map(each)
        };
        let least = values().fold(0.0, f64::min);
        let most = values().fold(0.0, f64::max);
        (10.0 * (least / 10.0 - 0.1).floor(), 10.0 * (most / 10.0 + 0.1).ceil())
    }

    fn on(&self, area: &Area) -> Drawn {
        let [left, right, top, bottom] = MARGINS;
        let (low, high) = self.bounds();
        let count = self.panels.len();
        let mut chart = ChartBuilder::on(area)
            .margin_right(units(right))
            .margin_top(units(top))
            .x_label_area_size(units(bottom))
            .y_label_area_size(units(left))
            .build_cartesian_2d(0.0..count as f64, low..high)?;
        let words = Letters::new(LETTERS, Side::Center);
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .bold_line_style(Pen::solid(PALE, 0.8).style())
            .light_line_style(TRANSPARENT)
            .axis_style(Pen::solid(INK, 1.0).style())
            .y_labels(((high - low) / 10.0) as usize + 2)
            .y_label_formatter(&|y| format!("{y:.0}").replace('-', "−"))
            .label_style(words.style())
            .axis_desc_style(words.style())
            .set_all_tick_mark_size(units(4.0))
            .draw()?;
        let plot = chart.plotting_area();
        let place = |x: f64, percent: f64| {
            let (x, y) = plot.map_coordinate(&(x, percent));
            (f64::from(x) / f64::from(units(1.0)), f64::from(y) / f64::from(units(1.0)))
        };
        name_upright(area, "gage error, percent of 0.010 in", 0.5 * (HEIGHT + top - bottom))?;
        for (row, (label, kind)) in self.panels.iter().enumerate() {
            let (x, y) = place(row as f64 + 0.5, low);
            write(area, &format!("{label} {kind}"), (x, y + 13.0), words)?;
            if row > 0 {
                let edge = [place(row as f64, low), place(row as f64, high)];
                line(area, &edge, Pen::solid(PALE, 0.6))?;
            }
        }
        let (x, y) = place(0.5 * count as f64, low);
        write(area, "panel: S shear, M membrane", (x, y + 38.0), words)?;
        let width = 0.84 / self.stages.len() as f64;
        for (s, stage) in self.stages.iter().enumerate() {
            for (row, &percent) in stage.computed.iter().enumerate() {
                let from = row as f64 + 0.08 + width * s as f64;
                let (upper, lower) = (place(from, percent.max(0.0)), place(from + width, percent.min(0.0)));
                bar(area, upper, lower, self.fill(s))?;
                if let (Some(published), true) = (stage.published[row], s > 0) {
                    let at = place(from + 0.5 * width, published);
                    mark(area, at, (Form::Diamond, 2.8), Some(ORANGE), Pen::solid(INK, 0.9))?;
                }
            }
        }
        line(area, &[place(0.0, 0.0), place(count as f64, 0.0)], Pen::solid(INK, 1.2))?;
        self.legend(area)
    }

    /// Stages darken from the first pass to the last; the start is white.
    fn fill(&self, stage: usize) -> RGBColor {
        match stage {
            0 => WHITE,
            _ => {
                let share = stage as f64 / (self.stages.len() - 1) as f64;
                between(between(WHITE, SKY, 0.5), BLUE, if self.stages.len() == 2 { 1.0 } else { share })
            }
        }
    }

    fn legend(&self, area: &Area) -> Drawn {
        let words = Letters::new(LETTERS, Side::Right);
        let mut x = MARGINS[0];
        for (s, stage) in self.stages.iter().enumerate() {
            bar(area, (x, 15.0), (x + 16.0, 29.0), self.fill(s))?;
            write(area, &stage.name.to_lowercase(), (x + 23.0, 22.0), words)?;
            x += 92.0;
        }
        if self.stages.iter().skip(1).any(|stage| stage.published.iter().any(Option::is_some)) {
            mark(area, (x + 8.0, 22.0), (Form::Diamond, 3.6), Some(ORANGE), Pen::solid(INK, 0.9))?;
            write(area, "published, on the bar of its pass", (x + 20.0, 22.0), words)?;
        }
        Ok(())
    }
}
