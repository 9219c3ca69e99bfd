//! Charts: axes in the style of all figures, and where a point of them lies.

use super::canvas::{Area, INK, MIDDLE, PALE, Pen, Place, UNITS, top, units};
use plotters::chart::MeshStyle;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;

/// A chart with room for its axes: left, right, top and bottom margins, px.
pub fn chart<'a, 'b>(
    area: &'a Area<'b>,
    margins: [f64; 4],
) -> ChartBuilder<'a, 'b, SVGBackend<'b>> {
    let [left, right, top, bottom] = margins.map(units);
    let mut chart = ChartBuilder::on(area);
    chart
        .margin_right(right)
        .margin_top(top)
        .x_label_area_size(bottom)
        .y_label_area_size(left);
    chart
}

pub type Chart<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

/// Axes in the style of all figures, to be drawn.
pub fn axes<'a, 'b, 'c, X, Y>(
    chart: &'c mut Chart<'a, 'b, X, Y>,
) -> MeshStyle<'a, 'c, X, Y, SVGBackend<'b>>
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let mut mesh = chart.configure_mesh();
    mesh.bold_line_style(Pen::solid(PALE, 0.8).style())
        .light_line_style(TRANSPARENT)
        .axis_style(Pen::solid(INK, 1.0).style())
        .label_style(MIDDLE.style())
        .axis_desc_style(MIDDLE.style())
        .set_all_tick_mark_size(units(4.0));
    mesh
}

/// Place of a chart's point on what the chart is drawn on.
pub fn placed(
    area: &Area,
    chart: &Chart<impl Ranged<ValueType = f64>, impl Ranged<ValueType = f64>>,
    x: f64,
    y: f64,
) -> Place {
    let (x, y) = chart.plotting_area().map_coordinate(&(x, y));
    (f64::from(x) / UNITS, f64::from(y) / UNITS - top(area))
}
