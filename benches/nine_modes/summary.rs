//! The ratios at the end of a run, from the times that criterion wrote.

use crate::problem::PassSetting;
use corfem::method::appendix_c::Pencil;
use corfem::method::error::Error;
use corfem::method::perturbation::{Perturbed, first_order, recursive_1, recursive_1_converged};
use nalgebra::{DMatrix, DVector};
use std::path::Path;

pub const DERIVATIVES: &str = "15 element derivatives";
pub const UPDATE: &str = "modal update";
pub const CASES: &str = "cases";
pub const DEFINITION: &str = "by definition";
/// Eigensolutions of matrices at the dynamic degrees of freedom.
pub const EIGENSOLUTION: &str = "eigensolution, ";
/// Eigensolutions that begin at the last modes, where the matrix is nearly diagonal.
pub const FROM_MODES: &str = "eigensolution in the last modes, ";
/// What solves them.
pub const RIVALS: [&str; 4] = ["cyclic Jacobi", "nalgebra", "nalgebra, fixed size", "faer"];

/// A way from $k$ and $\beta$ to the changed modes.
type Formula = fn(&DVector<f64>, &DMatrix<f64>) -> Result<Perturbed, Error>;

/// The updates compared.
pub fn formulae() -> [(&'static str, Formula); 6] {
    [
        ("first order", first_order),
        ("Recursive 1, order 2", |k, beta| recursive_1(k, beta, 2)),
        ("Recursive 1, order 4", |k, beta| recursive_1(k, beta, 4)),
        ("Recursive 1, order 8", |k, beta| recursive_1(k, beta, 8)),
        ("Recursive 1, converged", |k, beta| {
            Ok(recursive_1_converged(k, beta)?.perturbed)
        }),
        ("Recursive 2, order 2", |k, beta| {
            let no_mass = DMatrix::zeros(k.len(), k.len());
            Pencil::of_vibrations(k, beta, &no_mass)?.recursive_2(2)
        }),
    ]
}

/// Least time of an iteration in microseconds; none for a benchmark left out of this run.
///
/// The fastest of criterion's samples: whatever else the computer does can only add to it.
fn microseconds(folder: &Path, group: &str, name: &str) -> Option<f64> {
    let file = folder.join(group).join(name).join("new/sample.json");
    let sample: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(file).ok()?).ok()?;
    let (times, counts) = (sample["times"].as_array()?, sample["iters"].as_array()?);
    let per_iteration = times
        .iter()
        .zip(counts)
        .filter_map(|(time, count)| Some(time.as_f64()? / count.as_f64()?));
    per_iteration
        .reduce(f64::min)
        .map(|nanoseconds| nanoseconds / 1000.0)
}

/// Prints every comparison.
pub fn print(folder: &Path, passes: &[PassSetting]) {
    println!(
        "\nLeast times, and how many times faster than the eigensolutions (all eigenvalues and vectors, nothing else).\n"
    );
    compare(folder, DERIVATIVES, &[DEFINITION], EIGENSOLUTION);
    let names: Vec<&str> = formulae().iter().map(|(name, _)| *name).collect();
    compare(folder, UPDATE, &names, EIGENSOLUTION);
    compare(folder, UPDATE, &names, FROM_MODES);
    println!("Table 13 today: inner iterations and microseconds\n");
    println!(
        "{:<14}{:>12}{:>14}{:>14}",
        "", "iterations", "inner loop", "analysis"
    );
    for pass in passes {
        let label = pass.label();
        let time = |what: &str| written(microseconds(folder, CASES, &format!("{label} {what}")));
        println!(
            "{label:<14}{:>12}{:>14}{:>14}",
            pass.iterations,
            time("inner loop"),
            time("analysis"),
        );
    }
    for case in corfem::torque_box::CASES {
        let label = format!("case {case} whole");
        println!(
            "{label:<14}{:>26}",
            written(microseconds(folder, CASES, &label))
        );
    }
}

/// One line per method, one column per rival.
fn compare(folder: &Path, group: &str, methods: &[&str], prefix: &str) {
    let rivals = RIVALS.map(|rival| microseconds(folder, group, &format!("{prefix}{rival}")));
    println!(
        "{:<36}{:>10}{}",
        format!("{group} by"),
        "us",
        RIVALS.map(|rival| format!("{rival:>22}")).concat()
    );
    println!(
        "{:<46}{}",
        prefix.trim_end_matches(", "),
        rivals.map(|time| format!("{:>22}", written(time))).concat()
    );
    for &method in methods {
        let own = microseconds(folder, group, method);
        let ratios = rivals.map(|rival| match (rival, own) {
            (Some(rival), Some(own)) => format!("{:>21.1}x", rival / own),
            _ => format!("{:>22}", "-"),
        });
        println!("{method:<36}{:>10}{}", written(own), ratios.concat());
    }
    println!();
}

fn written(time: Option<f64>) -> String {
    time.map_or_else(|| "-".to_owned(), |time| format!("{time:.2}"))
}
