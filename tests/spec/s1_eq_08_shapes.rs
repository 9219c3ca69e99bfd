//! (8), which is the second line of (C.22): the recursion of the generalized shapes, and its printed and scanned forms.

use super::s1_eq_07_roots::{Changed, without};
use crate::common::tolerances::{SHAPE_ROUND_OFF, WRONG_FORM};

#[test]
fn shape_recursion_divides_by_the_denominator_with_a_minus_sign() {
    // The scan of (C.22) loses the minus sign and inverts a bracket by which it also divides; (8) has it right.
    let c = Changed::new();
    let right = c.shape_error(|i, j| -c.numerator(i, j) / c.denominator(i, j));
    let unsigned = c.shape_error(|i, j| c.numerator(i, j) / c.denominator(i, j));
    let inverted = c.shape_error(|i, j| -c.numerator(i, j) * c.denominator(i, j));
    assert!(right < SHAPE_ROUND_OFF, "{right:e}");
    assert!(
        unsigned > WRONG_FORM && inverted > WRONG_FORM,
        "{unsigned:e} {inverted:e}"
    );
}

#[test]
fn shape_recursion_has_the_root_of_the_mode_not_of_the_row() {
    // (8) and (C.22) print λ_i in the denominator of p_ij, at the previous order; (C.21) has the root of mode j.
    let c = Changed::new();
    let of_the_mode = c.shape_error(|i, j| -c.numerator(i, j) / c.denominator(i, j));
    let of_the_row = c.shape_error(|i, j| -c.numerator(i, j) / c.denominator(i, i));
    assert!(
        of_the_mode < SHAPE_ROUND_OFF && of_the_row > WRONG_FORM,
        "{of_the_mode:e} {of_the_row:e}"
    );
}

#[test]
fn shape_recursion_sums_over_the_components_of_its_own_mode() {
    // The scan of (C.22) has p_is; the row multiplies mode j's column, p_sj, as in (8).
    let c = Changed::new();
    let shape = |i: usize, j: usize, sum: f64| -(c.beta[(i, j)] + sum) / c.denominator(i, j);
    let column = |i: usize, j: usize| without(&[i, j]).map(|s| c.beta[(i, s)] * c.p[(s, j)]).sum();
    let row = |i: usize, j: usize| without(&[i, j]).map(|s| c.beta[(i, s)] * c.p[(i, s)]).sum();
    let right = c.shape_error(|i, j| shape(i, j, column(i, j)));
    let scanned = c.shape_error(|i, j| shape(i, j, row(i, j)));
    assert!(
        right < SHAPE_ROUND_OFF && scanned > WRONG_FORM,
        "{right:e} {scanned:e}"
    );
}

#[test]
fn shape_recursion_leaves_row_and_mode_out_of_its_sum() {
    // The scan of (8) sums over every s. With s = j the change β_ij counts twice, with s = i
    // the denominator's β_ii does.
    let c = Changed::new();
    for left_out in [|i: usize, _| vec![i], |_, j: usize| vec![j], |_, _| vec![]] {
        let sum = |i: usize, j: usize| {
            without(&left_out(i, j))
                .map(|s| c.beta[(i, s)] * c.p[(s, j)])
                .sum::<f64>()
        };
        let error = c.shape_error(|i, j| -(c.beta[(i, j)] + sum(i, j)) / c.denominator(i, j));
        assert!(error > WRONG_FORM, "{error:e}");
    }
}
