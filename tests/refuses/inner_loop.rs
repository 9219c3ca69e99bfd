//! What the inner loop refuses before it takes a step.

use crate::common::loops::chain_problem;
use crate::common::vibrations::Chain;
use corfem::method::error::Error;
use corfem::method::inner_loop::{InnerRun, InnerSettings, run};
use corfem::method::model::Range;

/// Two springs, the given lists, and the default settings with one change.
fn run_with(
    base: &[f64],
    total_ranges: &[Option<Range>],
    change: impl Fn(&mut InnerSettings),
) -> Result<InnerRun, Error> {
    let mut settings = InnerSettings::default();
    change(&mut settings);
    let problem = chain_problem(&Chain::uniform(2), &[1.2, 0.8]);
    run(&problem, base, total_ranges, &settings)
}

fn with_settings(change: impl Fn(&mut InnerSettings)) -> Result<InnerRun, Error> {
    run_with(&[1.0; 2], &[None; 2], change)
}

#[test]
fn relaxations_and_tolerance_must_be_positive() {
    type Setter = fn(&mut InnerSettings, f64);
    let setters: [(&str, Setter); 3] = [
        ("first_relaxation", |settings, value| {
            settings.first_relaxation = value
        }),
        ("relaxation", |settings, value| settings.relaxation = value),
        ("tolerance", |settings, value| settings.tolerance = value),
    ];
    for (setting, set) in setters {
        for bad in [0.0, -1.0, f64::INFINITY] {
            match with_settings(|settings| set(settings, bad)) {
                Err(Error::Setting {
                    name,
                    expected,
                    found,
                }) => {
                    assert_eq!(
                        (name, expected, found),
                        (setting, "a positive finite number", bad)
                    )
                }
                other => panic!("{other:?}"),
            }
        }
        assert!(matches!(
            with_settings(|settings| set(settings, f64::NAN)),
            Err(Error::Setting { name, found, .. }) if name == setting && found.is_nan()
        ));
        assert!(with_settings(|settings| set(settings, 0.5)).is_ok());
    }
}

#[test]
fn factor_limits_must_be_in_order() {
    for (low, high) in [(1.5, 0.55), (0.0, 1.5), (1.0, 1.0), (0.5, f64::INFINITY)] {
        let range = Range {
            lower: low,
            upper: high,
        };
        match with_settings(|settings| settings.factor_range = range) {
            Err(Error::Limits { what, lower, upper }) => {
                assert_eq!((what.as_str(), lower, upper), ("factor limits", low, high));
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn total_limits_must_be_in_order() {
    let crossed = Range {
        lower: 2.0,
        upper: 0.5,
    };
    match run_with(&[1.0; 2], &[None, Some(crossed)], |_| {}) {
        Err(Error::Limits { what, lower, upper }) => {
            assert_eq!(
                (what.as_str(), lower, upper),
                ("parameter limits", 2.0, 0.5)
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn lists_must_have_one_entry_a_parameter() {
    for (factors, limits, expected) in [
        (1, 2, ("parameter factors", 2, 1, 1, 1)),
        (3, 2, ("parameter factors", 2, 1, 3, 1)),
        (2, 0, ("parameter limits", 2, 1, 0, 1)),
        (2, 3, ("parameter limits", 2, 1, 3, 1)),
    ] {
        match run_with(&vec![1.0; factors], &vec![None; limits], |_| {}) {
            Err(Error::WrongShape {
                what,
                expected_rows,
                expected_columns,
                rows,
                columns,
            }) => {
                assert_eq!(
                    (what, expected_rows, expected_columns, rows, columns),
                    expected
                )
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_factor_of_an_earlier_pass_that_is_no_number_is_an_error() {
    let range = Some(Range {
        lower: 0.5,
        upper: 2.0,
    });
    assert!(matches!(
        run_with(&[1.0, f64::NAN], &[None, range], |_| {}),
        Err(Error::NotFinite { .. })
    ));
}
