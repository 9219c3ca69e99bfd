//! Standard deviations of components and covariances of all numbers: what residuals and jobs make of them, and whether intervals hold
//! the truth.

use crate::prelude::*;
use crate::spec::sx_weighted::at;

/// A chain of six masses by its matrices, every spring a parameter.
fn chain() -> DynamicModel {
    let whole = shear_building(&[1e5, 8e4, 1.2e5, 9e4, 1.1e5, 1e5], 60.0, None);
    let (stiffness, mass) = whole.at(&[1.0; 6]).unwrap();
    let share = |share: &WholeShare| match share {
        WholeShare::Stiffness(matrix) => matrix.dense(),
        _ => unreachable!("stories are stiffness"),
    };
    DynamicModel {
        stiffness: stiffness.dense(),
        mass: mass.dense(),
        shares: whole
            .parameters()
            .iter()
            .map(|parameter| share(&parameter.share))
            .collect(),
    }
}

/// The building's test with other deviations.
fn job(change: impl FnOnce(&mut TestData)) -> JobResult {
    let (_folder, path) = placed(&building());
    let mut data = prepare(&path).unwrap().loaded.data.clone();
    change(&mut data);
    corrected(data)
}

fn corrected(data: TestData) -> JobResult {
    let mut files: Files = building();
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    test.unwrap().1 = write_csv(&data);
    let loaded = prepared(&files);
    finished(&loaded)
}

/// The noise of a job's test, so that weights matter.
fn noisy(data: &mut TestData) {
    let exact = Modes::from_measured(&data.frequencies_hz, &data.shapes).unwrap();
    let test = with_noise(&exact, Noise::USUAL, 11).unwrap();
    (data.frequencies_hz, data.shapes) = (test.frequencies_hz(), test.shapes().clone());
}

#[test]
fn equal_deviations_of_components_are_the_deviation_of_the_shape() {
    let of_shapes = job(|data| {
        noisy(data);
        data.shape_deviation = Some(vec![0.013; 5]);
    });
    let of_components = job(|data| {
        noisy(data);
        let own = DVector::from_element(5, 0.013);
        data.component_deviation = (0..5).map(|mode| (mode, own.clone())).collect();
        // A column takes the place of the row's number.
        data.shape_deviation = Some(vec![0.4; 5]);
    });
    assert_alike(
        of_shapes.found.factors.iter(),
        &of_components.found.factors,
        WEIGHTED_FACTOR,
    );
    let [one, two] = [&of_shapes, &of_components].map(|of| of.misfit.chi_squared);
    assert!(relative_error(one, two) < WEIGHTED_FACTOR, "{one} {two}");
    let others = of_components.trust.about(Kind::AssumedDeviations);
    assert_eq!(others.len(), 1, "frequencies alone are assumed: {others:?}");
}

/// As the deviation of a component grows, the test becomes one without its sensor.
#[test]
fn a_component_of_boundless_deviation_is_as_one_without_a_sensor() {
    let largest = |data: &TestData| data.shapes.column(0).iamax();
    let vague = job(|data| {
        noisy(data);
        let row = largest(data);
        let own = DVector::from_fn(5, |sensor, _| if sensor == row { 1e5 } else { 0.01 });
        data.component_deviation = (0..5).map(|mode| (mode, own.clone())).collect();
    });
    let without = job(|data| {
        noisy(data);
        let row = largest(data);
        // Deviations are fractions of the largest component of all, which the others then lack.
        let scale = |mode: usize| {
            let shape = data.shapes.column(mode);
            shape.amax() / shape.into_owned().remove_row(row).amax()
        };
        let own = |mode: usize| (mode, DVector::from_element(4, 0.01 * scale(mode)));
        let own: BTreeMap<usize, DVector<f64>> = (0..5).map(own).collect();
        data.component_deviation = own;
        data.shapes = data.shapes.clone().remove_row(row);
        data.sensors.remove(row);
    });
    assert_alike(
        vague.found.factors.iter(),
        &without.found.factors,
        WEIGHTED_FACTOR,
    );
}

