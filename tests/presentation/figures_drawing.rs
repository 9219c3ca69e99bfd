//! The figures as drawn: complete, the same every time, their letters apart, and as stored.

use crate::common::drawings::{size, written};
use crate::evidence::counted_figures::counted_figures;
use crate::evidence::diagram::Diagram;
use crate::evidence::tour_figures;
use crate::paper::figures::Figure;
use crate::prelude::*;
use crate::presentation::figures::{all_figures, draw_all, figures, job_figures};

#[test]
fn figures_of_a_run_in_the_order_of_the_report() {
    let names = all_figures()
        .iter()
        .map(|figure| figure.name.as_str())
        .collect_vec();
    let mut expected = vec![
        "box_points".to_owned(),
        "box_elements".into(),
        "box_gages".into(),
        "cover_gages".into(),
    ];
    for case in 1..=3 {
        for name in [
            "frequencies",
            "errors",
            "mode_shapes",
            "agreement",
            "derivatives",
        ] {
            expected.push(format!("case_{case}_{name}"));
        }
    }
    expected.extend(["case_4_factors", "case_4_derivatives", "truncation"].map(String::from));
    let wings = [(
        "delta_wing",
        &[
            "structure",
            "frequencies",
            "mode_shapes",
            "errors",
            "factors",
            "agreement",
            "derivatives",
        ][..],
    )];
    for (wing, drawn) in wings.into_iter().chain([(
        "wing",
        &["structure", "frequencies", "errors", "factors", "agreement"][..],
    )]) {
        expected.extend(drawn.iter().map(|what| format!("{wing}_{what}")));
    }
    assert_eq!(names, expected);
    for figure in all_figures() {
        assert!(
            figure.caption.ends_with('.') && figure.caption.len() > 30,
            "{}",
            figure.name
        );
        // Caption, title and the words above the drawing say what it is of.
        let title = written(&figure.svg).remove(0).text;
        assert!(
            figure.svg.contains(&format!("<title>{title}</title>")),
            "{title}"
        );
        let of = match figure.name.split_once('_') {
            Some(("case", case)) => format!("Case {}:", &case[..1]),
            Some(("delta" | "wing", _)) => {
                format!(
                    "{} with wrong gages:",
                    title.split(" with").next().expect("a name")
                )
            }
            _ => "Case".to_owned(),
        };
        assert!(
            figure.caption.starts_with(&of) && title.starts_with(&of),
            "{}: {title}",
            figure.name
        );
    }
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
        svg: diagram.svg().expect("drawn"),
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

#[test]
fn stored_figures_are_what_the_command_writes() {
    let numbers = Numbers::DRAWN;
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/figures");
    let mut compared = 0;
    for entry in fs::read_dir(folder).expect("the folder") {
        let path = entry.expect("a file").path();
        let name = path
            .file_stem()
            .and_then(|name| name.to_str())
            .expect("a name");
        let figure = figures()
            .iter()
            .find(|figure| figure.name == name)
            .expect("a figure of that name");
        let stored = fs::read_to_string(&path).expect("it reads");
        assert!(
            numbers.agree(&stored, &figure.svg),
            "{name} differs: write it again"
        );
        compared += 1;
    }
    assert_eq!(compared, 11, "one of every kind");
}

#[test]
fn captions_name_the_papers_figures() {
    let caption = |name: &str| {
        let figure = figures().iter().find(|figure| figure.name == name);
        figure.expect("drawn").caption.as_str()
    };
    for (name, number) in [
        ("box_points", 2),
        ("box_elements", 3),
        ("cover_gages", 4),
        ("case_1_errors", 5),
        ("case_1_mode_shapes", 6),
        ("case_2_errors", 7),
        ("case_3_errors", 8),
    ] {
        assert!(
            caption(name).contains(&format!("Figure {number})")),
            "{name}"
        );
    }
}
