//! Table 1 for a reader: root errors of the perturbation formulae by order.

use super::{Cell, Digits, PresentError, Table};
use crate::cases::table_1::{Formula, formulae, problems};

/// Orders shown.
const ORDERS: usize = 6;

/// The larger error of the two roots of every problem, in percent, by rule and order.
///
/// The paper's own numbers, and its problems, are lost in the scan: nothing stands beside these.
///
/// # Errors
/// Those of [`crate::cases::table_1::TwoMasses::root_errors`].
pub fn root_error_table() -> Result<Table, PresentError> {
    let formulae = formulae(ORDERS);
    let title = "Largest root error of two-degree-of-freedom problems (Table 1, computed anew)";
    let mut table = Table::new("table_1", title, "Problem")
        .columns(["Coupling", "Change"], "")
        .columns(formulae.iter().map(|&rule| rule_name(rule)), "%")
        .note(
            "Two unit masses on unit springs to the ground, joined by the coupling spring; the first ground spring \
        is changed. Exact roots in closed form. The paper's own numbers are lost in the scan.",
        );
    for (number, problem) in problems().into_iter().enumerate() {
        let errors = formulae.iter().map(|&formula| problem.root_errors(formula)).collect::<Result<Vec<_>, _>>()?;
        let springs = [problem.coupling, problem.change].map(|value| Cell::number(value, Digits::Fixed(2)));
        let largest = errors.iter().map(|[one, other]| one.abs().max(other.abs()));
        let cells = largest.map(|error| Cell::percent(error, Digits::Scientific(1)));
        table.row(number + 1, springs.into_iter().chain(cells));
    }
    Ok(table)
}

fn rule_name(rule: Formula) -> String {
    match rule {
        Formula::FirstOrder => "First order".to_owned(),
        Formula::Original => "Original".to_owned(),
        Formula::Recursive1 { order } => format!("Recursive 1, order {order}"),
        Formula::Recursive2 { order } => format!("Recursive 2, order {order}"),
    }
}
