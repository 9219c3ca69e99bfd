//! The printed columns of gages one by one: each from the published gages of the pass before, with exactly the published number of
//! iterations. Neither a tolerance nor a cap takes part, so that the length of the step shows as well as its direction.

use super::PERCENT;
use super::readings::READINGS;
use crate::prelude::*;

/// A rule of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// A reading of the paper's sentence.
    Reading(StepRule),
    /// $c = 1 - R e_S y_e/\sum y^2$ with $y_e = (\Delta e_e/0.001)/\lVert \kappa_e \rVert^{1/2}$: no text stands behind it.
    Half,
}

/// All of them.
pub const RULES: [Rule; 5] = [
    Rule::Reading(READINGS[0]),
    Rule::Reading(READINGS[1]),
    Rule::Reading(READINGS[2]),
    Rule::Reading(READINGS[3]),
    Rule::Half,
];

impl Rule {
    /// What tables call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reading(reading) => reading.name(),
            Self::Half => "half",
        }
    }
}

/// What a rule makes of a printed column.
#[derive(Debug, Clone, PartialEq)]
pub struct Counted {
    /// The rule.
    pub rule: Rule,
    /// The column: `Case 1 pass 2`, `Table 11 FEM 7`.
    pub name: String,
    /// Gages reached, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// RMS difference of the gage errors from the printed ones, a fraction.
    pub difference: f64,
    /// Error sum reached, a fraction.
    pub error_sum: f64,
    /// The printed one, where errors of the inner loop are printed: a fraction.
    pub printed_sum: Option<f64>,
}

/// A printed column: where it starts, and what it should come to.
struct Printed {
    name: String,
    start: Vec<f64>,
    gages: Vec<f64>,
    iterations: usize,
    test_modes: usize,
    analysis_modes: usize,
    error_sum: Option<f64>,
}

/// The printed columns of a box's cases, each with its case.
fn printed(reconstruction: &Reconstruction) -> Result<Vec<(Case, Printed)>, CaseError> {
    let case = |number| Case::from_reconstruction(number, reconstruction.clone());
    let gages = |table: &PublishedTable, stage: &str| {
        let of = |panel: usize| table.required(&panel.to_string(), &format!("{stage}_in"));
        (1..=PANEL_COUNT)
            .map(of)
            .collect::<Result<Vec<f64>, CaseError>>()
    };
    let (counts, mut columns) = (PublishedTable::number(13)?, Vec::new());
    for number in 1..=3 {
        let (case, table) = (case(number)?, PublishedTable::number(2 * number + 2)?);
        let mut start = case.first_gages();
        for pass in 1..=published_passes(number) {
            let iterations =
                counts.required(&number.to_string(), &format!("pass_{pass}_iterations"))?;
            let reached = gages(&table, &format!("pass_{pass}"))?;
            let column = Printed {
                name: format!("Case {number} pass {pass}"),
                start,
                gages: reached.clone(),
                iterations: iterations as usize,
                test_modes: 9,
                analysis_modes: 9,
                error_sum: None,
            };
            columns.push((case.clone(), column));
            start = reached;
        }
    }
    let case = case(PUBLISHED_CASE)?;
    for (test_modes, analysis_modes) in PUBLISHED_RUNS {
        // Seven test modes in Table 10, five in Table 11, three in Table 12.
        let (number, stage) = ((27 - test_modes) / 2, format!("fem_{analysis_modes}"));
        let table = PublishedTable::number(number)?;
        let percent = |row: &str| table.required(row, &format!("{stage}_percent"));
        let sum = 0.01 * (percent("frequency_rms")? + percent("shape_rms")?);
        let column = Printed {
            name: format!("Table {number} FEM {analysis_modes}"),
            start: case.first_gages(),
            gages: gages(&table, &stage)?,
            iterations: percent("iterations")? as usize,
            test_modes,
            analysis_modes,
            error_sum: Some(sum * (test_modes as f64).sqrt()),
        };
        columns.push((case.clone(), column));
    }
    Ok(columns)
}

/// Those of the reconstructed box.
pub static COUNTED: LazyLock<Vec<Counted>> =
    LazyLock::new(|| counted(&Reconstruction::embedded().expect("a box")).expect("they run"));

/// Every printed column by every rule, rule by rule.
///
/// # Errors
/// Those of the model, the analysis and the inner loop.
pub fn counted(reconstruction: &Reconstruction) -> Result<Vec<Counted>, CaseError> {
    let columns = printed(reconstruction)?;
    let mut all = Vec::new();
    for rule in RULES {
        for (case, column) in &columns {
            let model = case.model_with(&column.start)?;
            let test = case.test_modes()?.lowest(column.test_modes)?;
            let modal = model.analyze(&[1.0; PANEL_COUNT], &test, Some(column.analysis_modes))?;
            let ranges = model.factor_ranges()?;
            let settings = InnerSettings {
                iterations: column.iterations,
                tolerance: f64::MIN_POSITIVE,
                ..case.settings.inner.clone()
            };
            let (factors, error_sum) = match rule {
                Rule::Reading(step) => {
                    let settings = InnerSettings { step, ..settings };
                    let run = run(&modal, &[1.0; PANEL_COUNT], &ranges, &settings)?;
                    (run.factors, run.last.errors.sum())
                }
                Rule::Half => run_by_half(&modal, &ranges, &settings)?,
            };
            let gages_in = column
                .start
                .iter()
                .zip(factors)
                .map(|(g, c)| g * c)
                .collect_vec();
            let pairs = gages_in.iter().zip(&column.gages);
            let differences = pairs.map(|(found, printed)| (found - printed) / TEST_GAGE);
            all.push(Counted {
                rule,
                name: column.name.clone(),
                difference: rms(&differences.collect_vec()),
                gages_in,
                error_sum,
                printed_sum: column.error_sum,
            });
        }
    }
    Ok(all)
}

