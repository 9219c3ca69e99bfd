//! `paper/errata.md` for Appendix C, and for (7) and (8), which are its (C.22).
//!
//! Roots and shapes of a changed structure satisfy every row of (C.16). A formula that follows from a row therefore
//! gives exact roots and shapes back when it is given exact ones; the printed and the scanned forms here do not.

use crate::common::appendix_c::exact;
use crate::common::boxes::first_problem;
use crate::common::complex_pencils::{Complexes, aeroelastic_section, amax, complex, through};
use crate::common::tolerances::{
    COMPLEX_EIGEN_ROUND_OFF, EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, SECOND_ORDER_ROOT, SHAPE_ROUND_OFF,
    WRONG_FORM,
};
use approx::assert_relative_eq;
use corfem::method::appendix_c::general::complex_modes::solve;
use corfem::method::appendix_c::general::{ModalChange, complex_modes::LeftRightModes};
use corfem::method::appendix_c::{Perturbed, eigensolution, first_order};
use corfem::torque_box::Case;
use nalgebra::{Complex, DMatrix, DVector, dmatrix, dvector};

const MODES: usize = 9;

/// Case 2's modes, a change of every element by ten percent, up and down in turn, and the exact modes after it.
struct Changed {
    k: DVector<f64>,
    beta: DMatrix<f64>,
    gamma: DVector<f64>,
    p: DMatrix<f64>,
}

impl Changed {
    fn new() -> Self {
        let problem = first_problem(2);
        let mut beta = DMatrix::zeros(MODES, MODES);
        for (e, share) in problem.shares().iter().enumerate() {
            beta += if e % 2 == 0 { 0.1 } else { -0.1 } * share.matrix();
        }
        let k = problem.exact().modes.omega_squared().clone();
        let Perturbed { roots, shapes } = exact(&k, &beta).expect("solved");
        Self {
            k,
            beta,
            gamma: roots,
            p: shapes,
        }
    }

    /// Largest relative error of roots whose change a formula gives.
    fn root_error(&self, change: impl Fn(usize) -> f64) -> f64 {
        let error = |i: usize| ((1.0 / self.k[i] + change(i)) / self.gamma[i] - 1.0).abs();
        (0..MODES).map(error).fold(0.0, f64::max)
    }

    /// The first line of (C.22) with a root before the sum and with the sum over the other modes.
    fn implicit_root(&self, i: usize, root: f64, sum: f64) -> f64 {
        -(self.beta[(i, i)] / self.k[i] + root * sum) / (self.k[i] + self.beta[(i, i)])
    }

    /// (C.24) with a sum over modes.
    fn explicit_root(&self, i: usize, sum: f64) -> f64 {
        -sum / self.k[i] / (self.k[i] + sum)
    }

    /// Largest error of the shapes that a formula gives for mode i's component in mode j.
    fn shape_error(&self, shape: impl Fn(usize, usize) -> f64) -> f64 {
        let error = |i: usize, j: usize| (shape(i, j) - self.p[(i, j)]).abs();
        (0..MODES)
            .flat_map(|j| without(&[j]).map(move |i| error(i, j)).collect::<Vec<_>>())
            .fold(0.0, f64::max)
    }

    /// The numerator of (8), without its sign.
    fn numerator(&self, i: usize, j: usize) -> f64 {
        self.beta[(i, j)]
            + without(&[i, j])
                .map(|s| self.beta[(i, s)] * self.p[(s, j)])
                .sum::<f64>()
    }

    /// The denominator of (8) with the root of a mode.
    fn denominator(&self, i: usize, mode: usize) -> f64 {
        self.k[i] + self.beta[(i, i)] - 1.0 / self.gamma[mode]
    }
}

/// The modes that are not left out.
fn without(left_out: &[usize]) -> impl Iterator<Item = usize> {
    (0..MODES).filter(move |mode| !left_out.contains(mode))
}

#[test]
fn root_recursion_needs_the_shapes_transposed() {
    // (7), (C.22): row i of mode i has β_ij p_ji, as (C.17) to (C.19) have it; β_ij p_ij is printed.
    let c = Changed::new();
    let sum = |p: &DMatrix<f64>, i: usize| without(&[i]).map(|j| c.beta[(i, j)] * p[(j, i)]).sum();
    let error = |p: &DMatrix<f64>| c.root_error(|i| c.implicit_root(i, c.gamma[i], sum(p, i)));
    assert!(error(&c.p) < EIGEN_ROUND_OFF, "{:e}", error(&c.p));
    assert!(
        error(&c.p.transpose()) > WRONG_FORM,
        "{:e}",
        error(&c.p.transpose())
    );
}

#[test]
fn root_recursion_carries_the_changed_root_not_the_old_one() {
    // (7), (C.22): the scan has (λ_i) before the sum, its order lost. The old root there does not give the row back.
    let c = Changed::new();
    let sum = |i: usize| without(&[i]).map(|j| c.beta[(i, j)] * c.p[(j, i)]).sum();
    let changed = c.root_error(|i| c.implicit_root(i, c.gamma[i], sum(i)));
    let old = c.root_error(|i| c.implicit_root(i, 1.0 / c.k[i], sum(i)));
    assert!(
        changed < EIGEN_ROUND_OFF && old > WRONG_FORM,
        "{changed:e} {old:e}"
    );
}

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

/// Three modes under a change of stiffness and mass.
fn three_modes() -> (ModalChange<f64>, Perturbed) {
    let beta = dmatrix![0.1, 0.2, -0.3; 0.2, -0.2, 0.4; -0.3, 0.4, 0.5];
    let alpha = dmatrix![0.1, -0.05, 0.02; -0.05, 0.2, 0.03; 0.02, 0.03, -0.1];
    let change = ModalChange::of_vibrations(&dvector![1.0, 3.0, 8.0], beta, alpha);
    let exact = eigensolution(&change).expect("separate modes");
    (change, exact)
}

