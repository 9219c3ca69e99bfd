//! What condensation to the measured DOF costs, and that the test is not blamed for it: a bar of ten rods measured at five joints.

use crate::common::condensed::{LARGEST_CONDENSATION_ERROR, condensation_errors, seen_modes};
use crate::prelude::*;

const RODS: usize = 10;

/// A bar of rods with these areas, whose masses are theirs alone.
fn bar(areas: &[f64]) -> Structure {
    let material = Material {
        density: 2.5e-4,
        ..Material::isotropic(1.0e7, 0.3).unwrap()
    };
    let grids = (0..=RODS).map(|joint| Grid {
        label: joint + 1,
        // Rods of unlike lengths: in a bar of like ones all that is condensed vibrates at one frequency, and costs no orthogonality.
        position: Vector3::new(10.0 * joint as f64 + 4.0 * (joint % 3) as f64, 0.0, 0.0),
        constrained: [joint == 0, true, true],
    });
    let rods = areas.iter().enumerate().map(|(rod, &size)| Element {
        label: rod + 1,
        kind: ElementKind::Rod,
        grids: vec![rod + 1, rod + 2],
        size,
        material,
    });
    Structure::new(grids.collect(), rods.collect()).unwrap()
}

/// The same as a whole model, and what reads the joints (1 to 10, from the wall) that are measured.
fn whole(bar: &Structure, measured: &[usize]) -> (WholeModel, SparseMatrix) {
    let rods = (1..=RODS).map(|rod| vec![rod]).collect_vec();
    let joints = measured.iter().map(|joint| joint - 1).collect_vec();
    (of_structure(bar, &rods).unwrap(), sensors_at(&joints, RODS))
}

const FIVE: [usize; 5] = [2, 4, 6, 8, 10];
const ONES: [f64; RODS] = [1.0; RODS];

properties! {
    #[test]
    fn whole_modes_are_those_of_the_assembled_pencil(areas in prop::collection::vec(0.5..2.0_f64, RODS)) {
        let bar = bar(&areas);
        let mass = DMatrix::from_diagonal(&lumped_mass(&bar));
        let (omega_squared, shapes) = modes_by_nalgebra(&dense(&bar), &mass);
        let (whole, joints) = whole(&bar, &FIVE);
        let found = seen_modes(&whole, &ONES, &joints, 5)?;
        for mode in 0..5 {
            prop_assert!(relative_error(found.omega_squared()[mode], omega_squared[mode]) < 1e2 * EIGEN_ROUND_OFF);
            let expected = DVector::from_fn(5, |row, _| shapes[(FIVE[row] - 1, mode)]);
            let (a, b) = (found.shapes().column(mode), &expected);
            let sign = a.dot(b).signum();
            prop_assert!((a - sign * b).amax() < 1e3 * EIGEN_ROUND_OFF * b.amax());
        }
    }

    #[test]
    fn condensed_frequencies_are_those_of_a_ritz_approximation(areas in prop::collection::vec(0.5..2.0_f64, RODS)) {
        // Mode by mode none lies below the whole structure's.
        let (whole, joints) = whole(&bar(&areas), &FIVE);
        let (condensed, mass) = condensed(&whole, &ONES, &joints)?;
        let condensed = solve(&condensed.stiffness, &mass, 5)?.frequencies_hz();
        let whole = seen_modes(&whole, &ONES, &joints, 5)?.frequencies_hz();
        for (condensed, whole) in condensed.iter().zip(whole) {
            prop_assert!(*condensed >= whole * (1.0 - EIGEN_ROUND_OFF));
        }
    }

    #[test]
    fn where_every_joint_is_measured_condensation_costs_nothing(areas in prop::collection::vec(0.5..2.0_f64, RODS)) {
        let all = (1..=RODS).collect_vec();
        let (whole, joints) = whole(&bar(&areas), &all);
        for error in condensation_errors(&whole, &ONES, &joints, RODS)? {
            prop_assert!(error.frequency.abs() < MATRIX_ROUND_OFF && error.shape.abs() < MATRIX_ROUND_OFF);
        }
    }
}

