//! What a wing of any size costs: the table, the sentences and the figure of `paper/cost.md` are made from `paper/costs.csv`, where
//! the benches store what they measure. `CORFEM_DOCUMENTS=write cargo test costs` writes the table anew.

use crate::common::log_log_slope;
use crate::common::tolerances::ROUND_OFF;
use crate::ledgers::documents::with_block;
use crate::present::figures::figures;
use corfem::present::figures::growth::{exponent, measured};
use std::fs;
use std::path::{Path, PathBuf};

const MARKER: &str = "measured: paper/costs.csv, November 2026, two x86-64 cores of a virtual machine";

/// A stage with its unit, and the DOF and costs of the wings on which it was measured.
struct Row {
    stage: String,
    unit: String,
    points: Vec<(f64, Option<f64>)>,
}

impl Row {
    fn known(&self) -> Vec<(f64, f64)> {
        self.points.iter().filter_map(|&(dof, cost)| Some((dof, cost?))).collect()
    }

    fn at(&self, dof: f64) -> f64 {
        self.known().iter().find(|point| point.0 == dof).unwrap_or_else(|| panic!("{} at {dof}", self.stage)).1
    }
}

fn rows() -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(include_str!("../../paper/costs.csv").as_bytes());
    let dof: Vec<f64> = reader.headers().expect("a head").iter().skip(2).map(|dof| dof.parse().expect("DOF")).collect();
    let row = |record: csv::StringRecord| {
        let cells = record.iter().skip(2).map(|cell| (!cell.is_empty()).then(|| cell.parse().expect("a number")));
        Row {
            stage: record[0].to_owned(),
            unit: record[1].to_owned(),
            points: dof.iter().copied().zip(cells).collect(),
        }
    };
    reader.records().map(|record| row(record.expect("a row"))).collect()
}

fn document() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("paper/cost.md")
}

fn row(stage: &str) -> Row {
    rows().into_iter().find(|row| row.stage == stage).unwrap_or_else(|| panic!("{stage}"))
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

fn table() -> String {
    let rows = rows();
    let heading: String = rows[0].points.iter().map(|point| format!(" {} DOF |", grouped(point.0))).collect();
    let mut lines = vec![
        format!("| stage, ms |{heading} from size to size | fitted |"),
        format!("|---|{}---|---|", "---|".repeat(rows[0].points.len())),
    ];
    for row in &rows {
        let unit = if row.unit == "ms" { String::new() } else { format!(", {}", row.unit) };
        let cells: String =
            row.points.iter().map(|point| format!(" {} |", point.1.map(written).unwrap_or_default())).collect();
        let steps: Vec<String> = row.known().windows(2).map(exponent_of).collect();
        let fitted = if row.known().len() > 1 { exponent_of(&row.known()) } else { String::new() };
        lines.push(format!("| {}{unit} |{cells} {} | {fitted} |", row.stage, steps.join(", ")));
    }
    lines.join("\n")
}

#[test]
fn the_table_of_costs_is_what_was_stored() {
    let file = document();
    let document = fs::read_to_string(&file).expect("it reads");
    let (now, count) = with_block(&document, MARKER, &table());
    assert_eq!(count, 1);
    if std::env::var("CORFEM_DOCUMENTS").is_ok_and(|value| value == "write") {
        fs::write(&file, now).expect("it can be written");
    } else {
        assert!(now == document, "CORFEM_DOCUMENTS=write writes the table anew");
    }
}

#[test]
fn sentences_on_costs_are_what_was_stored() {
    let (analysis, modes) = ("analysis with all shares", "20 modes of the whole model (counted)");
    let (scipy, its_modes) = ("analysis by SciPy", "20 modes by SciPy (not counted)");
    let (condensed, factor) = ("condensed model: these two and $K_D$", "assembly and factorization");
    let fitted = |stage: &str| format!("{stage} $n^{{{}}}$", exponent_of(&row(stage).known()));
    let slower = |of: &str, to: &str| {
        let times = [1458.0, 10098.0, 100_116.0].map(|dof| format!("{:.1}", row(of).at(dof) / row(to).at(dof)));
        format!("{} times as long at 1,458 DOF, {} at 10,098 and {} at 100,116", times[0], times[1], times[2])
    };
    let share = |of: &str, dof: f64| format!("{:.0} %", 100.0 * row(of).at(dof) / row(analysis).at(dof));
    let mut sentences: Vec<String> =
        ["element matrices (once)", "ordering and pattern (once)", factor, analysis].map(fitted).to_vec();
    sentences.extend([
        slower(scipy, analysis),
        format!(
            "{} the condensation and {} the eigensolution",
            share(condensed, 1458.0),
            share("modes: 10 of 108", 1458.0)
        ),
        format!("{} of an analysis at 100,116 DOF", share(factor, 100_116.0)),
    ]);
    // What no machine has measured yet has no sentence.
    if row(modes).known().len() > 2 && row(its_modes).known().len() > 2 {
        sentences.extend([fitted(modes), slower(its_modes, modes)]);
    }
    let text = fs::read_to_string(document()).expect("it reads");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let missing: Vec<&String> = sentences.iter().filter(|sentence| !text.contains(*sentence)).collect();
    assert!(missing.is_empty(), "paper/cost.md should say: {missing:#?}");
}

#[test]
fn the_figure_of_growth_has_the_exponents_of_what_was_stored() {
    let figure = figures().iter().find(|figure| figure.name == "growth").expect("drawn");
    let drawn: Vec<Row> = rows().into_iter().filter(|row| figure.svg.contains(&row.stage)).collect();
    assert!(drawn.len() > 5 && drawn.iter().all(|row| !row.known().is_empty()));
    for row in &drawn {
        let (stage, known) = (&row.stage, row.known());
        assert_eq!(measured(stage), known, "{stage}");
        assert!((exponent(&known) - log_log_slope(&known)).abs() < ROUND_OFF, "{stage}");
        assert!(figure.svg.contains(&format!("exponent {:.2}", log_log_slope(&known))), "{stage}");
    }
}
