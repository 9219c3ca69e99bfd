//! The objective (5, 6): zero only on equal modes, blind to scale and sign of shapes, relative in frequency.

use crate::prelude::*;

/// Analysis modes that are the test modes' partners in order, with the test's signs.
fn in_order(count: usize) -> Pairing {
    Pairing {
        analysis_mode: (0..count).collect(),
        sign: vec![1.0; count],
    }
}

properties! {
    #[test]
    fn errors_of_equal_modes_are_zero((chain, truth) in chain_and_truth()) {
        let modes = chain.modes(&truth);
        let found = errors(&modes, &in_order(modes.len()), &modes)?;
        prop_assert_eq!((found.frequency, found.shape, found.sum()), (0.0, 0.0, 0.0));
        prop_assert_eq!((found.frequency_count, found.shape_count), (modes.len(), modes.len()));
    }

    #[test]
    fn errors_do_not_depend_on_scale_or_sign_of_shapes(
        (chain, truth) in chain_and_truth(),
        scales in prop::collection::vec((1e-3..1e3_f64, any::<bool>(), 1e-3..1e3_f64), 5),
    ) {
        let (analysis, test) = (chain.modes(&vec![1.0; truth.len()]), chain.modes(&truth));
        let expected = errors(&analysis, &in_order(test.len()), &test)?;
        let (mut scaled, mut scaled_test) = (analysis.clone(), test.clone());
        let mut signs = vec![1.0; test.len()];
        for (mode, (scale, flip, test_scale)) in scales.into_iter().take(test.len()).enumerate() {
            let sign = if flip { -1.0 } else { 1.0 };
            alter(&mut scaled, |_, shapes| shapes.column_mut(mode).scale_mut(sign * scale));
            signs[mode] = sign;
            alter(&mut scaled_test, |_, shapes| shapes.column_mut(mode).scale_mut(test_scale));
        }
        let found = errors(&scaled, &Pairing { analysis_mode: (0..test.len()).collect(), sign: signs }, &scaled_test)?;
        prop_assert_eq!(found.frequency, expected.frequency);
        prop_assert!((found.shape - expected.shape).abs() <= ROUND_OFF);
    }

    #[test]
    fn errors_do_not_depend_on_the_order_of_modes(
        (chain, truth) in chain_and_truth(),
        change in rearrangement(5),
    ) {
        let (analysis, test) = (chain.modes(&vec![1.0; truth.len()]), chain.modes(&truth));
        let expected = errors(&analysis, &in_order(test.len()), &test)?;
        let order = change.order.iter().copied().filter(|&i| i < test.len()).collect_vec();
        let reordered = Modes::new(test.omega_squared().select_rows(&order), test.shapes().select_columns(&order))?;
        let pairing = Pairing { analysis_mode: order, sign: vec![1.0; test.len()] };
        let found = errors(&analysis, &pairing, &reordered)?;
        prop_assert!((found.frequency - expected.frequency).abs() <= ROUND_OFF);
        prop_assert!((found.shape - expected.shape).abs() <= ROUND_OFF);
    }

    #[test]
    fn the_error_sum_is_that_of_its_definition((chain, truth) in chain_and_truth()) {
        let analysis = chain.modes(&vec![1.0; truth.len()]);
        let test = chain.modes(&truth);
        let cross = cross_orthogonality(&analysis, &test, &chain.mass())?;
        let pairing = pair_modes(&cross)?;
        let found = errors(&analysis, &pairing, &test)?.sum();
        let model = chain.model(&vec![1.0; truth.len()]);
        let expected = error_sum_by_definition(&model.stiffness, &model.mass, &test);
        prop_assert!((found - expected).abs() <= MATRIX_ROUND_OFF, "{found} {expected}");
    }
}

