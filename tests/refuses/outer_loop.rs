//! What the outer loop refuses, and the errors of others that it hands on.

use crate::prelude::*;

const TRUTH: [f64; 3] = [1.3, 0.8, 1.1];

/// Three springs at the given factors, beside the truth.
fn analyzed(factors: &[f64]) -> Result<ModalModel, Error> {
    let chain = Chain::uniform(3);
    chain.model(factors).analyze(&chain.modes(&TRUTH), None)
}

/// Three springs with the given analysis, bounds and a change of the default settings.
fn correlate_with(
    analyze: impl FnMut(&[f64]) -> Result<ModalModel, Error>,
    ranges: &[Option<Bounds>],
    change: impl Fn(&mut Settings),
) -> Result<Correlation, Error> {
    let mut settings = Settings::default();
    change(&mut settings);
    correlate(analyze, ranges, &settings, |_, _| true)
}

fn with_settings(change: impl Fn(&mut Settings)) -> Result<Correlation, Error> {
    correlate_with(analyzed, &[None; 3], change)
}

#[test]
fn tolerances_must_be_positive() {
    type Setter = fn(&mut Settings, f64);
    let setters: [(&str, Setter); 4] = [
        ("later_inner_tolerance", |settings, value| {
            settings.later_inner_tolerance = value
        }),
        ("error_sum_tolerance", |settings, value| {
            settings.error_sum_tolerance = value
        }),
        ("frequency_tolerance", |settings, value| {
            settings.frequency_tolerance = value
        }),
        ("shape_tolerance", |settings, value| {
            settings.shape_tolerance = value
        }),
    ];
    for (setting, set) in setters {
        for bad in [0.0, -0.1, f64::INFINITY, f64::NAN] {
            assert_eq!(
                said(with_settings(|settings| set(settings, bad))),
                format!("{setting} of the outer loop is {bad}; it must be positive and finite")
            );
        }
        assert!(with_settings(|settings| set(settings, 0.2)).is_ok());
    }
}

#[test]
fn settings_are_checked_before_any_analysis() {
    let result = correlate_with(
        |_| panic!("no analysis is needed to see that a setting is wrong"),
        &[None; 3],
        |settings| settings.shape_tolerance = -1.0,
    );
    assert_eq!(
        said(result),
        "shape_tolerance of the outer loop is -1; it must be positive and finite"
    );
}

#[test]
fn the_inner_loops_errors_are_handed_on() {
    let of = |change: fn(&mut Settings)| said(correlate_with(analyzed, &[None; 3], change));
    for (found, words) in [
        (
            of(|own| own.inner.relaxation = 0.0),
            "relaxation of the inner loop is 0; it must be positive and finite",
        ),
        (
            of(|own| own.inner.factor_range.lower = 9.0),
            "factor limits: 9 to 1.5 is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them",
        ),
    ] {
        assert_eq!(found, words);
    }
}

#[test]
fn errors_of_the_analysis_are_handed_on() {
    // At the start, and at the end of the first pass.
    for good in 0..2 {
        let mut analyses = 0;
        let result = correlate_with(
            |factors| {
                analyses += 1;
                if analyses > good {
                    Err(Error::no_convergence("the seventh analysis"))
                } else {
                    analyzed(factors)
                }
            },
            &[None; 3],
            |_| {},
        );
        assert_eq!(
            said(result),
            "the seventh analysis: the library's routine did not converge"
        );
        assert_eq!(analyses, good + 1);
    }
}

#[test]
fn there_must_be_bounds_or_none_for_every_parameter() {
    // One share fewer than entries, and one more.
    for (count, parameter_count) in [(3, 2), (2, 3)] {
        let result = correlate_with(
            |_| {
                let mut model = Chain::uniform(3).model(&[1.0; 3]);
                model.shares.truncate(parameter_count);
                model.analyze(&Chain::uniform(3).modes(&TRUTH), None)
            },
            &vec![None; count],
            |_| {},
        );
        assert_eq!(
            said(result),
            format!("parameter factors: {count} x 1 instead of {parameter_count} x 1")
        );
    }
}
