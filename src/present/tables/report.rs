//! Tables of any correlation: paired modes, factors, and its history.

use super::{HERTZ, RMS_PERCENT};
use crate::method::error::Error;
use crate::present::report::{PairAgreement, Report};
use crate::present::table::{Cell, Digits, Table, counted, numbers, percents};
use crate::weighted::comparison::ExactResult;
use crate::weighted::intervals::MOST_FOLLOWED;
use crate::weighted::misfit::{Misfit, mark};

/// Three decimals, of criteria between zero and one and of factors.
const THREE: Digits = Digits::Fixed(3);
/// Three digits, of deviations in percent.
const THREE_DIGITS: Digits = Digits::Significant(3);
/// Words for a pair of modes, with the least of it and the most of any other pair of its two modes.
const MARKS: [(&str, f64, f64); 2] = [("good", 0.95, 0.05), ("acceptable", 0.90, 0.10)];

/// An empty table of a report.
fn table_of(report: &Report, name: &str, title: &str, label: &'static str) -> Table {
    Table::new(
        format!("{}_{name}", report.name),
        format!("{}: {title}", report.title),
        label,
    )
}

/// Every test mode with its partner in the first and in the corrected model: frequencies and their differences, modal assurance
/// criterion, cross-orthogonality and the largest other entry of the two modes, and a mark for the last.
///
/// # Errors
/// The errors of [`Report::agreement`].
pub fn paired_table(report: &Report) -> Result<Table, Error> {
    let mut test_hz = report.test.frequencies_hz();
    let shaped = test_hz.len();
    test_hz.extend(report.initial.lone.iter().map(|lone| lone.frequency_hz));
    let is_shaped = shaped > 0;
    // Where no mode has a shape, a column of dashes says nothing.
    let dash = if is_shaped { "–" } else { "" };
    let none = || report.initial.lone.iter().map(|_| Cell::text(dash));
    let mut table = table_of(report, "modes", "test modes and their partners", "Mode")
        .labels((0..test_hz.len()).map(|mode| report.mode_number(mode)))
        .labels(
            ["frequency RMS"]
                .into_iter()
                .chain(is_shaped.then_some("shape RMS")),
        )
        .column("Test", "Hz", numbers(test_hz.iter().copied(), HERTZ));
    let mut verdict = (String::new(), Vec::new());
    let corrected = (!report.stages.is_empty()).then(|| ("Corrected", report.corrected()));
    for (name, check) in [("First", &report.initial)].into_iter().chain(corrected) {
        let agreement = report.agreement(check)?;
        let (own, others): (Vec<f64>, Vec<f64>) =
            (0..shaped).map(|mode| agreement.pair(check, mode)).unzip();
        let shape_rms = is_shaped.then(|| check.errors.shape_rms());
        let rms = [Some(check.errors.frequency_rms()), shape_rms];
        let all_hz = check.modes.frequencies_hz();
        let lone_hz = check.lone.iter().map(|lone| all_hz[lone.partner]);
        let hertz: Vec<f64> = check
            .frequencies_hz
            .iter()
            .copied()
            .chain(lone_hz)
            .collect();
        let differences = hertz.iter().zip(&test_hz);
        let differences = differences.map(|(hertz, test)| Some(hertz / test - 1.0));
        let partners = check.pairing.analysis_mode.iter().enumerate();
        let assurance = partners.map(|(mode, &partner)| agreement.assurance[(partner, mode)]);
        let words = |(own, others): (&f64, &f64)| {
            let mark = MARKS
                .iter()
                .find(|(_, least, most)| own >= least && others <= most);
            Cell::text(mark.map_or("poor", |mark| mark.0))
        };
        let by_residuals = report.residuals.iter().map(|mode| {
            let squares =
                mode.shape.iter().map(|own| own * own).sum::<f64>() + mode.frequency.powi(2);
            // A shape's scale is free; before a fit a mode that is held out has no residuals.
            let marked = || mark(squares, mode.shape.len().max(1));
            Cell::text(if squares > 0.0 { marked() } else { "–" })
        });
        verdict = (
            format!("{name} is"),
            match report.residuals.is_empty() {
                true => own.iter().zip(&others).map(words).chain(none()).collect(),
                false => by_residuals.collect(),
            },
        );
        table = table
            .column(name, "Hz", numbers(hertz.iter().copied(), HERTZ))
            .column(
                format!("{name} error"),
                "%",
                percents(differences.chain(rms), RMS_PERCENT),
            )
            .column(
                format!("{name} MAC"),
                "",
                numbers(assurance, THREE).chain(none()),
            );
        if report.mass.is_some() {
            table = table.column(
                format!("{name} cross"),
                "",
                numbers(own, THREE).chain(none()),
            );
        }
        table = table.column(
            format!("{name} others"),
            "",
            numbers(others, THREE).chain(none()),
        );
    }
    let measure = match report.mass {
        Some(_) => "cross-orthogonality",
        None => "modal assurance criterion (no mass is known)",
    };
    let is_of_job = report.mass.is_some() && report.trust.is_some();
    let by = match &report.verdict {
        _ if !is_of_job => "",
        Some(_) => " The mass is that of the paired modes of the corrected model.",
        None => " The mass is that of the paired modes of the first model.",
    };
    let marked = match report.residuals.is_empty() {
        true => "Good: at least 0.95, others at most 0.05; acceptable: 0.90 and 0.10.",
        false => {
            "Good: residuals as noise alone leaves them in 95 of 100 tests; acceptable: in 999 of 1000."
        }
    };
    let note = format!(
        "Others: the largest {measure} of either mode with any but its partner. {marked}{by} MAC is not mass-weighted. Shape RMS: of \
        components, largest one, over all modes."
    );
    if !report.held_out.is_empty() {
        // An error is as many predicted deviations as its residual says.
        let predicted = report.residuals.iter().map(|own| {
            let held = report.held_out.iter().find(|held| held.mode == own.mode)?;
            Some(held.frequency[1] / own.frequency).filter(|own| own.is_finite())
        });
        table = table.column("Predicted deviation", "%", numbers(predicted, RMS_PERCENT));
    }
    Ok(table
        .column(verdict.0, "", verdict.1)
        .notes(is_shaped.then_some(note))
        .filled())
}

