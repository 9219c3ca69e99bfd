//! The report as one page: every table and figure in it, nothing needed beside it.

use crate::paper::figures::Figure;
use crate::paper::page::{Contents, page};
use crate::paper::tables::cases::{all_tables, frequency_table, summary};
use crate::paper::tables::fewer_modes::{published_tables, truncation_tables};
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

fn comparison_tables() -> Vec<Table> {
    let case = case_of(PUBLISHED_CASE);
    let mut tables = published_tables(&case, &published_runs(&case).unwrap()).unwrap();
    tables.extend(truncation_tables(fewer_modes_runs()));
    tables.retain(|table| !table.name.starts_with("truncation"));
    tables
}

#[test]
fn page_holds_every_table_number_by_number() {
    let html = html();
    let mut tables = all_tables(results()).unwrap();
    tables.extend(comparison_tables());
    for table in tables {
        assert_eq!(
            html.matches(&format!("<caption>{}</caption>", escaped(&table.title)))
                .count(),
            1,
            "{}",
            table.title
        );
        let start = html
            .find(&format!("<table id=\"{}\">", table.name))
            .unwrap();
        let text = &html[start..start + html[start..].find("</table>").unwrap()];
        assert_eq!(text.matches("<tr>").count(), table.rows.len() + 1);
        for row in &table.rows {
            let head = format!("<tr><th scope=\"row\">{}</th>", row.label);
            let mut cells = text
                .split(&head)
                .nth(1)
                .unwrap()
                .split("</tr>")
                .next()
                .unwrap()
                .split("</td>");
            for cell in &row.cells {
                let expected = match cell {
                    Cell::Blank => "<td>".to_owned(),
                    Cell::Text(text) | Cell::Printed(text) => format!("<td>{text}"),
                    Cell::Sentence(text) => format!("<td class=\"sentence\">{text}"),
                    Cell::Number {
                        computed,
                        published,
                        digits,
                    } => {
                        let mut text = format!("<td>{}", digits.write(*computed));
                        if let Some(paper) = published {
                            text += &format!(
                                " <span class=\"published\">({})</span>",
                                digits.write(*paper)
                            );
                        }
                        text
                    }
                };
                assert_eq!(
                    cells.next(),
                    Some(expected.as_str()),
                    "{}, row {}",
                    table.name,
                    row.label
                );
            }
        }
        for note in &table.notes {
            assert!(
                html.contains(&format!("<p class=\"note\">{}</p>", escaped(note))),
                "{note}"
            );
        }
    }
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
fn summary_says_so_when_a_case_does_not_converge() {
    let mut case = case_of(1);
    case.settings.inner.iterations = 1;
    let result = run_case(&case, |_, _| {}).unwrap();
    let table = summary(from_ref(&result)).unwrap();
    assert_eq!(
        table.rows[0].cells[5],
        Cell::Text("not converged".to_owned())
    );
    let html = page(&contents(&[result], &[])).unwrap();
    assert!(html.contains("did not converge within its limits"));
    assert!(!html.contains("Every case did what was asked"));
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
fn every_case_is_introduced_by_what_is_wrong_with_it() {
    let html = html();
    for heading in [
        "Case 1: every panel a shear panel, all half as thick again",
        "Case 2: membrane covers, all panels half as thick again",
        "Case 3: membrane covers, gages alternating 30 percent above and below",
        "Case 4: one cover a hundred times too thin by mistake",
    ] {
        assert_eq!(
            html.matches(&format!("<h2>{heading}</h2>")).count(),
            1,
            "{heading}"
        );
    }
}
