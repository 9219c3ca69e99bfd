//! The cost of every stage on wings from 1.4 thousand to a million structural DOF: time, peak memory, and how both grow.
//!
//! `cargo bench --bench large` measures the two smallest of the wings, `cargo bench --bench large -- 1k 10k 100k 1M` those
//! named. With `--write FOLDER` the problems are written there for `benches/scipy_wing.py`, which does the same with SciPy, and with
//! `--scipy python3` that is done in the same run, in a process for each wing. With `--store paper/costs.csv` what was measured replaces
//! what stands there, and the tables of `paper/cost.md` follow by `CORFEM_WRITE=1 cargo test`.

#[path = "../../tests/common/known/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the tests use the rest")]
mod known;
#[path = "../../tests/common/fill.rs"]
mod fill;
mod machine;
mod memory;
mod numpy;
mod stages;

use known::wing::{MESHES, Wing};
use stages::Stages;
use std::path::Path;
use std::process::Command;

fn main() {
    let mut arguments = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .peekable();
    let (mut names, mut folder, mut costs, mut scipy) = (Vec::new(), None, None, None);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--write" => folder = Some(arguments.next().expect("--write wants a folder")),
            "--store" => costs = Some(arguments.next().expect("--store wants a file")),
            "--scipy" => {
                scipy = Some(
                    arguments
                        .next()
                        .expect("--scipy wants the name of a Python with SciPy"),
                )
            }
            _ => names.push(argument),
        }
    }
    assert!(
        scipy.is_none() || folder.is_some(),
        "--scipy wants --write too: what it reads is written there"
    );
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
        let (mut stages, known, modal) = stages::of(&wing);
        let folder = folder.as_ref().map(|folder| Path::new(folder).join(name));
        if let Some(folder) = &folder {
            numpy::write(folder, &known.model, &modal).expect("the folder can be written");
        }
        if *name == MESHES[0].0 {
            print_papers_costs(&stages::papers_costs(&known, &stages));
        }
        drop((known, modal));
        let (mass, frequencies) = stages::whole_modes(&wing, &mut stages);
        if let Some(folder) = &folder {
            numpy::write_whole(folder, &mass, &frequencies).expect("the folder can be written");
        }
        if let Some(costs) = &costs {
            store(Path::new(costs), &stages).expect("the file can be written");
        }
        measured.push(stages);
        if let (Some(python), Some(folder)) = (&scipy, &folder) {
            let mut command = Command::new(python);
            command
                .arg("benches/scipy_wing.py")
                .args(costs.iter().flat_map(|costs| ["--store", costs]))
                .arg(folder);
            assert!(
                command.status().expect("Python starts").success(),
                "SciPy found something else"
            );
        }
    }
    print(&measured);
}

/// Writes what was measured of one wing over what stands in the file of costs; rows and columns have to be there.
fn store(file: &Path, stages: &Stages) -> std::io::Result<()> {
    let text = std::fs::read_to_string(file)?;
    let mut rows: Vec<Vec<String>> = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect();
    let column = rows[0]
        .iter()
        .position(|name| *name == stages.dof.to_string())
        .expect("a column of this wing");
    for row in &mut rows {
        let stage = stages.all.iter().find(|stage| stage.name == row[0]);
        match (stage, row[1].as_str(), row[0].as_str()) {
            (Some(stage), "ms", _) => row[column] = format!("{:.5}", 1e3 * stage.seconds),
            (Some(stage), "MB", _) => row[column] = format!("{:.1}", stage.bytes as f64 / 1e6),
            (.., "entries of the factor") => {
                row[column] = format!("{:.3}", stages.factor_entries as f64 / 1e6)
            }
            (.., "operations of the factorization") => {
                row[column] = format!("{:.4}", stages.factor_operations / 1e6)
            }
            (.., "product of dense matrices") => {
                row[column] = format!("{:.2}", stages.machine.operations / 1e9)
            }
            (.., "reading of memory") => row[column] = format!("{:.2}", stages.machine.bytes / 1e9),
            _ => {}
        }
    }
    std::fs::write(
        file,
        rows.iter()
            .map(|row| row.join(",") + "\n")
            .collect::<String>(),
    )
}

/// The paper's seconds and today's milliseconds.
fn print_papers_costs(costs: &[(&str, f64, f64)]) {
    println!("| | then, s | now, ms | ratio |\n|---|---|---|---|");
    for (what, then, now) in costs {
        println!(
            "| {what} | {then} | {:.3} | {:.0} |",
            1000.0 * now,
            then / now
        );
    }
    println!();
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
