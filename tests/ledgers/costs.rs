//! What a wing of any size costs: the table and the sentences of `paper/cost.md` are made from `paper/costs.csv`, where
//! the benches store what they measure.

use crate::common::log_log_slope;
use std::fs;
use std::path::{Path, PathBuf};

const ANALYSIS: &str = "analysis with all shares";
const CONDENSED: &str = "condensed model: these two and $K_D$";
const FACTOR: &str = "assembly and factorization";
const SHAPES: &str = "shapes of the structure: 10 solutions";

/// A stage with its unit, and the DOF and costs of the wings on which it was measured.
struct Row {
    stage: String,
    unit: String,
    points: Vec<(f64, Option<f64>)>,
}

impl Row {
    fn known(&self) -> Vec<(f64, f64)> {
        self.points
            .iter()
            .filter_map(|&(dof, cost)| Some((dof, cost?)))
            .collect()
    }

    fn at(&self, dof: f64) -> f64 {
        self.known()
            .iter()
            .find(|point| point.0 == dof)
            .unwrap_or_else(|| panic!("{} at {dof}", self.stage))
            .1
    }
}

fn rows() -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(include_str!("../../paper/costs.csv").as_bytes());
    let dof: Vec<f64> = reader
        .headers()
        .expect("a head")
        .iter()
        .skip(2)
        .map(|dof| dof.parse().expect("DOF"))
        .collect();
    let row = |record: csv::StringRecord| {
        let cells = record
            .iter()
            .skip(2)
            .map(|cell| (!cell.is_empty()).then(|| cell.parse().expect("a number")));
        Row {
            stage: record[0].to_owned(),
            unit: record[1].to_owned(),
            points: dof.iter().copied().zip(cells).collect(),
        }
    };
    reader
        .records()
        .map(|record| row(record.expect("a row")))
        .collect()
}

fn document() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("paper/cost.md")
}

fn row(stage: &str) -> Row {
    rows()
        .into_iter()
        .find(|row| row.stage == stage)
        .unwrap_or_else(|| panic!("{stage}"))
}

/// Three digits.
fn written(value: f64) -> String {
    let decimals = (2.0 - value.log10().floor()).clamp(0.0, 3.0) as usize;
    format!("{value:.decimals$}")
}

/// A number of thousands with commas.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let comma = |(at, digit): (usize, char)| {
        let is_third = at > 0 && (digits.len() - at).is_multiple_of(3);
        is_third.then_some(',').into_iter().chain([digit])
    };
    digits.chars().enumerate().flat_map(comma).collect()
}

/// An exponent without the sign of a zero.
fn exponent_of(points: &[(f64, f64)]) -> String {
    format!("{:.2}", log_log_slope(points)).replace("-0.00", "0.00")
}

/// The sizes, under a name for what stands in the rows and before further headings.
fn head(what: &str, further: &str) -> String {
    let sizes: String = rows()[0]
        .points
        .iter()
        .map(|point| format!(" {} DOF |", grouped(point.0)))
        .collect();
    let bars = "---|".repeat(1 + sizes.matches('|').count() + further.matches('|').count());
    format!("| {what} |{sizes}{further}\n|{bars}\n")
}

/// Values of all sizes, empty where there is none.
fn cells(values: impl Iterator<Item = Option<f64>>) -> String {
    values
        .map(|value| format!(" {} |", value.map(written).unwrap_or_default()))
        .collect()
}

/// What was measured, with exponents of growth: all but memory, or memory alone.
fn growth(what: &str, usual: &str, is_memory: bool) -> String {
    let row = |row: Row| {
        let unit = if row.unit == usual {
            String::new()
        } else {
            format!(", {}", row.unit)
        };
        let steps: Vec<String> = row.known().windows(2).map(exponent_of).collect();
        let fitted = if row.known().len() > 1 {
            exponent_of(&row.known())
        } else {
            String::new()
        };
        let cells = cells(row.points.iter().map(|point| point.1));
        format!(
            "| {}{unit} |{cells} {} | {fitted} |\n",
            row.stage,
            steps.join(", ")
        )
    };
    let wanted = rows()
        .into_iter()
        .filter(|row| (row.unit == "MB") == is_memory);
    head(what, " from size to size | fitted |") + &wanted.map(row).collect::<String>()
}

