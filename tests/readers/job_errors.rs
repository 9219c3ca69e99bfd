//! Mistakes in jobs: every one is named with what was expected and what was found.

use crate::common::jobs::{Files, building, rods};
use crate::common::tolerances::{ROUND_OFF, WEIGHTED_FACTOR};
use corfem::job::{Prepared, run};
use corfem::method::outer_loop::Settings;
use std::path::PathBuf;
use tempfile::TempDir;

/// A job in a folder of its own.
pub fn placed(files: &Files) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    files
        .iter()
        .for_each(|(name, text)| std::fs::write(folder.path().join(name), text).expect("written"));
    let path = folder.path().join("job.toml");
    (folder, path)
}

/// The files with one text replaced by another in one of them.
pub fn with(mut files: Files, file: &str, old: &str, new: &str) -> Files {
    let text = &mut files
        .iter_mut()
        .find(|(name, _)| name == file)
        .expect("a file")
        .1;
    assert!(text.contains(old), "{old} is not in {text}");
    *text = text.replacen(old, new, 1);
    files
}

/// What is said of a job, without its folder.
pub fn said(files: &Files) -> String {
    let (folder, path) = placed(files);
    let error = Prepared::new(&path)
        .and_then(|prepared| run(&prepared, |_| {}, || true))
        .map(drop);
    let error = error.expect_err("a mistake").to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

/// Mistakes in the small job: what is replaced by what, and what is then said.
fn check(mistakes: &[(&str, &str, &str)]) {
    for (old, new, expected) in mistakes {
        let error = said(&with(rods(), "job.toml", old, new));
        assert!(error.contains(expected), "{new}: {error}");
    }
}

const A: &str = "elements = [1]";
const SENSORS: &str = "[sensors]";
const COMPARE: &str = "[compare]";

#[test]
fn the_small_jobs_are_right_before_their_mistakes() {
    for files in [rods(), building()] {
        let (_folder, path) = placed(&files);
        Prepared::new(&path).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn a_job_names_its_model_once_and_whole() {
    const DECK: &str = "deck = \"model.bdf\"";
    let what = "job.toml: expected either model.deck, or model.stiffness and model.mass, found";
    for (model, found) in [
        ("", "neither"),
        (
            "deck = \"model.bdf\"\nstiffness = \"k.mtx\"",
            "a deck and matrices",
        ),
        (
            "deck = \"model.bdf\"\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"",
            "a deck and matrices",
        ),
        ("stiffness = \"k.mtx\"", "one matrix alone"),
        ("mass = \"m.mtx\"", "one matrix alone"),
    ] {
        assert_eq!(
            said(&with(rods(), "job.toml", DECK, model)),
            format!("{what} {found}")
        );
    }
    check(&[
        (
            "model.bdf",
            "no.bdf",
            "no.bdf (model.deck in job.toml): no such file",
        ),
        (
            "test.csv",
            "no.csv",
            "no.csv (test.file in job.toml): no such file",
        ),
        ("[model]", "[model]\ndek = 1", "unknown field `dek`"),
        ("[model]", "[model", "job.toml: TOML parse error at line 1"),
        ("gauss_newton", "newton", "unknown variant `newton`"),
    ]);
    let mut none = rods();
    none[0].1 = none[0]
        .1
        .split("[[parameter]]")
        .next()
        .expect("a beginning")
        .to_owned();
    assert_eq!(
        said(&none),
        "job.toml: expected at least one [[parameter]], found none"
    );
    let (folder, path) = placed(&rods());
    std::fs::remove_file(&path).expect("removed");
    let missing = Prepared::new(&path)
        .map(drop)
        .expect_err("no job")
        .to_string();
    assert!(
        missing.starts_with(&format!(
            "cannot read {}/job.toml: no such file",
            folder.path().display()
        )),
        "{missing}"
    );
}

#[test]
fn a_parameter_names_what_the_deck_has() {
    check(&[
        (
            A,
            "elements = [\"9-3\"]",
            "job.toml: expected a range of numbers such as \"10-19\", in all at most 10000000, found",
        ),
        (
            A,
            "elements = [\"1-x\"]",
            "expected a range of numbers such as \"10-19\", in all at most 10000000, found 1-x",
        ),
        (
            A,
            "elements = [\"2-10000002\"]",
            "in all at most 10000000, found 2-10000002",
        ),
        (
            A,
            "elements = [3, \"1-10000000\"]",
            "in all at most 10000000, found 1-10000000",
        ),
        (
            A,
            "elements = [\"9999990-9999999\"]",
            "parameter \"a\": the deck has no element 9999990",
        ),
        (
            A,
            "elements = [1, 9]",
            "parameter \"a\": the deck has no element 9",
        ),
        (
            A,
            "properties = [1, 7]",
            "expected properties and materials of the deck's elements in parameter a, found 7",
        ),
        (
            A,
            "materials = [8]",
            "expected properties and materials of the deck's elements in parameter a, found 8",
        ),
        (
            A,
            "",
            "expected elements or masses in parameter a, found none that the deck has",
        ),
        (
            A,
            "matrix = \"k.mtx\"",
            "expected parameters of a deck by elements or masses, found a matrix",
        ),
        (
            A,
            "masses = [12]",
            "expected scales = \"mass\" for point masses, found stiffness in parameter a",
        ),
        (
            A,
            "masses = [12, 19]\nscales = \"mass\"",
            "parameter \"a\": the deck has no point mass 19",
        ),
        (
            A,
            "elements = [1]\nlower = 0.5",
            "expected both lower and upper in parameter a, found one of them",
        ),
        (
            A,
            "elements = [1]\nlower_size = 0.5",
            "expected both lower_size and upper_size in parameter a, found one of them",
        ),
        (
            A,
            "elements = [1]\nlower_size = 0.2\nupper_size = 0.3",
            "a: bounds 2 to ",
        ),
        (
            A,
            "elements = [1]\nscales = \"mass\"\nlower_size = 0.05\nupper_size = 0.3",
            "expected the stiffness of a deck's elements where parameter a has bounds on sizes, found another",
        ),
        (
            A,
            "elements = [1]\nlower = 1.5\nupper = 2.0",
            "a: bounds 1.5 to 2 exclude the starting factor 1",
        ),
        (
            A,
            "elements = [1]\nlower = 2.0\nupper = 0.5",
            "is no range; the lower limit must be positive",
        ),
        (
            A,
            "elements = [\"1-2\"]",
            "element 2 is in two parameters, a and b; it may be in one",
        ),
        (
            "\"b\"",
            "\"a\"",
            "job.toml: expected every name of a parameter once, found a again",
        ),
    ]);
}

/// The narrower of the bounds on the factor and of those on the size of every element holds.
#[test]
fn bounds_on_sizes_are_bounds_on_the_factor() {
    let deck = with(rods(), "model.bdf", "PROD,2,2,.1", "PROD,2,2,.2");
    let rule = "elements = [1, 2]\nlower = 0.5\nupper = 1.9\nlower_size = 0.06\nupper_size = 0.3";
    let files = with(
        with(deck, "job.toml", A, rule),
        "job.toml",
        "elements = [\"2-3\"]",
        "elements = [3]",
    );
    let (_folder, path) = placed(&files);
    let range = Prepared::new(&path)
        .unwrap_or_else(|error| panic!("{error}"))
        .source
        .whole
        .ranges()[0]
        .expect("a range");
    // Of areas 0.1 and 0.2: at least 0.06/0.1, at most 0.3/0.2.
    assert!(
        (range.lower - 0.6).abs() < ROUND_OFF && (range.upper - 1.5).abs() < ROUND_OFF,
        "{range:?}"
    );
    let narrow = with(files, "job.toml", "lower_size = 0.06", "lower_size = 0.01");
    let (_folder, path) = placed(&narrow);
    let range = Prepared::new(&path).expect("a job").source.whole.ranges()[0].expect("a range");
    assert_eq!(range.lower, 0.5);
}

#[test]
fn properties_materials_masses_and_each_say_what_they_scale() {
    let members = |old: &str, new: &str| {
        let (_folder, path) = placed(&with(rods(), "job.toml", old, new));
        let source = Prepared::new(&path)
            .unwrap_or_else(|error| panic!("{new}: {error}"))
            .source;
        let names: Vec<String> = source
            .whole
            .parameters()
            .iter()
            .map(|parameter| parameter.name.clone())
            .collect();
        (names, source.members.clone())
    };
    let names = |names: &[&str]| {
        names
            .iter()
            .map(|name| (*name).to_owned())
            .collect::<Vec<_>>()
    };
    let b = "elements = [\"2-3\"]";
    for by in [
        "properties = [2]",
        "materials = [2]",
        "properties = [2]\nmaterials = [2]\nelements = [3, 2]",
    ] {
        assert_eq!(
            members(b, by),
            (names(&["a", "b"]), vec![vec![1], vec![2, 3]]),
            "{by}"
        );
    }
    let each = members(b, "properties = [2]\neach = true");
    assert_eq!(
        each,
        (names(&["a", "b 2", "b 3"]), vec![vec![1], vec![2], vec![3]])
    );
    let masses = members(b, "masses = [\"13-14\"]\nscales = \"mass\"\neach = true");
    assert_eq!(
        masses,
        (
            names(&["a", "b mass 13", "b mass 14"]),
            vec![vec![1], vec![], vec![]]
        )
    );
}

/// A mass that is named twice counts once, and a deck cannot say what factors of point masses say.
#[test]
fn point_masses_count_once_and_have_no_corrected_deck() {
    let masses = |list: &str| {
        let rule = format!("elements = [1]\nmasses = {list}\nscales = \"mass\"");
        let (folder, path) = placed(&with(rods(), "job.toml", A, &rule));
        (
            folder,
            Prepared::new(&path).unwrap_or_else(|error| panic!("{error}")),
        )
    };
    let (once, twice) = (masses("[12]").1, masses("[12, \"12-12\", 12]").1);
    assert_eq!(once.source.whole, twice.source.whole);
    assert!(once.corrected_deck(&[1.0, 1.2]).expect("a deck").is_some());
    let refused = once
        .corrected_deck(&[1.1, 1.0])
        .expect_err("a factor of point masses")
        .to_string();
    assert!(
        refused.contains("a is one of point masses, found a factor of 1.1"),
        "{refused}"
    );
}

#[test]
fn sensors_are_those_of_the_test_at_what_moves() {
    let place = |sensor: &str, grid: usize, direction: &str| {
        format!(
            "[sensors]\nplace = [{{ sensor = \"{sensor}\", grid = {grid}, direction = \"{direction}\" }}]"
        )
    };
    let distant = "[sensors]\nby = \"nearest\"\ndistance = 0.5";
    check(&[
        (
            SENSORS,
            "[sensors]\nleave_out = [\"S9\"]",
            "expected names of sensors that the test has, found S9",
        ),
        (
            SENSORS,
            &place("S9", 2, "x"),
            "expected names of sensors that the test has, found S9",
        ),
        (
            SENSORS,
            &place("S2", 1, "x"),
            "sensor S2: the model has no free degree of freedom at grid 1, direction x",
        ),
        (
            SENSORS,
            &place("S2", 2, "z"),
            "sensor S2: the model has no free degree of freedom at grid 2, direction z",
        ),
        (
            SENSORS,
            &place("S2", 77, "x"),
            "sensor S2: the model has no free degree of freedom at grid 77, direction x",
        ),
        (
            SENSORS,
            &place("S2", 2, "w"),
            "expected a direction x, y, z or -x, -y, -z of sensor S2, found w",
        ),
        (
            SENSORS,
            &place("S2", 3, "x"),
            "expected one sensor a degree of freedom, found S2 and S3 at grid 3 x",
        ),
        (
            SENSORS,
            "[sensors]\nby = \"name\"",
            "expected sensors of the test on the model, found none",
        ),
    ]);
    let far = with(
        with(rods(), "job.toml", SENSORS, distant),
        "test.csv",
        "+,10.0,",
        "+,11.0,",
    );
    assert_eq!(
        said(&far),
        "job.toml: expected sensor S2 within 0.5 of a grid, found grid 2 at 1.0000"
    );
    let nowhere = with(
        with(rods(), "job.toml", SENSORS, distant),
        "test.csv",
        "+,10.0,0.0,0.0",
        "+,,,",
    );
    let expected =
        "job.toml: expected a place of sensor S2 and of the model's grids, found none in the test";
    assert_eq!(said(&nowhere), expected);
    let rows = building().into_iter().map(|(name, text)| match &name[..] {
        "rows.csv" => (name, (1..=10).map(|row| format!("{row},x\n")).collect()),
        "job.toml" => (name, format!("{text}\n[sensors]\nby = \"nearest\"\n")),
        _ => (name, text),
    });
    let error = said(&rows.collect());
    assert!(error.ends_with("found none in the model"), "{error}");
    let unnamed = said(&with(rods(), "test.csv", "\n2,", "\n,"));
    assert!(
        unnamed.ends_with("expected a grid for sensor S2, found none in the test"),
        "{unnamed}"
    );
}

#[test]
fn test_modes_are_there_and_named_once() {
    const FILE: &str = "file = \"test.csv\"";
    let modes = |list: &str| format!("{FILE}\nmodes = {list}");
    check(&[
        (
            FILE,
            &modes("[4]"),
            "expected test.modes from 1 to 3, found 4",
        ),
        (
            FILE,
            &modes("[0]"),
            "expected test.modes from 1 to 3, found 0",
        ),
        (
            FILE,
            &modes("[2, 1, 2]"),
            "expected every mode of test.modes once, found 2 again",
        ),
        (FILE, &modes("[]"), "test modes: at least one is needed"),
        (COMPARE, "[compare]\nanalysis_modes = 0", "at least one"),
        (
            COMPARE,
            "[compare]\nanalysis_modes = 4",
            "but there are only",
        ),
        (
            COMPARE,
            "[compare]\nstarts = 0",
            "starts: at least one is needed",
        ),
        (
            "method = \"gauss_newton\"",
            "starts = 2",
            "expected one of compare.starts where the method is \"paper\", found 2",
        ),
    ]);
}

#[test]
fn an_entry_that_is_gone_is_named_with_what_happens_instead() {
    const FILE: &str = "file = \"test.csv\"";
    const INNER: &str = "[correlation.inner]\nstep = ";
    check(&[
        (
            FILE,
            "file = \"test.csv\"\northogonalize = true",
            "job.toml: test.orthogonalize is no longer an entry: test modes are compared as they were measured",
        ),
        (
            COMPARE,
            "[correlation.inner]\nhalvings = 3\n[compare]",
            "job.toml: correlation.inner.halvings is no longer an entry: a step that does not lower",
        ),
        (
            COMPARE,
            &format!("{INNER}\"steepest_descent\"\n[compare]"),
            "job.toml: correlation.inner.step: the step rule steepest_descent is gone; choose matrix, own, relative or gage",
        ),
        (
            COMPARE,
            &format!("{INNER}\"best\"\n[compare]"),
            "unknown variant `best`",
        ),
        (COMPARE, "[compare]\nflor = 0.1", "unknown field `flor`"),
    ]);
}

/// What a job leaves out of its settings is the library's, and what it gives is taken.
#[test]
fn a_job_sets_some_of_the_settings_and_the_others_are_the_librarys() {
    let settings = |job: &str| {
        let (_folder, path) = placed(&with(
            rods(),
            "job.toml",
            COMPARE,
            &format!("{job}\n[compare]"),
        ));
        corfem::job::read(&path).expect("a job").correlation
    };
    assert_eq!(settings(""), Settings::default());
    let mut expected = Settings {
        most_passes: 3,
        ..Settings::default()
    };
    assert_eq!(settings("[correlation]\nmost_passes = 3"), expected);
    expected.inner.tolerance = 0.5;
    let given = "[correlation]\nmost_passes = 3\n[correlation.inner]\ntolerance = 0.5";
    assert_eq!(settings(given), expected);
}

#[test]
fn a_test_mode_that_is_none_of_the_models_is_left_out_and_named() {
    // One sensor alone that moves is like none of the three.
    let mut files = rods();
    let text = &mut files[2].1;
    let more = [",999.0", ",mode 4", ",1.0", ",-1.0", ",1.0"];
    assert_eq!(text.lines().count(), more.len());
    *text = text
        .lines()
        .zip(more)
        .map(|(line, more)| format!("{line}{more}\n"))
        .collect();
    let (_folder, path) = placed(&files);
    let prepared = Prepared::new(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(prepared.modes, [0, 1, 2]);
    assert!(
        matches!(prepared.unpaired[..], [(3, assurance)] if assurance > 0.0 && assurance <= 1.0)
    );
}

#[test]
fn weights_are_one_a_test_mode_and_some_may_be_zero() {
    check(&[
        (
            COMPARE,
            "[compare]\nshape_weights = [1, 1]",
            "expected 3 shape_weights, one a test mode of the job, found 2",
        ),
        (
            COMPARE,
            "[compare]\nfrequency_weights = [1]",
            "expected 3 frequency_weights, one a test mode of the job",
        ),
        (
            COMPARE,
            "[compare]\nfrequency_weights = [1, -1, 1]",
            "it must be a finite number from zero up",
        ),
        (
            COMPARE,
            "[compare]\nshape_deviation = 0.0",
            "it must be a finite number from zero up",
        ),
        (
            COMPARE,
            "[compare]\nfrequency_weights = [0, 0, 0]\nshape_weights = [0, 0, 0]",
            "weight is 0; it must be a finite number from zero up, one of them positive",
        ),
    ]);
    let frequencies = with(
        rods(),
        "job.toml",
        COMPARE,
        "[compare]\nshape_weights = [0, 0, 0]",
    );
    let (_folder, path) = placed(&frequencies);
    let prepared = Prepared::new(&path).expect("a job");
    let finished = run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
    // Without shapes the frequencies come as close as two factors allow.
    let [first, last] =
        [&finished.first, &finished.last].map(|model| model.exact().errors.frequency);
    assert!(last < first, "{last} after {first}");
    assert!(
        prepared
            .weights()
            .expect("weights")
            .iter()
            .all(|weight| weight.shape == 0.0)
    );
}

/// By the paper's rule: ones change nothing, and what a mode of weight zero is measured as is in no error.
#[test]
fn the_papers_error_sum_takes_the_weights_of_a_job() {
    let paper = |weights: &str| with(rods(), "job.toml", "method = \"gauss_newton\"", weights);
    let ran = |files: &Files| {
        let (_folder, path) = placed(files);
        let prepared = Prepared::new(&path).unwrap_or_else(|error| panic!("{error}"));
        let finished = run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
        (finished.first.exact().errors, finished.factors)
    };
    let ones = ran(&paper("shape_weights = [1, 1, 1]"));
    assert_eq!(ones, ran(&paper("")));
    let weights = "frequency_weights = [1, 1, 0]\nshape_weights = [2, 1, 0]";
    let without = ran(&paper(weights));
    assert_ne!(without, ones);
    let (_, test) = &rods()[2];
    let third = test
        .lines()
        .find(|line| line.starts_with("frequency_hz"))
        .and_then(|line| line.rsplit(',').next());
    let frequency: f64 = third
        .and_then(|cell| cell.parse().ok())
        .expect("a frequency");
    let wrong = |weights: &str| {
        ran(&with(
            paper(weights),
            "test.csv",
            &format!(",{frequency:?}"),
            &format!(",{:?}", 1.02 * frequency),
        ))
    };
    assert_ne!(wrong("").0, ones.0);
    let (errors, factors) = wrong(weights);
    assert_eq!(errors, without.0);
    // The step measures changes of stiffness by all test modes: another way to the same place.
    assert!(
        factors
            .iter()
            .zip(&without.1)
            .all(|(a, b)| (a / b - 1.0).abs() < WEIGHTED_FACTOR),
        "{factors:?}"
    );
    let short = said(&paper("shape_weights = [1, 1]"));
    assert!(
        short.contains("expected 3 shape_weights, one a test mode of the job, found 2"),
        "{short}"
    );
    let none = said(&paper(
        "frequency_weights = [0, 0, 0]\nshape_weights = [0, 0, 0]",
    ));
    assert!(
        none.contains("weight is 0; it must be a finite number from zero up, one of them positive"),
        "{none}"
    );
}
