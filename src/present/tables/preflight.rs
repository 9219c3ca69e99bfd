//! The pre-flight as a table.

use crate::job::preflight::Finding;
use crate::present::table::{Cell, Table};

/// The findings before the first step, structure by structure.
pub fn findings_table(found: &[(String, Vec<Finding>)]) -> Table {
    let title = "Before the first step: what is found";
    let mut table = Table::new("preflight_findings", title, "Structure").headings(["Finding"], "");
    for (name, findings) in found {
        if findings.is_empty() {
            table.row(name, [Cell::text("nothing")]);
        }
        for (place, finding) in findings.iter().enumerate() {
            let label = if findings.len() == 1 {
                name.clone()
            } else {
                format!("{name}, {}", place + 1)
            };
            table.row(label, [Cell::text(finding.to_string())]);
        }
    }
    table
}
