//! The report of a job: no name breaks its page, every view says the same, and a terminal has room for it.

use crate::common::jobs::unbroken;
use crate::prelude::*;
use crate::presentation::play::by_node;
use crate::presentation::subject::is_well_formed;
use corfem::present::page::report_page;
use corfem::present::render::WIDTH;
use corfem::present::table::separated;

const JOBS: [&str; 3] = ["box", "building", "wing"];

/// Text, CSV, JSON and page are views of one value.
#[test]
fn every_view_tells_the_same_factors_and_errors() {
    for name in JOBS {
        let report = report_of(worked(name));
        let document = serde_json::to_value(&report).unwrap();
        let (plain, page) = (text(&report.brief()), report_page(&report).unwrap());
        let rows = separated(&report.parameters);
        let mut rows = csv::Reader::from_reader(rows.as_bytes());
        let rows = rows.deserialize().map(Result::unwrap);
        let rows: Vec<BTreeMap<String, String>> = rows.collect();
        assert_eq!(document["answer"], report.answer);
        assert!(unbroken(&plain).starts_with(&report.answer), "{plain}");
        for (e, own) in report.parameters.iter().enumerate() {
            assert_eq!(document["parameters"][e]["factor"], own.factor);
            assert_eq!(rows[e]["factor"].parse(), Ok(own.factor));
            let four = Digits::Fixed(4).write(own.factor);
            let mut lines = plain.lines().skip_while(|line| !line.is_empty());
            let line = lines.find(|line| line.starts_with(&format!("{} ", own.parameter)));
            assert!(line.is_some_and(|line| line.contains(&four)), "{plain}");
            assert!(page.contains(&format!("<td>{four}</td>")), "{four}");
        }
    }
}

/// The law: the surest change stands first, and what the test hardly sees last.
#[test]
fn factors_stand_in_the_order_of_how_sure_their_changes_are() {
    for name in ["box", "garteur", "wing"] {
        let rows = report_of(worked(name)).surest;
        let key = |e: usize| rows[e].sureness.map_or(1.0, |own| -own as f32);
        assert!((1..rows.len()).all(|e| key(e - 1) <= key(e)), "{name}");
    }
}

/// The law: the answer to a job, its doubts, factors, modes and remarks have room on one page of a terminal.
#[test]
fn the_text_of_a_job_is_sixty_lines_of_eighty_columns() {
    let plain = text(&report_of(worked("garteur")).brief());
    assert!(plain.lines().count() <= 60, "{plain}");
    assert!(
        plain.lines().all(|line| line.chars().count() <= WIDTH),
        "{plain}"
    );
}

#[test]
fn no_name_ends_the_script_or_a_tag() {
    let name = "</script><b a='x'>&amp;@DATA@";
    let title = format!("title = \"{name}\"\n[model]");
    let files = rods_with("name = \"a\"", &format!("name = \"{name}\""));
    let files = with(files, "job.toml", "[model]", &title);
    let page = report_page(&report_of(&finished(&prepared(&files)))).unwrap();
    assert!(is_well_formed(&page), "{page}");
    assert!(!page.contains("<b a"));
    let both = ["<script>", "</script>"].map(|tag| page.matches(tag).count());
    assert_eq!(both[0], both[1]);
    // Node reads the report that charts are drawn from.
    let (_, rest) = page.split_once("<script>const report = ").unwrap();
    let (data, _) = rest.split_once(";</script>").unwrap();
    let found = by_node(&format!("console.log(JSON.stringify({data}))"));
    assert_eq!(found["parameters"][0]["parameter"], name);
    assert_eq!(found["modes"].as_array().map(Vec::len), Some(3));
}
