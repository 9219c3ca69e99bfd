//! The step (13): factors from derivatives by every rule, and the bounds that limit them.

use crate::prelude::*;

/// A range around one, wide or narrow.
fn range() -> impl Strategy<Value = Bounds> {
    (0.1..0.99_f64, 1.01..10.0_f64).prop_map(|(lower, upper)| Bounds { lower, upper })
}

properties! {
    #[test]
    fn steps_are_in_proportion_to_relaxation_and_error_sum(
        // The stiffness of parameters is within a factor of a hundred of each other.
        (error, stiffness) in (-1e-3..1e-3_f64, 1e-5..1e-3_f64),
        error_sum in 0.01..1.0_f64,
        relaxation in 0.1..2.0_f64,
    ) {
        let unit = unlimited_factor(error, stiffness, 1.0, 1.0);
        let found = unlimited_factor(error, stiffness, error_sum, relaxation);
        let expected = relaxation * error_sum * (unit - 1.0);
        prop_assert!((found - 1.0 - expected).abs() <= ROUND_OFF * (1.0 + expected.abs()));
    }

    #[test]
    fn every_rule_goes_downhill((chain, truth) in chain_and_truth()) {
        let count = truth.len();
        let model = chain.model(&vec![1.0; count]).analyze(&chain.modes(&truth), None)?;
        let errors = model.error_changes(model.exact())?;
        for rule in StepRule::ALL {
            let factors = unlimited(&errors, &at_start(&model, rule), 0.3, 1.0);
            for (factor, change) in factors.iter().zip(&errors) {
                prop_assert!((factor - 1.0) * change <= 0.0, "{rule:?} {factor} {change}");
            }
        }
    }

    #[test]
    fn limits_hold(
        (total, place) in (0.2..5.0_f64, 0.001..0.999_f64),
        (unlimited, halvings) in (-3.0..6.0_f64, 0..6_i32),
        factor_range in range(),
        total_range in range(),
    ) {
        // Where the product so far lies within its range, as it does in the loops.
        let product = total_range.lower + place * (total_range.upper - total_range.lower);
        let base = product / total;
        let fraction = 0.5_f64.powi(halvings);
        let by = |range| limited_factor(unlimited, fraction, total, base, factor_range, range);
        let (free, next) = (by(None), by(Some(total_range)));
        let factor = next / total;
        prop_assert!(factor >= factor_range.lower * (1.0 - ROUND_OFF));
        prop_assert!(factor <= factor_range.upper * (1.0 + ROUND_OFF));
        prop_assert!(base * next >= total_range.lower * (1.0 - ROUND_OFF));
        prop_assert!(base * next <= total_range.upper * (1.0 + ROUND_OFF));
        if factor_range.contains(unlimited) {
            prop_assert_eq!(free, total * (1.0 + fraction * (unlimited - 1.0)));
        }
        if total_range.contains(base * free) {
            prop_assert_eq!(next, free);
        } else {
            let at_lower = (base * next / total_range.lower - 1.0).abs() <= ROUND_OFF;
            let at_upper = (base * next / total_range.upper - 1.0).abs() <= ROUND_OFF;
            prop_assert!(at_lower || at_upper);
        }
    }

    #[test]
    fn a_range_contains_what_lies_between_its_ends(range in range(), value in 0.0..12.0_f64) {
        prop_assert_eq!(range.contains(value), range.lower <= value && value <= range.upper);
        prop_assert!(range.contains(range.lower) && range.contains(range.upper));
    }
}

/// The changes at the start of an inner loop.
fn at_start(model: &ModalModel, rule: StepRule) -> Vec<f64> {
    model.stiffness_changes(model.exact(), &model.exact().share_factors, rule)
}

/// Factors of (13) of all parameters.
fn unlimited(errors: &[f64], stiffnesses: &[f64], error_sum: f64, relaxation: f64) -> Vec<f64> {
    let changes = errors.iter().zip(stiffnesses);
    changes
        .map(|(&error, &stiffness)| unlimited_factor(error, stiffness, error_sum, relaxation))
        .collect()
}

/// A model's state at factors on the stored stiffness, of which the changes of stiffness need nothing else.
fn state_at(model: &ModalModel, factors: &[f64]) -> State {
    State {
        share_factors: factors.to_vec(),
        ..model.exact().clone()
    }
}

