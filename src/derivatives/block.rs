//! First order for a block of parameters side by side.

use super::lanes::{LANES, Lanes, ZERO, combinations_into, lanes};
use crate::error::Error;
use crate::modal::{ModalProblem, Share};
use crate::perturbation::SMALLEST_SEPARATION;
use nalgebra::{DMatrix, DVector};
use std::cmp::Reverse;

/// Parameters that are changed side by side, and their generalized shares as rank-one terms.
///
/// An element's share has a low rank (a shear panel's one, a flat membrane's five), so that
/// $V^t K_e V = \sum_t s_t f_t f_t^t$ has few terms.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// The parameters, one a lane; lanes beyond them change nothing.
    pub parameters: Vec<usize>,
    /// Whether they change the mass, and not the stiffness.
    pub is_mass: bool,
    /// The vectors $f_t$, one after the other (terms × n).
    vectors: Vec<Lanes>,
    /// The signs $s_t$; zero for a parameter that has fewer terms than its block.
    signs: Vec<Lanes>,
}

impl Block {
    /// All parameters of a problem, in blocks of one kind and of like rank.
    pub fn all(problem: &ModalProblem) -> Vec<Self> {
        let mut blocks = Vec::new();
        for is_mass in [false, true] {
            let of_kind =
                |&e: &usize| matches!(problem.generalized_shares[e], Share::Mass(_)) == is_mass;
            let mut parameters: Vec<usize> =
                (0..problem.parameter_count()).filter(of_kind).collect();
            parameters.sort_by_key(|&e| Reverse(problem.share_terms[e].signs.len()));
            let chunks = parameters.chunks(LANES);
            blocks.extend(chunks.map(|chunk| Self::new(problem, chunk, is_mass)));
        }
        blocks
    }

    fn new(problem: &ModalProblem, parameters: &[usize], is_mass: bool) -> Self {
        let terms = |e: usize| &problem.share_terms[e];
        let ranks = parameters.iter().map(|&e| terms(e).signs.len());
        let most = ranks.max().unwrap_or(0);
        let count = problem.start.len();
        let mut vectors = vec![ZERO; most * count];
        let mut signs = vec![ZERO; most];
        for (lane, &e) in parameters.iter().enumerate() {
            for (t, &sign) in terms(e).signs.iter().enumerate() {
                signs[t][lane] = sign;
                for i in 0..count {
                    vectors[t * count + i][lane] = terms(e).vectors[(i, t)];
                }
            }
        }
        Self {
            parameters: parameters.to_vec(),
            is_mass,
            vectors,
            signs,
        }
    }

    /// The change $h\, p^t (V^t K_e V)\, p$ of every parameter, its lower triangle column by column (n × n), for present
    /// shapes $p$ in terms of the start's and relative changes $h$. `vector` is storage for n numbers.
    #[inline(always)]
    pub fn change_into(
        &self,
        present: &DMatrix<f64>,
        relative_change: &Lanes,
        vector: &mut [Lanes],
        change: &mut [Lanes],
    ) {
        let count = vector.len();
        change.fill(ZERO);
        for (start, sign) in self.vectors.chunks_exact(count).zip(&self.signs) {
            // Columns of p are stored one after the other, as rows of its transpose: this is pᵗ f.
            combinations_into(present.as_slice(), start, vector);
            for (j, column) in change.chunks_exact_mut(count).enumerate() {
                let weighted = lanes(|l| relative_change[l] * sign[l] * vector[j][l]);
                for (sum, entry) in column[j..].iter_mut().zip(&vector[j..]) {
                    *sum = lanes(|l| sum[l] + weighted[l] * entry[l]);
                }
            }
        }
    }

    /// First order (C.20, C.21) for every parameter: $x$ and the generalized shapes $p$ (n × n, column by column).
    ///
    /// A change of stiffness has $x_i = \omega_i^2 = k_{ii} + \beta_{ii}$, one of mass $x_i = 1/\omega_i^2 = (1+\alpha_{ii})/k_{ii}$.
    /// Both halves of a pair of modes follow from one division: with $q = \beta_{ij}/(x_i - x_j)$ they are $p_{ij} = -q$ and
    /// $p_{ji} = q$, and for a mass, with $\alpha$ in place of $\beta$, $p_{ij} = -q/k_{ii}$ and $p_{ji} = q/k_{jj}$.
    ///
    /// # Errors
    /// [`Error::LostRoot`], [`Error::CoalescingModes`].
    #[inline(always)]
    pub fn first_order_into(
        &self,
        k: &DVector<f64>,
        change: &[Lanes],
        x: &mut [Lanes],
        shapes: &mut [Lanes],
    ) -> Result<(), Error> {
        let count = k.len();
        for (i, x) in x.iter_mut().enumerate() {
            let own = &change[i * count + i];
            *x = if self.is_mass {
                lanes(|l| (1.0 + own[l]) / k[i])
            } else {
                lanes(|l| k[i] + own[l])
            };
        }
        let scale = |i: usize| if self.is_mass { 1.0 / k[i] } else { 1.0 };
        let mut margin = [f64::INFINITY; LANES];
        for j in 0..count {
            shapes[j * count + j] = [1.0; LANES];
            for i in j + 1..count {
                let (a, b, entry) = (&x[i], &x[j], &change[j * count + i]);
                let difference = lanes(|l| a[l] - b[l]);
                margin = lanes(|l| {
                    let own = difference[l].abs() - SMALLEST_SEPARATION * larger(a[l], b[l]);
                    if own < margin[l] { own } else { margin[l] }
                });
                let q = lanes(|l| entry[l] / difference[l]);
                shapes[j * count + i] = lanes(|l| -q[l] * scale(i));
                shapes[i * count + j] = lanes(|l| q[l] * scale(j));
            }
        }
        if margin.iter().all(|&margin| margin > 0.0) && x.iter().flatten().all(|&x| is_root(x)) {
            Ok(())
        } else {
            Err(unfit(x))
        }
    }
}

/// The larger of two numbers, neither of them NaN.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

fn is_root(x: f64) -> bool {
    x > 0.0 && x.is_finite()
}

/// Why first order cannot be carried out: a root that is lost, or two that are too close.
#[cold]
fn unfit(x: &[Lanes]) -> Error {
    for (mode, values) in x.iter().enumerate() {
        if let Some(&value) = values.iter().find(|&&value| !is_root(value)) {
            return Error::LostRoot { mode, value };
        }
    }
    let (mut first, mut second, mut separation) = (0, 0, f64::INFINITY);
    for j in 0..x.len() {
        for i in j + 1..x.len() {
            for (&a, &b) in x[i].iter().zip(&x[j]) {
                let found = (a - b).abs() / larger(a, b);
                if found < separation {
                    (first, second, separation) = (i, j, found);
                }
            }
        }
    }
    Error::CoalescingModes {
        first,
        second,
        separation,
    }
}
