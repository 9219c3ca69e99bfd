//! Mistakes in jobs: every one is named with its entry, its value and what would be right.

use crate::common::jobs::run;
use crate::common::jobs::said;
use crate::prelude::*;
use corfem::job::{LeftOut, Study, Vary};
use std::sync::Arc;

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
        prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn a_job_names_its_model_once_and_whole() {
    const DECK: &str = "deck = \"model.bdf\"";
    let what = "job.toml: [model] must name either a deck, or both stiffness and mass";
    for model in [
        "",
        "deck = \"model.bdf\"\nstiffness = \"k.mtx\"",
        "deck = \"model.bdf\"\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"",
        "stiffness = \"k.mtx\"",
        "mass = \"m.mtx\"",
    ] {
        assert_eq!(said(&with(rods(), "job.toml", DECK, model)), what);
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
        "job.toml: a job needs at least one [[parameter]]"
    );
    let (folder, path) = placed(&rods());
    std::fs::remove_file(&path).expect("removed");
    let missing = prepare(&path).map(drop).expect_err("no job").to_string();
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
            "job.toml: \"9-3\" is not a range of numbers such as \"10-19\"",
        ),
        (
            A,
            "elements = [\"1-x\"]",
            "\"1-x\" is not a range of numbers such as \"10-19\"",
        ),
        (
            A,
            "elements = [\"2-10000002\"]",
            "all of them together may be at most 10000000",
        ),
        (
            A,
            "elements = [3, \"1-10000000\"]",
            "\"1-10000000\" is not a range",
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
            "parameter \"a\": no element of the deck has property or material 7",
        ),
        (
            A,
            "materials = [8]",
            "parameter \"a\": no element of the deck has property or material 8",
        ),
        (A, "", "parameter \"a\" names no elements and no masses"),
        (
            A,
            "matrix = \"k.mtx\"",
            "parameter \"a\": in a deck, name elements or masses instead of a matrix",
        ),
        (
            A,
            "masses = [12]",
            "parameter \"a\": point mass 12 needs scales = \"mass\"",
        ),
        (
            A,
            "masses = [12, 19]\nscales = \"mass\"",
            "parameter \"a\": the deck has no point mass 19",
        ),
        (
            A,
            "elements = [1]\nlower = 0.5",
            "parameter \"a\" needs both lower and upper, or neither",
        ),
        (
            A,
            "elements = [1]\nprior_deviation = 0.0",
            "parameter \"a\": prior_deviation is 0; it must be positive and finite",
        ),
        (
            COMPARE,
            "[compare]\nprior_deviation = inf",
            "parameter \"a\": prior_deviation is inf; it must be positive and finite",
        ),
        (
            A,
            "elements = [1]\nlower_size = 0.5",
            "parameter \"a\" needs both lower_size and upper_size, or neither",
        ),
        (
            A,
            "elements = [1]\nlower_size = 0.2\nupper_size = 0.3",
            "factor of parameter a: 2 to ",
        ),
        (
            A,
            "elements = [1]\nscales = \"mass\"\nlower_size = 0.05\nupper_size = 0.3",
            "parameter \"a\": bounds on sizes are for the stiffness of a deck's elements",
        ),
        (
            A,
            "elements = [1]\nlower = 1.5\nupper = 2.0",
            "factor of parameter a: 1.5 to 2 exclude the starting factor 1",
        ),
        (
            A,
            "elements = [1]\nlower = 2.0\nupper = 0.5",
            "is no range; the lower limit must be positive",
        ),
        (
            A,
            "elements = [\"1-2\"]",
            "parameters a and b: element 2 is given twice",
        ),
        ("\"b\"", "\"a\"", "job.toml: parameter a is named twice"),
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
    let range = prepare(&path)
        .unwrap_or_else(|error| panic!("{error}"))
        .loaded
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
    let range = prepare(&path).expect("a job").loaded.source.whole.ranges()[0].expect("a range");
    assert_eq!(range.lower, 0.5);
}

#[test]
fn properties_materials_masses_and_each_say_what_they_scale() {
    let members = |old: &str, new: &str| {
        let (_folder, path) = placed(&with(rods(), "job.toml", old, new));
        let source = prepare(&path)
            .unwrap_or_else(|error| panic!("{new}: {error}"))
            .loaded
            .source
            .clone();
        let names: Vec<String> = source
            .whole
            .parameters()
            .iter()
            .map(|parameter| parameter.name.clone())
            .collect();
        let scaled = source.members.iter();
        let scaled = scaled.map(|own| [own.elements.clone(), own.masses.clone()]);
        (names, scaled.collect::<Vec<_>>())
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
            (
                names(&["a", "b"]),
                vec![[vec![1], vec![]], [vec![2, 3], vec![]]]
            ),
            "{by}"
        );
    }
    let each = members(b, "properties = [2]\neach = true");
    assert_eq!(
        each,
        (
            names(&["a", "b 2", "b 3"]),
            [1, 2, 3].map(|label| [vec![label], vec![]]).to_vec()
        )
    );
    let masses = members(b, "masses = [\"13-14\"]\nscales = \"mass\"\neach = true");
    assert_eq!(
        masses,
        (
            names(&["a", "b mass 13", "b mass 14"]),
            vec![[vec![1], vec![]], [vec![], vec![13]], [vec![], vec![14]]]
        )
    );
}