/// Three parameters on two test modes: relative stiffnesses (3, 4), (6, 8) with a coupling, and none.
fn by_hand() -> (ModalModel, Vec<f64>) {
    let relative = [
        dmatrix![3.0, 1.0; 1.0, 4.0],
        dmatrix![6.0, 2.0; 2.0, 8.0],
        dmatrix![0.0, 0.0; 0.0, 0.0],
    ];
    // Test modes of ω = 2 and 4, powers of two, whose shapes are the unit vectors.
    let omega = dvector![2.0, 4.0];
    let share = |relative: DMatrix<f64>| relative.component_mul(&(&omega * omega.transpose()));
    let model = DynamicModel {
        stiffness: dmatrix![3.0, 0.0; 0.0, 14.0],
        mass: eye(2),
        shares: relative.map(share).to_vec(),
    };
    let test = Modes::new(dvector![4.0, 16.0], eye(2)).unwrap();
    let model = model.analyze(&test, None).unwrap();
    (model, vec![0.002, -0.001, 0.0])
}

fn factors_by_hand(error_sum: f64, relaxation: f64, rule: StepRule) -> Vec<f64> {
    let (model, errors) = by_hand();
    unlimited(&errors, &at_start(&model, rule), error_sum, relaxation)
}

fn assert_close(found: &[f64], expected: [f64; 3]) {
    assert_eq!(found.len(), 3);
    for (found, expected) in found.iter().zip(expected) {
        assert_within(found, expected, ROUND_OFF);
    }
}

#[test]
fn matrix_is_the_librarys_own_rule_by_hand() {
    // Δk is 0.001 times the roots of 9 + 16 + 1 + 1 and of 36 + 64 + 4 + 4.
    let (first, second) = (27_f64.sqrt(), 108_f64.sqrt());
    assert_close(
        &factors_by_hand(0.5, 0.8, StepRule::Matrix),
        [1.0 - 0.8 / first, 1.0 + 0.4 / second, 1.0],
    );
    assert_eq!(InnerSettings::default().step, StepRule::Matrix);
}

#[test]
fn own_is_the_diagonal_alone_by_hand() {
    // Δk is 0.005 and 0.010: 1 - 0.8 · 0.5 · 0.002/0.005 and 1 + 0.8 · 0.5 · 0.001/0.010.
    assert_close(&factors_by_hand(0.5, 0.8, StepRule::Own), [0.84, 1.04, 1.0]);
}

#[test]
fn relative_is_the_change_itself_by_hand() {
    // Δk is 0.001 for each, also for one that no mode feels.
    assert_close(
        &factors_by_hand(0.5, 0.8, StepRule::Relative),
        [0.2, 1.4, 1.0],
    );
}

#[test]
fn gage_is_in_hundredths_of_an_inch_by_hand() {
    let rods = spring_chain(&[0.02, 0.005, 0.01], [true, false]);
    let parameters = (1..=3)
        .map(|label| Parameter::new(label, &[label]))
        .collect();
    let identity = eye(3);
    let model = FiniteElementModel::new(rods, identity.clone(), identity, parameters).unwrap();
    let test = model.modes(&[1.0; 3]).unwrap();
    let model = model.analyze(&[1.0; 3], &test, None).unwrap();
    let changes = model.stiffness_changes(model.exact(), &[1.5, 1.0, 1.0], StepRule::Gage);
    assert_close(&changes, [0.003, 0.0005, 0.001]);
}

#[test]
fn changes_of_stiffness_follow_the_shares_and_changes_of_gage_the_gages() {
    let (model, _) = by_hand();
    let state = state_at(&model, &[2.0, 0.5, 1.0]);
    let by = |rule| model.stiffness_changes(&state, &[3.0, 3.0, 3.0], rule);
    let norm = 0.001 * 27_f64.sqrt();
    assert_close(&by(StepRule::Matrix), [2.0 * norm, norm, 0.0]);
    assert_close(&by(StepRule::Own), [0.010, 0.005, 0.0]);
    assert_close(&by(StepRule::Gage), [0.003, 0.003, 0.003]);
    assert_close(&by(StepRule::Relative), [0.001, 0.001, 0.001]);
}

