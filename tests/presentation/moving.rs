//! The page of a job: its first screen, its moving structure, and that every view says the same.

use crate::common::drawings::{color, contrast};
use crate::common::jobs::loaded;
use crate::prelude::*;
use crate::presentation::play::by_node;
use crate::presentation::subject::{chain, is_well_formed, without_scripts};
use corfem::present::frame::{DrawnModes, extents};
use corfem::present::page::charts::{factor_bars, residual_map};
use corfem::present::page::moving::{SCRIPT, moving};
use corfem::present::page::report_page;
use corfem::present::report::ModeResiduals;
use corfem::present::tables::report::answer_table;
use corfem::present::{json, rows};

const JOBS: [&str; 3] = ["box", "building", "wing"];

fn report(name: &str) -> Report {
    Report::from_job(&loaded(name), Some(worked(name))).unwrap()
}

/// The data of the first moving structure of a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("<script>moving(").unwrap();
    let (data, _) = rest.split_once(")</script>").unwrap();
    serde_json::from_str(data).unwrap()
}

#[test]
fn the_answer_the_structure_and_the_factors_stand_before_all_else() {
    for name in JOBS {
        let report = report(name);
        let page = report_page(&report, &[], "corfem", "").unwrap();
        assert!(is_well_formed(&page), "{name}");
        let at = |what: &str| page.find(what).unwrap_or_else(|| panic!("{name}: {what}"));
        let parts = [
            at(&format!("<strong>{}</strong>", report.answer())),
            at("<figure class=\"moving\""),
            at("<figure class=\"bars\""),
            at("<figure class=\"pairing\""),
            at("<nav "),
            at("<section "),
        ];
        assert!(parts.is_sorted(), "{name}: {parts:?}");
    }
}

/// Both frame their pairs and say the least of them; a test of frequencies alone has neither.
#[test]
fn modal_assurance_of_the_first_model_stands_beside_that_of_the_corrected_one() {
    for name in JOBS {
        let report = report(name);
        let page = report_page(&report, &[], "corfem", "").unwrap();
        let (head, _) = page.split_once("<nav ").unwrap();
        for (when, check) in [("before", &report.initial), ("after", report.corrected())] {
            let start = format!("<figure id=\"{}_agreement_{when}\">", report.name);
            let found = head.split_once(&start);
            assert_eq!(found.is_some(), report.test.len() > 0, "{name}");
            let Some((_, map)) = found else {
                continue;
            };
            let (map, _) = map.split_once("</figure>").unwrap();
            let assurance = report.agreement(check).unwrap().assurance;
            let pairs = check.pairing.analysis_mode.iter().enumerate();
            let least = pairs
                .map(|(j, &i)| assurance[(i, j)])
                .fold(f64::INFINITY, f64::min);
            let words = format!("The least of a pair is {least:.2};");
            assert!(map.contains(&words), "{name}: {words} {map}");
            assert!(map.contains(&format!("{when} the correction")));
            assert_eq!(map.matches(" framed\"").count(), report.test.len());
        }
    }
}

/// Text, CSV, JSON, rows and page are views of one value.
#[test]
fn every_view_tells_the_same_factors_and_errors() {
    for name in JOBS {
        let report = report(name);
        let table = factor_table(&report);
        let document = json::report(&report).unwrap();
        let bars = factor_bars(&report);
        let (plain, separated, rows) = (
            text(&[answer_table(&report), table.clone()]),
            csv(&[table]),
            rows::factor_rows(&report),
        );
        assert_eq!(document["answer"], report.answer());
        let answer = plain.split_whitespace().collect_vec().join(" ");
        assert!(answer.starts_with(&report.answer()), "{plain}");
        for (e, parameter) in report.parameters.iter().enumerate() {
            let factor = document["factors"][e].as_f64().unwrap();
            assert_eq!(factor, report.factors()[e]);
            let row = plain
                .lines()
                .find(|line| line.starts_with(&format!("{parameter} ")));
            let four = Digits::Fixed(4).write(factor);
            assert!(
                row.is_some_and(|row| row.contains(&four)),
                "{parameter}: {plain}"
            );
            let is_of = |line: &&str| line.contains(&format!(",{parameter},Factor,,"));
            let read = separated.lines().find(is_of).unwrap();
            let read: f64 = read.split(',').nth(4).unwrap().parse().unwrap();
            assert!(relative_error(read, factor) < 1e-9, "{read} {factor}");
            assert!(
                rows.contains(&format!(",1,{factor},")),
                "{parameter}: {rows}"
            );
            let three = Digits::Fixed(3).write(factor);
            assert!(
                bars.contains(&format!("</td><td>{three}")),
                "{parameter}: {bars}"
            );
        }
    }
}

