//! Mistakes in jobs: every one is named with its entry, its value and what would be right.

use crate::common::cases::hold;
use crate::common::jobs::run;
use crate::common::jobs::said;
use crate::prelude::*;
use corfem::job::LeftOut;
use corfem::present::report::facts;
use std::sync::Arc;

const COMPARE: &str = "[compare]";

/// The files of a job one behind the other.
fn joined(files: &Files) -> String {
    files
        .iter()
        .map(|(name, text)| format!("=== {name}\n{text}"))
        .collect()
}

/// What is said of a job, or some of what is known of it before the first step.
fn of_job(text: &str, _: &[String]) -> Result<Value, String> {
    let files = text.split("=== ").skip(1);
    let files = files.map(|file| file.split_once('\n').unwrap());
    let files = files.map(|(name, text)| (name.to_owned(), text.to_owned()));
    let (folder, path) = placed(&files.collect());
    let known = prepare(&path).and_then(|job| {
        let trust = Trust::before(&job)?;
        run(&job, |_| {}, || true)?;
        let mass = facts(&job)?.into_iter();
        let mass = mass.filter(|own| own.fact.starts_with("mass"));
        let mass: String = mass.map(|own| own.value).collect();
        Ok(json!({
            "motions": job.loaded.source.motions.len(),
            "mass": mass,
            "unused": about(&trust, "not-used"),
        }))
    });
    known.map_err(|error| {
        error
            .to_string()
            .replace(&format!("{}/", folder.path().display()), "")
    })
}

fn hold_jobs(list: &str) {
    hold(
        list,
        &[("rods", joined(&rods())), ("building", joined(&building()))],
        ROUND_OFF,
        of_job,
    );
}

#[test]
fn jobs_are_refused_or_remarked_on_as_listed() {
    hold_jobs(include_str!("files/jobs.toml"));
}

#[test]
fn sensors_are_those_of_the_test_at_what_moves() {
    hold_jobs(include_str!("files/sensors.toml"));
}

#[test]
fn a_job_that_is_not_there_or_has_no_parameters_is_refused() {
    let mut none = rods();
    let end = none[0].1.find("[[parameter]]").unwrap();
    none[0].1.truncate(end);
    assert_eq!(
        said(&none),
        "job.toml: a job needs at least one [[parameter]]"
    );
    let (_folder, path) = placed(&rods());
    fs::remove_file(&path).unwrap();
    let missing = prepare(&path).map(drop).expect_err("no job").to_string();
    assert_eq!(
        missing,
        format!("cannot read {}: no such file", path.display())
    );
}

#[test]
fn properties_materials_masses_and_each_say_what_they_scale() {
    let members = |old: &str, new: &str| {
        let (_folder, path) = placed(&rods_with(old, new));
        let source = prepare(&path)
            .unwrap_or_else(|error| panic!("{new}: {error}"))
            .loaded
            .source
            .clone();
        let names = source
            .whole
            .parameters()
            .iter()
            .map(|parameter| parameter.name.clone())
            .collect_vec();
        let scaled = source.members.iter();
        let scaled = scaled.map(|own| [own.elements.clone(), own.masses.clone()]);
        (names, scaled.collect_vec())
    };
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect_vec();
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

/// There is nothing to correct in such a job, but its test and its model can be looked at.
#[test]
fn a_job_without_parameters_is_looked_at_and_not_run() {
    let mut files = rods();
    let job = &mut files[0].1;
    job.truncate(job.find("[[parameter]]").unwrap());
    let (_folder, path) = placed(&files);
    let loaded = prepare(&path).unwrap();
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
}

/// What a job leaves out of its settings is the library's, and what it gives is taken.
#[test]
fn a_job_sets_some_of_the_settings_and_the_others_are_the_librarys() {
    let settings = |job: &str| {
        let (_folder, path) = placed(&rods_with(COMPARE, &format!("{job}\n[compare]")));
        corfem::job::read(&path).unwrap().correlation
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
    let prepared = prepared(&files);
    assert_eq!(prepared.modes, [0, 1, 2]);
    assert!(
        matches!(prepared.unpaired[..], [LeftOut { mode: 3, assurance, .. }] if assurance > 0.0 && assurance <= 1.0)
    );
}

#[test]
fn shapes_of_weight_zero_count_for_nothing() {
    let frequencies = rods_with(COMPARE, "[compare]\nshape_weights = [0, 0, 0]");
    let prepared = prepared(&frequencies);
    let finished = finished(&prepared);
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
        rods_with("method = \"gauss_newton\"", &own)
    };
    let ran = |files: &Files| {
        let prepared = prepared(files);
        let finished = finished(&prepared);
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
    let frequency: f64 = third.and_then(|cell| cell.parse().ok()).unwrap();
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
            .all(|(a, b)| relative_error(a, b) < WEIGHTED_FACTOR),
        "{factors:?}"
    );
}

/// A node that one mode leaves out is no sensor of the test, which is said before the first step.
#[test]
fn a_sensor_left_out_for_a_mode_without_it_is_a_remark() {
    let mut prepared = prepared(&rods());
    let data = &mut Arc::make_mut(&mut prepared.loaded).data;
    data.incomplete = vec!["7 y".to_owned(), "9 z".to_owned()];
    let trust = trust_in(&prepared);
    let mut all = trust.all().iter();
    let found = all
        .find(|own| own.identifier == "not-in-every-mode")
        .unwrap();
    let words = "Sensors left out because some mode of the file has no value at them: 7 y, 9 z.";
    assert_eq!((found.stands(), &found.words[..]), (false, words));
}
