//! Slopes of weighted residuals at whole models: exact, though most modes are not known.

use crate::prelude::*;
use proptest::collection::vec;
use proptest::prelude::{Strategy, any};

/// Modes that are compared, and those that are asked for.
const MODES: [usize; 2] = [4, 6];

/// A row of springs and masses in which single springs and single masses are parameters, with its test.
#[derive(Debug, Clone)]
struct Row {
    model: WholeModel,
    sensors: SparseMatrix,
    test: Modes,
}

impl Row {
    /// A row of masses on springs, held at one end or free, of which every spacing-th spring and mass is a parameter, and every so many
    /// points are seen.
    fn new(sizes: &[f64], is_held: bool, spacing: usize, seen: usize) -> Self {
        let count = sizes.len();
        let mut all = (1..count)
            .map(|at| (at, Some(at - 1), 1e5 * sizes[at]))
            .collect_vec();
        if is_held {
            all.push((0, None, 1e5));
        }
        let mass = sizes.iter().rev().map(|size| 60.0 * size).collect_vec();
        let parameter = |name: String, share| WholeParameter {
            name,
            share,
            range: None,
        };
        let of_spring = |spring: &(usize, Option<usize>, f64)| {
            let share = WholeShare::Stiffness(springs(count, &[*spring]));
            parameter(format!("spring {}", spring.0), share)
        };
        let of_mass = |at: usize| {
            let own = (0..count)
                .map(|row| if row == at { mass[at] } else { 0.0 })
                .collect_vec();
            parameter(format!("mass {at}"), WholeShare::Mass(masses(&own)))
        };
        let parameters = all.iter().step_by(spacing).map(of_spring);
        let parameters = parameters.chain((1..count).step_by(2 * spacing).map(of_mass));
        let model = WholeModel::new(springs(count, &all), masses(&mass), parameters.collect());
        let model = model.unwrap();
        let sensors = sensors_at(&(0..count).step_by(seen).collect_vec(), count);
        let other = (0..model.parameters().len())
            .map(|e| 1.0 + 0.1 * (e % 3) as f64)
            .collect_vec();
        let found = model.modes(&other, MODES[0]).unwrap().vibrations;
        let test = seen_by(&sensors, &found);
        Self {
            model,
            sensors,
            test,
        }
    }

    fn at(&self, factors: &[f64]) -> Comparison {
        let size = MODES[1];
        let pair = by_sorting();
        self.model
            .analyze(factors, &self.sensors, &self.test, pair, size)
            .unwrap()
            .into()
    }
}

/// Held and free rows of which few sensors see many parameters, and many see few: each is a way of its own to the slopes.
fn rows() -> impl Strategy<Value = (Row, bool)> {
    let sizes = vec(0.5..2.0_f64, 60..90);
    (sizes, any::<bool>(), any::<bool>()).prop_map(|(sizes, is_held, sees_much)| {
        let (spacing, seen) = if sees_much { (25, 2) } else { (4, 9) };
        (Row::new(&sizes, is_held, spacing, seen), sees_much)
    })
}

properties! {
    #![proptest_config(costly_config())]

    /// The Jacobian is that of central differences of exact analyses, whatever modes are asked for.
    #[test]
    fn slopes_are_those_of_differences_of_exact_analyses((row, _) in rows()) {
        let (count, weights) = (row.model.parameters().len(), equal_weights(DEVIATIONS, MODES[0]));
        let exact = jacobian(&row.at(&vec![1.0; count]), &weights)?;
        let step = 1e-4_f64;
        let differences = (0..count).map(|e| {
            let side = |log: f64| {
                let mut factors = vec![1.0; count];
                factors[e] = log.exp();
                residuals(&row.at(&factors), &weights).unwrap()
            };
            (side(step) - side(-step)) / (2.0 * step)
        }).collect_vec();
        let off = (&exact - DMatrix::from_columns(&differences)).amax() / exact.amax();
        assert!(off < EXACT_SLOPES, "{off:e}");
    }
}

/// Both ways are drawn.
#[test]
fn rows_are_seen_from_the_sensors_and_from_the_loads() {
    for (spacing, seen, few_sensors) in [(25, 2, false), (4, 9, true)] {
        let row = Row::new(&[1.0; 70], true, spacing, seen);
        let loads = row.model.parameters().len() * MODES[0];
        assert_eq!(loads >= row.sensors.rows(), few_sensors);
    }
}
