//! Prints tables of the studies behind `paper/*.md` as the goldens and `paper/readings.csv` have them, and the figures of documents as SVG:
//! those that are named, or the names. The tests hold them against goldens and documents.
#![allow(
    dead_code,
    unused_imports,
    unused_macros,
    reason = "the tests use the rest"
)]

#[macro_use]
#[path = "../../tests/common/mod.rs"]
mod common;

use common::prelude;
use common::presentation::paper;
use common::presentation::paper::figures::Figure;
use common::presentation::studies::STUDIES;
use common::presentation::studies::tour_figures::figures;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo names what it runs.
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let asked: Vec<&String> = asked.iter().filter(|name| *name != "--bench").collect();
    let all = || STUDIES.iter();
    let drawn = || figures().into_iter();
    if asked.is_empty() {
        all().for_each(|(name, _)| println!("{name}"));
        drawn().for_each(|(name, _)| println!("{name}"));
    }
    for name in asked {
        if let Some((_, tables)) = all().find(|(own, _)| own == name) {
            print!("{}", prelude::csv(&tables()));
            continue;
        }
        let found = drawn().find(|(own, _)| own == name);
        let (_, diagram) = found.ok_or_else(|| format!("there is no study {name}"))?;
        print!("{}", Figure::drawn(name, "", &diagram.svg()?).svg);
    }
    Ok(())
}
