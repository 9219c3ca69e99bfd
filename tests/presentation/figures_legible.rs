//! What the figures show can be told apart and read: digits on their cells, three states that coincide,
//! and captions that promise nothing else.

use crate::common::drawings::{color, contrast, value, words};
use crate::paper::figures::matrices::{HeatMap, draw_by_twos};
use crate::paper::figures::mode_shapes;
use crate::paper::figures::{Figure, report_figures};
use crate::prelude::*;
use crate::presentation::figures::{all_figures, job_figures};
use crate::presentation::subject::chain;
use corfem::present::frame::DrawnModes;

fn of_kind(what: &str) -> impl Iterator<Item = &'static Figure> {
    all_figures()
        .iter()
        .filter(move |figure| figure.name.ends_with(what))
}

/// A chain along x that is measured upward.
fn upright_chain() -> Report {
    chain("rod", &[0.9, 1.1, 0.95, 1.0], |row| {
        (Vector3::new(row as f64, 0.0, 0.0), Vector3::z())
    })
}

/// Contrasts of all digits with the cell that is drawn just before them.
fn contrasts(svg: &str) -> Vec<f64> {
    let is_of = |tag: &&str| tag.starts_with("rect") || tag.starts_with("text ");
    let tags = svg.split('<').filter(is_of).collect_vec();
    let pairs = tags
        .windows(2)
        .filter(|pair| pair[0].starts_with("rect") && pair[1].starts_with("text "));
    pairs
        .map(|pair| contrast(color(value(pair[0], "fill")), color(value(pair[1], "fill"))))
        .collect()
}

#[test]
fn digits_have_a_contrast_of_four_and_a_half_on_every_color_of_a_cell() {
    let labels = || ("row".to_owned(), vec!["1".to_owned(); 9]);
    // From minus to plus the full color, finer than the steps of a color.
    let part = |at: usize| at as f64 / 485.5 - 1.0;
    let map = |first: usize| HeatMap {
        title: "all colors".to_owned(),
        rows: labels(),
        columns: labels(),
        values: DMatrix::from_fn(9, 9, |i, j| Some(part(81 * first + 9 * i + j))),
        full: 1.0,
        written: (100.0, 0),
    };
    let maps: Vec<HeatMap> = (0..12).map(map).collect();
    let found = contrasts(&draw_by_twos("colors", "All colors", &maps, &[]).unwrap());
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

/// Where three shapes coincide, each of the lines is wider than that above it; colors stand side by side.
#[test]
fn each_state_is_seen_where_all_three_lie_on_each_other() {
    let modes = DrawnModes::from_report(&upright_chain()).unwrap().unwrap();
    let svg = mode_shapes::draw(&modes, "modes", "Modes").unwrap();
    // Lines of the legend, from the one below to the one above.
    let lines = svg
        .split("<polyline")
        .skip(1)
        .map(|tag| (value(tag, "stroke"), value(tag, "stroke-width")));
    let legend: Vec<(&str, f64)> = lines
        .take(3)
        .map(|(color, wide)| (color, wide.parse().unwrap()))
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
    let report = Report::from_job(&prepared(&building()), None).unwrap();
    assert_eq!(report.frame.len() + 1, report.grids.len());
    let others = report_figures(&upright_chain()).unwrap();
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
