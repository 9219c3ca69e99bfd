//! Models without condensation, correlated at the sensors alone.

use crate::prelude::*;

/// A mode that moves no sensor resembles no test mode; that is no reason to refuse the analysis. Where a test mode must answer it there are
/// too few modes; shapes at other sensors have no distance.
#[test]
fn a_mode_that_no_sensor_sees_is_like_no_test_mode() {
    let (model, sensors) = apart();
    let analyze = |modes: usize, squares: DVector<f64>, shapes: DMatrix<f64>| {
        let test = Modes::new(squares, shapes).unwrap();
        model.analyze(&[1.0], &sensors, &test, by_sorting(), modes)
    };
    let found = analyze(1, dvector![1.2], eye(1)).unwrap();
    assert_eq!(found.exact().modes.len(), 1, "the other takes no part");
    // Whichever of the two springs is the stiffer.
    for factor in [1.0, 1.3, 9.0] {
        let state = found.at(&[factor]).unwrap();
        assert_eq!(state.pairing.analysis_mode, [0], "{factor}");
    }
    let two = dvector![1.2, 4.4];
    for (modes, shapes, words) in [
        (2, dmatrix![1.0, 1.0], "modes of finite frequency: 2 given"),
        (1, eye(2), "mode shapes: 2 x "),
    ] {
        let said = said(analyze(modes, two.clone(), shapes).map(drop));
        assert!(said.starts_with(words), "{said}");
    }
}

/// Two masses on a spring, whose rigid-body motion a change of mass beyond nothing would leave with a negative one.
#[test]
fn a_state_in_which_rigid_body_modes_have_no_mass_is_refused() {
    let parameter = whole_parameter("both", WholeShare::Mass(masses(&[1.0; 2])));
    let spring = springs(2, &[(1, Some(0), 1.0)]);
    let model = WholeModel::new(spring, masses(&[1.0; 2]), vec![parameter]).unwrap();
    let test = Modes::new(dvector![2.0], dmatrix![1.0; -1.0]).unwrap();
    let sensors = sensors_at(&[0, 1], 2);
    let free = model.analyze(&[1.0], &sensors, &test, by_sorting(), 1);
    let free = free.unwrap();
    assert!(free.at(&[2.0]).is_ok());
    let said = said(free.at(&[-1.0]).map(drop));
    assert!(
        said.starts_with("mass of the rigid-body modes is not positive definite"),
        "{said}"
    );
}

/// The share of one matrix in the modes of a building of three stories, and its congruence.
fn share_and_congruence(matrix: DMatrix<f64>) -> [DMatrix<f64>; 2] {
    let parameter = whole_parameter("a share", WholeShare::Stiffness(sparse(&matrix).unwrap()));
    let stories = [(0, None, 3.0), (1, Some(0), 2.0), (2, Some(1), 1.0)];
    let model = WholeModel::new(springs(3, &stories), masses(&[1.0; 3]), vec![parameter]).unwrap();
    let test = model.modes(&[1.0], 3).unwrap().vibrations;
    let sensors = sensors_at(&[0, 1, 2], 3);
    let found = model.analyze(&[1.0], &sensors, &test, by_sorting(), 3);
    let found = found.unwrap();
    let shapes = found.exact().modes.shapes();
    let congruence = shapes.tr_mul(&(matrix * shapes));
    [found.shares()[0].matrix().clone(), congruence]
}

properties! {
    /// An element's share needs no theory of elasticity: any symmetric matrix gives its congruence, in any unit.
    #[test]
    fn the_share_of_any_matrix_is_its_congruence(unit in symmetric(3), decades in -12..=12_i32) {
        let unit = unit * 10.0_f64.powi(decades);
        let [share, congruence] = share_and_congruence(unit.clone());
        prop_assert!((share - congruence).amax() <= MATRIX_ROUND_OFF * unit.amax());
    }
}