/// A mass that is named twice counts once.
#[test]
fn point_masses_count_once_and_are_in_the_corrected_deck() {
    let masses = |list: &str, deck: &str| {
        let rule = format!("elements = [1]\nmasses = {list}\nscales = \"mass\"");
        let files = with(
            with(rods(), "job.toml", A, &rule),
            "model.bdf",
            "CMASS2,12,1.,2,1",
            deck,
        );
        let (_folder, path) = placed(&files);
        prepare(&path).unwrap_or_else(|error| panic!("{error}"))
    };
    let given = "CMASS2,12,1.,2,1";
    let (once, twice) = (masses("[12]", given), masses("[12, \"12-12\", 12]", given));
    let heavier = |job: &PreparedJob| {
        job.loaded
            .source
            .whole
            .at(&[1.0, 1.25])
            .expect("its matrices")
    };
    assert_eq!(heavier(&once), heavier(&twice));
    for (deck, corrected) in [
        (given, "CMASS2,12,1.25,2,1"),
        (
            "CMASS2  12      1.      2       1",
            "CMASS2  12      1.25    2       1",
        ),
        ("CONM2,12,2,,1.", "CONM2,12,2,,1.25"),
        (
            "PARAM,WTMASS,.5\nCMASS2,12,2.,2,1",
            "PARAM,WTMASS,.5\nCMASS2,12,2.5,2,1",
        ),
    ] {
        let job = masses("[12]", deck);
        let first = &job.loaded.source.deck.as_ref().expect("a deck").0;
        let text = job
            .loaded
            .corrected_deck(&[1.25, 1.0])
            .expect("it rewrites")
            .expect("a deck");
        let expected = String::from_utf8_lossy(first).replace(deck, corrected);
        assert_eq!(String::from_utf8_lossy(&text), expected);
    }
}

/// There is nothing to correct in such a job, but its test and its model can be looked at.
#[test]
fn a_job_without_parameters_is_looked_at_and_not_run() {
    let mut files = rods();
    let job = &mut files[0].1;
    job.truncate(job.find("[[parameter]]").expect("parameters"));
    let (_folder, path) = placed(&files);
    let loaded = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        (loaded.test.len(), loaded.loaded.parameter_names().count()),
        (3, 0)
    );
    let none = "a job needs at least one [[parameter]]";
    let refused = run(&loaded, |_| {}, || true)
        .map(drop)
        .expect_err(none)
        .to_string();
    assert!(refused.ends_with(none), "{refused}");
    let refused = Study::new(&path, 1, &[Vary::Noise], &[])
        .map(drop)
        .expect_err(none)
        .to_string();
    assert!(refused.ends_with(none), "{refused}");
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
            "sensors: the test has no sensor S9",
        ),
        (
            SENSORS,
            &place("S9", 2, "x"),
            "sensors: the test has no sensor S9",
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
            "sensor S2: \"w\" is not a direction x, y, z",
        ),
        (
            SENSORS,
            &place("S2", 3, "x"),
            "sensors S2 and S3 are both at grid 3, direction x",
        ),
        (
            SENSORS,
            "[sensors]\nby = \"name\"",
            "no sensor of the test is on the model",
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
        "job.toml: sensor S2: grid 2 is 1.0000 away; sensors.distance allows 0.5"
    );
    let nowhere = with(
        with(rods(), "job.toml", SENSORS, distant),
        "test.csv",
        "+,10.0,0.0,0.0",
        "+,,,",
    );
    let expected = "job.toml: sensor S2 cannot be placed at the nearest grid: the test does not say where it is";
    assert_eq!(said(&nowhere), expected);
    let rows = building().into_iter().map(|(name, text)| match &name[..] {
        "rows.csv" => (name, (1..=10).map(|row| format!("{row},x\n")).collect()),
        "job.toml" => (name, format!("{text}\n[sensors]\nby = \"nearest\"\n")),
        _ => (name, text),
    });
    let error = said(&rows.collect());
    assert!(
        error.ends_with("no grid of the model that could move it has a place"),
        "{error}"
    );
    let unnamed = said(&with(rods(), "test.csv", "\n2,", "\n,"));
    assert!(
        unnamed.ends_with("sensor S2 has no grid in the test; place it in [sensors]"),
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
            "test.modes: there is no mode 4; the test has 1 to 3",
        ),
        (
            FILE,
            &modes("[0]"),
            "test.modes: there is no mode 0; the test has 1 to 3",
        ),
        (
            FILE,
            &modes("[2, 1, 2]"),
            "test.modes: mode 2 is named twice",
        ),
        (
            FILE,
            &modes("[]"),
            "test modes: 0 given or asked for; there must be at least 1",
        ),
        (
            COMPARE,
            "[compare]\nanalysis_modes = 0",
            "0 given or asked for; there must be 1 to",
        ),
        (
            COMPARE,
            "[compare]\nanalysis_modes = 4",
            "4 given or asked for; there must be 1 to 3",
        ),
        (
            COMPARE,
            "[compare]\nstarts = 0",
            "starts: 0 given or asked for; there must be at least 1",
        ),
        (
            "method = \"gauss_newton\"",
            "method = \"paper\"\nstarts = 2",
            "compare.starts is 2, but method \"paper\" has one start",
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
    let prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(prepared.modes, [0, 1, 2]);
    assert!(
        matches!(prepared.unpaired[..], [LeftOut { mode: 3, assurance, .. }] if assurance > 0.0 && assurance <= 1.0)
    );
}

