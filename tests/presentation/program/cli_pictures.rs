//! `corfem figures` and `corfem report` from outside: their files.

use crate::prelude::*;
use crate::presentation::figures::figures;
use crate::presentation::program::cli::{corfem, text};

#[test]
fn figures_command_writes_svg_and_leaves_other_files_alone() {
    let folder = new_folder();
    let out = folder.path().to_str().unwrap();
    let file = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let run = corfem(&["figures", "--folder", out]);
    assert_eq!((run.status.code(), run.stdout.len()), (Some(0), 0));
    let drawn = figures();
    let last = format!("{} files in {out}", drawn.len());
    assert_eq!(text(&run.stderr).lines().last(), Some(&last[..]));
    assert_eq!(fs::read_dir(out).unwrap().count(), drawn.len() + 1);
    let run = concat!("<!-- corfem ", env!("CARGO_PKG_VERSION"), " figures -->\n");
    for figure in drawn {
        assert_eq!(
            file(&format!("{}.svg", figure.name)),
            figure.svg.clone() + run
        );
    }
    assert_eq!(file("notes.txt"), "mine");
}
