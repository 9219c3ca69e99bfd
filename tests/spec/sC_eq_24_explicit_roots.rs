//! (C.24), explicit roots, and its printed forms.

use super::s1_eq_07_roots::{Changed, MODES, without};
use crate::common::tolerances::{EIGEN_ROUND_OFF, SECOND_ORDER_ROOT, WRONG_FORM};
use corfem::method::perturbation::first_order;
use nalgebra::DMatrix;

#[test]
fn explicit_root_sums_over_its_own_mode_too() {
    // (C.24): with j = i left out of the sum the second-order root misses the first-order change.
    let c = Changed::new();
    let sum = |i: usize| {
        without(&[i])
            .map(|j| c.beta[(i, j)] * c.p[(j, i)])
            .sum::<f64>()
    };
    let with = c.root_error(|i| c.explicit_root(i, sum(i) + c.beta[(i, i)]));
    let printed = c.root_error(|i| c.explicit_root(i, sum(i)));
    assert!(
        with < EIGEN_ROUND_OFF && printed > WRONG_FORM,
        "{with:e} {printed:e}"
    );
}

#[test]
fn explicit_root_needs_the_shapes_transposed() {
    // (C.24) prints β_ij p_ij too. By (C.21) p_ij = −p_ji, so that the second-order term gets the wrong sign: from the
    // first-order shapes, where the formula is meant to start, the root is twice as far off as before.
    let c = Changed::new();
    let first = first_order(&c.k, &c.beta).expect("separate modes");
    let sum = |p: &DMatrix<f64>, i: usize| (0..MODES).map(|j| c.beta[(i, j)] * p[(j, i)]).sum();
    let error = |p: &DMatrix<f64>| c.root_error(|i| c.explicit_root(i, sum(p, i)));
    let first_error = c.root_error(|i| first.roots[i] - 1.0 / c.k[i]);
    let (right, printed) = (error(&first.shapes), error(&first.shapes.transpose()));
    assert!(right < SECOND_ORDER_ROOT, "{right:e}");
    assert!(
        (printed - 2.0 * first_error).abs() < SECOND_ORDER_ROOT,
        "{printed:e} {first_error:e}"
    );
    assert!(first_error > 50.0 * right, "{first_error:e}");
}