/// Residuals of any covariance by their definition: the least of all scales of the shapes, by normal equations.
#[test]
fn residuals_with_a_covariance_are_those_of_generalized_least_squares() {
    let first = chain();
    let exact = solve(&first.stiffness, &first.mass, 4).unwrap();
    for seed in 1..=6 {
        let mut draws = Draws(seed);
        let test = with_noise(&exact, Noise::USUAL, seed).unwrap();
        let weights = equal_weights(Noise::USUAL, 4);
        let root = DMatrix::from_fn(28, 28, |i, j| {
            draws.between(-0.3, 0.3) + f64::from(u8::from(i == j))
        });
        let covariance = symmetric_part(&(&root * root.transpose()));
        let groups = if seed % 2 == 0 {
            vec![vec![1, 2]]
        } else {
            Vec::new()
        };
        let analyzed = |factors: &[f64]| {
            let model = Comparison::from(&at(&first, factors).analyze(&test, None).unwrap());
            let model = model.with_groups(groups.clone()).unwrap();
            model.with_covariance(&covariance).unwrap()
        };
        let factors = (0..6).map(|_| draws.between(0.8, 1.2)).collect_vec();
        let (model, inverse) = (
            analyzed(&factors),
            covariance.clone().try_inverse().unwrap(),
        );
        let found = residuals(&model, &weights).unwrap();
        // Free columns: the shapes that a test mode is compared with, in its rows.
        let (mut plain, mut free) = (DVector::zeros(28), Vec::new());
        let State { modes, pairing, .. } = model.model().exact();
        for (j, &i) in pairing.analysis_mode.iter().enumerate() {
            let ratio = modes.omega_squared()[i] / test.omega_squared()[j];
            plain[7 * j] = weights[j].frequency * (ratio.sqrt() - 1.0);
            let tested = test.shapes().column(j);
            plain
                .rows_mut(7 * j + 1, 6)
                .copy_from(&(-weights[j].shape / tested.amax() * tested));
            let together = groups.iter().find(|group: &&Vec<usize>| group.contains(&j));
            for test in together.cloned().unwrap_or(vec![j]) {
                let partner = pairing.analysis_mode[test];
                let mut column = DVector::zeros(28);
                let shape = modes.shapes().column(partner);
                column.rows_mut(7 * j + 1, 6).copy_from(&shape);
                free.push(column);
            }
        }
        let free = DMatrix::from_columns(&free);
        let normal = free.transpose() * &inverse * &free;
        let scales = normal
            .cholesky()
            .unwrap()
            .solve(&(free.transpose() * &inverse * &plain));
        let least = &plain - free * scales;
        let expected = (least.transpose() * &inverse * &least)[(0, 0)];
        let off = relative_error(found.norm_squared(), expected);
        assert!(off < CORRECTION_ROUND_OFF, "seed {seed}: {off:e}");
        // The gradient of half of it.
        let gradient = jacobian(&model, &weights).unwrap().tr_mul(&found);
        let step = 1e-5_f64;
        for e in 0..6 {
            let half = |log: f64| {
                let mut factors = factors.clone();
                factors[e] *= log.exp();
                0.5 * residuals(&analyzed(&factors), &weights)
                    .unwrap()
                    .norm_squared()
            };
            let difference = (half(step) - half(-step)) / (2.0 * step);
            let off = (difference - gradient[e]).abs();
            assert!(
                off < CENTRAL_DIFFERENCE_GRADIENT * gradient.amax(),
                "{seed} {e}: {off:e}"
            );
        }
        // Independent ones of unit variance are what they were, and so is the gradient.
        let plain = Comparison::from(&at(&first, &factors).analyze(&test, None).unwrap());
        let unit = plain.clone().with_covariance(&eye(28)).unwrap();
        let [one, two] = [&plain, &unit].map(|model| {
            let residuals = residuals(model, &weights).unwrap();
            let gradient = jacobian(model, &weights).unwrap().tr_mul(&residuals);
            (residuals, gradient)
        });
        assert!((&one.0 - &two.0).amax() < MATRIX_ROUND_OFF * one.0.amax());
        assert!((&one.1 - &two.1).amax() < MATRIX_ROUND_OFF * one.1.amax());
        let singular = DMatrix::from_element(28, 28, 1.0);
        assert!(plain.clone().with_covariance(&singular).is_err());
        assert!(plain.clone().with_covariance(&eye(27)).is_err());
        // A frequency without a shape is one more number.
        let lone = LoneFrequency {
            frequency_hz: 10.0,
            partner: 5,
        };
        let more = plain.with_lone_frequencies(vec![lone]).unwrap();
        for (count, is_right) in [(27, false), (28, false), (29, true)] {
            let unit = eye(count);
            assert_eq!(more.clone().with_covariance(&unit).is_ok(), is_right);
        }
    }
}
