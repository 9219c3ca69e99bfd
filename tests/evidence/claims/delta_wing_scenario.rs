//! The scenario of the delta wing's correlation: groups, wrong gages, dynamic points, masses and test modes.

use crate::prelude::*;

fn wing() -> DeltaWing {
    DeltaWing::embedded()
}

fn true_factors() -> Vec<f64> {
    GROUPS.iter().map(|g| 1.0 / g.first_over_true).collect()
}

#[test]
fn groups_are_all_covers_and_webs_once() {
    let mut members = GROUPS
        .iter()
        .flat_map(|g| g.elements)
        .copied()
        .collect_vec();
    members.sort_unstable();
    assert_eq!(members, (1..=53).collect_vec());
    assert_eq!(GROUPS.len(), 21);
    let wrong = GROUPS
        .iter()
        .filter(|g| g.first_over_true != 1.0)
        .map(|g| (g.name, g.first_over_true))
        .collect_vec();
    assert_eq!(
        wrong,
        [
            ("covers x 30-50 forward", 1.4),
            ("covers x 70-90", 0.85),
            ("webs y 20 outboard", 0.7),
            ("webs y 60 inboard", 1.2),
            ("webs x 30", 0.8),
            ("webs x 50", 0.8),
            ("webs leading edge", 1.25),
        ]
    );
}

#[test]
fn groups_lie_where_their_names_say() {
    let structure = wing().structure().unwrap();
    for group in GROUPS {
        let mut words = group.name.split(' ');
        let (kind, axis, place) = (words.next(), words.next(), words.next());
        for (element, corners) in structure.elements().iter().zip(structure.corners()) {
            if !group.elements.contains(&element.label) {
                continue;
            }
            let range = |axis: usize| {
                let values = corners.iter().map(|corner| corner[axis]);
                values.fold((f64::MAX, f64::MIN), |(low, high), value| {
                    (low.min(value), high.max(value))
                })
            };
            let (x, y) = (range(0), range(1));
            let name = group.name;
            match (kind, axis, place) {
                (Some("covers"), Some("x"), Some(bay)) => {
                    assert_eq!(format!("{}-{}", x.0, x.1), bay, "{name}");
                    match words.clone().next() {
                        Some("aft") => assert!(y.1 <= 40.0, "{name}"),
                        Some(_) => assert!(y.0 >= 40.0, "{name}"),
                        None => {}
                    }
                }
                (Some(_), Some("leading"), _) => assert_eq!(x.0 + y.1, 110.0, "{name}"),
                (Some(_), Some(axis), Some(place)) => {
                    let (along, across) = if axis == "x" { (x, y) } else { (y, x) };
                    assert_eq!(along.0, along.1, "{name}");
                    assert_eq!(along.0.to_string(), place, "{name}");
                    match words.clone().next() {
                        Some("inboard") => assert!(across.1 <= 30.0, "{name}"),
                        Some(_) => assert!(across.0 >= 30.0, "{name}"),
                        None => {}
                    }
                }
                _ => panic!("{name} has no place"),
            }
        }
    }
}

#[test]
fn first_model_has_wrong_gages_and_true_masses() {
    let model = first_model(&wing()).unwrap();
    let right = wing().structure().unwrap();
    let pairs = model.structure().elements().iter().zip(right.elements());
    for (first, right) in pairs {
        let group = GROUPS.iter().find(|g| g.elements.contains(&right.label));
        let ratio = group.map_or(1.0, |g| g.first_over_true);
        assert_relative_eq!(first.size, ratio * right.size, max_relative = ROUND_OFF);
        assert_relative_eq!(
            first.size * first.material.density,
            right.size * right.material.density,
            max_relative = ROUND_OFF
        );
    }
    let names = model
        .parameters()
        .iter()
        .map(|p| p.name.as_str())
        .collect_vec();
    assert_eq!(names, GROUPS.map(|g| g.name));
    let condensed = model.matrices(&[1.0; 21]).unwrap().mass;
    let b = model.condense(&[1.0; 21]).unwrap().transformation;
    let expected = b.tr_mul(&(DMatrix::from_diagonal(&lumped_mass(&right)) * &b));
    assert_relative_eq!(
        condensed,
        expected,
        epsilon = MATRIX_ROUND_OFF * expected.amax()
    );
}

