//! `corfem study` from outside: the same samples whatever the threads, gone on with after any end, and alone.

use crate::common::jobs::folder_of;
use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text, words};
use std::process::Output;

const COUNT: usize = 6;

fn job(name: &str) -> PathBuf {
    folder_of(name).join("job.toml")
}

fn study(folder: &Path, more: &[&str]) -> Output {
    let job = job("building");
    let count = COUNT.to_string();
    let base = [
        "study",
        words(&job),
        "-q",
        "--samples",
        &count,
        "--seed",
        "5",
        "--folder",
        words(folder),
    ];
    corfem(&[&base[..], more].concat())
}

/// The lines of the samples, sorted, and the file that is made of them.
fn found(folder: &Path) -> (Vec<String>, Vec<u8>) {
    let samples = fs::read_to_string(folder.join("samples.csv")).unwrap();
    assert!(
        samples.ends_with('\n')
            && samples.starts_with("sample,outcome,within,error_sum,analyses,\"story 1\",")
    );
    let mut lines = samples.lines().skip(1).map(str::to_owned).collect_vec();
    lines.sort();
    (lines, fs::read(folder.join("summary.csv")).unwrap())
}

/// Whatever the number of threads, and after any end, the folder is the same.
#[test]
fn threads_and_stops_change_nothing() {
    let folder = new_folder();
    let one = folder.path().join("one");
    let output = study(&one, &["--threads", "1"]);
    assert_eq!(
        (output.status.code(), text(&output.stderr)),
        (Some(0), String::new())
    );
    let expected = found(&one);
    assert_eq!(expected.0.len(), COUNT);
    let two = folder.path().join("two");
    assert_eq!(study(&two, &["--threads", "2"]).stdout, output.stdout);
    assert_eq!(found(&two), expected);
    // Three whole lines and a torn one.
    let whole = fs::read_to_string(one.join("samples.csv")).unwrap();
    let cut = whole.match_indices('\n').nth(3).unwrap().0 + 20;
    fs::write(two.join("samples.csv"), &whole[..cut]).unwrap();
    assert_eq!(study(&two, &[]).stdout, output.stdout);
    assert_eq!(found(&two), expected);
    // Nothing is left to do, and one more is.
    let before = fs::read(two.join("samples.csv")).unwrap();
    assert_eq!(study(&two, &[]).stdout, output.stdout);
    assert_eq!(fs::read(two.join("samples.csv")).unwrap(), before);
    let summary = text(&output.stdout);
    assert!(summary.contains(
        "6 samples, seed 5, with noise on the test: 6 within tolerance, 0 not, 0 failed."
    ));
    assert!(
        summary.lines().all(|line| line.chars().count() <= 100),
        "{summary}"
    );
}

/// The samples of a scheduler, each of a process of its own, are one file behind one another.
#[test]
fn samples_run_alone_and_put_together_are_the_study() {
    let folder = new_folder();
    let [one, merged] = ["one", "merged"].map(|name| folder.path().join(name));
    let output = study(&one, &[]);
    let alone = |sample: usize, more: &[&str]| {
        let (job, sample) = (job("building"), sample.to_string());
        let output = corfem(
            &[
                &["study", words(&job), "--seed", "5", "--sample", &sample],
                more,
            ]
            .concat(),
        );
        assert_eq!(
            (output.status.code(), text(&output.stderr)),
            (Some(0), String::new())
        );
        text(&output.stdout)
    };
    let mut lines = (1..=COUNT).map(|sample| alone(sample, &[])).collect_vec();
    assert_eq!(lines.concat().lines().collect_vec(), found(&one).0);
    let file = folder.path().join("3.csv");
    assert_eq!(alone(3, &["--output", words(&file)]), "");
    assert_eq!(fs::read_to_string(&file).unwrap(), lines[2]);
    lines.rotate_left(2);
    fs::create_dir(&merged).unwrap();
    fs::write(merged.join("samples.csv"), lines.concat()).unwrap();
    assert_eq!(study(&merged, &[]).stdout, output.stdout);
    assert_eq!(
        fs::read_to_string(merged.join("samples.csv")).unwrap(),
        lines.concat()
    );
    assert_eq!(fs::read(merged.join("summary.csv")).unwrap(), found(&one).1);
}

/// A study that would last is stopped: whole lines of what is done are there, and the same command goes on with them.
#[cfg(unix)]
#[test]
fn a_signal_keeps_the_samples_done() {
    use crate::common::signals::{corfem_run_by, send, undisturbed};
    use std::os::unix::process::ExitStatusExt;
    let folder = new_folder();
    let (job, path) = (job("building"), folder.path().join("samples.csv"));
    let mut child = corfem_run_by(undisturbed())
        .args([
            "study",
            words(&job),
            "-q",
            "--samples",
            "1000000",
            "--seed",
            "5",
            "--folder",
            words(folder.path()),
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = || fs::read_to_string(&path).map_or(0, |text| text.matches('\n').count());
    for _ in 0..600 {
        if lines() > COUNT + 1 {
            break;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    assert!(child.try_wait().unwrap().is_none(), "it lasts");
    send(&child, Signal::INT);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.signal(), Some(Signal::INT.as_raw()));
    let done = lines() - 1;
    let said = format!(
        "corfem: stopped by request; {done} of 1000000 samples are done; the same command resumes\n"
    );
    assert_eq!(text(&output.stderr), said);
    assert!(
        fs::read_to_string(&path).unwrap().ends_with('\n')
            && !folder.path().join("summary.csv").exists()
    );
    let whole = new_folder();
    let [resumed, uninterrupted] =
        [folder.path(), whole.path()].map(|folder| study(folder, &[]).stdout);
    assert_eq!(resumed, uninterrupted);
}

/// Progress is for a terminal that nobody asked to be quiet on; `script` lends one.
#[cfg(unix)]
#[test]
#[ignore = "needs script, of util-linux"]
fn progress_stands_on_a_terminal_alone() {
    let program = assert_cmd::cargo::cargo_bin("corfem");
    let on_terminal = |more: &str| {
        let command = format!("{} check {} {more}", words(&program), words(&job("wing")));
        let output = Command::new("script")
            .args(["-qec", &command, "/dev/null"])
            // Without its name nothing is drawn on a terminal.
            .env("TERM", "xterm")
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(output.status.success());
        text(&output.stdout)
    };
    let silent = corfem(&["check", words(&job("wing"))]);
    assert_eq!(
        (silent.status.code(), text(&silent.stderr)),
        (Some(0), String::new())
    );
    let (loud, quiet) = (on_terminal(""), on_terminal("-q"));
    assert!(loud.contains("looking at the job"), "{loud}");
    assert!(!quiet.contains("looking at the job"), "{quiet}");
}

#[test]
fn the_help_of_every_command_has_its_exit_statuses() {
    let help = text(&corfem(&["help"]).stdout);
    let commands = help.split("Commands:\n").nth(1).unwrap();
    let commands = commands.lines().take_while(|line| !line.is_empty());
    let commands = commands.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let commands = commands
        .filter(|name| !name.is_empty() && *name != "help")
        .collect_vec();
    assert_eq!(commands.len(), 12, "{commands:?}");
    for command in commands {
        let help = text(&corfem(&[command, "--help"]).stdout);
        assert!(help.contains("\nExit status: 0 "), "{command}: {help}");
    }
}
