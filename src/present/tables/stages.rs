//! Values beside their targets, from the first model to the last: frequencies or gages, pass by pass.

use super::{Cell, Digits, HERTZ, INCHES, PERCENT, Table, in_words, kind_letter};
use crate::cases::published::PublishedTable;
use crate::cases::torque_box::{PANEL_COUNT, Panel, TEST_GAGE};

/// A state of a model: how the published columns of it begin (`initial`, `pass_1`, `fem_5`), and its values in the
/// order of the rows.
pub(super) type Stage<'a> = (String, &'a [f64]);

/// What stands in a table of stages: a column of targets, then two for each stage, its values and their errors.
#[derive(Debug, Clone)]
pub(super) struct Stages<'a> {
    /// Heading of the targets.
    pub target: &'static str,
    /// Unit of the values, `Hz` or `in`.
    pub unit: &'static str,
    pub digits: Digits,
    pub error_digits: Digits,
    /// Labels of the rows, and the kind of each if they differ in kind.
    pub labels: Vec<String>,
    pub kinds: Option<Vec<&'static str>>,
    /// Targets; rows beyond the last have none.
    pub targets: &'a [f64],
    pub stages: Vec<Stage<'a>>,
    /// The published table, whose headings are the stages' with `_hz`, `_in` or `_percent`.
    pub paper: Option<&'a PublishedTable>,
}

/// Heading of a stage: `pass_1` is Pass 1.
pub(super) fn stage_title(stage: &str) -> String {
    let words = in_words(stage);
    let (first, rest) = words.split_at(words.len().min(1));
    first.to_uppercase() + rest
}

impl<'a> Stages<'a> {
    /// Frequencies of so many modes, numbered from one, beside those of a test.
    pub fn of_modes(count: usize, test_hz: &'a [f64], stages: Vec<Stage<'a>>) -> Self {
        Self {
            target: "GVT",
            unit: "Hz",
            digits: HERTZ,
            error_digits: PERCENT,
            labels: (1..=count).map(|mode| mode.to_string()).collect(),
            kinds: None,
            targets: test_hz,
            stages,
            paper: None,
        }
    }

    /// Gages of the box's panels beside those of the test configuration.
    pub fn of_gages(panels: &[Panel], stages: Vec<Stage<'a>>) -> Self {
        let (labels, kinds) = panels.iter().map(|panel| (panel.label.to_string(), kind_letter(panel.kind))).unzip();
        Self {
            unit: "in",
            digits: INCHES,
            labels,
            kinds: Some(kinds),
            ..Self::of_modes(0, &[TEST_GAGE; PANEL_COUNT], stages)
        }
    }

    /// Puts columns and rows into a table that has none.
    pub fn fill(&self, table: Table) -> Table {
        let mut table = table.columns(self.kinds.as_ref().map(|_| "Type"), "").column(self.target, self.unit);
        for (stage, _) in &self.stages {
            let title = stage_title(stage);
            table = table.column(&title, self.unit).column(title + " error", "%");
        }
        let suffix = self.unit.to_lowercase();
        for (row, label) in self.labels.iter().enumerate() {
            let cell = |value: Option<f64>, digits, heading: String| {
                let published = self.paper.and_then(|paper| paper.value(label, &heading));
                value.map_or(Cell::Blank, |value| Cell::beside(value, digits, published))
            };
            let mut cells: Vec<Cell> = self.kinds.iter().map(|kinds| Cell::text(kinds[row])).collect();
            let target = self.targets.get(row).copied();
            cells.push(cell(target, self.digits, format!("gvt_{suffix}")));
            for (stage, values) in &self.stages {
                let value = values.get(row).copied();
                let error = value.zip(target).map(|(v, t)| 100.0 * (v / t - 1.0));
                cells.push(cell(value, self.digits, format!("{stage}_{suffix}")));
                cells.push(cell(error, self.error_digits, format!("{stage}_percent")));
            }
            table.row(label, cells);
        }
        table
    }

    /// Adds a row with one error for each stage, fractions written in percent; the published row of that name, if there
    /// is one, is written with low lines and small letters: `frequency_rms` for `frequency RMS`.
    pub fn add_errors(
        &self,
        table: &mut Table,
        label: &str,
        digits: Digits,
        errors: impl IntoIterator<Item = Option<f64>>,
    ) {
        let printed = label.trim_start_matches("inner ").replace(' ', "_").to_lowercase();
        let mut cells = vec![Cell::Blank; 1 + usize::from(self.kinds.is_some())];
        for ((stage, _), error) in self.stages.iter().zip(errors) {
            let published = self.paper.and_then(|paper| paper.value(&printed, &format!("{stage}_percent")));
            let number = error.map(|error| Cell::beside(100.0 * error, digits, published));
            cells.extend([Cell::Blank, number.unwrap_or(Cell::Blank)]);
        }
        table.row(label, cells);
    }
}
