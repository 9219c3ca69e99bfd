//! The samples of a study in their file, one per line, and their statistics.

use super::Study;
use crate::files::error::{FileError, is_not};
use crate::files::read_bytes;
use crate::method::step::Bounds;
use crate::weighted::intervals::is_at_end;
use std::collections::BTreeMap;
use std::path::Path;

/// The samples of a file.
#[derive(Debug)]
pub struct Samples {
    /// The line of each, by its number.
    lines: BTreeMap<u64, String>,
    /// Bytes of whole lines; anything after them is a torn line.
    pub whole: u64,
}

/// The factor of one parameter over the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Number of samples.
    pub count: usize,
    /// Number of them that are at a bound.
    pub at_bound: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero of one sample.
    pub deviation: f64,
    /// The quantiles of 2.5, 50 and 97.5 %, linear between neighbors in order.
    pub quantiles: [f64; 3],
}

/// The statistics of the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Statistics by parameter; none without a sample that did not fail.
    pub spreads: Vec<(String, Option<Spread>)>,
    /// Samples within tolerance with every test mode compared that they select.
    pub within: usize,
    /// Other samples that ran.
    pub outside: usize,
    /// Numbers of those that failed.
    pub failed: Vec<u64>,
}

impl Samples {
    /// Reads a file of lines in any order; a header may stand anywhere, and a sample again as it was.
    ///
    /// # Errors
    /// [`FileError::File`]; [`FileError::DeckLine`] for a line of another study or of none, and a sample again with other numbers.
    pub fn read(path: &Path, study: &Study) -> Result<Self, FileError> {
        let bytes = read_bytes(path).map_err(FileError::of_file(path, "read"))?;
        let (header, end) = (study.header(), study.parameters().count() + 5);
        let (mut lines, mut whole) = (BTreeMap::new(), 0);
        for (number, bytes) in (1..).zip(bytes.split_inclusive(|byte| *byte == b'\n')) {
            if !bytes.ends_with(b"\n") {
                break;
            }
            whole += bytes.len() as u64;
            let line = String::from_utf8_lossy(bytes).trim_end().to_owned();
            if line == header.trim_end() || line.is_empty() {
                continue;
            }
            let file = path.display().to_string();
            let wrong = |what| Err(FileError::line(&file, number, is_not(&line, what)));
            let cells: Vec<&str> = line.split(',').collect();
            let (Ok(sample), true) = (cells[0].parse(), cells.len() == end + 1) else {
                return wrong("a line of a sample of this study");
            };
            if cells[end] != study.identity {
                return wrong("a sample of this job, seed and choice of what varies");
            }
            let is_number = |cell: &&str| cell.parse::<f64>().is_ok_and(f64::is_finite);
            let is_run = cells[2].parse::<bool>().is_ok() && cells[3..end].iter().all(is_number);
            // A failed sample has nothing there.
            if !is_run && !cells[2..end].concat().is_empty() {
                return wrong(
                    "a sample with true or false, and error sum, analyses and factors as numbers",
                );
            }
            let before = lines.insert(sample, line.clone());
            if before.is_some_and(|before| before != line) {
                return wrong("what another line says of this sample");
            }
        }
        Ok(Self { lines, whole })
    }

    /// True if a sample is there.
    pub fn contains(&self, sample: u64) -> bool {
        self.lines.contains_key(&sample)
    }

    /// The statistics of the samples up to number `last`, whatever their order in the file.
    pub fn summary(&self, study: &Study, last: u64) -> Summary {
        let rows = self.lines.range(..=last);
        let rows = rows.map(|(sample, line)| (*sample, line.split(',').collect::<Vec<_>>()));
        let (failed, ran): (Vec<_>, Vec<_>) = rows.partition(|(_, cells)| cells[2].is_empty());
        let within = ran.iter().filter(|(_, cells)| cells[2] == "true").count();
        let ranges = study.prepared.loaded.source.whole.ranges();
        let parameters = study.parameters().zip(ranges).enumerate();
        let spreads = parameters.map(|(place, (name, range))| {
            let values = ran.iter().flat_map(|(_, cells)| cells[place + 5].parse());
            (name.to_owned(), spread(values.collect(), range))
        });
        Summary {
            spreads: spreads.collect(),
            within,
            outside: ran.len() - within,
            failed: failed.into_iter().map(|(sample, _)| sample).collect(),
        }
    }
}

/// The statistics of one parameter within its range; none without values.
fn spread(mut values: Vec<f64>, range: Option<Bounds>) -> Option<Spread> {
    values.sort_unstable_by(f64::total_cmp);
    let count = values.len();
    let last = count.checked_sub(1)?;
    let mean = values.iter().sum::<f64>() / count as f64;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let quantile = |part: f64| {
        let at = part * last as f64;
        let (below, above) = (values[at.floor() as usize], values[at.ceil() as usize]);
        below + at.fract() * (above - below)
    };
    let at_end = |value: &&f64| range.is_some_and(|range| is_at_end(range, **value));
    Some(Spread {
        count,
        at_bound: values.iter().filter(at_end).count(),
        mean,
        deviation: (squares / last.max(1) as f64).sqrt(),
        quantiles: [0.025, 0.5, 0.975].map(quantile),
    })
}
