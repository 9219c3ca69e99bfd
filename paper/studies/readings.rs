//! What each reading of the step (12, 13) makes of the gages that the paper prints, column by column: in whole runs of as many passes as are
//! printed; and from the published gages of the pass before with exactly the published number of iterations, where neither a tolerance
//! nor a cap takes part, so that the length of the step shows as well as its direction. That tells which lies nearest, not which it was.

use super::accumulation::accumulation_table;
use super::{percents, rows};
use crate::prelude::*;

/// The element that Case 4 has a hundred times too thin.
pub const FAULTY_ELEMENT: usize = 8;

/// A rule of the step: a reading of the paper's sentence, or half, $c = 1 - R e_S y_e/\sum y^2$ with
/// $y_e = (\Delta e_e/0.001)/\lVert \kappa_e \rVert^{1/2}$, behind which no text stands.
pub type Rule = Option<StepRule>;

/// All of them.
pub const RULES: [Rule; 5] = [
    Some(StepRule::ALL[0]),
    Some(StepRule::ALL[1]),
    Some(StepRule::ALL[2]),
    Some(StepRule::ALL[3]),
    None,
];

/// What tables call a rule.
pub fn name(rule: Rule) -> &'static str {
    rule.map_or("half", StepRule::name)
}

/// A printed column of gages: where it starts, and what it should come to.
#[derive(Clone)]
struct Printed {
    case: Case,
    name: String,
    start: Vec<f64>,
    gages_in: Vec<f64>,
    iterations: usize,
    modes: (usize, usize),
    error_sum: Option<f64>,
}

/// The printed columns of a box's cases: `Case 1 pass 2`, `Table 11 FEM 7`.
fn printed(reconstruction: &Reconstruction) -> Vec<Printed> {
    let case = |number| Case::from_reconstruction(number, reconstruction.clone()).unwrap();
    let table = |number| PublishedTable::number(number).unwrap();
    let gages = |table: &PublishedTable, stage: &str| {
        let of = |panel: usize| {
            table
                .required(&panel.to_string(), &format!("{stage}_in"))
                .unwrap()
        };
        (1..=PANEL_COUNT).map(of).collect_vec()
    };
    let (counts, mut columns) = (table(13), Vec::new());
    for number in 1..=3 {
        let (case, table) = (case(number), table(2 * number + 2));
        let mut start = case.first_gages();
        for pass in 1..=published_passes(number) {
            let heading = format!("pass_{pass}_iterations");
            let gages_in = gages(&table, &format!("pass_{pass}"));
            columns.push(Printed {
                case: case.clone(),
                name: format!("Case {number} pass {pass}"),
                start: std::mem::replace(&mut start, gages_in.clone()),
                gages_in,
                iterations: counts.required(&number.to_string(), &heading).unwrap() as usize,
                modes: (9, 9),
                error_sum: None,
            });
        }
    }
    let case = case(PUBLISHED_CASE);
    for (test_modes, analysis_modes) in PUBLISHED_RUNS {
        // Seven test modes in Table 10, five in Table 11, three in Table 12.
        let (number, stage) = ((27 - test_modes) / 2, format!("fem_{analysis_modes}"));
        let table = table(number);
        let percent = |row: &str| table.required(row, &format!("{stage}_percent")).unwrap();
        let sum = 0.01 * (percent("frequency_rms") + percent("shape_rms"));
        columns.push(Printed {
            case: case.clone(),
            name: format!("Table {number} FEM {analysis_modes}"),
            start: case.first_gages(),
            gages_in: gages(&table, &stage),
            iterations: percent("iterations") as usize,
            modes: (test_modes, analysis_modes),
            error_sum: Some(sum * (test_modes as f64).sqrt()),
        });
    }
    columns
}

