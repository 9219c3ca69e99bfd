//! The figures as drawn: complete, the same every time, their letters apart, and as stored.

use crate::common::drawings::{size, written};
use crate::evidence::counted_figures::counted_figures;
use crate::evidence::diagram::Diagram;
use crate::evidence::tour_figures;
use crate::paper::figures::Figure;
use crate::prelude::*;
use crate::presentation::figures::{all_figures, draw_all, figures, job_figures};

/// Names, titles and captions, in the order of the report; the title is that of the drawing too.
#[test]
fn figures_are_named_and_introduced_as_stored() {
    let line = |Figure { name, caption, svg }: &Figure| {
        let title = written(svg).remove(0).text;
        assert!(svg.contains(&format!("<title>{title}</title>")), "{title}");
        format!("{name}: {title}\n    {caption}\n")
    };
    let all: String = all_figures().iter().map(line).collect();
    assert_golden("figures", &all, Numbers::AS_WRITTEN);
}

#[test]
fn figures_are_the_same_bytes_every_time() {
    assert_eq!(draw_all(), figures());
}

#[test]
fn letters_stay_on_the_page_off_each_other_and_legible() {
    let mut faults = Vec::new();
    let diagram = |(name, diagram): (&str, Diagram)| Figure {
        name: format!("tour {name}"),
        caption: String::new(),
        svg: diagram.svg().unwrap(),
    };
    let of_texts = tour_figures::figures().into_iter().chain(counted_figures());
    let of_texts = of_texts.map(diagram).collect_vec();
    for figure in all_figures().iter().chain(job_figures()).chain(&of_texts) {
        let (width, height) = size(&figure.svg);
        assert_eq!(width, 760.0);
        let words = written(&figure.svg)
            .into_iter()
            .filter(|word| !word.text.is_empty())
            .collect_vec();
        // The large wing has a title, one kind of support and its axes, and no numbers; one mode may be all that differs.
        let least = match &figure.name {
            name if name == "wing_structure" => 2,
            name if name.contains("mode_shapes") || name.starts_with("job_") => 5,
            _ => 10,
        };
        assert!(words.len() > least, "{}", figure.name);
        for (row, one) in words.iter().enumerate() {
            let [left, top, right, bottom] = one.bounds;
            // At 1280 px the page shows a figure as wide as it is, at the head of a report 592 px wide.
            let at_head = ["box_gages", "_frequencies", "_factors"];
            let is_at_head = at_head.iter().any(|end| figure.name.ends_with(end));
            let shown = one.em * if is_at_head { 592.0 / 760.0 } else { 1.0 };
            if shown < 9.0 {
                faults.push(format!("{}: {one:?} is too small", figure.name));
            }
            if left < 0.0 || top < 0.0 || right > width || bottom > height {
                faults.push(format!("{}: {one:?} leaves the page", figure.name));
            }
            for other in &words[row + 1..] {
                let [l, t, r, b] = other.bounds;
                if right > l && r > left && bottom > t && b > top {
                    faults.push(format!("{}: {one:?} on {other:?}", figure.name));
                }
            }
        }
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
        let figure = figures().iter().find(|figure| figure.name == name);
        let stored = fs::read_to_string(&path).unwrap();
        assert!(
            Numbers::DRAWN.agree(&stored, &figure.unwrap().svg),
            "{name} differs: write it again"
        );
    }
}