/// The matrix of (C.17), (C.18) or (C.19) for a changed root, with what stands for β_is γ − α_is.
fn rows(change: &ModalChange<f64>, gamma: f64, entry: impl Fn(f64, f64) -> f64) -> DMatrix<f64> {
    DMatrix::from_fn(3, 3, |i, s| {
        let own = if i == s {
            change.generalized_stiffness[i] * (gamma - change.roots[i])
        } else {
            0.0
        };
        own + entry(change.beta[(i, s)], change.alpha[(i, s)])
    })
}

#[test]
fn rows_of_three_modes_subtract_alpha() {
    // (C.16) to (C.19): the scan raises −α to an exponent. (C.14) has βλ − α.
    let (change, exact) = three_modes();
    for (&gamma, p) in exact.roots.iter().zip(exact.shapes.column_iter()) {
        let subtracted = rows(&change, gamma, |beta, alpha| beta * gamma - alpha) * p;
        let raised = rows(&change, gamma, |beta, alpha| beta * gamma.powf(-alpha)) * p;
        assert!(subtracted.amax() < MATRIX_ROUND_OFF, "{subtracted}");
        assert!(raised.amax() > WRONG_FORM, "{raised}");
    }
}

#[test]
fn own_component_counts_once() {
    // (C.15) prints δ_ji + p_ji and (C.21) p_ii = 1: together the mode's own component would be two.
    let (change, exact) = three_modes();
    for mode in 0..3 {
        let rows = rows(&change, exact.roots[mode], |beta, alpha| {
            beta * exact.roots[mode] - alpha
        });
        let mut p = exact.shapes.column(mode).into_owned();
        assert!((&rows * &p).amax() < MATRIX_ROUND_OFF);
        p[mode] += 1.0;
        assert!((&rows * &p).amax() > WRONG_FORM);
    }
}

#[test]
fn generalized_matrices_obey_g_equals_k_lambda() {
    // The line before (C.13) prints k = gΛ; from (C.5) it is g = kΛ, and with g = I that makes k = 1/λ = ω².
    let problem = first_problem(1);
    let model = Case::new(1).expect("a case").model().expect("a model");
    let dynamic = model.matrices(&[1.0; 15]).expect("held");
    let v = problem.exact().modes.shapes();
    let (k, g) = (
        v.tr_mul(&(&dynamic.stiffness * v)),
        v.tr_mul(&(&dynamic.mass * v)),
    );
    for i in 0..MODES {
        let lambda = 1.0 / problem.exact().modes.omega_squared()[i];
        assert_relative_eq!(
            g[(i, i)],
            k[(i, i)] * lambda,
            max_relative = MATRIX_ROUND_OFF
        );
        assert!((k[(i, i)] / (g[(i, i)] * lambda) - 1.0).abs() > WRONG_FORM);
    }
}

/// A wing section with aileron in a flow: stiffness, and G complex and unsymmetric.
fn wing_section() -> (Complexes, Complexes, LeftRightModes<Complex<f64>>) {
    let (stiffness, g) = aeroelastic_section(0.15);
    let modes = solve(&stiffness, &g).expect("three modes");
    (complex(&stiffness), g, modes)
}

#[test]
fn transposed_pencil_needs_g_transposed() {
    // (C.4), (C.6), (C.7), (C.9) print G where the transposed pencil (C.2) has Gᵗ. K is its own transpose.
    let (stiffness, g, modes) = wing_section();
    let (u, v) = (&modes.left, &modes.right);
    let c_4 = |g: &Complexes| {
        amax(&(through(v, &stiffness, u) * DMatrix::from_diagonal(&modes.roots) - through(v, g, u)))
    };
    assert!(c_4(&g.transpose()) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(c_4(&g) > WRONG_FORM);
    // (C.9): a scalar equals its transpose, uᵗGv = vᵗGᵗu; vᵗGu is another number.
    let b = through(u, &g, v);
    assert!(amax(&(&b - through(v, &g.transpose(), u).transpose())) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(amax(&(&b - through(v, &g, u).transpose())) > WRONG_FORM);
}

#[test]
fn changes_are_seen_through_the_transposed_left_shapes() {
    // Before (C.14) the scan has α = U ΔG Vᵗ, β = U ΔK V. Premultiplied by Uᵗ, as (C.12) is, the changed pencil in
    // v = Vq is k(λ − Λ) + βλ − α, for any λ, with Uᵗ in both.
    let (stiffness, g, modes) = wing_section();
    let (u, v) = (&modes.left, &modes.right);
    let stiffness_change = complex(&dmatrix![0.1, 0.0, 0.02; 0.0, -0.2, 0.0; 0.02, 0.0, 0.05]);
    let g_change = aeroelastic_section(0.3).1 - &g;
    let lambda = Complex::new(0.7, 0.2);
    let changed = through(
        u,
        &((&stiffness + &stiffness_change) * lambda - (&g + &g_change)),
        v,
    );
    let k = through(u, &stiffness, v);
    let unchanged = &k * (DMatrix::identity(3, 3) * lambda - DMatrix::from_diagonal(&modes.roots));
    let error = |alpha: &Complexes, beta: &Complexes| {
        amax(&(&unchanged + beta * lambda - alpha - &changed))
    };
    let ours = ModalChange::new(&stiffness, &modes, &stiffness_change, &g_change).expect("it fits");
    assert!(error(&ours.alpha, &ours.beta) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(error(&(u * &g_change * v.transpose()), &ours.beta) > WRONG_FORM);
    assert!(error(&ours.alpha, &(u * &stiffness_change * v)) > WRONG_FORM);
}
