//! What the first iteration of a case asks of its parameters before any limit, which gives a modeling error away.

use super::{Cell, Digits, Table};
use crate::cases::{CaseResult, Grouping, anomaly};
use crate::present::figures::factors::Factor;

/// What stands out so far that a modeling error must be looked for ([`anomaly`]).
pub const ANOMALY: &str = "anomaly";

/// What the first iteration of a case asks of every parameter, beside what the paper quotes; [`ANOMALY`] is remarked.
pub fn unlimited_factors(result: &CaseResult) -> Vec<Factor> {
    let (names, factors) = (&result.parameter_names, result.unlimited_factors());
    let outstanding = anomaly(names, factors);
    let factor = |(name, &value): (&String, &f64)| Factor {
        name: name.clone(),
        value,
        deviation: None,
        // The paper quotes one factor: about 60, for the faulty cover of Case 4.
        published: ((result.case.number, &name[..]) == (4, "8")).then_some(60.0),
        bounds: None,
        remark: outstanding.as_ref().filter(|anomaly| anomaly.parameter == *name).map(|_| ANOMALY),
    };
    names.iter().zip(factors).map(factor).collect()
}

/// Unlimited stiffness change factors of the first iteration, and the elements they give away.
pub fn unlimited_table(result: &CaseResult) -> Table {
    let (case, factors) = (result.case.number, unlimited_factors(result));
    let bounds = result.case.settings.inner.factor_range;
    let title = format!("Case {case}: unlimited stiffness change factors, first iteration");
    let mut table = Table::new(format!("case_{case}_factors"), title, "Parameter")
        .columns(["Factor", "Verdict"], "")
        .note(format!("Bounds of one iteration: {:.2} to {:.2}.", bounds.lower, bounds.upper));
    for factor in &factors {
        let within = if bounds.contains(factor.value) { "within bounds" } else { "limited" };
        let number = Cell::beside(factor.value, Digits::Fixed(1), factor.published);
        table.row(&factor.name, [number, Cell::text(factor.remark.unwrap_or(within))]);
    }
    for factor in factors.iter().filter(|factor| factor.remark.is_some()) {
        let kind = if result.case.grouping == Grouping::Elements { "element" } else { "group" };
        let next = factors.iter().filter(|other| other.name != factor.name).map(|other| other.value);
        table = table.note(format!(
            "Anomaly: {kind} {} asks for {:.1} times its stiffness, the next for {:.1}: look for a modeling error there.",
            factor.name,
            factor.value,
            next.fold(f64::MIN, f64::max),
        ));
    }
    table
}
