//! What the inner loop refuses before it takes a step.

use crate::prelude::*;

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

/// Uncoupled unit masses on springs of these rates, beside a test with squared frequencies half as high again.
fn uncoupled(springs: &[f64], share: ParameterMatrix) -> Box<dyn Analysis> {
    let (stiffness, mass) = (diagonal(springs), eye(springs.len()));
    let test = Modes::new(1.5 * stiffness.diagonal(), mass.clone()).unwrap();
    if let ParameterMatrix::Stiffness(share) = share {
        let shares = vec![share];
        let model = DynamicModel {
            stiffness,
            mass,
            shares,
        };
        return Box::new(model.analyze(&test, None).unwrap());
    }
    let (whole, sensors) = of_dense(&stiffness, &mass, &[share]).unwrap();
    let found = whole.analyze(&[1.0], &sensors, &test, by_sorting(), springs.len());
    Box::new(found.unwrap())
}

fn range(lower: f64, upper: f64) -> Bounds {
    Bounds { lower, upper }
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
        for bad in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            assert_eq!(
                said(with_settings(|settings| set(settings, bad))),
                format!("{setting} of the inner loop is {bad}; it must be positive and finite")
            );
        }
        assert!(with_settings(|settings| set(settings, 0.5)).is_ok());
    }
}

#[test]
fn limits_must_be_in_order() {
    for (lower, upper) in [(1.5, 0.55), (0.0, 1.5), (1.0, 1.0), (0.5, f64::INFINITY)] {
        let refused = with_settings(|settings| settings.factor_range = range(lower, upper));
        assert_eq!(
            said(refused),
            format!(
                "factor limits: {lower} to {upper} is no range; the lower limit must be positive, the upper one larger and finite, and the starting factor 1 between them"
            )
        );
    }
}

#[test]
fn lists_must_have_one_entry_a_parameter() {
    for (factors, limits, words) in [
        (1, 1, "parameter factors: 1 x 1 instead of 2 x 1"),
        (3, 3, "parameter factors: 3 x 1 instead of 2 x 1"),
        (1, 2, "parameter limits: 2 x 1 instead of 1 x 1"),
        (2, 0, "parameter limits: 0 x 1 instead of 2 x 1"),
        (2, 3, "parameter limits: 3 x 1 instead of 2 x 1"),
    ] {
        assert_eq!(
            said(run_with(&vec![1.0; factors], &vec![None; limits], |_| {})),
            words
        );
    }
}

#[test]
fn a_factor_of_an_earlier_pass_that_is_no_number_is_an_error() {
    assert_eq!(
        said(run_with(
            &[1.0, f64::NAN],
            &[None, Some(range(0.5, 2.0))],
            |_| {}
        )),
        "generalized stiffness change of entry (0, 0) is NaN; it must be a finite number"
    );
}

/// A thousandth of what a parameter has takes all stiffness, or more than all, from the mode, or brings one mode to another that it is coupled
/// with.
#[test]
fn a_share_of_which_no_difference_can_be_taken_is_refused() {
    let (coupled, heavy) = (
        dmatrix![500.0, 1.0; 1.0, 0.0],
        dmatrix![-1000.0 / 3.0, 1.0; 1.0, 0.0],
    );
    for (springs, share) in [
        (&[4.0][..], ParameterMatrix::Stiffness(dmatrix![-4000.0])),
        (&[4.0], ParameterMatrix::Stiffness(dmatrix![-8000.0])),
        (&[4.0], ParameterMatrix::Mass(dmatrix![-2000.0])),
        (&[1.0, 1.5], ParameterMatrix::Stiffness(coupled)),
        (&[1.0, 1.5], ParameterMatrix::Mass(heavy)),
    ] {
        let (problem, settings) = (uncoupled(springs, share), InnerSettings::default());
        let start = problem.at(&[1.0]).unwrap();
        for refused in [
            problem.error_changes(&start).map(drop),
            first_factors(&*problem, &settings).map(drop),
            run(&*problem, &[1.0], &[None], &settings).map(drop),
        ] {
            let is_named = match springs.len() {
                1 => matches!(refused, Err(Error::NotAVibration { mode: 0, .. })),
                _ => matches!(refused, Err(Error::CoalescingModes { .. })),
            };
            assert!(is_named, "{refused:?}");
        }
    }
}

#[test]
fn a_state_of_another_model_has_no_derivatives() {
    let three = chain_problem(&Chain::uniform(3), &[1.2, 0.8, 1.1]);
    let two = chain_problem(&Chain::uniform(2), &[1.2, 0.8]);
    let seen = SensorModel::from(&two);
    for (problem, expected) in [(&two as &dyn Analysis, "2 x 3"), (&seen, "2 x 2")] {
        assert!(problem.error_changes(two.exact()).is_ok());
        assert_eq!(
            said(problem.error_changes(three.exact())),
            format!("shapes of the state: 3 x 3 instead of {expected}")
        );
        let mut state = two.exact().clone();
        state.share_factors.push(1.0);
        assert_eq!(
            said(problem.error_changes(&state)),
            "parameter factors: 3 x 1 instead of 2 x 1"
        );
    }
}

/// Two neighbors that a change of mass couples more than they are apart: the recursion has no end, the eigensolution follows.
#[test]
fn a_change_of_mass_that_the_recursion_does_not_settle_on_is_refused() {
    let share = dmatrix![1.0, 0.9; 0.9, 1.0];
    let problem = uncoupled(&[1.0, 1.1], ParameterMatrix::Mass(share.clone()));
    let none = zero_square(2);
    let change = ModalChange::of_vibrations(&dvector![1.0, 1.1], none, 2.0 * share);
    assert!(eigensolution(&change).is_ok());
    let refused = problem.at(&[3.0]);
    assert!(
        matches!(
            refused,
            Err(Error::UnsettledRoots { .. } | Error::CoalescingModes { .. })
        ),
        "{refused:?}"
    );
}

/// An analysis that ends in an error of its own farther than a tenth from the exact modes.
struct Nearby(ModalModel);

impl Analysis for Nearby {
    fn exact(&self) -> &State {
        self.0.exact()
    }

    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        if factors.iter().any(|factor| (factor - 1.0).abs() > 0.1) {
            return Err(Error::no_convergence("the caller's analysis"));
        }
        self.0.at(factors)
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        self.0.error_changes(state)
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        self.0.stiffness_changes(state, gage_factors, rule)
    }
}

/// Only modes that come together, or a root that is lost, say that a step is too long. Of any other error the loop knows no cause, and a
/// shorter step that happens to escape it would hide it.
#[test]
fn an_error_that_no_shorter_step_explains_is_handed_on_at_once() {
    let problem = Nearby(chain_problem(&Chain::uniform(2), &[1.3, 0.7]));
    let by = |first_relaxation| {
        let settings = InnerSettings {
            first_relaxation,
            iterations: 1,
            ..InnerSettings::default()
        };
        let settings = inner_for_modes(settings, 2);
        run(&problem, &[1.0; 2], &[None; 2], &settings)
    };
    assert_eq!(
        said(by(0.8).map(drop)),
        "the caller's analysis: the library's routine did not converge"
    );
    // An eighth of the step is three halvings, which the loop may take.
    assert!(InnerSettings::default().halvings > 3);
    assert_eq!(by(0.1).unwrap().iterations.len(), 1);
}
