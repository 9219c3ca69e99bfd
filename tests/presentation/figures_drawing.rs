//! The figures as drawn: complete, the same every time, and as stored.

use crate::common::drawings::written;
use crate::paper::figures::Figure;
use crate::prelude::*;
use crate::presentation::figures::{draw_all, figures};

/// Names, titles and captions, in the order of the report; the title is that of the drawing too.
#[test]
fn figures_are_named_and_introduced_as_stored() {
    let line = |Figure {
                    name, caption, svg, ..
                }: &Figure| {
        let title = written(svg).remove(0);
        assert!(svg.contains(&format!("<title>{title}</title>")), "{title}");
        format!("{name}: {title}\n    {caption}\n")
    };
    let all: String = figures().iter().map(line).collect();
    assert_golden("figures", &all, Numbers::AS_WRITTEN);
}

#[test]
fn figures_are_the_same_bytes_every_time() {
    assert_eq!(draw_all(), figures());
}

/// One of every kind.
#[test]
fn stored_figures_are_what_the_command_writes() {
    let stored = fs::read_dir(in_root("golden/figures")).unwrap();
    let stored = stored.map(|entry| entry.unwrap().path()).collect_vec();
    assert_eq!(stored.len(), 11);
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
