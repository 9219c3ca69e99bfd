//! The inner loop by hand: one spring, a step that is halved, a step that fails, and the three reasons to stop.

use crate::prelude::*;

/// One spring whose test structure has 0.81 of its stiffness: $e_S = 1/9$, and the step goes to $1 - R/20$.
fn one_spring() -> ModalModel {
    chain_problem(&Chain::uniform(1), &[0.81])
}

#[test]
fn one_spring_by_hand() {
    let settings = InnerSettings {
        first_relaxation: 2.0,
        iterations: 1,
        ..InnerSettings::default()
    };
    let run = run(&one_spring(), &[1.0], &[None], &settings).unwrap();
    assert_within(one_spring().exact().errors.sum(), 1.0 / 9.0, ROUND_OFF);
    // Δe = (√1.001 − 1)/0.9 and Δk = 0.001/0.81.
    let factor = 1.0 - 2.0 / 9.0 * (1.001_f64.sqrt() - 1.0) / 0.9 / (0.001 / 0.81);
    assert_within(
        run.iterations[0].unlimited_factors[0],
        factor,
        1e3 * ROUND_OFF,
    );
    assert_within(run.last.share_factors[0], factor, 1e3 * ROUND_OFF);
    assert_within(
        run.last.errors.sum(),
        factor.sqrt() / 0.9 - 1.0,
        1e3 * ROUND_OFF,
    );
    assert_eq!(run.stop, Stop::Iterations);
    assert_eq!(run.iterations[0].halvings, 0);
}

#[test]
fn relaxation_is_another_in_the_first_iteration() {
    let settings = InnerSettings {
        first_relaxation: 0.5,
        relaxation: 2.0,
        iterations: 2,
        ..InnerSettings::default()
    };
    let run = run(&one_spring(), &[1.0], &[None], &settings).unwrap();
    let step = |iteration: usize, error_sum: f64| {
        let record = &run.iterations[iteration];
        let change = record.error_changes[0];
        let stiffness = record.stiffness_changes[0];
        (1.0 - record.unlimited_factors[0]) * stiffness / (change * error_sum)
    };
    assert_within(
        step(0, one_spring().exact().errors.sum()),
        0.5,
        1e3 * ROUND_OFF,
    );
    assert_within(
        step(1, run.iterations[0].errors.sum()),
        2.0,
        1e3 * ROUND_OFF,
    );
}

#[test]
fn a_step_that_overshoots_is_halved() {
    // R = 12 asks for 0.4, bounded to 0.55, which is farther off than the start; half of that step, 0.775, is nearer.
    let settings = InnerSettings {
        first_relaxation: 12.0,
        iterations: 1,
        ..InnerSettings::default()
    };
    let run_with = |halvings| {
        let settings = InnerSettings {
            halvings,
            ..settings.clone()
        };
        run(&one_spring(), &[1.0], &[None], &settings).unwrap()
    };
    let run = run_with(1);
    assert_eq!(run.iterations[0].halvings, 1);
    assert_within(run.last.share_factors[0], 0.775, ROUND_OFF);
    assert_within(run.iterations[0].unlimited_factors[0], 0.4, FIRST_FACTOR);
    // Without halvings the place counts as a local minimum.
    let stuck = run_with(0);
    assert_eq!(stuck.stop, Stop::LocalMinimum);
    assert!(stuck.iterations.is_empty());
    assert_eq!(stuck.last.share_factors, [1.0]);
    let start = one_spring().exact().errors.sum();
    assert_within(stuck.last.errors.sum(), start, ROUND_OFF);
    let asked = first_factors(&one_spring(), &settings).unwrap();
    assert_eq!(run.iterations[0].unlimited_factors, asked);
}

#[test]
fn a_step_too_far_for_the_perturbation_is_halved() {
    // Springs of 2, 1/2 and 1 times: the whole step loses a root, half of it raises the error sum, a quarter is good.
    let problem = chain_problem(&Chain::uniform(3), &[2.0, 0.5, 1.0]);
    let wide = Bounds {
        lower: 0.05,
        upper: 20.0,
    };
    let settings = InnerSettings {
        first_relaxation: 4.0,
        factor_range: wide,
        iterations: 1,
        step: StepRule::Own,
        ..InnerSettings::default()
    };
    let settings = inner_for_modes(settings, 3);
    let run = run(&problem, &[1.0; 3], &[None; 3], &settings).unwrap();
    assert_eq!(run.iterations[0].halvings, 2);
    assert!(run.last.errors.sum() < problem.exact().errors.sum());
    let at = |fraction: f64| {
        let factors = run.iterations[0].unlimited_factors.iter();
        let factors = factors.map(|c| 1.0 + fraction * (c.clamp(0.05, 20.0) - 1.0));
        problem.at(&factors.collect_vec())
    };
    assert!(matches!(at(1.0), Err(Error::NotAVibration { mode: 2, .. })));
    assert!(at(0.5).unwrap().errors.sum() > problem.exact().errors.sum());
    assert_eq!(at(0.25).unwrap().errors, run.last.errors);
}