/// The inner loop by [`Rule::Half`].
fn run_by_half(
    model: &Model,
    ranges: &[Option<Bounds>],
    settings: &InnerSettings,
) -> Result<(Vec<f64>, f64), Error> {
    run_by(model, ranges, settings, &|changes, kappa, _| {
        let roots = || kappa.iter().map(|norm| norm.sqrt());
        let y = changes
            .iter()
            .zip(roots())
            .map(|(change, root)| change / DERIVATIVE_STEP / root);
        let squares: f64 = y.map(|y| y * y).sum();
        roots()
            .map(|root| DERIVATIVE_STEP * root * squares)
            .collect()
    })
}

/// What a rule divides by: from the changes of the error sum $\Delta e$, the norms $\lVert \kappa \rVert$ of the reading matrix, and
/// the factors on the gages.
pub type Divisors<'a> = &'a dyn Fn(&[f64], &[f64], &[f64]) -> Vec<f64>;

/// The inner loop by any rule, without a tolerance: its factors and error sum at the end.
///
/// # Errors
/// Those of [`Analysis::error_changes`].
pub fn run_by(
    model: &Model,
    ranges: &[Option<Bounds>],
    settings: &InnerSettings,
    divisors: Divisors<'_>,
) -> Result<(Vec<f64>, f64), Error> {
    let (mut factors, mut state) = (vec![1.0; PANEL_COUNT], model.exact().clone());
    for iteration in 0..settings.iterations {
        let changes = model.error_changes(&state)?;
        let kappa = model
            .stiffness_changes(&state, &factors, StepRule::Matrix)
            .iter()
            .map(|change| change / DERIVATIVE_STEP)
            .collect_vec();
        let divisors = divisors(&changes, &kappa, &factors);
        let relaxation = match iteration {
            0 => settings.first_relaxation,
            _ => settings.relaxation,
        };
        let error_sum = state.errors.sum();
        let unlimited = |e: usize| unlimited_factor(changes[e], divisors[e], error_sum, relaxation);
        let trial = |halvings: i32| {
            let fraction = 0.5_f64.powi(halvings);
            let next = |e: usize| {
                let (bounds, range) = (settings.factor_range, ranges[e]);
                limited_factor(unlimited(e), fraction, factors[e], 1.0, bounds, range).0
            };
            let next = (0..PANEL_COUNT).map(next).collect_vec();
            let share = |e: usize| {
                let accumulation = settings.accumulation;
                accumulation.next_share_factor(state.factors[e], factors[e], next[e])
            };
            let shares = (0..PANEL_COUNT).map(share).collect_vec();
            let there = model.at(&shares).ok()?;
            (there.errors.sum() < error_sum).then_some((next, there))
        };
        let Some(step) = (0..=settings.halvings as i32).find_map(trial) else {
            break;
        };
        (factors, state) = step;
    }
    Ok((factors, state.errors.sum()))
}

/// Difference of all columns of a rule together, a fraction.
pub fn pooled(columns: &[Counted], rule: Rule) -> f64 {
    let of_rule = columns.iter().filter(|column| column.rule == rule);
    rms(&of_rule.map(|column| column.difference).collect_vec())
}

/// Differences from the printed gages and error sums, column by column and rule by rule.
pub fn counted_tables(columns: &[Counted]) -> Vec<Table> {
    let of = |rule: Rule| columns.iter().filter(move |column| column.rule == rule);
    let names = || of(RULES[0]).map(|column| column.name.clone());
    let one = |name: &str, title: &str| Table::new(name, title, "Column");
    let mut gages = one(
        "counted_gages",
        "RMS difference from the printed gages after the printed iterations, percent points",
    )
    .labels(names().chain(["all".to_owned()]));
    let mut sums = one(
        "counted_sums",
        "Error sum after the printed iterations, percent",
    )
    .labels(names());
    for rule in RULES {
        let differences = of(rule)
            .map(|column| column.difference)
            .chain([pooled(columns, rule)]);
        let cells = differences.map(|difference| Cell::number(100.0 * difference, PERCENT));
        gages = gages.column(rule.name(), "", cells.collect_vec());
        let cells = of(rule).map(|column| {
            let printed = column.printed_sum.map(|sum| 100.0 * sum);
            Cell::beside(100.0 * column.error_sum, PERCENT, printed)
        });
        sums = sums.column(rule.name(), "", cells.collect_vec());
    }
    vec![gages, sums]
}
