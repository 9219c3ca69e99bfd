//! The report as one page: every table and figure in it, nothing needed beside it.

use crate::paper::figures::Figure;
use crate::paper::page::{Contents, page};
use crate::prelude::*;
use crate::presentation::figures::{fewer_modes_runs, figures, results};

const COMMAND: &str = "corfem report --out <somewhere>";

fn contents<'a>(results: &'a [CaseResult], figures: &'a [Figure]) -> Contents<'a> {
    Contents {
        results,
        fewer_modes: fewer_modes_runs(),
        figures,
        command: COMMAND,
    }
}

pub fn html() -> String {
    page(&contents(results(), figures())).unwrap()
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
