//! `corfem init` from outside: a job and a test that explain themselves, and that the readers take.

use crate::common::jobs::folder_of;
use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text};
use crate::presentation::program::cli_jobs::{Reported, reported, words};
use corfem::job::{Job, read};

#[test]
fn init_writes_a_job_that_reads_and_nothing_over_another() {
    let folder = new_folder();
    let path = folder.path().join("job.toml");
    assert_eq!(corfem(&["init", words(&path)]).status.code(), Some(0));
    let written = fs::read(&path).expect("it reads");
    assert_eq!(written, corfem(&["init"]).stdout);
    let refused = corfem(&["init", words(&path)]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        text(&refused.stderr).contains("job.toml: it is there already"),
        "{}",
        text(&refused.stderr)
    );
    assert_eq!(fs::read(&path).expect("it reads"), written);
    let job = read(&path).unwrap();
    assert_eq!(job.title.as_deref(), Some("my structure"));
    // Every example and default is one that the reader takes, but for those of a model of matrices.
    let examples = String::from_utf8(written.clone()).expect("UTF-8");
    let examples: String = examples
        .lines()
        .skip_while(|line| !line.starts_with("title"))
        .fold(String::new(), |all, line| {
            let entry = line
                .strip_prefix("# ")
                .filter(|entry| entry.split(' ').nth(1) == Some("="));
            all + entry.unwrap_or(line) + "\n"
        });
    toml::from_str::<Job>(&examples).unwrap();
    // Pointed to files that exist, it is a job that can be looked at.
    let wing = |file: &str| words(&folder_of("wing").join(file)).to_owned();
    let text = String::from_utf8(written).expect("UTF-8");
    let text = text.replace("\"model.bdf\"", &format!("{:?}", wing("model.bdf")));
    let text = text.replace("\"test.unv\"", &format!("{:?}", wing("test.unv")));
    let text = text.replace("# by = \"grid\"", "by = \"nearest\"");
    fs::write(&path, text).expect("written");
    prepare(&path).unwrap();
}

/// The names of a struct's fields, as the reader itself lists them when it finds another.
fn entries(table: &str) -> Vec<String> {
    let base = "[model]\n[test]\nfile = \"t\"\n";
    let text = match table {
        "" => format!("stranger = 1\n{base}"),
        "model" => "[model]\nstranger = 1\n[test]\nfile = \"t\"\n".to_owned(),
        "test" => format!("{base}stranger = 1\n"),
        table => format!("{base}{table}\nstranger = 1\n"),
    };
    let error = toml::from_str::<Job>(&text)
        .expect_err("a stranger")
        .to_string();
    let list = error
        .split("expected ")
        .nth(1)
        .unwrap_or_else(|| panic!("{table}: {error}"));
    list.split('`')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

#[test]
fn init_explains_every_entry_that_a_job_may_have() {
    let template = text(&corfem(&["init"]).stdout);
    let tables = [
        "",
        "model",
        "test",
        "[sensors]",
        "[[parameter]]",
        "[compare]",
        "[[sensors.place]]",
    ];
    let all = tables.iter().flat_map(|table| entries(table)).collect_vec();
    let correlation = ["[correlation]", "[correlation.inner]"].map(entries);
    let correlation = correlation.into_iter().flatten().collect_vec();
    // Less six names of tables at the top, one of the inner loop's, and the three entries of a sensor's place.
    let count = all.len() + correlation.len() - 10;
    assert_eq!(count, 50, "{all:?} {correlation:?}");
    let uses = |entry: &str| {
        let is_use = |line: &str| {
            let line = line.trim_start_matches(['#', ' ']);
            line.starts_with(&format!("[{entry}]")) || line.starts_with(&format!("[[{entry}]]"))
        };
        template.contains(&format!("{entry} = ")) || template.lines().any(is_use)
    };
    for entry in all {
        assert!(uses(&entry), "{entry}");
    }
    for entry in correlation {
        assert!(
            uses(&entry) || uses(&format!("correlation.{entry}")),
            "correlation: {entry}"
        );
    }
}

#[test]
fn the_example_of_a_test_reads() {
    let output = corfem(&["init", "--test"]);
    let data = corfem::files::test_data::read("test.csv", &output.stdout).unwrap();
    assert_eq!((data.sensors.len(), data.frequencies_hz.len()), (2, 2));
}

/// Two commands from nothing to a corrected structure and its report.
#[test]
fn every_example_runs_as_it_is_written() {
    for name in ["building", "wing", "garteur"] {
        let folder = new_folder();
        let at = |name: &str| folder.path().join(name);
        let job = at("mine").join("job.toml");
        let written = corfem(&["init", "--example", name, words(&at("mine"))]);
        assert_eq!(
            (written.status.code(), written.stdout.len()),
            (Some(0), 0),
            "{name}"
        );
        let next = format!(
            "next: corfem correlate {} --folder results\n",
            job.display()
        );
        assert_eq!(text(&written.stderr), next);
        let run = Reported::of(&job);
        assert_eq!(run.json()["verdict"]["is_within"], name != "garteur");
        if name != "garteur" {
            run.assert_same(reported(name));
        }
        // It is the job of the tests, whole.
        let own = folder_of(name);
        let files = fs::read_dir(&own)
            .expect("it reads")
            .map(|file| file.expect("a file").file_name());
        let files = files.collect_vec();
        assert_eq!(
            files.len(),
            fs::read_dir(at("mine")).expect("it reads").count()
        );
        for file in files {
            let [mine, own] = [at("mine"), own.clone()]
                .map(|folder| fs::read(folder.join(&file)).expect("it reads"));
            assert_eq!(mine, own, "{name}: {}", file.display());
        }
        // And never over a file that is there.
        let again = corfem(&["init", "--example", name, words(&at("mine"))]);
        assert_eq!(again.status.code(), Some(2));
        assert!(
            text(&again.stderr).contains("it is there already"),
            "{}",
            text(&again.stderr)
        );
    }
    assert_eq!(
        corfem(&["init", "--example", "wing"]).status.code(),
        Some(2)
    );
    assert_eq!(
        corfem(&["init", "--example", "bridge", "x"]).status.code(),
        Some(2)
    );
}
