//! What freezing does to a condensed stiffness: old shapes bound it from above, old internal loads from below.

use crate::prelude::*;

/// A structure of elements k aaᵗ with a load distribution, and new factors on its elements.
#[derive(Debug, Clone)]
struct Framework {
    elements: Vec<DMatrix<f64>>,
    load_distribution: DMatrix<f64>,
    factors: Vec<f64>,
}

impl Framework {
    fn stiffness(&self, factors: &[f64]) -> DMatrix<f64> {
        self.elements
            .iter()
            .zip(factors)
            .map(|(element, factor)| *factor * element)
            .sum()
    }

    fn condensed(&self, factors: &[f64]) -> Condensed {
        condense(&self.stiffness(factors), &self.load_distribution).unwrap()
    }

    /// The first structure's, with the shapes kept, with the internal loads kept, and exactly, at the new factors.
    fn stiffnesses(&self) -> [DMatrix<f64>; 3] {
        let first = self.condensed(&vec![1.0; self.factors.len()]);
        let b = first.transformation.transpose();
        let above = &b * self.stiffness(&self.factors) * &first.transformation;
        let flexibilities = self.flexibilities();
        let flexibility: DMatrix<f64> = flexibilities
            .iter()
            .zip(&self.factors)
            .map(|(f, factor)| f / *factor)
            .sum();
        let below = flexibility.try_inverse().unwrap();
        [above, below, self.condensed(&self.factors).stiffness]
    }

    /// Flexibility of every element under its own internal loads due to unit dynamic ones, by virtual work.
    fn flexibilities(&self) -> Vec<DMatrix<f64>> {
        let inverse = self
            .stiffness(&vec![1.0; self.factors.len()])
            .try_inverse()
            .unwrap();
        let deflections = inverse * &self.load_distribution;
        self.elements
            .iter()
            .map(|element| deflections.tr_mul(&(element * &deflections)))
            .collect()
    }
}

/// As many independent elements as structural DOF, which is statically determinate, and some more.
fn framework(most_more: usize) -> impl Strategy<Value = Framework> {
    (2..=6_usize, 0..=most_more).prop_flat_map(|(dof, more)| {
        let count = dof + more;
        let numbers = |low: f64, high: f64, count: usize| prop::collection::vec(low..high, count);
        (
            numbers(-1.0, 1.0, dof * count),
            numbers(0.5, 2.0, count),
            numbers(0.3, 3.0, count),
            orthogonal(dof),
            1..=dof,
        )
            .prop_map(move |(entries, stiffness, factors, columns, dynamic)| {
                let element = |e: usize| {
                    // Unit vectors on the diagonal keep the first elements independent.
                    let vector = |i: usize, _| {
                        0.3 * entries[e * dof + i] + f64::from(u8::from(i == e % dof))
                    };
                    let a = DVector::from_fn(dof, vector);
                    stiffness[e] * &a * a.transpose()
                };
                let load_distribution = columns.columns(0, dynamic).into_owned();
                Framework {
                    elements: (0..count).map(element).collect(),
                    load_distribution,
                    factors,
                }
            })
    })
}

fn is_close(one: &DMatrix<f64>, other: &DMatrix<f64>) -> bool {
    (one - other).amax() < MATRIX_ROUND_OFF * other.amax()
}

/// How far a difference of two stiffnesses falls below zero in any direction, relative to the larger.
fn least(above: &DMatrix<f64>, below: &DMatrix<f64>) -> f64 {
    (above - below).symmetric_eigenvalues().min() / above.amax()
}

properties! {
    #[test]
    fn an_elements_share_is_its_flexibility_by_virtual_work(given in framework(4)) {
        // B K_e Bᵗ = K_D F_e K_D
        let first = given.condensed(&vec![1.0; given.factors.len()]);
        for (element, flexibility) in given.elements.iter().zip(given.flexibilities()) {
            let share = first.transformation.tr_mul(&(element * &first.transformation));
            let by_work = &first.stiffness * flexibility * &first.stiffness;
            prop_assert!((share - by_work).amax() < MATRIX_ROUND_OFF * first.stiffness.amax());
        }
    }

    #[test]
    fn the_exact_stiffness_lies_between_that_of_old_loads_and_that_of_old_shapes(given in framework(4)) {
        let [above, below, exact] = given.stiffnesses();
        prop_assert!(least(&above, &exact) > -MATRIX_ROUND_OFF);
        prop_assert!(least(&exact, &below) > -MATRIX_ROUND_OFF);
        // And so does every frequency, whatever the mass; here of one.
        let count = exact.nrows();
        let mass = eye(count);
        let [above, below, exact] =
            [above, below, exact].map(|k| solve(&(0.5 * (&k + k.transpose())), &mass, count).unwrap());
        for mode in 0..count {
            let [high, low, exact] = [&above, &below, &exact].map(|modes| modes.omega_squared()[mode]);
            prop_assert!(low <= exact * (1.0 + 1e2 * EIGEN_ROUND_OFF) && exact <= high * (1.0 + 1e2 * EIGEN_ROUND_OFF));
        }
    }

    #[test]
    fn old_loads_are_exact_in_a_statically_determinate_structure(given in framework(0)) {
        let [_, below, exact] = given.stiffnesses();
        prop_assert!(is_close(&below, &exact));
    }

    #[test]
    fn old_shapes_are_exact_where_all_elements_change_alike(given in framework(4), factor in 0.3..3.0_f64) {
        let factors = vec![factor; given.factors.len()];
        let [above, below, exact] = Framework { factors, ..given }.stiffnesses();
        prop_assert!(is_close(&above, &exact) && is_close(&below, &exact));
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn the_box_lies_between_its_bounds((case, factors) in (case(), factors(39))) {
        let model = with_every_element(&case);
        let (first, exact) = (model.matrices(&[1.0; 39])?, model.modes(&factors)?);
        let flexibility = first.stiffness.clone().try_inverse().unwrap();
        let (mut above, mut below) = (zero_square(9), zero_square(9));
        for (share, factor) in first.shares.iter().zip(&factors) {
            above += *factor * share;
            below += &flexibility * share * &flexibility / *factor;
        }
        let below = below.try_inverse().unwrap();
        let [above, below] =
            [above, below].map(|k| solve(&(0.5 * (&k + k.transpose())), &first.mass, 9).unwrap());
        for mode in 0..9 {
            let [high, low, exact] = [&above, &below, &exact].map(|modes| modes.omega_squared()[mode]);
            prop_assert!(low <= exact * (1.0 + 1e2 * EIGEN_ROUND_OFF) && exact <= high * (1.0 + 1e2 * EIGEN_ROUND_OFF));
        }
    }
}
