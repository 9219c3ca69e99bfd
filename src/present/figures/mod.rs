//! The figures: what they show as data first, then their drawing as SVG.
//!
//! Each module has a function that takes what a run gave and returns the figure's data, and a method of that data that
//! draws it. The same data give the same bytes. [`picture`] makes PNG of an SVG.

pub mod box_elements;
pub mod box_points;
mod canvas;
pub mod cover_gages;
pub mod derivative_map;
pub mod error_history;
pub mod gage_errors;
mod heat_map;
pub mod mode_agreement;
pub mod node_lines;
pub mod picture;
pub mod planform;
pub mod predictions;
pub mod stiffness_change;
pub mod truncation;
pub mod unlimited_factors;
mod view;

use crate::cases::fewer_modes::FewerModesRun;
use crate::cases::{CASES, Case, CaseResult};
use crate::present::error::PresentError;
use crate::studies::matrix_comparison::MatrixComparison;

/// A figure, drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name for files, such as `case_1_errors`.
    pub name: String,
    /// What to see in it.
    pub caption: String,
    /// The drawing.
    pub svg: String,
}

/// Figures of what is compared with the cases: fewer modes, then corrections of matrices.
///
/// # Errors
/// [`PresentError::Drawing`].
pub fn comparison_figures(
    case: usize,
    runs: &[FewerModesRun],
    comparison: &MatrixComparison,
) -> Result<Vec<Figure>, PresentError> {
    let changes = stiffness_change::stiffness_change(comparison);
    let predictions = predictions::predictions(comparison);
    let (corrected, given) = (comparison.case, comparison.test_modes);
    Ok(vec![
        Figure {
            name: "truncation".to_owned(),
            caption: format!(
                "Case {case} with fewer modes: what is left of the errors after the first pass, for every number of test modes and of analysis modes."
            ),
            svg: truncation::truncation(case, runs).draw()?,
        },
        Figure {
            name: "matrices_stiffness".to_owned(),
            caption: format!(
                "Case {corrected} corrected with {given} test modes: change of the dynamic stiffness entry by entry, the right one, by element factors, and by closed forms on the matrices."
            ),
            svg: changes.draw()?,
        },
        Figure {
            name: "matrices_frequencies".to_owned(),
            caption: format!(
                "Case {corrected} corrected with {given} test modes: frequency errors of the box as tested and with every cover thicker, a set of gages that no correction was fitted to."
            ),
            svg: predictions.draw()?,
        },
    ])
}

/// Every figure of the cases, in the order of the report: the box, then each case.
///
/// # Errors
/// Those of the figures' data; [`PresentError::Drawing`].
pub fn all_figures(results: &[CaseResult]) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    let mut add = |name: &str, caption: String, svg: String| {
        figures.push(Figure { name: name.to_owned(), caption, svg });
    };
    if let Some(first) = results.first() {
        add(
            "box_points",
            "The wing torque box with its structural and dynamic points (the paper's Figure 2).".into(),
            box_points::box_points(&first.case)?.draw()?,
        );
        add(
            "box_elements",
            "The box taken apart, its elements numbered (Figure 3).".into(),
            box_elements::box_elements(&first.case)?.draw()?,
        );
    }
    let cases: Vec<Case> = results.iter().map(|result| result.case.clone()).collect();
    add(
        "cover_gages",
        "Cover gages of the test configuration and of each first model (Figure 4); root at the left.".into(),
        cover_gages::cover_gages(&cases).draw()?,
    );
    for result in results {
        let case = result.case.number;
        if case == CASES[3] {
            add(
                &format!("case_{case}_factors"),
                format!(
                    "Case {case}: what the first iteration asks of every panel before any limit, on a linear scale."
                ),
                unlimited_factors::unlimited_factors(result).draw()?,
            );
        } else {
            for (name, caption, svg) in correlated(result)? {
                add(&format!("case_{case}_{name}"), format!("Case {case}: {caption}"), svg);
            }
        }
        add(
            &format!("case_{case}_derivatives"),
            format!("Case {case}: derivatives of the frequencies and of the error sum at the first model."),
            derivative_map::derivative_map(result)?.draw()?,
        );
    }
    Ok(figures)
}

/// Figures of a case that is carried through its passes: name, caption, drawing.
fn correlated(result: &CaseResult) -> Result<Vec<(&'static str, String, String)>, PresentError> {
    let nodes = node_lines::node_lines(result)?;
    let paper = match result.case.number {
        1 => " (Figure 5)",
        2 => " (Figure 7)",
        _ => " (Figure 8)",
    };
    let paper_nodes = if result.case.number == 1 { " (Figure 6)" } else { "" };
    Ok(vec![
        (
            "errors",
            format!(
                "errors against iteration{paper}. Between exact solutions the inner loop steps by perturbation; the gap at the end of a pass is what freezing the transformation cost."
            ),
            error_history::error_history(result).draw()?,
        ),
        (
            "gages",
            "gage errors of every panel at the start and after each pass.".to_owned(),
            gage_errors::gage_errors(result)?.draw()?,
        ),
        (
            "node_lines",
            format!(
                "node lines in plan{paper_nodes}, root at the left. Displacements are interpolated along ribs as the load distribution does and linearly between ribs."
            ),
            nodes.draw()?,
        ),
        (
            "mode_shapes",
            "mode shapes of the mid-plane, the largest displacement of each the same.".to_owned(),
            nodes.draw_shapes()?,
        ),
        (
            "agreement",
            "cross-orthogonality and modal assurance criterion of analysis and test modes.".to_owned(),
            mode_agreement::mode_agreement(result)?.draw()?,
        ),
    ])
}
