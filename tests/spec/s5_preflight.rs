//! The pre-flight: mistakes made by hand on the box, the delta wing and a spring chain, and what is said of none.

use crate::common::alter;
use crate::common::closed_forms::uniform_chain::uniform_held_modes;
use crate::common::known::delta_wing::{DeltaWing, correlation};
use crate::common::tolerances::{FIRST_FREQUENCY_RATIO, MATRIX_ROUND_OFF, ROUND_OFF};
use crate::evidence::rates::spring_chain;
use crate::evidence::specimen::Specimen;
use corfem::chain::spring_stiffness;
use corfem::job::preflight::{
    Change, CommonFactor, FACTORS, Finding, LEAST_DIFFERENCE, LOW_PAIR, Mended, preflight,
};
use corfem::method::model::{DynamicModel, FiniteElementModel};
use corfem::method::modes::{ModeSet, solve};
use corfem::method::outer_loop::correlate;
use corfem::method::pairing::{cross_orthogonality, pair_modes};
use corfem::sparse::random::split_mix_64;
use corfem::torque_box::Case;
use corfem::torque_box::wing_box::{PANEL_COUNT, TEST_GAGE};
use corfem::weighted::noise::{Noise, with_noise};
use nalgebra::DMatrix;

pub fn case(number: usize) -> Specimen {
    Specimen::of_case(&Case::new(number).unwrap()).unwrap()
}

pub fn chain() -> Specimen {
    spring_chain().unwrap()
}

pub fn wing() -> Specimen {
    Specimen::delta_wing().unwrap()
}

/// What is found beside parameters without bounds.
pub fn findings(specimen: &Specimen) -> Vec<Finding> {
    let mut found = specimen.findings(&specimen.test).unwrap();
    found.retain(|finding| !matches!(finding, Finding::Unbounded(_)));
    found
}

pub fn with_shapes(specimen: &Specimen, shapes: DMatrix<f64>) -> Specimen {
    Specimen {
        test: specimen
            .test
            .clone()
            .with_shapes(shapes)
            .expect("shapes that fit"),
        ..specimen.clone()
    }
}

/// The change that alone is found.
pub fn mended(specimen: &Specimen) -> Mended {
    match &findings(specimen)[..] {
        [Finding::Mended(mended)] => mended.clone(),
        other => panic!("{}: {other:?}", specimen.name),
    }
}

/// The mean of the paired cross-orthogonality, by its definition.
pub fn agreement(model: &DynamicModel, test: &ModeSet) -> f64 {
    let analysis = solve(&model.stiffness, &model.mass, model.mass.nrows()).unwrap();
    let test = test.scaled_with(&model.mass).unwrap();
    let cross = cross_orthogonality(&analysis, &test, &model.mass).unwrap();
    let pairing = pair_modes(&cross).unwrap();
    let pairs = pairing
        .analysis_mode()
        .iter()
        .enumerate()
        .map(|(test, &mode)| cross[(mode, test)].abs());
    pairs.sum::<f64>() / test.len() as f64
}

#[test]
fn nothing_is_said_of_the_papers_cases_and_of_the_wing_but_what_is_so() {
    for specimen in [case(1), case(2), case(3), wing(), chain()] {
        assert_eq!(findings(&specimen), [], "{}", specimen.name);
    }
    // Case 3 alone bounds its gages.
    let unbounded = |specimen: Specimen| specimen.findings(&specimen.test).unwrap();
    assert_eq!(unbounded(case(3)), []);
    assert_eq!(unbounded(case(2)), [Finding::Unbounded((0..15).collect())]);
    assert_eq!(unbounded(wing()), [Finding::Unbounded((0..21).collect())]);
}

