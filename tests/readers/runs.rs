//! Some sixty jobs and where they end: shipped ones, those of `tests/runs` that a reader's files once failed on, and structures built here.
//! `golden/runs.toml` has the ends; `CORFEM_WRITE=runs cargo test golden_runs` records them again.

use super::close_modes::towers;
use super::job_joins::{free_chain, mixed};
use super::job_pairs::net;
use super::job_parts::written;
use super::job_unseen::{chain, files};
use super::lone_frequencies::without_shapes;
use super::repeats::{exact, noisy, repeated};
use crate::common::answer::printed;
use crate::common::jobs::{files_of, free_masses, of_matrices, of_whole, tested, torque_box};
use crate::prelude::*;
use serde::Serialize;

/// The end of a run as it is stored.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Recorded {
    name: String,
    status: i32,
    doubts: Vec<String>,
    is_stationary: bool,
    chi_squared: f64,
    factors: Vec<f64>,
    /// Deviations of the factors, zero where the test tells none.
    deviations: Vec<f64>,
    /// Ends of the intervals, none where they are withheld.
    intervals: Vec<Vec<f64>>,
}

#[derive(Serialize, Deserialize)]
struct Golden {
    run: Vec<Recorded>,
}

impl Recorded {
    fn new(name: String, found: Answer) -> Self {
        assert!(!found.words.is_empty(), "{name}");
        assert!(found.status != 2 || found.frequencies.is_empty(), "{name}");
        let deviations = found.deviations.into_iter();
        let intervals = found.intervals.into_iter();
        Self {
            name,
            status: found.status,
            doubts: found.doubts,
            is_stationary: found.is_stationary,
            chi_squared: found.chi_squared,
            factors: found.factors,
            deviations: deviations.map(Option::unwrap_or_default).collect(),
            intervals: intervals
                .map(|own| own.map_or(Vec::new(), |ends| ends.to_vec()))
                .collect(),
        }
    }

    /// Everything that differs from a stored end.
    fn differences(&self, stored: &Self) -> Vec<String> {
        let mut all = Vec::new();
        if (self.status, &self.doubts) != (stored.status, &stored.doubts) {
            all.push("status or doubts".to_owned());
        }
        if !stored.is_stationary || !self.is_stationary {
            let both = [self.chi_squared, stored.chi_squared];
            let is_same = (both[0] - both[1]).abs() <= RUN_OBJECTIVE * both[1].max(1.0);
            if self.is_stationary != stored.is_stationary || !is_same {
                all.push("where it ends, or chi-squared".to_owned());
            }
            return all;
        }
        let count = stored.factors.len();
        for place in 0..count {
            // Where the test tells no deviation, the prior's of a logarithm is one.
            let told = stored.deviations[place];
            let unit = if told > 0.0 {
                told
            } else {
                stored.factors[place]
            };
            let is_near = |one: f64, other: f64| (one - other).abs() <= RUN_DEVIATIONS * unit;
            let ends = self.intervals[place].iter().zip(&stored.intervals[place]);
            if !is_near(self.factors[place], stored.factors[place]) {
                all.push(format!("factor {place}"));
            }
            if self.intervals[place].len() != stored.intervals[place].len()
                || ends.into_iter().any(|(one, other)| !is_near(*one, *other))
            {
                all.push(format!("interval {place}"));
            }
        }
        all
    }
}

/// Jobs of a folder below `tests`, each with its name.
fn in_folder(folder: &str) -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(in_root(folder)).unwrap();
    let paths = entries.flat_map(|entry| fs::read_dir(entry.unwrap().path()).unwrap());
    let paths = paths.map(|file| file.unwrap().path());
    let is_job = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml");
    let root = in_root("tests");
    let named = |path: PathBuf| {
        let name = path.with_extension("");
        let name = name.strip_prefix(&root).unwrap().display().to_string();
        (name.replace('\\', "/"), path)
    };
    paths.filter(is_job).map(named).collect()
}

/// Masses that move along x and y, with sensors along x.
fn plane() -> Files {
    let rows = 12;
    let row = |grid: usize, along: usize| 2 * grid + along;
    let mut all = Vec::new();
    for grid in 0..6_usize {
        for along in 0..2 {
            let other = grid.checked_sub(1).map(|grid| row(grid, along));
            all.push((row(grid, along), other, 1e5 * (1.0 + 0.7 * along as f64)));
        }
        if grid > 0 {
            all.push((row(grid, 0), Some(row(grid - 1, 1)), 2e4));
        }
    }
    let stiffness = springs(rows, &all).dense();
    let mass = eye(rows) * 3.0;
    let modes = solve(&stiffness, &mass, 5).unwrap();
    let mut files = of_matrices(&[stiffness], &mass, &modes);
    let lines = (1..=6).flat_map(|grid| ["x", "y"].map(|along| format!("{grid},{along}\n")));
    *file(&mut files, "rows.csv") = lines.collect();
    retested(files, |data| {
        data.shapes = data.shapes.select_rows(&[0, 2, 4, 6, 8, 10]);
        data.sensors.truncate(6);
        for (grid, sensor) in data.sensors.iter_mut().enumerate() {
            sensor.grid = Some(grid + 1);
        }
    })
}

