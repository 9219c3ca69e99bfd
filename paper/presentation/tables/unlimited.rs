//! The unlimited factors of a case's first iteration, which reveal a modeling error.

use super::super::figures::factors::DrawnFactor;
use corfem::present::table::{Cell, Digits, Table};
use corfem::torque_box::{CaseResult, Grouping};

/// The remark on a factor so large that it points to a modeling error ([`CaseResult::anomaly`]).
pub const ANOMALY: &str = "anomaly";

/// Unlimited factor of every parameter in the first iteration of a case, beside the factor that the paper quotes; [`ANOMALY`] is
/// remarked.
pub fn unlimited_factors(result: &CaseResult) -> Vec<DrawnFactor> {
    let (names, factors) = (&result.parameter_names, result.unlimited_factors());
    let factor = |(name, &value): (&String, &f64)| DrawnFactor {
        name: name.clone(),
        value,
        // The paper quotes one factor: about 60, for the faulty cover of Case 4.
        published: ((result.case.number, &name[..]) == (4, "8")).then_some(60.0),
        remark: result
            .anomaly
            .as_ref()
            .filter(|anomaly| anomaly.parameter == *name)
            .map(|_| ANOMALY),
        ..DrawnFactor::default()
    };
    names.iter().zip(factors).map(factor).collect()
}

/// Unlimited stiffness change factors of the first iteration, and the elements they give away.
pub fn unlimited_table(result: &CaseResult) -> Table {
    let (case, factors) = (result.case.number, unlimited_factors(result));
    let bounds = result.case.settings.inner.factor_range;
    let title = format!("Case {case}: unlimited stiffness change factors, first iteration");
    let word = |factor: &DrawnFactor| match factor.remark {
        None if bounds.contains(factor.value) => Cell::text("within bounds"),
        remark => Cell::text(remark.unwrap_or("limited")),
    };
    let kind = if result.case.grouping == Grouping::Elements {
        "element"
    } else {
        "group"
    };
    let anomalies = factors.iter().filter(|factor| factor.remark.is_some()).map(
        |DrawnFactor {
             name,
             value,
             published,
             ..
         }| {
            let published =
                published.map_or_else(String::new, |about| format!(" (published: {about})"));
            let next = factors
                .iter()
                .filter(|other| other.name != *name)
                .map(|other| other.value)
                .fold(f64::MIN, f64::max);
            let asks = format!(
                "{kind} {name} asks for {value:.1} times its stiffness{published}, the next for {next:.1}"
            );
            format!("Anomaly: {asks}: look for a modeling error there.")
        },
    );
    let number =
        |factor: &DrawnFactor| Cell::beside(factor.value, Digits::Fixed(1), factor.published);
    Table::new(format!("case_{case}_factors"), title, "Parameter")
        .labels(factors.iter().map(|factor| &factor.name))
        .column("Factor", "", factors.iter().map(number))
        .column("Verdict", "", factors.iter().map(word))
        .notes([format!(
            "Bounds of one iteration: {:.2} to {:.2}.",
            bounds.lower, bounds.upper
        )])
        .notes(anomalies)
}
