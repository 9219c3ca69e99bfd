//! Appendix A: from structural to dynamic DOF, by more than one route.

use crate::prelude::*;

/// Condition numbers of the random stiffness matrices, in decades. Round-off grows with their square here: five decades
/// leave three digits to compare in the worst case.
const DECADES: f64 = 5.0;

/// A random structural stiffness with its condition number and some of its DOF, at least one, at most all.
pub fn stiffness_and_kept() -> impl Strategy<Value = (DMatrix<f64>, f64, Vec<usize>)> {
    (2..10_usize)
        .prop_flat_map(|n| {
            (
                positive_definite(n, DECADES),
                prop::sample::subsequence((0..n).collect_vec(), 1..=n),
            )
        })
        .prop_map(|((stiffness, exponents), kept)| {
            let least = exponents.iter().copied().fold(f64::INFINITY, f64::min);
            let most = exponents.iter().copied().largest();
            (stiffness, 10f64.powf(most - least), kept)
        })
}

/// A random structural stiffness with its condition number and a load distribution of independent columns.
fn stiffness_and_distribution() -> impl Strategy<Value = (DMatrix<f64>, f64, DMatrix<f64>)> {
    stiffness_and_kept()
        .prop_flat_map(|(stiffness, condition, kept)| {
            let count = stiffness.nrows();
            (Just((stiffness, condition, kept.len())), orthogonal(count))
        })
        .prop_map(|((stiffness, condition, count), columns)| {
            (stiffness, condition, columns.columns(0, count).into_owned())
        })
}

/// A random structural stiffness with its condition number, and as many dynamic DOF as structural ones: T is square, and as
/// Q₁·diag(0.5 to 2)·Q₂ unsymmetric.
fn stiffness_and_square_distribution() -> impl Strategy<Value = (DMatrix<f64>, f64, DMatrix<f64>)> {
    (2..7_usize)
        .prop_flat_map(|n| {
            let stretch = prop::collection::vec(0.5..2.0_f64, n);
            (
                positive_definite(n, DECADES),
                orthogonal(n),
                stretch,
                orthogonal(n),
            )
        })
        .prop_map(|((stiffness, exponents), left, stretch, right)| {
            let least = exponents.iter().copied().fold(f64::INFINITY, f64::min);
            let most = exponents.iter().copied().largest();
            let t = left * diagonal(stretch) * right;
            (stiffness, 10f64.powf(most - least), t)
        })
}

fn is_unsymmetric(t: &DMatrix<f64>) -> bool {
    (t - t.transpose()).amax() > 0.1 * t.amax()
}

#[test]
fn square_load_distributions_are_unsymmetric() {
    let strategy = stiffness_and_square_distribution();
    let share = reached("an unsymmetric square T", &strategy, |(_, _, t)| {
        is_unsymmetric(&t)
    });
    assert!(share > LEAST_REACHED, "{share}");
}

fn condensed(stiffness: &DMatrix<f64>, t: &DMatrix<f64>) -> Result<Condensed, Error> {
    condense(stiffness, t)
}

