//! The library's own measure of a change of stiffness: the norm of the whole relative generalized stiffness, and what it is.

use crate::prelude::*;

fn changes(model: &ModalModel, rule: StepRule) -> Vec<f64> {
    model.stiffness_changes(model.exact(), &model.exact().share_factors, rule)
}

/// A structure of one mass a DOF, elements k aaᵗ with a vector each, and factors on them that the test has.
#[derive(Debug, Clone)]
struct RankOne {
    vectors: Vec<DVector<f64>>,
    stiffness: Vec<f64>,
    truth: Vec<f64>,
    mass: Vec<f64>,
}

impl RankOne {
    fn matrix(&self, factors: &[f64]) -> DMatrix<f64> {
        let share = |e: usize| {
            factors[e] * self.stiffness[e] * &self.vectors[e] * self.vectors[e].transpose()
        };
        (0..self.vectors.len()).map(share).sum()
    }

    fn model(&self) -> (ModalModel, DMatrix<f64>) {
        let ones = vec![1.0; self.vectors.len()];
        let mass = DMatrix::from_diagonal(&DVector::from_column_slice(&self.mass));
        let share = |e: usize| self.stiffness[e] * &self.vectors[e] * self.vectors[e].transpose();
        let shares = (0..ones.len()).map(share).collect();
        let model = DynamicModel {
            stiffness: self.matrix(&ones),
            mass: mass.clone(),
            shares,
        };
        let test_stiffness = self.matrix(&self.truth);
        let test = solve(&test_stiffness, &mass, self.mass.len()).unwrap();
        (model.analyze(&test, None).unwrap(), test_stiffness)
    }
}

/// As many independent elements as DOF, which is a statically determinate structure, or a few more.
fn rank_one(more: usize) -> impl Strategy<Value = RankOne> {
    (2..=4_usize).prop_flat_map(move |dof| {
        let count = dof + more;
        let numbers = |low: f64, high: f64, count: usize| prop::collection::vec(low..high, count);
        (
            numbers(-1.0, 1.0, dof * count),
            numbers(50.0, 150.0, count),
            numbers(0.6, 1.6, count),
            numbers(0.5, 2.0, dof),
        )
            .prop_map(move |(entries, stiffness, truth, mass)| {
                // Unit vectors on the diagonal keep the elements independent.
                let vector = |e: usize| {
                    DVector::from_fn(dof, |i, _| {
                        0.3 * entries[e * dof + i] + f64::from(u8::from(i == e % dof))
                    })
                };
                RankOne {
                    vectors: (0..count).map(vector).collect(),
                    stiffness,
                    truth,
                    mass,
                }
            })
    })
}

properties! {
    #[test]
    fn with_all_modes_it_is_the_norm_in_the_measure_of_the_tests_stiffness((chain, truth) in chain_and_truth()) {
        // Computed without any mode, from the symmetric root of the test's stiffness.
        let model = chain.model(&vec![1.0; truth.len()]);
        let root = chain.model(&truth).stiffness.symmetric_eigen();
        let inverse_root =
            &root.eigenvectors * DMatrix::from_diagonal(&root.eigenvalues.map(|value| 1.0 / value.sqrt()))
            * root.eigenvectors.transpose();
        let found = changes(&chain_problem(&chain, &truth), StepRule::Matrix);
        for (found, share) in found.iter().zip(&model.shares) {
            let expected = DERIVATIVE_STEP * (&inverse_root * share * &inverse_root).norm();
            prop_assert!(relative_error(found, expected) < MATRIX_ROUND_OFF);
        }
    }

    #[test]
    fn a_rank_one_element_has_its_energy_under_its_own_load_on_the_test_structure(given in rank_one(2)) {
        // 0.001 k aᵗ K_G⁻¹ a: k times the deflection of the test structure along a under a unit load along a.
        let (model, test_stiffness) = given.model();
        let flexibility = test_stiffness.try_inverse().unwrap();
        for (e, found) in changes(&model, StepRule::Matrix).into_iter().enumerate() {
            let a = &given.vectors[e];
            let expected = DERIVATIVE_STEP * given.stiffness[e] * a.dot(&(&flexibility * a));
            prop_assert!(relative_error(found, expected) < MATRIX_ROUND_OFF);
        }
    }

    #[test]
    fn in_a_statically_determinate_structure_it_is_the_stiffness_over_the_tests(given in rank_one(0)) {
        // There it knows each element's error without iterating; with all tests alike it is the reading by gages.
        let (model, _) = given.model();
        for (found, truth) in changes(&model, StepRule::Matrix).into_iter().zip(&given.truth) {
            prop_assert!((found * truth / DERIVATIVE_STEP - 1.0).abs() < MATRIX_ROUND_OFF);
        }
    }

    #[test]
    fn own_is_at_most_matrix_and_that_at_most_the_sum_of_magnitudes((chain, truth) in chain_and_truth(), modes in 1..=5_usize) {
        let count = truth.len();
        let test = chain.modes(&truth).lowest(modes.min(count))?;
        let model = chain.model(&vec![1.0; count]).analyze(&test, None)?;
        let (own, matrix) = (changes(&model, StepRule::Own), changes(&model, StepRule::Matrix));
        for ((own, matrix), share) in own.iter().zip(matrix).zip(model.test_shares()) {
            let sum: f64 = share.iter().map(|entry| entry.abs()).sum();
            prop_assert!(*own <= matrix * (1.0 + MATRIX_ROUND_OFF));
            prop_assert!(matrix <= DERIVATIVE_STEP * sum * (1.0 + MATRIX_ROUND_OFF));
        }
    }

    #[test]
    fn it_depends_on_no_test_shapes_scale_or_sign((chain, truth) in chain_and_truth(), scales in prop::collection::vec(prop_oneof![-5.0..-0.2_f64, 0.2..5.0_f64], 5)) {
        let model = chain.model(&vec![1.0; truth.len()]);
        let test = chain.modes(&truth);
        let mut scaled = test.clone();
        alter(&mut scaled, |_, shapes| shapes.column_iter_mut().zip(&scales).for_each(|(mut shape, scale)| shape *= *scale));
        let of = |test: &Modes| changes(&model.analyze(test, None).unwrap(), StepRule::Matrix);
        assert_alike(of(&scaled).iter(), of(&test), MATRIX_ROUND_OFF);
    }
}