/// On test shapes that are those of the modes but for their signs a share is as on these, relative to the test's frequencies.
#[test]
fn a_share_on_the_test_shapes_is_that_on_their_modes() {
    let model = shear_building(&[3.0, 2.0, 1.0], 1.0, None);
    let (sensors, turns) = (sensors_at(&[0, 1, 2], 3), [1.0, -1.0, -1.0]);
    let whole = model.modes(&[1.0; 3], 3).unwrap().vibrations;
    let turned = whole.shapes() * DMatrix::from_diagonal(&turns.to_vec().into());
    let test = Modes::new(whole.omega_squared().clone(), turned).unwrap();
    let found = model
        .analyze(&[1.0; 3], &sensors, &test, by_sorting(), 3)
        .unwrap();
    let modes = found.exact().modes.shapes();
    let sign = |j: usize| modes.column(j).dot(&test.shapes().column(j)).signum();
    let signs = [0, 1, 2].map(sign);
    assert!(signs.contains(&1.0) && signs.contains(&-1.0));
    let omega = whole.omega_squared().map(f64::sqrt);
    for rule in [StepRule::Matrix, StepRule::Own] {
        let changes = found.stiffness_changes(found.exact(), &[1.0; 3], rule);
        for (share, change) in found.shares().iter().zip(changes) {
            let relative = |j: usize, k: usize| share.matrix()[(j, k)] / (omega[j] * omega[k]);
            let expected =
                DERIVATIVE_STEP * rule.measure(&DMatrix::from_fn(3, 3, relative), 1.0, 1.0);
            assert_within(change, expected, MATRIX_ROUND_OFF * expected);
        }
    }
}

/// Two vibrations of three free masses, whose rigid-body motion a change of the first mass mixes into both. The difference is off by
/// something like its own step, from the slope of the error sum of analyses with a little more and less of the mass.
#[test]
fn the_error_change_by_a_mass_of_a_free_structure_is_near_its_limit() {
    let parameter = whole_parameter("first", WholeShare::Mass(masses(&[1.0, 0.0, 0.0])));
    let between = springs(3, &[(1, Some(0), 1.0), (2, Some(1), 2.0)]);
    let model = WholeModel::new(between, masses(&[1.0, 2.0, 1.5]), vec![parameter]).unwrap();
    let sensors = sensors_at(&[0, 1, 2], 3);
    let test = model.modes(&[1.5], 2).unwrap().vibrations;
    let test = seen_by(&sensors, &test);
    let free = |factor: f64| {
        let size = 2;
        let found = model.analyze(&[factor], &sensors, &test, by_sorting(), size);
        found.unwrap()
    };
    let first = free(1.0);
    let state = first.at(&[1.0]).unwrap();
    let difference = first.error_changes(&state).unwrap()[0];
    const STEP: f64 = 1e-4;
    let [more, less] = [STEP, -STEP].map(|step| free(1.0 + step).exact().errors.sum());
    let size = DERIVATIVE_STEP * (more - less) / (2.0 * STEP);
    assert!(
        relative_error(difference, size) <= 10.0 * DERIVATIVE_STEP,
        "{difference:e} {size:e}"
    );
}

/// Five of ten floors measured on an exact building: condensation alone would raise its frequencies by percents.
#[test]
fn five_of_ten_floors_recover_every_story_without_condensation() {
    let (model, sensors, test) = five_of_ten();
    assert_recovered(&model, &sensors, &test, &STORIES);
}

#[test]
fn a_factor_scales_its_own_share_of_stiffness_or_mass() {
    let (wall, between) = ((0, None, 5.0), (1, Some(0), 7.0));
    let parameter = |name: &str, share| whole_parameter(name, share);
    let parameters = vec![
        parameter("wall", WholeShare::Stiffness(springs(2, &[wall]))),
        parameter("tip", WholeShare::Mass(masses(&[0.0, 3.0]))),
    ];
    let model = WholeModel::new(
        springs(2, &[wall, between]),
        masses(&[2.0, 4.0]),
        parameters,
    )
    .unwrap();
    let (stiffness, mass) = model.at(&[2.0, 0.5]).unwrap();
    assert_eq!(
        stiffness.dense(),
        springs(2, &[(0, None, 10.0), between]).dense()
    );
    assert_eq!(mass.dense(), masses(&[2.0, 2.5]).dense());
}

