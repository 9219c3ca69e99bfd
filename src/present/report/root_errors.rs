//! Table 1 for a reader: root errors of the perturbation formulae by order.

use super::correlation_tables::column;
use super::table::{Cell, Digits, Row, Table};
use crate::cases::table_1::{problems, table_1};

use crate::cases::table_1::Formula;
use crate::present::error::PresentError;

/// Orders shown.
const ORDERS: usize = 6;

/// The larger error of the two roots of every problem, in percent, by rule and order.
///
/// The paper's own numbers, and its problems, are lost in the scan: nothing stands beside these.
///
/// # Errors
/// Those of [`table_1`].
pub fn root_error_table() -> Result<Table, PresentError> {
    let table = table_1(&problems(), ORDERS)?;
    let mut columns = vec![column("Coupling", ""), column("Change", "")];
    columns.extend(
        table
            .formulae
            .iter()
            .map(|&rule| column(&rule_name(rule), "%")),
    );
    let plain = |computed| Cell::Number {
        computed,
        published: None,
        digits: Digits::Fixed(2),
    };
    let rows = table.rows.iter().enumerate().map(|(number, row)| {
        let mut cells = vec![plain(row.problem.coupling), plain(row.problem.change)];
        cells.extend(row.root_errors.iter().map(|errors| Cell::Number {
            computed: 100.0 * errors[0].abs().max(errors[1].abs()),
            published: None,
            digits: Digits::Scientific(1),
        }));
        Row {
            label: (number + 1).to_string(),
            cells,
        }
    });
    Ok(Table {
        name: "table_1".to_owned(),
        title: "Largest root error of two-degree-of-freedom problems (Table 1, computed anew)".to_owned(),
        label_heading: "Problem",
        rows: rows.collect(),
        columns,
        notes: vec![
            "Two unit masses on unit springs to the ground, joined by the coupling spring; the first ground spring is changed. Exact roots in closed form. The paper's own numbers are lost in the scan.".to_owned(),
        ],
    })
}

fn rule_name(rule: Formula) -> String {
    match rule {
        Formula::FirstOrder => "First order".to_owned(),
        Formula::Original => "Original".to_owned(),
        Formula::Recursive1 { order } => format!("Recursive 1, order {order}"),
        Formula::Recursive2 { order } => format!("Recursive 2, order {order}"),
    }
}
