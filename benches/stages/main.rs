//! Every stage of a pass on the paper's box and on a wing, in time by `cargo bench --bench stages`, and in instructions by
//! `cargo bench --bench stages -- --instructions`, which asks valgrind to count them: times of microseconds are noise from one
//! machine and day to the next, counts are not. Where there is no valgrind it says so and ends.

#[path = "../wing/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the tests use the rest")]
mod wing;
mod problem;

use criterion::Criterion;
use problem::{STRUCTURES, stages};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// How often a stage is done in the longer of two runs whose difference is counted; the shorter does it once.
const REPEATS: usize = 3;

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--instructions"] => instructions(),
        ["--do", structure, row, times] => {
            let mut stages = stages(structure);
            let work = &mut stages[row.parse::<usize>().expect("a row")].1;
            (0..times.parse().expect("how often")).for_each(|_| work());
        }
        _ => times(),
    }
}

fn times() {
    let mut criterion = Criterion::default()
        .output_directory(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("criterion"))
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000))
        .configure_from_args();
    for structure in STRUCTURES {
        let mut group = criterion.benchmark_group(structure);
        for (name, mut work) in stages(structure) {
            group.bench_function(name, |bencher| bencher.iter(&mut work));
        }
        group.finish();
    }
    criterion.final_summary();
}

/// Prints the instructions of every stage.
fn instructions() {
    let Ok(version) = Command::new("valgrind").arg("--version").output() else {
        println!(
            "NOTHING IS COUNTED: valgrind is not installed. Install it (apt-get install valgrind) and run this again."
        );
        return;
    };
    println!(
        "Counted by {}",
        String::from_utf8_lossy(&version.stdout).trim()
    );
    println!(
        "| instructions | {} |\n|---|---|---|",
        STRUCTURES.join(" | ")
    );
    let names: Vec<&str> = stages(STRUCTURES[0]).iter().map(|stage| stage.0).collect();
    for (row, name) in names.into_iter().enumerate() {
        let of_one = |structure: &&str| {
            let [once, often] = [1, REPEATS].map(|times| counted(structure, row, times));
            (often - once) / (REPEATS - 1) as u64
        };
        println!(
            "| {name} | {} | {} |",
            of_one(&STRUCTURES[0]),
            of_one(&STRUCTURES[1])
        );
    }
}

/// The instructions of a whole run that does one stage so often.
fn counted(structure: &str, row: usize, times: usize) -> u64 {
    let program = std::env::current_exe().expect("this program");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--do", structure, &row.to_string(), &times.to_string()])
        .output()
        .expect("valgrind runs");
    let report = String::from_utf8_lossy(&output.stderr);
    let collected = report
        .lines()
        .find_map(|line| line.split("Collected :").nth(1));
    let count = collected.and_then(|count| count.trim().parse().ok());
    count.unwrap_or_else(|| panic!("valgrind counted nothing: {report}"))
}