impl PairAgreement {
    /// Agreement of a test mode and its partner: the magnitude of their cross-orthogonality, or their assurance without mass, and
    /// the largest other entry of either's row and column.
    fn pair(&self, check: &ExactResult, mode: usize) -> (f64, f64) {
        let (matrix, i) = (
            self.orthogonality.as_ref().unwrap_or(&self.assurance),
            check.pairing.analysis_mode[mode],
        );
        let row = (0..matrix.ncols())
            .filter(|&j| j != mode)
            .map(|j| matrix[(i, j)].abs());
        let column = (0..matrix.nrows())
            .filter(|&k| k != i)
            .map(|k| matrix[(k, mode)].abs());
        (
            matrix[(i, mode)].abs(),
            row.chain(column).fold(0.0, f64::max),
        )
    }
}

/// Columns of the factors that a terminal has room for.
pub const BRIEF_FACTORS: [&str; 6] = [
    "Factor",
    "Change",
    "Deviation",
    "Least (95 %)",
    "Most (95 %)",
    "Remark",
];
/// Columns of the modes that a terminal has room for.
pub const BRIEF_MODES: [&str; 8] = [
    "Test",
    "First",
    "First error",
    "Corrected",
    "Corrected error",
    "Predicted deviation",
    "Corrected MAC",
    "Corrected is",
];

