//! A report as tables for a terminal or Markdown, as CSV, and as pages have it.

use super::report::Report;
use super::table::{Table, counted, separated};
use crate::job::concern::Grade;
use crate::job::{Concern, Trust};

/// Columns of the factors that a terminal has room for.
const FACTORS: [&str; 7] = [
    "parameter",
    "factor",
    "change_percent",
    "deviation_percent",
    "low",
    "high",
    "remark",
];
/// Columns of the modes that a terminal has room for.
const MODES: [&str; 9] = [
    "mode",
    "test_hz",
    "first_hz",
    "first_error_percent",
    "corrected_hz",
    "corrected_error_percent",
    "predicted_deviation_percent",
    "corrected_mac",
    "fit",
];

/// Beginning of a sentence on a question that could not be answered.
const UNCHECKED: &str = "Not checked: ";
/// Sentences that tables stand under or over.
const SUREST: &str =
    "Factors on the first model, the surest change first; deviations of logarithms";
pub(super) const KNOW: &str = "What to know before trusting this";
pub(super) const PARTNERS: &str = "Test modes and their partners";

impl Report {
    /// Tables of doubts, the answer, factors, modes, and remarks that no row has: each fact once.
    pub fn brief(&self) -> Vec<Table> {
        let of = |is_of: &dyn Fn(&Concern) -> bool| {
            let all = self.concerns.all().iter().filter(|own| is_of(own));
            Trust::new(all.cloned().collect())
        };
        let is_unanswered = |own: &Concern| own.identifier.starts_with("not-checked-");
        let doubts = of(&|own| own.grade <= Grade::LeftOut);
        let remarks = of(&|own| own.grade > Grade::LeftOut && !is_unanswered(own));
        let unanswered = self.concerns.all().iter().filter(|own| is_unanswered(own));
        let unanswered = unanswered.map(|own| own.words.trim_start_matches(UNCHECKED));
        let unanswered: Vec<&str> = unanswered.map(|own| own.trim_end_matches('.')).collect();
        let unanswered = match unanswered.is_empty() {
            true => None,
            false => Some(format!("{UNCHECKED}{}.", unanswered.join("; "))),
        };
        let answer = Table::new("answer", &self.answer, "").notes([&self.verdict]);
        let mut tables = vec![
            trust_table("What stands against it", &doubts),
            answer,
            Table::of("factors", SUREST, &self.surest, &FACTORS),
            Table::of("modes", PARTNERS, &self.modes, &MODES),
        ];
        tables.push(self.minima_table());
        tables.push(trust_table(KNOW, &remarks).notes(unanswered));
        tables
    }

    /// Everything in tables, doubts and remarks first, as the page has it.
    pub fn tables(&self) -> Vec<Table> {
        let mut tables = vec![
            trust_table(KNOW, &self.concerns),
            Table::of("modes", PARTNERS, &self.modes, &[]),
            Table::of("errors", "Root mean square errors", &self.errors, &[]),
            Table::of("factors", SUREST, &self.surest, &[]),
        ];
        tables.push(self.minima_table());
        tables.extend([
            Table::of("history", "Steps", &self.history, &[]),
            Table::of("model", "The model", &self.model, &[]),
            Table::of("sensors", "Sensors on the model", &self.places, &[]),
        ]);
        tables
    }

    /// The rows of factors, modes, errors, readings, concerns and steps as CSV, each kind under its names and apart by an empty line.
    pub fn csv(&self) -> String {
        [
            separated(&self.parameters),
            separated(&self.modes),
            separated(&self.errors),
            separated(&self.readings),
            separated(self.concerns.all()),
            separated(&self.history),
        ]
        .join("\n")
    }

    /// The minima that noise allows, with their chi-squared, the number of starts that end there, and their factors in the order of the job.
    fn minima_table(&self) -> Table {
        let columns = ["chi_squared", "starts", "factors"];
        let failed = self.starts.iter().filter(|start| start.is_none()).count();
        let failed = counted(failed, "start", "starts");
        let note = format!(
            "{failed} failed. Any other that ends in none of them came to no minimum, or to one that this test excludes."
        );
        Table::of("minima", "Minima that noise allows", &self.minima, &columns)
            .notes((!self.minima.is_empty()).then_some(note))
    }
}

/// Doubts about a job or its result, and remarks, most important first.
pub fn trust_table(title: &str, trust: &Trust) -> Table {
    let has_doubt = trust.all().iter().any(|own| own.grade <= Grade::Accepted);
    let standing = "A doubt names a mistake; --accept IDENTIFIER answers for it.";
    Table::of(
        "trust",
        title,
        trust.all(),
        &["identifier", "grade", "words"],
    )
    .notes(has_doubt.then_some(standing))
}
