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
    let line = |Figure {
                    name, caption, svg, ..
                }: &Figure| {
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

/// What is wrong with the letters of a drawing that a page shows as many times as large as it is drawn.
fn illegible(name: &str, svg: &str, shown: f64) -> Vec<String> {
    let (width, height) = size(svg);
    let form = format!("{name}, {width} px");
    let all = written(svg).into_iter();
    let words = all.filter(|word| !word.text.is_empty()).collect_vec();
    // The large wing has a title, one kind of support and its axes, and no numbers; one mode may be all that differs.
    let least = match name {
        "wing_structure" => 2,
        name if name.contains("mode_shapes") || name.starts_with("job_") => 5,
        _ => 10,
    };
    assert!(words.len() > least, "{name}");
    let mut faults = Vec::new();
    for (row, one) in words.iter().enumerate() {
        let [left, top, right, bottom] = one.bounds;
        if one.em * shown < 9.0 {
            faults.push(format!("{form}: {one:?} is too small"));
        }
        if left < 0.0 || top < 0.0 || right > width || bottom > height {
            faults.push(format!("{form}: {one:?} leaves the page"));
        }
        for other in &words[row + 1..] {
            let [l, t, r, b] = other.bounds;
            if right > l && r > left && bottom > t && b > top {
                faults.push(format!("{form}: {one:?} on {other:?}"));
            }
        }
    }
    faults
}

/// At 1280 px a page shows a figure as wide as it is, at the head of a report 592 px wide; a telephone of 390 px has room for 358.
#[test]
fn letters_stay_on_the_page_off_each_other_and_legible_at_1280_and_at_390_pixels() {
    const PHONE: f64 = 390.0;
    let css = include_str!("../../src/present/page/report.css");
    let (_, narrow) = css.split_once("@media (max-width: 40rem) {").unwrap();
    assert!(narrow.contains(".drawn.wide { display: none; } .drawn.narrow { display: block; }"));
    assert!(narrow.contains("body { padding: 1rem 1rem "));
    let shown = PHONE - 2.0 * 16.0;
    let mut faults = Vec::new();
    let diagram = |(name, diagram): (&str, Diagram)| {
        Figure::drawn(&format!("tour {name}"), "", |wide| diagram.svg(wide)).unwrap()
    };
    let of_texts = tour_figures::figures().into_iter().chain(counted_figures());
    let of_texts = of_texts.map(diagram).collect_vec();
    for figure in all_figures().iter().chain(job_figures()).chain(&of_texts) {
        let Figure {
            name, svg, narrow, ..
        } = figure;
        assert_eq!([size(svg).0, size(narrow).0], [760.0, shown]);
        let at_head = ["box_gages", "_frequencies", "_factors"];
        let is_at_head = at_head.iter().any(|end| name.ends_with(end));
        let wide = if is_at_head { 592.0 / 760.0 } else { 1.0 };
        faults.extend(illegible(name, svg, wide));
        faults.extend(illegible(name, narrow, 1.0));
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// One of every kind, and the narrow forms that the tour shows.
#[test]
fn stored_figures_are_what_the_command_writes() {
    let stored = fs::read_dir(in_root("golden/figures")).unwrap();
    let stored = stored.map(|entry| entry.unwrap().path()).collect_vec();
    assert_eq!(stored.len(), 13);
    let drawn = figures().iter().cloned().flat_map(Figure::files);
    let drawn: BTreeMap<String, String> = drawn.collect();
    for path in stored {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap();
        let stored = fs::read_to_string(&path).unwrap();
        assert!(
            Numbers::DRAWN.agree(&stored, &drawn[name]),
            "{name} differs: write it again"
        );
    }
}
