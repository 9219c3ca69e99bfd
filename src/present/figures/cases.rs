//! The figures of the box and of the paper's cases, from what the runs gave.

use super::bars::{BarFigure, Bars, Series};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::planform::Planform;
use super::{Figure, box_elements, box_points, cover_gages, error_history, factors, node_lines};
use crate::cases::readings::{columns_of, run_by_reading};
use crate::cases::{CASES, Case, CaseResult};
use crate::method::derivatives::{DERIVATIVE_STEP, by_definition};
use crate::method::model::Check;
use crate::method::modes::ModeSet;
use crate::method::pairing::{cross_orthogonality, modal_assurance};
use crate::method::state::ModalState;
use crate::method::step::StepRule;
use crate::present::PresentError;
use crate::present::tables::cases::{gage_errors, unlimited_factors};
use crate::present::tables::correlation::last_check;
use crate::present::tables::kind_letter;
use nalgebra::DMatrix;

/// Every figure of the cases, in the order of the report: the box, then each case.
///
/// # Errors
/// Those of the figures' data; [`PresentError::Drawing`].
pub fn case_figures(results: &[CaseResult]) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    if let Some(CaseResult { case, .. }) = results.first() {
        let caption = "The wing torque box with its structural and dynamic points (the paper's Figure 2).";
        figures.push(Figure::new("box_points", caption, box_points::box_points(case)?.draw()?));
        let caption = "The box taken apart, its elements numbered (Figure 3).";
        figures.push(Figure::new("box_elements", caption, box_elements::draw(case)?));
    }
    let cases: Vec<Case> = results.iter().map(|result| result.case.clone()).collect();
    let caption = "Cover gages of the test configuration and of each first model (Figure 4); root at the left.";
    figures.push(Figure::new("cover_gages", caption, cover_gages::draw(&cover_gages::cover_gages(&cases))?));
    for result in results {
        add_figures_of(result, &mut figures)?;
    }
    Ok(figures)
}

/// Adds the figures of one case: of its passes or, in Case 4, of its single iteration; and its derivatives.
fn add_figures_of(result: &CaseResult, figures: &mut Vec<Figure>) -> Result<(), PresentError> {
    type Draw<'a> = &'a dyn Fn(&str, &str) -> Result<String, PresentError>;
    let case = result.case.number;
    let mut add = |name: &str, title: &str, caption: &str, draw: Draw| {
        let name = format!("case_{case}_{name}");
        let svg = draw(&name, &format!("Case {case}: {title}"))?;
        figures.push(Figure::new(&name, format!("Case {case}: {caption}."), svg));
        Ok::<_, PresentError>(())
    };
    let correlation = &result.correlation;
    if case == CASES[3] {
        let (asked, limits) = (unlimited_factors(result), result.case.settings.inner.factor_range);
        let caption = "what the first iteration asks of every panel before any limit, on a linear scale";
        add("factors", "unlimited stiffness change factors", caption, &|name, title| {
            factors::draw(name, title, &asked, limits, "published (“about 60”)")
        })?;
    } else {
        let (errors, nodes) = [(" (Figure 5)", " (Figure 6)"), (" (Figure 7)", ""), (" (Figure 8)", "")][case - 1];
        let history = error_history::error_history(correlation, &result.case.settings);
        let caption = format!(
            "errors against iteration{errors}. Between exact solutions the inner loop steps by perturbation; the gap \
            at the end of a pass is what freezing the transformation cost"
        );
        add("errors", "errors against iteration", &caption, &|name, title| error_history::draw(name, title, &history))?;
        let gages = gage_bars(result)?;
        let caption = "gage errors of every panel at the start and after each pass";
        add("gages", "gage errors by panel", caption, &|name, title| gages.draw(name, title))?;
        let by_readings = reading_bars(result)?;
        let caption = "gage errors by three readings of the step beside the printed ones, pass by pass";
        add("readings", "gage errors by readings of the step", caption, &|name, title| by_readings.draw(name, title))?;
        let planform = Planform::of(&result.case.reconstruction);
        let modes = node_lines::node_lines(planform, &result.test, correlation)?;
        let caption = format!(
            "node lines in plan{nodes}, root at the left. Displacements are interpolated along ribs as the load \
            distribution does and linearly between ribs"
        );
        add("node_lines", "node lines", &caption, &|name, title| modes.draw(name, title))?;
        let caption = "mode shapes of the mid-plane, the largest displacement of each the same";
        add("mode_shapes", "mode shapes", caption, &|name, title| modes.draw_shapes(name, title))?;
        let ends = [&correlation.initial, last_check(correlation)];
        let maps = mode_agreement(ends, &result.test, &result.case.reconstruction.mass())?;
        let caption = "cross-orthogonality and modal assurance criterion of analysis and test modes";
        add("agreement", "analysis against test modes before and after", caption, &|name, title| {
            let note = "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.";
            draw_by_twos(name, title, &maps, &[note])
        })?;
    }
    let maps = derivatives(result)?;
    let caption = "derivatives of the frequencies and of the error sum at the first model";
    let draw: Draw = &|name, title| draw_derivatives(name, title, &maps);
    add("derivatives", "derivatives of the first model", caption, draw)
}

