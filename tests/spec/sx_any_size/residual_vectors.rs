//! Residual vectors: further shapes of the basis in which changes of a whole model are followed.

use crate::prelude::*;

/// A net of springs between masses that move out of its plane, held at one edge; every column of it is a parameter. Springs and masses
/// vary from place to place by a rule, so that `golden/residual_vectors.py` has the same.
pub struct Net {
    model: WholeModel,
    sensors: SparseMatrix,
    test: Modes,
    truth: Vec<f64>,
}

/// Test modes, and the number of analysis modes that a job takes for them.
const MODES: [usize; 2] = [8, 12];

impl Net {
    pub fn new(rows: usize, columns: usize) -> Self {
        let count = rows * columns;
        let vary = |place: usize| 1.0 + 0.3 * (7.0 * place as f64).sin();
        let mut parts = vec![Vec::new(); columns];
        for row in 0..rows {
            for (column, part) in parts.iter_mut().enumerate() {
                let here = row * columns + column;
                if column + 1 < columns {
                    part.push((here, Some(here + 1), 1e5 * vary(2 * here)));
                }
                if row + 1 < rows {
                    part.push((here, Some(here + columns), 8e4 * vary(2 * here + 1)));
                }
                if row == 0 {
                    part.push((here, None, 1e5));
                }
            }
        }
        let parameters = parts.iter().enumerate().map(|(column, part)| {
            whole_parameter(
                format!("column {column}"),
                WholeShare::Stiffness(springs(count, part)),
            )
        });
        let mass = (0..count).map(|place| 60.0 * vary(3 * place)).collect_vec();
        let model = WholeModel::new(
            springs(count, &parts.concat()),
            masses(&mass),
            parameters.collect(),
        )
        .unwrap();
        let truth = (0..columns)
            .map(|e| (0.4 * (3.0 * e as f64).cos()).exp())
            .collect_vec();
        let places = (0..count).filter(|place| place % 3 == 1).collect_vec();
        let sensors = sensors_at(&places, count);
        let found = model.modes(&truth, MODES[0]).unwrap().vibrations;
        let test = seen_by(&sensors, &found);
        Self {
            model,
            sensors,
            test,
            truth,
        }
    }

    fn analyze(&self, factors: &[f64], further: usize) -> SensorModel {
        let pair = by_sorting();
        self.model
            .analyze(
                factors,
                &self.sensors,
                &self.test,
                pair,
                BasisSize {
                    modes: MODES[1],
                    residual_vectors: further,
                },
            )
            .unwrap()
    }
}

#[test]
fn residual_vectors_are_orthogonal_to_the_modes_and_to_each_other() {
    let net = Net::new(12, 9);
    let model = net.analyze(&[1.0; 9], 4);
    let k = model.omega_squared();
    assert_eq!(k.len(), MODES[1] + 4 * 9);
    // All stiffness belongs to parameters, so their shares add to that of the basis.
    let sum: DMatrix<f64> = model.shares().iter().map(|share| share.matrix()).sum();
    let scale = k.map(f64::sqrt);
    for (i, j) in (0..k.len()).flat_map(|i| (0..k.len()).map(move |j| (i, j))) {
        let expected = if i == j { k[i] } else { 0.0 };
        let off = (sum[(i, j)] - expected).abs() / (scale[i] * scale[j]);
        assert!(off < 100.0 * MATRIX_ROUND_OFF, "{i} {j} {off:e}");
    }
    // And none lies below the first mode left out.
    let left_out = net.model.modes(&[1.0; 9], MODES[1] + 1).unwrap().vibrations;
    let first = left_out.omega_squared()[MODES[1]];
    assert!(
        k.iter()
            .skip(MODES[1])
            .all(|square| *square > first * (1.0 - EIGEN_ROUND_OFF))
    );
}

