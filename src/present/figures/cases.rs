//! The figures of the box and of the paper's cases, from what the runs gave.

use super::bars::{BarFigure, Bars, Series};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::planform::Planform;
use super::{Figure, box_elements, box_points, cover_gages, error_history, factors, node_lines};
use crate::cases::{CASES, Case, CaseResult};
use crate::method::derivatives::{DERIVATIVE_STEP, by_definition};
use crate::method::model::Check;
use crate::method::modes::ModeSet;
use crate::method::pairing::{cross_orthogonality, modal_assurance};
use crate::method::state::ModalState;
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
    let mut add = |name: &str, caption: &str, svg: String| {
        figures.push(Figure {
            name: name.to_owned(),
            caption: caption.to_owned(),
            svg,
        });
    };
    if let Some(first) = results.first() {
        add(
            "box_points",
            "The wing torque box with its structural and dynamic points (the paper's Figure 2).",
            box_points::box_points(&first.case)?.draw()?,
        );
        add(
            "box_elements",
            "The box taken apart, its elements numbered (Figure 3).",
            box_elements::draw(&box_elements::box_elements(&first.case)?)?,
        );
    }
    let cases: Vec<Case> = results.iter().map(|result| result.case.clone()).collect();
    add(
        "cover_gages",
        "Cover gages of the test configuration and of each first model (Figure 4); root at the left.",
        cover_gages::draw(&cover_gages::cover_gages(&cases))?,
    );
    for result in results {
        figures.extend(figures_of(result)?);
    }
    Ok(figures)
}

/// A drawing that is given its name and title.
type Draw<'a> = &'a dyn Fn(&str, &str) -> Result<String, PresentError>;

/// The figures of one case: of its passes or, in Case 4, of its single iteration; and its derivatives.
fn figures_of(result: &CaseResult) -> Result<Vec<Figure>, PresentError> {
    let case = result.case.number;
    let mut figures = Vec::new();
    let mut add = |name: &str, title: &str, caption: &str, draw: Draw| {
        let name = format!("case_{case}_{name}");
        let svg = draw(&name, &format!("Case {case}: {title}"))?;
        let caption = format!("Case {case}: {caption}.");
        figures.push(Figure { name, caption, svg });
        Ok::<_, PresentError>(())
    };
    let correlation = &result.correlation;
    if case == CASES[3] {
        let asked = unlimited_factors(result);
        let limits = result.case.settings.inner.factor_range;
        add(
            "factors",
            "unlimited stiffness change factors",
            "what the first iteration asks of every panel before any limit, on a linear scale",
            &|name, title| factors::draw(name, title, &asked, limits, "published (“about 60”)"),
        )?;
    } else {
        let (errors, nodes) = match case {
            1 => (" (Figure 5)", " (Figure 6)"),
            2 => (" (Figure 7)", ""),
            _ => (" (Figure 8)", ""),
        };
        let history = error_history::error_history(correlation, &result.case.settings);
        let caption = format!(
            "errors against iteration{errors}. Between exact solutions the inner loop steps by perturbation; the gap at the end of a pass is what freezing the transformation cost"
        );
        add(
            "errors",
            "errors against iteration",
            &caption,
            &|name, title| error_history::draw(name, title, &history),
        )?;
        let gages = gage_bars(result)?;
        let caption = "gage errors of every panel at the start and after each pass";
        add("gages", "gage errors by panel", caption, &|name, title| {
            gages.draw(name, title)
        })?;
        let planform = Planform::of(&result.case.reconstruction);
        let modes = node_lines::node_lines(planform, &result.test, correlation)?;
        let caption = format!(
            "node lines in plan{nodes}, root at the left. Displacements are interpolated along ribs as the load distribution does and linearly between ribs"
        );
        add("node_lines", "node lines", &caption, &|name, title| {
            modes.draw(name, title)
        })?;
        let caption = "mode shapes of the mid-plane, the largest displacement of each the same";
        add("mode_shapes", "mode shapes", caption, &|name, title| {
            modes.draw_shapes(name, title)
        })?;
        let ends = [&correlation.initial, last_check(correlation)];
        let maps = mode_agreement(ends, &result.test, &result.case.reconstruction.mass())?;
        let title = "analysis against test modes before and after";
        let caption =
            "cross-orthogonality and modal assurance criterion of analysis and test modes";
        add("agreement", title, caption, &|name, title| {
            let note = "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.";
            draw_by_twos(name, title, &maps, &[note])
        })?;
    }
    let maps = derivatives(result)?;
    let title = "derivatives of the first model";
    let caption = "derivatives of the frequencies and of the error sum at the first model";
    add("derivatives", title, caption, &|name, title| {
        draw_derivatives(name, title, &maps)
    })?;
    Ok(figures)
}

/// Gage errors of a case by panel, at the start and after every pass.
///
/// # Errors
/// Those of [`gage_errors`].
pub fn gage_bars(result: &CaseResult) -> Result<BarFigure, PresentError> {
    let panels = result.case.panels.iter();
    let mut series: Vec<Series> = gage_errors(result)?
        .into_iter()
        .map(|(name, values)| Series {
            name: name.to_lowercase(),
            values,
        })
        .collect();
    // The start is given: nothing is to be compared there.
    for (_, published) in series
        .iter_mut()
        .take(1)
        .flat_map(|start| &mut start.values)
    {
        *published = None;
    }
    let chart = Bars {
        heading: String::new(),
        groups: panels
            .map(|panel| format!("{} {}", panel.label, kind_letter(panel.kind)))
            .collect(),
        series,
        divided: None,
    };
    Ok(BarFigure {
        charts: vec![chart],
        across: "panel: S shear, M membrane".to_owned(),
        up: "gage error, percent of 0.010 in".to_owned(),
        marked: "published, on the bar of its pass".to_owned(),
    })
}

/// Numbers from one, as labels.
pub(super) fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}

/// Cross-orthogonality $V_F^t M V_G$ (4) and modal assurance criterion of the exact solutions before and after, analysis
/// modes by test modes.
///
/// # Errors
/// [`WrongShape`](crate::method::error::Error::WrongShape) when shapes and mass do not fit.
pub fn mode_agreement(
    ends: [&Check; 2],
    test: &ModeSet,
    mass: &DMatrix<f64>,
) -> Result<[HeatMap; 4], PresentError> {
    let map = |title: &str, values: DMatrix<f64>| HeatMap {
        title: title.to_owned(),
        rows: ("analysis mode".to_owned(), numbers(values.nrows())),
        columns: ("test mode".to_owned(), numbers(values.ncols())),
        values: values.map(Some),
        full: 1.0,
        written: (100.0, 0),
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
/// with the mode paired with test mode $i$ (parameters × test modes), and that of the error sum, $\Delta e_e/0.001$ of (12),
/// in the first iteration (parameters × 1).
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
