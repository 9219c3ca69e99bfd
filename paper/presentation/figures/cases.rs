//! The paper's Figures 2 to 8 from what the runs gave, and the box's gages before and after.

use super::super::report::CaseReport;
use super::mode_shapes::{differing, draw as draw_shapes, farthest};
use super::structure::draw_structure;
use super::{Figure, box_elements, cover_gages, error_history};
use corfem::present::PresentError;
use corfem::present::table::Digits;
use corfem::torque_box::wing_box::dynamic_points;
use corfem::torque_box::{Case, CaseResult};

/// The case that the box is shown with before and after its correlation, and whose first pass can be played with.
pub const SHOWN: usize = 2;

/// Every figure of the cases, in the order of the paper.
///
/// # Errors
/// The errors of the figures' data; [`PresentError::Drawing`].
pub fn case_figures(results: &[CaseResult]) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    let mut add = |name: &str, caption: &str, svg: &str| {
        figures.push(Figure::drawn(name, caption, svg));
    };
    if let Some(CaseResult { case, .. }) = results.first() {
        let caption = "Cases 1 to 4: the wing torque box with its structural and dynamic points (the paper's Figure 2).";
        let title = "Cases 1 to 4: the wing torque box, its structural and dynamic points";
        let (model, points) = (case.model()?, dynamic_points(&case.reconstruction)?);
        let drawn = draw_structure("box_points", title, model.structure(), &points)?;
        add("box_points", caption, &drawn);
    }
    // From the second case on covers are membranes.
    if let Some(shown) = results.iter().find(|result| result.case.number == SHOWN) {
        let caption = "Case 2: the box taken apart, its elements numbered (the paper's Figure 3).";
        add("box_elements", caption, &box_elements::draw(&shown.case)?);
        let caption = "Case 2: how far every gage is off before and after, the box taken apart.";
        add("box_gages", caption, &box_elements::draw_gages(shown)?);
    }
    let cases: Vec<Case> = results.iter().map(|result| result.case.clone()).collect();
    let caption = "Cases 1 to 4: cover gages of the test configuration (GVT) and of each first model (the paper's Figure 4); root at \
        the left.";
    add("cover_gages", caption, &cover_gages::draw(&cases)?);
    let of_paper = results.iter().zip([5, 7, 8]);
    for (result, figure) in of_paper.filter(|(result, _)| result.case.number < 4) {
        let (number, run) = (result.case.number, &result.correlation);
        let name = format!("case_{number}_errors");
        let [first, last] = [&run.initial, run.best_check()]
            .map(|state| Digits::Significant(2).write(100.0 * state.errors.sum()));
        let caption = format!(
            "Case {number}: errors against iteration. The error sum falls from {first} to {last} %. Between exact solutions an inner \
             loop steps by perturbation; at the end of a pass the exact solution says what that was worth (the paper's Figure {figure})."
        );
        let title = format!("Case {number}: errors against iteration");
        add(
            &name,
            &caption,
            &error_history::draw(&name, &title, result)?,
        );
        if number == 1 {
            let drawn = differing(&CaseReport::new(result))?;
            let points = dynamic_points(&result.case.reconstruction)?;
            let [first, last] = [1, 2].map(|state| Digits::Fixed(2).write(farthest(&drawn, state)));
            let caption = format!(
                "Case 1: mode shapes of the test, of the first and of the corrected model, where the first model's are farther from \
                 the test's than on average: by up to {first} of the largest motion, and the corrected model's by up to {last}; what \
                 lies between sensors is interpolated from those near it (the paper's Figure 6)."
            );
            let (name, title) = ("case_1_mode_shapes", "Case 1: mode shapes that differ");
            add(name, &caption, &draw_shapes(&drawn, &points, name, title)?);
        }
    }
    Ok(figures)
}
