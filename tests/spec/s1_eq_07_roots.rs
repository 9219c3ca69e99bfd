//! (7), which is the first line of (C.22): the recursion of the roots, and its printed and scanned forms.
//!
//! Roots and shapes of a changed structure satisfy every row of (C.16). A formula that follows from a row therefore
//! gives exact roots and shapes back when it is given exact ones; the printed and the scanned forms here do not.

use crate::common::appendix_c::exact;
use crate::common::boxes::first_problem;
use crate::common::tolerances::{EIGEN_ROUND_OFF, WRONG_FORM};
use corfem::method::analysis::Analysis;
use corfem::method::perturbation::Perturbed;
use nalgebra::{DMatrix, DVector};

pub const MODES: usize = 9;

/// Case 2's modes, a change of every element by ten percent, up and down in turn, and the exact modes after it.
pub struct Changed {
    pub k: DVector<f64>,
    pub beta: DMatrix<f64>,
    pub gamma: DVector<f64>,
    pub p: DMatrix<f64>,
}

impl Changed {
    pub fn new() -> Self {
        let problem = first_problem(2);
        let mut beta = DMatrix::zeros(MODES, MODES);
        for (e, share) in problem.shares().iter().enumerate() {
            beta += if e % 2 == 0 { 0.1 } else { -0.1 } * share;
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
    pub fn root_error(&self, change: impl Fn(usize) -> f64) -> f64 {
        let error = |i: usize| ((1.0 / self.k[i] + change(i)) / self.gamma[i] - 1.0).abs();
        (0..MODES).map(error).fold(0.0, f64::max)
    }

    /// The first line of (C.22) with a root before the sum and with the sum over the other modes.
    pub fn implicit_root(&self, i: usize, root: f64, sum: f64) -> f64 {
        -(self.beta[(i, i)] / self.k[i] + root * sum) / (self.k[i] + self.beta[(i, i)])
    }

    /// (C.24) with a sum over modes.
    pub fn explicit_root(&self, i: usize, sum: f64) -> f64 {
        -sum / self.k[i] / (self.k[i] + sum)
    }

    /// Largest error of the shapes that a formula gives for mode i's component in mode j.
    pub fn shape_error(&self, shape: impl Fn(usize, usize) -> f64) -> f64 {
        let error = |i: usize, j: usize| (shape(i, j) - self.p[(i, j)]).abs();
        (0..MODES)
            .flat_map(|j| without(&[j]).map(move |i| error(i, j)).collect::<Vec<_>>())
            .fold(0.0, f64::max)
    }

    /// The numerator of (8), without its sign.
    pub fn numerator(&self, i: usize, j: usize) -> f64 {
        self.beta[(i, j)]
            + without(&[i, j])
                .map(|s| self.beta[(i, s)] * self.p[(s, j)])
                .sum::<f64>()
    }

    /// The denominator of (8) with the root of a mode.
    pub fn denominator(&self, i: usize, mode: usize) -> f64 {
        self.k[i] + self.beta[(i, i)] - 1.0 / self.gamma[mode]
    }
}

/// The modes that are not left out.
pub fn without(left_out: &[usize]) -> impl Iterator<Item = usize> {
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