#[test]
fn a_step_beyond_stability_is_halved_by_eigensolutions_too() {
    // One mass on a spring of 300 with a destabilizing one of -200; the test has 81 where the model has 100.
    let model = DynamicModel {
        stiffness: dmatrix![100.0],
        mass: dmatrix![1.0],
        shares: vec![dmatrix![300.0], dmatrix![-200.0]],
    };
    let test = solve(&dmatrix![81.0], &model.mass, 1).unwrap();
    let problem = Eigensolved(model.analyze(&test, Some(1)).unwrap());
    let settings = InnerSettings {
        first_relaxation: 6.0,
        iterations: 1,
        ..InnerSettings::default()
    };
    let settings = inner_for_modes(settings, 1);
    let run = run(&problem, &[1.0; 2], &[None; 2], &settings).unwrap();
    let whole = problem.at(&run.iterations[0].unlimited_factors);
    assert!(matches!(whole, Err(Error::NotAVibration { mode: 0, .. })));
    assert!(run.iterations[0].halvings >= 1);
    assert!(run.last.errors.sum() < problem.exact().errors.sum());
}

#[test]
fn equal_modes_are_a_local_minimum() {
    let chain = Chain::uniform(3);
    let problem = chain_problem(&chain, &[1.0; 3]);
    let settings = inner_for_modes(InnerSettings::default(), 3);
    let run = run(&problem, &[1.0; 3], &[None; 3], &settings).unwrap();
    // A step is tried although the start is within tolerance; nothing lowers an error sum of nothing.
    assert_eq!(run.stop, Stop::LocalMinimum);
    assert!(run.iterations.is_empty());
    // The shapes are scaled once more with the model's mass: equal to round-off.
    assert!(problem.exact().errors.sum() <= ROUND_OFF);
    let asked = first_factors(&problem, &settings).unwrap();
    assert_eq!(asked.len(), 3);
    let farthest = asked.iter().map(|factor| (factor - 1.0).abs());
    assert!(farthest.largest() <= ROUND_OFF);
}

#[test]
fn a_start_within_tolerance_is_still_stepped_from_once() {
    let settings = InnerSettings {
        tolerance: 10.0,
        ..InnerSettings::default()
    };
    let run = run(&one_spring(), &[1.0], &[None], &settings).unwrap();
    assert_eq!(run.stop, Stop::Tolerance);
    assert_eq!(run.iterations.len(), 1);
}

#[test]
fn no_iterations_are_no_steps() {
    let settings = InnerSettings {
        iterations: 0,
        ..InnerSettings::default()
    };
    let run = run(&one_spring(), &[1.0], &[None], &settings).unwrap();
    assert_eq!(run.stop, Stop::Iterations);
    assert!(run.iterations.is_empty());
    assert_eq!(run.last.share_factors, [1.0]);
}

#[test]
fn the_box_stops_for_each_of_the_three_reasons() {
    let problem = first_problem(1);
    let run_with = |change: &dyn Fn(&mut InnerSettings)| {
        let mut settings = InnerSettings::default();
        change(&mut settings);
        run(&problem, &[1.0; 15], &[None; 15], &settings).unwrap()
    };
    let within = run_with(&|_| {});
    assert_eq!(within.stop, Stop::Tolerance);
    assert!(within.last.errors.sum() < 0.025);
    let cut_short = run_with(&|settings| settings.iterations = 3);
    assert_eq!(
        (cut_short.stop, cut_short.iterations.len()),
        (Stop::Iterations, 3)
    );
    assert_eq!(cut_short.last.errors, within.iterations[2].errors);
    let stuck = run_with(&|settings| {
        settings.tolerance = 1e-6;
        settings.iterations = 1000;
    });
    assert_eq!(stuck.stop, Stop::LocalMinimum);
    assert!(stuck.last.errors.sum() < within.last.errors.sum());
    assert_error_sum_only_falls(&problem, &stuck);
}

#[test]
fn the_default_settings_are_the_papers() {
    let settings = InnerSettings::default();
    assert_eq!((settings.first_relaxation, settings.relaxation), (0.8, 1.0));
    assert_eq!(
        (settings.factor_range.lower, settings.factor_range.upper),
        (0.55, 1.5)
    );
    assert_eq!(settings.tolerance, 0.025);
    assert_eq!((settings.halvings, settings.iterations), (5, 30));
}

#[test]
fn the_tolerance_itself_is_not_within_the_tolerance() {
    let to = |tolerance: f64| {
        let settings = InnerSettings {
            tolerance,
            iterations: 1,
            ..InnerSettings::default()
        };
        run(&one_spring(), &[1.0], &[None], &settings).unwrap()
    };
    let reached = to(1e-9).last.errors.sum();
    assert!(reached > 1e-9);
    assert_eq!(to(reached).stop, Stop::Iterations);
    assert_eq!(to(reached.next_up()).stop, Stop::Tolerance);
}
