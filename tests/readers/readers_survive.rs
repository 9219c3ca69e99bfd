//! Whatever stands in a file, its reader answers with a model or with an error: it does not panic, and it does not hang.
//!
//! Valid files are damaged at random, one seed a call: characters changed, lost and doubled, lines cut and exchanged, numbers made
//! extreme. `CORFEM_CALLS=100000 CORFEM_READER=OUTPUT4 cargo test --release readers_survive -- --nocapture` makes so many calls of every
//! reader with that word in its name, all of them without, and says how many and in what time. `CORFEM_SEED=100000` goes on behind them.

use crate::prelude::*;
use corfem::files::deck::{modes, read as read_deck};
use corfem::files::matrices::read as read_matrix;
use corfem::files::test_data::read as read_test;
use corfem::job::Job;

/// What damage puts in: field separators, signs, ends of numbers, ends of lines, and bytes that are no text.
const BYTES: &[u8] = b" ,.+-*=0123456789eEdD$#\"'\t\r\n[]\0\xff\xefAG";
const WORDS: [&[u8]; 8] = [
    b"1.+308",
    b"-1",
    b"99999999999999999999",
    b"NaN",
    b"THRU",
    b"GRID,1",
    b"1e-320",
    b"\n*",
];

impl Draws {
    /// One to four changes anywhere.
    pub fn damaged(&mut self, valid: &[u8]) -> Vec<u8> {
        let mut text = valid.to_vec();
        for _ in 0..1 + self.below(4) {
            let at = self.below(text.len() + 1);
            let end = (at + 1 + self.below(12)).min(text.len());
            match self.below(6) {
                0 if at < text.len() => text[at] = BYTES[self.below(BYTES.len())],
                1 => text.insert(at, BYTES[self.below(BYTES.len())]),
                2 if at < end => drop(text.drain(at..end)),
                3 => {
                    let word = WORDS[self.below(WORDS.len())];
                    text.splice(at..end.max(at), word.iter().copied());
                }
                4 => {
                    let mut lines = text.split_inclusive(|byte| *byte == b'\n').collect_vec();
                    let (a, b) = (self.below(lines.len()), self.below(lines.len()));
                    if a < lines.len() && b < lines.len() {
                        lines.swap(a, b);
                    }
                    text = lines.concat();
                }
                _ => text.truncate(at),
            }
        }
        text
    }
}

/// Whether the building's job, with another table of rows, can be prepared; its matrices and its test are where they are.
fn prepares(job: &[u8], rows: &[u8]) -> bool {
    let folder = new_folder();
    let files = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/jobs/building/");
    let mut text = String::from_utf8_lossy(job).into_owned();
    for name in ["stiffness.mtx", "mass.mtx", "story_", "test.csv"] {
        text = text.replace(&format!("\"{name}"), &format!("\"{files}{name}"));
    }
    let path = folder.path().join("job.toml");
    fs::write(&path, text).unwrap();
    fs::write(folder.path().join("rows.csv"), rows).unwrap();
    prepare(&path).is_ok()
}

const JOB: &[u8] = include_bytes!("../jobs/building/job.toml");
const ROWS: &[u8] = include_bytes!("../jobs/building/rows.csv");

type Reader = (&'static str, &'static [u8], fn(&[u8]) -> bool);

