//! Whatever stands in a file, its reader answers with what it says or with an error, the same whatever ends its lines: it does not panic, and
//! it does not hang. Nor does a job, whatever stands in it and in its files.
//!
//! Valid files are damaged at random, one seed a call: characters changed, lost and doubled, lines cut and exchanged, numbers made
//! extreme. `CORFEM_CALLS=100000 cargo test --release survive -- --nocapture` makes so many calls of every file.

use crate::common::draws::asked_calls;
use crate::common::jobs::run;
use crate::prelude::*;
use corfem::job::TEMPLATE;
use corfem::present::json;
use corfem::present::page::report_page;
use std::cell::Cell;

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

/// What a reader says of a file, its error among it.
type Said = Result<String, String>;

fn words<T: Debug>(found: Result<T, impl Display>) -> Said {
    let found = found.map(|own| format!("{own:?}"));
    found.map_err(|error| error.to_string())
}

fn of_deck(bytes: &[u8]) -> Said {
    words(deck::read("file", bytes, &[]))
}

fn of_modes(bytes: &[u8]) -> Said {
    let found = deck::read("file", bytes, &[]);
    words(found.and_then(|own| deck::modes(&own.model, usize::MAX)))
}

fn of_rewrite(bytes: &[u8]) -> Said {
    let factors = BTreeMap::from([(12, [1.1, 0.5]), (21, [0.5, 1.0])]);
    words(rewrite(
        "deck",
        bytes,
        &factors,
        &BTreeMap::from([(91, 2.0)]),
    ))
}

/// Of a file with several, a matrix that it has.
fn of_matrix(bytes: &[u8]) -> Said {
    let named = |name| matrices::read("file", bytes, name);
    let found = named(None).or_else(|error| {
        let names = ["KAA", "KAAX", "T"].into_iter();
        names
            .filter_map(|name| named(Some(name)).ok())
            .next()
            .ok_or(error)
    });
    words(found)
}

fn of_test(bytes: &[u8]) -> Said {
    words(test_data::read("file", bytes))
}

fn of_output5(bytes: &[u8]) -> Said {
    words(read_output5(&String::from_utf8_lossy(bytes), 10_000))
}

fn of_box(bytes: &[u8]) -> Said {
    words(Reconstruction::parse(
        "box",
        &String::from_utf8_lossy(bytes),
    ))
}

fn of_table(bytes: &[u8]) -> Said {
    words(PublishedTable::parse(
        10,
        "table",
        &String::from_utf8_lossy(bytes),
    ))
}

/// The building's job with another file.
fn prepared_with(name: &str, bytes: &[u8]) -> Said {
    let (folder, path) = placed(&building());
    fs::write(folder.path().join(name), bytes).unwrap();
    words(prepare(&path).map(|own| own.modes))
}

fn of_job(bytes: &[u8]) -> Said {
    prepared_with("job.toml", bytes)
}

fn of_rows(bytes: &[u8]) -> Said {
    prepared_with("rows.csv", bytes)
}

/// A reader and one of its files.
type Reader = (&'static str, &'static [u8], fn(&[u8]) -> Said);

macro_rules! files {
    ($($reader:ident: $($name:literal)*;)*) => {
        &[$($(($name, include_bytes!(concat!("../../", $name)), $reader)),*),*]
    };
}

/// Files of this repository, most of them by other programs, whose lines may end in any way.
const OF_LINES: &[Reader] = files! {
    of_deck: "golden/formats/original.bdf" "golden/formats/rewritten.bdf" "tests/jobs/box/model.bdf" "golden/nastran95/decks/box_case_1_gvt.inp";
    of_matrix: "golden/formats/symmetric.mtx" "golden/formats/general_array.mtx" "golden/formats/symmetric_array.mtx" "golden/formats/small.dmig"
        "golden/formats/large.dmig" "golden/formats/dense.op4" "golden/formats/sparse.op4" "golden/formats/bigmat.op4";
    of_test: "golden/formats/universal_real.unv" "golden/formats/universal_complex.unv" "golden/formats/universal_six.unv"
        "golden/formats/universal_axes.unv" "golden/formats/shapes.unv" "tests/jobs/building/test.csv" "tests/jobs/wing/test.unv";
};

