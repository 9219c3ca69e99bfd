//! Percent errors as groups of bars: of panels stage by stage, and of modes model by model.

use super::canvas::*;

/// Bars of one color: what they are, and one value a group with the published one to mark on it, if there is any.
#[derive(Debug, Clone, PartialEq)]
pub struct BarSeries {
    /// What the legend says.
    pub name: String,
    /// Computed and published values, percent.
    pub values: Vec<(f64, Option<f64>)>,
}

/// Bars side by side: one group for each label, one bar in it for each series.
#[derive(Debug, Clone, PartialEq)]
pub struct Bars {
    /// What the chart shows, above it.
    pub heading: String,
    /// Labels of the groups.
    pub groups: Vec<String>,
    /// Series, with as many values as there are groups.
    pub series: Vec<BarSeries>,
    /// Groups before and after which number of them, with what the two sides are, if they are to be told apart.
    pub divided: Option<(usize, [&'static str; 2])>,
}

/// Charts below one another with one legend and one scale.
#[derive(Debug, Clone, PartialEq)]
pub struct BarFigure {
    /// The charts, of like series.
    pub charts: Vec<Bars>,
    /// Name of the horizontal axis.
    pub across: String,
    /// Name of the vertical axis.
    pub up: String,
    /// What a mark on a bar is.
    pub marked: String,
}

/// Left and right edge of the charts, height of one with its heading, and heights above and below all of them, px.
const EDGES: [f64; 2] = [66.0, 746.0];
const CHART: f64 = 256.0;
const HEADING: f64 = 66.0;
const HEAD: f64 = 14.0;
const FOOT: f64 = 54.0;
/// Most steps of the vertical axis.
const MOST_STEPS: f64 = 6.0;

/// Lower and upper end of an axis that holds all values with a little room; for errors of round-off alone it still has
/// a length.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((0.0, 1e-3), |(low, high), v| (v.min(low), v.max(high)));
    let room = 0.03 * (high - low);
    (low - room, high + room)
}

/// The series' colors: white for the first, which is the start; those between darken to the last.
fn fill(series: usize, count: usize) -> RGBColor {
    match series {
        0 => WHITE,
        _ => between(
            between(WHITE, SKY, 0.5),
            BLUE,
            series as f64 / (count - 1) as f64,
        ),
    }
}

impl BarFigure {
    /// The figure as SVG.
    pub fn draw(&self, name: &str, title: &str) -> Result<String, PresentError> {
        let height = HEAD + CHART * self.charts.len() as f64 + FOOT;
        svg(name, title, height, |area| self.on(area, height))
    }

    fn on(&self, area: &Area, height: f64) -> Drawn {
        let values = || {
            self.charts
                .iter()
                .flat_map(|chart| &chart.series)
                .flat_map(|series| &series.values)
        };
        let ends = ends(values().flat_map(|(value, marked)| [*value, marked.unwrap_or(*value)]));
        for (row, chart) in self.charts.iter().enumerate() {
            let top = HEAD + CHART * row as f64 + HEADING;
            chart.on(area, [top, height - top - (CHART - HEADING)], ends)?;
        }
        let center = 0.5 * (EDGES[0] + EDGES[1]);
        write(area, &self.across, (center, height - 14.0), MIDDLE)?;
        name_upright(area, &self.up, 0.5 * (height + HEAD + HEADING - FOOT))?;
        let first = self.charts.first().map_or(&[][..], |chart| &chart.series);
        let mut x = EDGES[0];
        for (row, series) in first.iter().enumerate() {
            bar(area, (x, 15.0), (x + 16.0, 29.0), fill(row, first.len()))?;
            write(area, &series.name, (x + 23.0, 22.0), START)?;
            x += 38.0 + 7.2 * series.name.len() as f64;
        }
        if values().any(|(_, marked)| marked.is_some()) {
            marked(area, (x + 8.0, 22.0), PUBLISHED, &self.marked)?;
        }
        Ok(())
    }
}

impl Bars {
    /// The chart with its top and bottom margins.
    fn on(&self, area: &Area, [top, bottom]: [f64; 2], (low, high): (f64, f64)) -> Drawn {
        let count = self.groups.len();
        let margins = [EDGES[0], WIDTH - EDGES[1], top, bottom];
        let mut chart = chart(area, margins).build_cartesian_2d(0.0..count as f64, low..high)?;
        let decimals = (-((high - low) / MOST_STEPS).log10().floor()).max(0.0) as usize;
        axes(&mut chart)
            .disable_x_mesh()
            .disable_x_axis()
            .y_labels(MOST_STEPS as usize + 2)
            .y_label_formatter(&|y| signed(format!("{y:.decimals$}")))
            .draw()?;
        let place = |x: f64, percent: f64| placed(&chart, x, percent);
        write(area, &self.heading, (EDGES[0], top - 14.0), START.bold())?;
        for (row, label) in self.groups.iter().enumerate() {
            let (x, y) = place(row as f64 + 0.5, low);
            write(area, label, (x, y + 14.0), MIDDLE)?;
            if row > 0 {
                let edge = [place(row as f64, low), place(row as f64, high)];
                line(area, &edge, Pen::solid(PALE, 0.6))?;
            }
        }
        let width = 0.84 / self.series.len() as f64;
        for (s, series) in self.series.iter().enumerate() {
            for (row, &(percent, published)) in series.values.iter().enumerate() {
                let from = row as f64 + 0.08 + width * s as f64;
                let upper = place(from, percent.max(0.0));
                let lower = place(from + width, percent.min(0.0));
                bar(area, upper, lower, fill(s, self.series.len()))?;
                if let Some(published) = published {
                    mark(area, place(from + 0.5 * width, published), PUBLISHED)?;
                }
            }
        }
        let zero = [place(0.0, 0.0), place(count as f64, 0.0)];
        line(area, &zero, Pen::solid(INK, 1.2))?;
        let Some((before, [left, right])) = self.divided.filter(|(before, _)| *before < count)
        else {
            return Ok(());
        };
        let (x, y) = place(before as f64, low);
        line(area, &[(x, top - 22.0), (x, y)], Pen::dashed(INK, 1.0))?;
        write(area, left, (x - 8.0, top - 14.0), END.small())?;
        write(area, right, (x + 8.0, top - 14.0), START.small())
    }
}