/// One spring deforms in one way, however soft it is beside the others and however fast all vibrate.
#[test]
fn every_spring_has_one_residual_vector() {
    for (stiff, mass) in [(1.0, 1.0), (1e9, 1e-2), (1e-6, 1e3)] {
        let count = 30;
        let spring = |row: usize, size: f64| (row, row.checked_sub(1), size * stiff);
        let chain = (0..count).map(|row| spring(row, 1.0)).collect_vec();
        // Three of them are parameters with another in parallel: as stiff, and ever softer.
        let sizes = [1.0, 1e-3, 1e-7];
        let parts = sizes.iter().zip([7, 15, 24]);
        let parts = parts.map(|(&size, row)| spring(row, size)).collect_vec();
        let parameters = parts.iter().map(|&part| {
            whole_parameter(
                format!("spring at {}", part.0),
                WholeShare::Stiffness(springs(count, &[part])),
            )
        });
        let model = WholeModel::new(
            springs(count, &[chain, parts.clone()].concat()),
            masses(&vec![mass; count]),
            parameters.collect(),
        )
        .unwrap();
        let sensors = sensors_at(&[5, 12, 20, 28], count);
        let test = seen_by(&sensors, &model.modes(&[1.0; 3], 4).unwrap().vibrations);
        let found = model
            .analyze(
                &[1.0; 3],
                &sensors,
                &test,
                by_sorting(),
                BasisSize {
                    modes: 4,
                    residual_vectors: 4,
                },
            )
            .unwrap();
        assert_eq!(found.omega_squared().len(), 4 + 3, "{stiff:e} {mass:e}");
    }
}

/// Largest relative error of the eight lowest frequencies that a basis predicts, the median over changes within e^±0.3.
fn predicted(net: &Net, further: usize) -> f64 {
    let first = net.analyze(&[1.0; 9], further);
    let mut errors = (1..=25)
        .map(|draw| {
            let factor = |e: usize| (0.3 * (f64::from(draw) * (1.7 + e as f64)).sin()).exp();
            let factors = (0..9).map(factor).collect_vec();
            // Solved in the basis, whose shapes are orthonormal in the mass.
            let mut stiffness = DMatrix::from_diagonal(first.omega_squared());
            for (share, factor) in first.shares().iter().zip(&factors) {
                stiffness += (factor - 1.0) * share.matrix();
            }
            let size = stiffness.nrows();
            let found = solve(&stiffness, &eye(size), MODES[0]).unwrap();
            let found = found.frequencies_hz();
            let exact = net.model.modes(&factors, MODES[0]).unwrap().vibrations;
            let off = found.iter().zip(exact.frequencies_hz());
            off.map(|(found, exact)| relative_error(found, exact))
                .largest()
        })
        .collect_vec();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() / 2]
}

#[test]
fn four_residual_vectors_a_parameter_predict_frequencies_twenty_times_better() {
    let net = Net::new(12, 9);
    let [none, four] = [0, 4].map(|further| predicted(&net, further));
    assert!(four < none / 20.0, "{none:e} to {four:e}");
}

/// The fewest that SciPy's least squares takes of the same net and test with exact derivatives, by `golden/residual_vectors.py`: the
/// method dogbox; trf takes 25.
const SCIPY_ANALYSES: usize = 12;

#[test]
fn a_net_of_300_degrees_of_freedom_comes_back_at_the_usual_number_of_modes() {
    let net = Net::new(20, 15);
    let settings = WeightedSettings {
        prior_deviations: vec![1e3],
        ..WeightedSettings::default()
    };
    let weights = equal_weights(DEVIATIONS, MODES[0]);
    let analyze = |factors: &[f64]| Ok::<_, Error>(Comparison::from(net.analyze(factors, 0)));
    let found = gauss_newton(analyze, &[1.0; 15], &[None; 15], &weights, &settings).unwrap();
    let worst = |factors: &[f64]| {
        let off = factors
            .iter()
            .zip(&net.truth)
            .map(|(found, truth)| relative_error(found, truth));
        off.largest()
    };
    assert_eq!(found.stop, WeightedStop::Gradient);
    assert!(worst(&found.factors) < 1e-5);
    assert!(found.analyses <= SCIPY_ANALYSES);
}
