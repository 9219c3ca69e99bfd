//! Many runs of a job: what its factors come to.

use crate::files::job::{Study, Summary, Vary};
use crate::present::table::{Cell, Digits, Table, counted};

/// Mean, standard deviation and quantiles of every factor over the samples that did not fail.
pub fn study_table(study: &Study, summary: &Summary) -> Table {
    let name = |vary: &Vary| match vary {
        Vary::Noise => "noise on the test",
        Vary::Start => "the first point",
        Vary::Subset => "sensors or modes left out",
    };
    let (Summary { spreads, within, outside, failed }, vary) = (summary, study.vary.iter().map(name));
    let count = within + outside + failed.len();
    let table = Table::new("study", format!("{}: factors over many runs", study.prepared.title), "Parameter");
    let mut table = table.columns(["mean", "deviation", "2.5 %", "median", "97.5 %"], "").note(format!(
        "{}, seed {}, with {}: {within} within tolerance, {outside} outside, {} failed.",
        counted(count, "sample", "samples"),
        study.seed,
        vary.collect::<Vec<_>>().join(" and "),
        failed.len(),
    ));
    if let Some(first) = failed.first() {
        table.notes.push(format!("What failed does not count; --sample {first} says why sample {first} did."));
    }
    for (name, spread) in spreads {
        let numbers = spread.iter().flat_map(|spread| [vec![spread.mean, spread.deviation], spread.quantiles.to_vec()]);
        table.row(name, numbers.flatten().map(|number| Cell::number(number, Digits::Fixed(4))));
    }
    table
}
