//! Time of every stage against the degrees of freedom, on logarithmic scales, as the benches measured and stored it.

use super::canvas::*;
use plotters::prelude::{BindKeyPoints, IntoLogRange};

/// What `benches/large` and `benches/scipy_wing.py` write: stages in rows, wings by their DOF in columns.
const COSTS: &str = include_str!("../../../paper/costs.csv");
const HEIGHT: f64 = 470.0;
/// The stages that are drawn, from the most to the least on the smallest wing.
const STAGES: [(&str, RGBColor, Form, Dash); 8] = [
    (
        "20 modes by SciPy (not counted)",
        GRAY,
        Form::Diamond,
        Dash::Dotted,
    ),
    (
        "20 modes of the whole model (counted)",
        INK,
        Form::Diamond,
        Dash::Solid,
    ),
    ("analysis by SciPy", GRAY, Form::Circle, Dash::Dotted),
    ("analysis with all shares", BLUE, Form::Circle, Dash::Solid),
    (
        "element matrices (once)",
        ORANGE,
        Form::Square,
        Dash::Dashed,
    ),
    (
        "ordering and pattern (once)",
        ORANGE,
        Form::Diamond,
        Dash::Dashed,
    ),
    (
        "assembly and factorization",
        VERMILION,
        Form::Square,
        Dash::Solid,
    ),
    (
        "inner loop of the first pass",
        SKY,
        Form::Square,
        Dash::Dashed,
    ),
];

/// DOF and milliseconds of a stored stage, without the wings on which it was not measured.
pub fn measured(stage: &str) -> Vec<(f64, f64)> {
    let cells = |line: &'static str| line.split(',').skip(2).map(|cell| cell.parse().ok());
    let row = COSTS
        .lines()
        .find(|line| line.split(',').next() == Some(stage))
        .unwrap_or_default();
    let dof = cells(COSTS.lines().next().unwrap_or_default());
    dof.zip(cells(row))
        .filter_map(|(dof, time)| dof.zip(time))
        .collect()
}

/// The exponent $p$ of $t = c n^p$ nearest to points $(n, t)$ by the squares of its logarithms; not finite for less than two.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let middle = points.iter().map(|point| point.0.ln()).sum::<f64>() / points.len() as f64;
    let moment = |of: fn(&(f64, f64)) -> f64| {
        points
            .iter()
            .map(|at| (at.0.ln() - middle) * of(at).ln())
            .sum::<f64>()
    };
    moment(|point| point.1) / moment(|point| point.0)
}

/// All stages in one chart, each with its exponent.
pub fn draw(name: &str, title: &str) -> Result<String, PresentError> {
    svg(name, title, HEIGHT, |area| {
        let dof = (1e3..1.2e6)
            .log_scale()
            .with_key_points(vec![1e3, 1e4, 1e5, 1e6]);
        let time = (0.5..3e5)
            .log_scale()
            .with_key_points(vec![1.0, 10.0, 100.0, 1e3, 1e4, 1e5]);
        let mut chart = chart(area, [66.0, 340.0, 20.0, 50.0]).build_cartesian_2d(dof, time)?;
        axes(&mut chart)
            .x_label_formatter(&|x| format!("{x}"))
            .y_label_formatter(&|x| format!("{x}"))
            .draw()?;
        for (row, (stage, color, form, dash)) in STAGES.into_iter().enumerate() {
            let points = measured(stage);
            let (at, look) = (
                36.0 + 44.0 * row as f64,
                Mark(form, 3.5, Some(color), Pen::solid(color, 1.0)),
            );
            let places: Vec<Place> = points
                .iter()
                .map(|&(dof, time)| placed(&chart, dof, time))
                .collect();
            for places in [&places, &vec![(436.0, at), (470.0, at)]] {
                line(area, places, Pen(color, 1.8, dash))?;
            }
            places
                .iter()
                .chain([&(453.0, at)])
                .try_for_each(|&place| mark(area, place, look))?;
            write(area, stage, (480.0, at), START)?;
            write(
                area,
                &format!("exponent {:.2}", exponent(&points)),
                (480.0, at + 17.0),
                START.small(),
            )?;
        }
        write(
            area,
            "structural degrees of freedom",
            (250.0, HEIGHT - 12.0),
            MIDDLE,
        )?;
        name_upright(area, "milliseconds", 0.5 * HEIGHT)
    })
}
