//! Prints the tables of the studies behind `paper/*.md` as the goldens and `paper/readings.csv` have them: of those that are named, or
//! their names. The tests hold them against the goldens.
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
use common::presentation::studies::{LONG, QUICK};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo names what it runs.
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let asked: Vec<&String> = asked.iter().filter(|name| *name != "--bench").collect();
    let all = || QUICK.iter().chain(&LONG);
    if asked.is_empty() {
        all().for_each(|(name, _)| println!("{name}"));
    }
    for name in asked {
        let found = all().find(|(own, _)| own == name);
        let (_, text) = found.ok_or_else(|| format!("there is no study {name}"))?;
        print!("{}", text()?);
    }
    Ok(())
}
