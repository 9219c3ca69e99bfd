//! Tables of any correlation: its frequencies, what its first iteration asks for, and its passes.

use super::RMS_PERCENT;
use super::stages::Stages;
use crate::cases::{BUILT_IN, anomaly};
use crate::method::error_sum::Errors;
use crate::method::inner_loop::Stop;
use crate::method::model::{Check, Range};
use crate::method::outer_loop::Correlation;
use crate::present::table::{Cell, Digits, Table};

/// Exact solutions with the names of their stages.
pub(super) type Checks<'a> = Vec<(String, &'a Check)>;

/// All exact solutions of a correlation: `initial`, `pass_1`, …
pub(super) fn checks(correlation: &Correlation) -> Checks<'_> {
    let passes = correlation.passes.iter().enumerate();
    let pass = passes.map(|(row, pass)| (format!("pass_{}", row + 1), &pass.check));
    std::iter::once(("initial".to_owned(), &correlation.initial)).chain(pass).collect()
}

/// The exact solution at the end: of the last pass, or the initial one without any.
pub fn last_check(correlation: &Correlation) -> &Check {
    correlation.passes.last().map_or(&correlation.initial, |pass| &pass.check)
}

/// Frequencies of exact solutions beside those of the test by the numbers of its modes, and both RMS errors; `adapt`
/// may add a published table and change labels and digits.
pub(super) fn frequencies<'a>(
    table: Table,
    test_hz: &'a [f64],
    checks: &'a Checks,
    adapt: impl FnOnce(&mut Stages<'a>),
) -> Table {
    let found = checks.iter().map(|(name, check)| (name.clone(), &check.frequencies_hz[..]));
    let mut stages = Stages::of_modes(test_hz.len(), test_hz, found.collect());
    adapt(&mut stages);
    let mut table = stages.fill(table);
    for (label, rms) in
        [("frequency RMS", Errors::frequency_rms as fn(&Errors) -> f64), ("shape RMS", Errors::shape_rms)]
    {
        let errors = checks.iter().map(|(_, check)| Some(rms(&check.errors)));
        stages.add_errors(&mut table, label, RMS_PERCENT, errors);
    }
    table
}

/// What is to be thought of an unlimited factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judgment {
    /// It lies within the bounds of one iteration.
    Within,
    /// It lies outside them.
    Limited,
    /// It stands out so far that a modeling error must be looked for ([`anomaly`]).
    Anomaly,
}

/// What the first iteration asks of a parameter before any limit.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedFactor {
    /// Name of the parameter.
    pub parameter: String,
    /// The unlimited factor.
    pub computed: f64,
    /// The one printed for it elsewhere.
    pub published: Option<f64>,
    /// What is to be thought of it.
    pub judgment: Judgment,
}

/// Unlimited factors with what is to be thought of each; nothing is published for them.
pub fn judged_factors(names: &[String], factors: &[f64], bounds: Range) -> Vec<JudgedFactor> {
    let outstanding = anomaly(names, factors);
    let judged = |(name, &computed): (&String, &f64)| {
        let judgment = match outstanding.as_ref().is_some_and(|anomaly| anomaly.parameter == *name) {
            true => Judgment::Anomaly,
            false if bounds.contains(computed) => Judgment::Within,
            false => Judgment::Limited,
        };
        JudgedFactor { parameter: name.clone(), computed, published: None, judgment }
    };
    names.iter().zip(factors).map(judged).collect()
}

/// Unlimited stiffness change factors of a first iteration, and the parameters they give away; `kind` is what the
/// parameters are, such as `element`.
pub fn factor_table(name: &str, title: &str, factors: &[JudgedFactor], bounds: Range, kind: &str) -> Table {
    let mut table = Table::new(name, title, "Parameter")
        .columns(["Factor", "Verdict"], "")
        .note(format!("Bounds of one iteration: {:.2} to {:.2}.", bounds.lower, bounds.upper));
    for factor in factors {
        let verdict = match factor.judgment {
            Judgment::Within => "within bounds",
            Judgment::Limited => "limited",
            Judgment::Anomaly => "anomaly",
        };
        let number = Cell::beside(factor.computed, Digits::Fixed(1), factor.published);
        table.row(&factor.parameter, [number, Cell::text(verdict)]);
    }
    for factor in factors.iter().filter(|factor| factor.judgment == Judgment::Anomaly) {
        let next = factors.iter().filter(|other| other.parameter != factor.parameter).map(|other| other.computed);
        table = table.note(format!(
            "Anomaly: {kind} {} asks for {:.1} times its stiffness, the next for {:.1}: look for a modeling error there.",
            factor.parameter,
            factor.computed,
            next.fold(f64::MIN, f64::max),
        ));
    }
    table
}

/// Passes of a correlation: iterations, why they ended, and the error sum by the inner loop and exactly.
pub fn pass_table(name: &str, title: &str, correlation: &Correlation) -> Table {
    let mut table = Table::new(name, title, "Pass")
        .columns(["Iterations", "Stopped by"], "")
        .columns(["Error sum inner", "Error sum exact"], "%");
    for (row, pass) in correlation.passes.iter().enumerate() {
        let stop = match pass.inner.stop {
            Stop::Tolerance => "tolerance",
            Stop::LocalMinimum => "local minimum",
            Stop::Iterations => "iterations",
        };
        let cells = [
            Cell::count(pass.inner.iterations.len()),
            Cell::text(stop),
            Cell::percent(pass.inner.last.errors.sum(), RMS_PERCENT),
            Cell::percent(pass.check.errors.sum(), RMS_PERCENT),
        ];
        table.row(row + 1, cells);
    }
    table
}

/// What did the finite element analyses of a part of the run, when it was not the crate itself.
pub(super) fn solver_note(solver: &str, before: &str, after: &str) -> Option<String> {
    (solver != BUILT_IN)
        .then(|| format!("Finite element analyses{before} by {solver}{after} everything else by this program."))
}
