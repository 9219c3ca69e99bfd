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