/// Uniform masses in a ring, whose roots come in pairs, in four parts and a spring to the ground.
fn ring() -> Files {
    let spring = |at: usize, size: f64| springs(8, &[(at, Some((at + 1) % 8), size)]).dense();
    let part = |first: usize| spring(first, 4e4) + spring(first + 4, 4e4);
    let ground = springs(8, &[0, 1, 2, 3, 4, 5, 6, 7].map(|row| (row, None, 2e4))).dense();
    let parts = [0, 1, 2, 3]
        .map(part)
        .into_iter()
        .chain([ground])
        .collect_vec();
    let truth = [1.1, 0.8, 1.0, 1.2, 0.9];
    let real = parts.iter().zip(truth).map(|(part, own)| part * own);
    let mass = 2.0 * eye(8);
    let modes = solve(&real.sum(), &mass, 6).unwrap();
    of_matrices(&parts, &mass, &modes)
}

/// A building of three floors that is alike in x and y, a part a story.
fn alike() -> Files {
    let springs_of = |at: usize| {
        let below = at.checked_sub(1);
        [0, 3].map(|first| (first + at, below.map(|below| first + below), 1e5))
    };
    let parts = [0, 1, 2].map(|at| springs(6, &springs_of(at)).dense());
    let real = 1.1 * &parts[0] + 0.8 * &parts[1] + &parts[2];
    let modes = solve(&real, &(50.0 * eye(6)), 6).unwrap();
    of_matrices(&parts, &(50.0 * eye(6)), &modes)
}

/// Structures built here.
fn built() -> Vec<(String, Files)> {
    let mut all: Vec<(String, Files)> = Vec::new();
    let mut add = |name: &str, files: Files| all.push((format!("built/{name}"), files));
    let building_with = |seed: u64, edit: fn(&mut TestData)| {
        retested(building(), |data| {
            *data = noisy(data, seed);
            edit(data);
        })
    };
    for seed in 0..4 {
        add(
            &format!("noisy building {seed}"),
            building_with(seed, |_| {}),
        );
    }
    type Edit = fn(&mut TestData);
    let edits: [(&str, Edit); 6] = [
        ("reversed", |data| data.shapes.row_mut(2).neg_mut()),
        ("exchanged", |data| data.shapes.swap_rows(0, 3)),
        ("gain", |data| data.shapes.row_mut(3).scale_mut(3.0)),
        ("dead", |data| data.shapes.row_mut(4).fill(0.0)),
        ("in rad/s", |data| {
            data.frequencies_hz.iter_mut().for_each(|own| *own *= TAU)
        }),
        ("off", |data| data.frequencies_hz[2] *= 1.03),
    ];
    for (seed, (name, edit)) in (5..).zip(edits) {
        add(&format!("building {name}"), building_with(seed, edit));
    }
    for (name, entries) in [
        ("by the paper", "method = \"paper\""),
        ("from starts", "starts = 5"),
        ("with weights", "shape_weights = [1, 1, 0.5, 1, 0]"),
        (
            "by noise",
            "frequency_deviation = 0.001\nshape_deviation = 0.05",
        ),
    ] {
        add(&format!("building {name}"), comparing(building(), entries));
    }
    for (name, entry) in [
        ("held out", "hold_out = [4]"),
        ("chosen", "modes = [1, 2, 4]"),
    ] {
        let entry = format!("[test]\n{entry}");
        add(
            &format!("building {name}"),
            with(building(), "job.toml", "[test]", &entry),
        );
    }
    let tests = (0..3).map(|seed| noisy(&exact(), seed)).collect_vec();
    add("building repeated", repeated(&tests, "[1, 2, 3, 4, 5]"));
    for modes in [&[2, 4][..], &[5]] {
        add(
            &format!("building without shapes {modes:?}"),
            without_shapes(modes),
        );
    }
    add("rods", rods());
    let higher = retested(rods(), |data| data.frequencies_hz[2] *= 1.02);
    add("rods higher", higher);
    add(
        "rods by the paper",
        rods_with(
            "[[parameter]]",
            "[compare]\nmethod = \"paper\"\n[[parameter]]",
        ),
    );
    add(
        "box held out",
        with(torque_box(), "job.toml", "[test]", "[test]\nhold_out = [9]"),
    );
    for values in [[1.0, 1.014, 0.6], [1.002, 1.014, -0.4], [1.0, 1.2, 0.0]] {
        add(&format!("towers {values:?}"), towers(values));
    }
    for method in ["paper", "gauss_newton"] {
        add(&format!("oscillators by {method}"), mixed(method));
    }
    add("free chain", free_chain(None));
    add("free chain reversed", free_chain(Some(3)));
    add("plane", plane());
    add("free masses", free_masses());
    add("right building", tested(|_| {}));
    add(
        "right building twice",
        tested(|data| data.shapes.row_mut(4).scale_mut(2.0)),
    );
    add("ring", ring());
    for seed in 0..3 {
        let mut draws = Draws(seed);
        let own = chain(&mut draws);
        add(
            &format!("chain {seed}"),
            files(&own, &Default::default(), 0.0, &mut draws),
        );
    }
    for seed in 10..14 {
        let mut draws = Draws(seed);
        let (model, parts, _) = net(&mut draws, 5);
        let truth = parts.iter().map(|_| draws.between(0.6, 1.5)).collect_vec();
        let sensors = (0..parts[0].nrows()).step_by(2).collect_vec();
        add(
            &format!("net {seed}"),
            of_whole(&model, &truth, &sensors, 5, Noise::USUAL),
        );
    }
    all
}