#[test]
fn load_distribution_selects_z_of_19_upper_grids() {
    let model = first_model(&wing()).unwrap();
    let grids = measured_grids(model.structure());
    assert_eq!(
        grids,
        [
            11, 12, 14, 15, 16, 31, 32, 34, 35, 36, 51, 52, 54, 55, 71, 72, 74, 91, 92
        ]
    );
    let t = &model.load_distribution().clone();
    assert_eq!(t.shape(), (86, 19));
    assert_eq!(t.iter().filter(|entry| **entry != 0.0).count(), 19);
    for (column, &grid) in grids.iter().enumerate() {
        let row = model.structure().free_dof_index(grid, 2).unwrap();
        assert_eq!(t[(row, column)], 1.0);
    }
}

#[test]
fn condensed_frequencies_bound_those_of_the_whole_wing_from_above() {
    let dynamic = first_model(&wing())
        .and_then(|model| model.matrices(&true_factors()))
        .unwrap();
    assert_eq!(dynamic.mass.shape(), (19, 19));
    let condensed = solve(&dynamic.stiffness, &dynamic.mass, 12).unwrap();
    let whole = wing().modes().unwrap().modes.frequencies_hz();
    for (mode, frequency) in condensed.frequencies_hz().iter().enumerate() {
        let above = frequency / whole[mode] - 1.0;
        assert!(
            (0.0..CONDENSED_WING).contains(&above),
            "mode {}: {above:.2e}",
            mode + 1
        );
    }
}

#[test]
fn test_modes_are_ten_of_the_whole_wing_sampled() {
    let model = first_model(&wing()).unwrap();
    let mass = model.matrices(&[1.0; 21]).unwrap().mass;
    let test = test_modes(&wing())
        .and_then(|test| test.scaled_with(&mass))
        .unwrap();
    assert_eq!((test.len(), test.shapes().shape()), (10, (19, 10)));
    let whole = wing().modes().unwrap();
    let grids = measured_grids(model.structure());
    for (column, mode) in TEST_MODES.into_iter().enumerate() {
        assert_relative_eq!(
            test.frequencies_hz()[column],
            whole.modes.frequencies_hz()[mode - 1],
            max_relative = ROUND_OFF
        );
        let shape = test.shapes().column(column);
        assert_relative_eq!(
            shape.dot(&(&mass * shape)),
            1.0,
            max_relative = MATRIX_ROUND_OFF
        );
        let sampled = grids
            .iter()
            .map(|&grid| {
                let mut dof = whole.dof.iter();
                let row = dof.position(|dof| dof.grid == grid && dof.direction == 2);
                whole.modes.shapes()[(row.unwrap(), mode - 1)]
            })
            .collect_vec();
        let ratio = shape[4] / sampled[4];
        for (a, b) in shape.iter().zip(&sampled) {
            assert!((a - ratio * b).abs() <= ROUND_OFF * shape.amax());
        }
    }
}

#[test]
fn modes_left_out_are_close_and_exchanged_by_the_wrong_gages() {
    let whole = wing().modes().unwrap().modes.frequencies_hz();
    let separation = |mode: usize| whole[mode] / whole[mode - 1] - 1.0;
    let left_out = (1..=12)
        .filter(|mode| !TEST_MODES.contains(mode))
        .collect_vec();
    assert_eq!(left_out, [8, 9]);
    // The closest pair of the lowest twelve.
    assert_eq!(format!("{:.4}", separation(8)), "0.0160");
    assert!((1..12).all(|mode| mode == 8 || separation(mode) > 0.06));
    // The wrong gages exchange them: what answers mode 8 is above what answers mode 9.
    let first = first_model(&wing())
        .and_then(|model| model.matrices(&[1.0; 21]))
        .unwrap();
    let modes = solve(&first.stiffness, &first.mass, 19).unwrap();
    let right = first_model(&wing())
        .and_then(|model| model.matrices(&true_factors()))
        .unwrap();
    let truth = solve(&right.stiffness, &right.mass, 12).unwrap();
    let cross = cross_orthogonality(&modes, &truth, &first.mass).unwrap();
    let answers = pair_modes(&cross).unwrap().analysis_mode.to_vec();
    let mut expected = (0..12).collect_vec();
    expected.swap(7, 8);
    assert_eq!(answers, expected);
}
