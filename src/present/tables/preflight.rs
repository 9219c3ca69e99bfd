//! The pre-flight as tables: what is found, and how often mistakes made on purpose are.

use super::noise_words;
use crate::present::table::{Cell, Table};
use crate::studies::noise::Noise;
use crate::studies::preflight::rates::{Rate, Rates};
use crate::studies::preflight::{Finding, MISTAKES, Mistake};

/// What is found before the first step, structure by structure.
pub fn findings_table(found: &[(String, Vec<Finding>)]) -> Table {
    let title = "Before the first step: what is found";
    let mut table = Table::new("preflight_findings", title, "Structure").headings(["Finding"], "");
    for (name, findings) in found {
        if findings.is_empty() {
            table.row(name, [Cell::text("nothing")]);
        }
        for (place, finding) in findings.iter().enumerate() {
            let label = if findings.len() == 1 { name.clone() } else { format!("{name}, {}", place + 1) };
            table.row(label, [Cell::text(finding.to_string())]);
        }
    }
    table
}

/// A count over the seeds of one mistake.
type Count = fn(&Rate) -> usize;

/// How often each mistake is named first, named first or as the next best, and not passed over in silence.
pub fn rate_tables(rates: &[Rates]) -> Vec<Table> {
    let seeds = rates.first().map_or(0, |rates| rates.seeds);
    let sides: [(&str, &str, Count); 3] = [
        ("named", "named", |rate| rate.named),
        ("told", "named first or as the next best", |rate| rate.told),
        ("said", "anything said", |rate| rate.said),
    ];
    let mut tables = sides.map(|(name, what, count)| {
        let title = format!("Mistakes made on purpose: {what}, of {seeds} seeds");
        let table = Table::new(format!("preflight_{name}"), title, "Mistake").labels(MISTAKES.map(words));
        rates.iter().fold(table, |table, rates| {
            let rate = |mistake| rates.rates.iter().find(|rate| rate.mistake == mistake);
            let counts = MISTAKES.map(|mistake| rate(mistake).map_or(Cell::Blank, |rate| Cell::count(count(rate))));
            table.column(&rates.name, "", counts)
        })
    });
    tables[0].row("none: false alarms", rates.iter().map(|rates| Cell::count(rates.false_alarms)));
    tables[0].row("none: a low pair by noise", rates.iter().map(|rates| Cell::count(rates.low_pairs)));
    tables[0].notes.push(format!(
        "Noise: {}. What a mistake hits is drawn anew with every seed. Named: with all its places right.",
        noise_words(Noise::USUAL)
    ));
    tables.to_vec()
}

fn words(mistake: Mistake) -> &'static str {
    match mistake {
        Mistake::Factor => "common factor of the frequencies",
        Mistake::Reversed => "one sensor reversed",
        Mistake::Exchanged => "two sensors exchanged",
        Mistake::Reordered => "points in another order",
        Mistake::TwoColumns => "two columns of T exchanged",
        Mistake::Columns => "columns of T in another order",
        Mistake::Transposed => "shapes transposed",
        Mistake::Frequencies => "two frequencies exchanged",
        Mistake::Repeated => "a mode measured twice",
        Mistake::FewPoints => "fewer points than modes",
    }
}
