//! Many runs of a job: what its factors come to.

use crate::files::job::{Study, Summary, Vary};
use crate::present::table::{Digits, Table, counted, numbers};

/// Mean, standard deviation and quantiles of every factor over the samples that did not fail.
pub fn study_table(study: &Study, summary: &Summary) -> Table {
    let name = |vary: &Vary| match vary {
        Vary::Noise => "noise on the test",
        Vary::Start => "the first point",
        Vary::Subset => "sensors or modes left out",
    };
    let (Summary { spreads, within, outside, failed }, vary) = (summary, study.vary.iter().map(name));
    let count = within + outside + failed.len();
    let note = format!(
        "{}, seed {}, with {}: {within} within tolerance, {outside} outside, {} failed.",
        counted(count, "sample", "samples"),
        study.seed,
        vary.collect::<Vec<_>>().join(" and "),
        failed.len(),
    );
    let why = |first| format!("What failed does not count; --sample {first} says why sample {first} did.");
    let mut table = Table::new("study", format!("{}: factors over many runs", study.prepared.title), "Parameter")
        .headings(["mean", "deviation", "2.5 %", "median", "97.5 %"], "")
        .notes([note])
        .notes(failed.first().map(why));
    for (name, spread) in spreads {
        let spread = spread.iter().flat_map(|spread| [vec![spread.mean, spread.deviation], spread.quantiles.to_vec()]);
        table.row(name, numbers(spread.flatten(), Digits::Fixed(4)));
    }
    table
}