/// What a rule makes of a printed column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// The rule.
    pub rule: Rule,
    /// The column.
    pub name: String,
    /// Gages reached, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// Gages printed, in.
    pub printed_in: Vec<f64>,
    /// Error sum reached, a fraction; NaN of a whole run.
    pub error_sum: f64,
    /// The printed one, where errors of the inner loop are printed: a fraction.
    pub printed_sum: Option<f64>,
}

impl Column {
    fn new(rule: Rule, printed: &Printed, gages_in: Vec<f64>, error_sum: f64) -> Self {
        Self {
            rule,
            name: printed.name.clone(),
            gages_in,
            printed_in: printed.gages_in.clone(),
            error_sum,
            printed_sum: printed.error_sum,
        }
    }

    /// Root mean square difference of the gage errors from the printed ones, a fraction of the test gage.
    pub fn difference(&self) -> f64 {
        let pairs = self.gages_in.iter().zip(&self.printed_in);
        rms(&pairs
            .map(|(own, print)| (own - print) / TEST_GAGE)
            .collect_vec())
    }

    /// Correlation coefficient of the gages with the printed ones.
    pub fn correlation(&self) -> f64 {
        correlation(&self.gages_in, &self.printed_in)
    }
}

/// Correlation coefficient of two lists.
pub fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let about_mean = |list: &[f64]| {
        let list = DVector::from_column_slice(list);
        list.add_scalar(-list.mean())
    };
    let (one, other) = (about_mean(one), about_mean(other));
    one.dot(&other) / (one.norm() * other.norm())
}

/// A case by one reading, as many passes as the paper prints.
///
/// # Errors
/// Those of [`run_case`].
pub fn run_by_reading(case: &Case, reading: StepRule) -> Result<CaseResult, CaseError> {
    let passes = published_passes(case.number);
    let mut case = case.clone();
    case.settings = Settings {
        least_passes: passes,
        most_passes: passes,
        ..case.settings_by(reading)
    };
    run_case(&case, |_, _| {})
}

/// The printed columns of one of Cases 1 to 3, or of Tables 10 to 12 for another number, by a reading.
///
/// # Errors
/// Those of [`run_by_reading`] and [`published_runs`].
pub fn columns_of(
    reconstruction: &Reconstruction,
    number: usize,
    reading: StepRule,
) -> Result<Vec<Column>, CaseError> {
    let name = if number < 4 {
        format!("Case {number}")
    } else {
        "Table".to_owned()
    };
    let mut columns = printed(reconstruction);
    columns.retain(|column| column.name.starts_with(&name));
    let mut case = columns[0].case.clone();
    let gages = if number < 4 {
        run_by_reading(&case, reading)?.pass_gages
    } else {
        case.settings = case.settings_by(reading);
        let runs = published_runs(&case)?.into_iter();
        runs.map(|run| run.gages_in).collect()
    };
    let column = |(of, gages)| Column::new(Some(reading), of, gages, f64::NAN);
    Ok(columns.iter().zip(gages).map(column).collect())
}

/// Every printed column of the reconstructed box by every reading.
pub static COLUMNS: LazyLock<Vec<Column>> = LazyLock::new(|| {
    let this = &Reconstruction::embedded().unwrap();
    let of = |reading| (1..=4).flat_map(move |case| columns_of(this, case, reading).unwrap());
    StepRule::ALL.into_iter().flat_map(of).collect()
});

/// An analysis whose steps are divided by what a rule makes of the changes of the error sum $\Delta e$, the norms $\lVert \kappa \rVert$ of
/// the reading matrix, and the factors on the gages.
pub struct ByRule<'a, F>(pub &'a ModalModel, pub F);

impl<F: Fn(&[f64], &[f64], &[f64]) -> Vec<f64>> Analysis for ByRule<'_, F> {
    fn exact(&self) -> &State {
        self.0.exact()
    }

    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        self.0.at(factors)
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        self.0.error_changes(state)
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], _: StepRule) -> Vec<f64> {
        let changes = self.0.error_changes(state).unwrap();
        let mut kappa = self
            .0
            .stiffness_changes(state, gage_factors, StepRule::Matrix);
        kappa.iter_mut().for_each(|norm| *norm /= DERIVATIVE_STEP);
        (self.1)(&changes, &kappa, gage_factors)
    }
}

