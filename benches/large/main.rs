//! The cost of every stage of an analysis on wings from 1.4 thousand to a million structural DOF: time, peak memory, and how both grow.
//!
//! `cargo bench --bench large` measures the two smallest of the wings, `cargo bench --bench large -- 1k 10k 100k 1M` those
//! named. With `--write FOLDER` the problems are written there for other programs, which do the same in the same run: `--scipy python3`
//! starts `benches/scipy_wing.py` with SciPy's SuperLU and with MKL's PARDISO, `--cholmod cc` compiles and starts
//! `benches/cholmod_wing.c`. With `--store paper/costs.csv` what was measured replaces the wing's whole column there.

#[path = "../wing/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the tests use the rest")]
mod wing;
#[path = "../../tests/common/fill.rs"]
mod fill;
mod machine;
mod memory;
mod numpy;
mod rivals;
mod stages;

use rivals::{Cost, Rivals};
use stages::Stages;
use std::path::{Path, PathBuf};
use wing::{MESHES, Wing};

fn main() {
    let mut arguments = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .peekable();
    let (mut names, mut folder, mut costs) = (Vec::new(), None, None);
    let (mut python, mut compiler) = (None, None);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next();
        match argument.as_str() {
            "--write" => folder = Some(PathBuf::from(value().expect("--write takes a folder"))),
            "--store" => costs = Some(value().expect("--store takes a file")),
            "--scipy" => python = Some(value().expect("--scipy takes a Python that has SciPy")),
            "--cholmod" => compiler = Some(value().expect("--cholmod takes a C compiler")),
            _ => names.push(argument),
        }
    }
    assert!(
        (python.is_none() && compiler.is_none()) || folder.is_some(),
        "--scipy and --cholmod read what --write FOLDER writes"
    );
    let rivals = folder
        .as_ref()
        .map(|folder| Rivals::found(python, compiler, folder));
    if names.is_empty() {
        names = MESHES[..2]
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .collect();
    }
    let mut measured = Vec::new();
    for name in &names {
        let known = MESHES.map(|(name, _)| name).join(", ");
        let wing =
            Wing::named(name).unwrap_or_else(|| panic!("expected one of {known}, found {name}"));
        let (stages, analyzed) = stages::of(&wing);
        let folder = folder.as_ref().map(|folder| Path::new(folder).join(name));
        if let Some(folder) = &folder {
            numpy::write(folder, &analyzed).expect("the folder can be written");
        }
        drop(analyzed);
        let mut rows = rows_of(&stages);
        if let (Some(rivals), Some(folder)) = (&rivals, &folder) {
            rows.extend(rivals.measured(folder, stages.dof));
        }
        if let Some(costs) = &costs {
            store(Path::new(costs), stages.dof, &rows).expect("the file can be written");
        }
        measured.push(stages);
    }
    print(&measured);
}

/// What was measured of one wing, as rows of the file of costs.
fn rows_of(stages: &Stages) -> Vec<Cost> {
    let row = |name: &str, unit: &str, value: String| Cost {
        name: name.to_owned(),
        unit: unit.to_owned(),
        value,
    };
    let timed = stages.all.iter().flat_map(|stage| {
        [
            row(stage.name, "ms", format!("{:.5}", 1e3 * stage.seconds)),
            row(stage.name, "MB", format!("{:.1}", stage.bytes as f64 / 1e6)),
        ]
    });
    let million = |count: f64, digits| format!("{:.digits$}", count / 1e6);
    let (fill, machine) = (&stages.fill, &stages.machine);
    timed
        .chain([
            row(
                "entries of the factor",
                "million",
                million(fill.entries as f64, 3),
            ),
            row(
                "entries of the factor without padding",
                "million",
                million(fill.needed as f64, 3),
            ),
            row(
                "operations of the factorization",
                "million",
                million(fill.operations, 4),
            ),
            row(
                "product of dense matrices",
                "GFLOP/s",
                format!("{:.2}", machine.operations / 1e9),
            ),
            row(
                "reading of memory",
                "GB/s",
                format!("{:.2}", machine.bytes / 1e9),
            ),
        ])
        .collect()
}

/// Writes what was measured of one wing over its column in the file of costs, so that all of it is of one run: a row that was not measured
/// is empty then. Rows and column have to be there.
fn store(file: &Path, dof: usize, measured: &[Cost]) -> std::io::Result<()> {
    let text = std::fs::read_to_string(file)?;
    let mut rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let size = dof.to_string();
    let column = rows[0].iter().position(|&name| name == size);
    let column = column.expect("a column of this wing");
    for row in &mut rows[1..] {
        let cost = measured
            .iter()
            .find(|cost| (cost.name.as_str(), cost.unit.as_str()) == (row[0], row[1]));
        row[column] = cost.map_or("", |cost| &cost.value);
    }
    let lines = rows.iter().map(|row| row.join(",") + "\n");
    std::fs::write(file, lines.collect::<String>())
}

/// Time and peak memory of every stage, and the exponents of growth from one wing to the next.
fn print(measured: &[Stages]) {
    let heading = |of: &Stages| format!(" {} DOF, s | MB |", of.dof);
    let exponents = measured
        .windows(2)
        .map(|pair| format!(" {} to {} |", pair[0].dof, pair[1].dof));
    println!(
        "| stage |{}{}",
        measured.iter().map(heading).collect::<String>(),
        exponents.collect::<String>()
    );
    println!("|---|{}", "---|".repeat(3 * measured.len() - 1));
    for (row, stage) in measured[0].all.iter().enumerate() {
        let cells = measured.iter().map(|of| {
            format!(
                " {:.6} | {:.1} |",
                of.all[row].seconds,
                of.all[row].bytes as f64 / 1e6
            )
        });
        let exponent = |pair: &[Stages]| {
            let ratio = pair[1].all[row].seconds / pair[0].all[row].seconds;
            format!(
                " {:.2} |",
                ratio.ln() / (pair[1].dof as f64 / pair[0].dof as f64).ln()
            )
        };
        let exponents = measured.windows(2).map(exponent).collect::<String>();
        println!("| {} |{}{exponents}", stage.name, cells.collect::<String>());
    }
}
