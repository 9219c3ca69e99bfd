//! The samples of a study in their file, one per line, and their statistics.

use super::Study;
use super::study::FAILED;
use crate::files::disk;
use crate::files::error::{FileError, is_not};
use crate::method::step::Bounds;
use crate::weighted::intervals::is_at_end;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Bars of a histogram.
const BARS: usize = 24;
/// The parts of all samples below the quantiles.
const PARTS: [f64; 3] = [0.025, 0.5, 0.975];

/// Places of a file's samples: some forty bytes per sample, whatever the number of parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Samples {
    path: PathBuf,
    /// Place where the line of each begins, by its number.
    places: BTreeMap<u64, u64>,
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
    /// Least and largest.
    pub ends: [f64; 2],
    /// Number of samples in each of equal intervals between the least and the largest.
    pub bars: Vec<usize>,
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
        let mut samples = Self {
            path: path.to_owned(),
            places: BTreeMap::new(),
            whole: 0,
        };
        let failed = FileError::of_file(path, "read");
        let mut reader = BufReader::new(disk::open(path).map_err(&failed)?);
        let (header, count, mut bytes) = (study.header(), study.parameters().count(), Vec::new());
        for number in 1.. {
            bytes.clear();
            let length = reader.read_until(b'\n', &mut bytes).map_err(&failed)?;
            if bytes.last() != Some(&b'\n') {
                break;
            }
            let (text, at) = (String::from_utf8_lossy(&bytes), samples.whole);
            samples.whole += length as u64;
            if text.trim_end() == header.trim_end() || text.trim().is_empty() {
                continue;
            }
            let name = path.display().to_string();
            let wrong = |what| {
                Err(FileError::line(
                    &name,
                    number,
                    is_not(text.trim_end(), what),
                ))
            };
            let cells: Vec<&str> = text.trim_end().split(',').collect();
            let (Some(sample), true) = (cells[0].parse().ok(), cells.len() == count + 6) else {
                return wrong("a line of a sample of this study");
            };
            if cells[count + 5] != study.identity {
                return wrong("a sample of this job, seed and choice of what varies");
            }
            let is_number = |cell: &&str| cell.parse::<f64>().is_ok_and(f64::is_finite);
            let is_run =
                ["true", "false"].contains(&cells[2]) && cells[3..count + 5].iter().all(is_number);
            if cells[1] != FAILED && !is_run {
                return wrong(
                    "a sample with true or false, and error sum, analyses and factors as numbers",
                );
            }
            if let Some(before) = samples.places.insert(sample, at) {
                // Rare enough to read that line again.
                let mut other = BufReader::new(disk::open(path).map_err(&failed)?);
                other.seek(SeekFrom::Start(before)).map_err(&failed)?;
                let mut line = String::new();
                other.read_line(&mut line).map_err(&failed)?;
                if line.trim_end() != text.trim_end() {
                    return wrong("what another line says of this sample");
                }
            }
        }
        Ok(samples)
    }

    /// True if a sample is there.
    pub fn contains(&self, sample: u64) -> bool {
        self.places.contains_key(&sample)
    }

    /// The statistics of the samples up to number `last`, whatever their order in the file. Only one parameter's values are in memory at
    /// a time.
    ///
    /// # Errors
    /// [`FileError::File`].
    pub fn summary(&self, study: &Study, last: u64) -> Result<Summary, FileError> {
        let mut summary = Summary {
            spreads: Vec::new(),
            within: 0,
            outside: 0,
            failed: Vec::new(),
        };
        self.each(last, |sample, cells| match cells[1..3] {
            [FAILED, _] => summary.failed.push(sample),
            [_, "true"] => summary.within += 1,
            _ => summary.outside += 1,
        })?;
        let ranges = study.loaded.source.whole.ranges();
        for (place, name) in study.parameters().enumerate() {
            let mut values = Vec::new();
            // A failed sample has no number.
            self.each(last, |_, cells| {
                values.extend(cells[place + 5].parse::<f64>().ok())
            })?;
            summary
                .spreads
                .push((name.to_owned(), spread(values, ranges[place])));
        }
        Ok(summary)
    }

    /// Calls with every sample up to `last`, ascending, and the cells of its line.
    fn each(&self, last: u64, mut with: impl FnMut(u64, &[&str])) -> Result<(), FileError> {
        let failed = FileError::of_file(&self.path, "read");
        let mut reader = BufReader::new(disk::open(&self.path).map_err(&failed)?);
        let (mut now, mut line) = (0, String::new());
        for (&sample, &at) in self.places.range(..=last) {
            // A seek within the buffer reads nothing again.
            reader
                .seek_relative(at as i64 - now as i64)
                .map_err(&failed)?;
            line.clear();
            now = at + reader.read_line(&mut line).map_err(&failed)? as u64;
            with(sample, &line.trim_end().split(',').collect::<Vec<_>>());
        }
        Ok(())
    }
}

/// The statistics of one parameter within its range; none without values.
fn spread(mut values: Vec<f64>, range: Option<Bounds>) -> Option<Spread> {
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
        // Equal values divide zero by zero; NaN casts to 0, the first bar.
        bars[((BARS as f64 * (value - ends[0]) / (ends[1] - ends[0])) as usize).min(BARS - 1)] += 1;
    }
    let deviation = (squares / count.saturating_sub(1).max(1) as f64).sqrt();
    let at_end = |value: &&f64| range.is_some_and(|range| is_at_end(range, **value));
    Some(Spread {
        count,
        at_bound: values.iter().filter(at_end).count(),
        mean,
        deviation,
        quantiles: PARTS.map(quantile),
        ends,
        bars,
    })
}
