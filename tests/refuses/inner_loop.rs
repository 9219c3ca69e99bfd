//! What the inner loop refuses before it takes a step.

use crate::common::assert_refused;
use crate::common::loops::chain_problem;
use crate::common::vibrations::Chain;
use corfem::method::derivatives::{DerivativeRule, by_definition, gradient};
use corfem::method::error::Error;
use corfem::method::inner_loop::{InnerRun, InnerSettings, first_factors, run};
use corfem::method::model::{Bounds, DynamicModel, ParameterMatrix};
use corfem::method::modes::ModeSet;
use corfem::method::state::{ModalState, UpdateRule};
use nalgebra::{dmatrix, dvector};

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

/// A thousandth of what a parameter has takes all stiffness, or more than all, from the mode.
#[test]
fn a_share_so_negative_that_no_difference_can_be_taken_is_refused() {
    let settings = InnerSettings {
        derivatives: DerivativeRule::Definition,
        ..InnerSettings::default()
    };
    for share in [
        ParameterMatrix::Stiffness(dmatrix![-4000.0]),
        ParameterMatrix::Stiffness(dmatrix![-8000.0]),
        ParameterMatrix::Mass(dmatrix![-2000.0]),
    ] {
        let model = DynamicModel {
            stiffness: dmatrix![4.0],
            mass: dmatrix![1.0],
            shares: vec![share],
        };
        let test = ModeSet::new(dvector![9.0], dmatrix![1.0]).expect("a mode");
        let problem = model.analyze(&test, None).expect("a problem");
        let refusals = [
            by_definition(&problem, &ModalState::start(&problem)).map(drop),
            first_factors(&problem, &settings).map(drop),
            run(&problem, &[1.0], &[None], &settings).map(drop),
        ];
        for refused in refusals {
            assert!(
                matches!(refused, Err(Error::LostRoot { mode: 0, .. })),
                "{refused:?}"
            );
        }
    }
}

/// A thousandth of what a parameter has brings one mode to another that it is coupled with.
#[test]
fn a_share_that_brings_modes_together_has_no_difference() {
    let stiffness = ParameterMatrix::Stiffness(dmatrix![500.0, 1.0; 1.0, 0.0]);
    let mass = ParameterMatrix::Mass(dmatrix![-1000.0 / 3.0, 1.0; 1.0, 0.0]);
    for share in [stiffness, mass] {
        let model = DynamicModel {
            stiffness: dmatrix![1.0, 0.0; 0.0, 1.5],
            mass: dmatrix![1.0, 0.0; 0.0, 1.0],
            shares: vec![share],
        };
        let test = ModeSet::new(dvector![1.0, 1.5], dmatrix![1.0, 0.0; 0.0, 1.0]).expect("modes");
        let problem = model.analyze(&test, None).expect("a problem");
        let refused = by_definition(&problem, &ModalState::start(&problem));
        assert!(
            matches!(refused, Err(Error::CoalescingModes { .. })),
            "{refused:?}"
        );
    }
}

#[test]
fn a_state_of_another_model_has_no_derivatives() {
    let three = chain_problem(&Chain::uniform(3), &[1.2, 0.8, 1.1]);
    let two = chain_problem(&Chain::uniform(2), &[1.2, 0.8]);
    for derivatives in [by_definition, gradient] {
        assert!(derivatives(&two, &ModalState::start(&two)).is_ok());
        let refused = derivatives(&two, &ModalState::start(&three));
        assert!(
            matches!(
                refused,
                Err(Error::WrongShape {
                    what: "parameter factors",
                    ..
                })
            ),
            "{refused:?}"
        );
    }
}

/// Two neighbors that a change of mass couples more than they are apart: the recursion has no end, the eigensolution follows.
#[test]
fn a_change_of_mass_that_the_recursion_does_not_settle_on_is_refused() {
    let model = DynamicModel {
        stiffness: dmatrix![1.0, 0.0; 0.0, 1.1],
        mass: dmatrix![1.0, 0.0; 0.0, 1.0],
        shares: vec![ParameterMatrix::Mass(dmatrix![1.0, 0.9; 0.9, 1.0])],
    };
    let test = ModeSet::new(dvector![1.0, 1.1], dmatrix![1.0, 0.0; 0.0, 1.0]).expect("modes");
    let problem = model.analyze(&test, None).expect("a problem");
    let at = |rule| ModalState::at(&problem, vec![3.0], rule);
    assert!(at(UpdateRule::Eigensolution).is_ok());
    let refused = at(UpdateRule::Recursive1);
    assert!(
        matches!(
            refused,
            Err(Error::UnsettledRoots { .. } | Error::CoalescingModes { .. })
        ),
        "{refused:?}"
    );
}
