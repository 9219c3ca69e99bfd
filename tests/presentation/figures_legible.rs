//! What the figures show can be told apart and read: digits on their cells, panels by their kind, three states that coincide, colors
//! only where something is measured, and captions that promise nothing else.

use crate::common::drawings::{words, written};
use crate::paper::figures::matrices::{HeatMap, draw_by_twos};
use crate::paper::figures::mode_shapes;
use crate::paper::figures::{Figure, report_figures};
use crate::paper::report::case_report;
use crate::prelude::*;
use crate::presentation::figures::{all_figures, job_figures, results};
use crate::presentation::subject::chain;
use corfem::present::frame::DrawnModes;

fn of_kind(what: &str) -> impl Iterator<Item = &'static Figure> {
    all_figures()
        .iter()
        .filter(move |figure| figure.name.ends_with(what))
}

/// The value of an attribute of a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let value = tag
        .split_once(&format!(" {name}=\""))
        .and_then(|(_, rest)| rest.split('"').next());
    value.unwrap_or_else(|| panic!("no {name} in {tag}"))
}

/// Relative luminance of a color such as `#0072B2` (WCAG 2.2).
fn luminance(color: &str) -> f64 {
    let linear = |at: usize| {
        let value = f64::from(u8::from_str_radix(&color[at..at + 2], 16).expect("a color")) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    };
    0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5)
}

/// Contrasts of all digits with the cell that is drawn just before them.
fn contrasts(svg: &str) -> Vec<f64> {
    let tags: Vec<&str> = svg
        .split('<')
        .filter(|tag| tag.starts_with("rect") || tag.starts_with("text "))
        .collect();
    let pairs = tags
        .windows(2)
        .filter(|pair| pair[0].starts_with("rect") && pair[1].starts_with("text "));
    let of = |pair: &[&str]| {
        let [one, other] = [pair[0], pair[1]].map(|tag| luminance(attribute(tag, "fill")) + 0.05);
        one.max(other) / one.min(other)
    };
    pairs.map(of).collect()
}

#[test]
fn digits_have_a_contrast_of_four_and_a_half_on_every_color_of_a_cell() {
    let labels = || {
        (
            "row".to_owned(),
            (1..=9).map(|row| row.to_string()).collect(),
        )
    };
    // From minus to plus the full color, finer than the steps of a color.
    let value = |at: usize| at as f64 / 485.5 - 1.0;
    let map = |first: usize| HeatMap {
        title: "all colors".to_owned(),
        rows: labels(),
        columns: labels(),
        values: DMatrix::from_fn(9, 9, |i, j| Some(value(81 * first + 9 * i + j))),
        full: 1.0,
        written: (100.0, 0),
    };
    let maps: Vec<HeatMap> = (0..12).map(map).collect();
    let found = contrasts(&draw_by_twos("colors", "All colors", &maps, &[]).expect("drawn"));
    assert!(found.len() > 960, "{}", found.len());
    let drawn = ["agreement", "derivatives", "truncation", "stiffness"]
        .into_iter()
        .flat_map(of_kind);
    let all = found
        .into_iter()
        .chain(drawn.flat_map(|figure| contrasts(&figure.svg)));
    let least = all.fold(f64::INFINITY, f64::min);
    assert!(least >= 4.5, "{least}");
}

#[test]
fn colors_of_a_shape_stay_out_of_the_strip_between_root_and_first_rib() {
    for result in &results()[..3] {
        let subject = case_report(result).expect("a subject");
        let modes = DrawnModes::from_report(&subject)
            .expect("nine points")
            .expect("places");
        let is_held =
            |panel: &&Vec<Vector3<f64>>| panel.iter().any(|at| subject.supports.contains(at));
        let held = subject.frame.iter().filter(is_held).count();
        assert_eq!(
            (held, modes.frame.panels.len()),
            (2, subject.frame.len() - 2)
        );
    }
}

#[test]
fn membranes_and_shear_panels_differ_in_the_box_taken_apart() {
    let figure = of_kind("box_elements").next().expect("drawn");
    let fills: Vec<&str> = figure
        .svg
        .split("<polygon")
        .skip(1)
        .map(|tag| attribute(tag, "fill"))
        .collect();
    let words: Vec<String> = written(&figure.svg)
        .into_iter()
        .map(|word| word.text)
        .collect();
    // Six covers and nine webs, each with its letter.
    for (letter, count) in [(" M", 6), (" S", 9)] {
        let is_panel = |word: &&String| {
            word.strip_suffix(letter)
                .is_some_and(|label| label.parse::<usize>().is_ok())
        };
        assert_eq!(words.iter().filter(is_panel).count(), count);
        assert!(
            fills
                .iter()
                .any(|fill| fills.iter().filter(|other| *other == fill).count() == count),
            "{fills:?}"
        );
    }
    assert_eq!(fills.len(), 15);
}

