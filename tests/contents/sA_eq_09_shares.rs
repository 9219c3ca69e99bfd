//! Appendix A on the paper's box: shares of elements, and what freezing B does.

use crate::common::torque_boxes::stiffness;
use crate::prelude::*;
use corfem::method::modes;

/// K_D at factors on the shares, B left as it was.
fn frozen(start: &DynamicModel, factors: &[f64]) -> DMatrix<f64> {
    let mut stiffness = start.stiffness.clone();
    for (share, factor) in start.shares.iter().zip(factors) {
        stiffness += (factor - 1.0) * share;
    }
    stiffness
}

fn frequencies(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Vec<f64> {
    modes::solve(stiffness, mass, stiffness.nrows())
        .unwrap()
        .frequencies_hz()
}

properties! {
    /// With the load between the spars shared by them as if it rode on no rib, the mid points would be averages of the
    /// spars' and the dynamic flexibility singular: the third point of the tip rib follows from the two before it.
    #[test]
    fn averaged_mid_points_would_make_the_boxs_flexibility_singular(case in case(), sizes in sizes_of(39)) {
        let model = case.model()?;
        let (factor, _) = stiffness(&model, &sizes);
        prop_assert!(condense(&factor, model.load_distribution()).is_ok());
        let mut t = model.load_distribution().clone();
        for rib in 0..3 {
            let average = 0.5 * (t.column(3 * rib) + t.column(3 * rib + 2));
            t.set_column(3 * rib + 1, &average);
        }
        prop_assert_eq!(said(condense(&factor, &t)), not_definite("dynamic flexibility", 2));
    }

    /// (A.9) with one B for all: the shares of all 39 elements, rods too, are the whole stiffness.
    #[test]
    fn element_shares_sum_to_the_dynamic_stiffness(case in case(), factors in factors(39)) {
        let model = with_every_element(&case);
        let dynamic = model.matrices(&factors)?;
        prop_assert_eq!(dynamic.shares.len(), 39);
        let sum: DMatrix<f64> = dynamic.shares.iter().sum();
        prop_assert!(relative_distance(&sum, &dynamic.stiffness) <= MATRIX_ROUND_OFF);
        for share in &dynamic.shares {
            prop_assert_eq!(share, &share.transpose());
        }
    }

    /// An element's share is B K_e Bᵗ with the element's matrix spread over all structural DOF.
    #[test]
    fn a_share_is_the_elements_stiffness_through_b(case in case(), factors in factors(39), row in 0..39_usize) {
        let model = with_every_element(&case);
        let sizes = model.sizes(&factors)?;
        let (factor, _) = stiffness(&model, &sizes);
        let bt = condense(&factor, model.load_distribution())?.transformation;
        let element = &model.element_matrices()[row];
        let mut spread = zero_square(36);
        for (a, &at) in element.dof.iter().enumerate() {
            for (b, &to) in element.dof.iter().enumerate() {
                spread[(at, to)] = element.unit[(a, b)];
            }
        }
        let expected = bt.tr_mul(&(spread * &bt));
        let scale = element.unit.amax() * bt.amax().powi(2);
        let shares = model.matrices(&factors)?.shares;
        prop_assert!((&shares[row] / sizes[row] - &expected).amax() <= MATRIX_ROUND_OFF * scale);
        prop_assert_eq!(expected.shape(), (9, 9));
    }

    /// With the B of other gages the structure is made to move as it would not by itself, so that it is too stiff:
    /// K_D with frozen B exceeds the exact one, and every frequency lies above.
    #[test]
    fn frozen_b_frequencies_bound_exact_ones_from_above(case in case(), factors in factors(15)) {
        let model = case.model()?;
        let start = model.matrices(&[1.0; 15])?;
        let exact = model.matrices(&factors)?;
        let frozen = frozen(&start, &factors);
        let excess = (&frozen - &exact.stiffness).symmetric_eigenvalues();
        prop_assert!(excess.min() >= -MATRIX_ROUND_OFF * frozen.amax(), "{:e}", excess.min());
        let bar = EIGEN_ROUND_OFF * condition(&exact.stiffness);
        for (above, below) in frequencies(&frozen, &exact.mass).iter().zip(frequencies(&exact.stiffness, &exact.mass)) {
            prop_assert!(*above >= below * (1.0 - bar), "{above} below {below}");
        }
    }

    /// B of the same gages is exact, whatever all of them are multiplied by together.
    #[test]
    fn a_common_factor_leaves_b_exact(case in case(), factor in 0.55..=1.5_f64) {
        let model = with_every_element(&case);
        let start = model.matrices(&[1.0; 39])?;
        let scaled = model.matrices(&[factor; 39])?;
        prop_assert!(relative_distance(&scaled.stiffness, &(factor * start.stiffness)) <= MATRIX_ROUND_OFF);
    }
}

/// An element matrix of another origin need not be semidefinite, and its share counts what no way to deform explains.
#[test]
fn shares_of_an_indefinite_element_sum_to_the_stiffness() {
    let model = with_every_element(&case_of(1));
    let mut units = model
        .element_matrices()
        .iter()
        .map(|element| element.unit.clone())
        .collect_vec();
    let (size, last) = (0.01 * units[4].amax(), units[4].nrows() - 1);
    units[4][(0, last)] += size;
    units[4][(last, 0)] += size;
    assert!(units[4].symmetric_eigenvalues().min() < -0.1 * size);
    let factors = vec![1.0; model.parameters().len()];
    let found = model
        .with_unit_stiffness(units)
        .unwrap()
        .matrices(&factors)
        .unwrap();
    let sum: DMatrix<f64> = found.shares.iter().sum();
    assert!((sum - &found.stiffness).amax() <= MATRIX_ROUND_OFF * found.stiffness.amax());
}
