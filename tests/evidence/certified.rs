//! Certified numbers: every frequency of Tables 3, 5, 7 and 9 and of Case 4, with a bound that proves its digits and a count that
//! proves that none is missing.
//!
//! Given the crate's element matrices, gages and masses as the numbers they are, the structural stiffness, its flexibility at the
//! dynamic points and the count of roots below a number are computed in integers, without rounding. For an approximate mode $(\lambda, v)$ a
//! root lies within
//!
//! $$ \lvert\lambda - \lambda_{exact}\rvert \le \lVert M^{-1/2}(K v - \lambda M v)\rVert / \lVert M^{1/2} v\rVert , $$
//!
//! evaluated in double-double with its own round-off added. The count says that exactly one root is there, and which one it is by
//! its place from below: so every root is found once, and none is left between them. That the element matrices are those of the
//! coordinates is the business of `double_double`.

use crate::common::double_double::{DD_EPSILON, Dd};
use crate::common::double_double_matrices::{Rows, inverse, product as matrix_product, rows};
use crate::common::inertia::{Flexible, Lower, negative_eigenvalues, product, scaled};
use crate::common::tolerances::{CERTIFIED_ROOT, SHOWN_UNITS};
use corfem::method::analysis::Analysis;
use corfem::method::inner_loop::run;
use corfem::method::modes::Modes;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, PUBLISHED_RUNS, fewer_modes_run};
use corfem::torque_box::wing_box::{PANEL_COUNT, TEST_GAGE};
use corfem::torque_box::{CASES, Case, run_case};
use nalgebra::DMatrix;
use num_bigint::BigInt;
use std::f64::consts::PI;

/// A pencil whose roots can be counted in integers, and its matrices in double-double.
struct Pencil {
    stiffness: Rows,
    mass: Vec<f64>,
    below: Box<dyn Fn(f64) -> usize>,
}

/// The structure at gages, from its element matrices on.
fn of_structure(case: &Case, gages: &[f64]) -> Pencil {
    let model = case.model_with(gages).expect("a model");
    let (t, mass) = (model.load_distribution().clone(), model.mass().diagonal());
    let size = t.nrows();
    let mut stiffness: Lower = (0..size).map(|i| vec![BigInt::from(0); i + 1]).collect();
    let sizes = model
        .structure()
        .elements()
        .iter()
        .map(|element| element.size);
    for (element, size) in model.element_matrices().iter().zip(sizes) {
        for (a, &row) in element.dof.iter().enumerate() {
            for (b, &column) in element
                .dof
                .iter()
                .enumerate()
                .filter(|&(_, &column)| column <= row)
            {
                stiffness[row][column] += product(size, element.unit[(a, b)]);
            }
        }
    }
    let loads: Vec<Vec<f64>> = t
        .row_iter()
        .map(|row| row.iter().copied().collect())
        .collect();
    let flexible = Flexible::new(stiffness, &loads, mass.as_slice());
    let entry = |i: usize, j: usize| {
        let (high, rest) = flexible.entry(i, j);
        Dd::from(high) + Dd::from(rest)
    };
    let stiffness = inverse(&rows(mass.len(), mass.len(), entry));
    Pencil {
        stiffness,
        mass: mass.as_slice().to_vec(),
        below: Box::new(move |square| flexible.below(square)),
    }
}