#[test]
fn low_pairs_of_case_4_come_from_its_faulty_element() {
    let low = findings(&case(4));
    let pairs: Vec<_> = low
        .iter()
        .map(|finding| match finding {
            Finding::LowPair {
                test,
                analysis,
                cross,
            } if *cross < LOW_PAIR => (*test, *analysis),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(pairs, [(4, 4), (6, 5), (7, 7)]);
    // Element 8 made right.
    let mut gages = Case::new(4).unwrap().first_gages();
    gages[7] *= 100.0;
    let model = Case::new(4)
        .unwrap()
        .model_with(&gages)
        .unwrap()
        .matrices(&[1.0; PANEL_COUNT])
        .unwrap();
    assert_eq!(findings(&Specimen { model, ..case(4) }), []);
}

#[test]
fn models_with_any_gages_within_two_thirds_cause_no_false_alarm() {
    let case = Case::new(2).unwrap();
    let (test, mut state) = (ModeSet::from(case.test_modes().unwrap()), 7);
    let mut unit = || (split_mix_64(&mut state) >> 11) as f64 / (1_u64 << 53) as f64;
    for seed in 1..=100 {
        let gages: Vec<f64> = (0..PANEL_COUNT)
            .map(|_| TEST_GAGE * 0.6_f64.powf(2.0 * unit() - 1.0))
            .collect();
        let model = case
            .model_with(&gages)
            .unwrap()
            .matrices(&[1.0; PANEL_COUNT])
            .unwrap();
        let noisy = with_noise(&test, Noise::USUAL, seed).unwrap();
        for finding in preflight(&model, &noisy, &case.settings, &[]).unwrap() {
            assert!(
                matches!(finding, Finding::LowPair { .. }),
                "{seed}: {finding}"
            );
        }
    }
}

#[test]
fn every_factor_is_named_and_a_models_error_is_none() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let with_factor = |factor: f64| {
            let mut wrong = specimen.clone();
            alter(&mut wrong.test, |squares, _| *squares *= factor * factor);
            findings(&wrong)
        };
        for known in FACTORS {
            match with_factor(known.factor)[..] {
                [
                    Finding::CommonFactor(CommonFactor {
                        median,
                        named: Some(named),
                        ..
                    }),
                ] => {
                    assert_eq!(named, known);
                    assert!(
                        (median / known.factor - 1.0).abs() < FIRST_FREQUENCY_RATIO,
                        "{median}"
                    );
                }
                ref other => panic!("{}: {other:?}", known.name),
            }
        }
        assert_eq!(with_factor(1.2), []);
        let unnamed = with_factor(2.1);
        assert!(
            matches!(
                unnamed[..],
                [Finding::CommonFactor(CommonFactor { named: None, .. })]
            ),
            "{unnamed:?}"
        );
    }
}

#[test]
fn factors_are_what_they_are_called() {
    for (known, squared) in
        FACTORS
            .iter()
            .step_by(2)
            .zip([std::f64::consts::TAU.powi(2), 3600.0, 1000.0, 386.09, 9.81])
    {
        assert!(
            (known.factor.powi(2) / squared - 1.0).abs() < ROUND_OFF,
            "{}",
            known.name
        );
    }
    for pair in FACTORS.chunks(2) {
        assert!((pair[0].factor * pair[1].factor - 1.0).abs() < ROUND_OFF);
        assert_eq!(format!("1/{}", pair[0].name), pair[1].name);
    }
}

#[test]
fn every_reversed_sensor_is_named_with_its_numbers() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let right = agreement(&specimen.model, &specimen.test);
        for sensor in 0..specimen.test.shapes().nrows() {
            let mut shapes = specimen.test.shapes().clone();
            shapes.row_mut(sensor).neg_mut();
            let wrong = with_shapes(&specimen, shapes);
            let found = mended(&wrong);
            assert_eq!(found.change, Change::Reversed(sensor), "{}", specimen.name);
            assert!((found.after - right).abs() < MATRIX_ROUND_OFF);
            assert!((found.before - agreement(&wrong.model, &wrong.test)).abs() < MATRIX_ROUND_OFF);
            let (next, runner_up) = found.next.expect("there are others");
            assert!(next != found.change && runner_up < found.after);
        }
    }
}

#[test]
fn the_loops_take_a_reversed_sensor_for_wrong_gages() {
    let case = Case::new(2).unwrap();
    let (model, mut test) = (
        case.model().unwrap(),
        ModeSet::from(case.test_modes().unwrap()),
    );
    alter(&mut test, |_, shapes| shapes.row_mut(6).neg_mut());
    let analyze = |factors: &[f64]| model.analyze(factors, &test, None);
    let run = correlate(
        analyze,
        &model.factor_ranges().unwrap(),
        &case.settings,
        |_, _| {},
    )
    .unwrap();
    let factors = &run.best_factors;
    assert!(!run.converged);
    assert!(
        factors.iter().any(|factor| *factor < 0.01) && factors.iter().any(|factor| *factor > 8.0),
        "{factors:?}"
    );
}

#[test]
fn a_reversed_sensor_costs_a_right_model_two_of_all_its_modes() {
    let (count, stiffness, mass) = (8, 2.0e4, 0.3);
    let springs = (0..=count).map(|spring| spring_stiffness(count, spring, stiffness));
    let model = DynamicModel {
        stiffness: springs.fold(DMatrix::zeros(count, count), |sum, spring| sum + spring),
        mass: DMatrix::from_diagonal_element(count, count, mass),
        shares: Vec::new(),
    };
    let test = uniform_held_modes(count, stiffness, mass);
    let right = Specimen {
        model,
        test,
        ..chain()
    };
    for sensor in 0..count {
        let mut shapes = right.test.shapes().clone();
        shapes.row_mut(sensor).neg_mut();
        let found = mended(&with_shapes(&right, shapes));
        assert_eq!(found.change, Change::Reversed(sensor));
        // No mode has more than 2/9 of its generalized mass at one point, so that no pair and no sign changes.
        assert!((found.before - (1.0 - 2.0 / count as f64)).abs() < MATRIX_ROUND_OFF);
        assert!((found.after - 1.0).abs() < MATRIX_ROUND_OFF);
    }
}

