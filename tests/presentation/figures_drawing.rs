//! The figures as drawn: complete, the same every time, their letters apart, and as stored.

use crate::common::drawings::{size, written};
use crate::evidence::counted_figures::counted_figures;
use crate::evidence::diagram::Diagram;
use crate::evidence::tour_figures;
use crate::paper::figures::Figure;
use crate::prelude::*;
use crate::presentation::figures::{draw_all, figures};

/// Names, titles and captions, in the order of the report; the title is that of the drawing too.
#[test]
fn figures_are_named_and_introduced_as_stored() {
    let line = |Figure {
                    name, caption, svg, ..
                }: &Figure| {
        let title = written(svg).remove(0).text;
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

/// What is wrong with the letters of a drawing that a page shows as many times as large as it is drawn.
fn illegible(name: &str, svg: &str, shown: f64) -> Vec<String> {
    let (width, height) = size(svg);
    let all = written(svg).into_iter();
    let words = all.filter(|word| !word.text.is_empty()).collect_vec();
    assert!(words.len() > 5, "{name}");
    let mut faults = Vec::new();
    for (row, one) in words.iter().enumerate() {
        let [left, top, right, bottom] = one.bounds;
        if one.em * shown < 9.0 {
            faults.push(format!("{name}: {one:?} is too small"));
        }
        if left < 0.0 || top < 0.0 || right > width || bottom > height {
            faults.push(format!("{name}: {one:?} leaves the page"));
        }
        for other in &words[row + 1..] {
            let [l, t, r, b] = other.bounds;
            if right > l && r > left && bottom > t && b > top {
                faults.push(format!("{name}: {one:?} on {other:?}"));
            }
        }
    }
    faults
}

/// A page of 1280 px shows a figure as wide as it is, and at the head of a report 592 px wide; on a telephone it scrolls, 640 px wide.
#[test]
fn letters_stay_on_the_page_off_each_other_and_legible() {
    let css = include_str!("../../src/present/page/report.css");
    assert!(css.contains("{ .drawing { overflow-x: auto; } .drawn { min-width: 40rem; } }"));
    let mut faults = Vec::new();
    let diagram = |(name, diagram): (&str, Diagram)| {
        Figure::drawn(&format!("tour {name}"), "", &diagram.svg().unwrap())
    };
    let of_texts = tour_figures::figures().into_iter().chain(counted_figures());
    let of_texts = of_texts.map(diagram).collect_vec();
    for Figure { name, svg, .. } in figures().iter().chain(&of_texts) {
        assert_eq!(size(svg).0, 760.0);
        let at_head = ["box_gages", "_frequencies"];
        let is_at_head = at_head.iter().any(|end| name.ends_with(end));
        let wide = if is_at_head { 592.0 } else { 640.0 };
        faults.extend(illegible(name, svg, wide / 760.0));
    }
    assert!(faults.is_empty(), "{faults:#?}");
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