/// The inner loop's own: $\mathrm{diag}(\omega^2) + \sum (c_e - 1) V^t K_e V$ in the modes that the pass began with.
fn of_inner_loop(squares: &[f64], shares: &[&DMatrix<f64>], factors: &[f64]) -> Pencil {
    let entry = |i: usize, j: usize| {
        let own = if i == j {
            product(squares[i], 1.0)
        } else {
            BigInt::from(0)
        };
        let change = |(share, &factor): (&&DMatrix<f64>, &f64)| {
            product(factor, share[(i, j)]) - product(1.0, share[(i, j)])
        };
        own + shares.iter().zip(factors).map(change).sum::<BigInt>()
    };
    let size = squares.len();
    let exact: Lower = (0..size)
        .map(|i| (0..=i).map(|j| entry(i, j)).collect())
        .collect();
    let stiffness = rows(size, size, |i, j| {
        let number = |value: f64| Dd::from(value);
        let own = if i == j { number(squares[i]) } else { Dd::ZERO };
        let change = |(share, &factor): (&&DMatrix<f64>, &f64)| {
            (number(factor) - Dd::ONE) * number(share[(i, j)])
        };
        own + shares.iter().zip(factors).map(change).sum::<Dd>()
    });
    let below = move |square: f64| {
        let mut shifted = exact.clone();
        (0..size).for_each(|i| shifted[i][i] -= scaled(square, 256));
        negative_eigenvalues(shifted)
    };
    Pencil {
        stiffness,
        mass: vec![1.0; size],
        below: Box::new(below),
    }
}

impl Pencil {
    /// The residual's bound for a mode, relative to its root, and what the evaluation itself may have lost.
    fn bound(&self, square: f64, shape: &[f64]) -> f64 {
        let shape: Vec<Dd> = shape.iter().copied().map(Dd::from).collect();
        let column: Rows = shape.iter().map(|&component| vec![component]).collect();
        let forces = matrix_product(&self.stiffness, &column);
        let (mut residual, mut norm, mut magnitude) = (Dd::ZERO, Dd::ZERO, Dd::ZERO);
        for (i, &mass) in self.mass.iter().enumerate() {
            let inertia = Dd::from(square) * Dd::from(mass) * shape[i];
            let rest = forces[i][0] - inertia;
            residual += rest * rest / Dd::from(mass);
            norm += Dd::from(mass) * shape[i] * shape[i];
            let parts: Dd = self.stiffness[i]
                .iter()
                .zip(&shape)
                .map(|(&k, &v)| (k * v).abs())
                .sum();
            let parts = parts + inertia.abs();
            magnitude += parts * parts / Dd::from(mass);
        }
        // Inverting the flexibility multiplies round-off by its condition, 1e6: a billion units are room enough.
        let lost = Dd::from(1e9 * DD_EPSILON) * magnitude.sqrt();
        ((residual.sqrt() + lost) / norm.sqrt() / Dd::from(square)).to_f64()
    }

    /// Certifies modes as the lowest of the pencil: a root within the bound of each, and no other below or between.
    fn certify(&self, what: &str, modes: &Modes) {
        let mut order: Vec<usize> = (0..modes.len()).collect();
        order.sort_by(|&a, &b| modes.omega_squared()[a].total_cmp(&modes.omega_squared()[b]));
        for (place, &mode) in order.iter().enumerate() {
            let square = modes.omega_squared()[mode];
            let bound = self.bound(square, modes.shapes().column(mode).as_slice());
            assert!(bound < CERTIFIED_ROOT, "{what}, mode {mode}: {bound:e}");
            // A rounding each for the two ends.
            let [lower, upper] =
                [-1.0, 1.0].map(|side: f64| square * (1.0 + side * (bound + 2.0 * f64::EPSILON)));
            assert_eq!(
                ((self.below)(lower), (self.below)(upper)),
                (place, place + 1),
                "{what}, mode {mode}"
            );
        }
    }
}

impl Pencil {
    /// Asserts that modes have the lowest frequencies to the last of the ten digits that tables have as numbers (other tables show
    /// fewer of the same): a rounded one is half a unit off.
    fn assert_shown(&self, what: &str, modes: &Modes) {
        let mut shown: Vec<String> = modes
            .frequencies_hz()
            .iter()
            .map(|frequency| format!("{frequency:.9e}"))
            .collect();
        shown.sort_by(|a, b| read(a).total_cmp(&read(b)));
        for (place, printed) in shown.iter().enumerate() {
            let unit = 10f64.powi(
                printed
                    .split('e')
                    .nth(1)
                    .and_then(|power| power.parse().ok())
                    .unwrap_or(0)
                    - 9,
            );
            let square = |units: f64| (2.0 * PI * (read(printed) + units * unit)).powi(2);
            let counts = (
                (self.below)(square(-SHOWN_UNITS)),
                (self.below)(square(SHOWN_UNITS)),
            );
            assert_eq!(counts, (place, place + 1), "{what}: {printed}");
        }
    }
}

