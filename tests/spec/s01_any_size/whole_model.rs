//! Models without condensation, correlated at the sensors alone.

use crate::prelude::*;

/// A mode that moves no sensor resembles no test mode; that is no reason to refuse the analysis.
#[test]
fn a_mode_that_no_sensor_sees_is_like_no_test_mode() {
    let apart = [(0, None, 1.0), (1, None, 4.0)];
    let parameter = WholeParameter {
        name: "first".to_owned(),
        share: WholeShare::Stiffness(springs(2, &apart[..1])),
        range: None,
    };
    let model = WholeModel::new(springs(2, &apart), masses(&[1.0, 1.0]), vec![parameter]);
    let test = Modes::new(DVector::from_element(1, 1.2), eye(1));
    let found = model
        .and_then(|model| {
            let sensors = sensors_at(&[0], 2);
            model.analyze(
                &[1.0],
                &sensors,
                &test?,
                by_sorting(),
                BasisSize {
                    modes: 1,
                    residual_vectors: 0,
                },
            )
        })
        .unwrap();
    assert_eq!(found.exact().modes.len(), 1, "the other takes no part");
    // Whichever of the two springs is the stiffer.
    for factor in [1.0, 1.3, 9.0] {
        let state = found.at(&[factor]).unwrap();
        assert_eq!(state.pairing.analysis_mode, [0], "{factor}");
    }
}

/// Where a test mode must answer it there are too few modes; shapes at other sensors have no distance.
#[test]
fn a_mode_that_no_sensor_sees_cannot_be_compared() {
    let apart = [(0, None, 1.0), (1, None, 4.0)];
    let parameter = WholeParameter {
        name: "first".to_owned(),
        share: WholeShare::Stiffness(springs(2, &apart[..1])),
        range: None,
    };
    let model = WholeModel::new(springs(2, &apart), masses(&[1.0, 1.0]), vec![parameter]).unwrap();
    let analyze = |modes: usize, shapes: DMatrix<f64>| {
        let squares = DVector::from_vec(vec![1.2, 4.4]);
        let test = Modes::new(squares, shapes)?;
        let sensors = sensors_at(&[0], 2);
        model
            .analyze(
                &[1.0],
                &sensors,
                &test,
                by_sorting(),
                BasisSize {
                    modes,
                    residual_vectors: 0,
                },
            )
            .map(drop)
    };
    let refused = analyze(2, DMatrix::from_element(1, 2, 1.0));
    assert!(
        matches!(
            &refused,
            Err(Error::Count {
                what: "modes of finite frequency",
                found: 2,
                most: 1,
                ..
            })
        ),
        "{refused:?}"
    );
    let refused = analyze(1, eye(2));
    assert!(
        matches!(
            refused,
            Err(Error::WrongShape {
                what: "mode shapes",
                expected_rows: 1,
                rows: 2,
                ..
            })
        ),
        "{refused:?}"
    );
}

/// Two masses on a spring, whose rigid-body motion a change of mass beyond nothing would leave with a negative one.
#[test]
fn a_state_in_which_rigid_body_modes_have_no_mass_is_refused() {
    let parameter = WholeParameter {
        name: "both".to_owned(),
        share: WholeShare::Mass(masses(&[1.0, 1.0])),
        range: None,
    };
    let spring = springs(2, &[(1, Some(0), 1.0)]);
    let model = WholeModel::new(spring, masses(&[1.0, 1.0]), vec![parameter]).unwrap();
    let shape = DMatrix::from_column_slice(2, 1, &[1.0, -1.0]);
    let test = Modes::new(DVector::from_element(1, 2.0), shape).unwrap();
    let free = model
        .analyze(
            &[1.0],
            &sensors_at(&[0, 1], 2),
            &test,
            by_sorting(),
            BasisSize {
                modes: 1,
                residual_vectors: 0,
            },
        )
        .unwrap();
    assert!(free.at(&[2.0]).is_ok());
    let refused = free.at(&[-1.0]);
    assert!(
        matches!(
            refused,
            Err(Error::NotPositiveDefinite {
                what: "mass of the rigid-body modes",
                ..
            })
        ),
        "{refused:?}"
    );
}

