//! The unlimited factors of a case's first iteration, which reveal a modeling error.

use corfem::present::table::{Cell, Digits, Table};
use corfem::torque_box::{CaseResult, Grouping};

/// Unlimited stiffness change factors of the first iteration, and the elements they give away.
pub fn unlimited_table(result: &CaseResult) -> Table {
    let (case, factors) = (result.case.number, &result.unlimited_factors);
    let names = &result.parameter_names;
    let bounds = result.case.settings.inner.factor_range;
    let title = format!("Case {case}: unlimited stiffness change factors, first iteration");
    let anomaly = result.anomaly.as_ref();
    let is_it = |name: &str| anomaly.is_some_and(|anomaly| anomaly.parameter == name);
    // The paper quotes one factor: about 60, for the faulty cover of Case 4.
    let published = |name: &str| ((case, name) == (4, "8")).then_some(60.0);
    let word = |(name, factor): (&String, &f64)| match () {
        () if is_it(name) => Cell::text("anomaly"),
        () if bounds.contains(*factor) => Cell::text("within bounds"),
        () => Cell::text("limited"),
    };
    let number =
        |(name, factor): (&String, &f64)| Cell::beside(*factor, Digits::Fixed(1), published(name));
    let anomaly = anomaly.map(|anomaly| {
        let (name, value) = (&anomaly.parameter, anomaly.factor);
        let kind = match result.case.grouping {
            Grouping::Elements => "element",
            _ => "group",
        };
        let printed = published(name).map_or_else(String::new, |about| format!(" (published: {about})"));
        let others = names.iter().zip(factors).filter(|(other, _)| *other != name);
        let next = others.map(|(_, factor)| *factor).fold(f64::MIN, f64::max);
        format!(
            "Anomaly: {kind} {name} asks for {value:.1} times its stiffness{printed}, the next for {next:.1}: look for a modeling error \
             there."
        )
    });
    let (lower, upper) = (bounds.lower, bounds.upper);
    Table::new(format!("case_{case}_factors"), title, "Parameter")
        .labels(names)
        .column("Factor", "", names.iter().zip(factors).map(number))
        .column("Verdict", "", names.iter().zip(factors).map(word))
        .notes([format!(
            "Bounds of one iteration: {lower:.2} to {upper:.2}."
        )])
        .notes(anomaly)
}
