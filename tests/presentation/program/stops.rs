//! The program stopped by signals: a reader of its folder finds each file old or new, and whole, and a correlation keeps its best.

use crate::common::jobs::folder_of;
use crate::common::signals::{SIGNALS, corfem_run_by, send, undisturbed};
use crate::prelude::*;
use crate::presentation::figures::figures;
use std::os::unix::process::ExitStatusExt;
use std::process::Child;
use std::thread::sleep;

/// A figure's file from before.
const OLD: &str = "old";
/// Random stops that are made.
const STOPS: u64 = 4;

/// How many files are new; the others are old, or not there where there was none before. One file of a killed run may have no name yet.
fn new_files(folder: &Path, had_old: bool) -> usize {
    let mut count = 0;
    for figure in figures() {
        match fs::read_to_string(folder.join(format!("{}.svg", figure.name))) {
            Err(_) => assert!(!had_old, "{} is gone", figure.name),
            Ok(text) if had_old && text == OLD => (),
            Ok(text) => {
                assert_eq!(text, figure.svg, "{} is whole", figure.name);
                count += 1;
            }
        }
    }
    let names = fs::read_dir(folder).unwrap().flatten();
    let names = names.map(|entry| entry.file_name().into_string().unwrap());
    let others = names.filter(|name| !name.ends_with(".svg")).collect_vec();
    assert!(
        others.len() <= 1 && others.iter().all(|name| name.starts_with(".corfem-")),
        "{others:?}"
    );
    count
}

/// The program, perhaps run by another one.
fn start(run_by: &[&str], arguments: &[&str]) -> Child {
    let mut command = corfem_run_by(run_by);
    command
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// The program writing figures into a folder, of which it has written the first.
fn drawing(run_by: &[&str], folder: &Path) -> Child {
    let mut child = start(
        run_by,
        &["figures", "-q", "--folder", folder.to_str().unwrap()],
    );
    let first = folder.join(format!("{}.svg", figures()[0].name));
    let is_written = || fs::read(&first).is_ok_and(|bytes| bytes != OLD.as_bytes());
    while !is_written() && child.try_wait().unwrap().is_none() {
        std::hint::spin_loop();
    }
    child
}

#[test]
fn a_kill_at_any_moment_leaves_each_file_old_or_new_and_whole() {
    let [interrupt, terminate, hang_up] = SIGNALS.map(|(signal, _)| signal);
    for (at, signal) in (1..=STOPS).zip([interrupt, terminate, hang_up, Signal::KILL]) {
        let folder = new_folder();
        // A folder with old files, and one that is new.
        let had_old = at % 2 == 0;
        for figure in figures().iter().filter(|_| had_old) {
            fs::write(folder.path().join(format!("{}.svg", figure.name)), OLD).unwrap();
        }
        let mut child = drawing(undisturbed(), folder.path());
        // The same delays every time; the machine adds its own.
        let random = at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        sleep(Duration::from_micros(random % 8000));
        send(&child, signal);
        let ended = child.wait().unwrap();
        let new = new_files(folder.path(), had_old);
        assert!(new > 0, "it had begun");
        assert!(ended.signal() == Some(signal.as_raw()) || new == figures().len());
        // The next run writes what was not written.
        assert!(drawing(&[], folder.path()).wait().unwrap().success());
        assert_eq!(new_files(folder.path(), had_old), figures().len());
    }
}

/// As `nohup` starts a program.
#[test]
fn a_signal_that_it_was_started_to_ignore_does_not_end_it() {
    for (signal, name) in SIGNALS {
        let folder = new_folder();
        let ignoring = format!("trap '' {name}; exec \"$@\"");
        let mut child = drawing(&["sh", "-c", &ignoring, "sh"], folder.path());
        send(&child, signal);
        assert!(child.wait().unwrap().success(), "{name}");
        assert_eq!(new_files(folder.path(), false), figures().len());
    }
}

/// Waits until a program has taken the signal of Ctrl-C over and has computed for so many hundredths of a second of its own, however
/// busy the machine; for so long by the clock where that is not known.
fn await_work(child: &Child, hundredths: u64) {
    let read = |file: &str| fs::read_to_string(format!("/proc/{}/{file}", child.id())).ok();
    let works = || {
        let status = read("status")?;
        let caught = status
            .lines()
            .find_map(|line| line.strip_prefix("SigCgt:"))?;
        let mask = u64::from_str_radix(caught.trim(), 16).ok()?;
        let stat = read("stat")?;
        // The fourteenth number of the line.
        let ticks = stat.rsplit_once(')')?.1.split_whitespace().nth(11)?;
        Some(mask & 2 != 0 && ticks.parse::<u64>().ok()? >= hundredths)
    };
    for round in 0..3000 {
        sleep(Duration::from_millis(100));
        if works().unwrap_or(round >= 10 + hundredths / 3) {
            break;
        }
    }
}

/// A pipe that nobody reads holds the program while it writes the best so far.
#[test]
fn a_second_signal_ends_the_program_at_once() {
    let folder = new_folder();
    let pipe = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo");
    let job = folder_of("building").join("job.toml");
    let [job, pipe] = [&job, &pipe].map(|path| path.to_str().unwrap());
    let mut child = start(undisturbed(), &["correlate", job, "-q", "-o", pipe]);
    await_work(&child, 0);
    let ends_within = |child: &mut Child, seconds: u64| {
        (0..10 * seconds).find_map(|_| {
            sleep(Duration::from_millis(100));
            child.try_wait().unwrap()
        })
    };
    assert!(ends_within(&mut child, 1).is_none(), "nobody reads");
    send(&child, Signal::INT);
    let first = ends_within(&mut child, 1);
    send(&child, Signal::INT);
    let second = ends_within(&mut child, 10);
    _ = child.kill();
    assert!(first.is_none(), "it is postponed");
    let signal = second.and_then(|status| status.signal());
    assert_eq!(signal, Some(Signal::INT.as_raw()));
}

/// A correlation that would last is stopped: the best so far is written whole, and standard error says so.
#[test]
fn a_signal_keeps_the_best_so_far() {
    let mut files = crate::common::jobs::files_of("wing");
    let job = file(&mut files, "job.toml");
    *job = job.replace(
        "method = \"gauss_newton\"",
        "method = \"gauss_newton\"\nstarts = 1000000",
    );
    let (folder, job) = placed(&files);
    let out = folder.path().join("out");
    let mut child = start(
        undisturbed(),
        &[
            "correlate",
            job.to_str().unwrap(),
            "-q",
            "--folder",
            out.to_str().unwrap(),
        ],
    );
    await_work(&child, 150);
    assert!(child.try_wait().unwrap().is_none(), "it lasts");
    send(&child, Signal::INT);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        said,
        "corfem: stopped by request; the best factors so far are given\n"
    );
    assert_eq!(fs::read_dir(&out).unwrap().count(), 7);
    let found = fs::read_to_string(out.join("correlation.json")).unwrap();
    let found: Value = serde_json::from_str(&found).unwrap();
    let mut factors = found["parameters"].as_array().unwrap().iter();
    let is_better =
        factors.any(|own| (own["factor"].as_f64().unwrap() - 1.0).abs() > FIELD_ROUNDING);
    assert!(is_better, "better than the first model");
}
