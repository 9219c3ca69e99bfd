//! Deflections: further shapes of a basis in which changes of a whole model are followed.

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

    fn analyze(&self, factors: &[f64]) -> SensorModel {
        let pair = by_sorting();
        self.model
            .analyze(factors, &self.sensors, &self.test, pair, MODES[1])
            .unwrap()
    }
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
    let analyze = |factors: &[f64]| Ok::<_, Error>(Comparison::from(net.analyze(factors)));
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