#[test]
fn every_two_sensors_exchanged_are_named() {
    for specimen in [case(2), case(3), chain()] {
        for b in 0..specimen.test.shapes().nrows() {
            for a in 0..b {
                let mut shapes = specimen.test.shapes().clone();
                shapes.swap_rows(a, b);
                assert_eq!(
                    mended(&with_shapes(&specimen, shapes)).change,
                    Change::Exchanged([a, b]),
                    "{}",
                    specimen.name
                );
            }
        }
    }
    let wing = wing();
    for [a, b] in [[0, 18], [3, 10], [1, 2]] {
        let mut shapes = wing.test.shapes().clone();
        shapes.swap_rows(a, b);
        assert_eq!(
            mended(&with_shapes(&wing, shapes)).change,
            Change::Exchanged([a, b])
        );
    }
}

#[test]
fn columns_of_t_in_another_order_are_named() {
    let case_2 = Case::new(2).unwrap();
    let model = case_2.model().unwrap();
    let ones = [1.0; PANEL_COUNT];
    // Rear, mid, front of each rib written station by station, and two exchanged.
    for order in [[0, 3, 6, 1, 4, 7, 2, 5, 8], [0, 1, 2, 7, 4, 5, 6, 3, 8]] {
        let t = model.load_distribution().clone().select_columns(&order);
        let parameters = model.parameters().to_vec();
        let wrong = FiniteElementModel::new(
            model.structure().clone(),
            t,
            model.mass().clone(),
            parameters,
        )
        .unwrap();
        let wrong = Specimen {
            model: wrong.matrices(&ones).unwrap(),
            ..case(2)
        };
        let found = mended(&wrong);
        let Change::Columns(back) = &found.change else {
            panic!("{found:?}")
        };
        let round: Vec<usize> = back.iter().map(|&place| order[place]).collect();
        assert_eq!(round, (0..9).collect::<Vec<_>>());
        assert!((found.after - agreement(&case(2).model, &case(2).test)).abs() < MATRIX_ROUND_OFF);
    }
    // The wing's masses are made with T and take its order: to the test it is the points that have another.
    let model = correlation::first_model(&DeltaWing::embedded()).unwrap();
    let order: Vec<usize> = (0..19).map(|place| (7 * place + 3) % 19).collect();
    let t = model.load_distribution().clone().select_columns(&order);
    let parameters = model.parameters().to_vec();
    let wrong = FiniteElementModel::new(
        model.structure().clone(),
        t,
        model.mass().clone(),
        parameters,
    )
    .unwrap();
    let wrong = Specimen {
        model: wrong.matrices(&[1.0; 21]).unwrap(),
        ..wing()
    };
    assert_eq!(mended(&wrong).change, Change::Reordered(order));
}

#[test]
fn sensors_and_columns_are_told_apart_by_the_masses_alone() {
    // Masses 4 and 6 of the chain are 0.82 and 0.70; exchanged columns look almost like exchanged sensors.
    let right = chain();
    let mut order: Vec<usize> = (0..8).collect();
    order.swap(3, 5);
    let mut wrong = right.clone();
    wrong.model.stiffness = right
        .model
        .stiffness
        .select_rows(&order)
        .select_columns(&order);
    let found = mended(&wrong);
    assert_eq!(found.change, Change::Exchanged([3, 5]));
    let (next, agreement) = found.next.clone().expect("the columns");
    assert_eq!(next, Change::Columns(order.clone()));
    assert!((agreement - found.after).abs() < LEAST_DIFFERENCE);
    let alike = DMatrix::from_diagonal_element(8, 8, 1.0);
    wrong.model.mass = alike.clone();
    wrong.test = solve(&right.model.stiffness, &alike, 8).unwrap().into();
    let found = mended(&wrong);
    let (_, agreement) = found.next.expect("the columns");
    assert!(
        (agreement - found.after).abs() < MATRIX_ROUND_OFF,
        "with equal masses they are the same mistake"
    );
}

#[test]
fn points_in_another_order_and_transposed_shapes_are_named() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let (points, modes) = specimen.test.shapes().shape();
        let order: Vec<usize> = (0..points).map(|place| (place + 1) % points).collect();
        let found = mended(&with_shapes(
            &specimen,
            specimen.test.shapes().select_rows(&order),
        ));
        let back: Vec<usize> = (0..points)
            .map(|place| (place + points - 1) % points)
            .collect();
        assert_eq!(found.change, Change::Reordered(back), "{}", specimen.name);
        if points == modes {
            let found = mended(&with_shapes(&specimen, specimen.test.shapes().transpose()));
            assert_eq!(found.change, Change::Transposed, "{}", specimen.name);
        }
    }
}