const OTHERS: &[Reader] = files! {
    of_modes: "tests/jobs/rods/model.bdf";
    of_rewrite: "golden/formats/original.bdf";
    of_output5: "golden/nastran95/output5_rod.txt";
    of_job: "tests/jobs/building/job.toml";
    of_rows: "tests/jobs/building/rows.csv";
    of_box: "paper/reconstruction.toml";
    of_table: "paper/tables/table_10.csv";
};

#[test]
fn no_reader_panics_on_a_damaged_file() {
    let calls = asked_calls(500);
    let mut faults = Vec::new();
    for (name, valid, read) in OF_LINES.iter().chain(OTHERS) {
        let said = read(valid);
        assert!(said.is_ok(), "{name}: {said:?}");
        let mut refused = 0;
        for seed in 0..calls {
            let text = Draws(seed).damaged(valid);
            match catch_unwind(AssertUnwindSafe(|| read(&text))) {
                Ok(said) => refused += u64::from(said.is_err()),
                Err(_) => faults.push(format!("{name}, seed {seed}")),
            }
        }
        assert!(
            refused > calls / 20,
            "{name}: {refused} of {calls} were refused"
        );
    }
    assert!(faults.is_empty(), "{faults:?}");
}

#[test]
fn ends_of_lines_change_nothing_that_is_said_of_whole_and_damaged_files() {
    for (name, valid, read) in OF_LINES {
        assert!(!valid.contains(&b'\r'), "{name}");
        let damaged = (0..asked_calls(500) / 8).map(|seed| {
            let mut damaged = Draws(seed).damaged(valid);
            damaged.retain(|byte| *byte != b'\r');
            damaged
        });
        // Bytes that say how wide a character is are no text of one byte each.
        let is_text = |own: &Vec<u8>| !own.starts_with(&[0xff]) && !own.starts_with(&[0xfe]);
        for bytes in once(valid.to_vec()).chain(damaged.filter(is_text)) {
            let said = read(&bytes);
            let lines = bytes.split(|byte| *byte == b'\n').collect_vec();
            for end in [&b"\r\n"[..], b"\r"] {
                assert_eq!(read(&lines.join(end)), said, "{name}");
            }
            let others = read(bytes.strip_suffix(b"\n").unwrap_or(&bytes));
            // Damage may leave a last number as one that the end of the file cut.
            let is_cut = others
                .as_ref()
                .is_err_and(|own| own.contains("ends inside"));
            assert!(is_cut || others == said, "{name}: {said:?}, {others:?}");
        }
    }
}

#[test]
fn files_cut_off_anywhere_are_answered() {
    for (name, bytes, read) in OF_LINES {
        for end in 0..bytes.len().min(3000) {
            let answer = catch_unwind(AssertUnwindSafe(|| read(&bytes[..end])));
            assert!(answer.is_ok(), "{name} cut off behind byte {end}");
        }
    }
}

/// Values in the place of numbers, of lists and of any other.
const NUMBERS: [&str; 12] = [
    "0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-300",
    "1e300",
    "nan",
    "inf",
    "1000000",
    "3.0",
    "1.0000001",
];
const LISTS: [&str; 5] = ["[]", "[1, 0]", "[0.01, 1.0, 3.0]", "[1, 1, 1]", "[3, 2, 1]"];
const WORDS_OF_JOBS: [&str; 4] = ["\"matrix\"", "\"paper\"", "\"nearest\"", "true"];