/// Factors of the corrected model, that with the surest change first: their changes, the standard deviations of their logarithms, 95 %
/// intervals, what is left of the prior, bounds, and a remark on each that stands out.
pub fn factor_table(report: &Report) -> Table {
    let (order, factors) = (report.by_sureness(), report.factors());
    let each = |of: &dyn Fn(usize) -> Option<f64>, digits: Digits| {
        let all: Vec<Cell> = numbers(order.iter().map(|&e| of(e)), digits).collect();
        all
    };
    let percent = |of: Option<f64>| of.map(|fraction| 100.0 * fraction);
    let interval = |e: usize| report.intervals.get(e)?.as_ref().ok();
    let range = |e: usize| report.ranges.get(e).copied().flatten();
    let shares = report.prior_shares();
    let before = report.seen.as_ref().map(|[first, _]| &first.deviations);
    let remark = |&e: &usize| {
        let remarks = [
            (report.is_at_bound(e, factors[e]), "at bound"),
            (report.is_unseen(e), "hardly seen"),
        ];
        let remarks = remarks.into_iter().filter(|(is_so, _)| *is_so);
        Cell::text(
            remarks
                .map(|(_, remark)| remark)
                .collect::<Vec<_>>()
                .join(", "),
        )
    };
    let four = Digits::Fixed(4);
    table_of(
        report,
        "factors",
        "factors on the first model, the surest change first",
        "Parameter",
    )
    .labels(order.iter().map(|&e| &report.parameters[e]))
    .column("Factor", "", each(&|e| Some(factors[e]), four))
    .column(
        "Change",
        "%",
        each(&|e| Some(100.0 * (factors[e] - 1.0)), Digits::Fixed(1)),
    )
    .column(
        "Deviation",
        "%",
        each(&|e| percent(report.log_deviation(e)), THREE_DIGITS),
    )
    .column(
        "Least (95 %)",
        "",
        each(&|e| Some(interval(e)?.lower), four),
    )
    .column("Most (95 %)", "", each(&|e| Some(interval(e)?.upper), four))
    .column("Remark", "", order.iter().map(remark))
    .column(
        "Deviation before",
        "%",
        each(&|e| percent(before.map(|all| all[e])), THREE_DIGITS),
    )
    .column(
        "Prior's share",
        "%",
        each(
            &|e| percent(shares.as_ref().map(|all| all[e])),
            Digits::Fixed(1),
        ),
    )
    .column("Lower bound", "", each(&|e| Some(range(e)?.lower), THREE))
    .column("Upper bound", "", each(&|e| Some(range(e)?.upper), THREE))
    .notes(deviations_in_words(report))
    .notes(intervals_in_words(report))
    .filled()
}

/// Sentences on the intervals that are withheld, and on how the others were found.
fn intervals_in_words(report: &Report) -> Vec<String> {
    let all = || report.intervals.iter();
    let withheld = all().filter(|interval| interval.is_err()).count();
    let is_by_slope = report.parameters.len() > MOST_FOLLOWED && all().any(Result::is_ok);
    let withheld = (withheld > 0).then(|| {
        let count = counted(withheld, "parameter", "parameters");
        format!("{count} without an interval; the remarks say why.")
    });
    let by_slope = is_by_slope
        .then(|| format!("Intervals of more than {MOST_FOLLOWED} parameters are by slopes alone."));
    withheld.into_iter().chain(by_slope).collect()
}

/// A sentence on the deviations of the parameters.
fn deviations_in_words(report: &Report) -> Option<String> {
    report.seen.as_ref()?;
    let widening = match report.misfit.as_ref().map_or(1.0, Misfit::widening) {
        1.0 => String::new(),
        widening => format!(", at the best factors {widening:.2} times as large"),
    };
    Some(format!(
        "Deviations are those of the logarithm of the factor, \
         from the standard deviations of the measurement{widening}.",
    ))
}

/// The answer in one line, and the verdict under it.
pub fn answer_table(report: &Report) -> Table {
    Table::new("answer", report.answer(), "").notes([report.words()])
}

/// The minima that noise allows, one column each, with their chi-squared, the number of starts that end there, and their factors;
/// none for a single start.
pub fn minima_table(report: &Report) -> Option<Table> {
    let minima = || report.minima.iter();
    let mut table = Table::new("minima", "Minima that noise allows", "Minimum")
        .headings((1..=minima().count()).map(|place| place.to_string()), "")
        .notes([format!(
            "{} failed. Any other that ends in none of them came to no minimum, or to one that this test excludes.",
            counted(report.failed_starts(), "start", "starts")
        )]);
    let chi_squared = minima().map(|minimum| minimum.chi_squared);
    table.row("chi-squared", numbers(chi_squared, Digits::Fixed(2)));
    let starts = minima().map(|minimum| Cell::count(minimum.starts));
    table.row("starts", starts);
    for (e, name) in report.parameters.iter().enumerate() {
        let factors = minima().map(|minimum| minimum.factors[e]);
        table.row(name, numbers(factors, Digits::Fixed(4)));
    }
    minima().next().map(|_| table)
}