#[test]
fn no_name_ends_the_script_or_a_tag() {
    let name = "</script><b a=\"x\">&amp;'@DATA@";
    let along = |row: usize| (Vector3::new(row as f64, 0.0, 0.0), Vector3::z());
    let subject = chain(name, &[0.9, 1.1, 0.95, 1.0], along);
    let page = report_page(&subject, &[], name, name).unwrap();
    assert!(is_well_formed(&page), "{page}");
    assert!(!page.contains("<b a"));
    assert_eq!(
        page.matches("<script>").count(),
        page.matches("</script>").count()
    );
    assert_eq!(data(&page)["modes"].as_array().map(Vec::len), Some(3));
}

/// Residuals at a sensor that measures the other way stand out.
#[test]
fn a_sensor_that_is_reversed_is_named_under_its_residuals() {
    let subject = chain("rod", &[1.0; 4], |row| {
        (Vector3::new(row as f64, 0.0, 0.0), Vector3::x())
    });
    let residuals = |mode: usize| ModeResiduals {
        mode,
        frequency: 0.5,
        shape: (0..4)
            .map(|row| if row == 2 { 20.0 } else { 1.0 })
            .collect(),
    };
    let map = residual_map(&Report {
        residuals: (1..=3).map(residuals).collect(),
        ..subject.clone()
    });
    assert!(
        map.contains("Largest over all modes: rod s2, 20.0 deviations RMS."),
        "{map}"
    );
    assert_eq!(residual_map(&subject), "");
}

/// Numbers can be read on every color of a cell, on light and on dark pages.
#[test]
fn numbers_have_a_contrast_of_four_and_a_half_on_every_cell_of_both_palettes() {
    let css = include_str!("../../src/present/page/report.css");
    let palettes = css.split("--ink: ").skip(1).collect_vec();
    assert_eq!(palettes.len(), 2);
    for palette in palettes {
        let palette = format!("--ink: {palette}");
        let color = |name: &str| {
            let (_, rest) = palette.split_once(&format!("--{name}: #")).unwrap();
            color(rest.split(';').next().unwrap())
        };
        for tone in ["plus", "minus"].map(color) {
            for step in 0..=60 {
                let part = f64::from(step) / 100.0;
                let page = color("page");
                let mixed = [0, 1, 2].map(|at| part * tone[at] + (1.0 - part) * page[at]);
                let contrast = contrast(color("ink"), mixed);
                assert!(contrast >= 4.5, "{tone:?} {step}: {contrast}");
            }
        }
    }
    assert_eq!(css.matches("calc(var(--v) * 60%)").count(), 2);
}

/// A real test of frequencies alone, of a model of matrices: nothing says where its lines are.
#[test]
fn what_has_no_lines_does_not_move() {
    let report = report("garteur");
    assert!(DrawnModes::from_report(&report).unwrap().is_none());
    assert_eq!(moving(&report).unwrap(), "");
}

/// Node runs the script as it stands in the page: the places that a reader sees are those of the program.
#[test]
#[ignore = "needs node"]
fn node_moves_every_structure_as_the_program_does() {
    let folder = new_folder();
    let path = folder.path().join("moving.js");
    fs::write(&path, SCRIPT).unwrap();
    for name in JOBS {
        let report = report(name);
        let drawn = DrawnModes::from_report(&report).unwrap().unwrap();
        let data = data(&moving(&report).unwrap());
        let stored = folder.path().join("data.json");
        fs::write(&stored, data.to_string()).unwrap();
        let program = format!(
            "const page = require({}), data = require({});\
             console.log(JSON.stringify(data.modes.map(mode => [0, 1, 2].map(state => {{\
               const moved = page.motion(mode, state, false);\
               return moved && page.displaced(data, moved, 90);\
             }}))))",
            json!(path),
            json!(stored)
        );
        let found = by_node(&program);
        let nodes = &drawn.frame.nodes;
        let extent = extents(nodes);
        let low = nodes
            .iter()
            .copied()
            .reduce(|low, node| low.inf(&node))
            .unwrap();
        let heights = data["heights"].as_f64().unwrap();
        let mut compared = 0;
        for (mode, found) in drawn.modes.iter().zip(found.as_array().unwrap()) {
            for state in 0..3 {
                for (node, motion) in mode.moved[state].iter().enumerate() {
                    let mut expected = (nodes[node] - low - 0.5 * extent) / extent.max();
                    expected.z *= heights;
                    expected += 0.125 * motion;
                    for axis in 0..3 {
                        let read = found[state][node][axis].as_f64().unwrap();
                        let off = (read - expected[axis]).abs();
                        assert!(off < DRAWN_THOUSANDTHS, "{name}: {read} {}", expected[axis]);
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 2 * 3 * nodes.len(), "{name}");
    }
}

/// The words of a page that a reader without scripts has.
#[test]
fn everything_but_the_motion_is_there_without_scripts() {
    let report = report("wing");
    let page = without_scripts(&report_page(&report, &[], "corfem", "").unwrap());
    for name in report
        .parameters
        .iter()
        .chain(report.sensors.iter().map(|sensor| &sensor.name))
    {
        assert!(page.contains(name.as_str()), "{name}");
    }
}