/// Gage errors of a case by panel, at the start and after every pass.
///
/// # Errors
/// Those of [`gage_errors`].
pub fn gage_bars(result: &CaseResult) -> Result<BarFigure, PresentError> {
    let mut stages = gage_errors(result)?;
    // The start is given: nothing is to be compared there.
    stages[0].1.iter_mut().for_each(|(_, published)| *published = None);
    let series = stages.into_iter().map(|(name, values)| Series { name: name.to_lowercase(), values }).collect();
    Ok(BarFigure {
        charts: vec![Bars { heading: String::new(), groups: panel_names(result), series, divided: None }],
        across: "panel: S shear, M membrane".to_owned(),
        up: "gage error, percent of 0.010 in".to_owned(),
        marked: "published, on the bar of its pass".to_owned(),
    })
}

/// Gage errors of a case by panel and by readings of the step, a chart for every pass that the paper prints.
///
/// # Errors
/// Those of [`run_by_reading`] and of the published tables.
pub fn reading_bars(result: &CaseResult) -> Result<BarFigure, PresentError> {
    let mut charts: Vec<Bars> = Vec::new();
    for reading in [StepRule::Matrix, StepRule::Own, StepRule::Relative] {
        for (row, column) in columns_of(&run_by_reading(&result.case, reading)?)?.iter().enumerate() {
            let pairs = column.errors().zip(&column.published_errors);
            let values = pairs.map(|(error, printed)| (100.0 * error, Some(100.0 * printed))).collect();
            if row == charts.len() {
                let (heading, groups) = (format!("Pass {}", row + 1), panel_names(result));
                charts.push(Bars { heading, groups, series: Vec::new(), divided: None });
            }
            charts[row].series.push(Series { name: reading.name().to_owned(), values });
        }
    }
    let (across, up) = ("panel: S shear, M membrane".to_owned(), "gage error, percent of 0.010 in".to_owned());
    Ok(BarFigure { charts, across, up, marked: "published".to_owned() })
}

/// Numbers and kinds of a case's panels.
fn panel_names(result: &CaseResult) -> Vec<String> {
    let panels = result.case.panels.iter();
    panels.map(|panel| format!("{} {}", panel.label, kind_letter(panel.kind))).collect()
}

/// Numbers from one, as labels.
pub(super) fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}

/// Cross-orthogonality $V_F^t M V_G$ (4) and modal assurance criterion of the exact solutions before and after,
/// analysis modes by test modes.
///
/// # Errors
/// [`WrongShape`](crate::method::error::Error::WrongShape) when shapes and mass do not fit.
pub fn mode_agreement(ends: [&Check; 2], test: &ModeSet, mass: &DMatrix<f64>) -> Result<[HeatMap; 4], PresentError> {
    let map = |title: &str, values: DMatrix<f64>| {
        let rows = ("analysis mode".to_owned(), numbers(values.nrows()));
        let columns = ("test mode".to_owned(), numbers(values.ncols()));
        HeatMap { title: title.to_owned(), rows, columns, values: values.map(Some), full: 1.0, written: (100.0, 0) }
    };
    let [before, after] = ends.map(|check| &check.modes);
    let cross = |modes: &ModeSet| cross_orthogonality(modes, test, mass);
    let assurance = |modes: &ModeSet| modal_assurance(&modes.shapes, &test.shapes);
    Ok([
        map("Cross-orthogonality before", cross(before)?),
        map("Cross-orthogonality after", cross(after)?),
        map("Modal assurance criterion before", assurance(before)?),
        map("Modal assurance criterion after", assurance(after)?),
    ])
}

/// Derivatives of a case's first model by the stiffness of each parameter: relative ones of the frequencies
///
/// $$ \frac{\partial \ln f_i}{\partial \ln k_e} = \frac{V_i^t K_e V_i}{2\omega_i^2} $$
///
/// with the mode paired with test mode $i$ (parameters × test modes), and that of the error sum, $\Delta e_e/0.001$ of
/// (12), in the first iteration (parameters × 1).
///
/// # Errors
/// Those of the model, its analysis and [`by_definition`].
pub fn derivatives(result: &CaseResult) -> Result<[HeatMap; 2], PresentError> {
    let model = result.case.model()?;
    let factors = vec![1.0; result.parameter_names.len()];
    let first = model.analyze(&factors, &result.test, None)?;
    let error_changes = by_definition(&first, &ModalState::start(&first))?;
    let exact = &first.exact;
    let frequency = DMatrix::from_fn(factors.len(), result.test.len(), |e, j| {
        let i = exact.pairing.analysis_mode[j];
        first.shares[e].matrix()[(i, i)] / (2.0 * exact.modes.omega_squared[i])
    });
    let error_sum = DMatrix::from_fn(factors.len(), 1, |e, _| error_changes[e] / DERIVATIVE_STEP);
    let map = |title: &str, rows: &str, columns: &str, labels, values: DMatrix<f64>| HeatMap {
        title: title.to_owned(),
        rows: (rows.to_owned(), result.parameter_names.clone()),
        columns: (columns.to_owned(), labels),
        full: values.amax(),
        values: values.map(Some),
        written: (1.0, 2),
    };
    let percent = "Percent of frequency for one percent of stiffness";
    let modes = numbers(result.test.len());
    let stiffness = vec!["one percent of stiffness".to_owned()];
    Ok([
        map(percent, "panel", "test mode", modes, frequency),
        map("Error sum", "", "percent points for", stiffness, error_sum),
    ])
}