/// Where no point has a mass of its own and every element has one.
#[test]
fn the_mass_of_elements_alone_is_condensed_as_the_method_does() {
    let bar = bar(&ONES);
    let t = eye(RODS).select_columns(&FIVE.map(|joint| joint - 1));
    let b = condense(&dense(&bar), &t).unwrap().transformation;
    let plain = b.tr_mul(&(DMatrix::from_diagonal(&lumped_mass(&bar)) * &b));
    let (model, joints) = whole(&bar, &FIVE);
    let (_, found) = condensed(&model, &ONES, &joints).unwrap();
    assert!(plain.amax() > 0.0);
    assert!((found - &plain).amax() <= MATRIX_ROUND_OFF * plain.amax());
}

#[test]
fn five_of_ten_joints_are_too_few_for_the_higher_modes() {
    let (model, joints) = whole(&bar(&ONES), &FIVE);
    let errors = condensation_errors(&model, &ONES, &joints, 5).unwrap();
    // Static condensation raises the fourth and the fifth frequency by several percent, the first by next to nothing.
    assert!(errors[0].frequency < 0.005 && errors[0].frequency > 0.0);
    assert!(errors[4].frequency > 0.03, "{errors:?}");
    let refused = errors
        .iter()
        .filter(|error| error.frequency > LARGEST_CONDENSATION_ERROR)
        .count();
    assert!((1..=4).contains(&refused), "{errors:?}");
}

/// A model whose one parameter is all its stiffness.
fn of_matrices(stiffness: SparseMatrix, values: &[f64]) -> WholeModel {
    let share = WholeShare::Stiffness(stiffness.clone());
    let all = WholeParameter {
        name: "all".to_owned(),
        share,
        range: None,
    };
    WholeModel::new(stiffness, masses(values), vec![all]).unwrap()
}

#[test]
fn modes_that_move_no_sensor_are_passed_over_in_any_units() {
    for (spring, mass) in [(1.0, 1.0), (1e20, 1e20), (1e-20, 1e-20)] {
        // Three masses between two walls, measured at the middle one, which rests in the second mode.
        let model = of_matrices(
            chain_of_springs(ChainEnds::FixedFixed, 3, spring),
            &[mass; 3],
        );
        let sensors = sensors_at(&[1], 3);
        let roots = chain_eigenvalues(ChainEnds::FixedFixed, 3, spring, mass);
        for count in [1, 2] {
            let found = seen_modes(&model, &[1.0], &sensors, count).unwrap();
            assert_alike(
                found.omega_squared().iter(),
                [roots[0], roots[2]],
                MATRIX_ROUND_OFF,
            );
            assert_eq!(found.len(), count);
        }
        let refused = seen_modes(&model, &[1.0], &sensors, 3);
        assert!(
            matches!(
                refused,
                Err(Error::Count {
                    what: "modes that move a sensor",
                    found: 3,
                    most: 2,
                    ..
                })
            ),
            "{refused:?}"
        );
        // Of two that are not joined the lower one does not move the other's sensor at all.
        let alone = of_matrices(
            springs(2, &[(0, None, spring), (1, None, 4.0 * spring)]),
            &[mass; 2],
        );
        let found = seen_modes(&alone, &[1.0], &sensors_at(&[1], 2), 1).unwrap();
        assert!((found.omega_squared()[0] / (4.0 * spring / mass) - 1.0).abs() < MATRIX_ROUND_OFF);
    }
}

#[test]
fn what_only_moves_as_one_has_no_mode_that_a_sensor_could_see() {
    // One mass, and a point without that hangs on it.
    let model = of_matrices(chain_of_springs(ChainEnds::FreeFree, 2, 1.0), &[1.0, 0.0]);
    let refused = seen_modes(&model, &[1.0], &sensors_at(&[0], 2), 1);
    assert!(
        matches!(
            refused,
            Err(Error::Count {
                what: FINITE,
                found: 1,
                most: 0,
                ..
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn more_modes_than_there_are_is_an_error() {
    let (model, joints) = whole(&bar(&ONES), &FIVE);
    assert!(matches!(
        seen_modes(&model, &ONES, &joints, 11),
        Err(Error::Count {
            found: 11,
            most: 10,
            ..
        })
    ));
    assert!(matches!(
        seen_modes(&model, &ONES, &joints, 0),
        Err(Error::Count { found: 0, .. })
    ));
    assert!(matches!(
        condensation_errors(&model, &ONES, &joints, 6),
        Err(Error::Count {
            found: 6,
            most: 5,
            ..
        })
    ));
}