#[test]
fn a_parameter_without_stiffness_keeps_one() {
    // Also when round-off gives it a derivative.
    for error in [1e-18, 0.0] {
        assert_eq!(unlimited_factor(error, 0.0, 0.5, 1.0), 1.0);
    }
}

#[test]
fn limits_by_hand() {
    let factor_range = Bounds {
        lower: 0.5,
        upper: 1.5,
    };
    let total_range = Some(Bounds {
        lower: 0.7,
        upper: 1.3,
    });
    for ((total, base, step, range), expected) in [
        // Nothing in the way, also at the very ends.
        ((1.2, 2.0, 1.25, None), 1.5),
        ((1.0, 1.0, 0.5, None), 0.5),
        ((1.0, 1.0, 1.5, None), 1.5),
        ((1.0, 1.0, 1.3, total_range), 1.3),
        ((1.0, 1.0, 0.7, total_range), 0.7),
        // One iteration's bounds, on the step and not on the product.
        ((2.0, 1.0, 3.0, None), 3.0),
        ((2.0, 1.0, -3.0, None), 1.0),
        // The total's bounds, on the product with the passes before.
        ((1.0, 1.0, 1.4, total_range), 1.3),
        ((1.0, 1.0, 0.6, total_range), 0.7),
        ((1.0, 0.5, 1.5, total_range), 1.5),
        ((2.0, 0.5, 1.5, total_range), 2.6),
        // Both: the total's has the last word.
        ((1.0, 1.0, 9.0, total_range), 1.3),
        ((1.0, 1.0, 0.1, total_range), 0.7),
        // The iteration's alone where the total's leaves room.
        ((0.8, 1.0, 9.0, total_range), 1.2000000000000002),
    ] {
        let found = limited_factor(step, 1.0, total, base, factor_range, range);
        assert_eq!(found, expected, "{total} {base} {step} {range:?}");
    }
}

#[test]
fn a_halving_shortens_the_limited_step() {
    // However far beyond the bound the unlimited factor lies: half of the step to 1.5, then a quarter.
    let factor_range = Bounds {
        lower: 0.5,
        upper: 1.5,
    };
    for unlimited in [1.6, 103.0, 1e9] {
        let by = |fraction| limited_factor(unlimited, fraction, 2.0, 1.0, factor_range, None);
        assert_eq!(by(1.0), 3.0);
        assert_eq!(by(0.5), 2.5);
        assert_eq!(by(0.25), 2.25);
    }
}

#[test]
fn changes_add_on_the_shares_while_gages_multiply() {
    // Three steps of one half more: 1 + 3/2 of the stored stiffness, while the gage is 1.5 cubed.
    let (mut share, mut gage) = (1.0, 1.0);
    for _ in 0..3 {
        let next = 1.5 * gage;
        share = next_share_factor(share, gage, next);
        gage = next;
    }
    assert_eq!((share, gage), (2.5, 3.375));
    // Steps of 0.45 less would leave nothing after the third.
    let down = (0..3).fold(1.0, |share, _| next_share_factor(share, 1.0, 0.55));
    assert_eq!(down, LEAST_SHARE);
    // What is left of a share may not be less than that, even where it is more than nothing.
    assert_eq!(next_share_factor(0.4504, 1.0, 0.55), LEAST_SHARE);
}

#[test]
fn crossed_ranges_do_not_panic() {
    let crossed = Bounds {
        lower: 2.0,
        upper: 1.0,
    };
    let next = limited_factor(1.5, 1.0, 1.0, 1.0, crossed, Some(crossed));
    assert!(next.is_finite());
}

#[test]
fn ranges_are_of_positive_finite_numbers_in_order() {
    let range = Bounds::positive("gage", 0.007, 0.013).unwrap();
    assert_eq!((range.lower, range.upper), (0.007, 0.013));
    for (low, high) in [
        (0.0, 1.0),
        (-1.0, 1.0),
        (1.0, 1.0),
        (2.0, 1.0),
        (1.0, f64::INFINITY),
    ] {
        assert_refused(
            Bounds::positive("gage", low, high),
            Error::Range {
                what: "gage".into(),
                lower: low,
                upper: high,
            },
        );
    }
    assert!(Bounds::positive("gage", f64::NAN, 1.0).is_err());
    assert!(Bounds::positive("gage", 0.5, f64::NAN).is_err());
}
