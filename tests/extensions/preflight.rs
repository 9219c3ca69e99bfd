//! The pre-flight: mistakes made by hand on the box and a spring chain, and what is said of none.

use crate::prelude::*;

/// Eight masses and eight springs in a row, held at one end, both less toward the other, with springs up to 30 % wrong: the first model, and
/// the exact test.
pub fn chain() -> (DynamicModel, Modes) {
    let errors = [0.8, 1.25, 1.0, 0.75, 1.0, 1.3, 0.9, 1.0];
    let count = errors.len();
    let spring =
        |s: usize, error: f64| spring_stiffness(count, s, 1e6 * error * (1.0 - 0.08 * s as f64));
    let right: DMatrix<f64> = (0..count).map(|s| spring(s, 1.0)).sum();
    let wrong = (0..count).map(|s| spring(s, errors[s]));
    let mass = DVector::from_fn(count, |point, _| 1.0 - 0.06 * point as f64);
    let mass = DMatrix::from_diagonal(&mass);
    let test = solve(&right, &mass, count).unwrap();
    let stiffness = wrong.clone().sum();
    let shares = wrong.collect();
    (
        DynamicModel {
            stiffness,
            mass,
            shares,
        },
        test,
    )
}

/// Deviations that nobody declares.
pub const NONE: Noise = Noise {
    shape: 0.0,
    frequency: 0.0,
};

/// Names of sensors by their numbers.
pub fn numbered(sensors: usize) -> Vec<String> {
    (1..=sensors).map(|sensor| sensor.to_string()).collect()
}

#[test]
fn factors_are_what_they_are_called() {
    for (known, squared) in
        FACTORS
            .iter()
            .step_by(2)
            .zip([TAU.powi(2), 3600.0, 1000.0, 386.09, 9.81])
    {
        assert!(
            relative_error(known.0.powi(2), squared) < ROUND_OFF,
            "{}",
            known.1
        );
    }
    for pair in FACTORS.chunks(2) {
        assert_within(pair[0].0 * pair[1].0, 1.0, ROUND_OFF);
        assert_eq!(format!("1/{}", pair[0].1), pair[1].1);
    }
}

#[test]
fn the_loops_take_a_reversed_sensor_for_wrong_gages() {
    let case = case_of(2);
    let (model, mut test) = (case.model().unwrap(), case.test_modes().unwrap());
    alter(&mut test, |_, shapes| shapes.row_mut(6).neg_mut());
    let analyze = |factors: &[f64]| model.analyze(factors, &test, None);
    let run = correlate(
        analyze,
        &model.factor_ranges().unwrap(),
        &case.settings,
        |_, _| true,
    )
    .unwrap();
    let factors = &run.best_factors;
    assert!(!run.converged);
    assert!(
        factors.iter().any(|factor| *factor < 0.01) && factors.iter().any(|factor| *factor > 8.0),
        "{factors:?}"
    );
}

/// Behind every mode stands another of ten times its frequency, whose shape is the same but for the sign of one sensor: by shapes alone
/// nobody could tell that sensor reversed from a test of the others.
#[test]
fn modes_far_off_in_frequency_do_not_explain_a_reversed_sensor() {
    let (model, right) = chain();
    let count = model.mass.nrows();
    let modes = solve(&model.stiffness, &model.mass, count).unwrap();
    let twice = |matrix: &DMatrix<f64>, factor: f64| {
        let mut both = DMatrix::zeros(2 * count, 2 * count);
        both.view_mut((0, 0), (count, count)).copy_from(matrix);
        let mut other = both.view_mut((count, count), (count, count));
        other.copy_from(&(factor * matrix));
        both
    };
    for sensor in 0..count {
        let mut turned = modes.shapes().clone();
        turned.row_mut(sensor).neg_mut();
        let both = DMatrix::from_fn(count, 2 * count, |row, mode| match mode < count {
            true => modes.shapes()[(row, mode)],
            false => turned[(row, mode - count)],
        });
        let squares = modes.omega_squared();
        let squares = DVector::from_fn(2 * count, |mode, _| match mode < count {
            true => squares[mode],
            false => 100.0 * squares[mode - count],
        });
        let share = |share: &DMatrix<f64>| {
            let own = modes.shapes().tr_mul(&(share * modes.shapes()));
            ParameterMatrix::Stiffness(twice(&own, 100.0))
        };
        let seen = SeenModes {
            shares: model.shares.iter().map(share).collect(),
            modes: Modes::new(squares, both).unwrap(),
        };
        let mut test = right.clone();
        alter(&mut test, |_, shapes| shapes.row_mut(sensor).neg_mut());
        let noise = vec![NONE; count];
        let found =
            preflight_at_sensors(&seen, (&test, &noise), (&numbered(count), "test")).unwrap();
        let reversed = format!("reversed-{}", sensor + 1);
        assert!(
            found.iter().any(|own| own.identifier == reversed),
            "{sensor}: {found:?}"
        );
    }
}