/// Where three shapes coincide, each of the lines is wider than that above it; colors stand side by side.
#[test]
fn each_state_is_seen_where_all_three_lie_on_each_other() {
    let chain = chain("rod", &[0.9, 1.1, 0.95, 1.0], |row| {
        (Vector3::new(row as f64, 0.0, 0.0), Vector3::z())
    });
    let modes = DrawnModes::from_report(&chain)
        .expect("fits")
        .expect("places");
    let svg = mode_shapes::draw(&modes, "modes", "Modes").expect("drawn");
    // Lines of the legend, from the one below to the one above.
    let lines = svg
        .split("<polyline")
        .skip(1)
        .map(|tag| (attribute(tag, "stroke"), attribute(tag, "stroke-width")));
    let legend: Vec<(&str, f64)> = lines
        .take(3)
        .map(|(color, wide)| (color, wide.parse().expect("a width")))
        .collect();
    for pair in legend.windows(2) {
        assert!(
            pair[0].0 != pair[1].0 && pair[0].1 >= pair[1].1 + 30.0,
            "{legend:?}"
        );
    }
    for figure in of_kind("mode_shapes").filter(|figure| figure.name.starts_with("case")) {
        let said = words(&figure.svg);
        let count = |start: &str| said.iter().filter(|word| word.starts_with(start)).count();
        let modes = count("Mode ");
        assert!((1..9).contains(&modes), "{}: {modes} differ", figure.name);
        for state in ["test: ", "first: ", "corrected: "] {
            assert_eq!(count(state), modes);
        }
        assert!(
            said.iter()
                .any(|word| word.contains("Blue moves along +z, red along −z"))
        );
    }
}

#[test]
fn criteria_without_mass_say_so_beside_those_with_it() {
    for figure in of_kind("agreement") {
        let words: Vec<String> = written(&figure.svg)
            .into_iter()
            .map(|word| word.text)
            .collect();
        let titled = |start: &str| {
            words
                .iter()
                .filter(|word| word.starts_with(start))
                .collect_vec()
        };
        let (assurance, cross) = (titled("MAC "), titled("Cross-orthogonality"));
        assert_eq!(
            assurance,
            [
                "MAC before, not mass-weighted",
                "MAC after, not mass-weighted"
            ]
        );
        assert!(cross.iter().all(|title| title.ends_with(", mass-weighted")));
        assert_eq!(
            cross.is_empty(),
            figure.name == "wing_agreement",
            "its mass stands in no subject"
        );
    }
}

/// What a caption says of a drawing, and what in the drawing keeps the word: a color, or words.
const PROMISES: [(&str, &str); 11] = [
    ("bounds in blue", "stroke=\"#0072B2\""),
    ("bars are one standard deviation", "stroke=\"#E69F00\""),
    (
        "an inner loop steps",
        "accepted iterations of the inner loop",
    ),
    ("every one solved exactly", "\niterations\n"),
    ("its sensors named", "fill=\"#D55E00\""),
    ("its supports black", "\nheld\n"),
    ("its grids numbered", "\ngrid\n"),
    ("cross-orthogonality", "Cross-orthogonality before"),
    ("and of the error sum", "\nError sum\n"),
    ("mode shapes of the test", "Mode "),
    ("its elements numbered", "\n1 S"),
];

#[test]
fn captions_promise_nothing_that_is_not_drawn() {
    // Grids of matrices are joined where their stiffness couples them.
    let report = Report::from_job(&prepared(&building()), None).expect("a report");
    assert_eq!(report.frame.len() + 1, report.grids.len());
    let chain = chain("rod", &[0.9, 1.1, 0.95, 1.0], |row| {
        (Vector3::new(row as f64, 0.0, 0.0), Vector3::z())
    });
    let others = report_figures(&chain).expect("drawn");
    let mut kept = BTreeSet::new();
    for Figure { name, caption, svg } in all_figures().iter().chain(job_figures()).chain(&others) {
        for (words, drawn) in PROMISES {
            if caption.contains(words) {
                assert!(svg.contains(drawn), "{name} promises {words:?}: {caption}");
                kept.insert(words);
            }
        }
    }
    assert_eq!(kept.len(), PROMISES.len(), "{kept:?}");
}