/// Each reader with a valid file, and whether an answer is no error.
const READERS: &[Reader] = &[
    ("deck", include_bytes!("../../golden/nastran95/decks/box_case_1_gvt.inp"), |text| {
        read_deck("deck", text, &[]).is_ok()
    }),
    ("modes of a small deck", b"GRID,1,,0.,0.,0.,,123456\nGRID,2,,10.,0.,0.,,23456\nCROD,1,1,1,2\nPROD,1,1,.01\nMAT1,1,1.+6,,.3\nCMASS2,8,.4,2,1\nSPC1,1,123,1\n", |text| {
        read_deck("deck", text, &[]).ok().is_some_and(|deck| modes(&deck.model, usize::MAX).is_ok())
    }),
    ("OUTPUT5", include_bytes!("../../golden/nastran95/output5_rod.txt"), |text| {
        read_output5(&String::from_utf8_lossy(text), 10_000).is_ok()
    }),
    ("deck to be rewritten", include_bytes!("../../golden/formats/original.bdf"), |text| {
        let factors = BTreeMap::from([(12, [1.1, 0.5]), (21, [0.5, 1.0])]);
        rewrite("deck", text, &factors, &BTreeMap::from([(91, 2.0)])).is_ok()
    }),
    ("Matrix Market", include_bytes!("../../golden/formats/symmetric.mtx"), |text| read_matrix("m", text, None).is_ok()),
    ("array of Matrix Market", include_bytes!("../../golden/formats/symmetric_array.mtx"), |text| {
        read_matrix("m", text, None).is_ok()
    }),
    ("DMIG", include_bytes!("../../golden/formats/small.dmig"), |text| read_matrix("m", text, Some("KAAX")).is_ok()),
    ("dense OUTPUT4", include_bytes!("../../golden/formats/dense.op4"), |text| read_matrix("m", text, Some("T")).is_ok()),
    ("sparse OUTPUT4", include_bytes!("../../golden/formats/sparse.op4"), |text| {
        read_matrix("m", text, Some("KAA")).is_ok()
    }),
    ("large OUTPUT4", include_bytes!("../../golden/formats/bigmat.op4"), |text| read_matrix("m", text, Some("T")).is_ok()),
    ("universal file", include_bytes!("../../golden/formats/universal_real.unv"), |text| read_test("test", text).is_ok()),
    ("complex modes", include_bytes!("../../golden/formats/universal_complex.unv"), |text| {
        read_test("test", text).is_ok()
    }),
    ("nodes in long columns", include_bytes!("../../golden/formats/universal_six.unv"), |text| {
        read_test("test", text).is_ok_and(|data| !write_universal(&data).is_empty() && !write_csv(&data).is_empty())
    }),
    ("coordinate systems", include_bytes!("../../golden/formats/universal_axes.unv"), |text| {
        read_test("test", text).is_ok_and(|data| data.sensors.iter().all(|sensor| sensor.place.is_some()))
    }),
    ("table of a test", b"# wing\nfrequency_hz,,,,,,,1.5,2.5\nshape_deviation,,,,,,,.01,.02\nname,grid,direction,sign,x,y,z,mode 1,mode 2\n\"tip, left\",12,z,-,0.,1.,2.,.5,-1.\nroot,1,rx,,,,,.25,1.e-1\n", |text| {
        read_test("test", text).is_ok()
    }),
    ("job", JOB, |text| toml::from_str::<Job>(&String::from_utf8_lossy(text)).is_ok()),
    ("job and what it names", JOB, |text| prepares(text, ROWS)),
    ("rows of a job", ROWS, |text| prepares(JOB, text)),
    ("torque box", include_bytes!("../../paper/reconstruction.toml"), |text| {
        Reconstruction::parse("box", &String::from_utf8_lossy(text)).is_ok()
    }),
    ("published table", include_bytes!("../../paper/tables/table_10.csv"), |text| {
        PublishedTable::parse(10, "table", &String::from_utf8_lossy(text)).is_ok()
    }),
];

/// A number that the environment asks for.
pub fn asked(name: &str, otherwise: u64) -> u64 {
    let number = std::env::var(name).ok();
    number
        .and_then(|number| number.parse().ok())
        .unwrap_or(otherwise)
}

#[test]
fn no_reader_panics_on_a_damaged_file() {
    let (calls, from) = (asked("CORFEM_CALLS", 500), asked("CORFEM_SEED", 0));
    let reader = std::env::var("CORFEM_READER").unwrap_or_default();
    let mut faults = Vec::new();
    for (name, valid, read) in READERS.iter().filter(|(name, ..)| name.contains(&reader)) {
        let start = Instant::now();
        assert!(read(valid), "{name}: the file without damage reads");
        let mut refused = 0;
        for seed in from..from + calls {
            let text = Draws(seed).damaged(valid);
            match catch_unwind(AssertUnwindSafe(|| read(&text))) {
                Ok(true) => {}
                Ok(false) => refused += 1,
                Err(_) => faults.push(format!("{name}, seed {seed}")),
            }
        }
        println!(
            "{name}: {calls} calls in {:.0?}, {refused} refused",
            start.elapsed()
        );
        assert!(
            refused > calls / 20,
            "{name}: {refused} of {calls} were refused"
        );
    }
    assert!(faults.is_empty(), "{faults:?}");
}