/// Stages of a correlation: iterations, the reason for their end, and the error sum by the inner loop and exactly.
pub fn history_table(report: &Report) -> Table {
    let mut table = table_of(report, "passes", "passes", "Pass")
        .headings(["Iterations", "Stopped by"], "")
        .headings(["Error sum inner", "Error sum exact"], "%");
    for (row, stage) in report.stages.iter().enumerate() {
        let errors = report.inner_errors(row);
        let inner = errors
            .last()
            .filter(|_| stage.inner.is_some())
            .map(|last| last.sum());
        let iterations = if stage.inner.is_some() {
            errors.len() - 1
        } else {
            1
        };
        let sums = percents([inner, Some(stage.check.errors.sum())], RMS_PERCENT);
        table.row(
            row + 1,
            [Cell::count(iterations), Cell::text(&stage.stop)]
                .into_iter()
                .chain(sums),
        );
    }
    let words = |swap: Swap| {
        let Swap {
            stage, from, to, ..
        } = swap;
        let test = report.mode_number(swap.test_mode - 1);
        format!("in pass {stage} test mode {test} from {from} to {to}")
    };
    let words = swaps(report)
        .into_iter()
        .map(words)
        .collect::<Vec<_>>()
        .join("; ");
    let swapped = (!words.is_empty()).then(|| format!("Other modes of the model answer: {words}."));
    let (sum, compared) = (
        report.corrected().errors.sum(),
        report
            .verdict
            .as_ref()
            .filter(|_| !report.is_judged_by_noise)
            .map(|verdict| verdict.error_sum),
    );
    let measure = compared.filter(|compared| sum > 0.0 && *compared != sum);
    let measure = measure.map(|compared| {
        format!(
            "Tolerances are those of nine modes: the verdict's error sum is {:.2} times the table's.",
            compared / sum
        )
    });
    table.filled().notes(swapped).notes(measure)
}

/// Change of the mode that a test mode is paired with; numbers count from one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swap {
    /// Stage in which it happened.
    pub stage: usize,
    /// Place of the test mode.
    pub test_mode: usize,
    /// Mode of the model before.
    pub from: usize,
    /// Mode of the model from then on.
    pub to: usize,
}

/// Test modes that are paired with another mode of the model than before.
pub fn swaps(report: &Report) -> Vec<Swap> {
    let checks =
        std::iter::once(&report.initial).chain(report.stages.iter().map(|stage| &stage.check));
    let pairs: Vec<&Vec<usize>> = checks.map(|check| &check.pairing.analysis_mode).collect();
    let of_stage = |(stage, both): (usize, &[&Vec<usize>])| {
        let modes = both[0]
            .iter()
            .zip(both[1])
            .enumerate()
            .filter(|(_, (from, to))| from != to);
        modes
            .map(|(test, (from, to))| Swap {
                stage: stage + 1,
                test_mode: test + 1,
                from: from + 1,
                to: to + 1,
            })
            .collect::<Vec<_>>()
    };
    pairs.windows(2).enumerate().flat_map(of_stage).collect()
}

/// Derivatives at the first model: percent of a frequency, and percent points of the error sum, for one percent of a parameter.
pub fn derivative_table(report: &Report) -> Option<Table> {
    let derivatives = report.derivatives.as_ref()?;
    let title = "derivatives at the first model, for one percent of each parameter";
    let mut table = table_of(report, "derivatives", title, "Parameter").labels(&report.parameters);
    for (place, column) in derivatives.frequency.column_iter().enumerate() {
        let mode = report.mode_number(place);
        table = table.column(
            format!("Mode {mode}"),
            "%",
            numbers(column.iter().copied(), THREE),
        );
    }
    Some(table.column(
        "Error sum",
        "points",
        numbers(derivatives.error_sum.iter().copied(), THREE),
    ))
}
