//! Prints tables of the studies behind `paper/*.md` as the goldens and `paper/readings.csv` have them, and the figures of documents as SVG:
//! those that are named, or the names. `--check` holds the tables that are named, or all but those that take minutes, against what is
//! stored, which `CORFEM_WRITE=1` writes anew. The tests hold figures and documents.
#![allow(
    dead_code,
    unused_imports,
    unused_macros,
    reason = "the tests use the rest"
)]

#[macro_use]
#[path = "../../tests/common/mod.rs"]
mod common;

use common::prelude::{self, *};
use common::presentation::paper;
use common::presentation::paper::figures::Figure;
use common::presentation::studies::tour_figures::figures;
use common::presentation::studies::{STUDIES, Study};

/// Counts of seeds of a hundred: one at a threshold may fall on its other side on another machine.
const COUNT: f64 = 1.0;
/// Steps of a correlation of dozens of them, which may be one more or less on another machine.
const STEPS: f64 = 0.05;

/// How far numbers of a study may be from what is stored.
fn numbers(name: &str) -> Numbers {
    let steps = Numbers {
        relative: JOB_RESULTS,
        absolute: 100.0 * ROUND_OFF_FLOOR,
        last_digit: true,
        ..Numbers::AS_WRITTEN
    };
    let counted = Numbers {
        relative: 0.0,
        absolute: COUNT,
        whole: true,
        ..Numbers::AS_WRITTEN
    };
    match name {
        "rules" => Numbers {
            absolute: JOB_RESULTS,
            last_digit: false,
            ..steps
        },
        "linearization" => steps,
        "eigensolutions" => Numbers {
            relative: STEPS,
            ..counted
        },
        "coverage" => Numbers {
            relative: GOLDEN_RELATIVE,
            absolute: GOLDEN_COVERAGE,
            ..Numbers::AS_WRITTEN
        },
        "detection" => counted,
        _ => Numbers::BY_UNIT,
    }
}

/// Whether the tables of a study are those that are stored.
fn is_stored((name, tables): &Study) -> bool {
    let (path, head) = match *name {
        "readings" => ("paper/readings.csv".to_owned(), ""),
        name => (
            format!("golden/snapshots/{name}.snap"),
            "---\nsource: tests/common/golden.rs\n---\n",
        ),
    };
    let new = head.to_owned() + &csv(&tables());
    let is_same = numbers(name).agree(&on_file(&path, &new), &new);
    println!("{name}: {}", if is_same { "as stored" } else { "OTHERS" });
    is_same
}

/// Holds the studies that are named against what is stored, or all but those that take minutes.
fn check(asked: &[&String]) -> Result<(), String> {
    let mut names = asked.iter().map(|name| &name[..]).collect_vec();
    if names.is_empty() {
        names.extend(STUDIES.map(|(name, _)| name));
        names.retain(|name| !["coverage", "detection"].contains(name));
    }
    let mut others = Vec::new();
    for name in names {
        let study = STUDIES.iter().find(|(own, _)| *own == name);
        if !is_stored(study.ok_or_else(|| format!("there is no study {name}"))?) {
            others.push(name);
        }
    }
    match others.is_empty() {
        true => Ok(()),
        false => Err(format!("not as stored: {}", others.join(", "))),
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo names what it runs.
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let asked: Vec<&String> = asked.iter().filter(|name| *name != "--bench").collect();
    let all = || STUDIES.iter();
    let drawn = || figures().into_iter();
    if asked.first().is_some_and(|first| *first == "--check") {
        return Ok(check(&asked[1..])?);
    }
    if asked.is_empty() {
        all().for_each(|(name, _)| println!("{name}"));
        drawn().for_each(|(name, _)| println!("{name}"));
    }
    for name in asked {
        if let Some((_, tables)) = all().find(|(own, _)| own == name) {
            print!("{}", csv(&tables()));
            continue;
        }
        let found = drawn().find(|(own, _)| own == name);
        let (_, diagram) = found.ok_or_else(|| format!("there is no study {name}"))?;
        print!("{}", Figure::drawn(name, "", &diagram.svg()?).svg);
    }
    Ok(())
}
