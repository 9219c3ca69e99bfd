//! The figures of the box and of the paper's cases, from what the runs gave.

use super::super::report::CaseReport;
use super::super::tables::unlimited::unlimited_factors;
use super::factors::{DrawnFactor, Factors};
use super::structure::draw_structure;
use super::{Figure, report_figures};
use super::{box_elements, cover_gages};
use corfem::present::PresentError;
use corfem::present::table::Digits;
use corfem::torque_box::wing_box::{TEST_GAGE, dynamic_points};
use corfem::torque_box::{CASES, Case, CaseResult};

/// The case that the box is shown with before and after its correlation, and whose first pass can be played with.
pub const SHOWN: usize = 2;

/// Every figure of the cases, in the order of the report: the box, then each case.
///
/// # Errors
/// The errors of the figures' data; [`PresentError::Drawing`].
pub fn case_figures(results: &[CaseResult]) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    if let Some(first) = results.first() {
        let case = &first.case;
        let caption = "Cases 1 to 4: the wing torque box with its structural and dynamic points (the paper's Figure 2).";
        let title = "Cases 1 to 4: the wing torque box, its structural and dynamic points";
        let (model, points) = (case.model()?, dynamic_points(&case.reconstruction)?);
        let drawn = draw_structure("box_points", title, model.structure(), &points)?;
        figures.push(Figure::drawn("box_points", caption, &drawn));
        // From the second case on covers are membranes.
        let case = &results.get(1).unwrap_or(first).case;
        let caption = "the box taken apart, its elements numbered (the paper's Figure 3).";
        let caption = format!("Case {}: {caption}", case.number);
        let drawn = box_elements::draw(case)?;
        figures.push(Figure::drawn("box_elements", caption, &drawn));
    }
    if let Some(shown) = results.iter().find(|result| result.case.number == SHOWN) {
        let caption = gages_caption(shown);
        let drawn = box_elements::draw_gages(shown)?;
        figures.push(Figure::drawn("box_gages", caption, &drawn));
    }
    let cases: Vec<Case> = results.iter().map(|result| result.case.clone()).collect();
    let caption = "Cases 1 to 4: cover gages of the test configuration (GVT) and of each first model (the paper's Figure 4); root at \
        the left.";
    let drawn = cover_gages::draw(&cases)?;
    figures.push(Figure::drawn("cover_gages", caption, &drawn));
    for result in results {
        add_figures_of(result, &mut figures)?;
    }
    Ok(figures)
}

/// Adds the figures of one case: those of its correlation, or of Case 4 the factors that its single iteration asks for; and its
/// derivatives.
fn add_figures_of(result: &CaseResult, figures: &mut Vec<Figure>) -> Result<(), PresentError> {
    let case = result.case.number;
    let mut all = report_figures(&CaseReport::new(result))?;
    for (name, number) in [
        ("case_1_errors", 5),
        ("case_1_mode_shapes", 6),
        ("case_2_errors", 7),
        ("case_3_errors", 8),
    ] {
        if let Some(figure) = all.iter_mut().find(|figure| figure.name == name) {
            let caption = figure.caption.trim_end_matches('.');
            figure.caption = format!("{caption} (the paper's Figure {number}).");
        }
    }
    if case == CASES[3] {
        let drawn = Factors {
            rows: unlimited_factors(result),
            limits: Some(result.case.settings.inner.factor_range),
            across: "unlimited stiffness change factor, first iteration",
            down: "element",
            origin: 1.0,
            decimals: 1,
        };
        let most = |is_it: fn(&DrawnFactor) -> bool| {
            let values = drawn.rows.iter().filter(|row| is_it(row));
            Digits::Fixed(1).write(values.map(|row| row.value).fold(0.0, f64::max))
        };
        let caption = format!(
            "Case 4: what the first iteration asks of every panel before any limit, on a linear scale: of the faulty one {} times its \
             stiffness, of any other {} times at most.",
            most(|row| row.remark.is_some()),
            most(|row| row.remark.is_none()),
        );
        let title = "Case 4: unlimited stiffness change factors";
        let svg = drawn.draw("case_4_factors", title)?;
        figures.push(Figure::drawn("case_4_factors", caption, &svg));
        all.retain(|figure| figure.name.ends_with("derivatives"));
    }
    figures.extend(all);
    Ok(())
}

/// Words on the gages of a case: how far they are off before, and how many still are, and how far, after.
fn gages_caption(result: &CaseResult) -> String {
    /// Distance from the test's gage within which one counts as found, a fraction.
    const NEAR: f64 = 0.06;
    let off = |gages: &[f64]| -> Vec<f64> {
        gages
            .iter()
            .map(|gage| (gage / TEST_GAGE - 1.0).abs())
            .collect()
    };
    let most =
        |off: &[f64]| Digits::Fixed(0).write(100.0 * off.iter().copied().fold(0.0, f64::max));
    let before = result.case.first_gages();
    let factors = result.correlation.best_factors.iter();
    let after: Vec<f64> = before.iter().zip(factors).map(|(a, b)| a * b).collect();
    let (before, after) = (off(&before), off(&after));
    let near = after.iter().filter(|off| **off <= NEAR).count();
    format!(
        "Case {}: how far every gage is off before and after, the box taken apart: up to {} % before; after, {near} of {} are within \
         {:.0} %, and the farthest is {} % off.",
        result.case.number,
        most(&before),
        after.len(),
        100.0 * NEAR,
        most(&after),
    )
}
