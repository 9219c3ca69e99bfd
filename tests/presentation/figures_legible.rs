//! What the figures show can be told apart and read: digits on their cells, in the dark too, and captions that promise nothing else.

use crate::common::drawings::{color, contrast, value};
use crate::paper::figures::Figure;

use crate::paper::figures::matrices::{HeatMap, draw_by_twos};
use crate::prelude::*;
use crate::presentation::figures::figures;

fn of_kind(what: &str) -> impl Iterator<Item = &'static Figure> {
    figures()
        .iter()
        .filter(move |figure| figure.name.ends_with(what))
}

/// A drawing with the colors that it has on a dark page.
fn in_the_dark(svg: &str) -> String {
    let (_, rules) = svg.split_once("(prefers-color-scheme: dark) {").unwrap();
    let (rules, drawn) = rules.split_once("}</style>").unwrap();
    let mut light: Vec<String> = drawn.split('<').map(str::to_owned).collect();
    // `.drawn text[fill="#222222"]{fill:#E4E4E4}`: those with a tag's name come last, and stand above the others.
    for rule in rules.lines().rev().filter(|line| !line.is_empty()) {
        let (selector, value) = rule
            .strip_prefix(".drawn ")
            .unwrap()
            .split_once("]{")
            .unwrap();
        let (tag, attribute) = selector.split_once('[').unwrap();
        let (name, to) = value.trim_end_matches('}').split_once(':').unwrap();
        for element in &mut light {
            if element.starts_with(tag) {
                let (old, new) = (format!(" {attribute}"), format!(" {name}=\"dark {to}\""));
                *element = element.replacen(&old, &new, 1);
            }
        }
    }
    light.join("<").replace("=\"dark #", "=\"#")
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
    for (form, draw) in [
        ("light", str::to_owned as fn(&str) -> String),
        ("dark", in_the_dark),
    ] {
        let colors = draw_by_twos("colors", "All colors", &maps, &[]).unwrap();
        let found = contrasts(&draw(&Figure::drawn("colors", "", &colors).svg));
        assert!(found.len() > 960, "{}", found.len());
        let drawn = ["agreement", "derivatives", "truncation", "box_gages"]
            .into_iter()
            .flat_map(of_kind);
        let all = found
            .into_iter()
            .chain(drawn.flat_map(|figure| contrasts(&draw(&figure.svg))));
        let least = all.fold(f64::INFINITY, f64::min);
        assert!(least >= 4.5, "{form}: {least}");
    }
}

/// In the dark nothing keeps the color that it has on white, letters have a contrast of 4.5 on the page, and lines one that is seen.
#[test]
fn figures_have_a_palette_of_their_own_on_dark_pages() {
    let css = include_str!("../../src/present/page/report.css");
    let (_, dark) = css
        .split_once("@media screen and (prefers-color-scheme: dark) {")
        .unwrap();
    let (_, page) = dark.split_once("--page: ").unwrap();
    let page = color(page.split(';').next().unwrap());
    assert!(!css.contains("invert("));
    for Figure { name, svg, .. } in figures() {
        let night = in_the_dark(svg);
        assert_eq!(
            color(value(night.split("<rect").nth(1).unwrap(), "fill")),
            page
        );
        let [day, night] = [svg, &night].map(|svg| svg.split("<").collect_vec());
        // Behind the style of the one.
        let day = &day[day.len() - night.len()..];
        let mut letters = 0;
        for (day, night) in day.iter().zip(night) {
            for attribute in ["fill", "stroke"] {
                let start = format!(" {attribute}=\"#");
                assert!(
                    !day.contains(&start) || value(day, attribute) != value(night, attribute),
                    "{name}: {night}"
                );
            }
            if night.starts_with("text ") {
                letters += 1;
                let contrast = contrast(color(value(night, "fill")), page);
                assert!(contrast >= 4.5, "{name}: {contrast}");
            }
        }
        assert!(letters > 2, "{name}");
    }
}

/// A caption says in numbers what is to be seen, but for drawings of the structure alone.
#[test]
fn captions_of_results_have_numbers() {
    let structures = ["box_points", "box_elements", "cover_gages", "derivatives"];
    for Figure { name, caption, .. } in figures() {
        if structures.iter().any(|end| name.ends_with(end)) {
            continue;
        }
        let (_, said) = caption.split_once(": ").unwrap();
        let digits = said.split("(the paper's").next().unwrap();
        assert!(
            digits.contains(|letter: char| letter.is_ascii_digit()),
            "{name}: {caption}"
        );
    }
}
