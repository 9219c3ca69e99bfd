//! The page of a job: its first screen, its moving structure, and that every view says the same.

use crate::common::jobs::loaded;
use crate::prelude::*;
use crate::presentation::subject::{chain, is_well_formed, without_scripts};
use corfem::present::page::charts::{factor_bars, residual_map};
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
