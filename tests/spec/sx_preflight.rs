//! The pre-flight: mistakes made by hand on the box, the delta wing and a spring chain, and what is said of none.

use crate::prelude::*;

/// A structure before its correlation, without mistakes, whose test measures at every dynamic DOF.
#[derive(Debug, Clone)]
pub struct Specimen {
    pub name: String,
    pub model: DynamicModel,
    pub test: Modes,
}

fn specimen(known: Known) -> Specimen {
    Specimen {
        model: known.model.matrices(&vec![1.0; known.truth.len()]).unwrap(),
        name: known.name,
        test: known.test,
    }
}

pub fn case(number: usize) -> Specimen {
    specimen(Known::of_case(number))
}

/// Eight masses and eight springs in a row, held at one end, both less toward the other, with springs up to 30 % wrong.
pub fn chain() -> Specimen {
    let errors = [0.8, 1.25, 1.0, 0.75, 1.0, 1.3, 0.9, 1.0];
    let count = errors.len();
    let spring =
        |s: usize, error: f64| spring_stiffness(count, s, 1e6 * error * (1.0 - 0.08 * s as f64));
    let right: DMatrix<f64> = (0..count).map(|s| spring(s, 1.0)).sum();
    let wrong = (0..count).map(|s| spring(s, errors[s]));
    let mass = DVector::from_fn(count, |point, _| 1.0 - 0.06 * point as f64);
    let mass = DMatrix::from_diagonal(&mass);
    Specimen {
        name: "Spring chain".to_owned(),
        test: solve(&right, &mass, count).unwrap(),
        model: DynamicModel {
            stiffness: wrong.clone().sum(),
            mass,
            shares: wrong.collect(),
        },
    }
}

pub fn wing() -> Specimen {
    specimen(Known::delta_wing())
}

/// What a job's pre-flight finds with a sensor at every dynamic DOF.
pub fn findings(Specimen { model, test, .. }: &Specimen) -> Vec<Concern> {
    let modes = solve(&model.stiffness, &model.mass, model.mass.nrows()).unwrap();
    let shapes = modes.shapes();
    let share = |share| ParameterMatrix::Stiffness(shapes.tr_mul(&(share * shapes)));
    let seen = SeenModes {
        shares: model.shares.iter().map(share).collect(),
        modes,
    };
    preflight_at_sensors(&seen, (test, &[]), &Names::default()).unwrap()
}

/// Whether a concern is that of a change.
pub fn is_of(concern: &Concern, change: &Change) -> bool {
    concern.identifier == change.concern(0.0, &Names::default()).identifier
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

/// Behind every mode stands another of fifty times its frequency, whose shape is the same but for the sign of one sensor: by shapes alone
/// nobody could tell that sensor reversed from a test of the others.
#[test]
fn modes_far_off_in_frequency_do_not_explain_a_reversed_sensor() {
    let chain = chain();
    let model = &chain.model;
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
            false => 2500.0 * squares[mode - count],
        });
        let share = |share: &DMatrix<f64>| {
            let own = modes.shapes().tr_mul(&(share * modes.shapes()));
            ParameterMatrix::Stiffness(twice(&own, 2500.0))
        };
        let seen = SeenModes {
            shares: model.shares.iter().map(share).collect(),
            modes: Modes::new(squares, both).unwrap(),
        };
        let mut test = chain.test.clone();
        alter(&mut test, |_, shapes| shapes.row_mut(sensor).neg_mut());
        let found = preflight_at_sensors(&seen, (&test, &[]), &Names::default()).unwrap();
        let reversed = Change::Reversed(sensor);
        assert!(
            found.iter().any(|own| is_of(own, &reversed)),
            "{sensor}: {found:?}"
        );
    }
}