#[test]
fn equal_roots_end_no_run_however_many_modes_are_taken() {
    for files in [alike(), ring(), towers([1.0, 1.014, 0.6])] {
        for (taken, shown) in (1..=6).flat_map(|taken| (1..=taken).map(move |own| (taken, own))) {
            let shown = format!("[test]\nmodes = {:?}", (1..=shown).collect_vec());
            let files = with(files.clone(), "job.toml", "[test]", &shown);
            let files = comparing(files, &format!("analysis_modes = {taken}"));
            let (_folder, path) = placed(&files);
            for command in ["check", "correlate"] {
                let output = printed(command, &path, "text");
                let words = String::from_utf8(output.stderr).unwrap();
                assert_ne!(output.status.code(), Some(2), "{command}, {taken}: {words}");
            }
        }
    }
}

/// The law: a look ends in status 3 exactly where a doubt stands, and what is unlike the first model stands against nothing yet.
#[test]
fn a_look_ends_in_3_exactly_where_a_doubt_stands() {
    for (name, path) in [in_folder("tests/jobs"), in_folder("tests/runs")].concat() {
        let output = printed("check", &path, "json");
        let Ok(found) = serde_json::from_slice::<Value>(&output.stdout) else {
            assert_eq!(output.status.code(), Some(2), "{name}");
            continue;
        };
        let has = |grade| {
            let mut all = found["concerns"].as_array().unwrap().iter();
            all.any(|own| own["grade"] == grade)
        };
        let status = if has("doubt") { 3 } else { 0 };
        assert_eq!(output.status.code(), Some(status), "{name}");
        assert!(!has("left out"), "{name}");
    }
}

#[test]
fn golden_runs_end_where_they_ended() {
    let stored = [in_folder("tests/jobs"), in_folder("tests/runs")].concat();
    let mut found = stored
        .into_iter()
        .map(|(name, path)| Recorded::new(name, answer(&path)))
        .collect_vec();
    for (name, files) in built() {
        found.push(Recorded::new(name, answered(&files)));
    }
    found.sort_by(|one, other| one.name.cmp(&other.name));
    let path = in_root("golden/runs.toml");
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "runs") {
        let golden = toml::to_string(&Golden { run: found }).unwrap();
        return fs::write(path, golden).unwrap();
    }
    let Golden { run: stored } = toml::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let names = |runs: &[Recorded]| runs.iter().map(|run| run.name.clone()).collect_vec();
    assert_eq!(names(&found), names(&stored));
    let differences = found.iter().zip(&stored).filter_map(|(found, stored)| {
        let all = found.differences(stored);
        (!all.is_empty())
            .then(|| format!("{}: {}\n{found:?}\n{stored:?}", stored.name, all.join(", ")))
    });
    let differences = differences.collect_vec();
    assert!(
        differences.is_empty(),
        "{} runs:\n{}",
        differences.len(),
        differences.join("\n")
    );
}

/// Mode 2 is off by eleven of its deviations, and ten digits of the stiffness move it by a seventh of one: chi-squared by some three.
#[test]
fn the_airplane_ends_alike_from_ten_digits() {
    let end = |files: &Files| finished(&prepared(files));
    let whole = end(&files_of("garteur"));
    for digits in [10, 12] {
        let files = written(&files_of("garteur"), digits, ("", 1.0));
        let found = end(&files);
        assert_within(found.misfit.chi_squared, whole.misfit.chi_squared, 3.0);
        // Tailplane and joint are hardly seen.
        for e in [0, 1, 2, 3, 4, 7] {
            assert_within(found.found.factors[e] / whole.found.factors[e], 1.0, 0.02);
        }
    }
}