#[test]
fn errors_by_hand() {
    // Frequencies 1.1 and 1.8 against 1 and 2: (0.1)^2 + (-0.1)^2. Shapes (2, 1) against (1, 0) is (1, 1/2) against
    // (1, 0), and (1, -3) against (-1, 4), turned, is (-1/3, 1) against (-1/4, 1): (1/4 + 1/144)/2.
    let analysis = Modes::new(dvector![3.24, 1.21], dmatrix![1.0, 2.0; -3.0, 1.0]).unwrap();
    let test = Modes::new(dvector![1.0, 4.0], dmatrix![1.0, -1.0; 0.0, 4.0]).unwrap();
    let pairing = Pairing {
        analysis_mode: vec![1, 0],
        sign: vec![1.0, -1.0],
    };
    let found = errors(&analysis, &pairing, &test).unwrap();
    assert_within(found.frequency, 0.02_f64.sqrt(), ROUND_OFF);
    assert_within(found.shape, (37.0 / 288.0_f64).sqrt(), ROUND_OFF);
    assert_eq!((found.frequency_count, found.shape_count), (2, 2));
}

#[test]
fn squares_too_large_for_a_number_are_refused_as_such() {
    let modes = |scale| Modes::new(dvector![scale], dmatrix![1.0]).unwrap();
    assert_refused(
        errors(&modes(1e300), &in_order(1), &modes(1e-20)),
        Error::Value {
            what: "error sum",
            owner: "these modes".into(),
            value: f64::INFINITY,
            expected: "a finite number",
        },
    );
}

#[test]
fn sums_and_root_mean_squares_by_hand() {
    let errors = Errors {
        frequency: 0.3,
        shape: 0.6,
        frequency_count: 9,
        shape_count: 4,
    };
    assert_within(errors.sum(), 0.9, ROUND_OFF);
    assert_within(errors.frequency_rms(), 0.1, ROUND_OFF);
    assert_within(errors.shape_rms(), 0.3, ROUND_OFF);
    let of_one = Errors {
        shape_count: 1,
        ..errors
    };
    assert_within(of_one.shape_rms(), 0.6, ROUND_OFF);
}

#[test]
fn weights_multiply_the_errors_of_their_modes() {
    let plain = SensorModel::from(&first_problem(2));
    let weight = |mode: usize| ModeWeight {
        frequency: mode as f64 % 3.0,
        shape: (mode + 1) as f64 % 3.0,
    };
    let weights = (0..9).map(weight).collect_vec();
    let exact = plain.exact();
    let each = mode_errors(&exact.modes, &exact.pairing, plain.test()).unwrap();
    let both = || each.iter().zip(&weights);
    let frequencies = both().map(|(error, weight)| weight.frequency * error.frequency);
    let shapes = both().map(|(error, weight)| weight.shape * error.shape);
    let weighted = plain.clone().weighted(&weights).unwrap();
    let found = weighted.exact().errors;
    assert_within(
        found.frequency.powi(2),
        frequencies.map(|x| x * x).sum::<f64>(),
        ROUND_OFF,
    );
    assert_within(
        found.shape.powi(2),
        shapes.map(|x| x * x).sum::<f64>(),
        ROUND_OFF,
    );
    // They do so wherever errors are taken, and weights of one change nothing.
    let at = |model: &SensorModel| model.at(&[0.9; 15]).unwrap().errors;
    assert_ne!(at(&weighted), at(&plain));
    let ones = plain.clone().weighted(&[ModeWeight::ONE; 9]).unwrap();
    assert_eq!((ones.exact().errors, at(&ones)), (exact.errors, at(&plain)));
    for (frequency, shape, value) in [
        (-1.0, 1.0, -1.0),
        (1.0, f64::NAN, f64::NAN),
        (f64::INFINITY, 1.0, f64::INFINITY),
        (0.0, 0.0, 0.0),
    ] {
        let error = Error::Value {
            what: "weight",
            owner: "the test modes".into(),
            value,
            expected: "a finite number from zero up, one of them positive",
        };
        assert_refused(
            plain
                .clone()
                .weighted(&[ModeWeight { frequency, shape }; 9]),
            error,
        );
    }
    let few = plain.clone().weighted(&weights[1..]).map(drop);
    assert_eq!(said(few), "weights: 8 x 1 instead of 9 x 1");
}
