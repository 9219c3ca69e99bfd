//! `corfem figures` and `corfem report` from outside: their files.

use crate::presentation::figures::figures;
use crate::presentation::program::cli::corfem;
use std::path::Path;

fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry
            .expect("an entry")
            .file_name()
            .into_string()
            .expect("UTF-8")
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

#[test]
fn report_command_writes_one_page_into_a_new_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("new");
    let out_text = out.to_str().expect("UTF-8");
    let run = corfem(&["report", "--folder", out_text]);
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stdout.is_empty());
    assert_eq!(String::from_utf8_lossy(&run.stderr).lines().count(), 4);
    assert_eq!(names_in(&out), ["report.html"]);
    assert_eq!(
        names_in(folder.path()),
        ["new"],
        "no scratch folder is left"
    );
    let html = std::fs::read_to_string(out.join("report.html")).expect("it reads");
    assert!(html.contains(&format!("<code>corfem report --folder {out_text}</code>")));
}

#[test]
fn report_command_writes_the_page_to_a_file_or_to_standard_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("report.html");
    let run = corfem(&["report", "-q", "-o", file.to_str().expect("UTF-8")]);
    assert_eq!((run.status.code(), run.stdout.len()), (Some(0), 0));
    assert_eq!(names_in(folder.path()), ["report.html"]);
    let html = std::fs::read_to_string(&file).expect("it reads");
    assert!(html.starts_with("<!DOCTYPE html>"));
    let shown = corfem(&["report", "-q", "-o", "-"]);
    let shown = String::from_utf8(shown.stdout).expect("UTF-8");
    let name = file.display().to_string();
    assert_eq!(
        shown.replace("--output -", &format!("--output {name}")),
        html
    );
}

#[test]
fn figures_command_writes_svg_and_leaves_other_files_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    std::fs::write(folder.path().join("notes.txt"), "mine").expect("written");
    let run = corfem(&["figures", "--folder", out]);
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stdout.is_empty());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    let count = figures().len();
    assert_eq!(
        said.lines().last(),
        Some(format!("{count} files in {out}").as_str())
    );
    let names = names_in(folder.path());
    assert_eq!(names.len(), figures().len() + 1);
    for figure in figures() {
        let svg = std::fs::read_to_string(folder.path().join(format!("{}.svg", figure.name)))
            .expect("it reads");
        let run = concat!("<!-- corfem ", env!("CARGO_PKG_VERSION"), " figures -->\n");
        assert_eq!(svg, figure.svg.clone() + run);
    }
    assert_eq!(
        std::fs::read_to_string(folder.path().join("notes.txt")).expect("it reads"),
        "mine"
    );
}

#[test]
fn what_cannot_be_written_is_exit_status_2_and_takes_nothing_away() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let failed = |arguments: &[&str], words: &str| {
        let run = corfem(arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(error.contains(words), "{error}");
    };
    failed(&["figures", "-q", "--folder", &path("no/such")], "such");
    assert!(names_in(folder.path()).is_empty());
    failed(&["report", "-q"], "--output");
    failed(
        &["report", "-q", "--folder", &path("report.html")],
        "this names a page",
    );
    failed(
        &["cases", "-q", "-o", &path("x.html")],
        "x.html: corfem cases -o writes no HTML; corfem report -o writes",
    );
    failed(
        &["correlate", "-q", "job.toml", "-o", &path("x.html")],
        "--folder writes the page of a job",
    );
    assert!(names_in(folder.path()).is_empty());
    std::fs::write(path("file"), "mine").expect("written");
    failed(
        &["report", "-q", "--folder", &path("file")],
        "file: Not a directory",
    );
    assert_eq!(
        std::fs::read_to_string(path("file")).expect("it reads"),
        "mine"
    );
    // A folder stands where a figure should, and stays.
    std::fs::create_dir_all(path("out/cover_gages.svg")).expect("made");
    failed(
        &["figures", "-q", "--folder", &path("out")],
        "cover_gages.svg",
    );
    assert!(folder.path().join("out/cover_gages.svg").is_dir());
    assert_eq!(names_in(folder.path()), ["file", "out"]);
}