/// Rates of the stages, against those of the machine.
fn bounds() -> String {
    let [factor, entries, operations] = [
        FACTOR,
        "entries of the factor",
        "operations of the factorization",
    ]
    .map(row);
    let [product, reading, shapes] =
        ["product of dense matrices", "reading of memory", SHAPES].map(row);
    let sizes = || factor.known().into_iter().map(|point| point.0);
    let line = |what: &str, value: &dyn Fn(f64) -> f64| {
        format!("| {what} |{}\n", cells(sizes().map(value).map(Some)))
    };
    // Millions a millisecond are thousand millions a second; an entry has eight bytes and is read forward and backward.
    let rate = |dof: f64| operations.at(dof) / factor.at(dof);
    let traffic = |dof: f64| 16.0 * entries.at(dof) / shapes.at(dof);
    let each = |stage: &'static str| move |dof: f64| 1e3 * row(stage).at(dof) / dof;
    let others = [CONDENSED, "modes: 10 of 108", SHAPES].map(each);
    let shares = |dof: f64| each(ANALYSIS)(dof) - others.iter().map(|of| of(dof)).sum::<f64>();
    [
        head("what bounds a stage", ""),
        line("entries of the factor for every DOF", &|dof| {
            1e6 * entries.at(dof) / dof
        }),
        line("assembly and factorization, GFLOP/s", &rate),
        line("the same, % of a product of dense matrices", &|dof| {
            100.0 * rate(dof) / product.at(dof)
        }),
        line(
            "shapes of the structure: reading of the factor, GB/s",
            &traffic,
        ),
        line("the same, % of reading memory from end to end", &|dof| {
            100.0 * traffic(dof) / reading.at(dof)
        }),
        line(
            "element matrices, µs for every DOF",
            &each("element matrices (once)"),
        ),
        line(
            "ordering and pattern, µs for every DOF",
            &each("ordering and pattern (once)"),
        ),
        line("shares, the rest of an analysis, µs for every DOF", &shares),
    ]
    .concat()
}

/// The tables of `paper/cost.md`.
pub fn table() -> String {
    let blocks = [
        growth("stage, ms", "ms", false),
        growth("most memory held, MB", "MB", true),
        bounds(),
    ];
    blocks.join("\n").trim_end().to_owned()
}

#[test]
fn sentences_on_costs_are_what_was_stored() {
    let (analysis, modes) = (ANALYSIS, "20 modes of the whole model (counted)");
    let (scipy, its_modes) = ("analysis by SciPy", "20 modes by SciPy (not counted)");
    let (condensed, factor) = (CONDENSED, FACTOR);
    let fitted = |stage: &str| format!("{stage} $n^{{{}}}$", exponent_of(&row(stage).known()));
    let slower = |of: &str, to: &str| {
        let times = [1458.0, 10098.0, 100_116.0]
            .map(|dof| format!("{:.1}", row(of).at(dof) / row(to).at(dof)));
        format!(
            "{} times as long at 1,458 DOF, {} at 10,098 and {} at 100,116",
            times[0], times[1], times[2]
        )
    };
    let share =
        |of: &str, dof: f64| format!("{:.0} %", 100.0 * row(of).at(dof) / row(analysis).at(dof));
    let memory = rows()
        .into_iter()
        .find(|row| row.unit == "MB" && row.stage == analysis)
        .expect("it was measured");
    let most = memory.at(1_002_000.0);
    let mut sentences: Vec<String> = [
        "element matrices (once)",
        "ordering and pattern (once)",
        factor,
        analysis,
    ]
    .map(fitted)
    .to_vec();
    sentences.extend([
        slower(scipy, analysis),
        format!(
            "{} the condensation and {} the eigensolution",
            share(condensed, 1458.0),
            share("modes: 10 of 108", 1458.0)
        ),
        format!("{} of an analysis at 100,116 DOF", share(factor, 100_116.0)),
        format!(
            "The operations grow with $n^{{{}}}$",
            exponent_of(&row("operations of the factorization").known())
        ),
        format!(
            "{:.1} s with assembly and checks",
            1e-3 * row(factor).at(1_002_000.0)
        ),
        format!("the analysis {:.1} s", 1e-3 * row(analysis).at(1_002_000.0)),
        format!(
            "{:.2} GB, which is {:.2} GiB",
            1e-3 * most,
            1e6 * most / f64::from(1 << 30)
        ),
    ]);
    // What no machine has measured yet has no sentence.
    if row(modes).known().len() > 2 && row(its_modes).known().len() > 2 {
        sentences.extend([fitted(modes), slower(its_modes, modes)]);
    }
    let text = fs::read_to_string(document()).expect("it reads");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let missing: Vec<&String> = sentences
        .iter()
        .filter(|sentence| !text.contains(*sentence))
        .collect();
    assert!(missing.is_empty(), "paper/cost.md should say: {missing:#?}");
}
