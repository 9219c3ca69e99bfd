//! The figures as stored.

use crate::prelude::*;
use crate::presentation::figures::figures;

/// One of every kind.
#[test]
fn stored_figures_are_what_the_command_writes() {
    let stored = fs::read_dir(in_root("golden/figures")).unwrap();
    let stored = stored.map(|entry| entry.unwrap().path()).collect_vec();
    assert_eq!(stored.len(), 6);
    for path in stored {
        let name = path.file_stem().and_then(|name| name.to_str()).unwrap();
        let drawn = figures().iter().find(|figure| figure.name == name).unwrap();
        let stored = fs::read_to_string(&path).unwrap();
        assert!(
            Numbers::DRAWN.agree(&stored, &drawn.svg),
            "{name} differs: write it again"
        );
    }
}
