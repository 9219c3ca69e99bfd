//! What the outer loop refuses, and the errors of others that it hands on.

use crate::common::assert_refused;
use crate::common::vibrations::Chain;
use corfem::method::error::Error;
use corfem::method::model::{Bounds, ModalModel};
use corfem::method::outer_loop::{Correlation, Settings, correlate};

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
    correlate(analyze, ranges, &settings, |_, _| {})
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
        for bad in [0.0, -0.1, f64::INFINITY] {
            assert_refused(
                with_settings(|settings| set(settings, bad)),
                Error::Setting {
                    name: setting,
                    expected: "a positive finite number",
                    found: bad,
                },
            );
        }
        assert!(matches!(
            with_settings(|settings| set(settings, f64::NAN)),
            Err(Error::Setting { name, found, .. }) if name == setting && found.is_nan()
        ));
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
    assert!(matches!(
        result,
        Err(Error::Setting {
            name: "shape_tolerance",
            ..
        })
    ));
}

#[test]
fn the_inner_loops_errors_are_handed_on() {
    assert!(matches!(
        with_settings(|settings| settings.inner.relaxation = 0.0),
        Err(Error::Setting {
            name: "relaxation",
            ..
        })
    ));
    assert!(matches!(
        with_settings(|settings| settings.inner.factor_range.lower = 9.0),
        Err(Error::Limits { what, lower, .. }) if what == "factor limits" && lower == 9.0
    ));
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
                    Err(Error::ZeroLength(7.0))
                } else {
                    analyzed(factors)
                }
            },
            &[None; 3],
            |_| {},
        );
        match result {
            Err(Error::ZeroLength(length)) => assert_eq!(length, 7.0),
            other => panic!("{other:?}"),
        }
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
        match result {
            Err(Error::WrongShape {
                what,
                expected_rows,
                rows,
                ..
            }) => {
                assert_eq!(
                    (what, expected_rows, rows),
                    ("parameter factors", parameter_count, count)
                )
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn bounds_must_be_in_order() {
    let crossed = Some(Bounds {
        lower: 2.0,
        upper: 0.5,
    });
    let result = correlate_with(analyzed, &[None, None, crossed], |_| {});
    assert!(matches!(
        result,
        Err(Error::Limits { what, lower, upper })
            if (what.as_str(), lower, upper) == ("parameter limits", 2.0, 0.5)
    ));
}