/// One entry of the template under its heading, with its own value or another.
fn entry(draws: &mut Draws) -> [String; 2] {
    let mut heading = String::new();
    let mut all = Vec::new();
    for line in TEMPLATE.lines() {
        let line = line.trim_start_matches("# ");
        match line.split_once(" = ") {
            Some((name, value)) if !name.contains(' ') => {
                let value = value.split(" #").next().unwrap_or("").trim();
                all.push([heading.clone(), name.to_owned(), value.to_owned()]);
            }
            _ if line.starts_with('[') => {
                heading = line.split("  ").next().unwrap_or("").to_owned()
            }
            _ => {}
        }
    }
    let [heading, name, value] = &all[draws.below(all.len())];
    let others = match value.chars().next() {
        Some('[') => &LISTS[..],
        Some(first) if first.is_ascii_digit() => &NUMBERS,
        _ => &WORDS_OF_JOBS,
    };
    let value = if draws.unit() < 0.5 {
        value
    } else {
        others[draws.below(others.len())]
    };
    [heading.clone(), format!("{name} = {value}")]
}

/// The job with an entry more, or with damage in one of its files, most often another digit.
fn mutated(files: &Files, draws: &mut Draws) -> Vec<(String, Vec<u8>)> {
    let mut files = files.clone();
    if draws.unit() < 0.6 {
        let text = file(&mut files, "job.toml");
        for _ in 0..1 + draws.below(2) {
            let [heading, line] = entry(draws);
            let name = line.split(" = ").next();
            let kept = text
                .lines()
                .filter(|own| own.split(" = ").next() != name || draws.unit() < 0.1);
            let mut kept = kept.collect_vec().join("\n") + "\n";
            match kept.find(&format!("{heading}\n")) {
                _ if heading.is_empty() => kept.insert_str(0, &format!("{line}\n")),
                Some(at) => kept.insert_str(at + heading.len() + 1, &format!("{line}\n")),
                None => kept += &format!("{heading}\n{line}\n"),
            }
            *text = kept;
        }
    }
    let is_whole = draws.unit() < 0.6;
    let at = draws.below(files.len());
    let files = files.into_iter().enumerate().map(|(place, (name, text))| {
        let mut bytes = text.into_bytes();
        if place == at && !is_whole {
            let digits = (0..bytes.len())
                .filter(|at| bytes[*at].is_ascii_digit())
                .collect_vec();
            match digits.get(draws.below(2 * digits.len())) {
                Some(at) => bytes[*at] = b'0' + draws.below(10) as u8,
                None => bytes = draws.damaged(&bytes),
            }
        }
        (name, bytes)
    });
    files.collect()
}

/// Everything that `check` and `correlate` print of a job, which a request stops after some analyses.
fn corrected(path: &Path) -> Result<bool, PresentError> {
    let job = prepare(path)?;
    let tables = check_tables(&job, &Trust::before(&job)?)?;
    let left = Cell::new(12);
    let go_on = || left.replace(left.get() - 1) > 1;
    let result = run(&job, |_| {}, go_on)?;
    let report = Report::new(&result, "corfem")?;
    let texts = [
        render::text(&tables),
        report.csv(),
        render::text(&report.brief()),
    ];
    assert!(texts.iter().all(|text| !text.is_empty()));
    json::document(json::OWN_UNITS, &report)?;
    report_page(&report)?;
    let factors = &result.found.factors;
    job.loaded.corrected_model(factors)?;
    Ok(factors
        .iter()
        .all(|factor| factor.is_finite() && *factor > 0.0))
}

#[test]
fn no_job_panics_whatever_stands_in_it() {
    let calls = asked_calls(500);
    let jobs = [rods(), building(), measured_building(6, 3)];
    let (mut refused, mut faults) = (0, Vec::new());
    for seed in 0..calls {
        let mut draws = Draws(seed);
        let job = draws.below(jobs.len());
        let (folder, path) = placed(&Vec::new());
        for (name, bytes) in mutated(&jobs[job], &mut draws) {
            fs::write(folder.path().join(name), bytes).unwrap();
        }
        match catch_unwind(AssertUnwindSafe(|| corrected(&path))) {
            Ok(Ok(is_finite)) => assert!(is_finite, "seed {seed}"),
            Ok(Err(error)) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
            Err(_) => faults.push(seed),
        }
    }
    println!("{calls} jobs, {refused} refused");
    assert!(faults.is_empty(), "seeds {faults:?}");
    assert!(
        refused > calls / 5 && refused < calls * 9 / 10,
        "{refused} of {calls}"
    );
}
