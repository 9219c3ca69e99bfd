//! The step and the tolerances mean the same whatever number of modes is compared, and the step that is halved is the one taken.

use crate::prelude::*;

/// A chain whose springs are one parameter, with a test of 1.1 times its stiffness: the first step over Newton's.
fn first_step_over_newtons(
    modes: usize,
    scaled: impl Fn(InnerSettings, usize) -> InnerSettings,
) -> f64 {
    let chain = Chain::uniform(modes);
    let whole = chain.model(&vec![1.0; modes]);
    let model = DynamicModel {
        shares: vec![whole.stiffness.clone()],
        ..whole
    };
    let test = solve(&(1.1 * &model.stiffness), &model.mass, modes).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    let settings = InnerSettings {
        first_relaxation: 1.0,
        iterations: 1,
        ..InnerSettings::default()
    };
    let run = run(&problem, &[1.0], &[None], &scaled(settings, modes)).unwrap();
    (run.iterations[0].unlimited_factors[0] - 1.0) / 0.1
}

#[test]
fn the_first_step_does_not_depend_on_how_many_modes_are_compared() {
    let of = |modes| first_step_over_newtons(modes, inner_for_modes);
    for modes in [1, 4, 16, 36, 64] {
        assert!(
            relative_error(of(modes), of(9)) < 1e3 * ROUND_OFF,
            "{modes}: {} for {}",
            of(modes),
            of(9)
        );
    }
    // With the paper's relaxation it grows with the square root of their number, and is the same for nine.
    let sum = |modes| first_step_over_newtons(modes, |settings, _| settings);
    assert_within(sum(64) / sum(16), 2.0, 1e3 * ROUND_OFF);
    assert!(relative_error(sum(9), of(9)) < ROUND_OFF);
}

/// The structure beside its own copy, every parameter in both: every test mode twice.
fn doubled(model: &DynamicModel) -> DynamicModel {
    let twice = |matrix: &DMatrix<f64>| {
        let size = matrix.nrows();
        let mut twice = DMatrix::zeros(2 * size, 2 * size);
        twice.view_mut((0, 0), (size, size)).copy_from(matrix);
        twice.view_mut((size, size), (size, size)).copy_from(matrix);
        twice
    };
    let shares = model.shares.iter().map(twice).collect();
    DynamicModel {
        stiffness: twice(&model.stiffness),
        mass: twice(&model.mass),
        shares,
    }
}

#[test]
fn doubling_every_test_mode_changes_neither_factors_nor_stop() {
    // Shapes are right here: each of the doubled ones has zeros at half of the DOF, which would halve their mean square.
    let chain = Chain::uniform(3);
    let one = chain.model(&[1.0; 3]);
    let one = DynamicModel {
        shares: vec![one.stiffness.clone()],
        ..one
    };
    let by = |model: &DynamicModel| {
        let test = both_copies(
            &solve(&(1.2 * &one.stiffness), &one.mass, 3).unwrap(),
            model.mass.nrows() / 3,
        );
        let problem = model.analyze(&test, None).unwrap();
        let settings = InnerSettings {
            step: StepRule::Own,
            ..InnerSettings::default()
        };
        let settings = inner_for_modes(settings, test.len());
        run(&problem, &[1.0], &[None], &settings).unwrap()
    };
    let (once, twice) = (by(&one), by(&doubled(&one)));
    assert_eq!(
        (once.stop, once.iterations.len()),
        (twice.stop, twice.iterations.len())
    );
    assert_eq!(once.stop, Stop::Tolerance);
    assert!(relative_error(once.gage_factors[0], twice.gage_factors[0]) < 1e4 * ROUND_OFF);
}

/// Modes of one structure as those of so many copies of it side by side.
fn both_copies(modes: &Modes, copies: usize) -> Modes {
    let (dof, count) = modes.shapes().shape();
    let mut shapes = DMatrix::zeros(copies * dof, copies * count);
    let mut frequencies = Vec::new();
    for copy in 0..copies {
        shapes
            .view_mut((copy * dof, copy * count), (dof, count))
            .copy_from(modes.shapes());
        frequencies.extend(modes.frequencies_hz());
    }
    Modes::from_measured(&frequencies, &shapes).unwrap()
}

#[test]
fn a_test_in_other_units_still_descends() {
    // Frequencies three times and 2π times the right ones: every element asks for far more than its bound.
    for (times, stated, below) in [(3.0, "1.82", 1.75), (2.0 * PI, "2.45", 2.40)] {
        let case = case_of(2);
        let model = case.model().unwrap();
        let test = case.test_modes().unwrap();
        let hz = test
            .frequencies_hz()
            .iter()
            .map(|hz| times * hz)
            .collect_vec();
        let test = Modes::from_measured(&hz, test.shapes()).unwrap();
        let settings = Settings {
            most_passes: 2,
            ..case.settings.clone()
        };
        let found = correlate(
            |factors| model.analyze(factors, &test, None),
            &[None; 15],
            &settings,
            |_, _| true,
        )
        .unwrap();
        let start = found.initial.errors.sum();
        let sums = found
            .passes
            .iter()
            .map(|pass| pass.inner.last.errors.sum())
            .collect_vec();
        assert_eq!(format!("{start:.2}"), stated);
        assert!(sums[0] < below && sums[0] < start, "{start} {sums:?}");
        assert!(found.passes[0].inner.iterations.len() > 1 && sums[1] <= sums[0]);
        assert!(!found.converged);
    }
}

#[test]
fn halvings_shorten_the_step_that_is_taken() {
    // However far the factor lies beyond its bound, each trial is half as long as the one before.
    let problem = first_problem(4);
    let settings = InnerSettings {
        step: StepRule::Own,
        iterations: 1,
        ..InnerSettings::default()
    };
    let run = run(&problem, &[1.0; 15], &[None; 15], &settings).unwrap();
    let record = &run.iterations[0];
    assert!(record.unlimited_factors[7] > 50.0);
    let expected = 1.0 + 0.5_f64.powi(record.halvings as i32 + 1);
    assert_within(record.gage_factors[7], expected, ROUND_OFF);
}
