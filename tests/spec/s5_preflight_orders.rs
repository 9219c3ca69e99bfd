//! The pre-flight: points in another order in shapes of any scale, ratios of frequencies, and what is too little to be named.

use crate::common::alter;
use crate::common::closed_forms::uniform_chain::uniform_held_modes;
use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF};
use crate::evidence::plant::mass_follows;
use crate::evidence::specimen::Specimen;
use crate::spec::s5_preflight::{agreement, case, chain, findings, mended, wing, with_shapes};
use corfem::chain::spring_stiffness;
use corfem::job::preflight::{Change, CommonFactor, Finding, LEAST_GAIN, LEAST_SHARE};
use corfem::method::model::DynamicModel;
use corfem::method::modes::{ModeSet, solve};
use corfem::method::pairing::{cross_orthogonality, pair_modes};
use nalgebra::DMatrix;

#[test]
fn points_in_another_order_are_named_whatever_the_scales_of_the_shapes() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let (points, modes) = specimen.test.shapes().shape();
        let order: Vec<usize> = (0..points).map(|place| (place + 3) % points).collect();
        let back: Vec<usize> = (0..points)
            .map(|place| (place + points - 3) % points)
            .collect();
        let mut shapes = specimen.test.shapes().select_rows(&order);
        (0..modes).for_each(|mode| {
            shapes
                .column_mut(mode)
                .scale_mut(-(10_f64.powi(3 * mode as i32 - 9)))
        });
        assert_eq!(
            mended(&with_shapes(&specimen, shapes)).change,
            Change::Reordered(back),
            "{}",
            specimen.name
        );
    }
}

#[test]
fn with_equal_masses_columns_in_another_order_stand_beside_points_in_it() {
    let right = chain();
    let order = [1, 2, 0, 3, 4, 7, 5, 6];
    let mut wrong = right.clone();
    wrong.model.stiffness = right
        .model
        .stiffness
        .select_rows(&order)
        .select_columns(&order);
    wrong.model.mass = DMatrix::identity(8, 8);
    wrong.test = solve(&right.model.stiffness, &wrong.model.mass, 8)
        .unwrap()
        .into();
    let found = mended(&wrong);
    assert_eq!(found.change, Change::Reordered(order.to_vec()));
    let mut back = vec![0; 8];
    order
        .iter()
        .enumerate()
        .for_each(|(place, &of)| back[of] = place);
    let (next, agreement) = found.next.expect("the columns");
    assert_eq!(next, Change::Columns(back));
    assert!((agreement - found.after).abs() < MATRIX_ROUND_OFF);
}

#[test]
fn a_mistake_that_costs_less_than_two_thousandths_is_not_named() {
    let (count, stiffness, mass) = (30, 2.0e4, 0.3);
    let model = DynamicModel {
        stiffness: (0..=count)
            .map(|spring| spring_stiffness(count, spring, stiffness))
            .sum(),
        mass: DMatrix::from_diagonal_element(count, count, mass),
        shares: Vec::new(),
    };
    // In the lowest mode the mass at the wall all but rests.
    let lowest = uniform_held_modes(count, stiffness, mass);
    let shape = lowest.shapes().columns(0, 1).into_owned();
    let test = ModeSet::new(lowest.omega_squared().rows(0, 1).into_owned(), shape).expect("a mode");
    let right = Specimen {
        model,
        test,
        ..chain()
    };
    let mut shapes = right.test.shapes().clone();
    shapes.row_mut(0).neg_mut();
    let wrong = with_shapes(&right, shapes);
    let [before, after] =
        [&wrong, &right].map(|specimen| agreement(&specimen.model, &specimen.test));
    assert!(after - before < LEAST_GAIN && after - before > LEAST_SHARE * (1.0 - before));
    assert_eq!(findings(&wrong), []);
}

#[test]
fn the_common_factor_is_the_median_of_the_ratios_of_pairs() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let mut wrong = specimen.clone();
        alter(&mut wrong.test, |squares, _| *squares *= 9.0);
        let [
            Finding::CommonFactor(CommonFactor {
                median, deviation, ..
            }),
        ] = findings(&wrong)[..]
        else {
            panic!("{}", specimen.name)
        };
        let model = &specimen.model;
        let analysis = solve(&model.stiffness, &model.mass, model.mass.nrows()).unwrap();
        let cross = cross_orthogonality(
            &analysis,
            &specimen.test.scaled_with(&model.mass).unwrap(),
            &model.mass,
        )
        .unwrap();
        let (test, all) = (wrong.test.frequencies_hz(), analysis.frequencies_hz());
        let pairs = pair_modes(&cross).unwrap().analysis_mode().to_vec();
        let mut ratios: Vec<f64> = test
            .iter()
            .zip(pairs)
            .map(|(test, mode)| test / all[mode])
            .collect();
        ratios.sort_by(f64::total_cmp);
        let (below, above) = (ratios[(ratios.len() - 1) / 2], ratios[ratios.len() / 2]);
        assert!(
            (median / (below * above).sqrt() - 1.0).abs() < ROUND_OFF,
            "{}",
            specimen.name
        );
        let mean = ratios
            .iter()
            .map(|ratio| (ratio / median).ln().abs())
            .sum::<f64>()
            / ratios.len() as f64;
        assert!((deviation - mean).abs() < ROUND_OFF, "{}", specimen.name);
    }
}

#[test]
fn ratios_that_scatter_have_no_common_factor() {
    for mut wrong in [case(2), chain()] {
        // By two and eight in turn: the factor between them is beyond what a first model is wrong by.
        alter(&mut wrong.test, |squares, _| {
            let both = squares.iter_mut().zip([4.0, 64.0].into_iter().cycle());
            both.for_each(|(value, factor)| *value *= factor);
        });
        let found = findings(&wrong);
        assert!(
            !found
                .iter()
                .any(|finding| matches!(finding, Finding::CommonFactor(_))),
            "{found:?}"
        );
    }
}

#[test]
fn masses_follow_the_columns_of_t_where_they_are_made_with_them() {
    // The wing's are of elements and come through T; those of the others are given at the points.
    assert!(mass_follows(&wing()));
    assert!(
        [case(1), case(2), case(3), chain()]
            .iter()
            .all(|specimen| !mass_follows(specimen))
    );
}

#[test]
fn masses_and_springs_of_the_chain_fall_by_equal_steps_from_the_wall() {
    let chain = chain();
    // The stiffness that has the test's modes: M V Ω² Vᵗ M.
    let momenta = &chain.model.mass * chain.test.scaled_with(&chain.model.mass).unwrap().shapes();
    let right = &momenta * DMatrix::from_diagonal(chain.test.omega_squared()) * momenta.transpose();
    let first = right[(0, 0)] + right[(0, 1)];
    for place in 0..8 {
        assert!((chain.model.mass[(place, place)] - (1.0 - 0.06 * place as f64)).abs() < ROUND_OFF);
        let spring = if place == 0 {
            first
        } else {
            -right[(place, place - 1)]
        };
        assert!(
            (spring / (1e6 * (1.0 - 0.08 * place as f64)) - 1.0).abs() < MATRIX_ROUND_OFF,
            "{place}: {spring}"
        );
    }
}