/// The share of one matrix in the modes of a building of three stories, and its congruence.
fn share_and_congruence(matrix: DMatrix<f64>) -> [DMatrix<f64>; 2] {
    let parameter = WholeParameter {
        name: "a share".to_owned(),
        share: WholeShare::Stiffness(sparse(&matrix).unwrap()),
        range: None,
    };
    let stories = [(0, None, 3.0), (1, Some(0), 2.0), (2, Some(1), 1.0)];
    let model = WholeModel::new(springs(3, &stories), masses(&[1.0; 3]), vec![parameter]).unwrap();
    let test = model.modes(&[1.0], 3).unwrap().vibrations;
    let sensors = sensors_at(&[0, 1, 2], 3);
    let found = model
        .analyze(
            &[1.0],
            &sensors,
            &test,
            by_sorting(),
            BasisSize {
                modes: 3,
                residual_vectors: 0,
            },
        )
        .unwrap();
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

#[test]
fn the_share_of_a_matrix_without_a_diagonal_is_its_congruence() {
    let mut unit = zero_square(3);
    (unit[(0, 2)], unit[(2, 0)]) = (1.0, 1.0);
    let [share, congruence] = share_and_congruence(unit);
    assert!(congruence.amax() > 0.1);
    assert!((share - congruence).amax() <= MATRIX_ROUND_OFF);
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
        .analyze(
            &[1.0; 3],
            &sensors,
            &test,
            by_sorting(),
            BasisSize {
                modes: 3,
                residual_vectors: 0,
            },
        )
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
            assert!((change - expected).abs() <= MATRIX_ROUND_OFF * expected);
        }
    }
}