fn read(printed: &str) -> f64 {
    printed.parse().expect("a number")
}

#[test]
fn frequencies_of_the_cases_are_certified() {
    for number in CASES {
        let case = Case::new(number).expect("a case");
        let found = run_case(&case, |_, _| {}).expect("it runs");
        let run = &found.correlation;
        let mut columns = vec![
            ("GVT".to_owned(), vec![TEST_GAGE; PANEL_COUNT], &found.test),
            ("Initial".to_owned(), case.first_gages(), &run.initial.modes),
        ];
        for (row, pass) in run.passes.iter().enumerate() {
            columns.push((
                format!("Pass {}", row + 1),
                found.pass_gages[row].clone(),
                &pass.check.modes,
            ));
        }
        for (column, gages, modes) in columns {
            let what = format!("Case {number}, {column}");
            let pencil = of_structure(&case, &gages);
            pencil.certify(&what, modes);
            pencil.assert_shown(&what, modes);
        }
    }
}

/// Table 9 prints the inner loop's own frequencies of the runs with five test modes; the exact ones stand beside them. Those of the
/// runs with seven and three, of Tables 10 and 12, are certified too.
#[test]
fn frequencies_with_fewer_modes_are_certified() {
    let case = Case::new(PUBLISHED_CASE).expect("a case");
    let model = case.model().expect("a model");
    let ones = vec![1.0; PANEL_COUNT];
    for (test_modes, analysis_modes) in PUBLISHED_RUNS {
        let what = format!("{test_modes} test and {analysis_modes} analysis modes");
        let test = case.test_modes().unwrap().lowest(test_modes).unwrap();
        let analyzed = model
            .analyze(&ones, &test, Some(analysis_modes))
            .expect("solved");
        let inner = run(
            &analyzed,
            &ones,
            &model.factor_ranges().unwrap(),
            &case.settings.inner,
        )
        .expect("it runs");
        let shares: Vec<&DMatrix<f64>> = analyzed.shares().iter().collect();
        let squares = analyzed.exact().modes.omega_squared().as_slice();
        let modal = Modes::new(
            inner.last.modes.omega_squared().clone(),
            inner.last.generalized_shapes.clone(),
        )
        .expect("modes");
        let inner = of_inner_loop(squares, &shares, &inner.last.factors);
        inner.certify(&what, &modal);
        let gages = fewer_modes_run(&case, test_modes, analysis_modes)
            .expect("it runs")
            .gages_in;
        let exact = case
            .model_with(&gages)
            .unwrap()
            .modes(&ones)
            .expect("solved");
        let structure = of_structure(&case, &gages);
        structure.certify(&what, &exact);
        inner.assert_shown(&what, &modal);
        structure.assert_shown(&what, &exact);
    }
}

/// Counting in integers where the answer is known: a chain of nine has the roots $2 - 2\cos\frac{j\pi}{10}$.
#[test]
fn the_count_below_a_number_is_that_of_the_roots() {
    let chain = |square: f64| {
        let entry = |i: usize, j: usize| match i - j {
            0 => scaled(2.0, 256) - scaled(square, 256),
            1 => scaled(-1.0, 256),
            _ => BigInt::from(0),
        };
        (0..9)
            .map(|i| (0..=i).map(|j| entry(i, j)).collect())
            .collect::<Lower>()
    };
    for j in 0..9 {
        let root = 2.0 - 2.0 * ((j + 1) as f64 * PI / 10.0).cos();
        for (side, count) in [(-1e-14, j), (1e-14, j + 1)] {
            assert_eq!(negative_eigenvalues(chain(root + side)), count);
        }
    }
}
