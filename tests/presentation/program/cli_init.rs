//! `corfem init` from outside: a job and a test that explain themselves, and that the readers take.

use crate::common::jobs::{files_of, folder_of};
use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text, words};
use crate::presentation::program::cli_jobs::{Reported, reported};
use corfem::job::Job;

#[test]
fn init_writes_a_job_that_reads_and_nothing_over_another() {
    let folder = new_folder();
    let path = folder.path().join("job.toml");
    assert_eq!(corfem(&["init", words(&path)]).status.code(), Some(0));
    let written = fs::read_to_string(&path).unwrap();
    assert_eq!(written, text(&corfem(&["init"]).stdout));
    let refused = corfem(&["init", words(&path)]);
    let said = text(&refused.stderr);
    assert!(said.contains("job.toml: it is there already"), "{said}");
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(fs::read_to_string(&path).unwrap(), written);
    let job = corfem::job::read(&path).unwrap();
    assert_eq!(job.title.as_deref(), Some("my structure"));
    // Every example and default is one that the reader takes, but for those of a model of matrices.
    let lines = written
        .lines()
        .skip_while(|line| !line.starts_with("title"));
    let examples = lines.map(|line| {
        let entry = line.strip_prefix("# ");
        let entry = entry.filter(|entry| entry.split(' ').nth(1) == Some("="));
        entry.unwrap_or(line).to_owned() + "\n"
    });
    toml::from_str::<Job>(&examples.collect::<String>()).unwrap();
    // Pointed to files that exist, it is a job that can be looked at.
    let wing = |file: &str| format!("{:?}", words(&folder_of("wing").join(file)));
    let pointed = written
        .replace("\"model.bdf\"", &wing("model.bdf"))
        .replace("\"test.unv\"", &wing("test.unv"))
        .replace("# by = \"grid\"", "by = \"nearest\"");
    fs::write(&path, pointed).unwrap();
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
    assert_eq!(count, 47, "{all:?} {correlation:?}");
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
        let mine = folder.path().join("mine");
        let init = || {
            let output = corfem(&["init", "--example", name, words(&mine)]);
            assert!(output.stdout.is_empty());
            (output.status.code(), text(&output.stderr))
        };
        let job = mine.join("job.toml");
        let next = format!(
            "next: corfem correlate {} --folder results\n",
            job.display()
        );
        assert_eq!(init(), (Some(0), next));
        let run = Reported::of(&job);
        assert_eq!(run.json()["is_within"], name != "garteur");
        if name != "garteur" {
            run.assert_same(reported(name));
        }
        // It is the job of the tests, whole, and never over a file that is there.
        let own = files_of(name);
        assert_eq!(fs::read_dir(&mine).unwrap().count(), own.len());
        for (file, text) in own {
            assert_eq!(
                fs::read_to_string(mine.join(&file)).unwrap(),
                text,
                "{name}: {file}"
            );
        }
        let (status, said) = init();
        assert!(
            status == Some(2) && said.contains("it is there already"),
            "{said}"
        );
    }
    for arguments in [&["wing"][..], &["bridge", "x"]] {
        let refused = corfem(&[&["init", "--example"], arguments].concat());
        assert_eq!(refused.status.code(), Some(2));
    }
}