/// Test shapes of any scale are brought to that of the modes they answer: the difference has no part of the shape, and whatever
/// factors they came with are gone but for their signs.
#[test]
fn test_shapes_at_sensors_are_scaled_to_their_modes() {
    let (model, sensors, test) = five_of_ten();
    let scales = [3.0, -0.2, 1.0e3, -1.0, 0.01];
    let mut other = test.clone();
    alter(&mut other, |_, shapes| *shapes *= diagonal(scales));
    let [first, other] = [&test, &other].map(|test| {
        let found = model.analyze(&[1.0; 10], &sensors, test, by_sorting(), 10);
        found.unwrap()
    });
    let State { modes, pairing, .. } = first.exact();
    for (j, scale) in scales.iter().enumerate() {
        let shape = first.test().shapes().column(j);
        let mode = pairing.sign[j] * modes.shapes().column(pairing.analysis_mode[j]);
        assert!((&mode - shape).dot(&shape).abs() < ROUND_OFF * shape.norm_squared());
        let off = other.test().shapes().column(j) - scale.signum() * shape;
        assert!(off.norm() < ROUND_OFF * shape.norm());
    }
}

/// The torque box of Case 2 as whole matrices: its condensed analysis is the finite element model's own. Its mass is at the sensors alone, so
/// that nothing is condensed and the whole model has the same.
#[test]
fn the_condensed_analysis_of_the_box_is_that_of_the_method() {
    let case = case_of(2);
    let (model, test) = (case.model().unwrap(), case.test_modes().unwrap());
    let (whole, sensors) = whole::of(&model).unwrap();
    let factors = (0..15).map(|e| 0.8 + 0.03 * e as f64).collect_vec();
    let expected = model.analyze(&factors, &test, None).unwrap();
    let found = analyze_condensed(&whole, &factors, &sensors, &test, None).unwrap();
    let at_sensors = whole.analyze(&factors, &sensors, &test, by_sorting(), 9);
    let at_sensors = at_sensors.unwrap();
    for state in [found.exact(), at_sensors.exact()] {
        assert_alike(paired_hz(state), paired_hz(expected.exact()), SAME_ANALYSIS);
        assert_alike(
            [state.errors.sum()],
            [expected.exact().errors.sum()],
            SAME_ANALYSIS,
        );
    }
    let shares = found.shares().iter().zip(at_sensors.shares());
    for ((own, seen), expected) in shares.zip(expected.shares()) {
        let bar = SAME_ANALYSIS * expected.amax();
        assert!((own - expected).amax() < bar);
        assert!((seen.matrix().abs() - expected.abs()).amax() < bar);
    }
}

/// A free chain, as hung in soft cords: its rigid-body mode is found, counted, and kept out of the correlation.
#[test]
fn a_free_chain_is_corrected_without_its_rigid_body_mode() {
    const COUNT: usize = 12;
    let truth: [f64; COUNT - 1] = std::array::from_fn(|e| [1.0, 0.8, 1.15, 1.0, 0.9][e % 5]);
    let spring = |e: usize| (e + 1, Some(e), 1.0e5);
    let all = (0..COUNT - 1).map(spring).collect_vec();
    let share = |e: usize| WholeShare::Stiffness(springs(COUNT, &[spring(e)]));
    let parameters = (0..COUNT - 1).map(|e| whole_parameter(e, share(e)));
    let mass = (0..COUNT)
        .map(|row| 1.0 + 0.1 * (row % 3) as f64)
        .collect_vec();
    let model = WholeModel::new(springs(COUNT, &all), masses(&mass), parameters.collect());
    let model = model.unwrap();
    let real = model.modes(&truth, 8).unwrap();
    assert_eq!(real.rigid_body.ncols(), 1);
    let sensors = sensors_at(&(0..COUNT).collect_vec(), COUNT);
    assert_recovered(&model, &sensors, &real.vibrations, &truth);
}