#[test]
fn weights_are_one_a_test_mode_and_some_may_be_zero() {
    check(&[
        (
            COMPARE,
            "[compare]\nshape_weights = [1, 1]",
            "compare.shape_weights: 2 given for 3 test modes",
        ),
        (
            COMPARE,
            "[compare]\nfrequency_weights = [1]",
            "compare.frequency_weights: 1 given for 3 test modes",
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
            "weight of the test modes is 0; it must be a finite number from zero up, one of them positive",
        ),
    ]);
    let frequencies = with(
        rods(),
        "job.toml",
        COMPARE,
        "[compare]\nshape_weights = [0, 0, 0]",
    );
    let (_folder, path) = placed(&frequencies);
    let prepared = prepare(&path).expect("a job");
    let finished = run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
    // Without shapes the frequencies come as close as two factors allow.
    let [first, last] = [&finished.found.first, &finished.found.last]
        .map(|model| model.model().exact().errors.frequency);
    assert!(last < first, "{last} after {first}");
    assert!(prepared.weights().iter().all(|weight| weight.shape == 0.0));
}

/// By the paper's rule: ones change nothing, and what a mode of weight zero is measured as is in no error.
#[test]
fn the_papers_error_sum_takes_the_weights_of_a_job() {
    let paper = |weights: &str| {
        let own = format!("method = \"paper\"\n{weights}");
        with(rods(), "job.toml", "method = \"gauss_newton\"", &own)
    };
    let ran = |files: &Files| {
        let (_folder, path) = placed(files);
        let prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
        let finished = run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
        (
            finished.found.first.model().exact().errors,
            finished.found.factors,
        )
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
        short.contains("compare.shape_weights: 2 given for 3 test modes"),
        "{short}"
    );
    let none = said(&paper(
        "frequency_weights = [0, 0, 0]\nshape_weights = [0, 0, 0]",
    ));
    assert!(
        none.contains("weight of the test modes is 0; it must be a finite number from zero up"),
        "{none}"
    );
}

/// Of the cards that are not read only loads and the like go without a word: they are no part of any model.
#[test]
fn what_a_deck_has_and_its_model_has_not_is_a_remark() {
    let remarks = |files: &Files| {
        let (_folder, path) = placed(files);
        let loaded = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
        Trust::before(&loaded)
            .expect("an account")
            .about(Kind::NotUsed)
    };
    let loads = with(rods(), "model.bdf", "MAT1,1,", "FORCE,9,4,,1.,1.\nMAT1,1,");
    assert_eq!(remarks(&loads), [""; 0]);
    let torsion = with(loads, "model.bdf", "PROD,1,1,.1", "PROD,1,1,.1,.5");
    let ignored = with(torsion, "model.bdf", "MAT1,1,", "CBAR,9,1,2,3\nMAT1,1,");
    let ignored = with(
        ignored,
        "job.toml",
        "deck = ",
        "ignore = [\"CBAR\"]\ndeck = ",
    );
    assert_eq!(
        remarks(&ignored),
        ["PROD J (line 8, 1 card)", "CBAR (line 11, 1 card)"]
    );
}

/// A node that one mode leaves out is no sensor of the test, which is said before the first step.
#[test]
fn a_sensor_left_out_for_a_mode_without_it_is_a_remark() {
    let (_folder, path) = placed(&rods());
    let mut prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let data = &mut Arc::make_mut(&mut prepared.loaded).data;
    data.incomplete = vec!["7 y".to_owned(), "9 z".to_owned()];
    let trust = Trust::before(&prepared).expect("concerns");
    let found = trust.of(Kind::NotInEveryMode).next().expect("said");
    let words = "Sensors left out because some mode of the file has no value at them: 7 y, 9 z.";
    assert_eq!((found.stands(), &found.words()[..]), (false, words));
}
