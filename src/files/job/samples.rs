//! The samples of a study as a file has them, one a line, and what they come to.

use super::Study;
use super::study::{FAILED, digest};
use crate::files::error::FileError;
use std::collections::BTreeMap;
use std::path::Path;

/// Bars of a histogram.
const BARS: usize = 24;
/// The parts of all samples below the quantiles.
const PARTS: [f64; 3] = [0.025, 0.5, 0.975];

/// The samples of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    by_number: BTreeMap<u64, Sample>,
    /// Bytes of whole lines: what follows is a line that was torn.
    pub whole: u64,
}

#[derive(Debug, Clone, PartialEq)]
struct Sample {
    /// None of one that failed.
    is_within: Option<bool>,
    /// None of one that failed.
    factors: Vec<f64>,
    /// A digest of its line.
    digest: u64,
}

/// The factor of one parameter over the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; zero of one sample.
    pub deviation: f64,
    /// The quantiles of 2.5, 50 and 97.5 %, linear between neighbors in order.
    pub quantiles: [f64; 3],
    /// Least and largest.
    pub ends: [f64; 2],
    /// How many samples lie in each of equal intervals between them.
    pub bars: Vec<usize>,
}

/// What samples come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// By parameter; none without a sample that did not fail.
    pub spreads: Vec<(String, Option<Spread>)>,
    /// Samples within tolerance.
    pub within: usize,
    /// Samples outside.
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
        let bytes = std::fs::read(path).map_err(FileError::of_file(path, "read"))?;
        let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let mut samples = Self { by_number: BTreeMap::new(), whole: whole as u64 };
        let (name, header, count) = (path.display().to_string(), study.header(), study.parameters().count());
        for (number, line) in (1..).zip(String::from_utf8_lossy(&bytes[..whole]).lines().map(str::trim_end)) {
            if line == header.trim_end() || line.is_empty() {
                continue;
            }
            let wrong = |expected| Err(FileError::line(&name, number, expected, line));
            let cells: Vec<&str> = line.split(',').collect();
            let (Some(sample), true) = (cells[0].parse().ok(), cells.len() == count + 6) else {
                return wrong("a line of a sample of this study");
            };
            if cells[count + 5] != format!("{:016x}", study.identity) {
                return wrong("a sample of this job, seed and choice of what varies");
            }
            let numbers: Vec<f64> = cells[3..count + 5].iter().filter_map(|cell| cell.parse().ok()).collect();
            let is_run = numbers.len() == count + 2 && numbers.iter().all(|number| number.is_finite());
            let (is_within, factors) = match cells[1..3] {
                [FAILED, _] => (None, Vec::new()),
                [_, "true" | "false"] if is_run => (Some(cells[2] == "true"), numbers[2..].to_vec()),
                _ => return wrong("true or false, and error sum, analyses and factors as numbers"),
            };
            let new = Sample { is_within, factors, digest: digest(line.as_bytes(), 0) };
            let digest = new.digest;
            if samples.by_number.insert(sample, new).is_some_and(|before| before.digest != digest) {
                return wrong("a sample once, or again as it was");
            }
        }
        Ok(samples)
    }

    /// Whether a sample is there.
    pub fn contains(&self, sample: u64) -> bool {
        self.by_number.contains_key(&sample)
    }

    /// What the samples up to the number `last` come to, the same whatever their order in the file.
    pub fn summary(&self, study: &Study, last: u64) -> Summary {
        let all = || self.by_number.range(..=last);
        let spreads = study.parameters().enumerate().map(|(place, name)| {
            let values = all().filter_map(|(_, sample)| sample.factors.get(place).copied());
            (name.to_owned(), spread(values.collect()))
        });
        let count = |is_within: bool| all().filter(|(_, sample)| sample.is_within == Some(is_within)).count();
        let failed = all().filter(|(_, sample)| sample.is_within.is_none()).map(|(number, _)| *number);
        Summary { spreads: spreads.collect(), within: count(true), outside: count(false), failed: failed.collect() }
    }
}

/// What the numbers of one parameter come to.
fn spread(mut values: Vec<f64>) -> Option<Spread> {
    let count = values.len();
    let mean = values.iter().sum::<f64>() / count as f64;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    values.sort_unstable_by(f64::total_cmp);
    let ends = [*values.first()?, *values.last()?];
    let quantile = |part: f64| {
        let at = part * (count - 1) as f64;
        let (below, above) = (values[at.floor() as usize], values[at.ceil() as usize]);
        below + at.fract() * (above - below)
    };
    let mut bars = vec![0; BARS];
    for value in &values {
        // Of equal numbers none is no number, and stands in the first bar.
        bars[((BARS as f64 * (value - ends[0]) / (ends[1] - ends[0])) as usize).min(BARS - 1)] += 1;
    }
    let deviation = (squares / count.saturating_sub(1).max(1) as f64).sqrt();
    Some(Spread { mean, deviation, quantiles: PARTS.map(quantile), ends, bars })
}