/// What half divides by.
fn half(changes: &[f64], kappa: &[f64], _: &[f64]) -> Vec<f64> {
    let y = changes.iter().zip(kappa);
    let y = y.map(|(change, norm)| change / DERIVATIVE_STEP / norm.sqrt());
    let squares: f64 = y.map(|y| y * y).sum();
    let divisor = |norm: &f64| DERIVATIVE_STEP * norm.sqrt() * squares;
    kappa.iter().map(divisor).collect()
}

/// Every printed column by every rule after the printed iterations, rule by rule, on the reconstructed box.
pub static COUNTED: LazyLock<Vec<Column>> = LazyLock::new(|| {
    let columns = printed(&Reconstruction::embedded().unwrap());
    let counted = |rule: Rule| {
        let of = move |column: &Printed| {
            let model = column.case.model_with(&column.start).unwrap();
            let test = column.case.test_modes().unwrap();
            let test = test.lowest(column.modes.0).unwrap();
            let ones = [1.0; PANEL_COUNT];
            let modal = model.analyze(&ones, &test, Some(column.modes.1)).unwrap();
            let ranges = model.factor_ranges().unwrap();
            let mut settings = InnerSettings {
                iterations: column.iterations,
                tolerance: f64::MIN_POSITIVE,
                ..column.case.settings.inner.clone()
            };
            let found = match rule {
                Some(step) => {
                    settings.step = step;
                    run(&modal, &ones, &ranges, &settings)
                }
                None => run(&ByRule(&modal, half), &ones, &ranges, &settings),
            }
            .unwrap();
            let gages = column.start.iter().zip(&found.gage_factors);
            let gages = gages.map(|(start, factor)| start * factor).collect();
            Column::new(rule, column, gages, found.last.errors.sum())
        };
        columns.iter().map(of).collect_vec()
    };
    RULES.into_iter().flat_map(counted).collect()
});

/// Difference of all columns of a rule together, a fraction.
pub fn pooled(rule: Rule) -> f64 {
    let of_rule = COUNTED.iter().filter(|column| column.rule == rule);
    rms(&of_rule.map(Column::difference).collect_vec())
}

/// Every reading against every printed column, what Case 4's first iteration asks for by each, and the printed counts.
pub fn tables() -> Vec<Table> {
    let names = COLUMNS[..COLUMNS.len() / StepRule::ALL.len()].iter();
    let agreement = names.map(|of| {
        let same = COLUMNS.iter().filter(|column| column.name == of.name);
        let both = same.flat_map(|column| [column.correlation(), 100.0 * column.difference()]);
        (&of.name, both.collect())
    });
    let columns = ["matrix", "own", "relative", "gage"]
        .map(|name| [format!("r {name}"), format!("d {name}")]);
    let columns = columns
        .as_flattened()
        .iter()
        .map(String::as_str)
        .collect_vec();
    let demands = StepRule::ALL.map(|reading| {
        let result = run_by_reading(&case_of(4), reading).unwrap();
        let mut factors = result.unlimited_factors.clone();
        let faulty = factors.remove(FAULTY_ELEMENT - 1);
        (reading.name(), vec![faulty, factors.into_iter().largest()])
    });
    let count = COUNTED.len() / RULES.len();
    let counted = (0..count).map(|row| {
        let of_rules = COUNTED[row..].iter().step_by(count);
        (
            &COUNTED[row].name[..],
            percents(of_rules.map(Column::difference)),
        )
    });
    let counted = counted.chain([("all", percents(RULES.map(pooled)))]);
    vec![
        rows("readings_agreement", &columns, agreement),
        rows(
            "case_4_readings",
            &["Faulty element", "Next largest"],
            demands,
        ),
        rows("counted_gages", &RULES.map(name), counted),
        accumulation_table(),
    ]
}