properties! {
    /// (A.3) to (A.8): the flexibility is TᵗK_S⁻¹T; B carries it back, K_D = B K_S Bᵗ; by equal work TᵗBᵗ = I.
    #[test]
    fn condensed_stiffness_and_transformation_satisfy_appendix_a(
        (stiffness, condition, t) in stiffness_and_distribution(),
    ) {
        let found = condensed(&stiffness, &t)?;
        let flexibility = t.tr_mul(&stiffness.clone().cholesky().unwrap().solve(&t));
        // Round-off of the flexibility grows once more in its inverse.
        let spread = flexibility.symmetric_eigenvalues();
        let bar = CONDITIONED_ROUND_OFF * condition * spread.max() / spread.min();
        let expected = flexibility.try_inverse().unwrap();
        prop_assert!(relative_distance(&found.stiffness, &expected) <= bar);
        prop_assert_eq!(&found.stiffness, &found.stiffness.transpose());
        let bt = &found.transformation;
        prop_assert_eq!(bt.shape(), t.shape());
        let identity = eye(t.ncols());
        prop_assert!(relative_distance(&t.tr_mul(bt), &identity) <= bar);
        let through_b = bt.tr_mul(&(&stiffness * bt));
        prop_assert!((through_b - &found.stiffness).amax() <= bar * stiffness.amax());
        // What Bᵗ leaves of the loads is what T put there.
        prop_assert!((&stiffness * bt - &t * &found.stiffness).amax() <= bar * stiffness.amax());
    }

    /// Where T is square nothing is condensed: (A.4) is q_S = T⁻ᵗq_D, which is Bᵗ whatever the stiffness, and K_D = T⁻¹K_ST⁻ᵗ.
    #[test]
    fn a_square_load_distribution_is_inverted_and_not_transposed(
        (stiffness, condition, t) in stiffness_and_square_distribution(),
    ) {
        let found = condensed(&stiffness, &t)?;
        let inverse = t.clone().try_inverse().unwrap();
        // As above: the flexibility's spread is the stiffness's, and up to 16 times as much by T.
        let bar = CONDITIONED_ROUND_OFF * condition * 16.0 * condition;
        prop_assert!(relative_distance(&found.transformation, &inverse.transpose()) <= bar);
        let expected = &inverse * &stiffness * inverse.transpose();
        prop_assert!(relative_distance(&found.stiffness, &expected) <= bar);
    }

    /// Of all structural motions with given dynamic ones, q_D = Tᵗq_S, that of Bᵗ has the least energy: K_D's.
    #[test]
    fn condensed_energy_is_the_least(
        (stiffness, condition, t) in stiffness_and_distribution(),
        motion in prop::collection::vec(-1.0..1.0_f64, 10),
    ) {
        let found = condensed(&stiffness, &t)?;
        let structural = DVector::from_column_slice(&motion[..stiffness.nrows()]);
        let dynamic = t.tr_mul(&structural);
        let energy = structural.dot(&(&stiffness * &structural));
        let least = dynamic.dot(&(&found.stiffness * &dynamic));
        prop_assert!(least <= energy * (1.0 + CONDITIONED_ROUND_OFF * condition), "{least} {energy}");
        prop_assert!(least >= 0.0);
    }

    #[test]
    fn a_combination_of_earlier_dynamic_dof_is_refused_by_its_number(
        ((stiffness, _), columns, weights, dof) in (3..9_usize).prop_flat_map(|n| (
            positive_definite(n, 2.0),
            orthogonal(n),
            prop::collection::vec(0.5..2.0_f64, n),
            1..n,
        )),
    ) {
        let mut t = columns;
        let mut combination = DVector::zeros(t.nrows());
        for (column, weight) in t.column_iter().zip(&weights[..dof]) {
            combination += *weight * column;
        }
        t.set_column(dof, &combination);
        prop_assert_eq!(said(condensed(&stiffness, &t)), not_definite("dynamic flexibility", dof));
    }
}

/// Springs 1 and 2 in a row, one dynamic DOF that is the mean of the two grids' motion: T = (1/2, 1/2), flexibility
/// 1/4·(1 + 1 + 1 + 3/2) = 9/8, deflections 8/9·(1, 5/4).
#[test]
fn two_springs_and_a_mean_are_the_hand_result() {
    let stiffness = dmatrix![3.0, -2.0; -2.0, 2.0];
    let found = condensed(&stiffness, &dmatrix![0.5; 0.5]).unwrap();
    let expected = DMatrix::from_element(1, 1, 8.0 / 9.0);
    assert!(relative_distance(&found.stiffness, &expected) <= MATRIX_ROUND_OFF);
    let motion = dmatrix![8.0 / 9.0; 10.0 / 9.0];
    assert!(relative_distance(&found.transformation, &motion) <= MATRIX_ROUND_OFF);
}

#[test]
fn a_bad_load_distribution_is_refused_by_name() {
    let nan = DMatrix::from_element(3, 1, f64::NAN);
    for (t, words) in [
        (
            DMatrix::zeros(3, 0),
            "dynamic degrees of freedom: 0 given or asked for; there must be at least 1".to_owned(),
        ),
        (
            DMatrix::zeros(4, 2),
            "load distribution: 4 x 2 instead of 3 x 2".into(),
        ),
        (
            nan,
            "load distribution of entry (0, 0) is NaN; it must be a finite number".into(),
        ),
        // A dynamic DOF that no load reaches is a combination of none.
        (DMatrix::zeros(3, 1), not_definite("dynamic flexibility", 0)),
    ] {
        assert_eq!(said(condensed(&eye(3), &t)), words);
    }
}
