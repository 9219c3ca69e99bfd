//! Axes and numbers of the figures on other data than the four cases': what holds them, and how they are written.

use crate::common::drawings::words;
use crate::paper::figures::cover_gages::draw;
use crate::paper::figures::error_history::{self, PassHistory, error_history};
use crate::paper::figures::factors::{DrawnFactor, Factors};
use crate::paper::report::case_report;
use crate::presentation::figures::results;
use corfem::torque_box::Case;

#[test]
fn thin_gages_are_written_with_the_decimals_they_need() {
    let cases: Vec<Case> = (1..=4)
        .map(|case| Case::new(case).expect("a case"))
        .collect();
    let said = words(&draw(&cases).expect("drawn"));
    // Element 8 of Case 4 is a hundred times too thin; the others have 0.010 in.
    assert_eq!(said.iter().filter(|word| *word == "0.0001").count(), 1);
    assert!(said.iter().any(|word| word == "0.010"));
    assert!(!said.iter().any(|word| word == "0.0100" || word == "0.000"));
    let mut case = cases[0].clone();
    case.panels.iter_mut().for_each(|panel| panel.gage = 0.001);
    let thin = words(&draw(&[case]).expect("drawn"));
    assert_eq!(
        thin.iter().filter(|word| *word == "0.001").count(),
        6,
        "three decimals are enough"
    );
}

#[test]
fn error_axis_ends_at_the_ticks_around_the_errors() {
    let result = &results()[0];
    let history = error_history(&case_report(result).expect("a subject"));
    let ticks = |history: &[PassHistory]| -> Vec<f64> {
        let said = words(&error_history::draw("errors", "errors", history).expect("drawn"));
        // Numbers of the iterations are whole and follow one another; those of the errors are 1, 2 and 5 times tens.
        let numbers = said.iter().filter_map(|word| word.parse::<f64>().ok());
        numbers
            .filter(|number| [0.1, 0.2, 0.5, 10.0, 20.0, 50.0, 100.0].contains(number))
            .collect()
    };
    let moments = |history: &[PassHistory]| -> Vec<f64> {
        let passes = history.iter();
        let moments = passes.flat_map(|pass| pass.inner.iter().chain([&pass.check]));
        moments.map(|errors| errors.sum()).collect()
    };
    let largest = moments(&history).into_iter().fold(0.0, f64::max);
    // A tenth of room is left above the largest: with 45 % at 50, and 46 % at 100.
    for (wanted, last) in [(0.46, 100.0), (0.45, 50.0), (0.05, 10.0)] {
        let mut scaled = history.clone();
        for pass in &mut scaled {
            for errors in pass.inner.iter_mut().chain([&mut pass.check]) {
                errors.frequency *= wanted / largest;
                errors.shape *= wanted / largest;
            }
        }
        let found = ticks(&scaled);
        let highest = found.iter().copied().fold(0.0, f64::max);
        assert_eq!(highest, last, "{found:?}");
    }
}

#[test]
fn factor_axis_leaves_room_for_the_numbers() {
    let limits = results()[3].case.settings.inner.factor_range;
    let factor = |value: f64| DrawnFactor {
        name: "web".to_owned(),
        value,
        ..DrawnFactor::default()
    };
    for (values, lowest) in [
        ([-9.9, 50.0], -20.0),
        ([-5.0, 50.0], -10.0),
        ([-0.99, 5.0], -2.0),
    ] {
        let rows = values.map(factor).to_vec();
        let across = "factor".to_owned();
        let drawn = Factors {
            rows,
            limits: Some(limits),
            across,
            down: "parameter",
            origin: 1.0,
            decimals: 3,
            published: "",
        };
        let said = words(&drawn.draw("factors", "factors").expect("drawn"));
        let labels = said
            .iter()
            .filter(|word| !word.contains('.') || word.len() < 5);
        let labels = labels.filter_map(|word| word.replace('−', "-").parse::<f64>().ok());
        assert_eq!(labels.fold(0.0, f64::min), lowest, "{said:?}");
    }
}

/// What the legend shows is the color of the panels it speaks of.
#[test]
fn legend_of_the_gages_has_the_panels_colors() {
    let cases: Vec<Case> = (1..=4)
        .map(|case| Case::new(case).expect("a case"))
        .collect();
    let svg = draw(&cases).expect("drawn");
    // The fill of the last polygon before a word.
    let fill = |word: &str| {
        let before = &svg[..svg.find(word).expect("written")];
        let polygon = &before[before.rfind("<polygon").expect("drawn")..];
        polygon.split("fill=\"").nth(1).expect("a fill")[..7].to_owned()
    };
    assert_eq!(fill("thinner than in the test"), fill("0.0001"));
    assert_eq!(fill("thicker than in the test"), fill("0.015"));
    assert_eq!(fill("as in the test"), fill("0.010"));
    assert_ne!(fill("0.0001"), fill("0.015"));
}