/// Tolerances of a test without noise.
fn fine_settings() -> Settings {
    let inner = InnerSettings {
        tolerance: 5e-4,
        ..InnerSettings::default()
    };
    Settings {
        inner,
        later_inner_tolerance: 5e-4,
        error_sum_tolerance: 1e-3,
        most_passes: 30,
        ..Settings::default()
    }
}

#[test]
fn what_is_wrong_with_a_whole_model_is_named() {
    let held = springs(3, &[(0, None, 1.0), (1, Some(0), 1.0), (2, Some(1), 1.0)]);
    let new = |mass: &[f64], share: &SparseMatrix| {
        let parameter = whole_parameter("all", WholeShare::Stiffness(share.clone()));
        WholeModel::new(held.clone(), masses(mass), vec![parameter])
    };
    let model = new(&[1.0; 3], &held).unwrap();
    let lopsided = SparseMatrix::new("stiffness", 3, 3, vec![(0, 1, 1.0)]).unwrap();
    let all = (1..199).map(|row| (row, Some(row - 1), 1.0)).collect_vec();
    let mut values = vec![1.0; 200];
    values[199] = 0.0;
    let modes = |factors: &[f64], count| said(model.modes(factors, count).map(drop));
    for (said, words) in [
        (
            said(new(&[1.0; 2], &held).map(drop)),
            "mass: 2 x 1 instead of 3 x 1",
        ),
        (
            said(new(&[1.0; 3], &lopsided).map(drop)),
            "relative difference of stiffness of a parameter, entry (1, 0) beside its mirror",
        ),
        (modes(&[0.0], 1), "factor of "),
        (modes(&[1.0, 1.0], 1), "2 x 1 instead of 1 x 1"),
        (
            modes(&[1.0], 4),
            "4 given or asked for; there must be 1 to 3",
        ),
        (
            said(SparseMatrix::new("m", 2, 2, vec![(2, 0, 1.0)])),
            "3 given or asked for",
        ),
        (
            said(SparseMatrix::new("m", 2, 2, vec![(0, 0, f64::NAN)])),
            "m of entry (0, 0) is NaN",
        ),
        (
            said(lowest_modes(&springs(200, &all), &masses(&values), 1).map(drop)),
            "row 199",
        ),
    ] {
        assert!(said.contains(words), "{said}: {words}");
    }
}

/// Two masses on springs of their own, of which the first alone has a sensor and a parameter.
fn apart() -> (WholeModel, SparseMatrix) {
    let apart = [(0, None, 1.0), (1, None, 4.0)];
    let parameter = whole_parameter("first", WholeShare::Stiffness(springs(2, &apart[..1])));
    let model = WholeModel::new(springs(2, &apart), masses(&[1.0; 2]), vec![parameter]);
    (model.unwrap(), sensors_at(&[0], 2))
}

/// A building of ten stories with five sensors, and a test of the real one.
fn five_of_ten() -> (WholeModel, SparseMatrix, Modes) {
    let building = |factors: [f64; 10]| shear_building(&factors.map(|own| 1e5 * own), 1.0, None);
    let sensors = sensors_at(&[1, 3, 5, 7, 9], 10);
    let whole = building(STORIES).modes(&[1.0; 10], 5).unwrap().vibrations;
    let test = seen_by(&sensors, &whole);
    (building([1.0; 10]), sensors, test)
}

/// Asserts that a model is corrected to the truth by a test without noise.
fn assert_recovered(model: &WholeModel, sensors: &SparseMatrix, test: &Modes, truth: &[f64]) {
    let size = truth.len();
    let analyze = |factors: &[f64]| model.analyze(factors, sensors, test, by_sorting(), size);
    let settings = fine_settings().for_modes(test.len());
    let found = correlate(analyze, &model.ranges(), &settings, |_, _| true).unwrap();
    assert_alike(&found.best_factors, truth, RECOVERED_STORY);
}
