//! What the inner loop refuses before it takes a step.

use crate::common::assert_refused;
use crate::common::loops::chain_problem;
use crate::common::vibrations::Chain;
use corfem::method::error::Error;
use corfem::method::inner_loop::{InnerRun, InnerSettings, run};
use corfem::method::model::Bounds;

/// Two springs, the given lists, and the default settings with one change.
fn run_with(
    base: &[f64],
    total_ranges: &[Option<Bounds>],
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
        assert!(with_settings(|settings| set(settings, 0.5)).is_ok());
    }
}

#[test]
fn factor_limits_must_be_in_order() {
    for (low, high) in [(1.5, 0.55), (0.0, 1.5), (1.0, 1.0), (0.5, f64::INFINITY)] {
        let range = Bounds {
            lower: low,
            upper: high,
        };
        assert_refused(
            with_settings(|settings| settings.factor_range = range),
            Error::Limits {
                what: "factor limits".into(),
                lower: low,
                upper: high,
            },
        );
    }
}

#[test]
fn total_limits_must_be_in_order() {
    let crossed = Bounds {
        lower: 2.0,
        upper: 0.5,
    };
    assert_refused(
        run_with(&[1.0; 2], &[None, Some(crossed)], |_| {}),
        Error::Limits {
            what: "parameter limits".into(),
            lower: 2.0,
            upper: 0.5,
        },
    );
}

#[test]
fn lists_must_have_one_entry_a_parameter() {
    for (factors, limits, expected) in [
        (1, 2, ("parameter factors", 2, 1, 1, 1)),
        (3, 2, ("parameter factors", 2, 1, 3, 1)),
        (2, 0, ("parameter limits", 2, 1, 0, 1)),
        (2, 3, ("parameter limits", 2, 1, 3, 1)),
    ] {
        let (what, expected_rows, expected_columns, rows, columns) = expected;
        assert_refused(
            run_with(&vec![1.0; factors], &vec![None; limits], |_| {}),
            Error::WrongShape {
                what,
                expected_rows,
                expected_columns,
                rows,
                columns,
            },
        );
    }
}

#[test]
fn a_factor_of_an_earlier_pass_that_is_no_number_is_an_error() {
    let range = Some(Bounds {
        lower: 0.5,
        upper: 2.0,
    });
    assert!(matches!(
        run_with(&[1.0, f64::NAN], &[None, range], |_| {}),
        Err(Error::NotFinite { .. })
    ));
}
