//! The page of a job: no name breaks it, and every view says the same.

use crate::common::jobs::loaded;
use crate::prelude::*;
use crate::presentation::subject::{chain, is_well_formed};
use corfem::present::page::charts::factor_bars;
use corfem::present::page::report_page;
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
            let mut rows_of = plain.lines().skip_while(|line| !line.is_empty());
            let row = rows_of.find(|line| line.starts_with(&format!("{parameter} ")));
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
