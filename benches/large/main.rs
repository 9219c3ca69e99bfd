//! The cost of every stage on wings from 1.4 thousand to a million structural DOF: time, peak memory, and how both grow.
//!
//! `cargo bench --bench large` measures the two smallest of the wings, `cargo bench --bench large -- 1k 10k 100k 1M` those
//! named. With `--write FOLDER` the problems are written there for `benches/scipy_wing.py`, which does the same with SciPy.

mod memory;
mod numpy;
mod stages;

use corfem::studies::wing::{MESHES, Wing};
use stages::Stages;
use std::path::Path;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench").peekable();
    let (mut names, mut folder) = (Vec::new(), None);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--write" => folder = Some(arguments.next().expect("--write wants a folder")),
            _ => names.push(argument),
        }
    }
    if names.is_empty() {
        names = MESHES[..2].iter().map(|(name, _)| (*name).to_owned()).collect();
    }
    let mut measured = Vec::new();
    for name in &names {
        let known = MESHES.map(|(name, _)| name).join(", ");
        let wing = Wing::named(name).unwrap_or_else(|| panic!("expected one of {known}, found {name}"));
        let (stages, known, modal) = stages::of(&wing);
        if let Some(folder) = &folder {
            numpy::write(&Path::new(folder).join(name), &known.model, &modal).expect("the folder can be written");
        }
        if *name == MESHES[0].0 {
            print_papers_costs(&stages::papers_costs(&known, &stages));
        }
        measured.push(stages);
    }
    print(&measured);
}

/// The paper's seconds and today's milliseconds.
fn print_papers_costs(costs: &[(&str, f64, f64)]) {
    println!("| | then, s | now, ms | ratio |\n|---|---|---|---|");
    for (what, then, now) in costs {
        println!("| {what} | {then} | {:.3} | {:.0} |", 1000.0 * now, then / now);
    }
    println!();
}

/// Time and peak memory of every stage, and the exponents of growth from one wing to the next.
fn print(measured: &[Stages]) {
    let heading = |of: &Stages| format!(" {} DOF, s | MB |", of.dof);
    let exponents = measured.windows(2).map(|pair| format!(" {} to {} |", pair[0].dof, pair[1].dof));
    println!("| stage |{}{}", measured.iter().map(heading).collect::<String>(), exponents.collect::<String>());
    println!("|---|{}", "---|".repeat(3 * measured.len() - 1));
    for (row, stage) in measured[0].all.iter().enumerate() {
        let cells =
            measured.iter().map(|of| format!(" {:.6} | {:.1} |", of.all[row].seconds, of.all[row].bytes as f64 / 1e6));
        let exponent = |pair: &[Stages]| {
            let ratio = pair[1].all[row].seconds / pair[0].all[row].seconds;
            format!(" {:.2} |", ratio.ln() / (pair[1].dof as f64 / pair[0].dof as f64).ln())
        };
        let exponents = measured.windows(2).map(exponent).collect::<String>();
        println!("| {} |{}{exponents}", stage.name, cells.collect::<String>());
    }
}
