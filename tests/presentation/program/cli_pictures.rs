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
    let run = corfem(&["report", "--output", out_text]);
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stdout.is_empty());
    assert_eq!(String::from_utf8_lossy(&run.stderr).lines().count(), 5);
    assert_eq!(names_in(&out), ["report.html"]);
    assert_eq!(
        names_in(folder.path()),
        ["new"],
        "no scratch folder is left"
    );
    let html = std::fs::read_to_string(out.join("report.html")).expect("it reads");
    assert!(html.contains(&format!("<code>corfem report --output {out_text}</code>")));
}

#[test]
fn figures_command_writes_svg_and_leaves_other_files_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    std::fs::write(folder.path().join("notes.txt"), "mine").expect("written");
    let run = corfem(&["figures", "--out", out]);
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
    failed(&["figures", "-q", "--out", &path("no/such")], "such");
    assert!(names_in(folder.path()).is_empty());
    failed(&["report", "-q"], "--output");
    std::fs::write(path("file"), "mine").expect("written");
    failed(
        &["report", "-q", "--out", &path("file")],
        "file: Not a directory",
    );
    assert_eq!(
        std::fs::read_to_string(path("file")).expect("it reads"),
        "mine"
    );
    // A folder stands where a figure should, and stays.
    std::fs::create_dir_all(path("out/cover_gages.svg")).expect("made");
    failed(&["figures", "-q", "--out", &path("out")], "cover_gages.svg");
    assert!(folder.path().join("out/cover_gages.svg").is_dir());
    assert_eq!(names_in(folder.path()), ["file", "out"]);
}
