//! The report as one page: every table and figure in it, nothing needed beside it.

use crate::paper::figures::Figure;
use crate::paper::page::{Contents, page};
use crate::paper::tables::cases::{frequency_table, summary};
use crate::prelude::*;
use crate::presentation::figures::{fewer_modes_runs, figures, results};
use crate::presentation::subject::is_well_formed;

const COMMAND: &str = "corfem report --out <somewhere>";

fn contents<'a>(results: &'a [CaseResult], figures: &'a [Figure]) -> Contents<'a> {
    Contents {
        results,
        fewer_modes: fewer_modes_runs(),
        figures,
        command: COMMAND,
    }
}

/// A text as it stands in HTML.
fn escaped(text: &str) -> String {
    text.replace('>', "&gt;")
}

pub fn html() -> String {
    page(&contents(results(), figures())).unwrap()
}

#[test]
fn summary_repeats_the_first_and_last_errors() {
    let table = summary(results()).unwrap();
    assert_eq!(table.rows.len(), 4);
    for (row, result) in table.rows.iter().zip(results()) {
        let full = frequency_table(result).unwrap();
        for (at, label) in [(0, "frequency RMS"), (2, "shape RMS")] {
            let errors = full.rows.iter().find(|row| row.label == label).unwrap();
            let ends = [&errors.cells[2], errors.cells.last().unwrap()];
            assert_eq!([&row.cells[at], &row.cells[at + 1]], ends);
        }
    }
}

#[test]
fn page_needs_nothing_beside_it() {
    let html = html().replace("http://www.w3.org/2000/svg", "");
    for outside in [
        "http:", "https:", "src=", "<link", "<script ", "@import", "url(",
    ] {
        assert!(!html.contains(outside), "{outside}");
    }
    assert_eq!(
        html.matches("href=").count(),
        html.matches("href=\"#").count()
    );
    for Figure { name, caption, svg } in figures() {
        assert_eq!(html.matches(&format!("<figure id=\"{name}\">")).count(), 1);
        let svg = svg.replace("http://www.w3.org/2000/svg", "");
        assert!(html.contains(&svg), "{name}");
        let caption = format!("{}</figcaption>", escaped(caption));
        assert!(html.contains(&caption), "{caption}");
    }
    assert!(html.contains("name=\"viewport\"") && html.contains("@media print"));
}

#[test]
fn page_says_what_made_it_what_was_assumed_and_how_well_the_box_fits() {
    let html = html();
    assert!(html.contains("<code>corfem report --out &lt;somewhere&gt;</code>"));
    assert!(html.contains(&format!(
        "corfem {}, by the command",
        env!("CARGO_PKG_VERSION")
    )));
    assert!(html.contains("1.106 % RMS, 5.20 % at worst"));
    assert!(html.contains("Case 4: element 8 asks for 58.4 times its stiffness"));
    assert!(html.contains("Every case did what was asked of it"));
    assert!(
        html.contains(
            "Of the paper's tables, here are 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13; corfem tables prints Table 1"
        )
    );
    // The texts of paper/, as HTML: the table of assumptions, the list of differences, its headings a level lower.
    assert!(
        html.contains("<td>rods 16 to 39</td>")
            && html.contains("<strong>Initial errors.</strong>")
    );
    assert!(html.contains("<h3>Passes and tolerances</h3>"));
    assert!(!html.contains("Where the results differ from the published ones, and why</h1>"));
    assert!(
        !html.contains("How it was found"),
        "of the box's story only the assumptions"
    );
    assert!(
        !html.contains("<h3>Where the results differ"),
        "its title is the section's"
    );
}

#[test]
fn every_link_leads_somewhere_and_every_tag_is_closed() {
    let html = html();
    for link in html.split("href=\"#").skip(1) {
        let id = link.split('"').next().unwrap();
        assert_eq!(html.matches(&format!(" id=\"{id}\"")).count(), 1, "{id}");
    }
    assert!(is_well_formed(&html));
}

#[test]
fn the_method_has_its_flow_and_five_equations() {
    let html = html();
    let (_, method) = html.split_once("<section id=\"story-method\"").unwrap();
    let (method, _) = method.split_once("<section").unwrap();
    assert_eq!(method.matches("<li>").count(), 6);
    for number in ["(1, 2)", "(4)", "(5, 6)", "(7, 8)", "(12, 13)"] {
        let mut rows = method.split("<tr>");
        let row = rows.find(|row| row.contains(number)).unwrap();
        assert!(row.contains("<math>"), "{number}");
    }
}