/// Two vibrations of three free masses, whose rigid-body motion a change of the first mass mixes into both. The difference is off by
/// something like its own step, from the slope of the error sum of analyses with a little more and less of the mass.
#[test]
fn the_error_change_by_a_mass_of_a_free_structure_is_near_its_limit() {
    let parameter = WholeParameter {
        name: "first".to_owned(),
        share: WholeShare::Mass(masses(&[1.0, 0.0, 0.0])),
        range: None,
    };
    let between = springs(3, &[(1, Some(0), 1.0), (2, Some(1), 2.0)]);
    let model = WholeModel::new(between, masses(&[1.0, 2.0, 1.5]), vec![parameter]).unwrap();
    let sensors = sensors_at(&[0, 1, 2], 3);
    let test = model.modes(&[1.5], 2).unwrap().vibrations;
    let test = seen_by(&sensors, &test);
    let free = |factor: f64| {
        let size = BasisSize {
            modes: 2,
            residual_vectors: 0,
        };
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
    let truth = [0.70, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.0, 0.85, 1.0];
    let range = None;
    let real = shear_building(&truth.map(|factor| factor * 1.0e5), 1.0, range);
    let model = shear_building(&[1.0e5; 10], 1.0, range);
    let sensors = sensors_at(&[1, 3, 5, 7, 9], 10);
    let whole = real.modes(&[1.0; 10], 5).unwrap().vibrations;
    let test = seen_by(&sensors, &whole);
    let analyze = |factors: &[f64]| {
        model.analyze(
            factors,
            &sensors,
            &test,
            by_sorting(),
            BasisSize {
                modes: 10,
                residual_vectors: 0,
            },
        )
    };
    let settings = fine_settings().for_modes(test.len());
    let found = correlate(analyze, &model.ranges(), &settings, |_, _| true).unwrap();
    for (story, (found, truth)) in found.best_factors.iter().zip(&truth).enumerate() {
        assert!(
            relative_error(found, truth) < RECOVERED_STORY,
            "story {}: {found} for {truth}",
            story + 1
        );
    }
}

#[test]
fn a_factor_scales_its_own_share_of_stiffness_or_mass() {
    let (wall, between) = ((0, None, 5.0), (1, Some(0), 7.0));
    let parameter = |name: &str, share| WholeParameter {
        name: name.to_owned(),
        share,
        range: None,
    };
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
    let truth = [0.70, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.0, 0.85, 1.0];
    let real = shear_building(&truth.map(|factor| factor * 1.0e5), 1.0, None);
    let model = shear_building(&[1.0e5; 10], 1.0, None);
    let sensors = sensors_at(&[1, 3, 5, 7, 9], 10);
    let whole = real.modes(&[1.0; 10], 5).unwrap().vibrations;
    let test = seen_by(&sensors, &whole);
    let scales = [3.0, -0.2, 1.0e3, -1.0, 0.01];
    let shapes = test.shapes() * DMatrix::from_diagonal(&scales.to_vec().into());
    let other = Modes::new(test.omega_squared().clone(), shapes).unwrap();
    let [first, other] = [&test, &other].map(|test| {
        model
            .analyze(
                &[1.0; 10],
                &sensors,
                test,
                by_sorting(),
                BasisSize {
                    modes: 10,
                    residual_vectors: 0,
                },
            )
            .unwrap()
    });
    for (j, scale) in scales.iter().enumerate() {
        let shape = first.test().shapes().column(j);
        let pairing = &first.exact().pairing;
        let mode = pairing.sign[j]
            * first
                .exact()
                .modes
                .shapes()
                .column(pairing.analysis_mode[j]);
        assert!((&mode - shape).dot(&shape).abs() < ROUND_OFF * shape.norm_squared());
        assert!(
            (other.test().shapes().column(j) - scale.signum() * shape).norm()
                < ROUND_OFF * shape.norm()
        );
    }
}

/// The torque box of Case 2 as whole matrices: its condensed analysis is the finite element model's own.
#[test]
fn the_condensed_analysis_of_the_box_is_that_of_the_method() {
    let case = Case::new(2).unwrap();
    let model = case.model().unwrap();
    let test = case.test_modes().unwrap();
    let (whole, sensors) = whole::of(&model).unwrap();
    let factors = (0..model.parameters().len())
        .map(|e| 0.8 + 0.03 * e as f64)
        .collect_vec();
    let expected = model.analyze(&factors, &test, None).unwrap();
    let found = analyze_condensed(&whole, &factors, &sensors, &test, None).unwrap();
    let paired_hz = |state: &State| {
        let paired = state.pairing.paired(&state.modes);
        paired.unwrap().frequencies_hz()
    };
    let expected_hz = paired_hz(expected.exact());
    assert_alike(paired_hz(found.exact()).iter(), &expected_hz, SAME_ANALYSIS);
    for (a, b) in found.shares().iter().zip(expected.shares()) {
        assert!((a - b).amax() < SAME_ANALYSIS * b.amax());
    }
    // Its mass is at the sensors alone, so that nothing is condensed and the whole model has the same modes.
    let at_sensors = whole
        .analyze(
            &factors,
            &sensors,
            &test,
            by_sorting(),
            BasisSize {
                modes: 9,
                residual_vectors: 0,
            },
        )
        .unwrap();
    let assurance = modal_assurance(
        at_sensors.exact().modes.shapes(),
        expected.exact().modes.shapes(),
    )
    .unwrap();
    let at_sensors_hz = paired_hz(at_sensors.exact());
    for (mode, hz) in expected_hz.iter().enumerate() {
        assert!(relative_error(at_sensors_hz[mode], hz) < SAME_ANALYSIS);
        assert!(assurance[(mode, mode)] > 1.0 - SAME_ANALYSIS);
    }
    assert!(
        relative_error(
            at_sensors.exact().errors.sum(),
            expected.exact().errors.sum()
        ) < SAME_ANALYSIS
    );
    for (a, b) in at_sensors.shares().iter().zip(expected.shares()) {
        assert!((a.matrix().abs() - b.abs()).amax() < SAME_ANALYSIS * b.amax());
    }
}

/// A free chain, as hung in soft cords: its rigid-body mode is found, counted, and kept out of the correlation.
#[test]
fn a_free_chain_is_corrected_without_its_rigid_body_mode() {
    let count = 12;
    let springs_of = |factors: &[f64]| {
        let spring = |e: usize| (e + 1, Some(e), 1.0e5 * factors[e]);
        springs(count, &(0..count - 1).map(spring).collect_vec())
    };
    let truth = (0..count - 1)
        .map(|e| [1.0, 0.8, 1.15, 1.0, 0.9][e % 5])
        .collect_vec();
    let model_of = |first: &[f64]| {
        let parameters = (0..count - 1).map(|e| {
            let mut alone = vec![0.0; count - 1];
            alone[e] = first[e];
            WholeParameter {
                name: format!("{e}"),
                share: WholeShare::Stiffness(springs_of(&alone)),
                range: None,
            }
        });
        let mass = (0..count)
            .map(|row| 1.0 + 0.1 * (row % 3) as f64)
            .collect_vec();
        WholeModel::new(springs_of(first), masses(&mass), parameters.collect()).unwrap()
    };
    let sensors = sensors_at(&(0..count).collect_vec(), count);
    let (real, model) = (model_of(&truth), model_of(&vec![1.0; count - 1]));
    let modes = real.modes(&vec![1.0; count - 1], 8).unwrap();
    assert_eq!(modes.rigid_body.ncols(), 1);
    let analyze = |factors: &[f64]| {
        model.analyze(
            factors,
            &sensors,
            &modes.vibrations,
            by_sorting(),
            BasisSize {
                modes: count - 1,
                residual_vectors: 0,
            },
        )
    };
    let settings = fine_settings().for_modes(modes.vibrations.len());
    let found = correlate(analyze, &model.ranges(), &settings, |_, _| true).unwrap();
    for (e, (found, truth)) in found.best_factors.iter().zip(&truth).enumerate() {
        assert!(
            relative_error(found, truth) < RECOVERED_STORY,
            "spring {e}: {found} for {truth}"
        );
    }
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
    let parameter = |matrix: SparseMatrix| {
        vec![WholeParameter {
            name: "all".to_owned(),
            share: WholeShare::Stiffness(matrix),
            range: None,
        }]
    };
    let mass = masses(&[1.0; 3]);
    let new = |stiffness: &SparseMatrix, mass: &SparseMatrix, parameters| {
        WholeModel::new(stiffness.clone(), mass.clone(), parameters)
    };
    assert!(matches!(
        new(&held, &masses(&[1.0; 2]), parameter(held.clone())),
        Err(Error::WrongShape { what: "mass", .. })
    ));
    assert!(new(&held, &mass, Vec::new()).is_ok());
    let lopsided = SparseMatrix::new("stiffness", 3, 3, vec![(0, 1, 1.0)]).unwrap();
    assert!(matches!(
        new(&held, &mass, parameter(lopsided)),
        Err(Error::Value { what: "relative difference", owner, .. })
            if owner == "stiffness of a parameter, entry (1, 0) beside its mirror"
    ));
    let model = new(&held, &mass, parameter(held.clone())).unwrap();
    assert!(matches!(
        model.modes(&[0.0], 1),
        Err(Error::Value { what: "factor", .. })
    ));
    assert!(matches!(
        model.modes(&[1.0, 1.0], 1),
        Err(Error::WrongShape { .. })
    ));
    assert!(matches!(
        model.modes(&[1.0], 4),
        Err(Error::Count {
            found: 4,
            most: 3,
            ..
        })
    ));
    assert!(matches!(
        SparseMatrix::new("m", 2, 2, vec![(2, 0, 1.0)]),
        Err(Error::Count { found: 3, .. })
    ));
    assert!(matches!(
        SparseMatrix::new("m", 2, 2, vec![(0, 0, f64::NAN)]),
        Err(Error::Value { what: "m", .. })
    ));
    let floating = springs(
        200,
        &(1..199).map(|row| (row, Some(row - 1), 1.0)).collect_vec(),
    );
    let mut values = vec![1.0; 200];
    values[199] = 0.0;
    let refused = lowest_modes(&floating, &masses(&values), 1);
    assert!(
        matches!(refused, Err(Error::NotPositiveDefinite { row: 199, .. })),
        "{refused:?}"
    );
}
